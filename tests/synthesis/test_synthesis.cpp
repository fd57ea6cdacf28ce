#include <Eigen/Geometry>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/synthesis/area_formulation.hpp"
#include "reprise/synthesis/assessment.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/synthesis/synthesis_task.hpp"
#include "sample_count.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

constexpr double five_degrees = pi / 36.0;

/// A design that reaches P2, not far from that of Table 5.3.
Eigen::VectorXd reaching_design() { return to_vector({-1.12, 0.29, 1.27, 1.95, 0.92}); }

/// -5, 0 and 5 degrees, and all orientations from -5 to 5 degrees.
std::vector<OrientationRange> three_slices() { return slices({-five_degrees, 0.0, five_degrees}); }
std::vector<OrientationRange> one_range() { return {{-five_degrees, five_degrees}}; }

/// A task with joint-angle limits of both widths, a triangular platform and a design that moves lengths too.
SynthesisTask general_task(std::vector<OrientationRange> orientations) {
  return {{"W", Rectangle{0.3, 0.2}, {{0.4, 1.5}, 1.0, 0.2}},
          std::move(orientations),
          samples::general_space(),
          {Normalisation::homogeneous, {}}};
}

/// The whole problem, prescribed workspace and design, moved by (x, 0).
SynthesisTask moved(double x) {
  SynthesisTask task = samples::thesis_task();
  task.prescribed = PrescribedWorkspace("P2", Ellipse{{1.75, 1.0}}, {{1.0 + x, 1.5}, 0.2, 0.0});
  return task;
}

BOOST_AUTO_TEST_SUITE(synthesis)

// Table 5.3 prints 0.768 for P2, with the outline that was reconstructed from it.
BOOST_AUTO_TEST_CASE(starting_design_has_the_published_conditioning) {
  const AreaEvaluation evaluation = AreaFormulation(samples::thesis_task()).evaluate(samples::thesis_start());
  BOOST_TEST(std::abs(evaluation.kappa_inverse - 0.7680) < 5e-4);
  BOOST_TEST(evaluation.constraint > 0.0);
  BOOST_TEST(evaluation.areas.size() == 1U);
}

BOOST_AUTO_TEST_CASE(both_formulations_and_the_assessment_see_the_same_design) {
  for (const auto& orientations : {three_slices(), one_range()}) {
    const SynthesisTask task = samples::thesis_task(orientations);
    const Assessment dense = assess(task, samples::thesis_start(), 2000);
    const AreaEvaluation area = AreaFormulation(task).evaluate(samples::thesis_start());
    BOOST_TEST(area.kappa_inverse == dense.kappa_inverse, tolerance(1e-4));
    BOOST_TEST(area.kappa_inverse >= dense.kappa_inverse - 1e-6);  // fewer points, so hardly lower
    const Eigen::VectorXd start = pointwise_start(task, samples::thesis_start(), {2000});
    BOOST_TEST(start[5] == dense.kappa_inverse, tolerance(1e-13));

    const Problem pointwise = pointwise_problem(task, {2000});
    Eigen::VectorXd g(pointwise.inequalities);
    pointwise.inequality(start, g);
    BOOST_TEST(g.maxCoeff() == dense.violation, tolerance(1e-13));
    BOOST_TEST(pointwise.objective(start) == -dense.kappa_inverse, tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(constraint_is_an_area_outside_and_a_clearance_inside) {
  const AreaFormulation formulation(samples::thesis_task());
  const AreaEvaluation inside = formulation.evaluate(reaching_design());
  BOOST_REQUIRE(assess(formulation.task(), reaching_design()).violation == 0.0);
  BOOST_TEST(inside.areas[0].prescribed_outside == 0.0);
  BOOST_TEST(inside.constraint == -inside.areas[0].clearance * inside.areas[0].clearance, tolerance(1e-14));
  const AreaEvaluation outside = formulation.evaluate(samples::thesis_start());
  BOOST_TEST(outside.constraint == outside.areas[0].prescribed_outside);
  BOOST_TEST(outside.areas[0].clearance < 0.0);
}

BOOST_AUTO_TEST_CASE(a_centre_out_of_reach_has_the_whole_area_outside) {
  Eigen::VectorXd far = samples::thesis_start();
  far[1] = -10.0;
  const AreaEvaluation evaluation = AreaFormulation(samples::thesis_task()).evaluate(far);
  BOOST_TEST((evaluation.trace_status == TraceStatus::closed));
  BOOST_TEST(evaluation.constraint == pi * 0.35 * 0.2, tolerance(1e-3));
  BOOST_TEST(evaluation.kappa_inverse > 0.0);
}

BOOST_AUTO_TEST_CASE(slices_add_up) {
  const auto evaluate = [](const std::vector<double>& orientations) {
    return AreaFormulation(samples::thesis_task(slices(orientations))).evaluate(samples::thesis_start());
  };
  const AreaEvaluation minus = evaluate({-five_degrees});
  const AreaEvaluation plus = evaluate({five_degrees});
  const AreaEvaluation both = evaluate({-five_degrees, five_degrees});
  BOOST_TEST(both.constraint == minus.constraint + plus.constraint, tolerance(1e-14));
  BOOST_TEST(both.kappa_inverse == std::min(minus.kappa_inverse, plus.kappa_inverse));
  BOOST_TEST(both.boundary_points == minus.boundary_points + plus.boundary_points);
}

BOOST_AUTO_TEST_CASE(moving_everything_changes_nothing) {
  Eigen::VectorXd design = samples::thesis_start();
  const AreaEvaluation here = AreaFormulation(samples::thesis_task()).evaluate(design);
  const double x = 0.7;
  for (const Eigen::Index i : {0, 2, 3}) design[i] += x;
  const AreaEvaluation there = AreaFormulation(moved(x)).evaluate(design);
  BOOST_TEST(there.kappa_inverse == here.kappa_inverse, tolerance(1e-10));
  BOOST_TEST(there.constraint == here.constraint, tolerance(1e-9));
}

// The thesis differentiates with an interval of 1e-6: what the chord method computes must be smooth down to there, as
// long as the number of chords stays. Where a traced point passes a direction of the outline's own there is a kink, but
// seldom as near as that.
BOOST_AUTO_TEST_CASE(area_formulation_is_smooth_enough_to_be_differentiated) {
  const AreaFormulation formulation(samples::thesis_task());
  constexpr int trials = test::scaled(10);
  int smooth = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Eigen::VectorXd d =
        samples::thesis_start() + 0.01 * Eigen::VectorXd::LinSpaced(5, trial, trial - 3.3).array().sin().matrix();
    for (Eigen::Index i = 0; i < 5; ++i) {
      const auto slope = [&](double step) {
        const Eigen::VectorXd along = step * Eigen::VectorXd::Unit(5, i);
        return (formulation.evaluate(d + along).constraint - formulation.evaluate(d - along).constraint) / (2.0 * step);
      };
      if (std::abs(slope(1e-6) - slope(1e-5)) < 1e-5) ++smooth;
    }
  }
  BOOST_TEST(smooth >= 4 * trials);
}

BOOST_AUTO_TEST_CASE(pointwise_derivatives_are_exact) {
  const auto check = [](const SynthesisTask& task, const Eigen::VectorXd& design) {
    const PointwiseOptions options{12};
    const Eigen::VectorXd x = pointwise_start(task, design, options);
    for (const DerivativeCheck& one : check_derivatives(pointwise_problem(task, options), x).checks) {
      BOOST_TEST(one.passed, one.function << ": " << one.coordinate_error << ", " << one.direction_error << ", order "
                                          << one.remainder_order);
    }
  };
  check(samples::thesis_task(three_slices()), samples::thesis_start());
  check(samples::thesis_task(one_range()), samples::thesis_start());
  // A range so wide that it sweeps legs: the limits are taken at its ends and between.
  const Eigen::Vector4d design(0.02, -0.03, 0.01, 0.04);
  for (const auto& orientations :
       {slices({0.1, 0.3}), std::vector<OrientationRange>{{-1.3, 2.1}, {0.4, 0.4}, {2.5, 3.5}}}) {
    SynthesisTask general = general_task(orientations);
    check(general, design);
    general.conditioning = {Normalisation::printed, 0.8};
    check(general, design);
  }
}

// A design that is singular in the middle of the workspace: with a side, kappa^-1 has a sign and no kink.
BOOST_AUTO_TEST_CASE(a_side_makes_singular_poses_smooth) {
  SynthesisTask task = general_task({{-0.2, 0.3}});
  const Eigen::Vector4d design(0.02, -0.03, 0.01, 0.04);
  const Manipulator manipulator = task.designs.manipulator(design);
  // Where the workspace lies across a singular curve.
  const auto has_both = [&](const Eigen::Vector2d& centre) {
    task.prescribed = PrescribedWorkspace("W", Circle{0.3}, {centre, 1.0, 0.0});
    bool positive = false, negative = false;
    for (const double beta : task.prescribed.angles(40)) {
      const int side = singularity_side(manipulator, {task.prescribed.point(beta), -0.2});
      positive = positive || side > 0;
      negative = negative || side < 0;
    }
    return positive && negative;
  };
  bool found = false;
  for (double x = -3.0; x < 3.0 && !found; x += 0.25) found = has_both({x, 1.2});
  BOOST_REQUIRE(found);
  const PointwiseOptions one{13, SingularitySide::positive};
  const PointwiseOptions other{13, SingularitySide::negative};
  const Eigen::VectorXd start = pointwise_start(task, design, one);
  const Eigen::VectorXd start_other = pointwise_start(task, design, other);
  BOOST_TEST(start[4] < 0.0);
  BOOST_TEST(start_other[4] < 0.0);
  BOOST_TEST((prevailing_side(task, design) != SingularitySide::either));
  for (const DerivativeCheck& check : check_derivatives(pointwise_problem(task, one), start).checks) {
    BOOST_TEST(check.passed, check.function);
  }
  // Only the sign differs from kappa^-1 itself.
  const Problem plain = pointwise_problem(task, {13});
  Eigen::VectorXd g(plain.inequalities), signed_g(plain.inequalities), g_other(plain.inequalities);
  Eigen::VectorXd x = start;
  x[4] = 0.0;
  plain.inequality(x, g);
  pointwise_problem(task, one).inequality(x, signed_g);
  pointwise_problem(task, other).inequality(x, g_other);
  const Eigen::Index limits = static_cast<Eigen::Index>(list_limits(manipulator).size());
  for (Eigen::Index row = 0; row < g.size(); ++row) {
    const bool is_kappa = row % (2 + 2 * limits) < 2;
    BOOST_TEST(std::abs(signed_g[row]) == std::abs(g[row]));
    BOOST_TEST(g_other[row] == (is_kappa ? -signed_g[row] : g[row]));
  }
}

BOOST_AUTO_TEST_CASE(rows_of_the_jacobian_are_those_of_the_whole) {
  const SynthesisTask task = samples::thesis_task(slices({-0.1, 0.0}));
  const Problem problem = pointwise_problem(task, {.points = 10});
  const Eigen::VectorXd start = pointwise_start(task, samples::thesis_start(), {.points = 10});
  SparseMatrix whole(problem.inequalities, problem.n);
  problem.inequality_jacobian(start, whole);
  const std::vector<Eigen::Index> rows{0, 1, 7, 30, problem.inequalities - 1};
  SparseMatrix some(static_cast<Eigen::Index>(rows.size()), problem.n);
  problem.inequality_jacobian_rows(start, rows, some);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    BOOST_TEST(some.row(row).nonZeros() == whole.row(rows[i]).nonZeros());
    BOOST_TEST((some.row(row).toDense() - whole.row(rows[i]).toDense()).isZero(0.0));
  }
}

BOOST_AUTO_TEST_CASE(rows_of_the_jacobian_alone_change_no_run) {
  const SynthesisTask task = samples::thesis_task();
  Problem problem = pointwise_problem(task, {.points = 100});
  const Eigen::VectorXd start = pointwise_start(task, samples::thesis_start(), {.points = 100});
  const ConstraintExchange solver(std::make_shared<DynamicQ>());
  const Result with_rows = solver.minimize(problem, start);
  problem.inequality_jacobian_rows = nullptr;
  const Result without = solver.minimize(problem, start);
  BOOST_TEST((with_rows.x - without.x).isZero(0.0));
  BOOST_TEST(with_rows.kkt_residual == without.kkt_residual);
  BOOST_TEST(with_rows.counts.inequality == without.counts.inequality);
  BOOST_TEST(with_rows.counts.inequality_jacobian == without.counts.inequality_jacobian);
  BOOST_TEST((with_rows.status == without.status));
}

BOOST_AUTO_TEST_CASE(jacobian_holds_only_what_can_differ_from_zero) {
  const Problem problem = pointwise_problem(samples::thesis_task(), {10});
  SparseMatrix jacobian(problem.inequalities, problem.n);
  const Eigen::VectorXd start = pointwise_start(samples::thesis_task(), samples::thesis_start(), {10});
  problem.inequality_jacobian(start, jacobian);
  // Each point: kappa^-1 with all six variables, and two limits of each of three legs with three design variables each.
  BOOST_TEST(problem.inequalities == 70);
  BOOST_TEST(jacobian.nonZeros() == 10 * (6 + 6 * 3));
  // Over a range it is kappa^-1 at both ends, and each limit over both halves.
  BOOST_TEST(pointwise_problem(samples::thesis_task(one_range()), {10}).inequalities == 10 * (2 + 2 * 6));
}

// Directly for one orientation, with constraint exchange for a range of them.
BOOST_AUTO_TEST_CASE(optimizers_agree_on_the_pointwise_formulation) {
  const PointwiseOptions points{200};
  DynamicQOptions dynamic_q;
  dynamic_q.move_limit = 0.1;
  dynamic_q.step_tolerance = 1e-6;
  std::vector<std::shared_ptr<const Solver>> solvers = {
      std::make_shared<DynamicQ>(dynamic_q), std::make_shared<NloptSolver>(), std::make_shared<IpoptSolver>()};
  const auto check = [&](const SynthesisTask& task, const Eigen::VectorXd& design) {
    const Problem problem = pointwise_problem(task, points);
    const Eigen::VectorXd start = pointwise_start(task, design, points);
    std::vector<double> best;
    for (auto solver : solvers) {
      if (task.orientations.front().lower < 0.0) solver = std::make_shared<ConstraintExchange>(solver);
      const Result result = solver->minimize(problem, start);
      BOOST_TEST((result.status == Status::converged), solver->name() << ": " << result.message);
      BOOST_TEST(result.violation <= 1e-6, solver->name());
      best.push_back(-result.f);
    }
    BOOST_TEST(best[1] == best[0], tolerance(1e-5));
    BOOST_TEST(best[2] == best[0], tolerance(1e-5));
  };
  check(samples::thesis_task(), samples::thesis_start());
  // P2 in the size of Table 5.5, from its start.
  SynthesisTask dextrous = samples::thesis_task(one_range());
  dextrous.prescribed = PrescribedWorkspace("P2", Ellipse{{1.75, 1.0}}, {{1.0, 1.5}, 0.16, 0.0});
  check(dextrous, to_vector({-0.75, 0.0, 0.75, 1.5, 0.75}));
}

// The area formulation has the same solution, but neither of its functions is smooth: Dynamic-Q ends near it, and never
// beyond it by more than its tolerance of the area allows.
BOOST_AUTO_TEST_CASE(dynamic_q_comes_near_the_optimum_by_the_area_formulation) {
  const AreaFormulation formulation(samples::thesis_task());
  const PointwiseOptions points{400};
  const Result reference = NloptSolver().minimize(pointwise_problem(formulation.task(), points),
                                                  pointwise_start(formulation.task(), samples::thesis_start(), points));
  DynamicQOptions options;
  options.move_limit = 0.1;
  options.step_tolerance = 1e-4;
  options.value_tolerance = 1e-6;
  Options run;
  run.derivatives = Derivatives::forward;
  run.difference_step = 1e-6;
  run.feasibility_tolerance = 1e-5;
  const Result result = DynamicQ(options).minimize(formulation.problem(), samples::thesis_start(), run);
  const Assessment dense = assess(formulation.task(), result.x);
  BOOST_TEST(dense.kappa_inverse > -reference.f - 0.02);
  BOOST_TEST(dense.kappa_inverse < -reference.f + 0.002);
  BOOST_TEST(dense.violation < 0.002);
}

// A range that shrinks to one orientation becomes a slice, and both functions move no faster than the range.
BOOST_AUTO_TEST_CASE(a_range_shrinks_to_a_slice) {
  const double phi = 0.03;
  const auto evaluate = [](std::vector<OrientationRange> orientations) {
    return AreaFormulation(samples::thesis_task(std::move(orientations))).evaluate(samples::thesis_start());
  };
  const AreaEvaluation slice = evaluate({{phi, phi}});
  for (const double half : {1e-3, 1e-5, 1e-7}) {
    const AreaEvaluation range = evaluate({{phi - half, phi + half}});
    BOOST_TEST(std::abs(range.kappa_inverse - slice.kappa_inverse) <= 2.0 * half);
    BOOST_TEST(std::abs(range.constraint - slice.constraint) <= 2.0 * half);
    const Assessment judged = assess(samples::thesis_task({{phi - half, phi + half}}), samples::thesis_start());
    const Assessment alone = assess(samples::thesis_task({{phi, phi}}), samples::thesis_start());
    BOOST_TEST(judged.violation >= alone.violation);
    BOOST_TEST(judged.violation <= alone.violation + 2.0 * half);
  }
}

// The definition: the limits at many orientations of the range, one by one.
BOOST_AUTO_TEST_CASE(violation_over_a_range_is_the_largest_at_its_orientations) {
  const auto check = [](SynthesisTask task, const OrientationRange& range, const Eigen::VectorXd& design) {
    constexpr int steps = 200;
    constexpr int points = test::scaled(300);
    task.orientations = {range};
    const Assessment judged = assess(task, design, points);
    task.orientations = slices(range.spread(steps + 1));
    const double sampled = assess(task, design, points).violation;
    BOOST_TEST(judged.violation >= sampled - 1e-13);
    BOOST_TEST(judged.violation <= sampled + 3.0 * (range.upper - range.lower) / steps);
    task.orientations = slices({judged.violation_orientation});
    BOOST_TEST(assess(task, design, points).violation == judged.violation, tolerance(1e-9));
  };
  check(samples::thesis_task(), {-five_degrees, five_degrees}, samples::thesis_start());
  check(general_task({}), {-1.3, 2.1}, Eigen::Vector4d(0.02, -0.03, 0.01, 0.04));
}

BOOST_AUTO_TEST_CASE(conditioning_throughout_a_range_is_that_of_its_orientations) {
  const OrientationRange range{-0.4, 0.3};
  const std::vector<double> orientations = range.spread(11);
  BOOST_TEST(orientations.size() == 11U);
  BOOST_TEST(orientations.front() == range.lower);
  BOOST_TEST(orientations[5] == -0.05, tolerance(1e-14));
  BOOST_TEST(orientations.back() == range.upper);
  const Assessment over_range = assess(samples::thesis_task({range}), samples::thesis_start(), 200, 11);
  const Assessment at_each = assess(samples::thesis_task(slices(orientations)), samples::thesis_start(), 200);
  BOOST_TEST(over_range.kappa_inverse_throughout == at_each.kappa_inverse, tolerance(1e-12));
  BOOST_TEST(at_each.kappa_inverse_throughout == at_each.kappa_inverse);
  const Assessment at_ends =
      assess(samples::thesis_task(slices({range.lower, range.upper})), samples::thesis_start(), 200);
  BOOST_TEST(over_range.kappa_inverse == at_ends.kappa_inverse);
}

// What reaches W_p at every orientation of a range reaches it at each of its slices; the chapter's claim f_D <= f_MO
// rests on that, but the ends of the range are fewer orientations for the conditioning than the slices.
BOOST_AUTO_TEST_CASE(a_range_asks_for_more_reach_than_its_slices) {
  for (const double y : {-0.2, 0.0, 0.2, 0.4}) {
    Eigen::VectorXd design = reaching_design();
    design[1] += y;
    const Assessment range = assess(samples::thesis_task(one_range()), design);
    const Assessment each = assess(samples::thesis_task(three_slices()), design);
    BOOST_TEST(range.violation >= each.violation);
    BOOST_TEST(range.kappa_inverse >= each.kappa_inverse);
    const AreaEvaluation over_range = AreaFormulation(samples::thesis_task(one_range())).evaluate(design);
    const AreaEvaluation at_each = AreaFormulation(samples::thesis_task(three_slices())).evaluate(design);
    // By chords of 0.02 an outline of curvature below 1 is cut off by less than 5e-5.
    for (const AreaMeasure& slice : at_each.areas) {
      BOOST_TEST(over_range.areas[0].prescribed_outside >= slice.prescribed_outside - 1e-4);
      BOOST_TEST(over_range.areas[0].clearance <= slice.clearance + 1e-4);
    }
  }
}

// Turning base, prescribed workspace and orientations by the same angle, and moving the first two, changes nothing but
// where the samples of the outline and the chords begin.
BOOST_AUTO_TEST_CASE(turning_everything_changes_nothing) {
  const double turn = 0.4;
  const Eigen::Rotation2Dd rotation(turn);
  const Eigen::Vector2d shift(0.3, -0.7);
  const auto moved_point = [&](const Eigen::Vector2d& point) { return Eigen::Vector2d(rotation * point + shift); };

  const SynthesisTask here = samples::thesis_task({{-0.05, 0.2}});
  // Base joints are linear in the design, so they turn with their map, and the shift is the design 0's.
  const DesignSpace& space = here.designs;
  std::vector<Leg> legs = space.manipulator(Eigen::VectorXd::Zero(5)).legs();
  Eigen::MatrixXd joint_map = space.joint_map();
  for (std::size_t i = 0; i < legs.size(); ++i) {
    legs[i].base_joint = moved_point(legs[i].base_joint);
    const auto row = 4 * static_cast<Eigen::Index>(i);
    joint_map.middleRows<2>(row) = rotation.toRotationMatrix() * space.joint_map().middleRows<2>(row);
  }
  const SynthesisTask there{{"P2", Ellipse{{1.75, 1.0}}, {moved_point({1.0, 1.5}), 0.2, turn}},
                            {{-0.05 + turn, 0.2 + turn}},
                            {Manipulator("moved", legs), space.names(), joint_map, space.length_map()},
                            here.conditioning};

  const Eigen::VectorXd design = samples::thesis_start();
  const Assessment a = assess(here, design, 20'000);
  const Assessment b = assess(there, design, 20'000);
  BOOST_TEST(a.violation > 0.0);
  BOOST_TEST(b.violation == a.violation, tolerance(1e-6));
  BOOST_TEST((moved_point(a.violation_at) - b.violation_at).norm() < 1e-3);
  BOOST_TEST(b.violation_orientation - turn == a.violation_orientation, tolerance(1e-6));
  BOOST_TEST(b.kappa_inverse == a.kappa_inverse, tolerance(1e-6));
  BOOST_TEST(b.kappa_inverse_throughout == a.kappa_inverse_throughout, tolerance(1e-6));
  const AreaEvaluation area_here = AreaFormulation(here).evaluate(design);
  const AreaEvaluation area_there = AreaFormulation(there).evaluate(design);
  BOOST_TEST(area_there.constraint == area_here.constraint, tolerance(1e-2));
  BOOST_TEST(area_there.kappa_inverse == area_here.kappa_inverse, tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  SynthesisTask task = samples::thesis_task({});
  BOOST_CHECK_THROW(AreaFormulation{task}, std::invalid_argument);
  BOOST_CHECK_THROW(pointwise_problem(task), std::invalid_argument);
  BOOST_CHECK_THROW(assess(task, samples::thesis_start()), std::invalid_argument);
  for (const Interval& range :
       {Interval{std::nan(""), 0.0}, Interval{0.0, std::nan("")}, Interval{0.1, -0.1}, Interval{0.0, 2.0 * pi}}) {
    task.orientations = {{0.0, 0.0}, range};
    BOOST_CHECK_THROW(AreaFormulation{task}, std::invalid_argument);
    BOOST_CHECK_THROW(pointwise_problem(task), std::invalid_argument);
    BOOST_CHECK_THROW(assess(task, samples::thesis_start()), std::invalid_argument);
  }
  BOOST_CHECK_THROW((AreaFormulation{samples::thesis_task(), {.chord_length = 0.0}}), std::invalid_argument);
  BOOST_CHECK_THROW((AreaFormulation{samples::thesis_task(), {.outline_points = 0}}), std::invalid_argument);
  BOOST_CHECK_THROW(pointwise_problem(samples::thesis_task(), {0}), std::invalid_argument);
  BOOST_CHECK_THROW(assess(samples::thesis_task(), samples::thesis_start(), 0), std::invalid_argument);
  BOOST_CHECK_THROW(assess(samples::thesis_task(), samples::thesis_start(), 10, 1), std::invalid_argument);
  BOOST_CHECK_THROW(AreaFormulation{samples::thesis_task()}.evaluate(Eigen::VectorXd::Zero(4)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
