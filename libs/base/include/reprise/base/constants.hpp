#pragma once

#include <limits>
#include <numbers>

namespace reprise {

using std::numbers::pi;

/// 2 pi, in radians.
inline constexpr double full_turn = 2.0 * pi;

/// An angle in degrees times this is the angle in radians.
inline constexpr double degree = pi / 180.0;

/// The bound of a quantity that has no bound.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace reprise
