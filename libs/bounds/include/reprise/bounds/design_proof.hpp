#pragma once

// What is proved of a design over the whole prescribed workspace, inside and outline, at all orientations of every
// range: that it reaches all of it, and how small kappa^-1 is there at most. The bounds are those of enclosure.hpp.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "reprise/bounds/enclosure.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// What prove_design is asked to attain.
struct ProofOptions {
  /// A limit counts as violated when it is by more than this, a length, at least 0.
  double allowance = 0.0;
  double margin_tolerance = 1e-6;        ///< width aimed at of the bounds of limits, a length
  double conditioning_tolerance = 1e-6;  ///< of those of kappa^-1
  /// Limit on evaluations for each range: for each of its limits, and for kappa^-1 with three legs. One evaluation of
  /// kappa^-1 goes through all triples of legs, so with more legs the limit is this over their number.
  long max_evaluations = 100'000;
};

/// What is proved of a design over the whole prescribed workspace.
struct DesignProof {
  /// The claim that no limit of any leg is violated by more than the allowance at any pose. Proved where
  /// there are no limits.
  Verdict reaches;
  double violation;        ///< the largest violation found, a length; 0 when none was
  double violation_bound;  ///< no limit is violated by more than this, proved; at least `violation`
  /// The limit that is nearest to being violated, or violated most; none where nothing was found. And the pose where.
  std::optional<Limit> limit;
  std::optional<Pose> limit_at;        ///< the pose where it is so
  std::vector<LimitEnclosure> limits;  ///< range by range, in the order of list_limits
  /// The smallest kappa^-1: at least `lower`, proved; at most `upper`, which is attained at the witness. There always
  /// is one: where bounds came to no end, the smallest value of some samples counts too. Both are 0 where det J changes
  /// its sign, and the witness is the pose where it does, to rounding.
  MinimumEnclosure kappa_inverse;
  std::vector<MinimumEnclosure> kappa_inverses;  ///< of each range
  long evaluations;                              ///< of all bounds
};

/// Throws std::invalid_argument as validate and DesignSpace do for an ill-formed task or design, and as the functions
/// of enclosure.hpp do for options.
DesignProof prove_design(const SynthesisTask& task, const Eigen::VectorXd& design, const ProofOptions& options = {});

/// The position q = c - R(phi) p that the working point has when a leg has length 0. A leg with a minimum length leaves
/// a hole around it.
Eigen::Vector2d hole_centre(const Leg& leg, double orientation);

/// Where a leg leaves a hole in the prescribed workspace: an orientation of the range, of `samples` (at least 2) spread
/// evenly, at which its hole_centre is farthest inside, if any is inside and the leg has a minimum length.
std::optional<double> find_hole(const PrescribedWorkspace& prescribed, const Leg& leg, const OrientationRange& range,
                                int samples = 33);

}  // namespace reprise
