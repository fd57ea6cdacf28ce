#include "pose_function.hpp"

#include <cmath>

namespace reprise::rigorous {
namespace {

struct Vector {
  Enclosure x;
  Enclosure y;
};

Vector unit(const Enclosure& angle) { return {cos(angle), sin(angle)}; }

Enclosure dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
Enclosure cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

/// The platform joint seen from P, and the vector of the leg.
struct LegVectors {
  Vector arm;
  Vector leg;
};

LegVectors leg_vectors(const Leg& leg, const Poses& poses, const Vector& turn) {
  const Eigen::Vector2d& p = leg.platform_joint;
  const Vector arm{p.x() * turn.x - p.y() * turn.y, p.x() * turn.y + p.y() * turn.x};
  return {arm, {poses.x - leg.base_joint.x() + arm.x, poses.y - leg.base_joint.y() + arm.y}};
}

Enclosure length(const Vector& a) { return sqrt(square(a.x) + square(a.y)); }

/// x / sqrt(x^2 + y^2) for pairs that leave out zero. It grows with x, and with |y| it comes nearer to zero, so its
/// bounds are at corners.
Enclosure direction_cosine(const Enclosure& x, const Enclosure& y) {
  const Enclosure size = abs(y);
  const auto at = [](double numerator, double other) {
    return Enclosure(numerator) / sqrt(square(Enclosure(numerator)) + square(Enclosure(other)));
  };
  const double lower = at(x.lower(), x.lower() > 0.0 ? size.upper() : size.lower()).lower();
  const double upper = at(x.upper(), x.upper() < 0.0 ? size.upper() : size.lower()).upper();
  return {std::max(-1.0, lower), std::min(1.0, upper)};
}

/// a / |a|; where a may be zero, the unit disc's box, which holds the generalised gradients of |a|.
Vector direction(const Vector& a) {
  if (zero_in(a.x) && zero_in(a.y)) return {Enclosure(-1.0, 1.0), Enclosure(-1.0, 1.0)};
  return {direction_cosine(a.x, a.y), direction_cosine(a.y, a.x)};
}

Enclosure nothing_known() { return {0.0, 1.0}; }

/// What a formula gives for kappa^-1 and for a derivative, also where it overflows into what is not a number.
Enclosure as_kappa_inverse(const Enclosure& x) { return empty(x) ? nothing_known() : intersect(x, nothing_known()); }
Enclosure as_derivative(const Enclosure& x) { return empty(x) ? everything() : x; }

/// The margin behind one edge of a wedge whose direction is `edge`: edge x a for its lower edge, the opposite for its
/// upper one. A joint at the platform turns its wedge with it.
FirstOrderBounds edge_margin(const Vector& edge, bool upper, bool at_platform, const Vector& arm, const Vector& a) {
  const Enclosure sign = upper ? -1.0 : 1.0;
  const Vector lever = at_platform ? Vector{arm.x - a.x, arm.y - a.y} : arm;
  return {sign * cross(edge, a), -sign * edge.y, sign * edge.x, sign * dot(edge, lever)};
}

/// The larger of two functions. Where it may be either, its derivatives are those of both.
FirstOrderBounds larger(const FirstOrderBounds& a, const FirstOrderBounds& b) {
  if (a.value.lower() > b.value.upper()) return a;
  if (b.value.lower() > a.value.upper()) return b;
  return {max(a.value, b.value), hull(a.x, b.x), hull(a.y, b.y), hull(a.orientation, b.orientation)};
}

}  // namespace

KappaInverse::KappaInverse(const Manipulator& manipulator, const Conditioning& conditioning)
    : legs_(manipulator.legs()) {
  kappa_inverse(manipulator, Pose{Eigen::Vector2d::Zero(), 0.0}, conditioning);  // for its checks
  if (conditioning.characteristic_length) {
    turn_factor_ = *conditioning.characteristic_length;
  } else {
    Enclosure sum(0.0);
    bool zero = true;
    for (const Leg& leg : legs_) {
      sum += square(Enclosure(leg.platform_joint.x())) + square(Enclosure(leg.platform_joint.y()));
      zero = zero && leg.platform_joint.isZero(0.0);
    }
    turn_factor_ = zero ? Enclosure(0.0) : sqrt(sum / static_cast<double>(legs_.size()));
    if (zero) return;
  }
  if (conditioning.normalisation == Normalisation::homogeneous) turn_factor_ = 1.0 / turn_factor_;
}

Enclosure KappaInverse::value(const Poses& poses) const {
  const Vector turn = unit(poses.orientation);
  JacobianRows<Enclosure> rows(legs_.size());
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const auto [arm, leg] = leg_vectors(legs_[i], poses, turn);
    if (zero_in(leg.x) && zero_in(leg.y)) return nothing_known();
    const Vector e = direction(leg);
    rows[i] = {e.x, e.y, cross(arm, e) * turn_factor_};
  }
  Enclosure result;
  if (!kappa_inverse_of_rows(legs_.size(), rows, result)) return nothing_known();
  return as_kappa_inverse(result);
}

FirstOrderBounds KappaInverse::first_order(const Poses& poses) const {
  FirstOrderBounds unknown{nothing_known(), everything(), everything(), everything()};
  const Vector turn = unit(poses.orientation);
  JacobianRows<Differentiated> rows(legs_.size());
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const auto [arm, leg] = leg_vectors(legs_[i], poses, turn);
    if (zero_in(leg.x) && zero_in(leg.y)) return unknown;
    const Vector e = direction(leg);
    // The leg turns by w along each coordinate, w = (e x da) / |a|; with it de = w e' and d(b x e) =
    // (b . e) (w - dphi).
    const Enclosure along = dot(arm, e);
    const Enclosure inverse = 1.0 / length(leg);
    const std::array<Enclosure, 3> w{-e.y * inverse, e.x * inverse, along * inverse};
    const Enclosure lever = along * turn_factor_;
    JacobianRow<Differentiated>& row = rows[i];
    row.x.value() = e.x;
    row.y.value() = e.y;
    row.turn.value() = cross(arm, e) * turn_factor_;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Enclosure& turned = w[static_cast<std::size_t>(k)];
      row.x.derivatives()[k] = -e.y * turned;
      row.y.derivatives()[k] = e.x * turned;
      row.turn.derivatives()[k] = lever * (k < 2 ? turned : turned - 1.0);
    }
  }
  Differentiated result;
  if (!kappa_inverse_of_rows(legs_.size(), rows, result)) return unknown;
  const auto& derivatives = result.derivatives();
  return {as_kappa_inverse(result.value()), as_derivative(derivatives[0]), as_derivative(derivatives[1]),
          as_derivative(derivatives[2])};
}

FirstOrderBounds Margin::first_order(const Poses& poses) const {
  const auto [arm, a] = leg_vectors(leg_, poses, unit(poses.orientation));
  const auto edge = [&, &arm = arm, &a = a](double angle, bool upper, bool at_platform) {
    const Enclosure direction = at_platform ? angle + poses.orientation : Enclosure(angle);
    return edge_margin(unit(direction), upper, at_platform, arm, a);
  };
  switch (kind_) {
    case LimitKind::minimum_length:
    case LimitKind::maximum_length: {
      const Vector e = direction(a);
      if (kind_ == LimitKind::minimum_length) return {length(a) - leg_.length.lower, e.x, e.y, cross(arm, e)};
      return {leg_.length.upper - length(a), -e.x, -e.y, cross(e, arm)};
    }
    case LimitKind::base_angle_lower:
      return edge(leg_.base_angle->lower, false, false);
    case LimitKind::base_angle_upper:
      return edge(leg_.base_angle->upper, true, false);
    case LimitKind::base_angle:
      return larger(edge(leg_.base_angle->lower, false, false), edge(leg_.base_angle->upper, true, false));
    case LimitKind::platform_angle_lower:
      return edge(leg_.platform_angle->lower, false, true);
    case LimitKind::platform_angle_upper:
      return edge(leg_.platform_angle->upper, true, true);
    case LimitKind::platform_angle:
      return larger(edge(leg_.platform_angle->lower, false, true), edge(leg_.platform_angle->upper, true, true));
  }
  return {everything(), everything(), everything(), everything()};
}

}  // namespace reprise::rigorous
