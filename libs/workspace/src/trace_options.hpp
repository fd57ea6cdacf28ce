#pragma once

// The check of the tracing options, shared by all that traces.

#include <Eigen/Geometry>

#include "reprise/workspace/trace.hpp"

namespace reprise {

/// The size of a box as seen from the origin: its diagonal or its largest coordinate, whichever is larger; 1 for an
/// empty one.
double size_of(const Eigen::AlignedBox2d& box);

/// Throws std::invalid_argument when an option is out of its range.
void validate(const TraceOptions& options);

/// Throws std::invalid_argument when the coordinates of the workspace are too large for the chord: below 1e-12 of the
/// size of its box, as seen from the origin, rounding is no longer small beside it.
void require_resolution(const Limits& limits, const TraceOptions& options);

}  // namespace reprise
