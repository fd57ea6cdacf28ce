#include "reprise/kinematics/manipulator.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "checks.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"

namespace reprise {
namespace {

[[noreturn]] void reject_of_leg(std::size_t leg, const char* quantity, const std::string& value, const char* allowed) {
  reject("leg " + std::to_string(leg + 1) + ": " + quantity, value, allowed);
}

void check_angles(std::size_t leg, const char* quantity, const std::optional<Interval>& angle) {
  if (!angle) return;
  const double width = angle->upper - angle->lower;
  if (width > 0.0 && width < 2.0 * pi) return;
  reject_of_leg(leg, quantity, "[" + shown(angle->lower) + ", " + shown(angle->upper) + "] rad",
                "an interval with finite bounds and a width between 0 and 2 pi");
}

}  // namespace

Manipulator::Manipulator(std::string name, std::vector<Leg> legs) : name_(std::move(name)), legs_(std::move(legs)) {
  if (legs_.empty()) throw std::invalid_argument("a manipulator has 0 legs, but at least 1 is needed");
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Leg& leg = legs_[i];
    const auto allowed = [](const Eigen::Vector2d& joint) { return (joint.array().abs() <= greatest_length).all(); };
    if (!allowed(leg.base_joint)) {
      reject_of_leg(i, "base joint", shown(leg.base_joint), "finite, with coordinates of at most 1e120");
    }
    if (!allowed(leg.platform_joint)) {
      reject_of_leg(i, "platform joint", shown(leg.platform_joint), "finite, with coordinates of at most 1e120");
    }
    if (!(leg.length.lower >= 0.0 && std::isfinite(leg.length.lower))) {
      reject_of_leg(i, "minimum length", shown(leg.length.lower), "finite and not negative");
    }
    if (!(leg.length.upper >= leg.length.lower && leg.length.upper <= greatest_length)) {
      reject_of_leg(i, "maximum length", shown(leg.length.upper), "at most 1e120 and not below the minimum length");
    }
    check_angles(i, "base angle", leg.base_angle);
    check_angles(i, "platform angle", leg.platform_angle);
  }
}

Manipulator make_manipulator(const CollinearDesign& design, const std::array<Interval, 3>& lengths, std::string name) {
  return {std::move(name),
          {Leg{{design.x_c, design.y_c}, {-design.r, 0.0}, lengths[0], {}, {}},
           Leg{{design.x_d, design.y_c}, {-design.r, 0.0}, lengths[1], {}, {}},
           Leg{{design.x_e, design.y_c}, {design.r, 0.0}, lengths[2], {}, {}}}};
}

std::optional<CollinearDesign> collinear_design(const Manipulator& manipulator) {
  if (manipulator.size() != 3) return std::nullopt;
  const auto& legs = manipulator.legs();
  const CollinearDesign design{legs[0].base_joint.x(), legs[0].base_joint.y(), legs[1].base_joint.x(),
                               legs[2].base_joint.x(), legs[2].platform_joint.x()};
  const Eigen::Vector2d a(-design.r, 0.0);
  const Eigen::Vector2d b(design.r, 0.0);
  const bool in_family = legs[1].base_joint.y() == design.y_c && legs[2].base_joint.y() == design.y_c &&
                         legs[0].platform_joint == a && legs[1].platform_joint == a && legs[2].platform_joint == b;
  return in_family ? std::optional(design) : std::nullopt;
}

Eigen::Matrix<double, 5, 1> to_vector(const CollinearDesign& design) {
  return {design.x_c, design.y_c, design.x_d, design.x_e, design.r};
}

CollinearDesign to_collinear_design(const Eigen::Matrix<double, 5, 1>& d) { return {d[0], d[1], d[2], d[3], d[4]}; }

Eigen::Matrix<double, 12, 5> collinear_design_map() {
  Eigen::Matrix<double, 12, 5> map = Eigen::Matrix<double, 12, 5>::Zero();
  map(0, 0) = map(4, 2) = map(8, 3) = 1.0;  // x_C, x_D, x_E
  map(1, 1) = map(5, 1) = map(9, 1) = 1.0;  // y_C, shared
  map(2, 4) = map(6, 4) = -1.0;             // A at -r
  map(10, 4) = 1.0;                         // B at r
  return map;
}

Eigen::Vector2d leg_vector(const Leg& leg, const Pose& pose) {
  const double c = std::cos(pose.orientation);
  const double s = std::sin(pose.orientation);
  const Eigen::Vector2d& p = leg.platform_joint;
  return {pose.position.x() + c * p.x() - s * p.y() - leg.base_joint.x(),
          pose.position.y() + s * p.x() + c * p.y() - leg.base_joint.y()};
}

double leg_length(const Leg& leg, const Pose& pose) { return leg_vector(leg, pose).norm(); }

Eigen::VectorXd leg_lengths(const Manipulator& manipulator, const Pose& pose) {
  Eigen::VectorXd lengths(static_cast<Eigen::Index>(manipulator.size()));
  for (std::size_t i = 0; i < manipulator.size(); ++i) {
    lengths[static_cast<Eigen::Index>(i)] = leg_length(manipulator.leg(i), pose);
  }
  return lengths;
}

}  // namespace reprise
