#include "reprise/workspace/dextrous_derivatives.hpp"

#include <cmath>

#include "edge_normals.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

Eigen::Vector4d stacked(const Eigen::Vector2d& of_w, const Eigen::Vector2d& of_p) {
  Eigen::Vector4d result;
  result << of_w, of_p;
  return result;
}

/// Hessian of a function of w plus a function of p.
Eigen::Matrix4d block_diagonal(const Eigen::Matrix2d& of_w, const Eigen::Matrix2d& of_p) {
  Eigen::Matrix4d result = Eigen::Matrix4d::Zero();
  result.topLeftCorner<2, 2>() = of_w;
  result.bottomRightCorner<2, 2>() = of_p;
  return result;
}

/// With the orientation held fixed: the chain rule with a = w + R p.
DextrousLimitDerivatives at_fixed_orientation(const Leg& leg, LimitKind kind, const Eigen::Vector2d& w,
                                              double orientation) {
  const Eigen::Rotation2Dd rotation(orientation);
  const LimitDerivatives h = limit_derivatives(leg, kind, w + rotation * leg.platform_joint, orientation);
  Eigen::Matrix<double, 2, 4> change;
  change << Eigen::Matrix2d::Identity(), rotation.toRotationMatrix();
  return {change.transpose() * h.gradient, change.transpose() * h.hessian * change};
}

/// A length within the range is |w| + |p| at the farthest, ||w| - |p|| at the nearest.
DextrousLimitDerivatives at_stationary_length(const Leg& leg, LimitKind kind, const Eigen::Vector2d& w) {
  const Eigen::Vector2d& p = leg.platform_joint;
  // |w| and |p| as if they were lengths of the leg.
  const LimitDerivatives size_w = limit_derivatives(leg, LimitKind::maximum_length, w, 0.0);
  const LimitDerivatives size_p = limit_derivatives(leg, LimitKind::maximum_length, p, 0.0);
  double sign_w = 1.0;
  double sign_p = 1.0;
  if (kind == LimitKind::minimum_length) (w.squaredNorm() >= p.squaredNorm() ? sign_w : sign_p) = -1.0;
  return {stacked(sign_w * size_w.gradient, sign_p * size_p.gradient),
          block_diagonal(sign_w * size_w.hessian, sign_p * size_p.hessian)};
}

/// One edge of a wedge, f = n . a, with its derivatives along z = [w, p], in which it is linear, and along phi.
struct Edge {
  double value;
  double slope;              ///< df/dphi
  double curvature;          ///< d2f/dphi2
  Eigen::Vector4d gradient;  ///< df/dz
  Eigen::Vector4d turn;      ///< d2f/dz dphi

  /// The normal n is that at the orientation.
  Edge(const Leg& leg, LimitKind kind, const Eigen::Vector2d& w, const Eigen::Vector2d& n,
       const Eigen::Rotation2Dd& rotation) {
    const Eigen::Vector2d arm = rotation * leg.platform_joint;
    const Eigen::Vector2d n_in_platform = rotation.inverse() * n;
    value = n.dot(w + arm);
    gradient = stacked(n, n_in_platform);
    if (is_at_platform(kind)) {  // n turns: it is n . w that changes
      slope = quarter_turned(n).dot(w);
      curvature = -n.dot(w);
      turn = stacked(quarter_turned(n), Eigen::Vector2d::Zero());
    } else {  // R p turns
      slope = n.dot(quarter_turned(arm));
      curvature = -n.dot(arm);
      turn = stacked(Eigen::Vector2d::Zero(), -quarter_turned(n_in_platform));
    }
  }

  /// d2f/dz2 when phi changes with z as phi_z says, without the second derivatives of phi.
  Eigen::Matrix4d hessian(const Eigen::Vector4d& phi_z) const {
    return turn * phi_z.transpose() + phi_z * turn.transpose() + curvature * phi_z * phi_z.transpose();
  }
};

/// Within the range the smaller edge is either stationary along phi, and phi(z) keeps it so, or both edges f, g are
/// equal there, and phi(z) keeps them so: phi_z = -(f_z - g_z) / (f_phi - g_phi). Their common value has the
/// derivatives of a mean of f and g, weighted so that the slopes along phi cancel; the second derivatives of phi cancel
/// with them.
DextrousLimitDerivatives at_critical_edge(const Leg& leg, LimitKind kind, const Eigen::Vector2d& w,
                                          double orientation) {
  const Eigen::Rotation2Dd rotation(orientation);
  const EdgeNormals normals = edge_normals(leg, kind, orientation);
  const Edge lower(leg, kind, w, normals.lower, rotation);
  const Edge upper(leg, kind, w, normals.upper, rotation);
  const bool equal = std::abs(lower.value - upper.value) <= 1e-12 * (1.0 + w.norm());
  if (equal && lower.slope * upper.slope < 0.0) {
    const double difference = lower.slope - upper.slope;
    const double of_lower = -upper.slope / difference;
    const double of_upper = lower.slope / difference;
    const Eigen::Vector4d phi_z = (upper.gradient - lower.gradient) / difference;
    return {of_lower * lower.gradient + of_upper * upper.gradient,
            of_lower * lower.hessian(phi_z) + of_upper * upper.hessian(phi_z)};
  }
  const Edge& smaller = lower.value <= upper.value ? lower : upper;
  if (smaller.curvature == 0.0) return {smaller.gradient, Eigen::Matrix4d::Zero()};
  return {smaller.gradient, smaller.hessian(-smaller.turn / smaller.curvature)};
}

}  // namespace

DextrousLimitDerivatives dextrous_limit_derivatives(const Leg& leg, LimitKind kind, const Eigen::Vector2d& w,
                                                    const Interval& orientations, double critical_orientation) {
  // A critical orientation is computed from its cosine and sine, and may miss an end by rounding.
  constexpr double rounding = 1e-12;
  const bool within =
      critical_orientation > orientations.lower + rounding && critical_orientation < orientations.upper - rounding;
  if (!within) return at_fixed_orientation(leg, kind, w, critical_orientation);
  const bool length = kind == LimitKind::minimum_length || kind == LimitKind::maximum_length;
  return length ? at_stationary_length(leg, kind, w) : at_critical_edge(leg, kind, w, critical_orientation);
}

}  // namespace reprise
