#pragma once

// Complete tracing: every component of a planar workspace and every hole, each boundary by the chord method.
//
// trace_boundary (trace.hpp) follows the one boundary that a ray from its start meets first. Here starts are found for
// all boundaries.
//
// From an exact region: for each of its loops the ray runs against the inward normal of an edge, from a point at most
// two chords inside and at most half way to where that normal leaves the region again. So it meets the loop at that
// edge, and nothing before. Of all edges the one is taken that leaves most room, along the edge and across the region.
// Every loop is traced or is among the failures. Among these is a closed polygon that is not everywhere within 1.5
// chords of its loop, or its loop of it: the walk has gone over to another boundary, or has left out a part. A walk may
// take four times as many points as the loop's length asks for.
//
// From a grid, when only constraints are known: all limits are evaluated at the points of a square grid that covers
// limits.box(). Where one of two neighbouring points is inside the workspace and the other outside, a boundary passes.
// The ray from the inner to the outer point finds it; unless a boundary traced before passes within one chord of there
// and faces the same way, it is traced. What can be missed are boundaries that this does not show, because between any
// two neighbouring points that lie on different sides another boundary comes first or there are no such points:
//   - a component or hole that holds no point of the grid. With the spacing s, any that contains a disc of radius
//     s / sqrt(2) holds one; a longer one that is narrower than s may not.
//   - the boundary between two components, or a component and a hole, that are apart by less than s all along it.
//   - a component or hole within one chord of the boundary of another that faces the same way.
// Everything else is traced or is among the failures.
//
// In both cases the chord method's own limits hold (trace.hpp). A loop that is too small for the chord is a failure
// with its reason.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reprise/geometry/region.hpp"
#include "reprise/workspace/limits.hpp"
#include "reprise/workspace/point_solver.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

/// A component by its traced boundaries. All are closed.
struct TracedComponent {
  TracedBoundary outer;               ///< counter-clockwise
  std::vector<TracedBoundary> holes;  ///< clockwise; by area, largest first
};

/// A boundary that is not part of the result.
struct FailedBoundary {
  TracedBoundary trace;  ///< the walk that was made
  std::string reason;    ///< one sentence; trace.message where the walk did not close
  /// Which loop of the region it should have been: the loops are counted component by component, the outer one before
  /// its holes. Nothing when the starts came from a grid.
  std::optional<std::size_t> loop;
};

/// All boundaries of a workspace.
struct TracedWorkspace {
  /// By area within the outer boundary, largest first.
  std::vector<TracedComponent> components;
  /// In the order in which they were tried.
  std::vector<FailedBoundary> failures;
  /// Evaluations of all limits at one point: at the points of the grid, and to find where the rays between them leave
  /// the workspace. 0 when the starts came from a region.
  std::size_t grid_evaluations = 0;
  /// Evaluations of all limits at one point altogether: grid_evaluations and those of all walks, failures included.
  std::size_t evaluations = 0;
  /// Gradients of a single limit, altogether.
  std::size_t gradients = 0;

  bool complete() const { return failures.empty(); }  ///< no walk failed
  std::size_t hole_count() const;                     ///< of all components
  /// On all boundaries of the components.
  std::size_t point_count() const;
  /// Enclosed by the chords of all components, holes taken out.
  double area() const;
  /// All boundaries, component by component, the outer one before its holes.
  std::vector<std::vector<Eigen::Vector2d>> polygons() const;
};

/// Traces all loops of a region that is the workspace h <= 0 (see make_region). Of the options, first_direction is not
/// used. Throws as trace_boundary does.
TracedWorkspace trace_all_boundaries(const Limits& limits, const Region& region, const TraceOptions& options = {},
                                     const PointSolver& solver = BracketingPointSolver());

/// Traces all boundaries that a grid of this spacing (a length) shows. Of the options, first_direction is not used.
/// Throws as trace_boundary does, and std::invalid_argument when the spacing is not positive and finite or the grid
/// would have more than 10^8 points.
TracedWorkspace trace_all_boundaries(const Limits& limits, double spacing, const TraceOptions& options = {},
                                     const PointSolver& solver = BracketingPointSolver());

}  // namespace reprise
