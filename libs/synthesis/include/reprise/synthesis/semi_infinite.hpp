#pragma once

// Synthesis without a sample of the outline: constraints for every direction beta of it.
//
//     maximise over [d, t]   t
//     subject to             t - kappa^-1(d, u(beta), phi) <= 0      at both ends phi of every range, or at a slice
//                            h_j(d, u(beta)) <= 0                    for every limit of every leg, over every range
//                            for all beta in [0, 2 pi)
//
// Each line is a family of constraints, a function g(d, t; beta) of the direction. A limit over a range that is no
// slice is two families, its largest value over the lower and over the upper half of the range (dextrous_limits.hpp),
// since then none has a kink where it is active. There are infinitely many constraints; at an optimum those matter that
// are the largest of their family along the outline, its peaks.
//
// Two ways to the optimum, which must agree:
//   exchange      constraints at a few directions; the peaks of all families at the solution are added where they are
//                 violated, and so on until none is. The directions are numbers like all others, no points of a grid.
//   discretised   constraints at thousands of directions at once, as one large sparse problem.
// R. Hettich, K. O. Kortanek, Semi-infinite programming: theory, methods, and applications, SIAM Rev. 35 (1993)
// 380-429.
//
// All functions throw std::invalid_argument as validate and DesignSpace do for a task that is ill-formed, for a design
// of the wrong length or one that is not finite, and, naming it, for an option or index that is out of range.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reprise/optimizers/solver.hpp"
#include "reprise/synthesis/constraint_functions.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// One constraint.
struct OutlineConstraint {
  std::size_t family;  ///< index in list_families
  double direction;    ///< beta, radians
};

/// The problem with these constraints only: variables [d, t], objective -t, inequalities in the order given, with exact
/// sparse derivatives as those of pointwise_problem, which is this problem with all families at every point.
Problem outline_problem(const SynthesisTask& task, const std::vector<OutlineConstraint>& constraints);

/// A local maximum of a family along the outline.
struct Peak {
  OutlineConstraint constraint;  ///< the family, and where on the outline
  double value;                  ///< g: t less kappa^-1, or a length
};

/// The local maxima of all families at [d, t], family by family. They are looked for between `samples` (at least 8)
/// directions of the outline (PrescribedWorkspace::angles, corners among them): around each sample that is not
/// lower than its neighbours, by Brent's method, then by Newton's on the slope. So a peak that is narrower than two
/// steps of the samples may be missed. (enclosure.hpp misses none.)
std::vector<Peak> find_peaks(const SynthesisTask& task, const Eigen::VectorXd& design, double t, int samples = 720);

/// What a design is worth over the whole outline, to rounding rather than to a step of samples.
struct OutlineAssessment {
  double kappa_inverse;  ///< smallest kappa^-1 at the ends of the ranges
  double violation;      ///< largest violation of a limit, a length; 0 when none is violated
};

/// Assesses a design at the peaks of all families, see find_peaks.
OutlineAssessment assess_outline(const SynthesisTask& task, const Eigen::VectorXd& design, int samples = 720);

/// How the exchange works.
struct ExchangeOptions {
  /// Directions of the first round, at which all families are taken, in addition to the peaks of the start; at least 1.
  int first_directions = 12;
  int samples = 720;  ///< of find_peaks
  /// The exchange ends when no peak is above this (t less kappa^-1, and lengths); positive.
  double violation_tolerance = 1e-10;
  int max_rounds = 60;  ///< of the exchange
};

/// One round of the exchange.
struct ExchangeRound {
  std::size_t constraints;  ///< of the round's problem
  double t;                 ///< of its solution
  double violation;         ///< largest peak at its solution
};

/// What an exchange or a discretised problem gives.
struct SemiInfiniteResult {
  Eigen::VectorXd design;  ///< d
  double t;                ///< as the solver has it; kappa^-1 is at least t less the violation
  double violation;        ///< largest peak at [d, t], at least 0
  /// The solver's of the last round; iteration_limit when the limit on rounds was reached.
  Status status;
  std::string message;                         ///< the solver's sentence
  std::vector<OutlineConstraint> constraints;  ///< of the last round
  std::vector<ExchangeRound> rounds;           ///< three or one of the discretised problem
  Counts counts;                               ///< of all rounds together
};

/// The exchange. The solver must be accurate to the violation tolerance, or the exchange ends at its limit on rounds.
SemiInfiniteResult solve_by_exchange(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                     const ExchangeOptions& options = {});

/// How finely the outline is divided.
struct DiscretisationOptions {
  /// Directions at which all families are taken; the corners are added to them.
  int points = 2000;
  /// The error of a sample is about the square of its step, and its effect on a flat optimum the root of that. So the
  /// problem is solved a second and a third time, with each family taken at this many directions more (0 for none)
  /// where it is within `margin` of being active at the last solution: between the neighbours of each of its highest
  /// samples, then within two of these finer steps of each of its peaks.
  int refinement = 100;
  double margin = 1e-3;  ///< of a constraint that counts as nearly active; t less kappa^-1, or a length
};

/// The large sparse problem, with all its constraints at once. Three rounds, see above, of which the last counts; the
/// violation is, as above, that between the points.
SemiInfiniteResult solve_discretised(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                     const DiscretisationOptions& options = {});

}  // namespace reprise
