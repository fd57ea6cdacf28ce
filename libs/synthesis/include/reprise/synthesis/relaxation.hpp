#pragma once

// What to change where no design reaches the prescribed workspace.
//
// The least violation is the solution of
//     minimise over [d, s]   s    subject to   h_j(d, u(beta), phi) <= s    for every limit j of every leg, every
//                                              direction beta of the outline, every phi of the ranges.
// Where s > 0 no design near d reaches the workspace: by s, a length, the worst limit is violated, wherever the joints
// go. (Maximum lengths are convex functions of the joints; where only they bind, no design at all does.)
//
// A relaxation lets one thing of the task give by an amount a >= 0, and the least one is the solution of
//     minimise over [d, a]   a    subject to   h_j(d, a; u, phi) <= 0    for the same j, u and phi,
// after min s over [d, a, s] has told whether there is an amount that helps. What can give:
//     maximum lengths   l_max + a, of one leg or of all
//     minimum lengths   l_min - a, of one leg or of all that have one
//     lengths           both
//     workspace         u = O' + (1 - a) (u_0 - O'), the prescribed workspace shrinks about its centre
//     orientations      phi = m + (1 - a) (phi_0 - m), the ranges and slices shrink about the middle m of them all
//     bounds            lower - a and upper + a, of every design variable that moves joints only
//
// Outline and range decide over the inside too. At a fixed orientation with q = c - R(phi) p: the set |u - q| <= l_max
// is convex; where an angle limit is violated inside, it is so along a ray from q that leaves the workspace; and a
// disc |u - q| < l_min that meets the workspace but not its outline lies in it. So one thing is added: for a leg with
// l_min > 0 and the middle phi of each range, q must not lie inside,
//     l_min - D(q) <= s,    D the distance of q from the outline, negative inside.
// (For the other phi of the range it follows: on its way inside q would cross the outline, which l_min forbids.)
//
// Both are semi-infinite problems and are solved by exchange, as in semi_infinite.hpp: a solver works on a few rows
// (j, beta), the peaks of all limits along the outline at its solution that are violated join, and so on until none is.
// A row that has been slack for some rounds leaves, once at most, so that this ends; a peak that has hardly moved takes
// the place of its row. So the set stays about as small as the number of variables. Limits are 1-Lipschitz in u, so
// that only samples within one step of the largest value are looked at more closely.
// R. Hettich, K. O. Kortanek, SIAM Rev. 35 (1993) 380-429; E. Polak, Optimization: algorithms and consistent
// approximations, Springer, 1997, chapter 3, on minimising a maximum.
//
// The searches are local: an amount found does (verify it, see enclosure.hpp), a smaller one may do as well. All
// functions throw std::invalid_argument for a task that is ill-formed, a design of the wrong length or not finite, and,
// naming it, for an option, an amount or a leg that is out of range.

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "reprise/optimizers/solver.hpp"
#include "reprise/synthesis/synthesis_task.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

/// What a task can give way in; see the head of this file.
enum class RelaxationKind { lengths, maximum_lengths, minimum_lengths, workspace, orientations, bounds };

/// One thing that gives.
struct Relaxation {
  RelaxationKind kind;                            ///< what gives
  std::optional<std::size_t> leg = std::nullopt;  ///< of lengths, from 0; none: all legs alike
};

/// The largest amount: infinite for maximum lengths and bounds; where minimum lengths give, 999/1000 of the smallest of
/// them; 999/1000 for workspace and orientations. 0 where there is nothing to give: no minimum length, one slice, no
/// finite bound.
double largest_amount(const SynthesisTask& task, const Relaxation& relaxation);

/// The smallest of the minimum lengths that give, a length; infinite where none does. Another amount than the largest
/// that relax() takes: the limit it is of vanishes then, and with it the hole that the leg leaves in a workspace, which
/// any part of it would keep.
double smallest_minimum_length(const SynthesisTask& task, const Relaxation& relaxation);

/// The task that has given way. The amount, at least 0 and at most the largest or, of minimum lengths, the smallest one
/// itself, is a length, or a share of workspace and orientations.
SynthesisTask relax(const SynthesisTask& task, const Relaxation& relaxation, double amount);

/// How exactly a design is searched for.
struct ReachOptions {
  /// Samples of the outline between which peaks are looked for, in addition to the corners; at least 8.
  int samples = 180;
  /// The exchange ends when no limit at a peak is above the solution's value by more than this length; positive.
  double tolerance = 1e-7;
  int max_rounds = 40;  ///< of the exchange
  /// The search for the least violation ends where the largest value of a limit is at most this (a length). Minus
  /// infinity: it goes on to the design that is farthest from all limits.
  double enough = 0.0;
  /// Polled before every evaluation; true ends the search with what there is.
  std::function<bool()> stop = {};
};

/// A limit at the pose where it is largest.
struct LimitAtPose {
  Limit limit;               ///< of which leg, and of which kind
  Eigen::Vector2d position;  ///< u
  double orientation;        ///< radians
  double value;              ///< h, a length; positive: violated
};

/// What both searches cost.
struct SearchCost {
  long evaluations = 0;  ///< of the working set's limits, at one design each
  long rounds = 0;       ///< of the exchange
  std::size_t rows = 0;  ///< of the largest working set
};

/// The design that misses the workspace least.
struct LeastViolation {
  Eigen::VectorXd design;  ///< d
  double largest;          ///< the largest value of a limit, a length; positive: by so much the workspace is missed
  /// Every limit that is as large, within a ten-thousandth and 1e-6, each where it is largest; the largest first.
  std::vector<LimitAtPose> binding;
  std::vector<Eigen::Index> binding_bounds;  ///< design variables at a bound
  SearchCost cost;                           ///< of the whole search
};

/// From a design, moved into the bounds.
LeastViolation find_least_violation(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                    const ReachOptions& options = {});

/// The least amount by which the task must give way.
struct LeastRelaxation {
  bool found = false;      ///< the relaxed task is reached within the tolerance
  double amount = 0.0;     ///< see relax()
  Eigen::VectorXd design;  ///< of the relaxed task
  double largest = 0.0;    ///< largest value of a limit of the relaxed task there
  SearchCost cost;         ///< of the whole search
};

/// From a design, moved into the bounds. `enough` has no meaning here.
LeastRelaxation find_least_relaxation(const SynthesisTask& task, const Relaxation& relaxation,
                                      const Eigen::VectorXd& design, const Solver& solver,
                                      const ReachOptions& options = {});

}  // namespace reprise
