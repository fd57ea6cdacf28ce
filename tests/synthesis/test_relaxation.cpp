#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/bounds/enclosure.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/synthesis/relaxation.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

/// The exchange ends at 1e-7.
constexpr double accuracy = 1e-6;

Eigen::VectorXd one_number(double value) { return Eigen::VectorXd::Constant(1, value); }

/// A first leg with the base joint (d, 0), d between bounds, and a second one that reaches everything.
SynthesisTask one_leg_task(const Leg& leg, Shape shape, std::vector<OrientationRange> orientations, double lower,
                           double upper, const Placement& placement = {}) {
  Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(8, 1);
  joints(0, 0) = 1.0;
  const Leg other{{0.0, 20.0}, {0.0, 0.0}, {0.0, 100.0}, {}, {}};
  return {{"W", std::move(shape), placement},
          std::move(orientations),
          {Manipulator("two legs", {leg, other}),
           {"d"},
           joints,
           Eigen::MatrixXd::Zero(4, 1),
           one_number(lower),
           one_number(upper),
           one_number(leg.base_joint.x())},
          {}};
}

const Eigen::Vector2d origin{0.0, 0.0};

LeastRelaxation solve(const SynthesisTask& task, const Relaxation& relaxation, double start) {
  return find_least_relaxation(task, relaxation, one_number(start), NloptSolver());
}

/// The positioning table of a stranger: strokes of 100 for a rectangle of 120 x 80 and 15 degrees either way; all
/// joints are free within 100. In units of 125.
SynthesisTask positioning_table(double longest = 250.0, double unit = 125.0) {
  const std::vector<std::array<double, 4>> joints{{-180, -100, -40, -25}, {180, -100, 40, -25}, {0, 220, 0, 45}};
  std::vector<Leg> legs;
  Eigen::VectorXd design(12);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [a, b, c, d] = joints[i];
    legs.push_back({{a / unit, b / unit}, {c / unit, d / unit}, {150.0 / unit, longest / unit}, {}, {}});
    design.segment<4>(4 * static_cast<Eigen::Index>(i)) << a / unit, b / unit, c / unit, d / unit;
  }
  return {{"rectangle", Rectangle{120.0, 80.0}, {origin, 1.0 / unit, 0.0}},
          {{-15.0 * degree, 15.0 * degree}},
          {Manipulator("table", legs), std::vector<std::string>(12, "joint"), Eigen::MatrixXd::Identity(12, 12),
           Eigen::MatrixXd::Zero(6, 12), design.array() - 100.0 / unit, design.array() + 100.0 / unit, design},
          {}};
}

/// The design of the task's own manipulator, then random ones within the bounds.
std::vector<Eigen::VectorXd> starts_of(const SynthesisTask& task, int count) {
  std::vector<Eigen::VectorXd> starts{task.designs.reference()};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  while (static_cast<int>(starts.size()) < count) {
    Eigen::VectorXd start = starts.front();
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      start[i] = task.designs.lower()[i] + share(random) * (task.designs.upper()[i] - task.designs.lower()[i]);
    }
    starts.push_back(start);
  }
  return starts;
}

BOOST_AUTO_TEST_SUITE(relaxation)

// A circle of radius R about O, a leg from distance D whose platform joint is P: it needs lengths from D - R to D + R.
BOOST_AUTO_TEST_CASE(a_circle_needs_its_radius_either_way) {
  const Leg leg{{5.0, 0.0}, origin, {3.5, 5.25}, {}, {}};
  const SynthesisTask task = one_leg_task(leg, Circle{2.0}, slices({0.3}), 5.0, 5.0);
  const LeastViolation least = find_least_violation(task, one_number(5.0), NloptSolver());
  BOOST_TEST(least.largest == 1.75, tolerance(accuracy));
  BOOST_REQUIRE(least.binding.size() == 1U);
  BOOST_TEST(least.binding[0].limit.leg == 0U);
  BOOST_TEST((least.binding[0].limit.kind == LimitKind::maximum_length));
  BOOST_TEST((least.binding[0].position - Eigen::Vector2d(-2.0, 0.0)).norm() < 1e-5);
  BOOST_TEST(least.binding[0].orientation == 0.3);
  // The minimum length is violated by .5 besides, so that neither helps alone.
  BOOST_TEST(!solve(task, {RelaxationKind::maximum_lengths}, 5.0).found);
  BOOST_TEST(!solve(task, {RelaxationKind::minimum_lengths}, 5.0).found);
  const LeastRelaxation both = solve(task, {RelaxationKind::lengths}, 5.0);
  BOOST_TEST(both.found);
  BOOST_TEST(both.amount == 1.75, tolerance(accuracy));
  // D + s R <= 5.25 and D - s R >= 3.5: s = 1/8.
  const LeastRelaxation smaller = solve(task, {RelaxationKind::workspace}, 5.0);
  BOOST_TEST(smaller.found);
  BOOST_TEST(1.0 - smaller.amount == 0.125, tolerance(accuracy));
  BOOST_TEST(!solve(task, {RelaxationKind::orientations}, 5.0).found);
}

BOOST_AUTO_TEST_CASE(one_limit_gives_alone) {
  const Leg leg{{5.0, 0.0}, origin, {3.5, 8.0}, {}, {}};
  const SynthesisTask task = one_leg_task(leg, Circle{2.0}, slices({0.0}), 4.0, 5.0);
  const LeastRelaxation minimum = solve(task, {RelaxationKind::minimum_lengths, 0}, 4.2);
  BOOST_TEST(minimum.found);
  BOOST_TEST(minimum.amount == 0.5, tolerance(accuracy));
  BOOST_TEST(minimum.design[0] == 5.0, tolerance(accuracy));
  BOOST_TEST(!solve(task, {RelaxationKind::minimum_lengths, 1}, 4.2).found);
  BOOST_TEST(!solve(task, {RelaxationKind::maximum_lengths, 0}, 4.2).found);
  // The leg reaches from 5.5 on, half beyond the bound.
  const LeastRelaxation wider = solve(task, {RelaxationKind::bounds}, 4.2);
  BOOST_TEST(wider.found);
  BOOST_TEST(wider.amount == 0.5, tolerance(accuracy));
  BOOST_TEST(wider.design[0] == 5.5, tolerance(accuracy));
  const LeastViolation least = find_least_violation(task, one_number(4.2), NloptSolver());
  BOOST_TEST(least.largest == 0.5, tolerance(accuracy));
  BOOST_TEST(least.binding_bounds.size() == 1U);
}

// About the base joint every point of the circle is as far as every other, to the last bit or not.
BOOST_AUTO_TEST_CASE(a_circle_about_the_base_joint_has_no_peak) {
  for (const double radius : {2.0, 3.0, 0.7, 1.1}) {
    const Leg leg{origin, origin, {0.0, 0.5}, {}, {}};
    const SynthesisTask task = one_leg_task(leg, Circle{radius}, slices({0.0}), 0.0, 0.0);
    const LeastViolation least = find_least_violation(task, one_number(0.0), NloptSolver());
    BOOST_TEST(least.largest == radius - 0.5, tolerance(accuracy));
    BOOST_TEST(!least.binding.empty());
    const LeastRelaxation longer = solve(task, {RelaxationKind::maximum_lengths}, 0.0);
    BOOST_TEST(longer.amount == radius - 0.5, tolerance(accuracy));
  }
}

// Two limits pull at the base joint: |d| + R <= l and |d - 6| + R <= l, of which the larger is least at d = 3.
BOOST_AUTO_TEST_CASE(limits_that_contradict_each_other_meet_half_way) {
  SynthesisTask task = one_leg_task({origin, origin, {0.0, 4.0}, {}, {}}, Circle{2.0}, slices({0.0}), -9.0, 9.0);
  Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(8, 1);
  joints(0, 0) = 1.0;
  joints(4, 0) = 1.0;
  task.designs =
      DesignSpace(Manipulator("two", {{origin, origin, {0.0, 4.0}, {}, {}}, {{-6.0, 0.0}, origin, {0.0, 4.0}, {}, {}}}),
                  {"d"}, joints, Eigen::MatrixXd::Zero(4, 1));
  for (const double start : {-8.0, 0.0, 2.9, 7.0}) {
    const LeastViolation least = find_least_violation(task, one_number(start), NloptSolver());
    BOOST_TEST(least.largest == 1.0, tolerance(accuracy));
    BOOST_TEST(least.design[0] == 3.0, tolerance(accuracy));
    BOOST_TEST(least.binding.size() == 2U);
    const LeastRelaxation longer = solve(task, {RelaxationKind::maximum_lengths}, start);
    BOOST_TEST(longer.amount == 1.0, tolerance(accuracy));
    // One leg alone does all of it: d = 2 for the other.
    const LeastRelaxation alone = solve(task, {RelaxationKind::maximum_lengths, 1}, start);
    BOOST_TEST(alone.found);
    BOOST_TEST(alone.amount == 2.0, tolerance(accuracy));
  }
}

// q = c - R(phi) p with c = (5, 0), p = (2, 0) is sqrt(29 - 20 cos phi) from O, and the leg needs a length of one more.
BOOST_AUTO_TEST_CASE(orientations_give_as_far_as_the_leg_reaches) {
  const Leg leg{{5.0, 0.0}, {2.0, 0.0}, {0.0, 4.5}, {}, {}};
  const double farthest = std::acos((29.0 - 3.5 * 3.5) / 20.0);
  const double asked = 50.0 * degree;
  const std::vector<std::vector<OrientationRange>> cases{{{-asked, asked}}, slices({-asked, 0.0, asked})};
  for (const std::vector<OrientationRange>& orientations : cases) {
    const SynthesisTask task = one_leg_task(leg, Circle{1.0}, orientations, 5.0, 5.0);
    const LeastRelaxation narrower = solve(task, {RelaxationKind::orientations}, 5.0);
    BOOST_TEST(narrower.found);
    BOOST_TEST((1.0 - narrower.amount) * asked == farthest, tolerance(accuracy));
  }
  // About the middle, wherever that is.
  const Eigen::Rotation2Dd turn(0.4);
  Leg turned = leg;
  turned.platform_joint = turn.inverse() * leg.platform_joint;
  const SynthesisTask task = one_leg_task(turned, Circle{1.0}, {{0.4 - asked, 0.4 + asked}}, 5.0, 5.0);
  const LeastRelaxation narrower = solve(task, {RelaxationKind::orientations}, 5.0);
  BOOST_TEST((1.0 - narrower.amount) * asked == farthest, tolerance(accuracy));
}

// The disc that a minimum length leaves out lies within the workspace: no limit is violated on the outline.
BOOST_AUTO_TEST_CASE(a_hole_within_the_outline_is_a_violation) {
  const Leg leg{{0.5, 0.0}, origin, {1.0, 20.0}, {}, {}};
  const SynthesisTask task = one_leg_task(leg, Circle{3.0}, slices({0.0}), -1.0, 1.0);
  const LeastViolation least = find_least_violation(task, one_number(0.5), NloptSolver());
  BOOST_TEST(least.largest == 1.0);
  BOOST_REQUIRE(!least.binding.empty());
  BOOST_TEST((least.binding[0].limit.kind == LimitKind::minimum_length));
  BOOST_TEST((least.binding[0].position - Eigen::Vector2d(least.design[0], 0.0)).norm() < 1e-9);
  // Out of the circle, by the minimum length.
  const LeastRelaxation outside = solve(task, {RelaxationKind::bounds}, 0.5);
  BOOST_TEST(outside.found);
  BOOST_TEST(outside.design[0] == 4.0, tolerance(accuracy));
  BOOST_TEST(outside.amount == 3.0, tolerance(accuracy));
  // A shorter minimum length leaves a smaller hole.
  BOOST_TEST(!solve(task, {RelaxationKind::minimum_lengths}, 0.5).found);
  // Base joint at 2.5: the workspace must end at 2.5 - 1.
  const SynthesisTask fixed =
      one_leg_task({{2.5, 0.0}, origin, {1.0, 20.0}, {}, {}}, Circle{3.0}, slices({0.0}), 2.5, 2.5);
  const LeastRelaxation smaller = solve(fixed, {RelaxationKind::workspace}, 2.5);
  BOOST_TEST(smaller.found);
  BOOST_TEST(1.0 - smaller.amount == 0.5, tolerance(accuracy));
}

// c = 0 and p = (4, 0): q = -4 (cos phi, sin phi). With O' = q(0) a slice at phi has a hole up to 8 sin(phi / 2) = R +
// l_min.
BOOST_AUTO_TEST_CASE(a_hole_moves_with_the_orientation) {
  const Leg leg{origin, {4.0, 0.0}, {0.25, 30.0}, {}, {}};
  const double asked = 120.0 * degree;
  const SynthesisTask task = one_leg_task(leg, Circle{1.0}, slices({0.0, asked}), 0.0, 0.0, {{-4.0, 0.0}, 1.0, 0.0});
  const double first = 2.0 * std::asin(1.25 / 8.0);
  // From the centre of the circle no way out is better than another: begin a little aside.
  SynthesisTask aside = task;
  aside.orientations = slices({0.01, asked});
  const LeastRelaxation narrower = solve(aside, {RelaxationKind::orientations}, 0.0);
  BOOST_TEST(narrower.found);
  const double half = 0.5 * (asked - 0.01);
  BOOST_TEST(0.01 + half * narrower.amount == first, tolerance(accuracy));
}

BOOST_AUTO_TEST_CASE(what_is_reached_needs_nothing) {
  const Leg leg{{5.0, 0.0}, origin, {2.0, 8.0}, {}, {}};
  const SynthesisTask task = one_leg_task(leg, Rectangle{2.0, 2.0}, {{-0.5, 0.5}}, 4.0, 6.0);
  const LeastViolation least = find_least_violation(task, one_number(5.0), NloptSolver());
  BOOST_TEST(least.largest <= 1e-7);
  BOOST_TEST(least.cost.evaluations == 0);
  BOOST_TEST(least.design[0] == 5.0);
  // As far from all limits as can be: sqrt((d + 1)^2 + 1) below 8 by as much as d - 1 is above 2.
  ReachOptions options;
  options.enough = -infinity;
  const LeastViolation farthest = find_least_violation(task, one_number(5.0), NloptSolver(), options);
  const double d = farthest.design[0];
  BOOST_TEST(farthest.largest == 3.0 - d, tolerance(accuracy));
  BOOST_TEST(farthest.largest == std::hypot(d + 1.0, 1.0) - 8.0, tolerance(accuracy));
  BOOST_TEST(solve(task, {RelaxationKind::workspace}, 5.0).amount == 0.0);
}

BOOST_AUTO_TEST_CASE(both_solvers_agree) {
  DynamicQOptions dual;
  dual.subproblem = SubproblemSolver::dual;
  dual.safeguard.active = true;
  dual.move_limit = 0.3;
  const SynthesisTask task = positioning_table();
  const NloptSolver slsqp;
  const DynamicQ dynamic_q(dual);
  const LeastViolation one = find_least_violation(task, task.designs.reference(), slsqp);
  const LeastViolation other = find_least_violation(task, one.design, dynamic_q);
  BOOST_TEST(other.largest == one.largest, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(the_positioning_table_needs_longer_legs) {
  const SynthesisTask task = positioning_table();
  const NloptSolver slsqp;
  SearchCost whole;
  const auto add = [&whole](const SearchCost& cost) {
    whole.evaluations += cost.evaluations;
    whole.rows = std::max(whole.rows, cost.rows);
  };
  LeastViolation least;
  least.largest = infinity;
  const std::vector<Eigen::VectorXd> starts = starts_of(task, 8);
  for (const Eigen::VectorXd& start : starts) {
    LeastViolation one = find_least_violation(task, start, slsqp);
    add(one.cost);
    if (one.largest < least.largest) least = std::move(one);
  }
  // Ipopt came to 10.54 of the file's units.
  BOOST_TEST(least.largest * 125.0 > 1.0);
  BOOST_TEST(least.largest * 125.0 < 10.54);
  const std::vector<RelaxationKind> kinds{RelaxationKind::lengths,   RelaxationKind::maximum_lengths,
                                          RelaxationKind::workspace, RelaxationKind::orientations,
                                          RelaxationKind::bounds,    RelaxationKind::minimum_lengths};
  for (const RelaxationKind kind : kinds) {
    const Relaxation relaxation{kind};
    LeastRelaxation best;
    best.amount = infinity;
    std::vector<Eigen::VectorXd> all = starts;
    all.push_back(least.design);
    for (const Eigen::VectorXd& start : all) {
      LeastRelaxation one = find_least_relaxation(task, relaxation, start, slsqp);
      add(one.cost);
      if (one.found && one.amount < best.amount) best = std::move(one);
    }
    BOOST_REQUIRE(best.found);
    // A little more than the least does, proved.
    const SynthesisTask enough = relax(task, relaxation, 1.001 * best.amount);
    ReachOptions inside;
    inside.enough = -infinity;
    const LeastViolation design = find_least_violation(enough, best.design, slsqp, inside);
    BOOST_TEST(
        (prove_containment(enough.designs.manipulator(design.design), enough.prescribed, enough.orientations.front())
             .verdict == Verdict::proved));
    BOOST_TEST((design.design - enough.designs.lower()).minCoeff() >= -1e-9);
    BOOST_TEST((enough.designs.upper() - design.design).minCoeff() >= -1e-9);
    // A little less does not, as far as the search tells.
    const SynthesisTask less = relax(task, relaxation, 0.99 * best.amount);
    for (const Eigen::VectorXd& start : {best.design, least.design}) {
      const LeastViolation missed = find_least_violation(less, start, slsqp);
      BOOST_TEST(missed.largest > 1e-6);
      add(missed.cost);
    }
  }
  BOOST_TEST_MESSAGE(whole.evaluations << " evaluations, " << whole.rows << " rows");
  BOOST_TEST(whole.evaluations < 20'000);
  BOOST_TEST(whole.rows < 5U * 14U);
}

BOOST_AUTO_TEST_CASE(the_unit_of_length_does_not_matter) {
  const SynthesisTask task = positioning_table();
  const SynthesisTask other = positioning_table(250.0, 12.5);
  const NloptSolver slsqp;
  const double one = find_least_violation(task, task.designs.reference(), slsqp).largest * 125.0;
  BOOST_TEST(find_least_violation(other, other.designs.reference(), slsqp).largest * 12.5 == one, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(relaxed_tasks_have_given_way) {
  const SynthesisTask task = positioning_table();
  const Manipulator longer = relax(task, {RelaxationKind::lengths, 1}, 0.2).designs.origin();
  BOOST_TEST(longer.leg(1).length.upper == 2.2);
  BOOST_TEST(longer.leg(1).length.lower == 1.0);
  BOOST_TEST(longer.leg(0).length.upper == 2.0);
  BOOST_TEST(relax(task, {RelaxationKind::workspace}, 0.25).prescribed.radius(0.0) == 0.75 * 60.0 / 125.0,
             tolerance(1e-14));
  BOOST_TEST(relax(task, {RelaxationKind::orientations}, 0.5).orientations[0].upper == 7.5 * degree, tolerance(1e-14));
  BOOST_TEST(relax(task, {RelaxationKind::bounds}, 0.1).designs.lower()[0] == -2.34, tolerance(1e-14));
  BOOST_TEST(largest_amount(task, {RelaxationKind::minimum_lengths}) == 0.999 * 1.2, tolerance(1e-14));
  BOOST_TEST(std::isinf(largest_amount(task, {RelaxationKind::bounds})));
}

BOOST_AUTO_TEST_CASE(wrong_input_is_named) {
  const SynthesisTask task = positioning_table();
  const Eigen::VectorXd design = task.designs.reference();
  const NloptSolver slsqp;
  const auto throws = [](auto&& call, const std::string& part) {
    BOOST_CHECK_EXCEPTION(call(), std::invalid_argument, [&](const std::invalid_argument& error) {
      return std::string(error.what()).find(part) != std::string::npos;
    });
  };
  throws([&] { relax(task, {RelaxationKind::workspace}, 1.5); }, "1.5");
  throws([&] { relax(task, {RelaxationKind::lengths}, -1.0); }, "-1");
  throws([&] { relax(task, {RelaxationKind::lengths, 3}, 0.1); }, "the leg that gives is 3");
  throws([&] { find_least_violation(task, design.head(3), slsqp); }, "entries of the design is 3");
  throws([&] { find_least_violation(task, design, slsqp, {.samples = 7}); }, "samples of the outline is 7");
  throws([&] { find_least_violation(task, design, slsqp, {.tolerance = 0.0}); }, "tolerance is 0");
  throws([&] { find_least_violation(task, design, slsqp, {.max_rounds = 0}); }, "rounds is 0");
  SynthesisTask none = task;
  none.orientations.clear();
  throws([&] { find_least_violation(none, design, slsqp); }, "0 ranges");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
