#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/standard_problems.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

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

/// Both ways to minimise a spherical program, with the accuracy of the step, in units of its length, and that to which
/// active constraints hold.
struct Method {
  std::string name;
  Eigen::VectorXd (*solve)(const SphericalProgram& program);
  double accuracy, feasibility;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all{
      {"lfopc", [](const SphericalProgram& program) { return lfopc(program).step; }, 1e-4, 1e-8},
      {"dual", [](const SphericalProgram& program) { return solve_dual(program).step; }, 2e-6, 1e-9}};
  return all;
}

BOOST_AUTO_TEST_SUITE(spherical_programs)

BOOST_AUTO_TEST_CASE(without_constraints_the_minimum_of_the_sphere) {
  for (const Method& method : methods()) {
    BOOST_TEST((method.solve(free_program(slope, 6.0, 10.0)) + slope / 6.0).norm() < method.accuracy, method.name);
  }
  BOOST_TEST(lfopc(free_program(slope, 6.0, 10.0)).particle_steps > 0);
}

BOOST_AUTO_TEST_CASE(a_linear_objective_goes_as_far_as_the_move_limit) {
  for (const Method& method : methods()) {
    for (const double move_limit : {1e-3, 0.1, 1.0, 50.0}) {
      const Eigen::VectorXd step = method.solve(free_program(slope, 0.0, move_limit));
      BOOST_TEST((step + move_limit * slope / 3.0).norm() < method.accuracy * move_limit,
                 method.name << ", move limit " << move_limit);
    }
  }
}

BOOST_AUTO_TEST_CASE(nearest_point_of_a_half_space) {
  // minimise |s - p|^2 / 2 over s_1 + s_2 + s_3 <= 0.3.
  const Eigen::Vector3d p(0.8, 0.1, 0.6);
  SphericalProgram program = free_program(-p, 1.0, 5.0);
  append(program.inequality, -0.3, Eigen::Vector3d::Ones());
  const double multiplier = (p.sum() - 0.3) / 3.0;
  const Eigen::Vector3d expected = p - multiplier * Eigen::Vector3d::Ones();
  for (const Method& method : methods()) {
    const Eigen::VectorXd step = method.solve(program);
    BOOST_TEST((step - expected).norm() < method.accuracy, method.name);
    BOOST_TEST(std::abs(step.sum() - 0.3) < method.feasibility, method.name);
  }
  const SphericalDualResult dual = solve_dual(program);
  BOOST_TEST(dual.inequality_multipliers[0] == multiplier, tolerance(1e-5));
  BOOST_TEST(dual.exact);
  BOOST_TEST(!dual.relaxed);
}

BOOST_AUTO_TEST_CASE(equalities_and_spheres) {
  // The point of the circle |s| = 0.5 in the plane s_3 = 0.3 with the lowest s_1.
  SphericalProgram program = free_program(Eigen::Vector3d::UnitX(), 0.0, 2.0);
  append(program.equality, -0.3, Eigen::Vector3d::UnitZ());
  append(program.equality, -0.125, Eigen::Vector3d::Zero(), 1.0);
  for (const Method& method : methods()) {
    const Eigen::VectorXd step = method.solve(program);
    BOOST_TEST((step - Eigen::Vector3d(-0.4, 0.0, 0.3)).norm() < method.accuracy, method.name);
    BOOST_TEST(std::abs(step.norm() - 0.5) < method.feasibility, method.name);
  }
  // The gradient of the Lagrangian vanishes: e_1 + mu_1 e_3 + mu_2 s = 0.
  const SphericalDualResult dual = solve_dual(program);
  BOOST_TEST(dual.equality_multipliers[1] == 2.5, tolerance(1e-5));
  BOOST_TEST(dual.equality_multipliers[0] == -0.75, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(bounds_hold) {
  SphericalProgram program = free_program(slope, 1.0, 10.0);
  program.lower << -0.25, -infinity, -0.5;
  program.upper << infinity, 1.5, infinity;
  for (const Method& method : methods()) {
    BOOST_TEST((method.solve(program) - Eigen::Vector3d(-0.25, 1.5, -0.5)).norm() < method.accuracy, method.name);
  }
}

// A disc, given by thousands of its tangents: neighbours of the active one are violated along with it in phase 1 of
// LFOPC and cannot all be met with equality in phase 2.
BOOST_AUTO_TEST_CASE(a_finely_sampled_curve_of_constraints) {
  const double radius = 0.4;
  SphericalProgram program = free_program(Eigen::Vector2d(0.6, 0.8), 0.0, 2.0);
  constexpr int tangents = 3000;
  for (int k = 0; k < tangents; ++k) {
    const double angle = 2.0 * pi * k / tangents;
    append(program.inequality, -radius, Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  for (const Method& method : methods()) {
    const Eigen::VectorXd step = method.solve(program);
    BOOST_TEST((step + radius * Eigen::Vector2d(0.6, 0.8)).norm() < 2e-3, method.name);
    BOOST_TEST(-Eigen::Vector2d(0.6, 0.8).dot(step) == radius, tolerance(1e-5));
  }
}

BOOST_AUTO_TEST_CASE(the_unit_of_length_does_not_matter) {
  const Eigen::Vector3d p(0.8, 0.1, 0.6);
  const auto make = [&](double unit) {
    // Every function is a length, or the square of one over a length.
    SphericalProgram program = free_program(-p, 1.0 / unit, 5.0 * unit);
    append(program.inequality, -0.3 * unit, Eigen::Vector3d::Ones());
    return program;
  };
  for (const Method& method : methods()) {
    BOOST_TEST((method.solve(make(1.0)) - method.solve(make(1e-2)) / 1e-2).norm() < 10.0 * method.accuracy,
               method.name);
  }
}

BOOST_AUTO_TEST_CASE(a_concave_objective_goes_to_the_sphere) {
  // Every point in the direction of s lowers a . s - |s|^2 / 2; the lowest is opposite to a.
  const SphericalDualResult dual = solve_dual(free_program(1e-3 * slope, -1.0, 0.7));
  BOOST_TEST((dual.step + 0.7 * slope / 3.0).norm() < 1e-6);
  BOOST_TEST(dual.exact);
}

BOOST_AUTO_TEST_CASE(contradicting_constraints_share_the_violation) {
  // s_1 >= 1 and s_1 <= -0.5, the second in another unit: 0.75 each, and s_2 as low as the rest allows.
  SphericalProgram program = free_program(Eigen::Vector2d(0.0, 1.0), 0.0, 1.0);
  append(program.inequality, 1.0, Eigen::Vector2d(-1.0, 0.0));
  append(program.inequality, 50.0, Eigen::Vector2d(100.0, 0.0));
  const SphericalDualResult dual = solve_dual(program);
  BOOST_TEST(dual.relaxed);
  BOOST_TEST(dual.step[0] == 0.25, tolerance(1e-5));
  BOOST_TEST(dual.step[1] == -std::sqrt(1.0 - 0.0625), tolerance(1e-4));
  // An equality out of reach of the move limit is approached as far as it goes.
  program = free_program(Eigen::Vector2d(0.0, 1.0), 0.0, 1.0);
  append(program.equality, -10.0, Eigen::Vector2d(3.0, 4.0));
  const SphericalDualResult far = solve_dual(program);
  BOOST_TEST(far.relaxed);
  BOOST_TEST((far.step - Eigen::Vector2d(0.6, 0.8)).norm() < 1e-2);
}

// With convex functions the conditions of optimality decide: they are checked by the program's own numbers.
BOOST_AUTO_TEST_CASE(random_convex_programs_are_solved_exactly) {
  std::mt19937 generator(2002);
  std::normal_distribution<double> normal;
  const auto random_vector = [&](Eigen::Index n) {
    Eigen::VectorXd result(n);
    for (double& entry : result) entry = normal(generator);
    return result;
  };
  int constrained = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Index n = 2 + trial % 6;
    SphericalProgram program = free_program(random_vector(n), std::abs(normal(generator)), 0.5 + trial % 3);
    // The origin is feasible.
    for (int j = 0; j < trial % 5; ++j) {
      append(program.inequality, -0.3 * std::abs(normal(generator)), random_vector(n), std::abs(normal(generator)));
    }
    if (trial % 2 == 0) append(program.equality, 0.0, random_vector(n));
    const SphericalDualResult dual = solve_dual(program);
    BOOST_TEST_CONTEXT("trial " << trial) {
      BOOST_TEST(dual.exact);
      BOOST_TEST(!dual.relaxed);
      const Eigen::VectorXd& s = dual.step;
      const auto value = [&](const SphericalQuadratics& functions, Eigen::Index k) {
        return functions.value[k] + functions.gradient.row(k).dot(s) + 0.5 * functions.curvature[k] * s.squaredNorm();
      };
      const auto gradient = [&](const SphericalQuadratics& functions, Eigen::Index k) -> Eigen::VectorXd {
        return functions.gradient.row(k).transpose() + functions.curvature[k] * s;
      };
      Eigen::VectorXd lagrangian = gradient(program.objective, 0);
      for (Eigen::Index j = 0; j < program.inequality.size(); ++j) {
        const double multiplier = dual.inequality_multipliers[j];
        BOOST_TEST(multiplier >= 0.0);
        BOOST_TEST(value(program.inequality, j) <= 1e-8);
        BOOST_TEST(std::abs(multiplier * value(program.inequality, j)) <= 1e-7);
        lagrangian += multiplier * gradient(program.inequality, j);
        if (multiplier > 1e-3) ++constrained;
      }
      for (Eigen::Index k = 0; k < program.equality.size(); ++k) {
        BOOST_TEST(std::abs(value(program.equality, k)) <= 1e-8);
        lagrangian += dual.equality_multipliers[k] * gradient(program.equality, k);
      }
      // What remains is the force of the move limit, along -s and only on the sphere.
      const double excess = program.move_limit - s.norm();
      BOOST_TEST(excess >= -1e-8);
      if (excess > 1e-5) {
        BOOST_TEST(lagrangian.norm() <= 1e-4);
      } else {
        BOOST_TEST((lagrangian - lagrangian.dot(s) / s.squaredNorm() * s).norm() <= 1e-4);
        BOOST_TEST(lagrangian.dot(s) <= 1e-4);
      }
    }
  }
  BOOST_TEST(constrained > 100);
}

BOOST_AUTO_TEST_CASE(bad_dual_options_are_refused_by_name) {
  const auto refused = [](auto change, const std::string& name) {
    SphericalDualOptions options;
    change(options);
    BOOST_CHECK_EXCEPTION(solve_dual(free_program(slope, 1.0, 1.0), options), std::invalid_argument,
                          [&](const auto& error) { return std::string(error.what()).find(name) != std::string::npos; });
  };
  refused([](auto& o) { o.tolerance = 0.0; }, "tolerance");
  refused([](auto& o) { o.max_steps = 0; }, "max_steps");
  refused([](auto& o) { o.least_curvature = -1.0; }, "least_curvature");
  refused([](auto& o) { o.slack_tolerance = std::nan(""); }, "slack_tolerance");
  refused([](auto& o) { o.first_raise = 0.0; }, "first_raise");
  refused([](auto& o) { o.max_raises = -1; }, "max_raises");
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

DynamicQOptions dual_options() {
  DynamicQOptions options;
  options.subproblem = SubproblemSolver::dual;
  return options;
}

DynamicQOptions safeguarded_options() {
  DynamicQOptions options = dual_options();
  options.safeguard.active = true;
  options.scale_variables = true;
  return options;
}

BOOST_AUTO_TEST_CASE(every_variant_has_its_name) {
  BOOST_TEST(DynamicQ().name() == "dynamic_q");
  BOOST_TEST(DynamicQ(dual_options()).name() == "dynamic_q_dual");
  BOOST_TEST(DynamicQ(safeguarded_options()).name() == "dynamic_q_safeguarded");
}

// Published accounts of the method solve these in some tens of gradient evaluations.
BOOST_AUTO_TEST_CASE(eight_hock_schittkowski_problems_in_at_most_fifty_gradient_evaluations) {
  Options options;
  options.feasibility_tolerance = 2e-6;
  for (const DynamicQ& solver : {DynamicQ(), DynamicQ(dual_options()), DynamicQ(safeguarded_options())}) {
    for (const char* name : {"hs10", "hs12", "hs29", "hs43", "hs65", "hs71", "hs78", "hs100"}) {
      BOOST_TEST_CONTEXT(solver.name() << " on " << name) {
        const StandardProblem& standard = standard_problem(name);
        const Result result = solver.minimize(standard.problem, standard.start, options);
        BOOST_TEST((result.status == Status::converged), result.message);
        BOOST_TEST(std::abs(result.f - standard.f_optimum) <= 1e-6 * std::abs(standard.f_optimum));
        BOOST_TEST(result.violation <= 2e-6);
        BOOST_TEST(result.counts.gradient_evaluations() <= 50);
        // A refused point costs no gradient and is no iterate.
        BOOST_TEST(result.history.size() == static_cast<std::size_t>(result.counts.gradient_evaluations()));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_safeguard_goes_through_the_valley) {
  // Without it the method leaves Rosenbrock's valley again and again.
  const StandardProblem hs1 = standard_problem("hs1");
  DynamicQOptions options = safeguarded_options();
  options.max_iterations = 1000;
  const Result result = DynamicQ(options).minimize(hs1.problem, hs1.start);
  BOOST_TEST((result.status == Status::converged), result.message);
  BOOST_TEST(result.f < 1e-6);
  BOOST_TEST(result.counts.function_evaluations() > result.counts.gradient_evaluations());
  const auto memory = static_cast<std::size_t>(options.safeguard.memory);
  BOOST_TEST(result.history.size() > memory);
  for (std::size_t k = memory; k < result.history.size(); ++k) {
    double largest = 0.0;
    for (std::size_t back = 1; back <= memory; ++back) largest = std::max(largest, result.history[k - back].f);
    BOOST_TEST(result.history[k].f <= largest);
  }
}

BOOST_AUTO_TEST_CASE(with_scaled_variables_their_units_do_not_matter) {
  // hs100 with its variables in other units; both starts have entries of 1 and more.
  StandardProblem standard = standard_problem("hs100");
  standard.start << 1, 2, 1, 4, 1, 1, 1;
  const Eigen::VectorXd units = (Eigen::VectorXd(7) << 1e-3, 1e-2, 1e-4, 1e-3, 1e-1, 1e-5, 1e-2).finished();
  Problem problem;
  problem.name = "hs100 in other units";
  problem.n = 7;
  problem.objective = [&](const Eigen::VectorXd& y) { return standard.problem.objective(y.cwiseProduct(units)); };
  problem.objective_gradient = [&](const Eigen::VectorXd& y, Eigen::VectorXd& gradient) {
    standard.problem.objective_gradient(y.cwiseProduct(units), gradient);
    gradient = gradient.cwiseProduct(units).eval();
  };
  problem.inequalities = standard.problem.inequalities;
  problem.inequality = [&](const Eigen::VectorXd& y, Eigen::VectorXd& g) {
    standard.problem.inequality(y.cwiseProduct(units), g);
  };
  problem.inequality_jacobian = [&](const Eigen::VectorXd& y, SparseMatrix& jacobian) {
    standard.problem.inequality_jacobian(y.cwiseProduct(units), jacobian);
    jacobian = (jacobian * units.asDiagonal()).eval();
  };
  DynamicQOptions options = dual_options();
  options.scale_variables = true;
  options.max_iterations = 8;
  const Result original = DynamicQ(options).minimize(standard.problem, standard.start);
  const Result other = DynamicQ(options).minimize(problem, standard.start.cwiseQuotient(units));
  BOOST_TEST_REQUIRE(original.history.size() == 8);
  BOOST_TEST_REQUIRE(other.history.size() == 8);
  for (std::size_t k = 0; k < 8; ++k) {
    BOOST_TEST((other.history[k].x.cwiseProduct(units) - original.history[k].x).norm() <= 1e-6);
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
  refused([](auto& o) { o.safeguard.active = true; }, "safeguard.active");
  refused([](auto& o) { o.safeguard.memory = 0; }, "safeguard.memory");
  refused([](auto& o) { o.safeguard.weight = 0.5; }, "safeguard.weight");
  refused([](auto& o) { o.safeguard.forgetting = 1.5; }, "safeguard.forgetting");
  refused([](auto& o) { o.safeguard.decrease = 1.0; }, "safeguard.decrease");
  refused([](auto& o) { o.safeguard.growth = 0.9; }, "safeguard.growth");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
