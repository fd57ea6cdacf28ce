#pragma once

// kappa^-1 as colours: values on a grid of positions.

#include <Eigen/Geometry>
#include <vector>

#include "reprise/study/problem_file.hpp"

namespace reprise::explorer {

/// The least kappa^-1 at a position over both ends of a range of orientations (radians), which are the same at a single
/// orientation.
double least_kappa_inverse(const ManipulatorInput& input, const Eigen::Vector2d& position, const Interval& range);

/// That at columns x rows positions, from the box's lower left corner to its upper right one, row by row. `values` is
/// resized to them.
void map_kappa_inverse(const ManipulatorInput& input, const Eigen::AlignedBox2d& box, int columns, int rows,
                       const Interval& range, std::vector<float>& values);

}  // namespace reprise::explorer
