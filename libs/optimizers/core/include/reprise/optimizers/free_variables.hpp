#pragma once

// For authors of solvers: which of a problem's variables a solver sees, and in which units.

#include <Eigen/Core>
#include <vector>

#include "reprise/optimizers/problem.hpp"

namespace reprise {

/// The variables whose bounds are not equal, in units that the solver may choose. "Full" is a vector, or what has a
/// column for every variable, of the problem itself, in its own units.
class FreeVariables {
 public:
  /// Of a valid problem; all units are 1.
  explicit FreeVariables(const Problem& problem);

  /// The number of free variables.
  Eigen::Index n() const { return static_cast<Eigen::Index>(places_.size()); }
  /// The place of free variable i, from 0 to n - 1, in a full vector.
  Eigen::Index place(Eigen::Index i) const { return places_[static_cast<std::size_t>(i)]; }

  /// Bounds of length n in the problem's own units; infinite where there is none.
  const Eigen::VectorXd& own_lower() const { return own_lower_; }
  const Eigen::VectorXd& own_upper() const { return own_upper_; }  ///< of length n
  /// The same in the solver's units.
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }  ///< of length n

  /// One unit of the solver's variable i is this many of the problem's own: n positive numbers.
  const Eigen::VectorXd& units() const { return units_; }
  /// Takes up other units.
  void set_units(const Eigen::VectorXd& units);

  /// The free variables of a full vector, in its own units.
  Eigen::VectorXd gather(const Eigen::VectorXd& full) const;
  /// Writes the solver's variables into a full vector, never outside the bounds, where rounding may have put them.
  void spread(const Eigen::VectorXd& x, Eigen::VectorXd& full) const;

  /// Keeps the columns of the free variables, in the problem's own units.
  void restrict_columns(const SparseMatrix& full, SparseMatrix& reduced) const;
  /// The same for rows and columns.
  void restrict_both(const SparseMatrix& full, SparseMatrix& reduced) const;
  /// Turns a Jacobian with respect to the free variables into one with respect to the solver's.
  void to_solver(SparseMatrix& jacobian) const;
  /// The same for a Hessian.
  void to_solver_twice(SparseMatrix& hessian) const;

 private:
  std::vector<Eigen::Index> places_;
  std::vector<Eigen::Index> position_of_;  ///< of each full variable among the free ones, -1 when fixed
  Eigen::VectorXd own_lower_, own_upper_, lower_, upper_, units_;
};

}  // namespace reprise
