#pragma once

// For authors of solvers: the calls of a problem's functions, counted and limited.

#include <Eigen/Core>
#include <vector>

#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/solver.hpp"

namespace reprise {

/// Thrown to end a run from outside its solver, with the reason.
struct StopRequest {
  Status status;       ///< of the result
  const char* reason;  ///< its message
  /// Whose run is to end: a run of another problem that is part of it lets this pass.
  const Problem* problem;
};

/// Calls the functions of a problem, x in its own variables. Each call is counted; a call of f, g or h throws
/// StopRequest instead when Options::stop says so or the limit on evaluations is reached. A function that the problem
/// does not have is not called.
class CountedFunctions {
 public:
  /// The problem must be valid. Both are kept by reference.
  CountedFunctions(const Problem& problem, const Options& options) : problem_(problem), options_(options) {}

  double objective(const Eigen::VectorXd& x);                     ///< f
  void inequality(const Eigen::VectorXd& x, Eigen::VectorXd& g);  ///< g
  void equality(const Eigen::VectorXd& x, Eigen::VectorXd& h);    ///< h

  /// True where exact derivatives are available: the problem gives them and the options do not ask for differences.
  bool has_objective_gradient() const { return is_exact(static_cast<bool>(problem_.objective_gradient)); }
  /// The same for the Jacobian of g.
  bool has_inequality_jacobian() const { return is_exact(static_cast<bool>(problem_.inequality_jacobian)); }
  /// Whether some rows of it can be had alone.
  bool has_inequality_jacobian_rows() const {
    return has_inequality_jacobian() && static_cast<bool>(problem_.inequality_jacobian_rows);
  }
  /// The same for the Jacobian of h.
  bool has_equality_jacobian() const { return is_exact(static_cast<bool>(problem_.equality_jacobian)); }
  /// The same for the Hessian of the Lagrangian.
  bool has_hessian() const { return is_exact(static_cast<bool>(problem_.lagrangian_hessian)); }

  /// Counts the gradient of f and evaluates it, where it is exact: otherwise false is returned, and it is the caller's
  /// to take differences.
  bool objective_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);
  /// The same for the Jacobian of g. A point of which some rows were counted is not `new_point`, and counts no more.
  bool inequality_jacobian(const Eigen::VectorXd& x, SparseMatrix& jacobian, bool new_point = true);
  /// The same for some rows of it (Problem::inequality_jacobian_rows), where the problem gives them.
  void inequality_jacobian_rows(const Eigen::VectorXd& x, const std::vector<Eigen::Index>& rows, SparseMatrix& jacobian,
                                bool new_point);
  /// The same for h.
  bool equality_jacobian(const Eigen::VectorXd& x, SparseMatrix& jacobian);
  /// The Hessian of the Lagrangian (Problem::lagrangian_hessian), where the problem gives it.
  void lagrangian_hessian(const Eigen::VectorXd& x, double objective_factor,
                          const Eigen::VectorXd& inequality_multipliers, const Eigen::VectorXd& equality_multipliers,
                          SparseMatrix& hessian);

  /// The calls so far.
  const Counts& counts() const { return counts_; }
  /// Whether a run may be ended from here; it may at first.
  void set_limited(bool limited) { limited_ = limited; }

 private:
  bool is_exact(bool given) const { return given && options_.derivatives == Derivatives::automatic; }
  void count_point(long& count);

  const Problem& problem_;
  const Options& options_;
  Counts counts_;
  bool limited_ = true;
};

}  // namespace reprise
