#include <boost/test/unit_test.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers.hpp"

using namespace reprise;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Variable 1 is at its lower bound, 2 between two bounds, 3 fixed.
Problem boxed() {
  Problem problem;
  problem.name = "boxed";
  problem.n = 3;
  problem.lower = Vector3d(0.0, -infinity, 7.0);
  problem.upper = Vector3d(5.0, 5.0, 7.0);
  problem.objective = [](const VectorXd& x) { return x.sum(); };
  problem.inequalities = 1;
  problem.inequality = [](const VectorXd& x, VectorXd& g) { g[0] = -x[0]; };
  return problem;
}

Result ended() {
  Result result;
  result.x = Vector3d(1e-8, 0.1, 7.0);
  result.f = 1.0 / 3.0;
  result.violation = 1.25e-9;
  result.status = Status::converged;
  result.solver_code = 4;
  result.message = "the step is short";
  result.counts.objective = 12;
  result.counts.inequality = 11;
  result.counts.objective_gradient = 9;
  result.iterates = 1;
  return result;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

BOOST_AUTO_TEST_SUITE(result_report)

BOOST_AUTO_TEST_CASE(the_brief_report_is_one_line) {
  Result result = ended();
  BOOST_TEST(brief_report(result) ==
             "converged: f = 0.333333, violation 1.25e-09; 1 iterate, 12 + 9 evaluations (functions + gradients)");
  result.kkt_residual = 0.5;
  result.iterates = 2;
  BOOST_TEST(holds(brief_report(result), ", KKT residual 0.5; 2 iterates, "));
  result.f = -infinity;
  result.status = Status::unbounded;
  BOOST_TEST(holds(brief_report(result), "unbounded: f = -inf, "));
}

BOOST_AUTO_TEST_CASE(the_full_report_has_a_line_for_everything) {
  BOOST_TEST(full_report(ended(), boxed()) ==
             "problem             boxed: 3 variables, 1 inequality, 0 equalities\n"
             "status              converged (code 4)\n"
             "reason              the step is short\n"
             "f                   0.333333\n"
             "largest violation   1.25e-09\n"
             "KKT residual        not looked at\n"
             "iterates            1\n"
             "functions           objective 12, inequalities 11\n"
             "derivatives         objective's gradient 9\n"
             "active bounds       x_1 at its lower bound, x_3 fixed\n"
             "x                   (1e-08, 0.1, 7)\n");
}

BOOST_AUTO_TEST_CASE(active_bounds_are_those_within_the_tolerance) {
  Result result = ended();
  result.x = Vector3d(1e-3, 5.0 - 1e-7, 7.0);
  BOOST_TEST(holds(full_report(result, boxed()), "x_2 at its upper bound, x_3 fixed\n"));
  Problem free = boxed();
  free.lower.resize(0);
  free.upper.resize(0);
  BOOST_TEST(holds(full_report(result, free), "active bounds       none\n"));
}

BOOST_AUTO_TEST_CASE(a_result_of_another_problem_is_refused) {
  Result result = ended();
  result.x.resize(2);
  BOOST_CHECK_EXCEPTION(full_report(result, boxed()), std::invalid_argument, [](const std::invalid_argument& error) {
    return holds(error.what(), "is 2, but it must be 3");
  });
}

BOOST_AUTO_TEST_CASE(counts_add_up) {
  const Counts one{1, 2, 3, 4, 5, 6, 7};
  Counts sum{10, 20, 30, 40, 50, 60, 70};
  sum += one;
  BOOST_TEST(sum.objective == 11);
  BOOST_TEST(sum.inequality == 22);
  BOOST_TEST(sum.equality == 33);
  BOOST_TEST(sum.objective_gradient == 44);
  BOOST_TEST(sum.inequality_jacobian == 55);
  BOOST_TEST(sum.equality_jacobian == 66);
  BOOST_TEST(sum.lagrangian_hessian == 77);
}

// Read back number by number, the file is the history.
BOOST_AUTO_TEST_CASE(the_history_is_a_file_of_the_same_numbers) {
  Result result = ended();
  for (const double x : {1.0, 2.0 / 3.0, 1e-300}) {
    Iterate iterate;
    iterate.index = static_cast<long>(result.history.size());
    iterate.x = Eigen::Vector2d(x, -x / 7.0);
    iterate.f = std::sqrt(x);
    iterate.violation = x / 11.0;
    iterate.counts.objective = 5 + iterate.index;
    iterate.counts.objective_gradient = iterate.index;
    result.history.push_back(iterate);
  }
  std::istringstream lines(history_csv(result));
  std::string line;
  std::getline(lines, line);
  BOOST_TEST(line == "iterate,f,violation,functions,gradients,x_1,x_2");
  for (const Iterate& iterate : result.history) {
    BOOST_REQUIRE(std::getline(lines, line));
    std::istringstream fields(line);
    std::vector<double> numbers;
    for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stod(field));
    const std::vector<double> expected{static_cast<double>(iterate.index),
                                       iterate.f,
                                       iterate.violation,
                                       static_cast<double>(iterate.counts.function_evaluations()),
                                       static_cast<double>(iterate.counts.gradient_evaluations()),
                                       iterate.x[0],
                                       iterate.x[1]};
    BOOST_TEST(numbers == expected, boost::test_tools::per_element());
  }
  BOOST_TEST(!std::getline(lines, line));
  BOOST_TEST(history_csv(Result()) == "iterate,f,violation,functions,gradients\n");
}

BOOST_AUTO_TEST_SUITE_END()
