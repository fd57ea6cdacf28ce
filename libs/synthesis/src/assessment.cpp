#include "reprise/synthesis/assessment.hpp"

#include <algorithm>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/workspace/dextrous_limits.hpp"

namespace reprise {

Assessor::Assessor(SynthesisTask task, int points, int orientations)
    : task_(std::move(task)), orientations_(orientations) {
  validate(task_);
  require(orientations >= 2, "the number of orientations", orientations, "at least 2");
  positions_ = task_.prescribed.points(points);
}

Assessment Assessor::operator()(const Eigen::VectorXd& design) const {
  const Manipulator manipulator = task_.designs.manipulator(design);
  Assessment result;
  result.kappa_inverse = infinity;
  result.kappa_inverse_throughout = infinity;
  double largest = -infinity;
  for (const OrientationRange& range : task_.orientations) {
    const DextrousLimits limits(manipulator, range);
    Eigen::VectorXd h(limits.count());
    const std::vector<double> throughout = range.spread(orientations_);
    for (const Eigen::Vector2d& position : positions_) {
      for (const double phi : throughout) {
        const double value = kappa_inverse(manipulator, {position, phi}, task_.conditioning);
        result.kappa_inverse_throughout = std::min(result.kappa_inverse_throughout, value);
        if ((phi == range.lower || phi == range.upper) && value < result.kappa_inverse) {
          result.kappa_inverse = value;
          result.kappa_inverse_at = position;
          result.kappa_inverse_orientation = phi;
        }
      }
      limits.evaluate(position, h);
      Eigen::Index j = 0;
      if (const double value = h.maxCoeff(&j); value > largest) {
        largest = value;
        result.violation_at = position;
        result.violation_orientation = limits.critical_orientation(position, j);
        result.violation_limit = limits.limit(j);
      }
    }
  }
  result.violation = std::max(0.0, largest);
  return result;
}

Assessment assess(const SynthesisTask& task, const Eigen::VectorXd& design, int points, int orientations) {
  return Assessor(task, points, orientations)(design);
}

}  // namespace reprise
