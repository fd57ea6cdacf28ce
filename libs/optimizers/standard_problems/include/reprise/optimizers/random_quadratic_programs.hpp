#pragma once

// Convex quadratic programs at random whose optimum is known, because they are built around it:
//
//     minimise    factor (x . Q x / 2 + c . x),        x in R^n,  n = 1, ..., 12
//     subject to  a_j . x <= b_j,                      j = 1, ..., m,  0 <= m <= 2 n
//                 -50 <= x_i <= 50.
//
// Q = M^T M + I / 10 with the entries of M, as those of a_j, in [-1, 1]. The optimum x* lies in [-10, 10]^n; up to
// min(m, n) inequalities are active there, with multipliers lambda_j in [0.1, 2], the others have a slack in [0.1, 5],
// and c = -Q x* - sum_j lambda_j a_j makes x* the only point where the conditions of optimality hold. The start lies in
// [-5, 5]^n and need not be feasible.
//
// The same programs in bent coordinates y are nonlinear, and neither their objective nor their constraints are convex:
//
//     x_i = y_i + alpha_i sin y_i + beta_i sin y_(i-1),     |alpha_i| <= 0.8,  |beta_i| <= 1.5,  no bounds on y.
//
// The map from y to x is one to one, and its Jacobian, which is triangular, is never singular. So the conditions of
// optimality hold at y just where they hold at x: still at a single point, the optimum. A claim of success anywhere
// else is false, and not another local minimum.
//
// The random numbers are our own (splitmix64; S. Vigna, public domain) and take 53 bits each, so that a seed means the
// same program with every standard library.

#include <Eigen/Core>
#include <cstdint>

#include "reprise/optimizers/problem.hpp"

namespace reprise {

/// A problem whose optimum is known by construction.
struct RandomQuadraticProgram {
  Problem problem;          ///< with exact gradients, Jacobian and Hessian
  Eigen::VectorXd start;    ///< where a solver begins
  Eigen::VectorXd optimum;  ///< x*, to rounding
  double f_optimum = 0.0;   ///< factor included
  int active = 0;           ///< number of inequalities that are active at the optimum
};

/// The program of a seed. `factor` multiplies the objective, as another unit of it would; positive and finite, else
/// std::invalid_argument is thrown.
RandomQuadraticProgram random_quadratic_program(std::uint64_t seed, double factor = 1.0);

/// The same in bent coordinates: start, optimum and problem in y.
RandomQuadraticProgram bent_quadratic_program(std::uint64_t seed, double factor = 1.0);

}  // namespace reprise
