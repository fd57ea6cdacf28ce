#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/random_quadratic_programs.hpp"
#include "reprise/optimizers/standard_problems.hpp"

using namespace reprise;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// factor |x - c|^2 under g = constraint_factor (x_1 + x_2 - 1) <= 0
Problem nearest_point(const Vector2d& c, double factor = 1.0, double constraint_factor = 1.0) {
  Problem problem;
  problem.name = "nearest point";
  problem.n = 2;
  problem.objective = [=](const VectorXd& x) { return factor * (x - c).squaredNorm(); };
  problem.objective_gradient = [=](const VectorXd& x, VectorXd& gradient) { gradient = 2.0 * factor * (x - c); };
  problem.inequalities = 1;
  problem.inequality = [=](const VectorXd& x, VectorXd& g) { g[0] = constraint_factor * (x.sum() - 1.0); };
  problem.inequality_jacobian =
      dense_jacobian([=](const VectorXd&, MatrixXd& jacobian) { jacobian.setConstant(constraint_factor); });
  return problem;
}

BOOST_AUTO_TEST_SUITE(residual_of_the_optimality_conditions)

BOOST_AUTO_TEST_CASE(it_is_zero_at_an_optimum) {
  BOOST_TEST(kkt_residual(nearest_point({1.0, 1.0}), Vector2d(0.5, 0.5)) < 1e-15);
  BOOST_TEST(kkt_residual(nearest_point({-1.0, 0.5}), Vector2d(-1.0, 0.5)) < 1e-15);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RandomQuadraticProgram program = random_quadratic_program(seed);
    BOOST_TEST(kkt_residual(program.problem, program.optimum) < 1e-9);
  }
  // Rounding of the optima of the literature, and no constraint qualification where the list says so.
  for (const StandardProblem& standard : standard_problems()) {
    if (standard.problem.name == "hs13") continue;
    const double residual = kkt_residual(standard.problem, standard.optimum);
    BOOST_TEST(residual <= largest_kkt_residual, standard.problem.name << ": " << residual);
  }
}

// Without an active constraint it is the distance to go in units of the variables: |x - c| / max(1, |x|).
BOOST_AUTO_TEST_CASE(near_a_free_optimum_it_is_the_distance) {
  Problem problem = nearest_point({-1.0, 0.5});
  problem.inequalities = 0;
  problem.inequality = nullptr;
  problem.inequality_jacobian = nullptr;
  for (const double distance : {1e-8, 1e-3, 0.1}) {
    BOOST_TEST(kkt_residual(problem, Vector2d(-1.0, 0.5 + distance)) == distance, boost::test_tools::tolerance(1e-6));
  }
}

// At (a, 1 - a) on the line the gradient along it is what is left: |grad f| cos of the angle between.
BOOST_AUTO_TEST_CASE(along_an_active_constraint_it_is_the_part_of_the_gradient_that_is_left) {
  const Vector2d x(0.8, 0.2);
  const Vector2d gradient = 2.0 * (x - Vector2d(1.0, 1.0));
  const double left = std::abs(gradient[0] - gradient[1]) / std::sqrt(2.0);
  BOOST_TEST(kkt_residual(nearest_point({1.0, 1.0}), x) == left / std::max(2.0, gradient.norm()),
             boost::test_tools::tolerance(1e-6));
  // A multiplier of the wrong sign does not help: everything is left.
  BOOST_TEST(kkt_residual(nearest_point({-1.0, -1.0}), Vector2d(0.5, 0.5)) == 1.0, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(units_of_f_and_g_do_not_matter) {
  for (const Vector2d& x : {Vector2d(0.8, 0.2), Vector2d(0.3, 0.4), Vector2d(0.501, 0.499)}) {
    const double residual = kkt_residual(nearest_point({1.0, 1.0}), x);
    for (const double factor : {1e-10, 1e6}) {
      BOOST_TEST(kkt_residual(nearest_point({1.0, 1.0}, factor, 1.0), x) == residual,
                 boost::test_tools::tolerance(1e-6));
      BOOST_TEST(kkt_residual(nearest_point({1.0, 1.0}, 1.0, factor), x) == residual,
                 boost::test_tools::tolerance(1e-6));
    }
  }
}

BOOST_AUTO_TEST_CASE(differences_stand_in_for_gradients) {
  const StandardProblem reference = standard_problem("hs71");
  Problem bare = reference.problem;
  bare.objective_gradient = nullptr;
  bare.inequality_jacobian = nullptr;
  bare.equality_jacobian = nullptr;
  BOOST_TEST(kkt_residual(bare, reference.optimum) < 1e-6);
  BOOST_TEST(kkt_residual(bare, reference.start) == kkt_residual(reference.problem, reference.start),
             boost::test_tools::tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(bounds_count_as_constraints_and_fixed_variables_not_at_all) {
  Problem problem = nearest_point({-1.0, -3.0});
  problem.lower = Vector2d(0.0, -1.0);
  problem.upper = Vector2d(2.0, -1.0);
  BOOST_TEST(kkt_residual(problem, Vector2d(0.0, -1.0)) < 1e-15);
  BOOST_TEST(kkt_residual(problem, Vector2d(1.0, -1.0)) > 0.5);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_told_is_not_a_number_and_bad_input_is_refused) {
  Problem root;
  root.name = "root";
  root.n = 1;
  root.lower = VectorXd::Zero(1);
  root.objective = [](const VectorXd& x) { return std::sqrt(x[0]); };
  root.objective_gradient = [](const VectorXd& x, VectorXd& gradient) { gradient[0] = 0.5 / std::sqrt(x[0]); };
  BOOST_TEST(std::isnan(kkt_residual(root, VectorXd::Zero(1))));
  BOOST_CHECK_THROW(kkt_residual(root, VectorXd::Zero(2)), std::invalid_argument);
  BOOST_CHECK_THROW(kkt_residual(root, VectorXd::Constant(1, std::nan(""))), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
