#pragma once

// Dynamic-Q: successive approximation of a nonlinear program by spherical quadratic ones.
//
// At the iterate x^i each function F (f, g_j, h_k) is replaced by
//     F~(x) = F(x^i) + grad F(x^i) . (x - x^i) + (c / 2) |x - x^i|^2,
//     c     = 2 [F(x^(i-1)) - F(x^i) - grad F(x^i) . (x^(i-1) - x^i)] / |x^(i-1) - x^i|^2,      c = 0 at the start,
// which meets F at the iterate, with its gradient, and at the previous iterate; no Hessian is stored. The next iterate
// minimises f~ subject to g~ <= 0, h~ = 0 and the move limit |x - x^i| <= rho, by LFOPC. One gradient evaluation of
// every function for each iteration.
// J. A. Snyman and A. M. Hay, The Dynamic-Q optimization method: an alternative to SQP?, Comput. Math. Appl. 44 (2002)
// 1589-1598; the optimizer of thesis chapter 5.
//
// By default the method is that of the thesis. Three extensions of ours can be switched on:
//   - the exact solution of the approximations, in place of LFOPC (`subproblem`);
//   - a unit of its own for every variable (`scale_variables`);
//   - a safeguard, which the published method lacks: it takes every step (`safeguard`).

#include "reprise/optimizers/lfopc.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/optimizers/spherical_dual.hpp"

namespace reprise {

/// What minimises the approximations.
enum class SubproblemSolver {
  lfopc,  ///< the trajectory method of the thesis
  dual,   ///< exactly, by duality (ours)
};

/// When a step is taken (ours). A step must lower the merit
///     f + sum_j w_j max(0, g_j) + sum_k w_k |h_k|
/// below the largest merit of the last iterates; w_j is `weight` times the multiplier of constraint j in the
/// approximation, forgotten slowly. Where the approximations of the constraints contradict each other within the move
/// limit, the merit is the largest violation in units of |grad g_j|, |grad h_k|. A point that is refused takes the
/// place of the previous iterate in the approximations: they learn from it, and no gradient is spent. The move limit is
/// halved meanwhile; after a step that was taken at once and went as far as it could, it grows, else it falls back
/// towards its value at the start.
struct SafeguardOptions {
  bool active = false;      ///< whether steps are compared at all
  int memory = 30;          ///< number of last iterates whose merit a step is compared with
  double weight = 1.5;      ///< at least 1
  double forgetting = 0.9;  ///< factor of the weights at every iteration, at most 1
  double decrease = 1e-4;   ///< part of the predicted decrease of the merit that is demanded
  double growth = 1.5;      ///< factor of the move limit, at least 1
};

/// Options of the method; those marked as ours are not in the thesis.
struct DynamicQOptions {
  /// rho, the largest step of one iteration, in the unit of x or, with scale_variables, in units of the variables' own.
  double move_limit = 1.0;
  /// eps_x: stop when |x^i - x^(i-1)| / (1 + |x^i|) is below this.
  double step_tolerance = 1e-8;
  /// eps_f: stop when |f^i - f_best| / (1 + |f_best|) is below this at a feasible x^i, with f_best the best feasible
  /// value before, unless the step was cut by the move limit: across a minimum it can lead to the same value (ours).
  /// Zero switches the test off.
  double value_tolerance = 1e-10;
  /// Limit on iterations, that is, on gradient evaluations.
  long max_iterations = 500;
  /// Safeguard of ours: when a function is not finite at the new iterate, it is taken back and the step halved, up to
  /// this many times in a row. The same limit holds for the points that SafeguardOptions refuse.
  int max_halvings = 40;
  SubproblemSolver subproblem = SubproblemSolver::lfopc;  ///< what solves the subproblems
  /// Ours: variable i is measured in units of max(1, |x_i|) of the start. Move limit, spheres and eps_x then mean the
  /// same for variables of very different size.
  bool scale_variables = false;
  /// Ours: f is measured in units of its largest slope at the start (Evaluator::measure), so that a factor of the
  /// objective changes neither the steps of LFOPC, whose penalties know no unit, nor what eps_f means. The thesis takes
  /// f as it comes: a small factor makes eps_f end a run anywhere, a large one outweighs the penalties.
  bool scale_objective = false;
  SafeguardOptions safeguard;  ///< only with SubproblemSolver::dual, which knows the multipliers
  LfopcOptions lfopc;          ///< for SubproblemSolver::lfopc
  SphericalDualOptions dual;   ///< for SubproblemSolver::dual
};

/// The method. Result::solver_code is 0 (eps_x met), 1 (eps_f met), 2 (iteration limit), 3 (not finite), 4 (unbounded).
/// The result is the best iterate: the lowest f among those within Options::feasibility_tolerance, else the least
/// violated.
class DynamicQ : public Solver {
 public:
  /// Throws std::invalid_argument, naming option and value, when one is out of range.
  explicit DynamicQ(DynamicQOptions options = {});

  /// dynamic_q, dynamic_q_dual, or dynamic_q_safeguarded.
  std::string name() const override;

 private:
  Outcome solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const override;

  DynamicQOptions options_;
};

}  // namespace reprise
