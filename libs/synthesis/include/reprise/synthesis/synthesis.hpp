#pragma once

// Dimensional synthesis: the design whose worst conditioning over a prescribed workspace is best, among those that
// reach all of it (thesis chapter 5, sections 5.6 and 5.7).
//
//     maximise over d   min over u in W_p and slices phi of  kappa^-1(d, u, phi)
//     subject to        W_p within the constant-orientation workspace W_c[phi] of d, for each slice
//
// One slice is the thesis's SO synthesis (5.34), several are its MO synthesis (5.37). The minimum over W_p is looked
// for on its outline, as the thesis does. Two formulations make an optimization problem of it:
//
//   area        the thesis's: W_c by the chord method, the part of W_p outside of it as one constraint, (5.35) and
//   (5.38);
//               values only, neither f nor g is smooth.
//   pointwise   maximise t subject to kappa^-1 >= t and to every limit of every leg at many points of the outline;
//   smooth,
//               with exact sparse first and second derivatives.

#include <Eigen/Core>
#include <vector>

#include "reprise/kinematics/conditioning.hpp"
#include "reprise/optimizers/problem.hpp"
#include "reprise/synthesis/area_measure.hpp"
#include "reprise/synthesis/design_space.hpp"
#include "reprise/synthesis/prescribed_workspace.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

/// What is asked for.
struct SynthesisTask {
  PrescribedWorkspace prescribed;
  std::vector<double> orientations;  ///< the slices phi, radians; at least one, finite
  DesignSpace designs;
  Conditioning conditioning;
};

/// The area formulation's numerical choices.
struct AreaOptions {
  double chord_length = 0.02;  ///< d of the chord method, in the manipulator's unit
  /// The sectors of the area measure lie between the directions of the computed boundary points and of this many points
  /// of the prescribed outline (corners come besides), so that no tip of it falls between two of them.
  int outline_points = 360;
};

/// Everything the area formulation computes at a design.
struct AreaEvaluation {
  /// f: the smallest kappa^-1 over the slices and the outline points in the directions of the computed boundary points.
  double kappa_inverse = 0.0;
  /// g of (5.35), (5.38): the sum S over slices of the area of W_p outside of W_c if positive, else -rho^2 with rho the
  /// smallest clearance of all slices. An area.
  double constraint = 0.0;
  /// One for each slice. Where O' is outside of W_c the computed radius is 0 all round, and outside is the area of W_p.
  std::vector<AreaMeasure> slices;
  long boundary_points = 0;    ///< of all slices
  long limit_evaluations = 0;  ///< of the chord method, all slices
  /// Not `closed` when the chord method failed at some slice for another reason than O' lying outside of W_c (which has
  /// an area and is no failure); f and g are then NaN.
  TraceStatus trace_status = TraceStatus::closed;
};

/// The area formulation of a task, ready to be evaluated at many designs. A value without state: any number of threads
/// may evaluate one object.
class AreaFormulation {
 public:
  /// Throws std::invalid_argument when the task has no slice or one that is not finite, or an option is out of range.
  explicit AreaFormulation(SynthesisTask task, const AreaOptions& options = {});

  const SynthesisTask& task() const { return task_; }

  /// Throws std::invalid_argument when the design has the wrong length or is not finite.
  AreaEvaluation evaluate(const Eigen::VectorXd& design) const;

  /// (5.34), (5.37): variables d, objective -f, one inequality g. Objective and constraint share the last evaluation,
  /// so the problem is not to be used by two threads at once.
  Problem problem() const;

 private:
  SynthesisTask task_;
  AreaOptions options_;
  std::vector<double> outline_;  ///< directions of the outline's points
};

/// The pointwise formulation's numerical choices.
struct PointwiseOptions {
  /// Number of outline points at equal distances; corners come besides. Between points a limit may be
  /// violated by about the square of their distance times the curvature: see the default's effect in the table of
  /// choices.
  int points = 2000;
};

/// Variables [d, t], objective -t. Inequalities, slice by slice and point by point: t - kappa^-1, then each limit of
/// each leg (a length, see limits.hpp). Gradients, Jacobian and Hessian of the Lagrangian are exact; the Jacobian holds
/// only the entries that can differ from zero.
Problem pointwise_problem(const SynthesisTask& task, const PointwiseOptions& options = {});

/// The start [d, t] of the pointwise problem from a design: t is the smallest kappa^-1 over the points.
Eigen::VectorXd pointwise_start(const SynthesisTask& task, const Eigen::VectorXd& design,
                                const PointwiseOptions& options = {});

/// A design seen from outside of any formulation: over `points` outline directions (corners besides) and all slices.
struct Assessment {
  double kappa_inverse = 0.0;              ///< smallest kappa^-1
  Eigen::Vector2d kappa_inverse_at;        ///< where
  double kappa_inverse_orientation = 0.0;  ///< at which slice, radians
  double violation = 0.0;                  ///< largest violation of a leg's limit, a length; 0 when none is violated
  Eigen::Vector2d violation_at;            ///< where the largest value of a limit is, violated or not
  double violation_orientation = 0.0;      ///< at which slice, radians
  Limit violation_limit;                   ///< which limit it is
};

/// Throws std::invalid_argument as AreaFormulation does, and when points < 1.
Assessment assess(const SynthesisTask& task, const Eigen::VectorXd& design, int points = 2000);

}  // namespace reprise
