#pragma once

// Exact solution of a spherical program by its dual, in place of LFOPC (ours; the thesis has LFOPC only).
//
// The Lagrangian of spherical quadratics is one itself: with multipliers lambda_j >= 0 of the inequalities and mu_k of
// the equalities its gradient is b = a + sum lambda_j a_j + sum mu_k a_k and its curvature C = c + sum lambda_j c_j +
// sum mu_k c_k, so that it is lowest at s = -b / C, and the dual function, which contains -|b|^2 / (2 C), is smooth and
// concave where C > 0. It is also the dual of the convex program
//     minimise a . s + (c / 2) t   subject to   g_j0 + a_j . s + (c_j / 2) t <= 0,   h_k0 + a_k . s + (c_k / 2) t = 0,
//                                               |s|^2 <= t <= move_limit^2,          lower <= s <= upper,
// where t stands for |s|^2 and C / 2 is the multiplier of |s|^2 <= t. The two are solved together by a primal-dual
// interior-point method with predictor and corrector (S. Mehrotra, SIAM J. Optim. 2 (1992) 575-601), in some ten steps.
//
// If t = |s|^2 at the solution, s is a global minimum of the spherical program, whatever the signs of the curvatures.
// If not (C = 0), the objective's curvature is raised until it is so. If the constraints contradict each other within
// bounds and move limit, the least violation that all of them must be granted is found first, each in units of |a_j|,
// and s is the point with the lowest objective among those with this violation.

#include <Eigen/Core>

#include "reprise/optimizers/spherical_program.hpp"

namespace reprise {

/// When the dual counts as solved, and how the curvature is raised.
struct SphericalDualOptions {
  /// Largest error of the optimality conditions, in units of |a|, |a_j| and move_limit.
  double tolerance = 1e-10;
  int max_steps = 80;  ///< of the interior-point method
  /// Added to the curvature of the objective, in units of |a| / move_limit, so that among several minima the nearest
  /// one is found.
  double least_curvature = 1e-6;
  /// How far t may exceed |s|^2, in units of move_limit^2, before the curvature of the objective is raised.
  double slack_tolerance = 1e-6;
  /// What is added then at first, in units of |a| / move_limit; ten times as much at each of the further trials.
  double first_raise = 0.1;
  int max_raises = 5;  ///< of the curvature; beyond it the step may be inexact
};

/// A step, and how well it solves the program.
struct SphericalDualResult {
  Eigen::VectorXd step;                    ///< s, within bounds and move limit
  Eigen::VectorXd inequality_multipliers;  ///< lambda
  Eigen::VectorXd equality_multipliers;    ///< mu
  /// True when the constraints contradict each other, and a violation was granted.
  bool relaxed = false;
  int raises = 0;      ///< how often the objective's curvature was raised
  bool exact = false;  ///< the optimality conditions hold and t = |s|^2
  long steps = 0;      ///< of the interior-point method
};

/// Minimises the program. Always returns a finite step when the program's numbers are finite. Throws
/// std::invalid_argument when an option is not positive (max_raises: negative).
SphericalDualResult solve_dual(const SphericalProgram& program, const SphericalDualOptions& options = {});

}  // namespace reprise
