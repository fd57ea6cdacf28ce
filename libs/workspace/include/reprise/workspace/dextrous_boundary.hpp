#pragma once

// The boundary of a dextrous workspace with what is active on it (thesis chapter 5, Section 5.5.3).
//
// Every boundary point belongs to a limit of one leg and to the orientation of the range at which that limit is met:
// phi_min or phi_max, or one between them where the leg's length has its extreme there (which the thesis leaves out:
// its legs would have to be in line with their arms). At a bifurcation point one or both of them change.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

/// A point of the boundary of a dextrous workspace with all that is known about it.
struct DextrousBoundaryPoint {
  Eigen::Vector2d position;  ///< a point of the plane
  /// The limits of the manipulator that are active before and after the point along the walk, and the orientations at
  /// which they are.
  std::array<Limit, 2> active;
  std::array<double, 2> orientations;  ///< radians

  /// What the point is on the boundary.
  enum class Kind { regular, type_i, type_ii };
  /// Type I where another limit becomes active at the same orientation, type II where the orientation changes; where
  /// neither does the point is regular.
  Kind kind = Kind::regular;
};

/// Describes the points of a boundary traced with such limits, in the same order.
std::vector<DextrousBoundaryPoint> describe_boundary(const TracedBoundary& boundary,
                                                     const OrientationRangeLimits& limits);

}  // namespace reprise
