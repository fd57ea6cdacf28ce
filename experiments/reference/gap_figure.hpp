#pragma once

#include "reprise/io/figure.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

/// What the picture shows of differences of f, and from which violation of a limit on a mark is hollow.
inline constexpr double lowest_shown = -0.016;
inline constexpr double highest_shown = 0.002;
inline constexpr double hollow_above = 1e-5;

/// Of every problem and source (a) what f is above or below the reference, (b) the residual of the optimality
/// conditions.
Figure draw_gaps(const Table& designs);

}  // namespace reprise::experiments
