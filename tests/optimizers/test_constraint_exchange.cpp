#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "counted_problem.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/nlopt.hpp"

using namespace reprise;
using Eigen::VectorXd;

namespace {

/// The quadratic a + b x + c x^2 nearest to x^3 on [-1, 1], sampled at 2 m + 1 points: minimise t under
/// |x^3 - a - b x - c x^2| <= t, variables [a, b, c, t]. By Chebyshev's polynomial T_3 it is 3 x / 4, with t = 1/4,
/// taken at -1, -1/2, 1/2 and 1 (samples, for even m).
Problem nearest_quadratic(int m) {
  Problem problem;
  problem.name = "nearest quadratic";
  problem.n = 4;
  problem.objective = [](const VectorXd& v) { return v[3]; };
  problem.objective_gradient = [](const VectorXd&, VectorXd& gradient) { gradient = VectorXd::Unit(4, 3); };
  problem.inequalities = 2 * (2 * m + 1);
  const auto sample = [m](Eigen::Index row) { return static_cast<double>(row / 2 - m) / m; };
  problem.inequality = [sample](const VectorXd& v, VectorXd& g) {
    for (Eigen::Index row = 0; row < g.size(); ++row) {
      const double x = sample(row);
      const double error = x * x * x - v[0] - v[1] * x - v[2] * x * x;
      g[row] = (row % 2 == 0 ? error : -error) - v[3];
    }
  };
  problem.inequality_jacobian = dense_jacobian([sample](const VectorXd&, Eigen::MatrixXd& jacobian) {
    for (Eigen::Index row = 0; row < jacobian.rows(); ++row) {
      const double x = sample(row);
      const double sign = row % 2 == 0 ? -1.0 : 1.0;
      jacobian.row(row) << sign, sign * x, sign * x * x, -1.0;
    }
  });
  problem.lagrangian_hessian = [](const VectorXd&, double, const VectorXd&, const VectorXd&, SparseMatrix& hessian) {
    assign_dense(Eigen::MatrixXd::Zero(4, 4), hessian);
  };
  return problem;
}

/// minimise x under x >= c_j.
Problem above_all(const VectorXd& c) {
  Problem problem;
  problem.name = "above all";
  problem.n = 1;
  problem.objective = [](const VectorXd& x) { return x[0]; };
  problem.inequalities = c.size();
  problem.inequality = [c](const VectorXd& x, VectorXd& g) { g = c.array() - x[0]; };
  return problem;
}

/// Moves x up by half of the largest value of the constraints it is given, and remembers how many these are.
class HalfWay : public Solver {
 public:
  explicit HalfWay(Status status) : status_(status) {}
  std::string name() const override { return "half_way"; }
  mutable std::vector<Eigen::Index> given;

 private:
  Outcome solve(Evaluator& evaluator, const VectorXd& x0) const override {
    given.push_back(evaluator.inequalities());
    return {x0 + VectorXd::Constant(1, 0.5 * evaluator.inequality(x0).maxCoeff()), status_, 7, "half way"};
  }

  Status status_;
};

BOOST_AUTO_TEST_SUITE(constraint_exchange)

BOOST_AUTO_TEST_CASE(nearest_quadratic_is_found_whatever_the_number_of_samples) {
  DynamicQOptions dynamic_q;
  dynamic_q.step_tolerance = 1e-7;
  const std::vector<std::shared_ptr<const Solver>> solvers = {
      std::make_shared<NloptSolver>(), std::make_shared<IpoptSolver>(), std::make_shared<DynamicQ>(dynamic_q)};
  for (const auto& solver : solvers) {
    for (const int m : {100, 10'000}) {
      const CountedProblem problem = counted(nearest_quadratic(m));
      Options options;
      options.check_stationarity = false;
      const Result result = ConstraintExchange(solver).minimize(problem.problem, VectorXd::Constant(4, 1.0), options);
      BOOST_TEST((result.status == Status::converged), solver->name() << ": " << result.message);
      BOOST_TEST(result.violation <= 1e-6, solver->name());
      BOOST_TEST((result.x - Eigen::Vector4d(0.0, 0.75, 0.0, 0.25)).norm() < 1e-4, solver->name());
      BOOST_TEST(as_list(result.counts) == as_list(*problem.calls), boost::test_tools::per_element());
      const double residual = kkt_residual(nearest_quadratic(m), result.x);
      BOOST_TEST(residual < 1e-4, solver->name() << ": " << residual);
      BOOST_TEST(result.history.front().x == VectorXd::Constant(4, 1.0));
      BOOST_TEST(static_cast<long>(result.history.size()) == result.counts.objective_gradient);
    }
  }
}

BOOST_AUTO_TEST_CASE(of_constraints_with_equal_gradients_the_most_violated_joins) {
  const auto solver = std::make_shared<HalfWay>(Status::converged);
  Options options;
  options.feasibility_tolerance = 1.9;
  // From 0, 8 joins and x becomes 4; 6 is violated then, but 8 more, which the solver says it cannot help.
  const Result result =
      ConstraintExchange(solver).minimize(above_all(Eigen::Vector3d(6.0, 8.0, 1.0)), VectorXd::Zero(1), options);
  BOOST_TEST(solver->given == (std::vector<Eigen::Index>{1}), boost::test_tools::per_element());
  BOOST_TEST(result.x[0] == 4.0);
  BOOST_TEST(result.solver_code == 7);
  BOOST_TEST(result.message.starts_with("half way"));
  // That is said, as it is without the exchange.
  BOOST_TEST((result.status == Status::infeasible));
}

// A thousand constraints with the same gradient: one of them is enough, however often the solver has to go on.
BOOST_AUTO_TEST_CASE(the_set_does_not_grow_by_neighbours_of_what_is_violated) {
  const auto solver = std::make_shared<HalfWay>(Status::iteration_limit);
  const Result result =
      ConstraintExchange(solver).minimize(above_all(VectorXd::LinSpaced(1000, 0.0, 8.0)), VectorXd::Zero(1));
  BOOST_TEST(std::all_of(solver->given.begin(), solver->given.end(), [](Eigen::Index count) { return count == 1; }));
  // Until the second largest, 8 / 999 below, is no longer violated.
  BOOST_TEST(solver->given.size() == 10U);
  BOOST_TEST(result.x[0] >= 8.0 - 8.0 / 999.0);
}

BOOST_AUTO_TEST_CASE(limit_on_rounds_is_kept) {
  const auto solver = std::make_shared<HalfWay>(Status::iteration_limit);
  const Result result = ConstraintExchange(solver, {.max_rounds = 2})
                            .minimize(above_all(VectorXd::LinSpaced(9, 0.0, 8.0)), VectorXd::Zero(1));
  BOOST_TEST(solver->given.size() == 2U);
  BOOST_TEST((result.status == Status::iteration_limit));
  BOOST_TEST(result.x[0] == 6.0);
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused) {
  const auto solver = std::make_shared<HalfWay>(Status::converged);
  BOOST_CHECK_THROW(ConstraintExchange(nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(ConstraintExchange(solver, {.angle = 0.0}), std::invalid_argument);
  BOOST_CHECK_THROW(ConstraintExchange(solver, {.angle = 1.6}), std::invalid_argument);
  BOOST_CHECK_THROW(ConstraintExchange(solver, {.max_rounds = 0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
