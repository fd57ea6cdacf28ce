#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/standard_problems.hpp"

using namespace reprise;
using Eigen::VectorXd;

namespace {

const DerivativeCheck& find(const DerivativeReport& report, const std::string& function) {
  const auto found = std::find_if(report.checks.begin(), report.checks.end(),
                                  [&](const DerivativeCheck& check) { return check.function == function; });
  BOOST_REQUIRE_MESSAGE(found != report.checks.end(), "no check of " << function);
  return *found;
}

/// Names of the checks that failed.
std::vector<std::string> failures(const DerivativeReport& report) {
  std::vector<std::string> names;
  for (const DerivativeCheck& check : report.checks) {
    if (!check.passed) names.push_back(check.function);
  }
  return names;
}

/// One variable, a function and its alleged derivative.
Problem one_variable(std::function<double(double)> function, std::function<double(double)> derivative) {
  Problem problem;
  problem.name = "one variable";
  problem.n = 1;
  problem.objective = [function](const VectorXd& x) { return function(x[0]); };
  problem.objective_gradient = [derivative](const VectorXd& x, VectorXd& gradient) { gradient[0] = derivative(x[0]); };
  return problem;
}

DerivativeCheck check_at(double x, std::function<double(double)> function, std::function<double(double)> derivative,
                         double tolerance = 1e-6) {
  return check_derivatives(one_variable(std::move(function), std::move(derivative)), VectorXd::Constant(1, x),
                           tolerance)
      .checks.front();
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_given_derivative_is_checked_and_named) {
  const StandardProblem hs71 = standard_problem("hs71");
  const DerivativeReport report = check_derivatives(hs71.problem, hs71.start);
  BOOST_TEST(report.passed());
  BOOST_TEST(report.checks.size() == 1 + 1 + 1 + 4);
  find(report, "objective");
  find(report, "inequality 1");
  find(report, "equality 1");
  find(report, "lagrangian hessian, column 4");

  Problem without = hs71.problem;
  without.objective_gradient = nullptr;
  without.inequality_jacobian = nullptr;
  BOOST_TEST(check_derivatives(without, hs71.start).checks.size() == 1);
}

BOOST_AUTO_TEST_CASE(a_wrong_gradient_entry_is_found) {
  for (const double error : {1e-4, 1e-2, 1.0}) {
    StandardProblem hs100 = standard_problem("hs100");
    const auto right = hs100.problem.objective_gradient;
    hs100.problem.objective_gradient = [right, error](const VectorXd& x, VectorXd& gradient) {
      right(x, gradient);
      gradient[4] += error * gradient.cwiseAbs().maxCoeff();
    };
    hs100.problem.lagrangian_hessian = nullptr;
    BOOST_TEST(failures(check_derivatives(hs100.problem, hs100.start)) == std::vector<std::string>{"objective"},
               boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(a_wrong_sign_is_found) {
  BOOST_TEST(!check_at(
                  1.0, [](double x) { return std::sin(x); }, [](double x) { return -std::cos(x); })
                  .passed);
}

BOOST_AUTO_TEST_CASE(a_wrong_jacobian_row_is_found) {
  StandardProblem hs113 = standard_problem("hs113");
  const auto right = hs113.problem.inequality_jacobian;
  hs113.problem.lagrangian_hessian = nullptr;
  hs113.problem.inequality_jacobian = [right](const VectorXd& x, SparseMatrix& jacobian) {
    right(x, jacobian);
    jacobian.coeffRef(4, 2) = 0.0;  // 2 (x_3 - 6) is forgotten
  };
  BOOST_TEST(failures(check_derivatives(hs113.problem, hs113.start)) == std::vector<std::string>{"inequality 5"},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(exchanged_jacobian_rows_are_found) {
  StandardProblem hs78 = standard_problem("hs78");
  const auto right = hs78.problem.equality_jacobian;
  hs78.problem.lagrangian_hessian = nullptr;
  hs78.problem.equality_jacobian = [right](const VectorXd& x, SparseMatrix& jacobian) {
    right(x, jacobian);
    Eigen::MatrixXd dense = jacobian;
    dense.row(0).swap(dense.row(2));
    assign_dense(dense, jacobian);
  };
  const std::vector<std::string> expected{"equality 1", "equality 3"};
  BOOST_TEST(failures(check_derivatives(hs78.problem, hs78.start)) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_wrong_hessian_entry_is_found) {
  StandardProblem hs43 = standard_problem("hs43");
  const auto right = hs43.problem.lagrangian_hessian;
  hs43.problem.lagrangian_hessian = [right](const VectorXd& x, double factor, const VectorXd& lambda,
                                            const VectorXd& mu, SparseMatrix& hessian) {
    right(x, factor, lambda, mu, hessian);
    hessian.coeffRef(3, 1) += 1e-3;
  };
  const std::vector<std::string> expected{"lagrangian hessian, column 2", "lagrangian hessian, column 4"};
  BOOST_TEST(failures(check_derivatives(hs43.problem, hs43.start)) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_hessian_that_takes_a_wrong_multiplier_is_found) {
  StandardProblem hs43 = standard_problem("hs43");
  const auto right = hs43.problem.lagrangian_hessian;
  hs43.problem.lagrangian_hessian = [right](const VectorXd& x, double factor, const VectorXd& lambda,
                                            const VectorXd& mu,
                                            SparseMatrix& hessian) { right(x, factor, lambda.reverse(), mu, hessian); };
  BOOST_TEST(!check_derivatives(hs43.problem, hs43.start).passed());
}

BOOST_AUTO_TEST_CASE(linear_and_constant_functions_pass) {
  const auto linear = check_at(
      2.0, [](double x) { return 3.0 * x - 1.0; }, [](double) { return 3.0; });
  BOOST_TEST(linear.passed);
  BOOST_TEST(linear.remainder_order == infinity);
  const auto steep = check_at(
      0.0, [](double x) { return 1e8 * x; }, [](double) { return 1e8; });
  BOOST_TEST(steep.passed);
  const auto constant = check_at(
      2.0, [](double) { return 5.0; }, [](double) { return 0.0; });
  BOOST_TEST(constant.passed);
  BOOST_TEST(constant.direction_error == 0.0);
  BOOST_TEST(constant.remainder_order == infinity);
}

BOOST_AUTO_TEST_CASE(the_remainder_tells_right_from_wrong_by_its_order) {
  const auto square = [](double x) { return x * x; };
  const auto tolerance = boost::test_tools::tolerance(1e-2);
  BOOST_TEST(check_at(1.0, square, [](double x) { return 2.0 * x; }).remainder_order == 2.0, tolerance);
  BOOST_TEST(check_at(
                 0.0, [](double x) { return x * x * x; },
                 [](double) {
                   return 0.0;
                 }).remainder_order == 3.0,
             tolerance);
  // Even where no error is called too large, the order is.
  const DerivativeCheck wrong = check_at(
      1.0, square, [](double) { return 2.001; }, infinity);
  BOOST_TEST(wrong.remainder_order == 1.0, tolerance);
  BOOST_TEST(!wrong.passed);
}

BOOST_AUTO_TEST_CASE(variables_of_very_different_size_are_checked_at_their_own_scale) {
  Problem problem;
  problem.name = "scales";
  problem.n = 2;
  problem.objective = [](const VectorXd& x) { return 1e-6 * x[0] * std::cos(x[1]); };
  problem.objective_gradient = [](const VectorXd& x, VectorXd& gradient) {
    gradient << 1e-6 * std::cos(x[1]), -1e-6 * x[0] * std::sin(x[1]);
  };
  BOOST_TEST(check_derivatives(problem, Eigen::Vector2d(1e6, 0.7)).passed());
}

BOOST_AUTO_TEST_CASE(a_function_may_end_close_by) {
  // Only the longest steps of the remainder leave the domain.
  const auto log = [](double x) { return std::log(x); };
  BOOST_TEST(check_at(
                 4e-3, log, [](double x) { return 1.0 / x; }, 1e-4)
                 .passed);
  const DerivativeCheck wrong = check_at(
      4e-3, log, [](double x) { return 1.1 / x; }, infinity);
  BOOST_TEST(!wrong.passed);
}

BOOST_AUTO_TEST_CASE(what_is_not_a_number_fails) {
  const auto nan = [](double) { return std::numeric_limits<double>::quiet_NaN(); };
  BOOST_TEST(!check_at(
                  1.0, [](double x) { return x; }, nan)
                  .passed);
  BOOST_TEST(!check_at(1.0, nan, [](double) { return 1.0; }).passed);

  StandardProblem hs43 = standard_problem("hs43");
  const auto right = hs43.problem.objective_gradient;
  for (Eigen::Index i = 0; i < 4; ++i) {
    hs43.problem.objective_gradient = [right, i](const VectorXd& x, VectorXd& gradient) {
      right(x, gradient);
      gradient[i] = std::numeric_limits<double>::quiet_NaN();
    };
    BOOST_TEST(!find(check_derivatives(hs43.problem, hs43.start), "objective").passed);
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  const StandardProblem hs43 = standard_problem("hs43");
  BOOST_CHECK_THROW(check_derivatives(hs43.problem, VectorXd::Zero(3)), std::invalid_argument);
  BOOST_CHECK_THROW(check_derivatives(hs43.problem, VectorXd::Constant(4, infinity)), std::invalid_argument);
  BOOST_CHECK_THROW(check_derivatives(Problem{}, VectorXd()), std::invalid_argument);
}
