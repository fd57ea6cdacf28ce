#pragma once

// Ten families of random manipulators, most of them nearly degenerate. Header only.

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "reprise/base/constants.hpp"
#include "workspace/samples.hpp"

namespace reprise::test {

/// A manipulator, an orientation, and a range of orientations.
struct FamilyMember {
  Manipulator manipulator;
  double orientation;
  Interval range;
};

inline constexpr std::array<const char*, 10> family_names{"generic",
                                                          "lattice",
                                                          "nearly a lattice",
                                                          "nearly equal legs",
                                                          "nearly equal length limits",
                                                          "legs that end at P",
                                                          "units of 10^4",
                                                          "far from the origin",
                                                          "wide and straight wedges",
                                                          "nearly the same circles"};

namespace families {

inline int whole(std::mt19937& random, int lower, int upper) {
  return std::uniform_int_distribution<int>(lower, upper)(random);
}
inline bool chance(std::mt19937& random, double probability) { return uniform(random, 0.0, 1.0) < probability; }
/// From 10^-15 to 10^-4, with a sign.
inline double tiny(std::mt19937& random) {
  return (chance(random, 0.5) ? 1.0 : -1.0) * std::pow(10.0, uniform(random, -15.0, -4.0));
}

inline std::vector<Leg> lattice_legs(std::mt19937& random) {
  const auto angles = [&random] {
    const double lower = 0.25 * pi * whole(random, -4, 4);
    return Interval{lower, lower + 0.25 * pi * whole(random, 1, 7)};
  };
  std::vector<Leg> legs(static_cast<std::size_t>(whole(random, 1, 5)));
  for (Leg& leg : legs) {
    leg.base_joint = Eigen::Vector2d(whole(random, -2, 2), whole(random, -2, 2));
    leg.platform_joint = Eigen::Vector2d(whole(random, -1, 1), whole(random, -1, 1));
    const int lower = whole(random, 0, 5);
    leg.length = {std::sqrt(lower), std::sqrt(lower + whole(random, 1, 12))};
    if (whole(random, 0, 3) == 0) leg.base_angle = angles();
    if (whole(random, 0, 3) == 0) leg.platform_angle = angles();
  }
  return legs;
}

/// Moves joints and lengths by ever so little, each with a probability.
inline void disturb(std::mt19937& random, Leg& leg, double probability) {
  const auto moved = [&](double value) { return chance(random, probability) ? value + tiny(random) : value; };
  leg.base_joint = {moved(leg.base_joint.x()), moved(leg.base_joint.y())};
  leg.platform_joint = {moved(leg.platform_joint.x()), moved(leg.platform_joint.y())};
  leg.length.lower = std::max(moved(leg.length.lower), 0.0);
  leg.length.upper = std::max(moved(leg.length.upper), leg.length.lower);
}

inline std::vector<Leg> legs_of(std::mt19937& random, std::size_t family) {
  std::vector<Leg> legs = random_manipulator(random).legs();
  switch (family) {
    case 1:
      return lattice_legs(random);
    case 2:
      legs = lattice_legs(random);
      for (Leg& leg : legs) disturb(random, leg, 0.3);
      return legs;
    case 3:
      for (int k = whole(random, 1, 2); k > 0; --k) {
        Leg other = legs[static_cast<std::size_t>(whole(random, 0, static_cast<int>(legs.size()) - 1))];
        disturb(random, other, 0.4);
        legs.push_back(other);
      }
      return legs;
    case 4:
      for (Leg& leg : legs) {
        if (chance(random, 0.5)) leg.length.lower = leg.length.upper * (1.0 - std::abs(tiny(random)));
      }
      return legs;
    case 5:
      for (Leg& leg : legs) {
        leg.platform_joint.setZero();
        if (chance(random, 0.3)) leg.length.lower = std::abs(tiny(random));
      }
      return legs;
    case 6:
      for (Leg& leg : legs) {
        leg.base_joint *= 1e4;
        leg.platform_joint *= 1e4;
        leg.length = {1e4 * leg.length.lower, 1e4 * leg.length.upper};
      }
      return legs;
    case 7: {
      const Eigen::Vector2d far(1e6, uniform(random, -1e6, 1e6));
      for (Leg& leg : legs) leg.base_joint += far;
      return legs;
    }
    case 8:
      for (Leg& leg : legs) {
        const std::array<double, 4> lower{-0.5 * pi, 0.0, pi, uniform(random, -pi, pi)};
        const auto wedge = [&] {
          const double first = lower[static_cast<std::size_t>(whole(random, 0, 3))];
          const double width = chance(random, 0.5) ? pi + tiny(random) : uniform(random, 3.0, 6.28);
          return Interval{first, first + width};
        };
        if (chance(random, 0.7)) leg.base_angle = wedge();
        if (chance(random, 0.4)) leg.platform_angle = wedge();
      }
      return legs;
    case 9:
      for (std::size_t k = 1; k < legs.size(); ++k) {
        // The circles of one leg about those of another: the same, or touching from within or outside.
        legs[k].platform_joint = legs[0].platform_joint;
        legs[k].base_angle.reset();
        legs[k].platform_angle.reset();
        const double apart = chance(random, 0.4) ? 0.0 : uniform(random, 0.1, 1.5);
        legs[k].base_joint = legs[0].base_joint + apart * unit(uniform(random, -pi, pi));
        const double radius = chance(random, 0.5) ? legs[0].length.upper : legs[0].length.lower;
        const double touching = std::abs(chance(random, 0.5) ? radius - apart : radius + apart);
        if (chance(random, 0.5)) {
          legs[k].length = {chance(random, 0.5) ? 0.0 : 0.3 * touching, touching};
        } else {
          legs[k].length = {touching, touching + 1.0};
        }
        disturb(random, legs[k], 0.4);
      }
      return legs;
    default:
      return legs;
  }
}

}  // namespace families

/// Always the same for the same family and number.
inline FamilyMember family_member(std::size_t family, std::size_t number) {
  std::seed_seq seed{family, number};
  std::mt19937 random(seed);
  const std::vector<Leg> legs = families::legs_of(random, family);
  const bool lattice = family == 1 || family == 2;
  const double orientation = lattice ? 0.5 * pi * families::whole(random, -2, 2) : uniform(random, -pi, pi);
  const Interval range = lattice ? Interval{orientation, orientation + 0.25 * pi * families::whole(random, 0, 3)}
                                 : random_orientations(random);
  return {{family_names[family], legs}, orientation, range};
}

}  // namespace reprise::test
