#pragma once

// How single points of a workspace boundary are found: the three problems of the chord method.
//
//     ray          max r^2      subject to h_j(u0 + r s) <= 0                               (5.16), (5.17)
//     chord        min w^2      subject to h_j(b + d [cos(psi + w), sin(psi + w)]) <= 0      (5.18), (5.19)
//     bifurcation  min h_p(u)^2 + h_q(u)^2                                                  (5.20)
//
// The thesis gives (5.16) and (5.20); the page with (5.17) to (5.19) is missing from its copies, and those are
// reconstructed by analogy with its (5.30) and (5.31). Of a ray the first exit is wanted, since a workspace need not be
// convex; of a chord the feasible direction nearest to psi in the positive sense, with psi outside the workspace.

#include <Eigen/Core>
#include <string>

#include "reprise/optimizers/solver.hpp"
#include "reprise/workspace/limit_evaluator.hpp"

namespace reprise {

/// The farthest point of the workspace along a ray.
struct RayProblem {
  Eigen::Vector2d start;      ///< u0, inside the workspace
  Eigen::Vector2d direction;  ///< s, of length 1
  double reach;               ///< no point of the workspace on the ray is farther than this
  double chord;               ///< d: the scale of the steps along the ray
};

/// The next boundary point, at one chord from the last.
struct ChordProblem {
  Eigen::Vector2d point;  ///< b, on the boundary
  double chord;           ///< d
  double outward;         ///< psi, an angle
  double predicted;       ///< the direction expected for the chord, an angle
};

/// The point where two limits are both zero, problem (5.20).
struct BifurcationProblem {
  Eigen::Index first;     ///< p
  Eigen::Index second;    ///< q
  Eigen::Vector2d start;  ///< near the point wanted
  double chord;           ///< d: the point is wanted within a few chords of the start
};

/// What a point solver found, or why it found nothing.
struct SolvedPoint {
  /// How a search for a point ended.
  enum class Outcome {
    found,
    no_feasible_direction,  ///< no point of a chord's circle is in the workspace: the chord is too long
    failed,
  };

  Outcome outcome = Outcome::failed;                   ///< how the search ended
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< the point; (0, 0) when none was found
  std::string message;                                 ///< why it failed
};

/// Finds boundary points by one method.
class PointSolver {
 public:
  virtual ~PointSolver() = default;

  /// `tolerance` is the length to which a point must meet its limits, where the method can do so.
  virtual SolvedPoint solve_ray(LimitEvaluator& limits, const RayProblem& problem, double tolerance) const = 0;
  /// The next boundary point of a walk.
  virtual SolvedPoint solve_chord(LimitEvaluator& limits, const ChordProblem& problem, double tolerance) const = 0;
  /// The point where two limits meet.
  virtual SolvedPoint solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& problem,
                                        double tolerance) const = 0;

  /// How far from zero the limits active at this method's points may be, at a chord length; at least `tolerance`.
  virtual double attainable(double tolerance, double chord) const = 0;
};

/// The default: a bracket of the largest h_j, narrowed by Algorithm TOMS 748 (Boost.Math); Newton for (5.20).
///
/// Ray: steps of the clearance, which cannot leave the workspace, until the clearance is below d / 1000; then steps of
/// d / 1000. So the exit is the first one, unless the ray crosses a gap that is narrower than this. Where the limits
/// have no Lipschitz constant all steps are d / 4, and so is the width of such gaps.
///
/// Chord: a bracket about the predicted direction is tried first (right of it outside, left of it inside). If there is
/// none, the circle is searched from psi in the positive sense by steps of violation / d, which cannot pass a feasible
/// direction, or of 0.01 rad where that is more (0.1 rad without a Lipschitz constant). If psi itself is feasible it is
/// first turned back, by up to 135 degrees, until it is not.
///
/// Bifurcation: at most 60 steps of Newton's method, none longer than d.
class BracketingPointSolver final : public PointSolver {
 public:
  SolvedPoint solve_ray(LimitEvaluator& limits, const RayProblem& problem, double tolerance) const override;
  /// See PointSolver.
  SolvedPoint solve_chord(LimitEvaluator& limits, const ChordProblem& problem, double tolerance) const override;
  /// See PointSolver.
  SolvedPoint solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& problem,
                                double tolerance) const override;
  double attainable(double tolerance, double) const override { return tolerance; }
};

/// The thesis's way: each problem is given to an optimizer unchanged, with exact gradients, and with lengths counted
/// in chords, so that its variables and constraints are of order one. Which exit or which direction a local optimizer
/// finds is up to it. A point is accepted when its limits are met, and the one active in (5.17) and (5.19) is so, to 10
/// times the feasibility tolerance (in chords).
///
/// Ray: 0 <= r <= reach, from r = d, since r^2 is stationary at r = 0; when the point found is not accepted, from 1/10,
/// 1/4 and 1/2 of the reach as well. Chord: 0 <= w <= 2 pi, from w = 0. A corner may
/// leave several local minima: when the point found is more than 45 degrees beyond the predicted direction, or is not
/// accepted, the predicted direction and w = pi/2, pi and 3 pi/2 are tried as well, and the least w counts. If psi is
/// feasible, where w = 0 would be the minimum, it is first turned back in steps of 45 degrees. Bifurcation: up to four
/// rounds, each from where the last one ended and in units of the residual it left.
class OptimizerPointSolver final : public PointSolver {
 public:
  /// Keeps a reference to the solver, which must outlive it. Ill-formed options are reported by the solver, at the
  /// first problem.
  explicit OptimizerPointSolver(const Solver& solver, Options options = default_options());

  /// A feasibility tolerance of 1e-8, at most 1000 evaluations for one problem, no history, and no check of
  /// stationarity: a point is judged by the limits themselves.
  static Options default_options();

  SolvedPoint solve_ray(LimitEvaluator& limits, const RayProblem& ray, double tolerance) const override;
  /// See PointSolver.
  SolvedPoint solve_chord(LimitEvaluator& limits, const ChordProblem& chord, double tolerance) const override;
  /// See PointSolver.
  SolvedPoint solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& bifurcation,
                                double tolerance) const override;
  double attainable(double tolerance, double chord) const override;

 private:
  const Solver& solver_;
  Options options_;
};

}  // namespace reprise
