#pragma once

// What every solver returns: the point, its value, its violation, a status with a reason, and what it cost.
// result_report.hpp writes it as text.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// How a run ended, in the same words for every solver.
enum class Status {
  converged,          ///< the solver's own test was met, at a point that is feasible within the tolerance
  infeasible,         ///< the solver ended of itself, but its point violates a constraint by more than the tolerance
  unbounded,          ///< the objective or the point ran off without a limit
  iteration_limit,    ///< the solver's limit on iterations was reached
  evaluation_limit,   ///< the limit on function evaluations was reached
  stopped,            ///< the observer or Options::stop asked to stop
  numerical_failure,  ///< a function was not finite where it was needed, or the solver could not go on; see the message
  not_stationary,  ///< the solver's own test was met, at a feasible point, but the conditions of optimality do not hold
  wrong_derivative,  ///< a derivative that the problem gives is not that of its function (Options::check_derivatives)
};

/// The status as one lower-case word, as the tables write it.
std::string_view to_string(Status status);

/// Calls of the problem's functions. Those that finite differences need are counted in. A gradient by differences
/// counts as one evaluation of the gradient as well.
struct Counts {
  long objective = 0;            ///< of f
  long inequality = 0;           ///< of all g together
  long equality = 0;             ///< of all h together
  long objective_gradient = 0;   ///< of the gradient of f
  long inequality_jacobian = 0;  ///< of the Jacobian of g
  long equality_jacobian = 0;    ///< of the Jacobian of h
  long lagrangian_hessian = 0;   ///< of the Hessian of the Lagrangian

  /// N_f: number of points at which the functions were evaluated (the largest of the three function counts).
  long function_evaluations() const;
  /// N_g: number of points at which gradients were evaluated (the largest of the three gradient counts); thesis,
  /// Table 5.3.
  long gradient_evaluations() const;

  /// Adds those of another run.
  Counts& operator+=(const Counts& other);
};

/// One point of the history: a point at which a gradient was evaluated or, for a solver without derivatives, any point.
struct Iterate {
  long index = 0;          ///< 0 for the start
  Eigen::VectorXd x;       ///< in the problem's own units
  double f = 0.0;          ///< f(x)
  Eigen::VectorXd g;       ///< values of the inequalities
  Eigen::VectorXd h;       ///< values of the equalities
  double violation = 0.0;  ///< largest violation of bounds and constraints
  Counts counts;           ///< cost up to here
};

/// Where a run ended, why, and what it cost.
struct Result {
  Eigen::VectorXd x;       ///< best point, see the solver
  double f = 0.0;          ///< f(x)
  double violation = 0.0;  ///< of bounds and constraints, by the problem's own functions, whatever the solver said
  /// How far the conditions of optimality are from holding at x, found from outside, without a unit (kkt_residual.hpp);
  /// NaN where they were not looked at: they are where a solver claims success at a feasible point of a smooth problem.
  double kkt_residual = std::numeric_limits<double>::quiet_NaN();
  Status status = Status::numerical_failure;  ///< why the run ended
  int solver_code = 0;                        ///< the solver's own return code
  std::string message;                        ///< the solver's own sentence
  Counts counts;                              ///< cost of the whole run
  long iterates = 0;                          ///< points of the history, whether or not it is kept
  std::vector<Iterate> history;               ///< empty without Options::record_history
};

}  // namespace reprise
