#include "reprise/workspace/dextrous_boundary.hpp"

#include <cmath>
#include <cstddef>

namespace reprise {

std::vector<DextrousBoundaryPoint> describe_boundary(const TracedBoundary& boundary,
                                                     const OrientationRangeLimits& limits) {
  constexpr double same_orientation = 1e-9;
  const std::size_t n = boundary.points.size();
  std::vector<DextrousBoundaryPoint> described;
  described.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const BoundaryPoint& point = boundary.points[i];
    const auto [before, after] = point.active;
    // At a corner of a limit's own curve two orientations are critical: each of the neighbours knows one of them.
    const bool own_corner = before == after && limits.corner(before, point.position) == point.position;
    const Eigen::Vector2d& from = own_corner ? boundary.points[(i + n - 1) % n].position : point.position;
    const Eigen::Vector2d& to = own_corner ? boundary.points[(i + 1) % n].position : point.position;
    DextrousBoundaryPoint result{point.position,
                                 {limits.limit(before), limits.limit(after)},
                                 {limits.critical_orientation(from, before), limits.critical_orientation(to, after)}};
    if (std::abs(result.orientations[1] - result.orientations[0]) > same_orientation) {
      if (point.is_bifurcation() || own_corner) result.kind = DextrousBoundaryPoint::Kind::type_ii;
    } else if (point.is_bifurcation()) {
      result.kind = DextrousBoundaryPoint::Kind::type_i;
    }
    described.push_back(result);
  }
  return described;
}

}  // namespace reprise
