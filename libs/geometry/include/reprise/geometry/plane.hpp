#pragma once

// Vectors of the plane.

#include <Eigen/Core>
#include <cmath>

namespace reprise {

/// a x b = |a| |b| sin(angle from a to b, counter-clockwise).
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The unit vector in a direction (radians, counter-clockwise from the x-axis).
inline Eigen::Vector2d unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// J a: the vector turned by +90 degrees.
inline Eigen::Vector2d quarter_turned(const Eigen::Vector2d& a) { return {-a.y(), a.x()}; }

}  // namespace reprise
