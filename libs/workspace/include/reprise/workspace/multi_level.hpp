#pragma once

// The dextrous workspace as the thesis computes it: by optimization on several levels (chapter 5, Section 5.5.2,
// Algorithm 5.1).
//
// The problems of the boundary, (5.30) for the ray and (5.31) for the chords, have the two constraints
//     c_1 = phi_max - w_max(u) <= 0,        c_2 = w_min(u) - phi_min <= 0,
// and to evaluate them is to solve (5.26) at u twice: see orientation_solver.hpp. This takes no closed form for granted
// but that of the inverse kinematics, and costs accordingly; dextrous_limits.hpp has the closed form.
//
// Algorithm 5.1:
//  1. The assembled point u^a: min |v(u, w) - (v_min + v_max) / 2|^2                              (5.27), (5.28)
//  2. The point of greatest dexterity u^d: max (w_max(u) - w_min(u))^2                            (5.29)
//  3. The initial boundary point b^1 on a ray from u^d                                            (5.30)
//  4. Successive boundary points at chord length d                                                (5.31)
//     Bifurcation points of type I, two limits at one extreme orientation, from the inverse kinematics there (5.32);
//     of type II, both extreme orientations at once                                               (5.33)
//  5. The boundary is closed when the next chord would pass b^1                                   (C.14)

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/workspace/dextrous_boundary.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/orientation_solver.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

/// The constraints c_1 and c_2 as limits of a workspace. So that corners between two limits of the manipulator are seen
/// as such (type I), each constraint comes once for every limit k of the manipulator, with a length L (the longest
/// arm):
///     h = L c_1 + h_k(u, w_max),    h = L c_2 + h_k(u, w_min).
/// The limit that is active at the extreme orientation has h_k = 0, hence h = L c; for the others h_k < 0, hence
/// h < L c. So the largest of all is L max(c_1, c_2), as it should be.
///
/// Where no orientation can be attained, w_ave = (phi_min + phi_max) / 2 stands in for both extremes; then one h_k is
/// positive. As the interval that holds w_ave splits, w_max or w_min jumps, and with it the limits: where that makes
/// the boundary, no solution of (5.30), (5.31) exists, and a walk ends with the status `point_solver_failed`.
///
/// Holds the last solutions and counts, so it is not to be used by two threads at once.
class MultiLevelDextrousLimits final : public OrientationRangeLimits {
 public:
  /// Keeps a reference to the solver of (5.26), which must outlive it. Throws std::invalid_argument as
  /// OrientationRangeLimits does.
  MultiLevelDextrousLimits(const Manipulator& manipulator, const Interval& orientations,
                           const OrientationSolver& solver);

  /// Limits 0 to n - 1 belong to phi_max and c_1, limits n to 2 n - 1 to phi_min and c_2, each in the order of
  /// list_limits().
  const Limit& limit(Eigen::Index j) const override;
  double critical_orientation(const Eigen::Vector2d& u, Eigen::Index j) const override;

  /// Number of solutions of (5.26), each of which gives both ends, and evaluations of all limits of the manipulator at
  /// a pose that they took.
  std::size_t inner_solutions() const { return inner_solutions_; }
  std::size_t inner_evaluations() const { return inner_evaluations_; }  ///< see inner_solutions

  Eigen::Index count() const override {
    return 2 * static_cast<Eigen::Index>(limits_.size());
  }  ///< twice those of the manipulator
  void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const override;
  /// From the implicit function theorem: dw/du = -(dh_a/du) / (dh_a/dphi) with the limit a active at w.
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j) const override;
  /// Two limits at the same extreme orientation: those of the constant-orientation workspace there (5.32).
  std::optional<LimitPair> at_bifurcation(Eigen::Index p, Eigen::Index q) const override;
  std::string label(Eigen::Index j) const override;
  Eigen::AlignedBox2d box() const override { return box_; }
  /// None is known.
  double lipschitz_constant() const override;
  double accuracy() const override;

 private:
  /// An extreme orientation at a position, and its gradient there.
  struct Extreme {
    double orientation;
    Eigen::Vector2d gradient;
  };
  struct Extremes {
    Eigen::Vector2d position;
    std::array<Extreme, 2> ends;  ///< w_max, w_min
  };

  const Extremes& extremes_at(const Eigen::Vector2d& u) const;
  Extremes solve(const Eigen::Vector2d& u) const;
  std::size_t end_of(Eigen::Index j) const { return j < count() / 2 ? 0 : 1; }

  Manipulator manipulator_;
  const OrientationSolver& solver_;
  std::vector<Limit> limits_;
  double arm_;
  Eigen::AlignedBox2d box_;
  std::array<ConstantOrientationLimits, 2> fixed_;  ///< at phi_max, at phi_min
  /// The last few positions, since a walk comes back to those it has just left.
  mutable std::vector<Extremes> known_;
  mutable std::size_t oldest_ = 0;
  mutable std::size_t inner_solutions_ = 0;
  mutable std::size_t inner_evaluations_ = 0;
};

/// The point of greatest dexterity.
struct GreatestDexterity {
  Eigen::Vector2d position;             ///< u^d
  std::optional<OrientationEnds> ends;  ///< w_min, w_max there
  Result result;                        ///< of the optimizer's best round; x is the way from the start in longest arms
  std::size_t evaluations = 0;          ///< of (5.29), all rounds: each is a solution of (5.26)
  std::size_t inner_evaluations = 0;    ///< of all limits at one pose
};

/// How many evaluations of (5.29) an optimizer gets.
inline constexpr long dexterity_evaluations = 200;

/// Solves (5.29) from a start, about the middle w_ave of the expected interval. (w_max - w_min)^2 is not smooth where
/// the limit that is active at an end changes, and its maximum is often at such a place, where a gradient-based
/// optimizer may stop early or try for long: it gets dexterity_evaluations. Any point inside the dextrous workspace
/// serves the algorithm. Where no orientation can be attained, the square of the violation at w_ave stands in. Throws
/// std::invalid_argument when the start is not finite, or as OrientationSolver does.
GreatestDexterity find_greatest_dexterity(const Manipulator& manipulator, const Eigen::Vector2d& start,
                                          const Interval& expected, const OrientationSolver& orientation_solver,
                                          const Solver& solver);

/// What Algorithm 5.1 computes, step by step.
struct DextrousMap {
  FittedPose assembled;        ///< step 1
  GreatestDexterity greatest;  ///< step 2
  TracedBoundary boundary;     ///< steps 3 to 5; indices of active limits as MultiLevelDextrousLimits counts them
  std::vector<DextrousBoundaryPoint> points;  ///< the boundary's points, described
  std::size_t inner_solutions = 0;            ///< of (5.26), steps 3 to 5
  std::size_t inner_evaluations = 0;          ///< of all limits at one pose, steps 3 to 5
};

/// Algorithm 5.1 from a start of step 1. The boundary's status is `start_outside` when u^d is not in the dextrous
/// workspace (as when that is empty). Throws std::invalid_argument for a wrong range, option or start.
DextrousMap map_dextrous_workspace(const Manipulator& manipulator, const Interval& orientations, const Pose& start,
                                   const OrientationSolver& orientation_solver, const Solver& solver,
                                   const TraceOptions& options = {},
                                   const PointSolver& point_solver = BracketingPointSolver());

}  // namespace reprise
