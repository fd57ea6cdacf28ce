#pragma once

// Counted evaluations of limits.

#include <Eigen/Core>
#include <cstddef>

#include "reprise/workspace/limits.hpp"

namespace reprise {

/// Evaluates limits and counts. Keeps the values of its last evaluation, and allocates nothing after construction.
class LimitEvaluator {
 public:
  explicit LimitEvaluator(const Limits& limits) : limits_(limits), values_(limits.count()) {}

  /// Evaluates all limits at u and returns the largest; a NaN among them counts as +infinity.
  double largest(const Eigen::Vector2d& u);

  /// h_j at the last point evaluated.
  const Eigen::VectorXd& values() const { return values_; }

  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j);

  const Limits& limits() const { return limits_; }
  /// Number of points at which all limits were evaluated.
  std::size_t evaluations() const { return evaluations_; }
  /// Number of gradients of a single limit.
  std::size_t gradients() const { return gradients_; }

 private:
  const Limits& limits_;
  Eigen::VectorXd values_;
  std::size_t evaluations_ = 0;
  std::size_t gradients_ = 0;
};

}  // namespace reprise
