#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/synthesis/assessment.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/synthesis/semi_infinite.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

constexpr double five_degrees = pi / 36.0;

Eigen::VectorXd some_design() { return to_vector({-1.12, 0.29, 1.27, 1.95, 0.92}); }

/// Accurate to the tolerance of the exchange, and not led away from its start by the barrier.
IpoptSolver accurate_ipopt() {
  IpoptOptions options;
  options.tolerance = 1e-11;
  options.acceptable_tolerance = 1e-9;
  options.initial_barrier = 1e-8;
  options.initial_push = 1e-8;
  return IpoptSolver(options);
}

/// A leg whose base joint lies on the x-axis, at d, and which may not be longer than 3: it reaches the workspace where
/// d is at least the workspace's farthest x less 3, for workspaces symmetric about the axis.
SynthesisTask one_variable_task(Shape shape) {
  const std::vector<Leg> legs{Leg{{0.0, 0.0}, {0.0, 0.0}, {0.0, 3.0}, {}, {}},
                              Leg{{0.0, 0.0}, {0.0, 0.0}, {0.0, 50.0}, {}, {}}};
  Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(8, 1);
  joints(0, 0) = 1.0;
  // The second leg stands still, far above.
  std::vector<Leg> placed = legs;
  placed[1].base_joint = {0.0, 20.0};
  return {{"W", std::move(shape)},
          slices({0.0}),
          {Manipulator("two legs", placed), {"x"}, joints, Eigen::MatrixXd::Zero(4, 1)},
          {}};
}

BOOST_AUTO_TEST_SUITE(semi_infinite)

BOOST_AUTO_TEST_CASE(families_are_those_of_the_pointwise_problem) {
  const std::vector<OrientationRange> ranges{{0.1, 0.1}, {-five_degrees, five_degrees}};
  const SynthesisTask task = samples::thesis_task(ranges);
  const std::vector<ConstraintFamily> families = list_families(task);
  BOOST_TEST(families.size() == (1U + 6U) + (2U + 2U * 6U));
  BOOST_TEST(to_string(families[8]) == "kappa^-1 at 5 deg");
  BOOST_TEST(to_string(families[10]) == "leg 1, maximum length from -5 to 0 deg");
  // The same constraints in another order.
  const int points = 9;
  std::vector<OutlineConstraint> constraints;
  for (const double beta : task.prescribed.angles(points)) {
    for (std::size_t family = 0; family < families.size(); ++family) constraints.push_back({family, beta});
  }
  const auto sorted_values = [&](const Problem& problem) {
    const Eigen::VectorXd x = pointwise_start(task, some_design(), {points});
    Eigen::VectorXd g(problem.inequalities);
    problem.inequality(x, g);
    std::sort(g.begin(), g.end());
    return g;
  };
  BOOST_TEST((sorted_values(outline_problem(task, constraints)) - sorted_values(pointwise_problem(task, {points})))
                 .isZero(0.0));
}

BOOST_AUTO_TEST_CASE(derivatives_are_exact) {
  const SynthesisTask task{{"W", Rectangle{0.3, 0.2}, {{0.4, 1.5}, 1.0, 0.2}},
                           {{-1.3, 2.1}, {0.4, 0.4}},
                           samples::general_space(),
                           {Normalisation::homogeneous, {}}};
  std::vector<OutlineConstraint> constraints;
  for (std::size_t family = 0; family < list_families(task).size(); ++family) {
    constraints.push_back({family, 0.7 * static_cast<double>(family)});
  }
  Eigen::VectorXd x(5);
  x << 0.02, -0.03, 0.01, 0.04, 0.3;
  for (const DerivativeCheck& one : check_derivatives(outline_problem(task, constraints), x).checks) {
    BOOST_TEST(one.passed, one.function << ": " << one.coordinate_error);
  }
}

// The farthest and the nearest points of an ellipse from a point on its axis beyond it are its two ends; those of a
// circle from any point lie on the line through the centre. For a rectangle they are corners, or on an edge.
BOOST_AUTO_TEST_CASE(peaks_of_a_length_in_closed_form) {
  const auto highest = [](const PrescribedWorkspace& prescribed) {
    SynthesisTask task = one_variable_task(Circle{1.0});
    task.prescribed = prescribed;
    Peak best{{0, 0.0}, -1e300};
    for (const Peak& peak : find_peaks(task, Eigen::VectorXd::Constant(1, -2.0), 0.0, 50)) {
      if (peak.constraint.family == 1 && peak.value > best.value) best = peak;
    }
    return best;
  };
  const Peak circle = highest({"circle", Circle{0.5}, {{0.3, 1.1}, 1.0, 0.0}});
  BOOST_TEST(circle.value == std::hypot(2.3, 1.1) + 0.5 - 3.0, tolerance(1e-14));
  BOOST_TEST(circle.constraint.direction == std::atan2(1.1, 2.3), tolerance(1e-9));
  const Peak ellipse = highest({"ellipse", Ellipse{{0.9, 0.4}}});
  BOOST_TEST(ellipse.value == -0.1, tolerance(1e-13));
  BOOST_TEST(std::abs(std::remainder(ellipse.constraint.direction, 2.0 * pi)) < 1e-9);
  const PrescribedWorkspace box("box", Rectangle{1.0, 0.6}, {{0.0, 0.2}, 1.0, 0.0});
  const Peak corner = highest(box);
  BOOST_TEST(corner.value == std::hypot(2.5, 0.5) - 3.0, tolerance(1e-14));
  BOOST_TEST(corner.constraint.direction == box.corners().front());
}

BOOST_AUTO_TEST_CASE(no_sample_is_above_the_highest_peak) {
  for (const auto& orientations : {slices({-five_degrees, 0.0, five_degrees}), {{-five_degrees, five_degrees}}}) {
    const SynthesisTask task = samples::thesis_task(orientations);
    for (const Eigen::VectorXd& design : {some_design(), samples::thesis_start()}) {
      const OutlineAssessment found = assess_outline(task, design, 60);
      const Assessment dense = assess(task, design, 20'000);
      BOOST_TEST(found.kappa_inverse <= dense.kappa_inverse + 1e-14);
      BOOST_TEST(found.kappa_inverse == dense.kappa_inverse, tolerance(1e-6));
      BOOST_TEST(found.violation >= dense.violation - 1e-14);
      BOOST_TEST(std::abs(found.violation - dense.violation) < 1e-6);
    }
  }
}

/// Two legs that are one: every pose is singular, and kappa^-1 has no peak along the outline.
BOOST_AUTO_TEST_CASE(what_is_the_same_all_along_is_assessed) {
  const SynthesisTask task = samples::thesis_task();
  Eigen::VectorXd design = some_design();
  design[2] = design[0];
  BOOST_TEST(assess_outline(task, design).kappa_inverse == 0.0);
}

// The optimum in closed form: the farther the joint is from the circle, the more nearly right is the angle of the legs.
BOOST_AUTO_TEST_CASE(a_limit_decides_the_design) {
  // kappa^-1 = |sin| of the angle between the legs at u; the joint far to the left makes it large at u = (0, 0), whose
  // second leg points up: within a small circle the smallest value grows with |d|. The reach ends at |d| = 3 - radius.
  const double radius = 0.05;
  const SynthesisTask task = one_variable_task(Circle{radius});
  const SemiInfiniteResult found = solve_by_exchange(task, Eigen::VectorXd::Constant(1, -2.0), accurate_ipopt());
  BOOST_TEST((found.status == Status::converged));
  // Ipopt's barrier keeps off a limit by its tolerance over the multiplier, which is small here.
  BOOST_TEST(std::abs(found.design[0]) == 3.0 - radius, tolerance(1e-7));
  BOOST_TEST(found.violation <= 1e-10);
}

BOOST_AUTO_TEST_CASE(exchange_and_discretised_problem_agree) {
  for (const auto& orientations : {slices({0.0}), {{-five_degrees, five_degrees}}}) {
    SynthesisTask task = samples::thesis_task(orientations);
    if (orientations.front().lower < 0.0) {
      task.prescribed = PrescribedWorkspace("P2", Ellipse{{1.75, 1.0}}, {{1.0, 1.5}, 0.16, 0.0});
    }
    const Eigen::VectorXd start = to_vector({-1.08, 0.27, 1.32, 1.8, 0.88});
    const IpoptSolver solver = accurate_ipopt();
    const SemiInfiniteResult exchange = solve_by_exchange(task, start, solver);
    BOOST_TEST((exchange.status == Status::converged));
    BOOST_TEST(exchange.violation <= 1e-10);
    BOOST_TEST(exchange.counts.lagrangian_hessian > 0);
    const OutlineAssessment outline = assess_outline(task, exchange.design);
    BOOST_TEST(std::abs(outline.kappa_inverse - exchange.t) <= 1.1e-10);
    BOOST_TEST(outline.violation <= 1e-10);
    // Every round is a relaxation that the next one tightens.
    for (std::size_t i = 1; i < exchange.rounds.size(); ++i) {
      BOOST_TEST(exchange.rounds[i].constraints > exchange.rounds[i - 1].constraints);
      BOOST_TEST(exchange.rounds[i].t <= exchange.rounds[i - 1].t + 1e-9);
    }
    // The large problem of a range takes minutes in Debug; reference_optimum solves it.
    if (orientations.front().lower < 0.0) continue;
    const SemiInfiniteResult discretised = solve_discretised(task, start, solver, {.points = 60, .refinement = 60});
    BOOST_TEST((discretised.status == Status::converged));
    BOOST_TEST(discretised.rounds.size() == 3U);
    BOOST_TEST(std::abs(discretised.t - exchange.t) < 1e-7);
    BOOST_TEST((discretised.design - exchange.design).cwiseAbs().maxCoeff() < 1e-5);
    // A sample misses peaks by about the square of its step.
    BOOST_TEST(discretised.rounds[0].violation < 1e-3);
    BOOST_TEST(discretised.rounds[1].violation < 0.1 * discretised.rounds[0].violation);
    BOOST_TEST(discretised.rounds[2].violation < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(a_solver_that_is_not_accurate_ends_at_the_limit_on_rounds) {
  NloptOptions options;
  options.xtol_rel = 1e-2;
  const SemiInfiniteResult result =
      solve_by_exchange(samples::thesis_task(), samples::thesis_start(), NloptSolver(options), {.max_rounds = 2});
  BOOST_TEST(result.rounds.size() == 2U);
  BOOST_TEST((result.status == Status::iteration_limit));
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  const SynthesisTask task = samples::thesis_task();
  const Eigen::VectorXd d = some_design();
  const IpoptSolver solver;
  BOOST_CHECK_THROW(list_families(samples::thesis_task({})), std::invalid_argument);
  BOOST_CHECK_THROW(outline_problem(task, {{7, 0.0}}), std::invalid_argument);
  BOOST_CHECK_THROW(outline_problem(task, {{0, std::nan("")}}), std::invalid_argument);
  BOOST_CHECK_THROW(find_peaks(task, d, 0.0, 7), std::invalid_argument);
  BOOST_CHECK_THROW(find_peaks(task, Eigen::VectorXd::Zero(4), 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(assess_outline(task, d, 0), std::invalid_argument);
  BOOST_CHECK_THROW(solve_by_exchange(task, d, solver, {.first_directions = 0}), std::invalid_argument);
  BOOST_CHECK_THROW(solve_by_exchange(task, d, solver, {.violation_tolerance = 0.0}), std::invalid_argument);
  BOOST_CHECK_THROW(solve_by_exchange(task, d, solver, {.max_rounds = 0}), std::invalid_argument);
  BOOST_CHECK_THROW(solve_discretised(task, d, solver, {.points = 7}), std::invalid_argument);
  BOOST_CHECK_THROW(solve_discretised(task, d, solver, {.refinement = -1}), std::invalid_argument);
  BOOST_CHECK_THROW(solve_discretised(task, d, solver, {.margin = 0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
