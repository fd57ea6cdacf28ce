#pragma once

// Rigorous bounds of the smallest value of a function of the pose over a prescribed workspace and a range of
// orientations, or over a part of both, by branch and bound.

#include <limits>
#include <optional>

#include "outline.hpp"
#include "pose_function.hpp"
#include "reprise/bounds/enclosure.hpp"

namespace reprise::rigorous {

/// Which positions of the region, or which orientations of the range, are searched.
enum class Part {
  all,
  border,    ///< the outline; the two ends of the range
  interior,  ///< all but the border, where the smallest value of all can be: where no derivative forbids it
};

struct Search {
  Part positions = Part::all;
  Part orientations = Part::all;
  /// Only values below `below` are looked for, and of them only those below `found_below` count as found. When the
  /// first is known to be a value of the border and the second a lower bound of all of them, what is found in the
  /// interior contradicts the claim that the smallest value is on the border, and when nothing is left the claim is
  /// proved.
  double below = std::numeric_limits<double>::infinity();
  double found_below = std::numeric_limits<double>::infinity();
};

struct SearchResult {
  double lower = 0.0;           ///< no smaller value is there; `below` when no value below that is there
  double upper = 0.0;           ///< a value not above this was found; `below` when none was
  std::optional<Pose> witness;  ///< where it was found
  long evaluations = 0;         ///< of the function, over boxes or at poses
  bool finished = false;        ///< nothing is left, or upper - lower is within the tolerance of what was found
};

SearchResult search(const PoseFunction& function, const Outline& outline, const Interval& orientations,
                    const Search& what, const EnclosureOptions& options);

}  // namespace reprise::rigorous
