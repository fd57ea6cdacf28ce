#pragma once

// The limits of a leg at a fixed position as sinusoids in the orientation; shared by dextrous and orientation
// workspaces. J turns a vector by +90 degrees.

#include "edge_normals.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

/// constant + amplitude . (cos phi, sin phi).
struct Sinusoid {
  double constant;
  Eigen::Vector2d amplitude;

  double at(const Eigen::Vector2d& rotation) const { return constant + amplitude.dot(rotation); }
};

/// |a|^2 as a function of phi, with w = u - c.
inline Sinusoid square_length(const Leg& leg, const Eigen::Vector2d& w) {
  const Eigen::Vector2d& p = leg.platform_joint;
  return {w.squaredNorm() + p.squaredNorm(), {2.0 * w.dot(p), 2.0 * w.dot(quarter_turned(p))}};
}

/// normal . a as a function of phi; the normal of a limit at the platform is that at phi = 0 and turns along.
inline Sinusoid edge_distance(const Leg& leg, LimitKind kind, const Eigen::Vector2d& normal, const Eigen::Vector2d& w) {
  const Eigen::Vector2d& p = leg.platform_joint;
  if (is_at_platform(kind)) return {normal.dot(p), {normal.dot(w), quarter_turned(normal).dot(w)}};
  return {normal.dot(w), {normal.dot(p), normal.dot(quarter_turned(p))}};
}

}  // namespace reprise
