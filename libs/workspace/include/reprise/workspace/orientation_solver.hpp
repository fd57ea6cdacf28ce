#pragma once

// How the ends of an interval of the orientation workspace are found: problem (5.26) of thesis chapter 5,
//
//     max (w - w_ave)^2   subject to   h_j(u, w) <= 0 for every limit j of the manipulator                     (5.26)
//
// whose two local solutions w_min <= w_ave <= w_max are the ends of the interval that holds w_ave. The thesis leaves
// open what they are where w_ave cannot be attained. Here they are then the ends of the interval nearest to w_ave: so
// they vary continuously with u when an end passes w_ave, as the problems (5.30) and (5.31) need it just outside of the
// dextrous workspace.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "reprise/kinematics/manipulator.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/workspace/limits.hpp"
#include "reprise/workspace/point_solver.hpp"

namespace reprise {

/// [w_min, w_max], radians, with the limits that are active at the ends; none is where the search ended half a turn
/// away from w_ave.
struct OrientationEnds {
  Interval interval;                           ///< phi_min and phi_max, radians
  std::array<std::optional<Limit>, 2> active;  ///< the limit that ends it on either side, if one does
};

/// Solves (5.26) by one method.
class OrientationSolver {
 public:
  virtual ~OrientationSolver() = default;

  /// The interval of W^O[u] that holds the middle w_ave of the expected one, or is nearest to it; nothing when no
  /// orientation can be attained, or none is found. An interval wider than a turn is cut half a turn away from w_ave.
  /// Adds to `evaluations` the number of orientations at which all limits were evaluated. Throws std::invalid_argument
  /// when u is not finite or `expected` is not finite and in order.
  virtual std::optional<OrientationEnds> solve(const Manipulator& manipulator, const Eigen::Vector2d& u,
                                               const Interval& expected, std::size_t& evaluations) const = 0;

  /// How far the limits active at the ends may be from zero.
  virtual double accuracy(const Manipulator& manipulator) const = 0;
};

/// From the intervals in closed form (orientation_workspace.hpp). It evaluates no limit but the two at the ends, so it
/// counts two evaluations.
class ClosedFormOrientationSolver final : public OrientationSolver {
 public:
  std::optional<OrientationEnds> solve(const Manipulator& manipulator, const Eigen::Vector2d& u,
                                       const Interval& expected, std::size_t& evaluations) const override;
  double accuracy(const Manipulator&) const override { return 0.0; }
};

/// The thesis's way: (5.26) is given to an optimizer with exact gradients, once from each end of the expected interval.
/// Limits are counted in lengths of the longest arm |p_i|, so that they are angles too. A local optimizer may pass over
/// a gap to another interval; nothing here prevents that. Where w_ave cannot be attained, min (w - w_ave)^2 gives the
/// side on which the nearest interval lies, and (5.26) its two ends. An end is accepted when all limits are met there,
/// and one of them with equality, to 10 times the feasibility tolerance; otherwise it is sought once more with w_ave
/// moved away by 1 rad, since the square has hardly a slope where an end is close to w_ave.
class OptimizerOrientationSolver final : public OrientationSolver {
 public:
  /// Keeps a reference to the solver, which must outlive it. Ill-formed options are reported by the solver, at the
  /// first problem.
  explicit OptimizerOrientationSolver(const Solver& solver, Options options = OptimizerPointSolver::default_options());

  std::optional<OrientationEnds> solve(const Manipulator& manipulator, const Eigen::Vector2d& u,
                                       const Interval& expected, std::size_t& evaluations) const override;
  double accuracy(const Manipulator& manipulator) const override;

 private:
  const Solver& solver_;
  Options options_;
};

}  // namespace reprise
