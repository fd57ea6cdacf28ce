#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/synthesis/synthesis.hpp"
#include "samples.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

constexpr double pi = std::numbers::pi;
constexpr double five_degrees = pi / 36.0;

/// A design that reaches P2, not far from that of Table 5.3.
Eigen::VectorXd reaching_design() { return to_vector({-1.12, 0.29, 1.27, 1.95, 0.92}); }

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
  BOOST_TEST(evaluation.slices.size() == 1U);
}

BOOST_AUTO_TEST_CASE(both_formulations_and_the_assessment_see_the_same_design) {
  const SynthesisTask task = samples::thesis_task({-five_degrees, 0.0, five_degrees});
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

BOOST_AUTO_TEST_CASE(constraint_is_an_area_outside_and_a_clearance_inside) {
  const AreaFormulation formulation(samples::thesis_task());
  const AreaEvaluation inside = formulation.evaluate(reaching_design());
  BOOST_REQUIRE(assess(formulation.task(), reaching_design()).violation == 0.0);
  BOOST_TEST(inside.slices[0].prescribed_outside == 0.0);
  BOOST_TEST(inside.constraint == -inside.slices[0].clearance * inside.slices[0].clearance, tolerance(1e-14));
  const AreaEvaluation outside = formulation.evaluate(samples::thesis_start());
  BOOST_TEST(outside.constraint == outside.slices[0].prescribed_outside);
  BOOST_TEST(outside.slices[0].clearance < 0.0);
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
  const auto evaluate = [](std::vector<double> orientations) {
    return AreaFormulation(samples::thesis_task(std::move(orientations))).evaluate(samples::thesis_start());
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
  int smooth = 0;
  for (int trial = 0; trial < 10; ++trial) {
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
  BOOST_TEST(smooth >= 40);
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
  check(samples::thesis_task({-five_degrees, 0.0, five_degrees}), samples::thesis_start());
  SynthesisTask general{{"W", Rectangle{0.3, 0.2}, {{0.4, 1.5}, 1.0, 0.2}},
                        {0.1, 0.3},
                        samples::general_space(),
                        {Normalisation::homogeneous, {}}};
  check(general, Eigen::Vector4d(0.02, -0.03, 0.01, 0.04));
  general.conditioning = {Normalisation::printed, 0.8};
  check(general, Eigen::Vector4d(0.02, -0.03, 0.01, 0.04));
}

BOOST_AUTO_TEST_CASE(jacobian_holds_only_what_can_differ_from_zero) {
  const Problem problem = pointwise_problem(samples::thesis_task(), {10});
  SparseMatrix jacobian(problem.inequalities, problem.n);
  const Eigen::VectorXd start = pointwise_start(samples::thesis_task(), samples::thesis_start(), {10});
  problem.inequality_jacobian(start, jacobian);
  // Each point: kappa^-1 with all six variables, and two limits of each of three legs with three design variables each.
  BOOST_TEST(problem.inequalities == 70);
  BOOST_TEST(jacobian.nonZeros() == 10 * (6 + 6 * 3));
}

BOOST_AUTO_TEST_CASE(optimizers_agree_on_the_pointwise_formulation) {
  const SynthesisTask task = samples::thesis_task();
  const PointwiseOptions points{200};
  const Problem problem = pointwise_problem(task, points);
  const Eigen::VectorXd start = pointwise_start(task, samples::thesis_start(), points);
  DynamicQOptions dynamic_q;
  dynamic_q.move_limit = 0.1;
  dynamic_q.step_tolerance = 1e-6;
  std::vector<std::unique_ptr<Solver>> solvers;
  solvers.push_back(std::make_unique<DynamicQ>(dynamic_q));
  solvers.push_back(std::make_unique<NloptSolver>());
  solvers.push_back(std::make_unique<IpoptSolver>());
  std::vector<double> best;
  for (const auto& solver : solvers) {
    const Result result = solver->minimize(problem, start);
    BOOST_TEST((result.status == Status::converged), solver->name() << ": " << result.message);
    BOOST_TEST(result.violation <= 1e-6, solver->name());
    best.push_back(-result.f);
  }
  BOOST_TEST(best[1] == best[0], tolerance(1e-5));
  BOOST_TEST(best[2] == best[0], tolerance(1e-5));
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

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  SynthesisTask task = samples::thesis_task({});
  BOOST_CHECK_THROW(AreaFormulation{task}, std::invalid_argument);
  BOOST_CHECK_THROW(pointwise_problem(task), std::invalid_argument);
  BOOST_CHECK_THROW(assess(task, samples::thesis_start()), std::invalid_argument);
  task.orientations = {std::nan("")};
  BOOST_CHECK_THROW(AreaFormulation{task}, std::invalid_argument);
  BOOST_CHECK_THROW((AreaFormulation{samples::thesis_task(), {.chord_length = 0.0}}), std::invalid_argument);
  BOOST_CHECK_THROW((AreaFormulation{samples::thesis_task(), {.outline_points = 0}}), std::invalid_argument);
  BOOST_CHECK_THROW(pointwise_problem(samples::thesis_task(), {0}), std::invalid_argument);
  BOOST_CHECK_THROW(assess(samples::thesis_task(), samples::thesis_start(), 0), std::invalid_argument);
  BOOST_CHECK_THROW(AreaFormulation{samples::thesis_task()}.evaluate(Eigen::VectorXd::Zero(4)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
