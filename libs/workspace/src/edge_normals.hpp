#pragma once

// The angle limits of a leg as edges of a wedge; shared by the limits at one orientation and over a range of them.

#include "reprise/workspace/limits.hpp"

namespace reprise {

/// h as the minimum of lower . a and upper . a; equal normals for a single edge, zero ones for a length limit.
struct EdgeNormals {
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
};

/// Whether a limit is one of the joint at the platform, whose wedge turns along with phi.
inline bool is_at_platform(LimitKind kind) {
  return kind == LimitKind::platform_angle || kind == LimitKind::platform_angle_lower ||
         kind == LimitKind::platform_angle_upper;
}

/// The normals of a limit of the leg at an orientation (radians). Throws std::invalid_argument when the leg lacks the
/// limit.
EdgeNormals edge_normals(const Leg& leg, LimitKind kind, double orientation);

}  // namespace reprise
