#pragma once

// Manipulators shared by the tests of libs/workspace. Header only.

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/region.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise::test {

inline double uniform(std::mt19937& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

inline Eigen::Vector2d uniform_point(std::mt19937& random, double size = 1.0) {
  return {uniform(random, -size, size), uniform(random, -size, size)};
}

inline Eigen::Vector2d unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Area common to two discs whose centres are d apart.
inline double lens_area(double r, double s, double d) {
  const double a = std::acos((d * d + r * r - s * s) / (2.0 * d * r));
  const double b = std::acos((d * d + s * s - r * r) / (2.0 * d * s));
  return r * r * (a - 0.5 * std::sin(2.0 * a)) + s * s * (b - 0.5 * std::sin(2.0 * b));
}

/// Largest h_j at a point.
inline double largest_limit(const Limits& limits, const Eigen::Vector2d& u) {
  Eigen::VectorXd h(limits.count());
  limits.evaluate(u, h);
  return h.maxCoeff();
}

/// Central differences of all h_j at a point, one row for each.
inline Eigen::MatrixX2d differenced_gradients(const Limits& limits, const Eigen::Vector2d& u, double step) {
  Eigen::VectorXd above(limits.count());
  Eigen::VectorXd below(limits.count());
  Eigen::MatrixX2d differences(limits.count(), 2);
  for (Eigen::Index i = 0; i < 2; ++i) {
    limits.evaluate(u + step * Eigen::Vector2d::Unit(i), above);
    limits.evaluate(u - step * Eigen::Vector2d::Unit(i), below);
    differences.col(i) = (above - below) / (2.0 * step);
  }
  return differences;
}

/// Calls of the limits, counted independently of the tracer.
class CountingLimits final : public Limits {
 public:
  explicit CountingLimits(const Limits& limits) : limits_(limits) {}
  Eigen::Index count() const override { return limits_.count(); }
  void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const override {
    ++evaluations;
    limits_.evaluate(u, h);
  }
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j) const override {
    ++gradients;
    return limits_.gradient(u, j);
  }
  std::string label(Eigen::Index j) const override { return limits_.label(j); }
  Eigen::AlignedBox2d box() const override { return limits_.box(); }

  mutable std::size_t evaluations = 0;
  mutable std::size_t gradients = 0;

 private:
  const Limits& limits_;
};

/// The designs M1 to M3 of Table 5.1, with the leg limits of Section 5.5.4.
inline std::vector<Manipulator> thesis_manipulators() {
  const double s2 = std::numbers::sqrt2;
  const std::array<Interval, 3> lengths{{{s2, 2.0}, {s2, 2.0}, {1.0, std::numbers::sqrt3}}};
  return {make_manipulator({-1.0, 0.0, 1.0, 2.0, 1.0}, lengths, "M1"),
          make_manipulator({-0.75, 0.0, 0.75, 1.5, 0.75}, lengths, "M2"),
          make_manipulator({-0.5, 0.0, 0.5, 1.0, 0.25}, lengths, "M3")};
}

inline Manipulator m1() { return thesis_manipulators().front(); }

/// All loops of a region, component by component, the outer one before its holes.
inline std::vector<BoundaryLoop> loops(const Region& region) {
  std::vector<BoundaryLoop> list;
  for (const RegionComponent& component : region.components()) {
    list.push_back(component.outer);
    list.insert(list.end(), component.holes.begin(), component.holes.end());
  }
  return list;
}

inline std::size_t number_of_holes(const Region& region) { return loops(region).size() - region.components().size(); }

/// A leg that ends at P itself, so that its limits are circles about its base joint.
inline Leg leg_at(const Eigen::Vector2d& base_joint, const Interval& length) {
  return {base_joint, Eigen::Vector2d::Zero(), length, {}, {}};
}

/// One to four legs; some without a minimum length, some with joint angle limits, narrow and wide.
inline Manipulator random_manipulator(std::mt19937& random) {
  std::vector<Leg> legs(std::uniform_int_distribution<std::size_t>(1, 4)(random));
  const auto random_angles = [&random] {
    const double lower = uniform(random, -4.0, 4.0);
    return Interval{lower, lower + uniform(random, 0.5, 5.5)};
  };
  for (Leg& leg : legs) {
    leg.base_joint = uniform_point(random);
    leg.platform_joint = uniform_point(random, 0.7);
    leg.length.lower = uniform(random, 0.0, 1.0) < 0.15 ? 0.0 : uniform(random, 0.2, 1.2);
    leg.length.upper = leg.length.lower + uniform(random, 0.1, 1.2);
    if (uniform(random, 0.0, 1.0) < 0.2) leg.base_angle = random_angles();
    if (uniform(random, 0.0, 1.0) < 0.2) leg.platform_angle = random_angles();
  }
  return {"random", legs};
}

/// A range of orientations: most are narrow, some nearly a full turn wide.
inline Interval random_orientations(std::mt19937& random) {
  const double lower = uniform(random, -pi, pi);
  return {lower, lower + std::pow(uniform(random, 0.0, 1.0), 3.0) * 1.9 * pi};
}

}  // namespace reprise::test
