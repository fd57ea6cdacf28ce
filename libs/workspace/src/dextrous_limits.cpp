#include "reprise/workspace/dextrous_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "edge_normals.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "sinusoid.hpp"

namespace reprise {
namespace {

/// The vector turned by the angle whose cosine and sine are given.
Eigen::Vector2d turned(const Eigen::Vector2d& rotation, const Eigen::Vector2d& a) {
  return {rotation.x() * a.x() - rotation.y() * a.y(), rotation.y() * a.x() + rotation.x() * a.y()};
}

}  // namespace

OrientationRangeLimits::OrientationRangeLimits(const Interval& orientations) : orientations_(orientations) {
  const double width = orientations.upper - orientations.lower;
  if (!(std::isfinite(orientations.lower) && width >= 0.0 && width < 2.0 * pi)) {
    throw std::invalid_argument("the range of orientations is [" + shown(orientations.lower) + ", " +
                                shown(orientations.upper) +
                                "] rad, but its bounds must be finite, in order and less than a full turn apart");
  }
}

DextrousLimits::DextrousLimits(const Manipulator& manipulator, const Interval& orientations)
    : OrientationRangeLimits(orientations),
      manipulator_(manipulator),
      first_(unit(orientations.lower)),
      last_(unit(orientations.upper)),
      limits_(list_limits(manipulator)) {
  for (const Leg& leg : manipulator.legs()) {
    const Eigen::Vector2d& p = leg.platform_joint;
    arms_.push_back({turned(first_, p), turned(last_, p), p.norm()});
  }
  const bool any_angle = std::any_of(limits_.begin(), limits_.end(), [](const Limit& limit) {
    return limit.kind != LimitKind::minimum_length && limit.kind != LimitKind::maximum_length;
  });
  if (any_angle) {
    for (const Limit& limit : limits_) {
      const EdgeNormals normals = edge_normals(manipulator.leg(limit.leg), limit.kind, 0.0);
      edges_.push_back({normals.lower, normals.upper});
    }
  }
  // Both ends of the range must be attained.
  box_ = ConstantOrientationLimits(manipulator, orientations.lower)
             .box()
             .intersection(ConstantOrientationLimits(manipulator, orientations.upper).box());
}

bool DextrousLimits::sweeps(const Eigen::Vector2d& direction) const {
  const double width = orientations().upper - orientations().lower;
  if (width <= pi) {
    if (cross(first_, direction) < 0.0 || cross(direction, last_) < 0.0) return false;
    // The opposite side, which a narrow range does not tell from its own. Of half a turn the sum would be rounding.
    return width > 0.5 * pi || (first_ + last_).dot(direction) >= 0.0;
  }
  return !(cross(last_, direction) > 0.0 && cross(direction, first_) > 0.0);
}

DextrousLimits::LengthRange DextrousLimits::length_range(const Eigen::Vector2d& u, std::size_t leg) const {
  const Eigen::Vector2d w = u - manipulator_.leg(leg).base_joint;
  const Arm& arm = arms_[leg];
  const Extreme first{(w + arm.first).norm(), first_};
  const Extreme last{(w + arm.last).norm(), last_};
  // R(phi) p along w, or against it.
  const Eigen::Vector2d aligned = square_length(manipulator_.leg(leg), w).amplitude;
  if (aligned.isZero(0.0)) return {first, first};
  LengthRange range{last.value < first.value ? last : first, last.value > first.value ? last : first};
  if (sweeps(aligned)) {
    const double length = w.norm() + arm.length;
    if (length > range.longest.value) range.longest = {length, aligned.normalized()};
  }
  if (sweeps(-aligned)) {
    const double length = std::abs(w.norm() - arm.length);
    if (length < range.shortest.value) range.shortest = {length, -aligned.normalized()};
  }
  return range;
}

DextrousLimits::Extreme DextrousLimits::angle_extreme(const Eigen::Vector2d& u, Eigen::Index j) const {
  const LimitKind kind = limit(j).kind;
  const Leg& leg = manipulator_.leg(limit(j).leg);
  const Eigen::Vector2d w = u - leg.base_joint;
  Extreme result{-std::numeric_limits<double>::infinity(), first_};
  const Edges& edges = edges_[static_cast<std::size_t>(j)];
  const Sinusoid lower = edge_distance(leg, kind, edges.lower, w);
  const Sinusoid upper = edge_distance(leg, kind, edges.upper, w);
  const auto include_smaller = [&](const Eigen::Vector2d& rotation) {
    const double value = std::min(lower.at(rotation), upper.at(rotation));
    if (value > result.value) result = {value, rotation};
  };
  for (const Eigen::Vector2d& end : {first_, last_}) include_smaller(end);
  for (const Sinusoid& one : {lower, upper}) {
    if (!one.amplitude.isZero(0.0) && sweeps(one.amplitude)) include_smaller(one.amplitude.normalized());
  }
  // Where both are equal: difference.amplitude . rotation = -difference.constant.
  const Sinusoid difference{lower.constant - upper.constant, lower.amplitude - upper.amplitude};
  const double size = difference.amplitude.norm();
  if (size > std::abs(difference.constant)) {
    const Eigen::Vector2d along = difference.amplitude / size;
    const double cosine = -difference.constant / size;
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    for (const double side : {sine, -sine}) {
      const Eigen::Vector2d rotation = cosine * along + side * quarter_turned(along);
      if (sweeps(rotation)) include_smaller(rotation);
    }
  }
  return result;
}

double DextrousLimits::critical_orientation(const Eigen::Vector2d& u, Eigen::Index j) const {
  const auto critical = [&] {
    if (limit(j).kind == LimitKind::minimum_length) return length_range(u, limit(j).leg).shortest;
    if (limit(j).kind == LimitKind::maximum_length) return length_range(u, limit(j).leg).longest;
    return angle_extreme(u, j);
  };
  const Eigen::Vector2d rotation = critical().rotation;
  const double from_lower = std::atan2(cross(first_, rotation), first_.dot(rotation));
  // Rounding may put a rotation at the lower end just before it.
  constexpr double rounding = 1e-12;
  const double ahead = from_lower < -rounding ? from_lower + 2.0 * pi : std::max(from_lower, 0.0);
  return std::min(orientations().lower + ahead, orientations().upper);
}

// Both ends of the range are alike for a position on the axis that halves it, w = t e. On the side of the axis where an
// orientation between them is worse than both, the curve is smooth; on the other it has a corner.
std::optional<Eigen::Vector2d> DextrousLimits::corner(Eigen::Index j, const Eigen::Vector2d& near) const {
  const Leg& leg = manipulator_.leg(limit(j).leg);
  const LimitKind kind = limit(j).kind;
  const double half_width = 0.5 * (orientations().upper - orientations().lower);
  if (half_width == 0.0) return std::nullopt;
  const Eigen::Vector2d middle = unit(orientations().lower + half_width);
  const Eigen::Vector2d& p = leg.platform_joint;
  if (kind == LimitKind::platform_angle_lower || kind == LimitKind::platform_angle_upper) {
    // n(phi) . w + n . p = 0, worst where n(phi) points along w.
    const Eigen::Vector2d normal = edge_normals(leg, kind, 0.0).lower;
    const double t = -normal.dot(p) / std::cos(half_width);
    if (!std::isfinite(t) || t >= 0.0) return std::nullopt;
    return leg.base_joint + t * turned(middle, normal);
  }
  if (kind != LimitKind::minimum_length && kind != LimitKind::maximum_length) return std::nullopt;
  // |w + R(phi) p| = l, farthest where R(phi) p points along w, nearest where it points against it.
  const double arm = p.norm();
  const bool longest = kind == LimitKind::maximum_length;
  const double length = longest ? leg.length.upper : leg.length.lower;
  const double across = arm * std::sin(half_width);
  if (arm == 0.0 || length < across) return std::nullopt;
  const double half_chord = std::sqrt((length - across) * (length + across));
  std::optional<Eigen::Vector2d> nearest;
  for (const double side : {-half_chord, half_chord}) {
    const double t = side - arm * std::cos(half_width);
    if (longest ? t >= 0.0 : t <= 0.0) continue;
    const Eigen::Vector2d at = leg.base_joint + t / arm * turned(middle, p);
    if (!nearest || (at - near).squaredNorm() < (*nearest - near).squaredNorm()) nearest = at;
  }
  return nearest;
}

void DextrousLimits::evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const {
  // The limits are listed leg by leg, so that both on a leg's length share its range.
  std::size_t known = manipulator_.size();
  LengthRange range{};
  for (Eigen::Index j = 0; j < count(); ++j) {
    const auto& [leg, kind] = limit(j);
    const bool shortest = kind == LimitKind::minimum_length;
    if (!shortest && kind != LimitKind::maximum_length) {
      h[j] = angle_extreme(u, j).value;
      continue;
    }
    if (leg != known) range = length_range(u, leg);
    known = leg;
    const Interval& allowed = manipulator_.leg(leg).length;
    h[j] = shortest ? allowed.lower - range.shortest.value : range.longest.value - allowed.upper;
  }
}

// The gradient of a maximum is that of what is largest. Where both edges of a wide wedge are equal there, phi follows u
// so that they stay equal: the mean of their gradients, weighted so that the slopes along phi cancel.
Eigen::Vector2d DextrousLimits::gradient(const Eigen::Vector2d& u, Eigen::Index j) const {
  const Leg& leg = manipulator_.leg(limit(j).leg);
  const LimitKind kind = limit(j).kind;
  const double phi = critical_orientation(u, j);
  if (kind == LimitKind::base_angle || kind == LimitKind::platform_angle) {
    const Edges& edges = edges_[static_cast<std::size_t>(j)];
    const Eigen::Vector2d w = u - leg.base_joint;
    const Sinusoid lower = edge_distance(leg, kind, edges.lower, w);
    const Sinusoid upper = edge_distance(leg, kind, edges.upper, w);
    const Eigen::Vector2d rotation = unit(phi);
    const double lower_slope = lower.amplitude.dot(quarter_turned(rotation));
    const double upper_slope = upper.amplitude.dot(quarter_turned(rotation));
    const bool equal = std::abs(lower.at(rotation) - upper.at(rotation)) <= 1e-12 * (1.0 + w.norm());
    if (equal && lower_slope * upper_slope < 0.0) {
      const EdgeNormals here = edge_normals(leg, kind, phi);
      return (upper_slope * here.lower - lower_slope * here.upper) / (upper_slope - lower_slope);
    }
  }
  return limit_derivatives(leg, kind, leg_vector(leg, {u, phi}), phi).gradient;
}

}  // namespace reprise
