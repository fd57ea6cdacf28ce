#pragma once

// Workspaces by slabs, where two digits of a difference decide: curves that nearly coincide, nearly touch, or nearly
// meet in one point.
//
// The plane, turned so that no straight limit is upright, is cut into upright slabs at every x where two curves cross
// within the workspace or a circle turns back. Within a slab the curves do not cross where they bound the workspace,
// so their order in its middle, and the limits between two neighbours there, say which pieces bound it: no piece is
// told by a distance. At the x between two slabs each side has its list of bounds, from below to above. Read together
// in the order of y, they make the two sides differ and agree in turn, so that two neighbours each are joined, whatever
// rounding has done to their order: the loops always close. An error e of a crossing changes the area by some e^2,
// since both curves run through it.
//
// Numbers have 64 binary digits, or 50 decimal ones where a curve is more than 10^4 times as large as the workspace.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "reprise/geometry/region.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// What slabs are made of, and how finely.
struct SlabOptions {
  Eigen::Vector2d origin;                              ///< from which positions are measured
  double extent;                                       ///< size of the workspace: of a box about it
  double size;                                         ///< of the numbers that are computed with
  std::function<bool(std::size_t)> is_relevant;        ///< whether limit curve number k reaches the workspace
  std::function<bool(const Eigen::Vector2d&)> is_far;  ///< whether a position is outside of the workspace for certain
};

/// The loops of a workspace at all orientations of a range, which may be a single one: outer boundaries counter-
/// clockwise, holes clockwise. Gaps, necks and parts that are narrower than 1e-14 of the extent are taken for closed:
/// parts of the workspace then touch there. The limits of the edges are left at 0.
std::vector<BoundaryLoop> careful_loops(const Manipulator& manipulator, const Interval& orientations,
                                        const SlabOptions& options);

}  // namespace reprise
