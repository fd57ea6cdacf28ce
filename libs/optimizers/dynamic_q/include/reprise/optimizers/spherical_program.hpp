#pragma once

// The one kind of problem that Dynamic-Q makes of every other: all functions are spherical quadratics in the step s,
//     F(s) = F_0 + a . s + (c / 2) |s|^2.

#include <Eigen/Core>

namespace reprise {

/// Spherical quadratics F_k(s) = value_k + gradient_k . s + (curvature_k / 2) |s|^2, one for each row.
struct SphericalQuadratics {
  Eigen::VectorXd value;      ///< F_0
  Eigen::MatrixXd gradient;   ///< a, one row for each function
  Eigen::VectorXd curvature;  ///< c

  Eigen::Index size() const { return value.size(); }  ///< number of functions
};

/// minimise objective(s) subject to inequality(s) <= 0, equality(s) = 0, |s| <= move_limit, lower <= s <= upper.
struct SphericalProgram {
  SphericalQuadratics objective;   ///< of size 1
  SphericalQuadratics inequality;  ///< one row for each inequality
  SphericalQuadratics equality;    ///< one row for each equality
  double move_limit = 1.0;         ///< of |s|, positive
  Eigen::VectorXd lower;           ///< of length n, -infinity where there is no bound
  Eigen::VectorXd upper;           ///< of length n, +infinity where there is no bound
};

}  // namespace reprise
