#pragma once

// Ipopt: a primal-dual interior-point method with a filter line search.
// A. Waechter and L. T. Biegler, On the implementation of an interior-point filter line-search algorithm for
// large-scale nonlinear programming, Math. Program. 106 (2006) 25-57.

#include <memory>

#include "reprise/optimizers/solver.hpp"

namespace reprise {

struct IpoptApplications;

/// Where Ipopt has second derivatives from.
enum class IpoptHessian {
  automatic,       ///< exact where the problem gives it, else limited-memory
  limited_memory,  ///< limited-memory BFGS even where the problem gives the Hessian: first derivatives only
};

/// Options of this solver, in addition to those of all solvers.
struct IpoptOptions {
  IpoptHessian hessian = IpoptHessian::automatic;  ///< where second derivatives come from

  /// Ipopt's `tol`: largest scaled error of the optimality conditions. Ipopt's own default.
  double tolerance = 1e-8;

  /// Ipopt's `acceptable_tol`: also ends a run in which the error stays below this for 15 iterations, since rounding in
  /// finite differences can keep it above the tolerance for ever. Ipopt's own default. Not below the tolerance.
  double acceptable_tolerance = 1e-6;

  /// Ipopt's `mu_init`, the factor of the barrier terms at the start. Ipopt's own default. The terms are a sum over the
  /// inequalities: when these are thousands, the sum outweighs the objective and the run goes to their middle first,
  /// wherever it started. Positive.
  double initial_barrier = 0.1;

  /// Ipopt's `bound_push`, `bound_frac`, `slack_bound_push` and `slack_bound_frac`: how far, relatively, the start and
  /// the slacks of its inequalities are moved inside their bounds. Ipopt's own default. A start at which many
  /// inequalities are active or nearly so is left for good by that; a small number, with a small initial barrier, keeps
  /// it. In (0, 0.5].
  double initial_push = 0.01;

  /// Limit on iterations. Ipopt's own default.
  long max_iterations = 3000;

  /// Ipopt's `bound_relax_factor`, the relative widening of bounds and inequalities before the run. Ipopt's own default
  /// is 1e-8; here it is zero, so that no function is called outside the bounds and an active inequality g <= 0 ends
  /// with g near 0 from below, however small Options::feasibility_tolerance is. Constraints without an interior (such
  /// as x^2 <= 0) may need it.
  double bound_relax_factor = 0.0;
};

/// Solver over Ipopt with the linear solver MUMPS. Ipopt reads no option file and prints nothing. Its `constr_viol_tol`
/// is Options::feasibility_tolerance (at least 1e-14). Jacobians and Hessians are passed on with the pattern they have
/// at the start, which costs one evaluation of each there, since Ipopt moves a start that is on a bound inside.
///
/// Ipopt sees variables and objective in the units of Evaluator::measure: variable i in units of min(max(1, |x_i|) of
/// the start, distance of its bounds), f such that its largest slope at the start is 100. Where the start is steep,
/// that and Ipopt's own scaling of constraints loosen its tolerance; Solver::minimize looks at the end from outside and
/// goes on from there.
///
/// A point where a function is not finite makes Ipopt shorten its step; at the start it is a numerical_failure, and so
/// are more equalities than free variables. Ipopt calls a problem unbounded when the iterates pass 1e20; where the
/// objective is linear it may reach the limit on iterations before. Result::solver_code is Ipopt's own
/// (ApplicationReturnStatus).
///
/// Runs may be nested (a function of the problem may itself call Ipopt) and may go on in several threads at a time;
/// MUMPS is not safe for threads, so that then only the problem's functions run side by side.
class IpoptSolver : public Solver {
 public:
  /// Throws std::invalid_argument, naming option and value, when one is out of range.
  explicit IpoptSolver(IpoptOptions options = {});

  std::string name() const override { return "ipopt"; }

 private:
  Outcome solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const override;

  IpoptOptions options_;
  /// Ipopt with its options set, once for all runs that are not nested.
  std::shared_ptr<IpoptApplications> applications_;
};

}  // namespace reprise
