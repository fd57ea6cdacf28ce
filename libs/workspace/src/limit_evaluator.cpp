#include "reprise/workspace/limit_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reprise {

LimitEvaluator::LimitEvaluator(const Limits& limits) : limits_(limits) {
  last_.h.resize(limits.count());
  nearest_.h.resize(limits.count());
}

double LimitEvaluator::largest(const Eigen::Vector2d& u) {
  limits_.evaluate(u, last_.h);
  ++evaluations_;
  last_.position = u;
  last_.largest = -std::numeric_limits<double>::infinity();
  for (const double value : last_.h) {
    last_.largest = std::isnan(value) ? std::numeric_limits<double>::infinity() : std::max(last_.largest, value);
  }
  if (!has_nearest_ || std::abs(last_.largest) < std::abs(nearest_.largest)) {
    nearest_ = last_;
    has_nearest_ = true;
  }
  return last_.largest;
}

void LimitEvaluator::evaluate(const Eigen::Vector2d& u, LimitEvaluation& result) {
  if (has_nearest_ && nearest_.position == u) {
    result = nearest_;
    return;
  }
  if (evaluations_ == 0 || last_.position != u) largest(u);
  result = last_;
}

Eigen::Vector2d LimitEvaluator::gradient(const Eigen::Vector2d& u, Eigen::Index j) {
  ++gradients_;
  return limits_.gradient(u, j);
}

}  // namespace reprise
