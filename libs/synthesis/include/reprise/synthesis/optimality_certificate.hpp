#pragma once

// How far a design is from a local optimum of the semi-infinite synthesis (semi_infinite.hpp), whoever found it.
//
// With x = [d, t], f = -t and the peaks g_i of all families along the outline, the conditions of Karush, Kuhn and
// Tucker are
//     grad f + sum_i lambda_i grad g_i = 0,    lambda_i g_i = 0,    lambda_i >= 0,    g_i <= 0.
// Given d, t is the smallest kappa^-1 over the outline, and the multipliers are those that come nearest,
//     r = min over lambda >= 0 of ( |grad f + sum_i lambda_i grad g_i|^2 + sum_i (lambda_i g_i)^2 )^(1/2),
// a sparse least-squares problem (nonnegative_least_squares.hpp). The residual r needs no decision which constraints
// are active, is zero where the first three conditions hold, and at most 1, its value for lambda = 0. The fourth is the
// violation, given apart. Lengths are in the manipulator's unit. Bounds of the design space count as constraints.
//
// Of second order, the peaks move with the design: with the derivative along beta as an index, the peak of a smooth
// piece of the outline has the Hessian of
//     G_i(x) = max over beta of g_i(x, beta):    g_xx - g_xb g_bx / g_bb,    g_bb < 0,
// (at a corner g_xx alone). A design with r = 0 and no violation is a strict local optimum when sum_i lambda_i G_i has
// positive curvature in every direction that keeps all constraints with positive multipliers at zero: the tangent
// space, which holds the cone of the critical directions.
// R. Hettich and K. O. Kortanek, SIAM Rev. 35 (1993) 380-429, section 4.

#include <Eigen/Core>
#include <vector>

#include "reprise/synthesis/semi_infinite.hpp"

namespace reprise {

/// When a constraint counts as active.
struct CertificateOptions {
  int samples = 720;  ///< of find_peaks
  /// A constraint is active when it is within this of zero (t less kappa^-1, or a length); not negative.
  double active_tolerance = 1e-7;
  /// A multiplier counts as positive, for the tangent space, when it is above this and above |g| of its constraint:
  /// near an optimum that tells what is active there. Positive.
  double multiplier_tolerance = 1e-7;
};

/// A peak that is active or has a positive multiplier.
struct ActiveConstraint {
  OutlineConstraint constraint;  ///< which one, and where on the outline
  Eigen::Vector2d position;      ///< u
  double value;                  ///< g
  double multiplier;             ///< at least 0
};

/// How far the conditions of optimality hold at a design.
struct OptimalityCertificate {
  double kappa_inverse;                  ///< t: smallest kappa^-1 along the outline, at the ends of the ranges
  double violation;                      ///< largest violation of a limit, a length
  double kkt_residual;                   ///< r
  double stationarity;                   ///< the first part of r, the gradients'
  double complementarity;                ///< the second part
  std::vector<ActiveConstraint> active;  ///< family by family
  Eigen::VectorXd bound_multipliers;     ///< of the design's bounds, positive at upper, negative at lower ones

  Eigen::Index tangent_dimension;  ///< of the tangent space
  double smallest_curvature;       ///< of the Lagrangian there, infinite where the dimension is 0

  /// How fast t* grows when limit j of list_limits is loosened, per length: the sum of its multipliers, at least 0. At
  /// an optimum that is dt*/dl_max for a maximum, -dt*/dl_min for a minimum length.
  std::vector<double> limit_sensitivities;
  /// How t* changes with the size of the prescribed workspace, scaled about O' by 1 + e: dt*/de at e = 0.
  double size_sensitivity;
};

/// Throws std::invalid_argument as find_peaks does, and when an option is out of range.
OptimalityCertificate certify_optimality(const SynthesisTask& task, const Eigen::VectorXd& design,
                                         const CertificateOptions& options = {});

/// A design at which the conditions hold better.
struct RefinedOptimum {
  Eigen::VectorXd design;  ///< d
  double kkt_residual;     ///< r at the design
  int steps;               ///< taken; 0 when none made r smaller
};

/// Newton's method on the conditions above, with the constraints of positive multipliers as equations and the peaks
/// moving: from a design near a local optimum to that optimum within rounding. An exchange stops when violations are
/// small, which along a flat direction fixes the design to their square root only. A step counts as long as it makes r
/// smaller, at most 20 do. Throws as certify_optimality.
RefinedOptimum refine_optimum(const SynthesisTask& task, const Eigen::VectorXd& design,
                              const CertificateOptions& options = {});

}  // namespace reprise
