#include "reprise/optimizers/solver.hpp"

#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/kkt_residual.hpp"

namespace reprise {
namespace {

/// How often a run goes on from an end that is no optimum though the solver says so.
constexpr int most_restarts = 5;

std::string to_text(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << value;
  return text.str();
}

void validate(const Options& options) {
  if (options.difference_step && !(*options.difference_step > 0.0 && std::isfinite(*options.difference_step))) {
    throw std::invalid_argument("difference_step is " + std::to_string(*options.difference_step) +
                                ", but it must be positive and finite");
  }
  if (!(options.feasibility_tolerance >= 0.0)) {
    throw std::invalid_argument("feasibility_tolerance is " + std::to_string(options.feasibility_tolerance) +
                                ", but it must not be negative");
  }
  if (options.max_function_evaluations < 1) {
    throw std::invalid_argument("max_function_evaluations is " + std::to_string(options.max_function_evaluations) +
                                ", but it must be at least 1");
  }
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
  // One run from a start in the free variables, and what is to be said of its end.
  const auto run_from = [&](const Eigen::VectorXd& from) {
    Outcome outcome;
    const bool ended = evaluator.attempt([&] {
      if (evaluator.n() == 0) {
        outcome = {from, Status::converged, 0, "every variable is fixed by its bounds"};
      } else {
        outcome = solve(evaluator, from);
      }
    });
    if (!ended) {
      try {
        std::rethrow_exception(evaluator.pending_);
      } catch (const StopRequest&) {
        // Without a reason of its own it comes from a run that this one is part of.
        if (!evaluator.stop_status_) throw;
        outcome = {std::nullopt, *evaluator.stop_status_, 0, evaluator.stop_reason_};
      }
    }

    // A method's own test is met at a point of its own; any other end is no better than the best point before it.
    const bool by_own_test = outcome.status == Status::converged || outcome.status == Status::unbounded;
    Iterate end = evaluator.settle(outcome.x, !by_own_test);
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
                          to_text(result.kkt_residual) + ")";
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
  result.counts = evaluator.counts_;
  result.history = std::move(evaluator.history_);
  return result;
}

}  // namespace reprise
