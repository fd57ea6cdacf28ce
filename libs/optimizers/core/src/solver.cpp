#include "reprise/optimizers/solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "reprise/base/require.hpp"
#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/tolerances.hpp"
#include "short_text.hpp"

namespace reprise {
namespace {

constexpr int message_digits = 3;

void validate(const Options& options) {
  if (const std::optional<double>& step = options.difference_step) {
    require(*step > 0.0 && std::isfinite(*step), "difference_step", *step, "positive and finite");
  }
  require(options.feasibility_tolerance >= 0.0, "feasibility_tolerance", options.feasibility_tolerance, "at least 0");
  require(options.max_function_evaluations >= 1, "max_function_evaluations", options.max_function_evaluations,
          "at least 1");
}

void validate_start(const Problem& problem, const Eigen::VectorXd& x0) {
  if (x0.size() != problem.n) {
    throw std::invalid_argument("the start has " + std::to_string(x0.size()) + " entries, but problem '" +
                                problem.name + "' has " + std::to_string(problem.n) + " variables");
  }
  if (!x0.allFinite()) {
    throw std::invalid_argument("the start of problem '" + problem.name + "' has an entry that is not finite");
  }
}

/// What is to be said of a derivative at the start that is not that of its function, if there is one.
std::optional<Outcome> wrong_derivative(const Problem& problem, const Eigen::VectorXd& start) {
  const DerivativeReport report = check_derivatives(problem, start);
  const auto failed =
      std::find_if(report.checks.begin(), report.checks.end(), [](const DerivativeCheck& one) { return !one.passed; });
  if (failed == report.checks.end()) return std::nullopt;
  return Outcome{std::nullopt, Status::wrong_derivative, 0,
                 "a wrong derivative at the start, " + failed->function + ": it is " +
                     short_text(std::max(failed->coordinate_error, failed->direction_error), message_digits) +
                     " away from differences, and the Taylor remainder is of order " +
                     short_text(failed->remainder_order, message_digits)};
}

/// Where a run ends. A method's own test is met at a point of its own; any other end is no better than the best iterate
/// before it.
Iterate end_of(const Outcome& outcome, Evaluator& evaluator) {
  const bool by_own_test = outcome.status == Status::converged || outcome.status == Status::unbounded;
  const bool has_point = outcome.x && outcome.x->allFinite();
  const std::optional<Iterate>& best = evaluator.record().best();
  if (best && !(by_own_test && has_point)) return *best;
  return evaluator.settle(has_point ? outcome.x : std::nullopt);
}

}  // namespace

Result Solver::minimize(const Problem& problem, const Eigen::VectorXd& x0, const Options& options,
                        const Observer& observer) const {
  reprise::validate(problem);
  validate(options);
  validate_start(problem, x0);
  if (problem.equalities > 0 && !handles_equalities()) {
    throw std::invalid_argument("problem '" + problem.name + "' has " + std::to_string(problem.equalities) +
                                " equality constraints, but " + name() + " takes inequalities only");
  }

  Eigen::VectorXd start = x0;
  if (problem.lower.size() != 0) start = start.cwiseMax(problem.lower);
  if (problem.upper.size() != 0) start = start.cwiseMin(problem.upper);
  Evaluator evaluator(problem, start, options, observer, derivative_free());
  const std::optional<Outcome> wrong =
      options.check_derivatives ? wrong_derivative(problem, start) : std::optional<Outcome>();
  // One run from a start in the free variables, and what is to be said of its end.
  const auto run_from = [&](const Eigen::VectorXd& from) {
    Outcome outcome;
    try {
      if (wrong) {
        outcome = *wrong;
      } else if (evaluator.n() == 0) {
        outcome = {from, Status::converged, 0, "every variable is fixed by its bounds"};
      } else {
        outcome = solve(evaluator, from);
      }
    } catch (const StopRequest& request) {
      // It may come from a run that this one is part of.
      if (request.problem != &problem) throw;
      outcome = {std::nullopt, request.status, 0, request.reason};
    }

    Iterate end = end_of(outcome, evaluator);
    Result result;
    result.x = std::move(end.x);
    result.f = end.f;
    result.violation = end.violation;
    result.status = outcome.status;
    result.solver_code = outcome.code;
    result.message = std::move(outcome.message);

    if (!std::isfinite(result.f) && result.status == Status::converged) {
      result.status = result.f < 0.0 ? Status::unbounded : Status::numerical_failure;
      result.message += " (but the objective is not finite there)";
    } else if (std::isnan(result.violation) && result.status == Status::converged) {
      result.status = Status::numerical_failure;
      result.message += " (but a constraint is not a number there)";
    } else if (result.status == Status::converged && !(result.violation <= options.feasibility_tolerance)) {
      result.status = Status::infeasible;
      result.message += " (but a constraint is violated there)";
    } else if (result.status == Status::infeasible && result.violation <= options.feasibility_tolerance) {
      result.status = Status::numerical_failure;
      result.message += " (but a feasible point was found)";
    } else if (result.status == Status::converged && problem.smooth && options.check_stationarity &&
               evaluator.n() > 0) {
      result.kkt_residual = kkt_residual(problem, result.x);
      if (result.kkt_residual > largest_kkt_residual) {
        result.status = Status::not_stationary;
        result.message += " (but the conditions of optimality do not hold there: their residual is " +
                          short_text(result.kkt_residual, message_digits) + ")";
      }
    }
    return result;
  };

  Result result;
  for (int restarts = 0;; ++restarts) {
    Result next = run_from(evaluator.gather(start));
    // A run that goes on where another ended is to lead further, or else the other's end counts.
    const bool further = restarts == 0 || next.status == Status::converged ||
                         is_better(next.f, next.violation, result.f, result.violation, options.feasibility_tolerance);
    const bool moved = next.x != start;
    if (further) result = std::move(next);
    if (result.status != Status::not_stationary || !further || !moved || restarts == most_restarts) break;
    start = result.x;
  }
  result.counts = evaluator.counts();
  result.iterates = evaluator.record().size();
  result.history = evaluator.record().take_history();
  return result;
}

}  // namespace reprise
