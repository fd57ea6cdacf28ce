#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/problem.hpp"

using namespace reprise;
using Eigen::VectorXd;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Problem plane(Eigen::Index n) {
  Problem problem;
  problem.name = "plane";
  problem.n = n;
  problem.objective = [](const VectorXd& x) { return x.sum(); };
  return problem;
}

/// True when the message of the refusal names the problem and holds the word.
auto naming(const std::string& word) {
  return [word](const std::invalid_argument& error) {
    const std::string message = error.what();
    return message.find("'plane'") != std::string::npos && message.find(word) != std::string::npos;
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_problem_needs_little) {
  validate(plane(1));
  Problem bounded = plane(2);
  bounded.lower = VectorXd::Constant(2, -infinity);
  bounded.upper = VectorXd::Constant(2, infinity);
  validate(bounded);
  bounded.lower[0] = bounded.upper[0] = 3.0;
  validate(bounded);
}

BOOST_AUTO_TEST_CASE(ill_formed_problems_are_refused) {
  const auto refused = [](const auto& spoil, const std::string& word) {
    Problem problem = plane(2);
    spoil(problem);
    BOOST_CHECK_EXCEPTION(validate(problem), std::invalid_argument, naming(word));
  };
  const auto constraint = [](const VectorXd&, VectorXd&) {};
  refused([](Problem& p) { p.n = 0; }, "n is 0");
  refused([](Problem& p) { p.n = -1; }, "n is -1");
  refused([](Problem& p) { p.objective = nullptr; }, "no objective");
  refused([](Problem& p) { p.lower = VectorXd::Zero(3); }, "lower has 3 entries");
  refused([](Problem& p) { p.upper = VectorXd::Zero(1); }, "upper has 1 entries");
  refused([](Problem& p) { p.lower = VectorXd::Constant(2, not_a_number); }, "lower");
  refused([](Problem& p) { p.upper = VectorXd::Constant(2, not_a_number); }, "upper");
  refused([](Problem& p) { p.lower = VectorXd::Constant(2, infinity); }, "+infinity");
  refused([](Problem& p) { p.upper = VectorXd::Constant(2, -infinity); }, "-infinity");
  refused(
      [](Problem& p) {
        p.lower = Eigen::Vector2d(0, 2);
        p.upper = Eigen::Vector2d(1, 1);
      },
      "variable 2");
  refused([](Problem& p) { p.inequalities = -1; }, "inequalities");
  refused([](Problem& p) { p.equalities = -1; }, "equalities");
  refused([](Problem& p) { p.inequalities = 1; }, "inequalities");
  refused([&](Problem& p) { p.inequality = constraint; }, "inequalities");
  refused([](Problem& p) { p.equalities = 1; }, "equalities");
  refused([&](Problem& p) { p.equality = constraint; }, "equalities");
}

BOOST_AUTO_TEST_CASE(largest_violation_covers_bounds_and_constraints) {
  Problem problem = plane(2);
  const VectorXd none;
  const Eigen::Vector2d x(1, 2);
  BOOST_TEST(largest_violation(problem, x, none, none) == 0.0);
  BOOST_TEST(largest_violation(problem, x, VectorXd::Constant(2, -3.0), none) == 0.0);
  BOOST_TEST(largest_violation(problem, x, Eigen::Vector2d(-3, 0.5), none) == 0.5);
  BOOST_TEST(largest_violation(problem, x, none, Eigen::Vector2d(-3, 0.5)) == 3.0);
  problem.lower = Eigen::Vector2d(1.25, -infinity);
  BOOST_TEST(largest_violation(problem, x, none, none) == 0.25);
  problem.upper = Eigen::Vector2d(infinity, 1.5);
  BOOST_TEST(largest_violation(problem, x, none, none) == 0.5);
}

BOOST_AUTO_TEST_CASE(largest_violation_is_not_a_number_when_a_value_is_not) {
  Problem problem = plane(2);
  const VectorXd none;
  BOOST_TEST(std::isnan(largest_violation(problem, VectorXd::Zero(2), Eigen::Vector3d(5, not_a_number, 7), none)));
  BOOST_TEST(std::isnan(largest_violation(problem, VectorXd::Zero(2), none, Eigen::Vector3d(5, not_a_number, 7))));
  problem.lower = VectorXd::Zero(2);
  BOOST_TEST(std::isnan(largest_violation(problem, Eigen::Vector2d(not_a_number, -1), none, none)));
  BOOST_TEST(std::isnan(largest_violation(problem, Eigen::Vector2d(-1, not_a_number), none, none)));
}

BOOST_AUTO_TEST_CASE(largest_violation_evaluates_the_constraints) {
  Problem problem = plane(2);
  problem.inequalities = 1;
  problem.inequality = [](const VectorXd& x, VectorXd& g) { g[0] = x[0] - 1.0; };
  problem.equalities = 1;
  problem.equality = [](const VectorXd& x, VectorXd& h) { h[0] = x[1] + 2.0; };
  BOOST_TEST(largest_violation(problem, Eigen::Vector2d(4, -2)) == 3.0);
  BOOST_TEST(largest_violation(problem, Eigen::Vector2d(4, -9)) == 7.0);
}

BOOST_AUTO_TEST_CASE(a_dense_jacobian_keeps_its_zeros) {
  const auto jacobian_of = dense_jacobian([](const VectorXd& x, Eigen::MatrixXd& jacobian) {
    jacobian.setZero();
    jacobian(1, 2) = x[0];
  });
  SparseMatrix jacobian(2, 3);
  for (const double value : {0.0, 7.0}) {
    jacobian_of(VectorXd::Constant(3, value), jacobian);
    BOOST_TEST(jacobian.nonZeros() == 6);
    BOOST_TEST(jacobian.isCompressed());
    BOOST_TEST(jacobian.coeff(1, 2) == value);
    BOOST_TEST(jacobian.sum() == value);
  }
}

BOOST_AUTO_TEST_CASE(a_dense_matrix_replaces_any_sparse_one) {
  SparseMatrix sparse(3, 2);
  sparse.insert(2, 0) = 9.0;
  const Eigen::MatrixXd dense = Eigen::MatrixXd::Random(2, 3);
  assign_dense(dense, sparse);
  BOOST_TEST((Eigen::MatrixXd(sparse) == dense));
  assign_dense(-dense, sparse);
  BOOST_TEST((Eigen::MatrixXd(sparse) == -dense));
}
