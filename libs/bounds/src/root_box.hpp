#pragma once

// The box of designs that a search begins with, see global_optimum.hpp.

#include "box_examiner.hpp"

namespace reprise::rigorous {

/// Throws std::invalid_argument for an option that is out of its range.
void check_search(int side, long max_boxes, long threads, const std::optional<Interval>& sizes);

/// Sizes |r| outside of which kappa^-1 is at most 0.25, or a leg cannot reach O'; unbounded above where neither says
/// anything.
Interval default_sizes(const DesignFamily& family);

/// The value of kappa^-1 that no design outside of the sizes has more of.
double bound_outside(const DesignFamily& family, const Interval& sizes);

/// All designs of these sizes, of one sign of r, that reach O' at one height. Throws std::invalid_argument where the
/// sizes are unbounded.
DesignBox root_box(const SynthesisTask& task, const DesignFamily& family, const Interval& sizes, int side);

}  // namespace reprise::rigorous
