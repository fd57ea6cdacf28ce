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
#include <optional>
#include <string>

#include "reprise/optimizers/solver.hpp"
#include "reprise/workspace/limit_evaluator.hpp"

namespace reprise {

struct RayProblem {
  Eigen::Vector2d start;      ///< u0, inside the workspace
  Eigen::Vector2d direction;  ///< s, of length 1
  double reach;               ///< no point of the workspace on the ray is farther than this
  double chord;               ///< d: the scale of the steps along the ray
};

struct ChordProblem {
  Eigen::Vector2d point;  ///< b, on the boundary
  double chord;           ///< d
  double outward;         ///< psi, an angle
  double predicted;       ///< the direction expected for the chord, an angle
};

struct BifurcationProblem {
  Eigen::Index first;     ///< p
  Eigen::Index second;    ///< q
  Eigen::Vector2d start;  ///< near the point wanted
  double reach;           ///< the point is wanted within this distance of the start
};

/// What a point solver found, or why it found nothing.
struct SolvedPoint {
  /// No point of a chord's circle is in the workspace: the chord is too long.
  enum class Outcome { found, no_feasible_direction, failed };

  Outcome outcome = Outcome::failed;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  std::string message;  ///< in the case of failure
};

/// Finds boundary points by one method. The last evaluation of `limits` after a successful call need not be at the
/// point found. `tolerance` is the length to which a point must meet its limits, where the method can do so.
class PointSolver {
 public:
  virtual ~PointSolver() = default;

  virtual SolvedPoint solve_ray(LimitEvaluator& limits, const RayProblem& problem, double tolerance) const = 0;
  virtual SolvedPoint solve_chord(LimitEvaluator& limits, const ChordProblem& problem, double tolerance) const = 0;
  virtual SolvedPoint solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& problem,
                                        double tolerance) const = 0;

  /// The violation of a limit that this method's points may have; at least `tolerance`.
  virtual double attainable(double tolerance) const = 0;
};

/// The default: a bracket of the largest h_j, narrowed by Algorithm TOMS 748 (Boost.Math); Newton for (5.20).
///
/// Ray: steps of the clearance, which never leave the workspace, until the clearance is below d / 1000, then steps of
/// d / 1000. So the exit is the first one but for gaps between parts of the workspace that are narrower than that along
/// the ray. Where the limits have no Lipschitz constant all steps are d / 4, and so is the width of such gaps.
///
/// Chord: a bracket about the predicted direction is tried first (right of it outside, left of it inside). Otherwise
/// the circle is searched from psi in the positive sense by steps of violation / d, which cannot pass a feasible
/// direction, and of 0.01 rad where that is less (0.1 rad without a Lipschitz constant). If psi itself is feasible it
/// is first turned back until it is not.
class BracketingPointSolver final : public PointSolver {
 public:
  SolvedPoint solve_ray(LimitEvaluator& limits, const RayProblem& problem, double tolerance) const override;
  SolvedPoint solve_chord(LimitEvaluator& limits, const ChordProblem& problem, double tolerance) const override;
  SolvedPoint solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& problem,
                                double tolerance) const override;
  double attainable(double tolerance) const override { return tolerance; }
};

/// The thesis's way: each problem is given to an optimizer as it stands, with exact gradients. Which exit or which
/// direction a local optimizer finds is up to it.
///
/// Ray: r^2 is stationary at r = 0, so the start is r = d / 100; 0 <= r <= reach. Chord: 0 <= w <= 2 pi, from w = 0,
/// and when that ends at no boundary point, from the predicted direction and from w = pi/2, pi, 3 pi/2; the constraints
/// are divided by d, so that they are of order one.
class OptimizerPointSolver final : public PointSolver {
 public:
  /// Keeps a reference to the solver, which must outlive it. Throws std::invalid_argument for an ill-formed option at
  /// the first problem solved.
  explicit OptimizerPointSolver(const Solver& solver, Options options = default_options());

  /// Feasibility to 1e-8 and no history.
  static Options default_options();

  SolvedPoint solve_ray(LimitEvaluator& limits, const RayProblem& problem, double tolerance) const override;
  SolvedPoint solve_chord(LimitEvaluator& limits, const ChordProblem& problem, double tolerance) const override;
  SolvedPoint solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& problem,
                                double tolerance) const override;
  double attainable(double tolerance) const override;

 private:
  const Solver& solver_;
  Options options_;
};

}  // namespace reprise
