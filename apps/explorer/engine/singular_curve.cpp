#include "singular_curve.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace reprise::explorer {

namespace {

using Curve = std::vector<Eigen::Vector2d>;

/// Points along each piece of a curve.
constexpr int steps = 96;

/// Discriminants of this part of the terms they are made of count as zero.
constexpr double rounding = 1e-12;

/// The polynomial along its principal axes: with w = Q [s, v], constant + a s + b v + lambda s^2 + mu v^2, |mu| the
/// larger. For mu = 0 it is a line.
struct PrincipalForm {
  explicit PrincipalForm(const SingularityPolynomial& polynomial) : constant(polynomial.constant) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(polynomial.quadratic);
    axes = solver.eigenvectors();
    Eigen::Vector2d values = solver.eigenvalues();
    if (std::abs(values[0]) > std::abs(values[1])) {
      axes.col(0).swap(axes.col(1));
      std::swap(values[0], values[1]);
    }
    lambda = values[0];
    mu = values[1];
    const Eigen::Vector2d linear = axes.transpose() * polynomial.linear;
    a = linear[0];
    b = linear[1];
  }

  /// Of the equation for v at s, and the size of its terms.
  double discriminant(double s) const { return b * b - 4.0 * mu * (constant + s * (a + s * lambda)); }
  double size(double s) const {
    return b * b + 4.0 * std::abs(mu) * (std::abs(constant) + std::abs(a * s) + std::abs(lambda) * s * s);
  }

  /// The values of s in (-reach, reach) at which the discriminant is zero.
  std::vector<double> turning_points(double reach) const {
    const double p = -4.0 * mu * lambda;
    const double q = -4.0 * mu * a;
    const double r = b * b - 4.0 * mu * constant;
    std::vector<double> roots;
    if (const double under = q * q - 4.0 * p * r; std::abs(p) * reach * reach > rounding * size(reach)) {
      if (under > 0.0) {
        const double t = -0.5 * (q + std::copysign(std::sqrt(under), q));
        roots = {t / p, r / t};
      }
      // Where two lines cross both roots are here, and rounding may leave none.
      roots.push_back(-0.5 * q / p);
    } else if (q != 0.0) {
      roots = {-r / q};
    }
    std::erase_if(roots, [&](double s) { return !(std::abs(s) < reach); });
    std::sort(roots.begin(), roots.end());
    return roots;
  }

  Eigen::Matrix2d axes;
  double constant, a, b, lambda, mu;
};

}  // namespace

std::vector<Curve> singular_curve(const SingularityPolynomial& polynomial, const Eigen::AlignedBox2d& box) {
  if (polynomial.vanishes()) return {};
  const PrincipalForm form(polynomial);
  double reach = 0.0;
  for (const auto corner : {box.BottomLeft, box.BottomRight, box.TopLeft, box.TopRight}) {
    reach = std::max(reach, (box.corner(corner) - polynomial.centre).norm() / polynomial.unit);
  }
  const auto place = [&](double s, double v) -> Eigen::Vector2d {
    return polynomial.centre + polynomial.unit * (form.axes * Eigen::Vector2d(s, v));
  };
  if (form.mu == 0.0) {
    const Eigen::Vector2d normal(form.a, form.b);
    if (normal.isZero()) return {};
    const Eigen::Vector2d foot = -form.constant / normal.squaredNorm() * normal;
    const Eigen::Vector2d along = 2.0 * reach * Eigen::Vector2d(-normal.y(), normal.x()).normalized();
    return {{place(foot.x() - along.x(), foot.y() - along.y()), place(foot.x() + along.x(), foot.y() + along.y())}};
  }
  std::vector<double> ends = form.turning_points(reach);
  ends.insert(ends.begin(), -reach);
  ends.push_back(reach);
  std::vector<Curve> curves;
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const double middle = 0.5 * (ends[piece] + ends[piece + 1]);
    const double half = 0.5 * (ends[piece + 1] - ends[piece]);
    const double there = form.discriminant(middle);
    const bool is_double = std::abs(there) <= rounding * form.size(middle);
    if (!(there > 0.0) && !is_double) continue;
    for (const double sign : {1.0, -1.0}) {
      if (is_double && sign < 0.0) continue;
      Curve curve;
      for (int k = 0; k <= steps; ++k) {
        // Close together at the ends, where two sheets may meet.
        const double s = middle - half * std::cos(std::numbers::pi * k / steps);
        const double root = is_double ? 0.0 : std::sqrt(std::max(0.0, form.discriminant(s)));
        curve.push_back(place(s, (-form.b + sign * root) / (2.0 * form.mu)));
      }
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace reprise::explorer
