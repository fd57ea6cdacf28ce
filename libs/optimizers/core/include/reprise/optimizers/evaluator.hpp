#pragma once

// For authors of solvers: the problem as a solver sees it, with every call counted.

#include <Eigen/Core>
#include <exception>
#include <optional>
#include <vector>

#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/result.hpp"
#include "reprise/optimizers/solver.hpp"

namespace reprise {

/// Thrown by the evaluator to end a run: the observer or Options::stop said so, or the limit on evaluations is reached.
struct StopRequest {};

/// True when a point with the first value and violation is the one to keep: finite before not finite, feasible within
/// the tolerance before infeasible, then the lower value or, of two infeasible points, the smaller violation.
bool is_better(double f, double violation, double other_f, double other_violation, double tolerance);

/// The problem in its free variables (those whose bounds are not equal). Values at the last point are remembered, so
/// that asking twice costs once; derivatives are exact or finite differences as the options say. Each new point at
/// which a gradient is asked for is an iterate: it goes into the history and to the observer.
class Evaluator {
 public:
  /// The problem must be valid; x0 of length problem.n gives the fixed variables' place.
  Evaluator(const Problem& problem, const Eigen::VectorXd& x0, const Options& options, Observer observer,
            bool every_point_is_an_iterate);

  Eigen::Index n() const { return static_cast<Eigen::Index>(free_.size()); }  ///< number of free variables
  Eigen::Index inequalities() const { return problem_.inequalities; }         ///< number of inequalities
  Eigen::Index equalities() const { return problem_.equalities; }             ///< number of equalities
  const Options& options() const { return options_; }                         ///< of the run

  /// Bounds of the free variables, always of length n; infinite where there is none.
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }  ///< of length n

  /// Changes the units in which the solver sees the problem from here on, so that its lengths and tolerances mean the
  /// same whatever units the problem has. `start` comes in the problem's own units and is returned in the new ones.
  ///   variables: variable i is measured in units of min(max(1, |start_i|), upper_i - lower_i). Such a unit depends
  ///              neither on how near a start is to zero nor on how near it is to a bound.
  ///   slope:     f is multiplied so that the largest entry of its gradient at the start, in the units of the
  ///              variables, has this size. That costs the gradient there, unless the solver asks for it anyway. A
  ///              gradient below 1e-9 or one that is not finite leaves f as it is, and so does a slope of zero.
  /// History, observer and result keep the problem's own units, and so do violations, since they are compared with
  /// Options::feasibility_tolerance.
  struct Measured {
    bool variables = false;  ///< the variables are measured
    double slope = 0.0;      ///< the largest slope that f is given; 0 leaves f alone
  };
  /// Takes up these units, and returns the start in them.
  Eigen::VectorXd measure(const Eigen::VectorXd& start, Measured measured);
  /// The unit of f: what the solver sees times this is the problem's own value.
  double objective_unit() const { return objective_unit_; }

  double objective(const Eigen::VectorXd& x);                           ///< f
  const Eigen::VectorXd& inequality(const Eigen::VectorXd& x);          ///< g
  const Eigen::VectorXd& equality(const Eigen::VectorXd& x);            ///< h
  const Eigen::VectorXd& objective_gradient(const Eigen::VectorXd& x);  ///< of f, of length n
  const SparseMatrix& inequality_jacobian(const Eigen::VectorXd& x);    ///< of g, a row for each constraint
  const SparseMatrix& equality_jacobian(const Eigen::VectorXd& x);      ///< of h, a row for each constraint

  /// True when the problem gives a Hessian and the options do not ask for differences throughout.
  bool has_hessian() const { return is_exact(static_cast<bool>(problem_.lagrangian_hessian)); }
  /// Lower triangle of the Hessian of the Lagrangian (Problem::lagrangian_hessian), n x n.
  const SparseMatrix& lagrangian_hessian(const Eigen::VectorXd& x, double objective_factor,
                                         const Eigen::VectorXd& inequality_multipliers,
                                         const Eigen::VectorXd& equality_multipliers);

  /// Largest violation at x (evaluates the constraints there when they are not remembered).
  double violation(const Eigen::VectorXd& x);

  /// For libraries that no exception may cross: runs the body and returns true; when it throws (StopRequest included)
  /// the exception is kept for Solver::minimize, and false is returned, now and at every later call: the solver must
  /// stop.
  template <class Body>
  bool attempt(Body&& body) noexcept {
    if (pending_) return false;
    try {
      body();
    } catch (...) {
      if (!pending_) pending_ = std::current_exception();
    }
    return !pending_;
  }

 private:
  friend class Solver;

  /// What is known about the last point.
  struct Known {
    bool point = false;
    bool objective = false, inequality = false, equality = false;
    bool objective_gradient = false, inequality_jacobian = false, equality_jacobian = false;
    bool differences = false;
    bool recorded = false;
  };

  /// Turns to another point, forgetting what was known of the last one.
  void move_to(const Eigen::VectorXd& x);
  /// Writes the free variables into the full vector, in the problem's own units and never outside the bounds, where
  /// rounding may have put them.
  void spread(const Eigen::VectorXd& x);
  void count_point(long& count);
  void record();
  double call_objective();
  void call_inequality(Eigen::VectorXd& g);
  void call_equality(Eigen::VectorXd& h);
  bool is_exact(bool given) const { return given && options_.derivatives == Derivatives::automatic; }
  /// Finite differences of all functions without exact derivatives at once, so that functions that share work at a
  /// point are called together there.
  void differentiate();
  /// Keeps the columns of the free variables.
  void restrict_columns(const SparseMatrix& full, SparseMatrix& reduced) const;
  /// The point where the run ends with its value and violation, from memory or else evaluated and counted, the limit
  /// notwithstanding: the given point if it is finite, else the best iterate, else the start. With at_best the best
  /// iterate comes first.
  Iterate settle(const std::optional<Eigen::VectorXd>& x, bool at_best);
  /// The free variables of a full vector.
  Eigen::VectorXd gather(const Eigen::VectorXd& full) const;
  void scale_columns(SparseMatrix& jacobian) const;

  const Problem& problem_;
  const Options& options_;
  Observer observer_;
  bool every_point_is_an_iterate_;

  std::vector<Eigen::Index> free_;
  std::vector<Eigen::Index> position_of_;  ///< of each full variable among the free ones, -1 when fixed
  Eigen::VectorXd own_lower_, own_upper_;  ///< bounds of the free variables in the problem's own units
  Eigen::VectorXd lower_, upper_;          ///< and in the solver's
  Eigen::VectorXd units_;                  ///< of the free variables
  double objective_unit_ = 1.0;
  Eigen::VectorXd full_x_, full_start_;

  Eigen::VectorXd point_;  ///< the last point asked for, free variables
  Known known_;
  double f_ = 0.0;
  Eigen::VectorXd g_, h_, gradient_, full_gradient_;
  SparseMatrix full_inequality_jacobian_, inequality_jacobian_, full_equality_jacobian_, equality_jacobian_;
  SparseMatrix full_hessian_, hessian_;
  Eigen::VectorXd g_above_, g_below_, h_above_, h_below_;
  Eigen::MatrixXd inequality_differences_, equality_differences_;

  Counts counts_;
  long iterates_ = 0;
  std::vector<Iterate> history_;
  std::optional<Iterate> best_;  ///< lowest f among feasible iterates, else lowest violation
  std::exception_ptr pending_;
  std::optional<Status> stop_status_;
  const char* stop_reason_ = "";
  bool settling_ = false;  ///< the run has ended: neither limit nor Options::stop holds any more
};

}  // namespace reprise
