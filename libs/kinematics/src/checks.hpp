#pragma once

// Checks of arguments shared by the sources of this library.

#include <Eigen/Core>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// Throws std::invalid_argument unless `size` is `expected`; `name` is what has that size.
void check_size(const char* name, Eigen::Index size, Eigen::Index expected);

/// Throws std::invalid_argument unless the pose is finite; `name` is what the pose is for.
void check_finite(const char* name, const Pose& pose);

}  // namespace reprise
