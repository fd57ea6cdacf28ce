#include <Eigen/QR>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "reprise/optimizers/nonnegative_least_squares.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

SparseMatrix sparse(const Eigen::MatrixXd& dense) {
  SparseMatrix result(dense.rows(), dense.cols());
  assign_dense(dense, result);
  return result;
}

BOOST_AUTO_TEST_SUITE(nonnegative_least_squares_solver)

BOOST_AUTO_TEST_CASE(a_bound_is_met_where_the_free_solution_is_negative) {
  // |x_1 - 1|^2 + |x_2 + 1|^2
  const NonnegativeLeastSquares solved =
      nonnegative_least_squares(sparse(Eigen::Matrix2d::Identity()), Eigen::Vector2d(1.0, -1.0));
  BOOST_TEST(solved.converged);
  BOOST_TEST((solved.x - Eigen::Vector2d(1.0, 0.0)).norm() < 1e-15);
  BOOST_TEST(solved.residual == 1.0, tolerance(1e-15));
}

// A x - b and x satisfy the conditions of optimality: the slope is nowhere negative, and zero where x is positive.
BOOST_AUTO_TEST_CASE(conditions_of_optimality_hold) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Index m = 4 + trial % 7;
    const Eigen::Index n = 2 + trial % 11;  // also more unknowns than equations
    Eigen::MatrixXd a(m, n);
    Eigen::VectorXd b(m);
    for (double& entry : a.reshaped()) entry = trial % 3 == 0 && normal(random) > 0.5 ? 0.0 : normal(random);
    for (double& entry : b) entry = normal(random);
    if (trial % 5 == 0) a.col(1) = a.col(0);  // dependent columns
    const NonnegativeLeastSquares solved = nonnegative_least_squares(sparse(a), b);
    const Eigen::VectorXd slope = a.transpose() * (a * solved.x - b);
    BOOST_TEST(solved.converged);
    BOOST_TEST(solved.x.minCoeff() >= 0.0);
    BOOST_TEST(slope.minCoeff() > -1e-12);
    BOOST_TEST(std::abs(slope.dot(solved.x)) < 1e-12);
    BOOST_TEST(solved.residual == (a * solved.x - b).norm(), tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(nonnegative_coefficients_are_recovered) {
  Eigen::MatrixXd a(5, 3);
  a << 1, 2, 0, 0, 1, 1, 3, 0, 1, 1, 1, 1, 0, 2, 5;
  const Eigen::Vector3d x(0.5, 0.0, 2.0);
  const NonnegativeLeastSquares solved = nonnegative_least_squares(sparse(a), a * x);
  BOOST_TEST((solved.x - x).norm() < 1e-13);
  BOOST_TEST(solved.residual < 1e-13);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  BOOST_CHECK_THROW(nonnegative_least_squares(sparse(Eigen::Matrix2d::Identity()), Eigen::Vector3d::Zero()),
                    std::invalid_argument);
  BOOST_CHECK_THROW(nonnegative_least_squares(sparse(Eigen::Matrix2d::Identity()), Eigen::Vector2d(0.0, std::nan(""))),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
