#pragma once

// How far the conditions of optimality are from holding at a point, whoever found it.
//
// With S = diag(s_i), where s_i = min(max(1, |x_i|), upper_i - lower_i) is the unit of variable i, the multipliers are
// those that come nearest,
//     r^2 = min over lambda, nu >= 0 and mu of
//           |S (grad f + sum_j lambda_j grad g_j + sum_k mu_k grad h_k + sum_b nu_b grad b)|^2      (the slope)
//           + sum_j (lambda_j min(0, g_j))^2 + sum_b (nu_b b)^2,                                    (complementarity)
// with b <= 0 for each finite bound, as lower_i - x_i: a nonnegative least-squares problem
// (nonnegative_least_squares.hpp), which needs no decision which constraints are active. An r below 1e-6 |S grad f| is
// not made smaller, and a constraint that is more than a unit away, to first order, has no multiplier. All its terms
// are in the unit of f, so that neither the unit of f nor that of a constraint matters. They are compared with
//     the length |S grad f| of the gradient, and with the curvature, if that is larger:
//     c = max(0, u . S (grad L(x + t S u) - grad L(x)) / t),       t = 1e-4,
// of the Lagrangian L along u, the direction opposite to the slope, so that a gradient that is small because x is near
// an optimum without active constraints does not look large for want of others; r / c is then about the distance to go,
// in units of the variables. A step that leaves the bounds is cut.
//
// The residual is r / max(|S grad f|, c): zero where the conditions of Karush, Kuhn and Tucker hold, about 1 where no
// constraint holds back the gradient. It does not depend on the units of f, g and h, and on those of the variables only
// where |x_i| is below 1 and the bounds are no closer. Where no multipliers exist at an optimum (no constraint
// qualification holds, as for x^2 <= 0) it is large there too.

#include <Eigen/Core>

#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/tolerances.hpp"

namespace reprise {

/// The units s_i of the variables at a point; 0 for a variable that is fixed by its bounds.
Eigen::VectorXd variable_units(const Problem& problem, const Eigen::VectorXd& x);

/// The residual at a point within the bounds, by the problem's gradients, and where it gives none by central
/// differences. Violations of the constraints are not looked at. NaN when a value or gradient is not finite there.
/// Throws std::invalid_argument for an ill-formed problem or an x of the wrong length or not finite, and on what the
/// problem's functions throw.
double kkt_residual(const Problem& problem, const Eigen::VectorXd& x);

}  // namespace reprise
