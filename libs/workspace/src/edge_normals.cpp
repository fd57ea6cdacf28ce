#include "edge_normals.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace reprise {
namespace {

/// n with n . a = -(e x a), e the unit vector at the angle: the outward normal of a lower edge.
Eigen::Vector2d lower_edge_normal(double angle) { return {std::sin(angle), -std::cos(angle)}; }
/// n with n . a = e x a: the outward normal of an upper edge.
Eigen::Vector2d upper_edge_normal(double angle) { return {-std::sin(angle), std::cos(angle)}; }

const Interval& given(const std::optional<Interval>& angle, LimitKind kind) {
  if (!angle) {
    throw std::invalid_argument("kind is " + std::string(to_string(kind)) + ", but it must be a limit of the leg");
  }
  return *angle;
}

}  // namespace

EdgeNormals edge_normals(const Leg& leg, LimitKind kind, double orientation) {
  switch (kind) {
    case LimitKind::minimum_length:
    case LimitKind::maximum_length:
      return {};
    case LimitKind::base_angle_lower: {
      const Eigen::Vector2d normal = lower_edge_normal(given(leg.base_angle, kind).lower);
      return {normal, normal};
    }
    case LimitKind::base_angle_upper: {
      const Eigen::Vector2d normal = upper_edge_normal(given(leg.base_angle, kind).upper);
      return {normal, normal};
    }
    case LimitKind::base_angle:
      return {lower_edge_normal(given(leg.base_angle, kind).lower),
              upper_edge_normal(given(leg.base_angle, kind).upper)};
    case LimitKind::platform_angle_lower: {
      const Eigen::Vector2d normal = lower_edge_normal(given(leg.platform_angle, kind).lower + orientation);
      return {normal, normal};
    }
    case LimitKind::platform_angle_upper: {
      const Eigen::Vector2d normal = upper_edge_normal(given(leg.platform_angle, kind).upper + orientation);
      return {normal, normal};
    }
    case LimitKind::platform_angle:
      return {lower_edge_normal(given(leg.platform_angle, kind).lower + orientation),
              upper_edge_normal(given(leg.platform_angle, kind).upper + orientation)};
  }
  return {};
}

}  // namespace reprise
