#pragma once

// Synthesis over the whole prescribed workspace, inside and outline, and over all orientations of the ranges.
//
// The pointwise formulation (synthesis_task.hpp) looks at points of the outline, and for kappa^-1 at the ends of the
// ranges. Which of the constraints can be missed by that?
//   maximum length     none: |u - q| is convex in u, so it is largest on the outline.
//   narrow wedges      none: at a fixed orientation each edge is a linear function of u.
//   wide wedges        none: what they leave out is a cone with its apex at the joint. From a position in it the ray
//                      away from the apex stays in it, with a violation that grows, until it crosses the outline.
//   minimum length     a disc of radius l_min about q = c - R(phi) p is out of reach, and may lie inside the outline.
//                      The constraint for all of the region is l_min <= distance of q from the region.
//   kappa^-1           may be smaller inside, and within the range, than on the outline and at the ends.
// (Each of the first three holds at every orientation, hence for the largest value over a range.)
//
// So the problem is solved by exchange. Its solution is bounded over all poses (design_proof.hpp); the pose where
// kappa^-1 is smallest, and the limits that are violated, join the problem, until the bound agrees with the problem's
// t.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "reprise/bounds/design_proof.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// A constraint that joins those of the outline.
struct PoseConstraint {
  /// None: t - kappa^-1 at the pose. A minimum length: l_min less the distance of q, at the pose's orientation, from
  /// the prescribed workspace, which is negative inside (the position counts for nothing); the leg's constraints at
  /// points of the outline, which hold on the wrong side too, then leave. Another limit: its largest value at the
  /// pose's position over that half of the range which holds the pose's orientation.
  std::optional<Limit> limit;
  Pose pose;  ///< where the constraint is taken
};

/// The pointwise problem and these constraints, see PoseConstraint, which come last. All functions are smooth,
/// except for the distance of a q that is as near to one part of the outline as to another. Throws
/// std::invalid_argument when a limit is none of the manipulator's or an orientation is in no range.
Problem whole_region_problem(const SynthesisTask& task, const std::vector<PoseConstraint>& constraints,
                             const PointwiseOptions& options = {});

/// How solve_whole_region works.
struct WholeRegionOptions {
  PointwiseOptions pointwise;  ///< of the problem on the outline
  /// Of the solver; its limit on evaluations is for all rounds together.
  Options solver;
  ProofOptions proof;  ///< of the bounds that follow every round
  /// The exchange ends when the smallest kappa^-1 of the region is less than this below that of the problem, and no
  /// limit is violated by more than `length_tolerance` more than in the problem. Both positive.
  double conditioning_tolerance = 1e-5;
  double length_tolerance = 1e-5;  ///< a length; see conditioning_tolerance
  int max_rounds = 20;             ///< of the exchange; positive
};

/// What solve_whole_region found.
struct WholeRegionResult {
  Eigen::VectorXd design;  ///< d of the best round
  /// The solver's of the round that the design is from; counts and history are of all rounds. Its x is [d, t].
  Result solved;
  DesignProof proof;                        ///< of the design, over the whole region
  std::vector<PoseConstraint> constraints;  ///< that joined
  int rounds;                               ///< of the exchange
  /// Whether the exchange came to its end: the solver's problem is that of the whole region within the tolerances.
  bool closed;
};

/// Throws as whole_region_problem does, and when an option is out of range.
WholeRegionResult solve_whole_region(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                     const WholeRegionOptions& options = {}, const Observer& observer = {});

}  // namespace reprise
