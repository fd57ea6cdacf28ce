#pragma once

// The chord method: the boundary of a planar workspace as a closed list of points (thesis Section 5.4.2).
//
//  1. From a point u0 inside, the ray along s^1 meets the boundary at b^1                      (5.16), (5.17)
//  2. From b^i the next point b^(i+1) lies at the distance d, in the feasible direction that is
//     nearest to psi_i in the positive (counter-clockwise) sense                              (5.18), (5.19)
//     psi_i is the direction of the last chord turned outward, to the right, by 45 degrees: enough to see the workspace
//     from outside at corners that turn right by up to that much (beyond, psi_i is turned further), and not so much
//     that h_j has no slope along the circle there, which would leave an optimizer without a direction. For the
//     first chord the tangent at b^1 stands in for the last chord.
//  3. When the next chord would pass b^1, the boundary is closed                                (C.14)
//  4. Where the active limit changes from p to q within a chord, the point with h_p = h_q = 0 is put between    (5.20)
//
// So the walk keeps the workspace on its left: it runs counter-clockwise around the workspace, and clockwise around a
// hole, if a hole is what the ray meets first.
//
// Limits that become active and inactive again within one chord are found from the values of all limits at its ends
// and in its middle, by a parabola through the three; a corner of one limit's own curve (Limits::corner) becomes a
// boundary point as well. Where the boundary cannot be followed from b^i to b^(i+1) so, the chord has jumped over a gap
// in the workspace: the step then ends at the first point at which another limit takes over from the active one, if
// there is one within about a chord, and the next chord begins there.
//
// Features of the boundary shorter than about half a chord may be missed. Where parts of the workspace touch at a
// point, or a neck of it is narrower than about a hundredth of a chord, the walk may go over to the other side. The
// chord should be much shorter than the workspace: from about a third of its width on, not every boundary that is
// called closed is a good picture.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/workspace/limits.hpp"
#include "reprise/workspace/point_solver.hpp"

namespace reprise {

/// How far psi_i is turned outward from the last chord, an angle.
inline constexpr double outward_turn = pi / 4.0;

/// How a boundary is walked.
struct TraceOptions {
  /// d, a length in the manipulator's unit. Positive. The thesis's value.
  double chord = 0.02;
  /// s^1, of any length but zero.
  Eigen::Vector2d first_direction = Eigen::Vector2d::UnitX();
  /// Whether step 4 is done.
  bool bifurcation_points = true;
  /// Limit on the number of boundary points. Positive.
  std::size_t max_points = 100'000;
  /// Every boundary point meets its limits to this part of the size of the workspace (its box, as seen from the
  /// origin), where the point solver can do so. In [1e-15, 1e-3].
  double tolerance = 1e-14;
};

/// A point of a walk, with its limits.
struct BoundaryPoint {
  Eigen::Vector2d position;  ///< b^i
  /// The limits active before and after this point along the walk: equal, except at bifurcation points (and at a b^1 or
  /// b^i that happens to be one).
  std::array<Eigen::Index, 2> active;

  bool is_bifurcation() const { return active[0] != active[1]; }  ///< another limit is active behind it than before it
};

/// How a walk ended.
enum class TraceStatus {
  closed,               ///< the boundary is complete
  start_outside,        ///< the given start violates a limit
  empty,                ///< no start was given, and the workspace is proved to be empty (see find_interior_point)
  no_start,             ///< no start was given, and none was found, nor a proof that there is none
  chord_too_long,       ///< the workspace has no point at the distance d from a boundary point, or less than 3 chords
  point_solver_failed,  ///< a ray or chord problem was not solved
  too_many_points,      ///< max_points was reached before the boundary closed
};

/// The status as one lower-case word, as the tables write it.
std::string_view to_string(TraceStatus status);

/// A boundary as it was walked.
struct TracedBoundary {
  TraceStatus status = TraceStatus::point_solver_failed;  ///< how the walk ended
  /// Why the status is not `closed`, in one sentence; empty when it is.
  std::string message;
  /// In the order of the walk; the last is joined to the first. What was found so far when not closed.
  std::vector<BoundaryPoint> points;
  /// u0.
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  /// Number of chord problems solved.
  std::size_t chords = 0;
  /// Chords along which the boundary could not be followed: it is cut short there, or the walk has jumped over a gap.
  std::size_t unresolved_bifurcations = 0;
  /// Evaluations of all limits at one point, for the whole boundary, search for a start included.
  std::size_t evaluations = 0;
  /// Gradients of a single limit.
  std::size_t gradients = 0;

  bool closed() const { return status == TraceStatus::closed; }  ///< the boundary is complete
  /// The points' positions, as area and polar form take them.
  std::vector<Eigen::Vector2d> positions() const;
};

/// Traces the boundary that the ray from the start meets first. Throws std::invalid_argument when an option is out of
/// its range (chord: 1e-12 of the box as seen from the origin) or the start not finite; what limits or solver throw
/// too.
TracedBoundary trace_boundary(const Limits& limits, const Eigen::Vector2d& start, const TraceOptions& options = {},
                              const PointSolver& solver = BracketingPointSolver());

/// The same from a start that find_interior_point finds (which jumps when the limits change a little; a caller who
/// needs the boundary to vary continuously gives a start).
TracedBoundary trace_boundary(const Limits& limits, const TraceOptions& options = {},
                              const PointSolver& solver = BracketingPointSolver());

}  // namespace reprise
