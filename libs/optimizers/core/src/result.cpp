#include "reprise/optimizers/result.hpp"

#include <algorithm>

namespace reprise {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::infeasible:
      return "infeasible";
    case Status::unbounded:
      return "unbounded";
    case Status::iteration_limit:
      return "iteration_limit";
    case Status::evaluation_limit:
      return "evaluation_limit";
    case Status::stopped:
      return "stopped";
    case Status::numerical_failure:
      return "numerical_failure";
    case Status::not_stationary:
      return "not_stationary";
    case Status::wrong_derivative:
      return "wrong_derivative";
  }
  return "unknown";
}

long Counts::function_evaluations() const { return std::max({objective, inequality, equality}); }

long Counts::gradient_evaluations() const {
  return std::max({objective_gradient, inequality_jacobian, equality_jacobian});
}

Counts& Counts::operator+=(const Counts& other) {
  objective += other.objective;
  inequality += other.inequality;
  equality += other.equality;
  objective_gradient += other.objective_gradient;
  inequality_jacobian += other.inequality_jacobian;
  equality_jacobian += other.equality_jacobian;
  lagrangian_hessian += other.lagrangian_hessian;
  return *this;
}

}  // namespace reprise
