#pragma once

// The one interface of every solver.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/result.hpp"

namespace reprise {

class Evaluator;

/// Where derivatives come from.
enum class Derivatives {
  automatic,  ///< exact where the problem gives them, central differences elsewhere
  forward,    ///< forward differences for all, even where the problem gives exact ones
  central,    ///< central differences for all, even where the problem gives exact ones
};

/// What all solvers understand alike.
struct Options {
  Derivatives derivatives = Derivatives::automatic;  ///< exact where the problem gives them, unless told otherwise

  /// Gamma, the finite-difference interval, the same for every variable. Without it: eps^(1/2) max(1, |x_i|) for
  /// forward and eps^(1/3) max(1, |x_i|) for central differences. Positive.
  std::optional<double> difference_step;

  /// A point counts as feasible when its largest violation is at most this. Not negative.
  double feasibility_tolerance = 1e-6;

  /// Limit on the points at which the functions are evaluated (N_f); the check of the final point may add one.
  /// Positive.
  long max_function_evaluations = 1'000'000;

  /// Optional: asked before every evaluation of a function; true ends the run as Status::stopped, with the best point
  /// so far. A time limit or an interruption goes in here, since libraries read no clock.
  std::function<bool()> stop;

  /// Keep the history in the result.
  bool record_history = true;

  /// Where a solver claims success, look at the conditions of optimality from outside (kkt_residual.hpp). It costs one
  /// or two evaluations of the gradients, which are not counted. Runs whose end is judged by other means, or that are
  /// parts of another run, may do without.
  bool check_stationarity = true;

  /// Before the run, compare the derivatives that the problem gives with its functions, at the start
  /// (check_derivatives.hpp). Where one fails, the run does not begin and ends as Status::wrong_derivative, with a
  /// message that names it. It costs evaluations that are not counted: of all objectives, inequalities or equalities
  /// 2 n + 13, and two more for each of them. They may lie a little outside of the bounds.
  bool check_derivatives = false;
};

/// Called for every new iterate; returns false to stop the run.
using Observer = std::function<bool(const Iterate&)>;

/// What a solver itself has to say at its end; Solver::minimize makes a Result of it.
struct Outcome {
  std::optional<Eigen::VectorXd> x;           ///< in the evaluator's variables; without it, the best iterate counts
  Status status = Status::numerical_failure;  ///< why the solver ended
  int code = 0;                               ///< the library's own return code
  std::string message;                        ///< one sentence
};

/// An optimization method with its own options. Solvers hold no state of a run: one object may serve many runs.
class Solver {
 public:
  virtual ~Solver() = default;

  /// One lower-case word, as options and tables write it: dynamic_q, slsqp, ipopt, ...
  virtual std::string name() const = 0;

  /// False when the method takes inequalities and bounds only.
  virtual bool handles_equalities() const { return true; }

  /// True when the method never asks for a gradient: then every point evaluated is an iterate of the history.
  virtual bool derivative_free() const { return false; }

  /// Minimises the problem from x0 (moved into the bounds where it lies outside them). Variables fixed by equal bounds
  /// are taken out before the solver sees the problem. Value and violation are those of the problem's own functions,
  /// whatever the solver says, and a point that violates the tolerance is never reported as converged; nor, where the
  /// problem is smooth, is one at which the conditions of optimality do not hold (Status::not_stationary). A run that
  /// ends otherwise than by the solver's own test ends with its best iterate: of the feasible ones that with the lowest
  /// f, else the least violated one.
  ///
  /// Throws std::invalid_argument for an ill-formed problem, option or start (wrong length, not finite), and for
  /// equalities given to a solver that does not handle them, before any function is called; what a function of the
  /// problem or the observer throws stops the solver and reaches the caller. Nothing else is thrown: a numerical
  /// outcome is a status.
  Result minimize(const Problem& problem, const Eigen::VectorXd& x0, const Options& options = {},
                  const Observer& observer = {}) const;

 private:
  /// The method itself. All functions are called through the evaluator (evaluator.hpp), which throws StopRequest to end
  /// the run: the solver lets it pass, or keeps it until its library has returned (parked_exception.hpp).
  virtual Outcome solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const = 0;
};

}  // namespace reprise
