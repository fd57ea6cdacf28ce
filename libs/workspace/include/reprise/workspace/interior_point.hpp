#pragma once

// A certified search for a point inside a workspace.
//
// With the Lipschitz constant L of the limits, no point of a box whose centre c has the clearance s(c) = -max_j h_j(c)
// has a clearance above s(c) + L * (half the box's diagonal). Splitting the box with the highest such bound first gives
// either a point whose clearance is within a factor of the best possible, or the proof that there is none.

#include <Eigen/Core>
#include <cstddef>

#include "reprise/workspace/limits.hpp"

namespace reprise {

/// How a search for a point inside ended.
enum class InteriorStatus {
  found,      ///< `position` is inside the workspace
  empty,      ///< proved: no point has a clearance above the resolution; see `clearance_bound`
  undecided,  ///< the limit on evaluations was reached with no point found
};

/// When the search ends.
struct InteriorOptions {
  /// The search ends when the clearance found is at least this part of the best possible. In (0, 1).
  double quality = 0.5;
  /// The search ends as empty when no clearance above this part of the diagonal of limits.box() is possible. Positive.
  double resolution = 1e-4;
  /// Limit on the evaluations of the limits. Positive.
  std::size_t max_evaluations = 1'000'000;
};

/// A point inside a workspace, or what is known where none was found.
struct InteriorPoint {
  InteriorStatus status = InteriorStatus::undecided;   ///< whether one was found
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< best point met
  double clearance = 0.0;                              ///< -max_j h_j there: not positive unless status is found
  double clearance_bound = 0.0;                        ///< no point of limits.box() has a greater clearance
  std::size_t evaluations = 0;                         ///< of all limits at one point
};

/// Searches limits.box(). Throws std::invalid_argument when an option is out of its range or the limits have no finite
/// Lipschitz constant.
InteriorPoint find_interior_point(const Limits& limits, const InteriorOptions& options = {});

}  // namespace reprise
