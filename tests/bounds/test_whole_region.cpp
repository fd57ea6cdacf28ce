#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/bounds/whole_region.hpp"
#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/synthesis/assessment.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

/// All joint coordinates of a manipulator, free within a distance of where they are.
DesignSpace free_joints(const Manipulator& origin, double within) {
  const auto size = static_cast<Eigen::Index>(4 * origin.size());
  Eigen::VectorXd joints(size);
  std::vector<std::string> names;
  for (std::size_t leg = 0; leg < origin.size(); ++leg) {
    joints.segment<4>(static_cast<Eigen::Index>(4 * leg)) << origin.leg(leg).base_joint, origin.leg(leg).platform_joint;
    for (const char* of : {"base_x", "base_y", "platform_x", "platform_y"}) names.push_back(of + std::to_string(leg));
  }
  const Eigen::VectorXd reach = Eigen::VectorXd::Constant(size, within);
  return {origin,
          names,
          Eigen::MatrixXd::Identity(size, size),
          Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * origin.size()), size),
          joints - reach,
          joints + reach,
          joints};
}

Eigen::VectorXd start_of(const SynthesisTask& task) { return 0.5 * (task.designs.lower() + task.designs.upper()); }

/// A positioning table in units of 100: it is its own mirror image, so every pose with x = 0 and phi = 0 is singular.
SynthesisTask table_task() {
  const Manipulator table{
      "table",
      {Leg{{-1.8, -1.0}, {-0.4, -0.25}, {1.5, 3.2}, {}, {}}, Leg{{1.8, -1.0}, {0.4, -0.25}, {1.5, 3.2}, {}, {}},
       Leg{{0.0, 2.2}, {0.0, 0.45}, {1.5, 3.2}, {}, {}}}};
  return {{"W", Rectangle{1.2, 0.8}},
          {{-15.0 * degree, 15.0 * degree}},
          free_joints(table, 1.0),
          {Normalisation::homogeneous, 0.5}};
}

/// Three legs, the first of which stands within the rectangle that is to be reached: around (0.05, 0.03) a disc of
/// radius 0.1 is out of reach. In units of 100.
SynthesisTask hole_task(double within) {
  const Manipulator manipulator{
      "hole",
      {Leg{{0.05, 0.03}, {0.0, 0.0}, {0.1, 3.0}, {}, {}}, Leg{{-1.5, -0.2}, {-0.2, 0.0}, {0.2, 3.0}, {}, {}},
       Leg{{0.1, 1.6}, {0.1, 0.3}, {0.2, 3.0}, {}, {}}}};
  return {
      {"W", Rectangle{0.8, 0.6}}, slices({0.0}), free_joints(manipulator, within), {Normalisation::homogeneous, 0.5}};
}

double random_between(std::mt19937_64& random, double lower, double upper) {
  return lower + (upper - lower) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// The smallest kappa^-1 over a grid of inside, outline and range.
double smallest_of_grid(const SynthesisTask& task, const Eigen::VectorXd& design, int directions, int radii,
                        int orientations) {
  const Manipulator manipulator = task.designs.manipulator(design);
  double smallest = std::numeric_limits<double>::infinity();
  for (const OrientationRange& range : task.orientations) {
    for (const double phi : range.spread(orientations)) {
      for (const double beta : task.prescribed.angles(directions)) {
        const Eigen::Vector2d outward = task.prescribed.point(beta) - task.prescribed.centre();
        for (int k = 0; k <= radii; ++k) {
          const Pose pose{task.prescribed.centre() + outward * k / radii, phi};
          smallest = std::min(smallest, kappa_inverse(manipulator, pose, task.conditioning));
        }
      }
    }
  }
  return smallest;
}

ConstraintExchange sequential_programming() {
  NloptOptions options;
  options.algorithm = NloptAlgorithm::slsqp;
  return ConstraintExchange(std::make_shared<NloptSolver>(options));
}

WholeRegionResult solve(const SynthesisTask& task, SingularitySide side) {
  WholeRegionOptions options;
  options.pointwise = {60, side};
  options.solver.feasibility_tolerance = 1e-7;
  options.solver.max_function_evaluations = 1000;
  options.proof.allowance = 1e-4;
  return solve_whole_region(task, start_of(task), sequential_programming(), options);
}

/// The value of the last inequality of a problem with one distance constraint: l_min less the distance.
double distance_constraint(const SynthesisTask& task, const Eigen::VectorXd& design, std::size_t leg, double phi) {
  const Problem problem = whole_region_problem(
      task, {{Limit{leg, LimitKind::minimum_length}, {Eigen::Vector2d::Zero(), phi}}}, {.points = 8});
  Eigen::VectorXd x(problem.n), g(problem.inequalities);
  x << design, 0.0;
  problem.inequality(x, g);
  return g[problem.inequalities - 1];
}

BOOST_AUTO_TEST_SUITE(whole_region)

BOOST_AUTO_TEST_CASE(distances_from_a_circle_and_a_rectangle_are_closed_forms) {
  std::mt19937_64 random(1);
  SynthesisTask task = hole_task(1.0);
  const Eigen::VectorXd start = start_of(task);
  for (int k = 0; k < 30; ++k) {
    Eigen::VectorXd design = start;
    design[0] = random_between(random, -1.0, 1.0);
    design[1] = random_between(random, -1.0, 1.0);
    const Eigen::Vector2d q = design.head<2>();  // the platform joint is at P
    task.prescribed = PrescribedWorkspace("circle", Circle{0.5}, {{0.1, -0.2}, 1.0, 0.0});
    const double of_circle = (q - Eigen::Vector2d(0.1, -0.2)).norm() - 0.5;
    BOOST_TEST(std::abs(distance_constraint(task, design, 0, 0.0) - (0.1 - of_circle)) < 1e-12);
    task.prescribed = PrescribedWorkspace("rectangle", Rectangle{0.8, 0.6});
    const Eigen::Array2d beyond = q.array().abs() - Eigen::Array2d(0.4, 0.3);
    const double of_rectangle =
        beyond.maxCoeff() < 0.0 ? beyond.maxCoeff() : beyond.max(Eigen::Array2d::Zero()).matrix().norm();
    BOOST_TEST(std::abs(distance_constraint(task, design, 0, 0.0) - (0.1 - of_rectangle)) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(derivatives_of_what_joins_are_those_of_its_values) {
  SynthesisTask task{{"W", Rectangle{0.3, 0.2}, {{0.4, 1.5}, 1.0, 0.2}},
                     {{-0.1, 0.15}},
                     samples::general_space(),
                     {Normalisation::homogeneous, {}}};
  const std::vector<PoseConstraint> constraints{
      {std::nullopt, {{0.41, 1.47}, 0.03}},
      {std::nullopt, {{0.35, 1.55}, -0.1}},
      {Limit{0, LimitKind::minimum_length}, {{0.0, 0.0}, 0.05}},
      {Limit{1, LimitKind::minimum_length}, {{0.0, 0.0}, -0.1}},
      {Limit{2, LimitKind::minimum_length}, {{0.0, 0.0}, 0.15}},
      {Limit{2, LimitKind::maximum_length}, {{0.42, 1.52}, 0.1}},
  };
  Eigen::VectorXd x(5);
  x << 0.05, -0.03, 0.04, 0.02, 0.3;
  const std::vector<PrescribedWorkspace> workspaces{
      task.prescribed,                                           // outside, nearest to a corner or an edge
      {"ellipse", Ellipse{{0.9, 0.4}}, {{0.3, 0.4}, 1.0, 0.3}},  // two of the three inside or close
      {"circle", Circle{1.2}, {{-0.3, 0.9}, 1.0, 0.0}},
      {"star", Polygon{{{2, -1}, {0.3, 0.4}, {0.2, 2}, {-0.4, 0.5}, {-2, -1}}}, {{0.0, 0.8}, 1.0, 0.1}},
  };
  for (const PrescribedWorkspace& prescribed : workspaces) {
    task.prescribed = prescribed;
    for (const SingularitySide side : {SingularitySide::either, SingularitySide::positive}) {
      const Problem problem = whole_region_problem(task, constraints, {.points = 3, .side = side});
      for (const DerivativeCheck& one : check_derivatives(problem, x).checks) {
        BOOST_TEST(one.passed, prescribed.name() << ", " << one.function << ": " << one.coordinate_error << ", "
                                                 << one.direction_error << ", order " << one.remainder_order);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(wrong_constraints_are_refused) {
  const SynthesisTask task = table_task();
  BOOST_CHECK_THROW(whole_region_problem(task, {{std::nullopt, {{0.0, 0.0}, 1.0}}}), std::invalid_argument);
  BOOST_CHECK_THROW(whole_region_problem(task, {{Limit{0, LimitKind::base_angle}, {{0.0, 0.0}, 0.0}}}),
                    std::invalid_argument);
  BOOST_CHECK_THROW(prove_design(task, Eigen::VectorXd::Zero(3)), std::invalid_argument);
  BOOST_CHECK_THROW(prove_design(task, start_of(task), {.allowance = -1.0}), std::invalid_argument);
  WholeRegionOptions options;
  options.conditioning_tolerance = 0.0;
  BOOST_CHECK_THROW(solve_whole_region(task, start_of(task), sequential_programming(), options), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_leg_within_the_workspace_leaves_a_hole) {
  const SynthesisTask task = hole_task(0.3);
  const Eigen::VectorXd start = start_of(task);
  // The outline is reached, as far as points of it tell.
  BOOST_TEST(assess(task, start, 500).violation == 0.0);
  const DesignProof proof = prove_design(task, start, {.allowance = 1e-4});
  BOOST_TEST((proof.reaches == Verdict::refuted));
  BOOST_REQUIRE(proof.limit.has_value());
  BOOST_TEST(to_string(*proof.limit) == "leg 1, minimum length");
  BOOST_TEST(proof.violation == 0.1, tolerance(1e-12));
  BOOST_TEST(proof.violation_bound == 0.1, tolerance(1e-12));
  BOOST_TEST((proof.limit_at->position - Eigen::Vector2d(0.05, 0.03)).norm() < 1e-12);
  // Without a minimum length there is none.
  BOOST_TEST(!find_hole(task.prescribed, Leg{{0.05, 0.03}, {0.0, 0.0}, {0.0, 3.0}, {}, {}}, {0.0, 0.0}).has_value());
  // With an arm at P the centre of the hole goes round: it is inside near 90 degrees only.
  const Leg turning{{0.0, 1.0}, {1.0, 0.0}, {0.1, 3.0}, {}, {}};
  BOOST_TEST(!find_hole(task.prescribed, turning, {0.0, 0.5}).has_value());
  BOOST_TEST(std::abs(*find_hole(task.prescribed, turning, {0.0, pi}) - 0.5 * pi) < 0.05);
}

BOOST_AUTO_TEST_CASE(a_synthesis_moves_a_hole_out_of_the_workspace) {
  const SynthesisTask task = hole_task(0.6);
  const WholeRegionResult found = solve(task, prevailing_side(task, start_of(task)));
  BOOST_TEST((found.proof.reaches == Verdict::proved));
  BOOST_TEST(found.closed);
  BOOST_TEST(found.proof.kappa_inverse.lower > 0.3);
  const Eigen::Vector2d q = hole_centre(task.designs.manipulator(found.design).leg(0), 0.0);
  const Eigen::Array2d beyond = q.array().abs() - Eigen::Array2d(0.4, 0.3);
  BOOST_TEST(beyond.max(Eigen::Array2d::Zero()).matrix().norm() >= 0.1 - 1e-4);
}

BOOST_AUTO_TEST_CASE(a_mirrored_table_is_singular_within_its_range) {
  const SynthesisTask task = table_task();
  const Eigen::VectorXd start = start_of(task);
  BOOST_TEST(assess(task, start).kappa_inverse == 0.577, tolerance(1e-3));  // at both ends of the range
  const DesignProof before = prove_design(task, start);
  BOOST_TEST(before.kappa_inverse.upper < 1e-6);
  BOOST_TEST(before.kappa_inverse.lower == 0.0);
  const WholeRegionResult found = solve(task, prevailing_side(task, start));
  BOOST_TEST((found.proof.reaches == Verdict::proved));
  BOOST_TEST(found.proof.kappa_inverse.lower > 0.0);
  BOOST_TEST(found.proof.kappa_inverse.lower <= smallest_of_grid(task, found.design, 40, 8, 13));
  // What the solver takes for the smallest is the smallest.
  BOOST_TEST(found.solved.x[12] - found.proof.kappa_inverse.lower < 1e-4);
}

// The bounds against a dense grid, and the exchange's claim, for manipulators of no symmetry.
BOOST_AUTO_TEST_CASE(what_is_proved_holds_on_a_dense_grid) {
  std::mt19937_64 random(23);
  for (int problem = 0; problem < 3; ++problem) {
    std::vector<Leg> legs;
    for (int leg = 0; leg < 3; ++leg) {
      const double at = 2.0 * pi * leg / 3.0 + random_between(random, -0.4, 0.4);
      const Eigen::Vector2d outward(std::cos(at), std::sin(at));
      const Eigen::Vector2d off(random_between(random, -0.2, 0.2), random_between(random, -0.2, 0.2));
      legs.push_back({2.0 * outward + off, 0.4 * Eigen::Vector2d(outward.y(), -outward.x()) + off, {0.8, 2.8}, {}, {}});
    }
    const double half = random_between(random, 5.0, 20.0) * degree;
    const SynthesisTask task{{"W", Rectangle{random_between(random, 0.5, 1.0), 0.6}},
                             {{-half, half}},
                             free_joints(Manipulator("random", legs), 0.4),
                             {Normalisation::homogeneous, 0.5}};
    const Eigen::VectorXd start = start_of(task);
    const DesignProof before = prove_design(task, start);
    const double grid = smallest_of_grid(task, start, 40, 8, 13);
    BOOST_TEST(before.kappa_inverse.lower <= grid);
    BOOST_TEST(before.kappa_inverse.upper <= grid + 1e-6);
    const WholeRegionResult found = solve(task, prevailing_side(task, start));
    BOOST_TEST((found.proof.reaches == Verdict::proved));
    BOOST_TEST(found.proof.kappa_inverse.lower <= smallest_of_grid(task, found.design, 40, 8, 13));
    BOOST_TEST(found.proof.kappa_inverse.upper > before.kappa_inverse.upper);
    BOOST_TEST(found.solved.x[12] - found.proof.kappa_inverse.lower < 1e-4);
  }
}

// The thesis's designs have their smallest value on outline and ends, so that nothing but points of the outline joins.
BOOST_AUTO_TEST_CASE(nothing_changes_where_outline_and_ends_decide) {
  const SynthesisTask task = samples::thesis_task({{-5.0 * degree, 5.0 * degree}});
  WholeRegionOptions options;
  options.pointwise = {1000, SingularitySide::positive};
  options.solver.feasibility_tolerance = 1e-7;
  const Eigen::VectorXd start = samples::thesis_start();
  const ConstraintExchange solver = sequential_programming();
  options.pointwise.side = prevailing_side(task, start);
  const WholeRegionResult whole = solve_whole_region(task, start, solver, options);
  const Result outline = solver.minimize(pointwise_problem(task, options.pointwise),
                                         pointwise_start(task, start, options.pointwise), options.solver);
  BOOST_TEST(whole.closed);
  BOOST_TEST(whole.rounds == 1);
  BOOST_TEST(whole.constraints.empty());
  BOOST_TEST((whole.design - outline.x.head(5)).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(a_stopped_exchange_gives_its_best_design) {
  const SynthesisTask task = table_task();
  WholeRegionOptions options;
  options.pointwise = {30, SingularitySide::positive};
  long asked = 0;
  options.solver.stop = [&asked] { return ++asked > 40; };
  const WholeRegionResult found = solve_whole_region(task, start_of(task), sequential_programming(), options);
  BOOST_TEST((found.solved.status == Status::stopped));
  BOOST_TEST(!found.closed);
  BOOST_TEST(found.design.allFinite());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
