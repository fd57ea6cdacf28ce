#pragma once

// Ranges of orientations.

#include <vector>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// All orientations phi from `lower` to `upper`, radians, lower <= upper. A range of one orientation is a slice: what
/// holds over it is the thesis's W^C[phi], over a wider one W^D[phi_min, phi_max].
struct OrientationRange : Interval {
  OrientationRange() : Interval{0.0, 0.0} {}                                      ///< the orientation 0
  OrientationRange(double lowest, double highest) : Interval{lowest, highest} {}  ///< radians
  OrientationRange(const Interval& interval) : Interval(interval) {}              ///< radians

  /// Whether it is a single orientation.
  bool is_slice() const { return lower == upper; }

  /// Both ends, or of a slice its one orientation.
  std::vector<double> ends() const;

  /// `count` (at least 2) equally spaced orientations, both ends among them; of a slice its one. Throws
  /// std::invalid_argument when count < 2.
  std::vector<double> spread(int count) const;
};

/// Single orientations, radians, as ranges.
std::vector<OrientationRange> slices(const std::vector<double>& orientations);

}  // namespace reprise
