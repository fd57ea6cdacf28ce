#include "reprise/workspace/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "edge_normals.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

void append_angle_limits(std::size_t leg, const std::optional<Interval>& angle, LimitKind lower, LimitKind upper,
                         LimitKind both, std::vector<Limit>& limits) {
  if (!angle) return;
  if (angle->upper - angle->lower < pi) {
    limits.push_back({leg, lower});
    limits.push_back({leg, upper});
  } else {
    limits.push_back({leg, both});
  }
}

/// `length` is |a|.
double value_of(LimitKind kind, double minimum, double maximum, const EdgeNormals& normals, const Eigen::Vector2d& a,
                double length) {
  if (kind == LimitKind::minimum_length) return minimum - length;
  if (kind == LimitKind::maximum_length) return length - maximum;
  return std::min(normals.lower.dot(a), normals.upper.dot(a));
}

Eigen::Vector2d gradient_of(LimitKind kind, const EdgeNormals& normals, const Eigen::Vector2d& a) {
  if (kind == LimitKind::minimum_length || kind == LimitKind::maximum_length) {
    const double length = a.norm();
    if (length == 0.0) return Eigen::Vector2d::Zero();
    return (kind == LimitKind::minimum_length ? -1.0 : 1.0) / length * a;
  }
  return normals.lower.dot(a) <= normals.upper.dot(a) ? normals.lower : normals.upper;
}

}  // namespace

std::string_view to_string(LimitKind kind) {
  switch (kind) {
    case LimitKind::minimum_length:
      return "minimum length";
    case LimitKind::maximum_length:
      return "maximum length";
    case LimitKind::base_angle_lower:
      return "lower base angle";
    case LimitKind::base_angle_upper:
      return "upper base angle";
    case LimitKind::base_angle:
      return "base angle";
    case LimitKind::platform_angle_lower:
      return "lower platform angle";
    case LimitKind::platform_angle_upper:
      return "upper platform angle";
    case LimitKind::platform_angle:
      return "platform angle";
  }
  return "unknown limit";
}

std::string to_string(const Limit& limit) {
  return "leg " + std::to_string(limit.leg + 1) + ", " + std::string(to_string(limit.kind));
}

std::vector<Limit> list_limits(const Manipulator& manipulator) {
  std::vector<Limit> limits;
  limits.reserve(2 * manipulator.size());
  for (std::size_t i = 0; i < manipulator.size(); ++i) {
    const Leg& leg = manipulator.leg(i);
    if (leg.length.lower > 0.0) limits.push_back({i, LimitKind::minimum_length});
    limits.push_back({i, LimitKind::maximum_length});
    append_angle_limits(i, leg.base_angle, LimitKind::base_angle_lower, LimitKind::base_angle_upper,
                        LimitKind::base_angle, limits);
    append_angle_limits(i, leg.platform_angle, LimitKind::platform_angle_lower, LimitKind::platform_angle_upper,
                        LimitKind::platform_angle, limits);
  }
  return limits;
}

double limit_value(const Leg& leg, LimitKind kind, const Eigen::Vector2d& a, double orientation) {
  return value_of(kind, leg.length.lower, leg.length.upper, edge_normals(leg, kind, orientation), a, a.norm());
}

LimitDerivatives limit_derivatives(const Leg& leg, LimitKind kind, const Eigen::Vector2d& a, double orientation) {
  const EdgeNormals normals = edge_normals(leg, kind, orientation);
  LimitDerivatives result;
  const double length = a.norm();
  result.value = value_of(kind, leg.length.lower, leg.length.upper, normals, a, length);
  result.gradient = gradient_of(kind, normals, a);
  result.hessian.setZero();
  if ((kind == LimitKind::minimum_length || kind == LimitKind::maximum_length) && length > 0.0) {
    // d2|a|/da2 = t t^T / |a|, with t the unit vector across the leg.
    const Eigen::Vector2d across(-result.gradient.y(), result.gradient.x());
    const double sign = kind == LimitKind::minimum_length ? -1.0 : 1.0;
    result.hessian = across * across.transpose();
    result.hessian *= sign / length;
  }
  return result;
}

double orientation_slope(const Leg& leg, LimitKind kind, const Pose& pose) {
  const Eigen::Vector2d a = leg_vector(leg, pose);
  const Eigen::Vector2d gradient = gradient_of(kind, edge_normals(leg, kind, pose.orientation), a);
  const Eigen::Vector2d arm = a - pose.position + leg.base_joint;  // R(phi) p
  const double slope = gradient.dot(quarter_turned(arm));
  return is_at_platform(kind) ? slope - gradient.dot(quarter_turned(a)) : slope;
}

ConstantOrientationLimits::ConstantOrientationLimits(const Manipulator& manipulator, double orientation)
    : orientation_(orientation), limits_(list_limits(manipulator)) {
  require(std::isfinite(orientation), "orientation", orientation, "finite");
  box_ = Eigen::AlignedBox2d(Eigen::Vector2d::Constant(-infinity), Eigen::Vector2d::Constant(infinity));
  fixed_legs_.reserve(manipulator.size());
  fixed_limits_.reserve(limits_.size());
  for (const Leg& leg : manipulator.legs()) {
    const Eigen::Vector2d centre = -leg_vector(leg, {Eigen::Vector2d::Zero(), orientation});
    fixed_legs_.push_back({centre, leg.length.lower, leg.length.upper});
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(leg.length.upper);
    box_ = box_.intersection(Eigen::AlignedBox2d(centre - reach, centre + reach));
  }
  for (const Limit& limit : limits_) {
    const EdgeNormals normals = edge_normals(manipulator.leg(limit.leg), limit.kind, orientation);
    fixed_limits_.push_back({limit.leg, limit.kind, normals.lower, normals.upper});
  }
}

void ConstantOrientationLimits::evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const {
  // The limits are listed leg by leg, so that those of one leg share its vector and its length.
  const FixedLeg* leg = nullptr;
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  double length = 0.0;
  for (std::size_t j = 0; j < fixed_limits_.size(); ++j) {
    const FixedLimit& limit = fixed_limits_[j];
    if (leg != &fixed_legs_[limit.leg]) {
      leg = &fixed_legs_[limit.leg];
      a = u - leg->centre;
      length = a.norm();
    }
    h[static_cast<Eigen::Index>(j)] = value_of(limit.kind, leg->minimum_length, leg->maximum_length,
                                               {limit.lower_normal, limit.upper_normal}, a, length);
  }
}

Eigen::Vector2d ConstantOrientationLimits::gradient(const Eigen::Vector2d& u, Eigen::Index j) const {
  const FixedLimit& limit = fixed_limits_.at(static_cast<std::size_t>(j));
  return gradient_of(limit.kind, {limit.lower_normal, limit.upper_normal}, u - fixed_legs_[limit.leg].centre);
}

std::optional<Eigen::Vector2d> ConstantOrientationLimits::corner(Eigen::Index j, const Eigen::Vector2d&) const {
  const FixedLimit& limit = fixed_limits_.at(static_cast<std::size_t>(j));
  if (limit.kind != LimitKind::base_angle && limit.kind != LimitKind::platform_angle) return std::nullopt;
  return fixed_legs_[limit.leg].centre;
}

}  // namespace reprise
