#include "reprise/optimizers/check_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

namespace reprise {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

using Vector = Eigen::VectorXd;
/// A family of scalar functions evaluated together.
using VectorFunction = std::function<void(const Vector& x, Vector& values)>;

/// Step along a unit direction that moves each coordinate by at most `relative` times max(1, |x_i|).
double step_along(const Vector& direction, const Vector& x, double relative) {
  double step = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (direction[i] != 0.0) step = std::min(step, relative * std::max(1.0, std::abs(x[i])) / std::abs(direction[i]));
  }
  return step;
}

/// Central difference of all functions along a unit direction.
Vector directional_difference(const VectorFunction& function, Eigen::Index count, const Vector& x,
                              const Vector& direction) {
  const double step = step_along(direction, x, std::cbrt(epsilon));
  Vector above(count);
  Vector below(count);
  function(x + step * direction, above);
  function(x - step * direction, below);
  return (above - below) / (2.0 * step);
}

/// Slope of log remainder over log step along a direction, for each function, at the shortest steps whose remainders
/// stand clear of rounding; infinity where fewer than two do. Steps where a function is not finite are left out.
Vector remainder_orders(const VectorFunction& function, const Vector& x, const Eigen::MatrixXd& jacobian) {
  constexpr int steps = 12;
  constexpr double ratio = 4.0;
  // A direction with no symmetry, so that no term of the expansion vanishes by accident.
  Vector direction(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) direction[i] = std::cos(1.0 + 2.0 * static_cast<double>(i));
  direction.normalize();
  const Vector slope = jacobian * direction;
  // The size of a function's terms, which may cancel in its value.
  const Vector terms = jacobian.cwiseAbs() * x.cwiseAbs();
  Vector base(jacobian.rows());
  Vector moved(jacobian.rows());
  function(x, base);
  Vector orders = Vector::Constant(jacobian.rows(), std::numeric_limits<double>::infinity());
  Vector last_remainder = Vector::Constant(jacobian.rows(), std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> drowned(static_cast<std::size_t>(jacobian.rows()), false);
  // Short enough for the second order to show above the third, and the steps after it above rounding.
  constexpr double first_step = 1e-2;
  double step = step_along(direction, x, first_step);
  for (int k = 0; k < steps; ++k, step /= ratio) {
    function(x + step * direction, moved);
    for (Eigen::Index row = 0; row < orders.size(); ++row) {
      const auto index = static_cast<std::size_t>(row);
      const double remainder = std::abs(moved[row] - base[row] - step * slope[row]);
      const double rounding = 1e4 * epsilon * std::max({1.0, std::abs(base[row]), std::abs(moved[row]), terms[row]});
      if (remainder <= rounding) drowned[index] = true;
      if (drowned[index]) continue;
      if (std::isfinite(last_remainder[row]) && std::isfinite(remainder)) {
        orders[row] = std::log(last_remainder[row] / remainder) / std::log(ratio);
      }
      last_remainder[row] = remainder;
    }
  }
  return orders;
}

void check(const VectorFunction& function, const Eigen::MatrixXd& jacobian, const Vector& x, double tolerance,
           const std::function<std::string(Eigen::Index)>& name, std::vector<DerivativeCheck>& checks) {
  const Eigen::Index count = jacobian.rows();
  Eigen::MatrixXd differences(count, x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    differences.col(i) = directional_difference(function, count, x, Vector::Unit(x.size(), i));
  }
  const Vector orders = remainder_orders(function, x, jacobian);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector gradient = jacobian.row(k);
    const double scale = std::max(1.0, gradient.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
    DerivativeCheck result;
    result.function = name(k);
    result.coordinate_error =
        (gradient - differences.row(k).transpose()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / scale;
    const double length = gradient.norm();
    if (length > 0.0) {
      const double along = directional_difference(function, count, x, gradient / length)[k];
      result.direction_error = std::abs(along - length) / scale;
    }
    result.remainder_order = orders[k];
    // Written so that a NaN anywhere fails.
    result.passed = result.coordinate_error <= tolerance && result.direction_error <= tolerance &&
                    result.remainder_order >= least_remainder_order;
    checks.push_back(std::move(result));
  }
}

}  // namespace

bool DerivativeReport::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const DerivativeCheck& one) { return one.passed; });
}

DerivativeReport check_derivatives(const Problem& problem, const Vector& x, double tolerance) {
  validate(problem);
  if (x.size() != problem.n || !x.allFinite()) {
    throw std::invalid_argument("x has " + std::to_string(x.size()) + " entries, but problem '" + problem.name +
                                "' needs " + std::to_string(problem.n) + " finite ones");
  }
  DerivativeReport report;
  const auto numbered = [](const char* kind) {
    return [kind](Eigen::Index k) { return std::string(kind) + " " + std::to_string(k + 1); };
  };
  if (problem.objective_gradient) {
    Vector gradient(problem.n);
    problem.objective_gradient(x, gradient);
    check([&](const Vector& at, Vector& value) { value.setConstant(1, problem.objective(at)); }, gradient.transpose(),
          x, tolerance, [](Eigen::Index) { return "objective"; }, report.checks);
  }
  if (problem.inequality_jacobian) {
    SparseMatrix jacobian(problem.inequalities, problem.n);
    problem.inequality_jacobian(x, jacobian);
    check(problem.inequality, jacobian, x, tolerance, numbered("inequality"), report.checks);
  }
  if (problem.equality_jacobian) {
    SparseMatrix jacobian(problem.equalities, problem.n);
    problem.equality_jacobian(x, jacobian);
    check(problem.equality, jacobian, x, tolerance, numbered("equality"), report.checks);
  }
  // The Hessian is checked as the Jacobian of the Lagrangian's gradient, which needs all first derivatives.
  const bool has_gradients = problem.objective_gradient && (!problem.inequality || problem.inequality_jacobian) &&
                             (!problem.equality || problem.equality_jacobian);
  if (problem.lagrangian_hessian && has_gradients) {
    // Unequal multipliers, so that no two terms can stand in for each other.
    const Vector lambda = Vector::LinSpaced(problem.inequalities, 0.5, 1.5);
    const Vector mu = Vector::LinSpaced(problem.equalities, -1.25, 0.75);
    const double factor = 0.75;
    const auto lagrangian_gradient = [&](const Vector& at, Vector& value) {
      value.resize(problem.n);
      problem.objective_gradient(at, value);
      value *= factor;
      if (problem.inequality) {
        SparseMatrix jacobian(problem.inequalities, problem.n);
        problem.inequality_jacobian(at, jacobian);
        value += jacobian.transpose() * lambda;
      }
      if (problem.equality) {
        SparseMatrix jacobian(problem.equalities, problem.n);
        problem.equality_jacobian(at, jacobian);
        value += jacobian.transpose() * mu;
      }
    };
    SparseMatrix lower(problem.n, problem.n);
    problem.lagrangian_hessian(x, factor, lambda, mu, lower);
    const Eigen::MatrixXd dense = lower;
    const Eigen::MatrixXd hessian = dense.selfadjointView<Eigen::Lower>();
    check(lagrangian_gradient, hessian, x, tolerance, numbered("lagrangian hessian, column"), report.checks);
  }
  return report;
}

}  // namespace reprise
