#include "reprise/optimizers/dynamic_q.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "reprise/base/require.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/tolerances.hpp"

namespace reprise {
namespace {

/// Values and gradients of a group of functions at an iterate.
struct Sample {
  Eigen::VectorXd value;
  Eigen::MatrixXd gradient;
};

/// All functions at one point.
struct Iteration {
  Eigen::VectorXd x;
  Sample objective, inequality, equality;

  bool finite() const {
    return objective.value.allFinite() && inequality.value.allFinite() && equality.value.allFinite();
  }
  bool finite_gradients() const {
    return objective.gradient.allFinite() && inequality.gradient.allFinite() && equality.gradient.allFinite();
  }
};

void evaluate_values(Evaluator& evaluator, Iteration& at) {
  at.objective.value.setConstant(1, evaluator.objective(at.x));
  at.inequality.value = evaluator.inequality(at.x);
  at.equality.value = evaluator.equality(at.x);
}

void evaluate_gradients(Evaluator& evaluator, Iteration& at) {
  at.objective.gradient = evaluator.objective_gradient(at.x).transpose();
  at.inequality.gradient = evaluator.inequality_jacobian(at.x);
  at.equality.gradient = evaluator.equality_jacobian(at.x);
}

/// The spherical quadratic of each function at the iterate that also meets it at another point, in variables measured
/// in the given units. `back` leads to that point; without it the curvature is zero.
SphericalQuadratics approximate(const Sample& here, const Eigen::VectorXd& units, const Eigen::VectorXd* other_value,
                                const Eigen::VectorXd& back) {
  SphericalQuadratics result{here.value, here.gradient * units.asDiagonal(), Eigen::VectorXd::Zero(here.value.size())};
  if (other_value != nullptr) {
    result.curvature = 2.0 * (*other_value - here.value - result.gradient * back) / back.squaredNorm();
  }
  return result;
}

SphericalProgram approximate(const Iteration& here, const std::optional<Iteration>& other, const Eigen::VectorXd& units,
                             double move_limit, const Evaluator& evaluator) {
  const Eigen::VectorXd back = other ? Eigen::VectorXd((other->x - here.x).cwiseQuotient(units)) : Eigen::VectorXd();
  const auto build = [&](Sample Iteration::*group) {
    return approximate(here.*group, units, other ? &((*other).*group).value : nullptr, back);
  };
  SphericalProgram program;
  program.objective = build(&Iteration::objective);
  program.inequality = build(&Iteration::inequality);
  program.equality = build(&Iteration::equality);
  program.move_limit = move_limit;
  program.lower = (evaluator.lower() - here.x).cwiseQuotient(units);
  program.upper = (evaluator.upper() - here.x).cwiseQuotient(units);
  return program;
}

/// Objective and violations at a point.
struct Standing {
  double f = 0.0;
  Eigen::VectorXd inequality, equality;

  static Standing of(double f, const Eigen::VectorXd& g, const Eigen::VectorXd& h) {
    return {f, g.cwiseMax(0.0), h.cwiseAbs()};
  }
};

Standing standing(const Iteration& at) {
  return Standing::of(at.objective.value[0], at.inequality.value, at.equality.value);
}

/// What the approximations promise.
Standing promised(const SphericalProgram& program, const Eigen::VectorXd& step) {
  const double half_square = 0.5 * step.squaredNorm();
  const auto evaluate = [&](const SphericalQuadratics& functions) -> Eigen::VectorXd {
    return functions.value + functions.gradient * step + half_square * functions.curvature;
  };
  return Standing::of(evaluate(program.objective)[0], evaluate(program.inequality), evaluate(program.equality));
}

/// Decides which steps are taken; see SafeguardOptions.
class Safeguard {
 public:
  explicit Safeguard(const SafeguardOptions& options) : options_(options) {}

  void add_iterate(const Iteration& at) {
    last_.push_back(standing(at));
    if (static_cast<int>(last_.size()) > options_.memory) last_.pop_front();
  }

  bool accepts(const SphericalProgram& program, const SphericalDualResult& solution, const Iteration& next) {
    const auto inverse_lengths = [](const SphericalQuadratics& functions) -> Eigen::VectorXd {
      return functions.gradient.rowwise().norm().cwiseMax(1e-12).cwiseInverse();
    };
    const auto renew = [this](Eigen::VectorXd& weights, const Eigen::VectorXd& multipliers) {
      if (weights.size() == 0) weights = Eigen::VectorXd::Zero(multipliers.size());
      weights = (options_.forgetting * weights).cwiseMax(options_.weight * multipliers.cwiseAbs());
    };
    const Eigen::VectorXd inequality_units = inverse_lengths(program.inequality);
    const Eigen::VectorXd equality_units = inverse_lengths(program.equality);
    if (!solution.relaxed) {
      renew(inequality_weights_, solution.inequality_multipliers);
      renew(equality_weights_, solution.equality_multipliers);
    }
    const auto merit = [&](const Standing& at) {
      if (!solution.relaxed) {
        return at.f + inequality_weights_.dot(at.inequality) + equality_weights_.dot(at.equality);
      }
      double largest = 0.0;
      if (at.inequality.size() > 0) largest = at.inequality.cwiseProduct(inequality_units).maxCoeff();
      if (at.equality.size() > 0) largest = std::max(largest, at.equality.cwiseProduct(equality_units).maxCoeff());
      return largest;
    };
    double reference = -std::numeric_limits<double>::infinity();
    for (const Standing& one : last_) reference = std::max(reference, merit(one));
    const double predicted = merit(last_.back()) - merit(promised(program, solution.step));
    return merit(standing(next)) <= reference - options_.decrease * std::max(predicted, 0.0);
  }

 private:
  const SafeguardOptions& options_;
  std::deque<Standing> last_;
  Eigen::VectorXd inequality_weights_, equality_weights_;
};

/// One run of the method: its iterate, and what it remembers of the ones before.
class Run {
 public:
  Run(const DynamicQOptions& options, Evaluator& evaluator, const Eigen::VectorXd& start)
      : options_(options),
        evaluator_(evaluator),
        units_(options.scale_variables ? start.cwiseAbs().cwiseMax(1.0) : Eigen::VectorXd::Ones(start.size()).eval()),
        safeguard_(options.safeguard),
        move_limit_(options.move_limit) {
    current_.x = start;
    evaluate_values(evaluator_, current_);
  }

  Outcome outcome() {
    for (long iteration = 0; iteration < options_.max_iterations; ++iteration) {
      evaluate_gradients(evaluator_, current_);
      if (const std::optional<Outcome> end = judge()) return *end;
      if (const std::optional<Outcome> end = advance()) return *end;
    }
    return {std::nullopt, Status::iteration_limit, 2, "the limit on iterations was reached"};
  }

 private:
  /// Whether the run ends at the iterate.
  std::optional<Outcome> judge() {
    if (!current_.finite() || !current_.finite_gradients()) {
      return Outcome{std::nullopt, Status::numerical_failure, 3, "a function or gradient is not finite at an iterate"};
    }
    const double f = current_.objective.value[0];
    if (evaluator_.objective_unit() * f < -unbounded_size || current_.x.norm() > unbounded_size) {
      return Outcome{current_.x, Status::unbounded, 4, "the objective or the point grows without limit"};
    }
    const bool feasible = evaluator_.violation(current_.x) <= evaluator_.options().feasibility_tolerance;
    if (previous_x_) {
      if (is_short(current_.x - *previous_x_, current_.x)) return step_is_short();
      if (feasible && !at_limit_ &&
          std::abs(f - best_feasible_) / (1.0 + std::abs(best_feasible_)) < options_.value_tolerance) {
        return Outcome{std::nullopt, Status::converged, 1, "the change of the best feasible value is below eps_f"};
      }
    }
    if (feasible) best_feasible_ = std::min(best_feasible_, f);
    return std::nullopt;
  }

  /// Goes to the next iterate, the solution of the approximations; with the safeguard, a step that is refused is tried
  /// again within half its length. Returns how the run ends where there is no next iterate.
  std::optional<Outcome> advance() {
    if (options_.safeguard.active) safeguard_.add_iterate(current_);
    Iteration next;
    double limit = move_limit_;
    for (int refusals = 0;; ++refusals) {
      const SphericalProgram program = approximate(current_, other_, units_, limit, evaluator_);
      SphericalDualResult solution;
      if (options_.subproblem == SubproblemSolver::dual) {
        solution = solve_dual(program, options_.dual);
      } else {
        solution.step = lfopc(program, options_.lfopc).step;
      }
      if (!follow(solution.step, next)) {
        return Outcome{std::nullopt, Status::numerical_failure, 3, "no finite value was found along the step"};
      }
      if (next.x == current_.x) return step_is_short();
      constexpr double nearly = 0.99;
      const double length = solution.step.norm();
      at_limit_ = length >= nearly * limit;
      if (!options_.safeguard.active) break;
      if (safeguard_.accepts(program, solution, next)) {
        const bool went_far = refusals == 0 && at_limit_;
        const double growth = options_.safeguard.growth;
        move_limit_ = went_far ? move_limit_ * growth : std::max(options_.move_limit, move_limit_ / growth);
        break;
      }
      if (refusals == options_.max_halvings || is_short(next.x - current_.x, current_.x)) return step_is_short();
      limit = 0.5 * std::min(limit, length);
      other_ = next;
    }
    previous_x_ = current_.x;
    other_ = std::move(current_);
    current_ = std::move(next);
    return std::nullopt;
  }

  /// Evaluates the point that a step leads to, within the bounds; the step is halved while a value there is not finite.
  /// False where max_halvings do not help.
  bool follow(Eigen::VectorXd& step, Iteration& next) {
    for (int halvings = 0;; ++halvings) {
      next.x = (current_.x + units_.cwiseProduct(step)).cwiseMax(evaluator_.lower()).cwiseMin(evaluator_.upper());
      evaluate_values(evaluator_, next);
      if (next.finite()) return true;
      if (halvings == options_.max_halvings) return false;
      step *= 0.5;
    }
  }

  /// Whether a step from x is below eps_x.
  bool is_short(const Eigen::VectorXd& step, const Eigen::VectorXd& x) const {
    return step.cwiseQuotient(units_).norm() / (1.0 + x.cwiseQuotient(units_).norm()) < options_.step_tolerance;
  }
  static Outcome step_is_short() { return {std::nullopt, Status::converged, 0, "the step is below eps_x"}; }

  const DynamicQOptions& options_;
  Evaluator& evaluator_;
  Eigen::VectorXd units_;
  Safeguard safeguard_;
  double move_limit_;
  Iteration current_;
  /// The second point that the approximations meet: the previous iterate, or a point that the safeguard refused.
  std::optional<Iteration> other_;
  std::optional<Eigen::VectorXd> previous_x_;
  bool at_limit_ = false;  ///< the last step was cut by the move limit
  double best_feasible_ = std::numeric_limits<double>::infinity();
};

}  // namespace

DynamicQ::DynamicQ(DynamicQOptions options) : options_(std::move(options)) {
  require(options_.move_limit > 0.0 && std::isfinite(options_.move_limit), "Dynamic-Q option move_limit",
          options_.move_limit, "positive and finite");
  require(options_.step_tolerance > 0.0, "Dynamic-Q option step_tolerance", options_.step_tolerance, "positive");
  require(options_.value_tolerance >= 0.0, "Dynamic-Q option value_tolerance", options_.value_tolerance, "at least 0");
  require(options_.max_iterations >= 1, "Dynamic-Q option max_iterations", options_.max_iterations, "at least 1");
  require(options_.max_halvings >= 0, "Dynamic-Q option max_halvings", options_.max_halvings, "at least 0");
  const SafeguardOptions& safeguard = options_.safeguard;
  require(!safeguard.active || options_.subproblem == SubproblemSolver::dual, "Dynamic-Q option safeguard.active", 1.0,
          "false with LFOPC, which gives no multipliers");
  require(safeguard.memory >= 1, "Dynamic-Q option safeguard.memory", safeguard.memory, "at least 1");
  require(safeguard.weight >= 1.0, "Dynamic-Q option safeguard.weight", safeguard.weight, "at least 1");
  require(safeguard.forgetting >= 0.0 && safeguard.forgetting <= 1.0, "Dynamic-Q option safeguard.forgetting",
          safeguard.forgetting, "from 0 to 1");
  require(safeguard.decrease >= 0.0 && safeguard.decrease < 1.0, "Dynamic-Q option safeguard.decrease",
          safeguard.decrease, "at least 0 and below 1");
  require(safeguard.growth >= 1.0, "Dynamic-Q option safeguard.growth", safeguard.growth, "at least 1");
}

std::string DynamicQ::name() const {
  if (options_.safeguard.active) return "dynamic_q_safeguarded";
  return options_.subproblem == SubproblemSolver::dual ? "dynamic_q_dual" : "dynamic_q";
}

Outcome DynamicQ::solve(Evaluator& evaluator, const Eigen::VectorXd& given_start) const {
  const Eigen::VectorXd start =
      evaluator.measure(given_start, {.variables = false, .slope = options_.scale_objective ? 1.0 : 0.0});
  return Run(options_, evaluator, start).outcome();
}

}  // namespace reprise
