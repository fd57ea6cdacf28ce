#pragma once

// Tells whether a problem's derivatives are those of its functions.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/tolerances.hpp"

namespace reprise {

/// One function (f, g_j or h_k) whose given gradient was compared with its values.
struct DerivativeCheck {
  std::string
      function;  ///< "objective", "inequality 3", "equality 1" (counted from 1), or "lagrangian hessian, column 2"
  /// Largest |given - central difference| over the coordinates, over max(1, largest |entry| of the gradient).
  double coordinate_error = 0.0;
  /// The same for the directional derivative along the given gradient's own (unit) direction.
  double direction_error = 0.0;
  /// Observed order p of the Taylor remainder |F(x + t s) - F(x) - t grad F . s| = O(t^p) along a fixed direction s: 2
  /// for a right gradient of a curved function, 1 for a wrong one; infinity when the remainder is rounding only (linear
  /// F).
  double remainder_order = 0.0;
  bool passed = false;  ///< whether the derivative holds
};

/// The checks of all derivatives that a problem gives.
struct DerivativeReport {
  std::vector<DerivativeCheck> checks;  ///< one for each function whose derivative the problem gives
  bool passed() const;                  ///< whether all of them hold
};

/// Checks every derivative the problem gives at x, whether or not x is feasible. A check passes when both errors are at
/// most `tolerance` and the order is at least least_remainder_order. Throws std::invalid_argument for an ill-formed
/// problem or an x of the wrong length or not finite.
DerivativeReport check_derivatives(const Problem& problem, const Eigen::VectorXd& x,
                                   double tolerance = derivative_tolerance);

}  // namespace reprise
