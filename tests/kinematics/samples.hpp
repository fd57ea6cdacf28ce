#pragma once

// Manipulators, poses and measures shared by the tests of libs/kinematics. Header only.

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/coordinates.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise::test {

inline double uniform(std::mt19937& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

inline Eigen::VectorXd uniform_vector(std::mt19937& random, Eigen::Index size) {
  return Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return uniform(random, -1.0, 1.0); });
}

inline Leg leg_between(const Eigen::Vector2d& base_joint, const Eigen::Vector2d& platform_joint) {
  return Leg{base_joint, platform_joint, {0.0, 10.0}, {}, {}};
}

/// Base joints in a square of half width 2 `size`, platform joints in one of half width `size`.
inline Manipulator random_manipulator(std::mt19937& random, std::size_t legs, double size = 1.0) {
  std::vector<Leg> result;
  for (std::size_t i = 0; i < legs; ++i) {
    result.push_back(leg_between(2.0 * size * uniform_vector(random, 2), size * uniform_vector(random, 2)));
  }
  return {"random", result};
}

inline Pose random_pose(std::mt19937& random, double size = 1.0) {
  const Eigen::Vector2d position = 2.0 * size * uniform_vector(random, 2);
  return {position, uniform(random, -pi, pi)};
}

/// The manipulator and pose whose coordinates (coordinates.hpp) differ by `step`.
inline std::pair<Manipulator, Pose> displaced(const Manipulator& manipulator, const Pose& pose,
                                              const Eigen::VectorXd& step) {
  std::vector<Leg> legs = manipulator.legs();
  for (std::size_t i = 0; i < legs.size(); ++i) {
    legs[i].base_joint += step.segment<2>(coordinate_count(i));
    legs[i].platform_joint += step.segment<2>(coordinate_count(i) + 2);
  }
  return {{manipulator.name(), legs}, {pose.position + step.head<2>(), pose.orientation + step[2]}};
}

/// The manipulator and pose after a turn of the world about its origin, a shift of it, and a change of length unit.
inline std::pair<Manipulator, Pose> moved(const Manipulator& manipulator, const Pose& pose, double turn,
                                          const Eigen::Vector2d& shift, double unit) {
  const Eigen::Rotation2Dd rotation(turn);
  std::vector<Leg> legs = manipulator.legs();
  for (Leg& leg : legs) {
    leg.base_joint = unit * (rotation * leg.base_joint + shift);
    leg.platform_joint *= unit;
  }
  return {{manipulator.name(), legs}, {unit * (rotation * pose.position + shift), pose.orientation + turn}};
}

/// Root mean squares of the Taylor remainders of f(t) = value + t slope + t^2 curvature / 2 + ..., gathered over many
/// samples at a step and at half of it; a single remainder may vanish by chance.
class TaylorRemainders {
 public:
  void add(const std::function<double(double)>& f, double value, double slope, double curvature) {
    for (int i = 0; i < 2; ++i) {
      const double t = longest_step / (i + 1);
      const double first = f(t) - value - t * slope;
      first_[i] += first * first;
      const double second = first - 0.5 * t * t * curvature;
      second_[i] += second * second;
    }
  }
  /// 2 if the slope is right, 1 otherwise.
  double first_order() const { return 0.5 * std::log2(first_[0] / first_[1]); }
  /// 3 if slope and curvature are right, 2 or less otherwise.
  double second_order() const { return 0.5 * std::log2(second_[0] / second_[1]); }

 private:
  static constexpr double longest_step = 1e-4;
  double first_[2] = {0.0, 0.0};
  double second_[2] = {0.0, 0.0};
};

}  // namespace reprise::test
