#pragma once

// Workspaces as exact regions, with no walk and no optimization (not in the thesis: the yardstick for its chord
// method).
//
// Each limit of a manipulator is active on pieces of a few circles and straight lines. At a fixed orientation phi, leg
// i allows an annulus about q_i = c_i - R(phi) p_i, and angle limits add straight edges. When phi runs over a range,
// q_i runs on an arc of radius |p_i| about c_i, and the limits on the farthest and on the nearest distance of u from
// that arc are active on circles again: of radius l about the arc's two ends, and of radius l_max - |p_i| and | |p_i|
// +- l_min | about c_i within the swept wedge.
//
// The region is put together from those curves: each is cut where it meets another; a piece belongs to the boundary
// when its middle satisfies all limits, one of them with equality; the pieces are joined to loops, the loops to
// components.
//
// Where distances do not tell what is on the boundary, because curves nearly coincide, nearly touch or nearly meet in
// one point, the workspaces of manipulators are found by slabs with more digits: between two neighbouring curves of a
// slab the limits themselves say what is inside.

#include <span>
#include <vector>

#include "reprise/geometry/region.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

/// A circle, or a straight line (radius 0) through `centre` along `direction`.
struct LimitCurve {
  Eigen::Vector2d centre;                               ///< of its circle
  double radius = 0.0;                                  ///< a length
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< of length 1 for a line, zero for a circle
};

/// Circles and lines that contain the whole boundary of a constant-orientation workspace.
std::vector<LimitCurve> limit_curves(const Manipulator& manipulator, double orientation);

/// The same for a dextrous workspace. Orientations as DextrousLimits takes them.
std::vector<LimitCurve> limit_curves(const Manipulator& manipulator, const Interval& orientations);

/// The region h <= 0, given curves that contain its whole boundary (more do no harm; a circle of radius 0 is left out).
/// Parts of it without area (isolated points, curves) are left out. Where parts of it touch at a point, its loops
/// touch. With s the size of limits.box() and of the curves that reach it, as seen from the origin, vertices are
/// correct to some 1e-15 s over the sine of the angle at which their curves meet. Curves closer than 1e-13 s are taken
/// as one, vertices closer than about 3e-7 s too, which may move whole edges by as much. (Where loops do not close so,
/// because curves nearly coincide, wider tolerances are tried, up to 1e-9 s and 3e-5 s.) Throws
/// std::invalid_argument when s is above 1e70.
Region make_region(const Limits& limits, std::span<const LimitCurve> curves);

/// The constant-orientation workspace W^C[phi] (5.14), about an origin of its own. With s the diagonal of the box about
/// the workspace, the area is correct to 1e-12 s^2, wherever the workspace lies and however near to each other curves
/// are, and vertices to the rounding of their coordinates. Components and holes are those of the interior of the
/// workspace: where it touches itself in a point only, it does not hang together there, so that a ring which a circle
/// pinches has no hole. Gaps and necks that are narrower than 1e-14 s are taken for closed, and parts left out that are
/// narrower than that: about these, rounded coordinates do not decide. Throws std::invalid_argument when phi is not
/// finite, and as make_region.
Region constant_orientation_workspace(const Manipulator& manipulator, double orientation);

/// The dextrous workspace W^D[phi_min, phi_max] (5.22), orientations in radians, alike. Throws std::invalid_argument as
/// DextrousLimits and make_region do.
Region dextrous_workspace(const Manipulator& manipulator, const Interval& orientations);

}  // namespace reprise
