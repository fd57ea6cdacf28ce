#pragma once

// Least squares with nonnegative unknowns,  min |A x - b|  over  x >= 0,  with a sparse A.
//
// The active-set method of C. L. Lawson and R. J. Hanson (Solving Least Squares Problems, 1974, chapter 23): unknowns
// are let in one by one, the one first along which the residual falls fastest; each set is solved without bounds by a
// sparse QR factorisation (SuiteSparse's SPQR, or Eigen's); what would become negative is put back. It ends at a
// minimum, by the conditions of optimality, after finitely many steps.
//
// It is public since certificates of syntheses need it too: their constraints are peaks along an outline, whose number
// and places change with the design, and not the inequalities of a Problem that kkt_residual could be given.

#include <Eigen/Core>
#include <optional>

#include "reprise/optimizers/problem.hpp"

namespace reprise {

/// The minimum, and what it cost.
struct NonnegativeLeastSquares {
  Eigen::VectorXd x;  ///< >= 0
  double residual;    ///< |A x - b|, Euclidean
  int iterations;     ///< factorisations
  bool converged;     ///< false when the limit on factorisations was reached
};

/// When the search ends.
struct NonnegativeLeastSquaresOptions {
  double residual_tolerance = 0.0;  ///< a residual that is at most this is small enough
  /// Limit on factorisations; without it 10 n + 10. Where it is reached x is feasible, but the residual may be larger
  /// than it must be.
  std::optional<Eigen::Index> max_iterations = std::nullopt;
};

/// A is m x n, b of length m. Throws std::invalid_argument when the lengths differ or an entry is not finite.
NonnegativeLeastSquares nonnegative_least_squares(const SparseMatrix& a, const Eigen::VectorXd& b,
                                                  NonnegativeLeastSquaresOptions options = {});

}  // namespace reprise
