#pragma once

// For authors of solvers: the problem as a solver sees it.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "reprise/optimizers/counted_functions.hpp"
#include "reprise/optimizers/finite_differences.hpp"
#include "reprise/optimizers/free_variables.hpp"
#include "reprise/optimizers/iterate_record.hpp"
#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/result.hpp"
#include "reprise/optimizers/solver.hpp"

namespace reprise {

/// The functions of a problem and their derivatives, in the solver's variables, with what is known of the last point
/// remembered: asking twice there costs once. It puts these together:
///     FreeVariables       which variables the solver sees, and in which units
///     CountedFunctions    the calls of the problem's functions, counted and limited
///     FiniteDifferences   derivatives where there are no exact ones
///     IterateRecord       history, observer and best iterate
/// Each new point at which a gradient is asked for is an iterate. For a method without derivatives every point is.
class Evaluator {
 public:
  /// The problem must be valid, and x0, of length problem.n, within its bounds. Problem and options are kept by
  /// reference.
  Evaluator(const Problem& problem, const Eigen::VectorXd& x0, const Options& options, Observer observer,
            bool every_point_is_an_iterate);
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  Eigen::Index n() const { return variables_.n(); }                    ///< number of free variables
  Eigen::Index inequalities() const { return problem_.inequalities; }  ///< number of inequalities
  Eigen::Index equalities() const { return problem_.equalities; }      ///< number of equalities
  const Options& options() const { return options_; }                  ///< of the run

  /// Bounds of the free variables, always of length n; infinite where there is none.
  const Eigen::VectorXd& lower() const { return variables_.lower(); }
  const Eigen::VectorXd& upper() const { return variables_.upper(); }  ///< of length n

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
  /// Some rows of the Jacobian of g, in the order of their indices; alone where the problem gives them so. It counts as
  /// the whole of it: a point at which both are asked for counts once.
  SparseMatrix inequality_jacobian_rows(const Eigen::VectorXd& x, const std::vector<Eigen::Index>& rows);

  /// True when the problem gives a Hessian and the options do not ask for differences throughout.
  bool has_hessian() const { return functions_.has_hessian(); }
  /// Lower triangle of the Hessian of the Lagrangian (Problem::lagrangian_hessian), n x n.
  const SparseMatrix& lagrangian_hessian(const Eigen::VectorXd& x, double objective_factor,
                                         const Eigen::VectorXd& inequality_multipliers,
                                         const Eigen::VectorXd& equality_multipliers);

  /// Largest violation at x (evaluates the constraints there when they are not remembered).
  double violation(const Eigen::VectorXd& x);

  /// For Solver::minimize: the free variables of a full vector, in the problem's own units.
  Eigen::VectorXd gather(const Eigen::VectorXd& full) const { return variables_.gather(full); }
  /// For Solver::minimize: the point where a run ends, which is x or, without it, the start, from memory or else
  /// evaluated and counted, even beyond the limits. It is no new iterate.
  Iterate settle(const std::optional<Eigen::VectorXd>& x);
  /// The iterates so far.
  IterateRecord& record() { return record_; }
  /// The calls so far.
  const Counts& counts() const { return functions_.counts(); }

 private:
  /// What is known about the last point.
  struct Known {
    bool point = false;
    bool objective = false, inequality = false, equality = false;
    bool objective_gradient = false, inequality_jacobian = false, equality_jacobian = false;
    bool some_rows = false;  ///< of the Jacobian of g were counted
    bool differences = false;
    bool recorded = false;
  };

  /// Turns to another point, forgetting what was known of the last one.
  void move_to(const Eigen::VectorXd& x);
  /// The values at the last point.
  void know_objective();
  void know_inequality();
  void know_equality();
  /// The last point with its values, all of which must be known.
  Iterate iterate() const;
  void record_iterate();
  void take_differences();

  const Problem& problem_;
  const Options& options_;
  bool every_point_is_an_iterate_;
  FreeVariables variables_;
  CountedFunctions functions_;
  FiniteDifferences differences_;
  IterateRecord record_;

  double objective_unit_ = 1.0;
  Eigen::VectorXd point_;  ///< the last point asked for, in the solver's variables
  Eigen::VectorXd full_x_, full_start_;
  Known known_;
  double f_ = 0.0;
  Eigen::VectorXd g_, h_, gradient_, full_gradient_;
  SparseMatrix full_inequality_jacobian_, inequality_jacobian_, full_equality_jacobian_, equality_jacobian_;
  SparseMatrix full_hessian_, hessian_;
};

}  // namespace reprise
