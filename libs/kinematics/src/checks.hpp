#pragma once

// Checks of arguments shared by the sources of this library.

#include <Eigen/Core>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// The largest absolute value of a joint coordinate or a leg length: squares of larger ones may overflow.
inline constexpr double greatest_length = 1e120;

/// What a characteristic length may be: beyond, a product of four lengths may overflow.
inline constexpr double least_characteristic_length = 1e-100;
inline constexpr double greatest_characteristic_length = 1e100;

/// Throws std::invalid_argument unless `size` is `expected`; `name` is what has that size.
void check_size(const char* name, Eigen::Index size, Eigen::Index expected);

/// Throws std::invalid_argument unless the pose is finite; `name` is what the pose is for.
void check_finite(const char* name, const Pose& pose);

}  // namespace reprise
