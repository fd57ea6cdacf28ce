#pragma once

// Dimensional synthesis: the design whose worst conditioning over a prescribed workspace is best, among those that
// reach all of it (thesis chapter 5, sections 5.6 to 5.8).
//
//     maximise over d   min over u in W_p and the ends phi of the ranges of  kappa^-1(d, u, phi)
//     subject to        W_p within the dextrous workspace W_c = W^D[phi_min, phi_max] of d, for each range
//
// The orientations are a list of ranges. A range of one orientation is a slice, whose dextrous workspace is the
// constant-orientation workspace W^C[phi]: one slice is the thesis's SO synthesis (5.34), several are its MO synthesis
// (5.37), one wider range is its D synthesis (5.39). Limits hold at every orientation of a range; the conditioning
// counts at its ends, where the thesis expects it to be worst (assess tells whether it is). The minimum over W_p is
// looked for on its outline, as the thesis does. Two formulations make an optimization problem of it:
//
//   area        the thesis's: W_c by the chord method, the part of W_p outside of it as one constraint, (5.35), (5.38)
//               and (5.40); values only, neither f nor g is smooth.
//   pointwise   maximise t subject to kappa^-1 >= t and to every limit of every leg at many points of the outline;
//               smooth, with exact sparse first and second derivatives.

#include <Eigen/Core>
#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/orientation_range.hpp"
#include "reprise/optimizers/problem.hpp"
#include "reprise/synthesis/area_measure.hpp"
#include "reprise/synthesis/design_space.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

/// What is asked for.
struct SynthesisTask {
  PrescribedWorkspace prescribed;  ///< W_p
  std::vector<OrientationRange>
      orientations;           ///< the ranges of phi, radians, each as DextrousLimits takes it; at least one
  DesignSpace designs;        ///< the designs to choose from
  Conditioning conditioning;  ///< how the Jacobian is made comparable
};

/// The area formulation's numerical choices.
struct AreaOptions {
  double chord_length = 0.02;  ///< d of the chord method, in the manipulator's unit
  /// The sectors of the area measure lie between the directions of the computed boundary points and of this many points
  /// of the prescribed outline (and its corners), so that no tip of it falls between two of them.
  int outline_points = 360;
};

/// Everything the area formulation computes at a design.
struct AreaEvaluation {
  /// f: the smallest kappa^-1 over the ends of the ranges and the outline points in the directions of the computed
  /// boundary points.
  double kappa_inverse = 0.0;
  /// g of (5.35), (5.38), (5.40): the sum S over ranges of the area of W_p outside of W_c if positive, else -rho^2 with
  /// rho the smallest clearance of all ranges. An area.
  double constraint = 0.0;
  /// One for each range. Where O' is outside of W_c the computed radius is 0 in every direction, and outside is the
  /// area of W_p.
  std::vector<AreaMeasure> areas;
  long boundary_points = 0;    ///< of all ranges
  long limit_evaluations = 0;  ///< of the chord method, all ranges
  /// Not `closed` when the chord method failed at some range for another reason than O' lying outside of W_c (which has
  /// an area and is no failure); f and g are then NaN.
  TraceStatus trace_status = TraceStatus::closed;
};

/// The area formulation of a task, ready to be evaluated at many designs. A value without state: any number of threads
/// may evaluate one object.
class AreaFormulation {
 public:
  /// Throws std::invalid_argument when the task has no range of orientations or one that is not finite, reversed or a
  /// full turn or wider, or when an option is out of range.
  explicit AreaFormulation(SynthesisTask task, const AreaOptions& options = {});

  const SynthesisTask& task() const { return task_; }  ///< as it was given

  /// Throws std::invalid_argument when the design has the wrong length or is not finite.
  AreaEvaluation evaluate(const Eigen::VectorXd& design) const;

  /// (5.34), (5.37), (5.39): variables d, objective -f, one inequality g. Objective and constraint share the last
  /// evaluation, so the problem is not to be used by two threads at once.
  Problem problem() const;

 private:
  SynthesisTask task_;
  AreaOptions options_;
  std::vector<double> outline_;  ///< directions of the outline's points
};

/// The pointwise formulation's numerical choices.
struct PointwiseOptions {
  /// Number of outline points, spread as PrescribedWorkspace::angles says; corners are added. Between points a limit
  /// may be violated by about the square of their distance times the curvature: see the default's effect in the table
  /// of choices.
  int points = 2000;
  /// 0: kappa^-1 as it is. 1 or -1: kappa^-1 times the sign of det J (singularity_side) and times this, which is
  /// negative at poses of the other sign. A design that is singular somewhere in W_p has kappa^-1 = 0 there whichever
  /// way its joints are moved a little; with the sign it sees which way leads out. Where t > 0 both say the same. For
  /// two and three legs.
  int side = 0;
};

/// The side (1 or -1) on which more of the outline's poses, at the ends of the ranges, are for a design. 0 for more
/// than three legs.
int prevailing_side(const SynthesisTask& task, const Eigen::VectorXd& design, int points = 100);

/// Variables [d, t], -1 <= t <= 1, objective -t. Inequalities, range by range and point by point: t - kappa^-1 at each
/// end, then each limit of each leg (a length, see dextrous_limits.hpp). A limit is one constraint at a slice and two
/// over a wider range, the largest value over its lower and over its upper half: then none has a kink where it is
/// active (wide angle limits left aside, which have one at a single orientation too). Gradients, Jacobian and Hessian
/// of the Lagrangian are exact; the Jacobian holds only the entries that can differ from zero.
Problem pointwise_problem(const SynthesisTask& task, const PointwiseOptions& options = {});

/// The start [d, t] of the pointwise problem from a design: t is the smallest kappa^-1 over the points, with the side's
/// sign where the options name one.
Eigen::VectorXd pointwise_start(const SynthesisTask& task, const Eigen::VectorXd& design,
                                const PointwiseOptions& options = {});

/// A design seen from outside of any formulation: over `points` directions of the outline and its corners.
struct Assessment {
  double kappa_inverse = 0.0;              ///< smallest kappa^-1 at the ends of the ranges
  Eigen::Vector2d kappa_inverse_at;        ///< where
  double kappa_inverse_orientation = 0.0;  ///< at which end, radians
  /// Smallest kappa^-1 at `orientations` equally spaced orientations of each range, its ends among them.
  double kappa_inverse_throughout = 0.0;
  /// Largest violation of a leg's limit at any orientation of the ranges, in closed form; a length, 0 when none is
  /// violated.
  double violation = 0.0;
  Eigen::Vector2d violation_at;        ///< where the largest value of a limit is, violated or not
  double violation_orientation = 0.0;  ///< at which orientation, radians
  Limit violation_limit;               ///< which limit it is
};

/// Throws std::invalid_argument as AreaFormulation does, and when points < 1 or orientations < 2.
Assessment assess(const SynthesisTask& task, const Eigen::VectorXd& design, int points = 2000, int orientations = 21);

}  // namespace reprise
