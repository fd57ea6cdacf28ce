#pragma once

// Step 4 of the chord method (trace.hpp): the bifurcation points between two consecutive boundary points.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "reprise/workspace/limit_evaluator.hpp"
#include "reprise/workspace/point_solver.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

/// A boundary point with all limits there and the one that is active from here on.
struct Node {
  LimitEvaluation at;
  Eigen::Index active = -1;
};

/// Lengths that decide while a boundary is traced.
struct TraceTolerances {
  double length;          ///< the accuracy of a boundary point
  double slack;           ///< how far from zero an active limit may be
  double merge_distance;  ///< of two points that are closer, one is enough
};

/// Unit vector along the curve h_j = 0 with the workspace on its left; zero where h_j has no gradient.
Eigen::Vector2d tangent(LimitEvaluator& evaluator, const Eigen::Vector2d& u, Eigen::Index j);

/// Finds bifurcation points. Keeps what it needs from call to call, so that nothing is allocated for each point.
class BifurcationFinder {
 public:
  /// The evaluator and the solver must outlive the object.
  BifurcationFinder(LimitEvaluator& evaluator, const PointSolver& solver, double chord,
                    const TraceTolerances& tolerances)
      : evaluator_(evaluator), solver_(solver), chord_(chord), tolerances_(tolerances) {}

  /// Appends the bifurcation points between two consecutive boundary points. False when they are not joined so.
  bool connect(const Node& from, const Node& to, std::vector<BoundaryPoint>& between);
  /// The first point on the curve h_p = 0 after a boundary point at which another limit takes over, if there is one
  /// within about a chord.
  std::optional<Node> first_takeover(const Node& from);

  // Of the simpler limits that stand in for a pair at a bifurcation point.
  std::size_t simpler_evaluations() const { return simpler_evaluations_; }
  std::size_t simpler_gradients() const { return simpler_gradients_; }

 private:
  /// The same where the limit r comes between the limits p of `from` and q of `to`.
  bool connect_through(const Node& from, const Node& to, Eigen::Index r, const Eigen::Vector2d& guess);
  /// The same between two points on the curve h_p = 0. `known` is a limit that is known not to cross in between.
  bool follow(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p, Eigen::Index known);
  /// The same where the curve has no corner of its own in between.
  bool follow_smoothly(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p, Eigen::Index known);
  /// Whether the curve h_p = 0 itself has a corner between two points on it; own_corner_ is there.
  bool find_own_corner(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p);

  bool find_bifurcation(Eigen::Index p, Eigen::Index q, const Eigen::Vector2d& guess, LimitEvaluation& result);
  /// The limit other than p and q that a point violates most, or nothing.
  std::optional<Eigen::Index> violated(const LimitEvaluation& at, Eigen::Index p, Eigen::Index q) const;
  /// Whether a point can lie on the walk after b^i and before b^(i+1).
  bool lies_after(const Node& from, const Eigen::Vector2d& u);
  bool lies_before(const Node& to, const Eigen::Vector2d& u);

  LimitEvaluator& evaluator_;
  const PointSolver& solver_;
  double chord_;
  TraceTolerances tolerances_;
  std::size_t simpler_evaluations_ = 0;
  std::size_t simpler_gradients_ = 0;
  std::vector<BoundaryPoint>* between_ = nullptr;  ///< of the call at work
  LimitEvaluation middle_;
  LimitEvaluation corner_;
  LimitEvaluation own_corner_;
  LimitEvaluation first_crossing_;
  LimitEvaluation second_crossing_;
};

}  // namespace reprise
