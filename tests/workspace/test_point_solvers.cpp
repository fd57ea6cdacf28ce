#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "optimizers.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/workspace/point_solver.hpp"
#include "reprise/workspace/trace.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

/// How far an optimizer's point may be from the exact one.
constexpr double accuracy = 1e-8;

}  // namespace

BOOST_AUTO_TEST_CASE(a_ray_ends_at_the_first_exit) {
  // An annulus from the hole of another: the ray from the left leaves at x = 0.5, and enters again at x = 1.5.
  const ConstantOrientationLimits limits({"ring", {leg_at({0.0, 0.0}, {0.0, 2.0}), leg_at({1.0, 0.0}, {0.5, 4.0})}},
                                         0.0);
  LimitEvaluator evaluator(limits);
  const SolvedPoint point = BracketingPointSolver().solve_ray(evaluator, {{0.0, 0.0}, {1.0, 0.0}, 10.0, 0.02}, 1e-14);
  BOOST_TEST((point.outcome == SolvedPoint::Outcome::found));
  BOOST_TEST((point.position - Eigen::Vector2d(0.5, 0.0)).norm() <= 1e-13);
}

BOOST_AUTO_TEST_CASE(a_ray_sees_gaps_wider_than_a_thousandth_of_a_chord) {
  // Two discs whose boundaries, in the directions of the ray, leave a gap between 1 - g and 1 + g.
  for (const double half_gap : {1e-2, 1e-3, 2e-5}) {
    const ConstantOrientationLimits limits(
        {"gap", {leg_at({0.0, 0.0}, {0.0, 3.0}), leg_at({1.0, 0.0}, {half_gap, 9.0})}}, 0.0);
    LimitEvaluator evaluator(limits);
    const SolvedPoint point = BracketingPointSolver().solve_ray(evaluator, {{0.0, 0.0}, {1.0, 0.0}, 10.0, 0.02}, 1e-14);
    BOOST_TEST((point.outcome == SolvedPoint::Outcome::found));
    BOOST_TEST((point.position - Eigen::Vector2d(1.0 - half_gap, 0.0)).norm() <= 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(a_chord_ends_at_the_feasible_direction_nearest_to_psi) {
  // From (1, 0) on the unit circle the workspace is to the left of the way up; the chord's direction is
  // pi/2 + asin(d/2).
  const ConstantOrientationLimits limits({"disc", {leg_at({0.0, 0.0}, {0.0, 1.0})}}, 0.0);
  for (const double d : {0.5, 0.02}) {
    const double exact = 0.5 * pi + std::asin(0.5 * d);
    const Eigen::Vector2d expected = Eigen::Vector2d(1.0, 0.0) + d * unit(exact);
    // The prediction may be good, bad or absurd, and psi inside.
    for (const double predicted : {exact, exact + 0.1, exact - 0.1, exact + 1.5, exact - 2.0}) {
      for (const double psi : {0.25 * pi, -0.25 * pi, 0.75 * pi}) {
        LimitEvaluator evaluator(limits);
        const SolvedPoint point =
            BracketingPointSolver().solve_chord(evaluator, {{1.0, 0.0}, d, psi, predicted}, 1e-14);
        BOOST_TEST((point.outcome == SolvedPoint::Outcome::found));
        BOOST_TEST((point.position - expected).norm() <= 1e-12);
      }
      for (const auto& optimizer : optimizers()) {
        LimitEvaluator evaluator(limits);
        const OptimizerPointSolver solver(*optimizer);
        const SolvedPoint point = solver.solve_chord(evaluator, {{1.0, 0.0}, d, 0.25 * pi, predicted}, 1e-14);
        BOOST_TEST((point.outcome == SolvedPoint::Outcome::found), optimizer->name() << ": " << point.message);
        BOOST_TEST((point.position - expected).norm() <= accuracy, optimizer->name());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(no_direction_is_feasible_when_the_chord_is_too_long) {
  const ConstantOrientationLimits limits({"disc", {leg_at({0.0, 0.0}, {0.0, 1.0})}}, 0.0);
  LimitEvaluator evaluator(limits);
  const SolvedPoint point =
      BracketingPointSolver().solve_chord(evaluator, {{1.0, 0.0}, 2.5, 0.25 * pi, 0.5 * pi}, 1e-14);
  BOOST_TEST((point.outcome == SolvedPoint::Outcome::no_feasible_direction));
}

BOOST_AUTO_TEST_CASE(a_bifurcation_point_meets_both_limits) {
  // The circles of radius 1 about (0, 0) and (1, 0) meet at (1/2, +-sqrt(3)/2).
  const ConstantOrientationLimits limits({"lens", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({1.0, 0.0}, {0.0, 1.0})}},
                                         0.0);
  const Eigen::Vector2d exact(0.5, 0.5 * std::numbers::sqrt3);
  const BifurcationProblem problem{0, 1, exact + Eigen::Vector2d(0.01, 0.007), 0.02};
  LimitEvaluator evaluator(limits);
  const SolvedPoint point = BracketingPointSolver().solve_bifurcation(evaluator, problem, 1e-14);
  BOOST_TEST((point.outcome == SolvedPoint::Outcome::found));
  BOOST_TEST((point.position - exact).norm() <= 1e-13);
  for (const auto& optimizer : optimizers()) {
    const SolvedPoint other = OptimizerPointSolver(*optimizer).solve_bifurcation(evaluator, problem, 1e-14);
    BOOST_TEST((other.outcome == SolvedPoint::Outcome::found), optimizer->name() << ": " << other.message);
    BOOST_TEST((other.position - exact).norm() <= accuracy, optimizer->name());
  }
}

BOOST_AUTO_TEST_CASE(parallel_limits_have_no_bifurcation_point) {
  const ConstantOrientationLimits limits({"annulus", {leg_at({0.0, 0.0}, {0.5, 1.0})}}, 0.0);
  LimitEvaluator evaluator(limits);
  const SolvedPoint point = BracketingPointSolver().solve_bifurcation(evaluator, {0, 1, {0.7, 0.1}, 0.02}, 1e-14);
  BOOST_TEST((point.outcome == SolvedPoint::Outcome::failed));
  BOOST_TEST(!point.message.empty());
}

BOOST_AUTO_TEST_CASE(every_optimizer_traces_the_boundary_that_bracketing_traces) {
  for (const double orientation : {0.0, 0.1}) {
    const ConstantOrientationLimits limits(m1(), orientation);
    const TraceOptions options{.chord = 0.1};
    const TracedBoundary expected = trace_boundary(limits, {1.0, 1.5}, options);
    BOOST_TEST_REQUIRE(expected.closed());
    for (const auto& optimizer : optimizers()) {
      BOOST_TEST_CONTEXT(optimizer->name() << " at " << orientation) {
        const TracedBoundary boundary = trace_boundary(limits, {1.0, 1.5}, options, OptimizerPointSolver(*optimizer));
        BOOST_TEST_REQUIRE(boundary.closed(), boundary.message);
        BOOST_TEST(boundary.unresolved_bifurcations == 0u);
        BOOST_TEST_REQUIRE(boundary.points.size() == expected.points.size());
        double largest = 0.0;
        for (std::size_t i = 0; i < boundary.points.size(); ++i) {
          BOOST_TEST(boundary.points[i].is_bifurcation() == expected.points[i].is_bifurcation());
          largest = std::max(largest, (boundary.points[i].position - expected.points[i].position).norm());
        }
        // Errors along the boundary add up from point to point.
        BOOST_TEST(largest <= accuracy * static_cast<double>(boundary.points.size()));
        BOOST_TEST_MESSAGE(optimizer->name()
                           << ": largest difference " << largest << ", " << boundary.evaluations << " evaluations");
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(an_optimizer_that_fails_gives_a_status) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const NloptSolver solver;
  Options options = OptimizerPointSolver::default_options();
  options.max_function_evaluations = 1;
  const TracedBoundary boundary = trace_boundary(limits, {1.0, 1.5}, {}, OptimizerPointSolver(solver, options));
  BOOST_TEST((boundary.status == TraceStatus::point_solver_failed));
  BOOST_TEST(boundary.message.find(solver.name()) != std::string::npos);
  options.max_function_evaluations = 0;
  BOOST_CHECK_THROW(trace_boundary(limits, {1.0, 1.5}, {}, OptimizerPointSolver(solver, options)),
                    std::invalid_argument);
}
