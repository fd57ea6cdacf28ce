#pragma once

// The thesis's formulation of a synthesis (synthesis_task.hpp): W_c by the chord method, the part of W_p outside of it
// as one constraint, (5.35), (5.38) and (5.40). It has values only; neither f nor g is smooth.

#include <Eigen/Core>
#include <vector>

#include "reprise/optimizers/problem.hpp"
#include "reprise/synthesis/area_measure.hpp"
#include "reprise/synthesis/synthesis_task.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

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

}  // namespace reprise
