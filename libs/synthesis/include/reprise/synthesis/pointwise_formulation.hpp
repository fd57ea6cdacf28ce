#pragma once

// A smooth formulation of a synthesis (synthesis_task.hpp): maximise t subject to kappa^-1 >= t and to every limit of
// every leg at many points of the outline, with exact sparse first and second derivatives.

#include <Eigen/Core>

#include "reprise/optimizers/problem.hpp"
#include "reprise/synthesis/constraint_functions.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// The pointwise formulation's numerical choices.
struct PointwiseOptions {
  /// Number of outline points, spread as PrescribedWorkspace::angles says; corners are added. Between points a limit
  /// may be violated by about the square of their distance times the curvature: see the default's effect in the table
  /// of choices.
  int points = 2000;
  /// A design that is singular somewhere in W_p has kappa^-1 = 0 there whichever way its joints are moved a little;
  /// with the sign of one side it sees which way leads out. Where t > 0 both say the same.
  SingularitySide side = SingularitySide::either;
};

/// The side on which more of the outline's poses, at the ends of the ranges, are for a design; `either` for more than
/// three legs.
SingularitySide prevailing_side(const SynthesisTask& task, const Eigen::VectorXd& design, int points = 100);

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

}  // namespace reprise
