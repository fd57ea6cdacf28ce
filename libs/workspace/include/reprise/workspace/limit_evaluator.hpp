#pragma once

// Counted evaluations of limits.

#include <Eigen/Core>
#include <cstddef>

#include "reprise/workspace/limits.hpp"

namespace reprise {

/// All limits at one point.
struct LimitEvaluation {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< u
  double largest = 0.0;                                ///< max_j h_j; +infinity when a value is NaN
  Eigen::VectorXd h;                                   ///< length count()
};

/// Evaluates limits and counts. Allocates nothing after construction.
class LimitEvaluator {
 public:
  /// Keeps a reference to the limits, which must outlive it.
  explicit LimitEvaluator(const Limits& limits);

  /// Evaluates all limits at u, which counts as one evaluation, and returns the largest.
  double largest(const Eigen::Vector2d& u);

  /// h_j at the last point evaluated.
  const Eigen::VectorXd& values() const { return last_.h; }

  /// Copies the evaluation at u, which costs none if u is the last point or the one nearest to the boundary.
  void evaluate(const Eigen::Vector2d& u, LimitEvaluation& result);

  /// dh_j/du, counted as one gradient.
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j);

  /// Forgets the point nearest to the boundary, that is, with the smallest |max_j h_j|, so that a new search begins.
  void begin_search() { has_nearest_ = false; }

  const Limits& limits() const { return limits_; }  ///< as they were given
  /// Number of points at which all limits were evaluated.
  std::size_t evaluations() const { return evaluations_; }
  /// Number of gradients of a single limit.
  std::size_t gradients() const { return gradients_; }

 private:
  const Limits& limits_;
  LimitEvaluation last_;
  LimitEvaluation nearest_;
  bool has_nearest_ = false;
  std::size_t evaluations_ = 0;
  std::size_t gradients_ = 0;
};

}  // namespace reprise
