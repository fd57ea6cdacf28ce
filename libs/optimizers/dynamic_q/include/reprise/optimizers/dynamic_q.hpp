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

#include "reprise/optimizers/lfopc.hpp"
#include "reprise/optimizers/solver.hpp"

namespace reprise {

struct DynamicQOptions {
  /// rho, the largest step of one iteration, in the unit of x.
  double move_limit = 1.0;
  /// eps_x: stop when |x^i - x^(i-1)| / (1 + |x^i|) is below this.
  double step_tolerance = 1e-8;
  /// eps_f: stop when |f^i - f_best| / (1 + |f_best|) is below this at a feasible x^i, with f_best the best feasible
  /// value before. Zero switches the test off.
  double value_tolerance = 1e-10;
  /// Limit on iterations, that is, on gradient evaluations.
  long max_iterations = 500;
  /// Safeguard of ours: when a function is not finite at the new iterate, it is taken back and the step halved, up to
  /// this many times in a row.
  int max_halvings = 40;
  LfopcOptions lfopc;
};

/// The method. Result::solver_code is 0 (eps_x met), 1 (eps_f met), 2 (iteration limit), 3 (not finite), 4 (unbounded).
/// The result is the best iterate: the lowest f among those within Options::feasibility_tolerance, else the least
/// violated.
class DynamicQ : public Solver {
 public:
  /// Throws std::invalid_argument, naming option and value, when one is out of range.
  explicit DynamicQ(DynamicQOptions options = {});

  std::string name() const override { return "dynamic_q"; }

 private:
  Outcome solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const override;

  DynamicQOptions options_;
};

}  // namespace reprise
