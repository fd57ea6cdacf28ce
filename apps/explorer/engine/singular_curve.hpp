#pragma once

// The singular positions at an orientation as curves to be drawn.

#include <Eigen/Geometry>
#include <vector>

#include "reprise/kinematics/singular_positions.hpp"

namespace reprise::explorer {

/// The zeros of the polynomial within a box and a little around it: a conic, one or two lines, each as polygons of
/// points in order. Both sheets of a line that counts twice are given once. Empty where there are none in the box, and
/// where every position is singular.
std::vector<std::vector<Eigen::Vector2d>> singular_curve(const SingularityPolynomial& polynomial,
                                                         const Eigen::AlignedBox2d& box);

}  // namespace reprise::explorer
