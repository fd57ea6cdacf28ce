#pragma once

// Problems with very many inequalities of which few matter: one for each of many points of a curve, say.
//
// A working set of the inequalities is given to another solver; at its solution the violated ones join the set, and so
// on until none is violated. Of neighbours on a curve, whose gradients are nearly the same, one is enough: the
// candidates are tried in turn, the most violated first, and one joins when its gradient is at an angle to those of all
// that have joined in the same round, and of all that are in the set and violated as much: where the solver cannot hold
// one row, its neighbours tell it nothing new, and nothing joins that would. So the set stays small where nothing is
// feasible. Before the first round every inequality is a candidate. The set only grows, so this ends: when none is
// violated, or none can join.
//
// The cost of the solver's own work then hardly depends on how finely the curve is sampled. The local solutions are
// those of the whole problem, but which of them is found may depend on the set.
// J. W. Blankenship and J. E. Falk, Infinitely constrained optimization problems, J. Optim. Theory Appl. 19 (1976)
// 261-281; R. Hettich and K. O. Kortanek, Semi-infinite programming: theory, methods, and applications, SIAM Rev. 35
// (1993) 380-429.

#include <memory>

#include "reprise/optimizers/solver.hpp"

namespace reprise {

/// When the exchange ends.
struct ConstraintExchangeOptions {
  /// Smallest angle between the gradients of inequalities that join in one round, radians; in (0, pi / 2). Smaller ones
  /// make the set larger and the rounds fewer.
  double angle = 0.02;
  /// Limit on rounds; positive.
  int max_rounds = 100;
};

/// The method around a solver. Counts and history are those of the whole problem over all rounds: at a point all
/// inequalities are evaluated, whatever the set. Status, code and message are the solver's of the last round, or
/// iteration_limit with the code 0 when the limit on rounds is reached.
class ConstraintExchange : public Solver {
 public:
  /// Throws std::invalid_argument, naming option and value, when one is out of range, and when there is no solver.
  explicit ConstraintExchange(std::shared_ptr<const Solver> solver, ConstraintExchangeOptions options = {});

  /// The solver's.
  std::string name() const override { return solver_->name(); }
  bool handles_equalities() const override { return solver_->handles_equalities(); }
  bool derivative_free() const override { return solver_->derivative_free(); }

 private:
  Outcome solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const override;

  std::shared_ptr<const Solver> solver_;
  ConstraintExchangeOptions options_;
};

}  // namespace reprise
