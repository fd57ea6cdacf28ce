#include "reprise/synthesis/optimality_certificate.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "reprise/base/require.hpp"
#include "reprise/optimizers/nonnegative_least_squares.hpp"
#include "reprise/synthesis/constraint_functions.hpp"

namespace reprise {
namespace {

/// A peak, or a bound of the design.
struct Candidate {
  Eigen::VectorXd gradient;  ///< along [d, t]
  double value;
  Eigen::MatrixXd hessian;  ///< along d, of the peak as it moves
  double growth;            ///< dg/de with the size of the prescribed workspace
};

Candidate candidate(const ConstraintFunctions& functions, ConstraintFunctions::AtDesign& at, const Peak& peak) {
  const PrescribedWorkspace& prescribed = functions.task().prescribed;
  const auto& [family, beta] = peak.constraint;
  const OutlinePoint u = prescribed.outline(beta);
  const ConstraintDerivatives g = at.derivatives(family, u.position);
  const Eigen::Index k = functions.design_size();
  Candidate result{Eigen::VectorXd(k + 1), peak.value, g.hessian.topLeftCorner(k, k), 0.0};
  result.gradient << g.gradient.head(k), functions.is_conditioning(family) ? 1.0 : 0.0;
  const Eigen::Vector2d along_u = g.gradient.tail<2>();
  result.growth = along_u.dot(u.position - prescribed.centre());
  const std::vector<double>& corners = prescribed.corners();
  const bool corner = std::binary_search(corners.begin(), corners.end(), beta);
  const double bend = along_u.dot(u.bend) + u.slope.dot(g.hessian.bottomRightCorner<2, 2>() * u.slope);
  if (!corner && bend < 0.0) {
    const Eigen::VectorXd mixed = g.hessian.topRightCorner(k, 2) * u.slope;
    result.hessian -= mixed * mixed.transpose() / bend;
  }
  return result;
}

/// min |grad f + sum lambda_i grad g_i|^2 + sum (lambda_i g_i)^2
Eigen::VectorXd nearest_multipliers(const std::vector<Candidate>& candidates, Eigen::Index n) {
  const auto count = static_cast<Eigen::Index>(candidates.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Candidate& one = candidates[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) {
      if (one.gradient[j] != 0.0) entries.emplace_back(j, i, one.gradient[j]);
    }
    entries.emplace_back(n + i, i, one.value);
  }
  SparseMatrix a(n + count, count);
  a.setFromTriplets(entries.begin(), entries.end());
  return nonnegative_least_squares(a, Eigen::VectorXd::Unit(n + count, n - 1)).x;
}

/// A basis of the directions along which no row of the matrix changes.
Eigen::MatrixXd kernel(const Eigen::MatrixXd& rows, Eigen::Index n) {
  if (rows.rows() == 0) return Eigen::MatrixXd::Identity(n, n);
  // rows = Q [T 0; 0 0] Z P', so P Z' turns the last unit vectors into a basis of the kernel. Gradients of neighbouring
  // peaks may be alike to a few digits, and are one below half of the digits.
  constexpr double alike = 1e-8;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factorisation;
  factorisation.setThreshold(alike);
  factorisation.compute(rows);
  const Eigen::MatrixXd turned = factorisation.colsPermutation() * factorisation.matrixZ().transpose();
  return turned.rightCols(n - factorisation.rank());
}

void check(const CertificateOptions& options) {
  require(options.active_tolerance >= 0.0, "the tolerance of active constraints", options.active_tolerance,
          "at least 0");
  require(options.multiplier_tolerance > 0.0, "the tolerance of multipliers", options.multiplier_tolerance, "positive");
}

struct Bound {
  Eigen::Index variable;
  double sign;  ///< 1 for an upper bound, -1 for a lower one
};

/// All constraints at a design with the multipliers that come nearest to the conditions of optimality.
struct Conditions {
  OutlineAssessment outline;
  std::vector<Peak> peaks;
  std::vector<Bound> bounds;
  std::vector<Candidate> candidates;  ///< of the peaks, then of the bounds
  Eigen::VectorXd multipliers;
  std::vector<std::size_t> positive;  ///< those with positive multipliers
  Eigen::VectorXd gradient;           ///< of the Lagrangian, along [d, t]
  Eigen::MatrixXd hessian;            ///< likewise
  double complementarity = 0.0;

  double residual() const { return std::hypot(gradient.norm(), complementarity); }

  Conditions(const ConstraintFunctions& functions, const Eigen::VectorXd& design, const CertificateOptions& options)
      : outline(assess_outline(functions.task(), design, options.samples)),
        peaks(find_peaks(functions.task(), design, outline.kappa_inverse, options.samples)) {
    const Eigen::Index k = functions.design_size();
    ConstraintFunctions::AtDesign at(functions, design);
    for (const Peak& peak : peaks) candidates.push_back(candidate(functions, at, peak));
    const auto add_bounds = [&](const Eigen::VectorXd& bound, double sign) {
      for (Eigen::Index j = 0; j < bound.size(); ++j) {
        if (!std::isfinite(bound[j])) continue;
        bounds.push_back({j, sign});
        candidates.push_back(
            {sign * Eigen::VectorXd::Unit(k + 1, j), sign * (design[j] - bound[j]), Eigen::MatrixXd::Zero(k, k), 0.0});
      }
    };
    add_bounds(functions.task().designs.lower(), -1.0);
    add_bounds(functions.task().designs.upper(), 1.0);

    multipliers = nearest_multipliers(candidates, k + 1);
    gradient = -Eigen::VectorXd::Unit(k + 1, k);
    hessian = Eigen::MatrixXd::Zero(k + 1, k + 1);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double multiplier = multipliers[static_cast<Eigen::Index>(i)];
      gradient += multiplier * candidates[i].gradient;
      hessian.topLeftCorner(k, k) += multiplier * candidates[i].hessian;
      complementarity = std::hypot(complementarity, multiplier * candidates[i].value);
      if (counts(i, options)) positive.push_back(i);
    }
  }

  bool counts(std::size_t i, const CertificateOptions& options) const {
    const double multiplier = multipliers[static_cast<Eigen::Index>(i)];
    return multiplier > options.multiplier_tolerance && multiplier > std::abs(candidates[i].value);
  }

  /// The gradients of the constraints with positive multipliers, one in a row.
  Eigen::MatrixXd active_gradients() const {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(positive.size()), gradient.size());
    for (std::size_t i = 0; i < positive.size(); ++i) {
      rows.row(static_cast<Eigen::Index>(i)) = candidates[positive[i]].gradient;
    }
    return rows;
  }
};

}  // namespace

OptimalityCertificate certify_optimality(const SynthesisTask& task, const Eigen::VectorXd& design,
                                         const CertificateOptions& options) {
  check(options);
  const ConstraintFunctions functions(task);
  const Conditions conditions(functions, design, options);
  const Eigen::Index k = functions.design_size();
  OptimalityCertificate result{};
  result.kappa_inverse = conditions.outline.kappa_inverse;
  result.violation = conditions.outline.violation;
  result.kkt_residual = conditions.residual();
  result.stationarity = conditions.gradient.norm();
  result.complementarity = conditions.complementarity;

  const std::vector<Limit> limits = list_limits(task.designs.manipulator(design));
  result.limit_sensitivities.assign(limits.size(), 0.0);
  const std::vector<Peak>& peaks = conditions.peaks;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const double multiplier = conditions.multipliers[static_cast<Eigen::Index>(i)];
    result.size_sensitivity -= multiplier * conditions.candidates[i].growth;
    const OutlineConstraint& constraint = peaks[i].constraint;
    if (const auto& limit = functions.families()[constraint.family].limit) {
      const auto index = std::find(limits.begin(), limits.end(), *limit) - limits.begin();
      result.limit_sensitivities[static_cast<std::size_t>(index)] += multiplier;
    }
    if (conditions.counts(i, options) || std::abs(peaks[i].value) <= options.active_tolerance) {
      result.active.push_back({constraint, task.prescribed.point(constraint.direction), peaks[i].value, multiplier});
    }
  }
  result.bound_multipliers = Eigen::VectorXd::Zero(k);
  for (std::size_t i = 0; i < conditions.bounds.size(); ++i) {
    const auto& [variable, sign] = conditions.bounds[i];
    result.bound_multipliers[variable] += sign * conditions.multipliers[static_cast<Eigen::Index>(peaks.size() + i)];
  }

  const Eigen::MatrixXd tangent = kernel(conditions.active_gradients().rowwise().normalized(), k + 1);
  result.tangent_dimension = tangent.cols();
  result.smallest_curvature = std::numeric_limits<double>::infinity();
  if (tangent.cols() > 0) {
    const Eigen::MatrixXd reduced = tangent.transpose() * conditions.hessian * tangent;
    result.smallest_curvature =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(reduced, Eigen::EigenvaluesOnly).eigenvalues()[0];
  }
  return result;
}

RefinedOptimum refine_optimum(const SynthesisTask& task, const Eigen::VectorXd& design,
                              const CertificateOptions& options) {
  check(options);
  constexpr int most_steps = 20;
  const ConstraintFunctions functions(task);
  const Eigen::Index k = functions.design_size();
  Conditions conditions(functions, design, options);
  RefinedOptimum result{design, conditions.residual(), 0};
  while (result.steps < most_steps) {
    // [H A'; A 0] [dx; lambda] = [-grad f; -g]
    const Eigen::MatrixXd rows = conditions.active_gradients();
    const Eigen::Index n = k + 1 + rows.rows();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    matrix.topLeftCorner(k + 1, k + 1) = conditions.hessian;
    matrix.topRightCorner(k + 1, rows.rows()) = rows.transpose();
    matrix.bottomLeftCorner(rows.rows(), k + 1) = rows;
    Eigen::VectorXd right = Eigen::VectorXd::Unit(n, k);
    for (std::size_t i = 0; i < conditions.positive.size(); ++i) {
      right[k + 1 + static_cast<Eigen::Index>(i)] = -conditions.candidates[conditions.positive[i]].value;
    }
    const Eigen::VectorXd step = matrix.completeOrthogonalDecomposition().solve(right).head(k);
    if (!step.allFinite()) break;
    Conditions next(functions, result.design + step, options);
    if (!(next.residual() < result.kkt_residual)) break;
    conditions = std::move(next);
    result = {result.design + step, conditions.residual(), result.steps + 1};
  }
  return result;
}

}  // namespace reprise
