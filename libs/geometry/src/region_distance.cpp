#include "reprise/geometry/region_distance.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

constexpr int samples = 360;

/// The direction between two in which the outline, taken to have no corner between them, is nearest to q.
double nearest_between(const PrescribedWorkspace& prescribed, const Eigen::Vector2d& q, double from, double to) {
  constexpr int half_of_the_digits = std::numeric_limits<double>::digits / 2;
  std::uintmax_t limit = 100;
  double beta = boost::math::tools::brent_find_minima([&](double b) { return (prescribed.point(b) - q).squaredNorm(); },
                                                      from, to, half_of_the_digits, limit)
                    .first;
  // Distances near the smallest are alike to rounding; the slope tells more.
  for (int step = 0; step < 3; ++step) {
    const OutlinePoint u = prescribed.outline(beta);
    const Eigen::Vector2d away = u.position - q;
    const double slope = away.dot(u.slope);
    const double bend = u.slope.squaredNorm() + away.dot(u.bend);
    const double next = beta - slope / bend;
    if (!(bend > 0.0 && next >= from && next <= to)) break;
    beta = next;
  }
  return beta;
}

}  // namespace

RegionDistance::RegionDistance(const PrescribedWorkspace& prescribed)
    : prescribed_(prescribed), directions_(prescribed.angles(samples)) {
  const std::vector<double>& corners = prescribed.corners();
  for (const double beta : directions_) {
    positions_.push_back(prescribed.point(beta));
    corner_.push_back(std::binary_search(corners.begin(), corners.end(), beta));
  }
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const Eigen::Vector2d& next = positions_[i + 1 == positions_.size() ? 0 : i + 1];
    largest_step_ = std::max(largest_step_, (next - positions_[i]).norm());
  }
}

bool RegionDistance::inside(const Eigen::Vector2d& q) const {
  const Eigen::Vector2d from_centre = q - prescribed_.centre();
  return from_centre.norm() < prescribed_.radius(std::atan2(from_centre.y(), from_centre.x()));
}

RegionDistance::Nearest RegionDistance::nearest(const Eigen::Vector2d& q) const {
  const std::size_t size = positions_.size();
  double smallest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& position : positions_) smallest = std::min(smallest, (position - q).norm());
  Nearest best{0.0, std::numeric_limits<double>::infinity(), false};
  for (std::size_t i = 0; i < size; ++i) {
    const double own = (positions_[i] - q).norm();
    const std::size_t before = i == 0 ? size - 1 : i - 1;
    const std::size_t after = i + 1 == size ? 0 : i + 1;
    // Between two samples the outline comes nearer than to them by less than their distance from one another.
    const bool lowest = own <= (positions_[before] - q).norm() && own < (positions_[after] - q).norm();
    if (own > smallest && (!lowest || own > smallest + largest_step_)) continue;
    const auto consider = [&](double beta, bool corner) {
      const double distance = (prescribed_.point(beta) - q).norm();
      if (distance < best.distance) best = {beta, distance, corner};
    };
    const double beta = directions_[i];
    const double from = directions_[before] - (i == 0 ? full_turn : 0.0);
    const double to = directions_[after] + (after == 0 ? full_turn : 0.0);
    consider(beta, corner_[i]);
    if (corner_[i]) {
      consider(nearest_between(prescribed_, q, from, beta), false);
      consider(nearest_between(prescribed_, q, beta, to), false);
    } else {
      consider(nearest_between(prescribed_, q, from, to), false);
    }
  }
  return best;
}

double RegionDistance::value(const Eigen::Vector2d& q) const {
  const double distance = nearest(q).distance;
  return inside(q) ? -distance : distance;
}

DistanceDerivatives RegionDistance::derivatives(const Eigen::Vector2d& q) const {
  const Nearest found = nearest(q);
  const OutlinePoint u = prescribed_.outline(found.direction);
  DistanceDerivatives result{inside(q) ? -found.distance : found.distance, Eigen::Vector2d::Zero(),
                             Eigen::Matrix2d::Zero()};
  const double length = u.slope.norm();
  // On the outline itself the direction away from it is its normal.
  const bool on_outline = found.distance <= 1e-12 * (u.position - prescribed_.centre()).norm();
  if (on_outline && std::isfinite(length)) {
    result.gradient = Eigen::Vector2d(u.slope.y(), -u.slope.x()) / length;
  } else if (result.value != 0.0) {
    result.gradient = (q - u.position) / result.value;
  }
  const Eigen::Vector2d along(-result.gradient.y(), result.gradient.x());
  double curvature = 0.0;  // of the curve of equal distance through q
  if (found.corner) {
    if (result.value != 0.0) curvature = 1.0 / result.value;
  } else {
    const double of_outline = cross(u.slope, u.bend) / (length * length * length);
    curvature = of_outline / (1.0 + of_outline * result.value);
  }
  if (std::isfinite(curvature)) result.hessian = curvature * along * along.transpose();
  return result;
}

}  // namespace reprise
