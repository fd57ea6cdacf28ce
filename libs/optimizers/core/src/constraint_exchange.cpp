#include "reprise/optimizers/constraint_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/optimizers/evaluator.hpp"

namespace reprise {
namespace {

/// A solver that has come to its limit on iterations goes on with the same set as long as a round lowers the violation
/// to less than this part of it.
constexpr double worthwhile = 0.9;

/// Rows of the inequalities, in increasing order.
using Rows = std::vector<Eigen::Index>;

/// The candidates, the most violated first, whose gradients are at an angle to those of all taken before, and of all
/// in the set that are violated as much.
Rows choose(Rows candidates, const std::vector<bool>& in_set, Evaluator& evaluator, const Eigen::VectorXd& x,
            double angle) {
  const Eigen::VectorXd& g = evaluator.inequality(x);
  const auto violation = [&g](Eigen::Index row) { return std::isnan(g[row]) ? infinity : g[row]; };
  std::sort(candidates.begin(), candidates.end(), [&](Eigen::Index a, Eigen::Index b) {
    return violation(a) != violation(b) ? violation(a) > violation(b) : a < b;
  });
  const SparseMatrix jacobian = evaluator.inequality_jacobian_rows(x, candidates);
  const double largest_cosine = std::cos(angle);
  Rows chosen;
  Eigen::MatrixXd directions(jacobian.cols(), 64);  // a column for each row taken or in the set, and room for more
  Eigen::Index count = 0;
  Eigen::VectorXd direction(jacobian.cols());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Eigen::Index row = candidates[k];
    const bool member = in_set[static_cast<std::size_t>(row)];
    direction = jacobian.row(static_cast<Eigen::Index>(k)).transpose();
    direction.normalize();
    if (!member && count > 0 && (directions.leftCols(count).transpose() * direction).maxCoeff() > largest_cosine) {
      continue;
    }
    if (count == directions.cols()) directions.conservativeResize(Eigen::NoChange, 2 * count);
    directions.col(count++) = direction;
    if (!member) chosen.push_back(row);
  }
  return chosen;
}

/// The problem with the inequalities of the working set only, through the evaluator of the whole one.
Problem restricted(Evaluator& evaluator, const Rows& rows) {
  Problem problem;
  problem.name = "working set";
  problem.n = evaluator.n();
  problem.lower = evaluator.lower();
  problem.upper = evaluator.upper();
  problem.objective = [&evaluator](const Eigen::VectorXd& x) { return evaluator.objective(x); };
  problem.objective_gradient = [&evaluator](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    gradient = evaluator.objective_gradient(x);
  };
  problem.equalities = evaluator.equalities();
  if (problem.equalities > 0) {
    problem.equality = [&evaluator](const Eigen::VectorXd& x, Eigen::VectorXd& h) { h = evaluator.equality(x); };
    problem.equality_jacobian = [&evaluator](const Eigen::VectorXd& x, SparseMatrix& jacobian) {
      jacobian = evaluator.equality_jacobian(x);
    };
  }
  if (evaluator.has_hessian()) {
    problem.lagrangian_hessian =
        [&evaluator, rows](const Eigen::VectorXd& x, double objective_factor, const Eigen::VectorXd& multipliers,
                           const Eigen::VectorXd& equality_multipliers, SparseMatrix& hessian) {
          Eigen::VectorXd all = Eigen::VectorXd::Zero(evaluator.inequalities());
          all(rows) = multipliers;
          hessian = evaluator.lagrangian_hessian(x, objective_factor, all, equality_multipliers);
        };
  }
  problem.inequalities = static_cast<Eigen::Index>(rows.size());
  if (rows.empty()) return problem;
  problem.inequality = [&evaluator, rows](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    g = evaluator.inequality(x)(rows);
  };
  problem.inequality_jacobian = [&evaluator, rows](const Eigen::VectorXd& x, SparseMatrix& jacobian) {
    jacobian = evaluator.inequality_jacobian_rows(x, rows);
  };
  return problem;
}

}  // namespace

ConstraintExchange::ConstraintExchange(std::shared_ptr<const Solver> solver, ConstraintExchangeOptions options)
    : solver_(std::move(solver)), options_(options) {
  if (!solver_) throw std::invalid_argument("the solver of the constraint exchange is null, but it must be given");
  require(options_.angle > 0.0 && options_.angle < 0.5 * pi, "constraint exchange option angle", options_.angle,
          "above 0 and below pi / 2");
  require(options_.max_rounds >= 1, "constraint exchange option max_rounds", options_.max_rounds, "at least 1");
}

Outcome ConstraintExchange::solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const {
  Options options = evaluator.options();
  // Differences are the evaluator's to take, and it is the evaluator that ends the run.
  options.derivatives = Derivatives::automatic;
  options.difference_step.reset();
  options.max_function_evaluations = std::numeric_limits<long>::max();
  options.stop = nullptr;
  options.record_history = false;
  // That is for the end of the whole run, and this for its start.
  options.check_stationarity = false;
  options.check_derivatives = false;

  std::vector<bool> in_set(static_cast<std::size_t>(evaluator.inequalities()), false);
  Rows rows;
  double last_violation = infinity;
  Outcome outcome{x0, Status::iteration_limit, 0, {}};
  for (int round = 0; round < options_.max_rounds; ++round) {
    const Eigen::VectorXd x = *outcome.x;
    const Eigen::VectorXd& g = evaluator.inequality(x);
    Rows candidates;
    double violation = 0.0;
    bool any_new = round == 0;
    for (Eigen::Index row = 0; row < g.size(); ++row) {
      const bool violated = !(g[row] <= options.feasibility_tolerance);
      if (violated) violation = std::isnan(g[row]) ? infinity : std::max(violation, g[row]);
      if (violated || round == 0) candidates.push_back(row);
      any_new = any_new || (violated && !in_set[static_cast<std::size_t>(row)]);
    }
    if (!any_new) return outcome;
    const Rows joining = choose(std::move(candidates), in_set, evaluator, x, options_.angle);
    if (round > 0 && joining.empty()) {
      const bool goes_on = outcome.status == Status::iteration_limit && violation < worthwhile * last_violation;
      if (!goes_on) return outcome;
    }
    last_violation = violation;
    for (const Eigen::Index row : joining) {
      in_set[static_cast<std::size_t>(row)] = true;
      rows.push_back(row);
    }
    std::sort(rows.begin(), rows.end());
    Result result = solver_->minimize(restricted(evaluator, rows), x, options);
    outcome = {std::move(result.x), result.status, result.solver_code, std::move(result.message)};
  }
  return {outcome.x, Status::iteration_limit, 0, "the limit on rounds of the constraint exchange was reached"};
}

}  // namespace reprise
