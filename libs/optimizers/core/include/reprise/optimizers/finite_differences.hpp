#pragma once

// For authors of solvers: derivatives where a problem gives none.

#include <Eigen/Core>

#include "reprise/optimizers/counted_functions.hpp"
#include "reprise/optimizers/free_variables.hpp"

namespace reprise {

/// Finite differences of all functions of a problem without exact derivatives, in the free variables and the problem's
/// own units. They are taken at once, so that functions that share work at a point are called together there.
class FiniteDifferences {
 public:
  /// Takes the differences about the full point x, where the functions have the values f, g and h; those of a function
  /// with exact derivatives are not looked at. Steps and kind are those of the options. Bounds are kept: a step is cut
  /// where they end, and a forward difference turns where there is more room behind.
  void take(CountedFunctions& functions, const FreeVariables& variables, const Options& options,
            const Eigen::VectorXd& x, double f, const Eigen::VectorXd& g, const Eigen::VectorXd& h);

  /// The differences of the last point: f changes by change_i over the width_i, and a column of the others for each
  /// variable is a derivative. Undefined for functions with exact ones.
  const Eigen::VectorXd& objective_changes() const { return objective_changes_; }
  const Eigen::VectorXd& widths() const { return widths_; }          ///< of length n
  const Eigen::MatrixXd& inequality() const { return inequality_; }  ///< the Jacobian of g, for n variables
  const Eigen::MatrixXd& equality() const { return equality_; }      ///< the Jacobian of h, for n variables

 private:
  Eigen::VectorXd objective_changes_, widths_;
  Eigen::MatrixXd inequality_, equality_;
  Eigen::VectorXd moved_, g_above_, g_below_, h_above_, h_below_;
};

}  // namespace reprise
