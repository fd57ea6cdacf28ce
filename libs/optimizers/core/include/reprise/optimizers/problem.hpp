#pragma once

// A nonlinear optimization problem as a plain value:
//
//     minimise    f(x),                    x in R^n
//     subject to  g_j(x) <= 0,             j = 1, ..., inequalities
//                 h_k(x)  = 0,             k = 1, ..., equalities
//                 lower <= x <= upper
//
// Derivatives are optional; a solver that needs one the problem does not give gets finite differences, counted as such.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <string>
#include <vector>

namespace reprise {

/// Jacobians and Hessians are sparse, by rows.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// minimise f(x) subject to g(x) <= 0, h(x) = 0 and bounds.
struct Problem {
  using Vector = Eigen::VectorXd;  ///< of variables, values or slopes

  std::string name;    ///< as messages and tables call it
  Eigen::Index n = 0;  ///< number of variables

  /// False when a function has kinks or jumps, so that no gradient tells an optimum: then the conditions of optimality
  /// are not looked at where a run ends.
  bool smooth = true;

  /// Bounds of length n, or empty for none; -infinity and +infinity are allowed. lower == upper fixes a variable.
  Vector lower;
  Vector upper;  ///< of length n, or empty

  std::function<double(const Vector& x)> objective;  ///< f

  /// Number of inequalities, and their values; g is passed in with the right length.
  Eigen::Index inequalities = 0;
  std::function<void(const Vector& x, Vector& g)> inequality;  ///< g(x)

  /// Number of equalities, and their values; h is passed in with the right length.
  Eigen::Index equalities = 0;
  std::function<void(const Vector& x, Vector& h)> equality;  ///< h(x)

  /// Optional: gradient of f; it has length n when it comes.
  std::function<void(const Vector& x, Vector& gradient)> objective_gradient;

  /// Optional: Jacobians of g and h, one row for each constraint. The matrix comes with the right size and with what
  /// the last call left in it. The pattern (explicit zeros included) must be the same at every x.
  std::function<void(const Vector& x, SparseMatrix& jacobian)> inequality_jacobian;
  std::function<void(const Vector& x, SparseMatrix& jacobian)> equality_jacobian;  ///< of h

  /// Optional, beside inequality_jacobian: some rows of it alone, to the last bit, in the order of their indices in
  /// `rows`. The matrix comes empty, with a row for each of them. Methods that work with few of very many inequalities
  /// ask for no more.
  std::function<void(const Vector& x, const std::vector<Eigen::Index>& rows, SparseMatrix& jacobian)>
      inequality_jacobian_rows;

  /// Optional: lower triangle of the n x n Hessian of the Lagrangian
  ///     objective_factor * f(x) + sum_j inequality_multipliers_j g_j(x) + sum_k equality_multipliers_k h_k(x),
  /// with a pattern that is the same at every x, explicit zeros included.
  std::function<void(const Vector& x, double objective_factor, const Vector& inequality_multipliers,
                     const Vector& equality_multipliers, SparseMatrix& hessian)>
      lagrangian_hessian;
};

/// Throws std::invalid_argument, naming the problem and what is wrong, when a function is missing, a count is negative,
/// or the bounds have a wrong length, are NaN or reversed, or leave no finite value (lower +infinity, upper -infinity).
void validate(const Problem& problem);

/// Makes a Jacobian function of one that fills a dense matrix (which has the right size when it comes). Every entry
/// belongs to the pattern.
std::function<void(const Eigen::VectorXd&, SparseMatrix&)> dense_jacobian(
    std::function<void(const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian)> function);

/// Copies a dense matrix into a sparse one of the same size, keeping every entry, zeros included.
void assign_dense(const Eigen::MatrixXd& dense, SparseMatrix& sparse);

/// Largest violation of the problem's bounds and constraints at x, with values g of the inequalities and h of the
/// equalities: max(0, g_j, |h_k|, lower - x, x - upper). NaN when a value is NaN.
double largest_violation(const Problem& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& g,
                         const Eigen::VectorXd& h);

/// The same with the constraints evaluated here.
double largest_violation(const Problem& problem, const Eigen::VectorXd& x);

}  // namespace reprise
