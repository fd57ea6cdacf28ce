#include "reprise/optimizers/dynamic_q.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "reprise/optimizers/evaluator.hpp"

namespace reprise {
namespace {

/// Values and gradients of a group of functions at an iterate.
struct Sample {
  Eigen::VectorXd value;
  Eigen::MatrixXd gradient;
};

/// The spherical quadratic of each function at the iterate that also meets it at the previous iterate, a step away.
SphericalQuadratics approximate(const Sample& here, const Eigen::VectorXd* previous_value,
                                const Eigen::VectorXd& back) {
  SphericalQuadratics result{here.value, here.gradient, Eigen::VectorXd::Zero(here.value.size())};
  if (previous_value != nullptr) {
    result.curvature = 2.0 * (*previous_value - here.value - here.gradient * back) / back.squaredNorm();
  }
  return result;
}

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

void require(bool allowed, const char* name, double value, const char* range) {
  if (!allowed) {
    throw std::invalid_argument(std::string("Dynamic-Q option ") + name + " is " + std::to_string(value) +
                                ", but it must be " + range);
  }
}

/// f below this, or |x| above its negative, is called unbounded.
constexpr double unbounded_value = -1e20;

}  // namespace

DynamicQ::DynamicQ(DynamicQOptions options) : options_(std::move(options)) {
  require(options_.move_limit > 0.0 && std::isfinite(options_.move_limit), "move_limit", options_.move_limit,
          "positive and finite");
  require(options_.step_tolerance > 0.0, "step_tolerance", options_.step_tolerance, "positive");
  require(options_.value_tolerance >= 0.0, "value_tolerance", options_.value_tolerance, "at least 0");
  require(options_.max_iterations >= 1, "max_iterations", static_cast<double>(options_.max_iterations), "at least 1");
  require(options_.max_halvings >= 0, "max_halvings", options_.max_halvings, "at least 0");
}

Outcome DynamicQ::solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const {
  Iteration current;
  current.x = x0;
  evaluate_values(evaluator, current);
  Iteration previous;
  bool has_previous = false;
  double best_feasible = std::numeric_limits<double>::infinity();

  for (long iteration = 0; iteration < options_.max_iterations; ++iteration) {
    evaluate_gradients(evaluator, current);
    if (!current.finite() || !current.finite_gradients()) {
      return {std::nullopt, Status::numerical_failure, 3, "a function or gradient is not finite at an iterate"};
    }
    const double f = current.objective.value[0];
    if (f < unbounded_value || current.x.norm() > -unbounded_value) {
      return {current.x, Status::unbounded, 4, "the objective or the point grows without limit"};
    }
    const bool feasible = evaluator.violation(current.x) <= evaluator.options().feasibility_tolerance;
    if (has_previous) {
      const double step = (current.x - previous.x).norm() / (1.0 + current.x.norm());
      if (step < options_.step_tolerance) {
        return {std::nullopt, Status::converged, 0, "the step is below eps_x"};
      }
      if (feasible && std::abs(f - best_feasible) / (1.0 + std::abs(best_feasible)) < options_.value_tolerance) {
        return {std::nullopt, Status::converged, 1, "the change of the best feasible value is below eps_f"};
      }
    }
    if (feasible) best_feasible = std::min(best_feasible, f);

    const Eigen::VectorXd back = has_previous ? Eigen::VectorXd(previous.x - current.x) : Eigen::VectorXd();
    SphericalProgram program;
    const auto build = [&](const Sample& here, const Sample& before) {
      return approximate(here, has_previous ? &before.value : nullptr, back);
    };
    program.objective = build(current.objective, previous.objective);
    program.inequality = build(current.inequality, previous.inequality);
    program.equality = build(current.equality, previous.equality);
    program.move_limit = options_.move_limit;
    program.lower = evaluator.lower() - current.x;
    program.upper = evaluator.upper() - current.x;
    Eigen::VectorXd step = lfopc(program, options_.lfopc).step;

    previous = current;
    has_previous = true;
    for (int halvings = 0;; ++halvings) {
      current.x = (previous.x + step).cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper());
      evaluate_values(evaluator, current);
      if (current.finite()) break;
      if (halvings == options_.max_halvings) {
        return {std::nullopt, Status::numerical_failure, 3, "no finite value was found along the step"};
      }
      step *= 0.5;
    }
    if (current.x == previous.x) return {std::nullopt, Status::converged, 0, "the step is below eps_x"};
  }
  return {std::nullopt, Status::iteration_limit, 2, "the limit on iterations was reached"};
}

}  // namespace reprise
