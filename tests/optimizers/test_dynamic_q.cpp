#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/standard_problems.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A program in n variables without constraints but the move limit.
SphericalProgram free_program(const Eigen::VectorXd& slope, double curvature, double move_limit) {
  const Eigen::Index n = slope.size();
  SphericalProgram program;
  program.objective = {Eigen::VectorXd::Zero(1), slope.transpose(), Eigen::VectorXd::Constant(1, curvature)};
  program.inequality = {Eigen::VectorXd(0), Eigen::MatrixXd(0, n), Eigen::VectorXd(0)};
  program.equality = program.inequality;
  program.move_limit = move_limit;
  program.lower = Eigen::VectorXd::Constant(n, -infinity);
  program.upper = Eigen::VectorXd::Constant(n, infinity);
  return program;
}

/// One more function value + slope . s + curvature / 2 |s|^2.
void append(SphericalQuadratics& functions, double value, const Eigen::VectorXd& slope, double curvature = 0.0) {
  const Eigen::Index row = functions.size();
  functions.value.conservativeResize(row + 1);
  functions.gradient.conservativeResize(row + 1, slope.size());
  functions.curvature.conservativeResize(row + 1);
  functions.value[row] = value;
  functions.gradient.row(row) = slope.transpose();
  functions.curvature[row] = curvature;
}

const Eigen::Vector3d slope(1.0, -2.0, 2.0);  // of length 3

BOOST_AUTO_TEST_SUITE(lfopc_on_spherical_programs)

BOOST_AUTO_TEST_CASE(without_constraints_the_minimum_of_the_sphere) {
  const LfopcResult result = lfopc(free_program(slope, 6.0, 10.0));
  BOOST_TEST((result.step + slope / 6.0).norm() < 1e-5);
  BOOST_TEST(result.particle_steps > 0);
}

BOOST_AUTO_TEST_CASE(a_linear_objective_goes_as_far_as_the_move_limit) {
  for (const double move_limit : {1e-3, 0.1, 1.0, 50.0}) {
    const LfopcResult result = lfopc(free_program(slope, 0.0, move_limit));
    BOOST_TEST((result.step + move_limit * slope / 3.0).norm() < 1e-4 * move_limit, "move limit " << move_limit);
  }
}

BOOST_AUTO_TEST_CASE(nearest_point_of_a_half_space) {
  // minimise |s - p|^2 / 2 over s_1 + s_2 + s_3 <= 0.3.
  const Eigen::Vector3d p(0.8, 0.1, 0.6);
  SphericalProgram program = free_program(-p, 1.0, 5.0);
  append(program.inequality, -0.3, Eigen::Vector3d::Ones());
  const Eigen::Vector3d expected = p - (p.sum() - 0.3) / 3.0 * Eigen::Vector3d::Ones();
  const Eigen::VectorXd step = lfopc(program).step;
  BOOST_TEST((step - expected).norm() < 1e-5);
  BOOST_TEST(std::abs(step.sum() - 0.3) < 1e-9);  // phase 2 meets what is active
}

BOOST_AUTO_TEST_CASE(equalities_and_spheres) {
  // The point of the circle |s| = 0.5 in the plane s_3 = 0.3 with the lowest s_1.
  SphericalProgram program = free_program(Eigen::Vector3d::UnitX(), 0.0, 2.0);
  append(program.equality, -0.3, Eigen::Vector3d::UnitZ());
  append(program.equality, -0.125, Eigen::Vector3d::Zero(), 1.0);
  const Eigen::VectorXd step = lfopc(program).step;
  BOOST_TEST((step - Eigen::Vector3d(-0.4, 0.0, 0.3)).norm() < 1e-4);
  BOOST_TEST(std::abs(step.norm() - 0.5) < 1e-8);
}

BOOST_AUTO_TEST_CASE(bounds_hold) {
  SphericalProgram program = free_program(slope, 1.0, 10.0);
  program.lower << -0.25, -infinity, -0.5;
  program.upper << infinity, 1.5, infinity;
  BOOST_TEST((lfopc(program).step - Eigen::Vector3d(-0.25, 1.5, -0.5)).norm() < 1e-5);
}

// A disc, given by thousands of its tangents: neighbours of the active one are violated along with it in phase 1 and
// cannot all be met with equality in phase 2.
BOOST_AUTO_TEST_CASE(a_finely_sampled_curve_of_constraints) {
  const double radius = 0.4;
  SphericalProgram program = free_program(Eigen::Vector2d(0.6, 0.8), 0.0, 2.0);
  constexpr int tangents = 3000;
  for (int k = 0; k < tangents; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / tangents;
    append(program.inequality, -radius, Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const Eigen::VectorXd step = lfopc(program).step;
  BOOST_TEST((step + radius * Eigen::Vector2d(0.6, 0.8)).norm() < 2e-3);
  BOOST_TEST(-Eigen::Vector2d(0.6, 0.8).dot(step) == radius, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(the_unit_of_length_does_not_matter) {
  const Eigen::Vector3d p(0.8, 0.1, 0.6);
  const auto solve = [&](double unit) {
    // Every function is a length, or the square of one over a length.
    SphericalProgram program = free_program(-p, 1.0 / unit, 5.0 * unit);
    append(program.inequality, -0.3 * unit, Eigen::Vector3d::Ones());
    return Eigen::VectorXd(lfopc(program).step / unit);
  };
  BOOST_TEST((solve(1.0) - solve(1e-2)).norm() < 1e-3);
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused_by_name) {
  const auto refused = [](auto change, const std::string& name) {
    LfopcOptions options;
    change(options);
    BOOST_CHECK_EXCEPTION(lfopc(free_program(slope, 1.0, 1.0), options), std::invalid_argument,
                          [&](const auto& error) { return std::string(error.what()).find(name) != std::string::npos; });
  };
  refused([](auto& o) { o.penalty_first = 0.0; }, "penalty_first");
  refused([](auto& o) { o.penalty_second = -1.0; }, "penalty_second");
  refused([](auto& o) { o.gradient_tolerance = std::nan(""); }, "gradient_tolerance");
  refused([](auto& o) { o.max_steps = 0; }, "max_steps");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(dynamic_q)

// Published accounts of the method solve these in some tens of gradient evaluations.
BOOST_AUTO_TEST_CASE(eight_hock_schittkowski_problems_in_at_most_fifty_gradient_evaluations) {
  Options options;
  options.feasibility_tolerance = 2e-6;
  for (const char* name : {"hs10", "hs12", "hs29", "hs43", "hs65", "hs71", "hs78", "hs100"}) {
    const StandardProblem& reference = standard_problem(name);
    const Result result = DynamicQ().minimize(reference.problem, reference.start, options);
    BOOST_TEST((result.status == Status::converged), name << ": " << result.message);
    BOOST_TEST(std::abs(result.f - reference.f_optimum) <= 1e-6 * std::abs(reference.f_optimum), name);
    BOOST_TEST(result.violation <= 2e-6, name);
    BOOST_TEST(result.counts.gradient_evaluations() <= 50, name);
    BOOST_TEST(result.history.size() == static_cast<std::size_t>(result.counts.gradient_evaluations()), name);
  }
}

/// |x - centre|^2 over the unit disc: every function is a spherical quadratic itself.
Problem disc_problem() {
  Problem problem;
  problem.name = "nearest point of the disc";
  problem.n = 2;
  problem.objective = [](const Eigen::VectorXd& x) { return (x - Eigen::Vector2d(3.0, 4.0)).squaredNorm(); };
  problem.inequalities = 1;
  problem.inequality = [](const Eigen::VectorXd& x, Eigen::VectorXd& g) { g[0] = x.squaredNorm() - 1.0; };
  return problem;
}

BOOST_AUTO_TEST_CASE(spherical_problems_are_solved_at_once) {
  // One step to learn the curvatures, one to the optimum, one or two to see that it is one.
  const Result result = DynamicQ().minimize(disc_problem(), Eigen::Vector2d(0.1, -0.2));
  BOOST_TEST((result.x - Eigen::Vector2d(0.6, 0.8)).norm() < 1e-4);
  BOOST_TEST(result.counts.gradient_evaluations() <= 6);
}

BOOST_AUTO_TEST_CASE(no_step_is_longer_than_the_move_limit) {
  DynamicQOptions options;
  options.move_limit = 0.05;
  const Result result = DynamicQ(options).minimize(disc_problem(), Eigen::Vector2d(0.1, -0.2));
  for (std::size_t k = 1; k < result.history.size(); ++k) {
    BOOST_TEST((result.history[k].x - result.history[k - 1].x).norm() <= 0.05 * (1.0 + 1e-3));
  }
  BOOST_TEST((result.x - Eigen::Vector2d(0.6, 0.8)).norm() < 1e-4);
}

BOOST_AUTO_TEST_CASE(a_step_into_the_undefined_is_taken_back) {
  Problem problem;
  problem.name = "x - log x";
  problem.n = 1;
  problem.objective = [](const Eigen::VectorXd& x) { return x[0] - std::log(x[0]); };
  problem.objective_gradient = [](const Eigen::VectorXd& x, Eigen::VectorXd& g) { g[0] = 1.0 - 1.0 / x[0]; };
  DynamicQOptions options;
  options.move_limit = 10.0;  // reaches far beyond 0
  const Result result = DynamicQ(options).minimize(problem, Eigen::VectorXd::Constant(1, 5.0));
  BOOST_TEST((result.status == Status::converged), result.message);
  BOOST_TEST(result.x[0] == 1.0, tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused_by_name) {
  const auto refused = [](auto change, const std::string& name) {
    DynamicQOptions options;
    change(options);
    BOOST_CHECK_EXCEPTION(DynamicQ{options}, std::invalid_argument,
                          [&](const auto& error) { return std::string(error.what()).find(name) != std::string::npos; });
  };
  refused([](auto& o) { o.move_limit = 0.0; }, "move_limit");
  refused([](auto& o) { o.move_limit = infinity; }, "move_limit");
  refused([](auto& o) { o.step_tolerance = -1.0; }, "step_tolerance");
  refused([](auto& o) { o.value_tolerance = -1.0; }, "value_tolerance");
  refused([](auto& o) { o.max_iterations = 0; }, "max_iterations");
  refused([](auto& o) { o.max_halvings = -1; }, "max_halvings");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
