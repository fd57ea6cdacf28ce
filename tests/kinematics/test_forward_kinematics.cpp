#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "kinematics/samples.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/joint_angles.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

std::array<double, 3> lengths_at(const Manipulator& manipulator, const Pose& pose) {
  const Eigen::VectorXd lengths = leg_lengths(manipulator, pose);
  return {lengths[0], lengths[1], lengths[2]};
}

/// Distance of two poses: the larger of the distance of their positions over `size` and the angle between them.
double distance(const Pose& a, const Pose& b, double size = 1.0) {
  return std::max((a.position - b.position).norm() / size, std::abs(wrap_angle(a.orientation - b.orientation)));
}

double distance_to_nearest(const std::vector<Pose>& poses, const Pose& pose, double size = 1.0) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Pose& other : poses) nearest = std::min(nearest, distance(other, pose, size));
  return nearest;
}

/// A manipulator with base joints in line and platform joints in line, as in the thesis, both in general direction.
Manipulator random_collinear_manipulator(std::mt19937& random, double size) {
  std::vector<Leg> legs;
  const double height = uniform(random, -1.0, 1.0);
  for (int i = 0; i < 3; ++i) {
    legs.push_back(leg_between(size * Eigen::Vector2d(uniform(random, -2.0, 2.0), height),
                               size * Eigen::Vector2d(uniform(random, -1.0, 1.0), 0.0)));
  }
  return {"collinear", legs};
}

/// Assembly modes by an independent route: sweep the orientation, intersect the circles of legs 1 and 2, and bisect
/// where the length of leg 3 changes from too short to too long.
std::vector<Pose> modes_by_scanning(const Manipulator& manipulator, const std::array<double, 3>& lengths) {
  const auto pose_at = [&](double phi, double side) -> std::optional<Pose> {
    const Eigen::Rotation2Dd rotation(phi);
    const Eigen::Vector2d first = manipulator.leg(0).base_joint - rotation * manipulator.leg(0).platform_joint;
    const Eigen::Vector2d second = manipulator.leg(1).base_joint - rotation * manipulator.leg(1).platform_joint;
    const double apart = (second - first).norm();
    const double along = (lengths[0] * lengths[0] - lengths[1] * lengths[1] + apart * apart) / (2.0 * apart);
    const double square = lengths[0] * lengths[0] - along * along;
    if (square < 0.0) return std::nullopt;
    const Eigen::Vector2d unit = (second - first) / apart;
    const Eigen::Vector2d position =
        first + along * unit + side * std::sqrt(square) * Eigen::Vector2d(-unit.y(), unit.x());
    return Pose{position, phi};
  };
  const auto error = [&](const Pose& pose) { return leg_length(manipulator.leg(2), pose) - lengths[2]; };
  // Between an orientation where the circles meet and one where they do not, the last one where they do.
  const auto last_meeting = [&](double meeting, double apart) {
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (meeting + apart);
      (pose_at(middle, 1.0) ? meeting : apart) = middle;
    }
    return meeting;
  };
  std::vector<Pose> modes;
  constexpr int steps = 5000;
  for (int i = 0; i < steps; ++i) {
    double lower = -pi + 2.0 * pi * i / steps;
    double upper = -pi + 2.0 * pi * (i + 1) / steps;
    if (!pose_at(lower, 1.0) && !pose_at(upper, 1.0)) continue;
    if (!pose_at(lower, 1.0)) lower = last_meeting(upper, lower);
    if (!pose_at(upper, 1.0)) upper = last_meeting(lower, upper);
    for (const double side : {-1.0, 1.0}) {
      double low = lower;
      double high = upper;
      const bool rising = error(*pose_at(high, side)) > 0.0;
      if ((error(*pose_at(low, side)) > 0.0) == rising) continue;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        ((error(*pose_at(middle, side)) > 0.0) == rising ? high : low) = middle;
      }
      modes.push_back(*pose_at(low, side));
    }
  }
  return modes;
}

bool increasing(const Pose& a, const Pose& b) {
  constexpr double same = 1e-8;
  if (std::abs(a.orientation - b.orientation) > same) return a.orientation < b.orientation;
  if (std::abs(a.position.x() - b.position.x()) > same) return a.position.x() < b.position.x();
  return a.position.y() < b.position.y();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_pose_is_among_the_modes_of_its_lengths) {
  std::mt19937 random(61);
  std::map<std::size_t, int> counts;
  for (int sample = 0; sample < 1000; ++sample) {
    const double size = std::pow(10.0, uniform(random, -3.0, 3.0));
    const bool collinear = sample % 3 == 1;
    const Manipulator manipulator =
        collinear ? random_collinear_manipulator(random, size) : random_manipulator(random, 3, size);
    Pose pose = random_pose(random, size);
    if (collinear && sample % 2 == 0) pose.orientation = 0.0;  // all legs' circle centres are then in line
    const std::array<double, 3> lengths = lengths_at(manipulator, pose);
    const AssemblyModes modes = assembly_modes(manipulator, lengths);
    BOOST_TEST(!modes.infinitely_many);
    BOOST_TEST(distance_to_nearest(modes.poses, pose, size) <= 1e-9);
    const double largest = *std::max_element(lengths.begin(), lengths.end());
    for (std::size_t i = 0; i < modes.poses.size(); ++i) {
      const std::array<double, 3> reached = lengths_at(manipulator, modes.poses[i]);
      for (std::size_t leg = 0; leg < 3; ++leg) {
        BOOST_TEST(std::abs(reached[leg] - lengths[leg]) <= 1e-12 * std::max(largest, size));
      }
      for (std::size_t j = 0; j < i; ++j) BOOST_TEST(distance(modes.poses[i], modes.poses[j], size) > 1e-8);
    }
    BOOST_TEST(modes.poses.size() % 2 == 0);
    BOOST_TEST(modes.poses.size() <= 6);
    ++counts[modes.poses.size()];
  }
  BOOST_TEST(counts[2] > 0);
  BOOST_TEST(counts[4] > 0);
  BOOST_TEST(counts[6] > 0);
}

BOOST_AUTO_TEST_CASE(no_mode_is_missing) {
  std::mt19937 random(62);
  for (int sample = 0; sample < 24; ++sample) {
    const Manipulator manipulator =
        sample % 4 == 0 ? random_collinear_manipulator(random, 1.0) : random_manipulator(random, 3);
    const std::array<double, 3> lengths = lengths_at(manipulator, random_pose(random));
    const std::vector<Pose> modes = assembly_modes(manipulator, lengths).poses;
    const std::vector<Pose> scanned = modes_by_scanning(manipulator, lengths);
    BOOST_TEST(scanned.size() == modes.size());
    for (const Pose& pose : scanned) BOOST_TEST(distance_to_nearest(modes, pose) <= 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(modes_are_sorted_and_free_of_the_frame_the_unit_and_the_order_of_legs) {
  std::mt19937 random(63);
  for (int sample = 0; sample < 40; ++sample) {
    const Manipulator manipulator = random_manipulator(random, 3);
    const Pose pose = random_pose(random);
    const std::vector<Pose> modes = assembly_modes(manipulator, lengths_at(manipulator, pose)).poses;
    BOOST_TEST(std::is_sorted(modes.begin(), modes.end(), increasing));

    const auto [other, other_pose] = moved(manipulator, pose, 0.9, {4.0, -7.0}, 250.0);
    const std::vector<Pose> other_modes = assembly_modes(other, lengths_at(other, other_pose)).poses;
    BOOST_TEST(other_modes.size() == modes.size());
    for (const Pose& mode : modes) {
      const Pose expected = moved(manipulator, mode, 0.9, {4.0, -7.0}, 250.0).second;
      BOOST_TEST(distance_to_nearest(other_modes, expected, 250.0) <= 1e-9);
    }

    const Manipulator rotated("rotated", {manipulator.leg(2), manipulator.leg(0), manipulator.leg(1)});
    const std::vector<Pose> rotated_modes = assembly_modes(rotated, lengths_at(rotated, pose)).poses;
    BOOST_TEST(rotated_modes.size() == modes.size());
    for (const Pose& mode : modes) BOOST_TEST(distance_to_nearest(rotated_modes, mode) <= 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(the_thesis_family_at_orientation_zero_has_mirrored_modes) {
  // Base joints on y = 0 and the platform in line with them: every mode mirrored at that line is a mode.
  const Manipulator manipulator =
      make_manipulator({-1.0, 0.0, 1.0, 2.0, 1.0}, {Interval{1.0, 2.0}, {1.0, 2.0}, {1.0, 2.0}});
  const Pose pose{{1.0, 1.5}, 0.0};
  const std::vector<Pose> modes = assembly_modes(manipulator, lengths_at(manipulator, pose)).poses;
  BOOST_TEST(distance_to_nearest(modes, pose) <= 1e-12);
  BOOST_TEST(distance_to_nearest(modes, {{1.0, -1.5}, 0.0}) <= 1e-12);
  for (const Pose& mode : modes) {
    const Pose mirrored{{mode.position.x(), -mode.position.y()}, -mode.orientation};
    BOOST_TEST(distance_to_nearest(modes, mirrored) <= 1e-9);
  }
  BOOST_TEST(std::is_sorted(modes.begin(), modes.end(), increasing));
}

BOOST_AUTO_TEST_CASE(a_platform_far_smaller_or_larger_than_the_base_is_no_obstacle) {
  std::mt19937 random(71);
  for (const double ratio : {1e-3, 1e-2, 1e2, 1e3}) {
    for (int sample = 0; sample < 30; ++sample) {
      const bool collinear = sample % 2 == 0;
      std::vector<Leg> legs =
          (collinear ? random_collinear_manipulator(random, 1.0) : random_manipulator(random, 3)).legs();
      for (Leg& leg : legs) leg.platform_joint *= ratio;
      const Manipulator manipulator("uneven", legs);
      Pose pose = random_pose(random);
      if (collinear) pose.orientation = 0.0;
      const std::vector<Pose> modes = assembly_modes(manipulator, lengths_at(manipulator, pose)).poses;
      BOOST_TEST(modes.size() <= 6);
      BOOST_TEST(modes.size() % 2 == 0);
      // Rounding of the lengths is magnified by about the ratio of sizes, more so near a singular pose.
      BOOST_TEST(distance_to_nearest(modes, pose) <= 1e-6);
    }
  }
}

BOOST_AUTO_TEST_CASE(lengths_out_of_reach_have_no_modes) {
  std::mt19937 random(64);
  for (int sample = 0; sample < 100; ++sample) {
    const Manipulator manipulator = random_manipulator(random, 3);
    // Leg 3 longer than legs 1, base and platform can span.
    const double span = (manipulator.leg(2).base_joint - manipulator.leg(0).base_joint).norm() +
                        (manipulator.leg(2).platform_joint - manipulator.leg(0).platform_joint).norm();
    const AssemblyModes modes = assembly_modes(manipulator, {1.0, 1.0, 1.001 + span});
    BOOST_TEST(modes.poses.empty());
    BOOST_TEST(!modes.infinitely_many);
  }
}

BOOST_AUTO_TEST_CASE(a_fully_stretched_manipulator_has_one_mode) {
  // Leg 3, the platform and leg 1 in one line, as long as they can be: the two modes next to it have met there.
  const Manipulator manipulator("stretched", {leg_between({0.0, 0.0}, {0.0, 0.0}), leg_between({0.0, -1.0}, {0.0, 0.0}),
                                              leg_between({4.0, 0.0}, {1.0, 0.0})});
  const Pose stretched{{1.0, 0.0}, 0.0};
  const AssemblyModes modes = assembly_modes(manipulator, lengths_at(manipulator, stretched));
  BOOST_TEST(distance_to_nearest(modes.poses, stretched) <= 1e-7);
  BOOST_TEST(modes.poses.size() == 1);
  // With leg 3 a little longer the two modes part, with leg 3 a little shorter they are out of reach.
  BOOST_TEST(assembly_modes(manipulator, {1.0, std::sqrt(2.0), 2.0 + 1e-6}).poses.size() == 2);
  BOOST_TEST(assembly_modes(manipulator, {1.0, std::sqrt(2.0), 2.0 - 1e-6}).poses.empty());
}

BOOST_AUTO_TEST_CASE(modes_that_have_come_together_are_one_with_its_multiplicity) {
  // Joints on a lattice, and lengths with the rounding of one that was computed. What is expected follows from the
  // eliminant in whole numbers: of the first manipulator it is (t - 1) (3 t + 2)^2 (9 t - 1) (13 t^2 - 24 t + 13) in t
  // = tan(phi / 2), and at its double root circles 1 and 2 are the same, but circle 3 is too far away to meet them. Of
  // the last it is t (t + 1)^2 (t + 3) (3 t + 1), and at t = -1 all circles have one centre and different radii.
  struct Case {
    std::array<Eigen::Vector2d, 3> base;
    std::array<Eigen::Vector2d, 3> platform;
    std::array<double, 3> lengths;
    std::vector<Pose> poses;
    std::vector<int> multiplicities;
  };
  using Corners = std::array<Eigen::Vector2d, 3>;
  const Case cases[] = {
      {Corners{Eigen::Vector2d(1.0, 0.0), {-0.5, 1.0}, {-1.5, 2.0}},
       Corners{Eigen::Vector2d(0.5, 0.5), {-1.0, -0.5}, {-1.0, -1.0}},
       {1.8027756377319946, 1.8027756377319946, 3.6055512754639891},
       {{{153.0 / 82.0, 29.0 / 41.0}, 2.0 * std::atan(1.0 / 9.0)}, {{0.5, 1.0}, 0.5 * pi}},
       {1, 1}},
      {Corners{Eigen::Vector2d(0.0, 1.0), {1.0, -1.0}, {1.5, -1.0}},
       Corners{Eigen::Vector2d(1.0, 0.5), {0.5, 0.5}, {0.5, 0.0}},
       {0.49999999999999989, 1.5811388300841898, 2.2360679774997898},
       {{{1.0, 1.0}, pi}},
       {2}},
      {Corners{Eigen::Vector2d(-2.0, -2.0), {-2.0, -2.0}, {-1.5, -2.0}},
       Corners{Eigen::Vector2d(-1.0, 0.5), {0.0, 0.5}, {1.0, -0.5}},
       {2.0, 0.99999999999999989, 1.1180339887498949},
       {{{-3.0, -2.5}, 0.0}, {{-1.0, -1.5}, pi}},
       {2, 2}},
      {Corners{Eigen::Vector2d(-1.0, -0.5), {-0.5, 0.0}, {-2.0, 0.5}},
       Corners{Eigen::Vector2d(0.5, 0.0), {0.0, 0.5}, {-0.5, -1.0}},
       {1.1180339887498949, 0.50000000000000011, 1.8027756377319948},
       {{{-0.8, 0.9}, -2.0 * std::atan(3.0)},
        {{-0.4, -0.7}, -2.0 * std::atan(1.0 / 3.0)},
        {{-0.5, 0.0}, 0.0},
        {{-1.0, 0.5}, pi}},
       {1, 1, 1, 1}},
      // At half a turn the lines of all legs meet in (1.5, 1.5). The second mode is from Newton iterations in 40
      // digits.
      {Corners{Eigen::Vector2d(1.5, -0.5), {-0.5, -0.5}, {-1.5, 1.5}},
       Corners{Eigen::Vector2d(0.0, 0.0), {0.0, -1.0}, {-1.0, -1.0}},
       {1.0, 2.8284271247461903, 4.0},
       {{{1.5, 0.5}, pi},
        {{2.24932564347132, -1.16220169135717}, -0.413614032940721},
        {{1.5, 0.5}, 2.0 * std::atan(0.5)}},
       {2, 1, 1}},
  };
  for (const Case& one : cases) {
    std::vector<Leg> legs;
    for (std::size_t i = 0; i < 3; ++i) legs.push_back(leg_between(one.base[i], one.platform[i]));
    const AssemblyModes modes = assembly_modes(Manipulator("lattice", legs), one.lengths);
    BOOST_TEST(modes.poses.size() == one.poses.size());
    for (const Pose& pose : one.poses) BOOST_TEST(distance_to_nearest(modes.poses, pose) <= 1e-14);
    BOOST_TEST(modes.multiplicities == one.multiplicities, tt::per_element());
  }
}

BOOST_AUTO_TEST_CASE(a_free_motion_is_reported) {
  const Leg first = leg_between({0.0, 0.0}, {-0.5, 0.0});
  const Leg third = leg_between({2.0, 0.3}, {0.5, 0.2});
  // Two identical legs leave one freedom, if the third reaches at all.
  const Manipulator twins("twins", {first, first, third});
  BOOST_TEST(assembly_modes(twins, {1.0, 1.0, 1.2}).infinitely_many);
  BOOST_TEST(assembly_modes(twins, {1.0, 1.0, 1.2}).poses.empty());
  BOOST_TEST(!assembly_modes(twins, {1.0, 1.1, 1.2}).infinitely_many);
  BOOST_TEST(assembly_modes(twins, {1.0, 1.1, 1.2}).poses.empty());
  BOOST_TEST(!assembly_modes(twins, {0.1, 0.1, 20.0}).infinitely_many);
  BOOST_TEST(assembly_modes(Manipulator("twins", {third, first, first}), {1.2, 1.0, 1.0}).infinitely_many);

  // Platform congruent to the base and legs of one length: a parallelogram.
  const std::array<Eigen::Vector2d, 3> corners = {Eigen::Vector2d(0.0, 0.0), {2.0, 0.0}, {0.5, 1.0}};
  const Manipulator congruent("congruent", {leg_between(corners[0], corners[0]), leg_between(corners[1], corners[1]),
                                            leg_between(corners[2], corners[2])});
  BOOST_TEST(assembly_modes(congruent, {1.0, 1.0, 1.0}).infinitely_many);
  BOOST_TEST(!assembly_modes(congruent, {1.0, 1.0, 1.01}).infinitely_many);

  // All base joints in one point: the platform turns about it.
  const Manipulator star("star", {leg_between({1.0, 1.0}, corners[0]), leg_between({1.0, 1.0}, corners[1]),
                                  leg_between({1.0, 1.0}, corners[2])});
  BOOST_TEST(assembly_modes(star, lengths_at(star, {{0.3, 0.4}, 0.5})).infinitely_many);
  BOOST_TEST(assembly_modes(star, {1.0, 1.0, 3.0}).poses.empty());

  // All platform joints in one point: the platform turns about it, if the legs meet there.
  const Manipulator point("point", {leg_between(corners[0], {0.2, 0.1}), leg_between(corners[1], {0.2, 0.1}),
                                    leg_between(corners[2], {0.2, 0.1})});
  BOOST_TEST(assembly_modes(point, lengths_at(point, {{0.3, 0.4}, 0.5})).infinitely_many);
  BOOST_TEST(!assembly_modes(point, {1.0, 1.2, 1.4}).infinitely_many);
  BOOST_TEST(assembly_modes(point, {1.0, 1.2, 1.4}).poses.empty());

  const Leg nothing = leg_between({1.0, 1.0}, {0.0, 0.0});
  BOOST_TEST(assembly_modes(Manipulator("nothing", {nothing, nothing, nothing}), {0.0, 0.0, 0.0}).infinitely_many);
}

BOOST_AUTO_TEST_CASE(similar_base_and_platform_have_finitely_many_modes) {
  // Both in line and in proportion: the linear equations are singular at every orientation.
  const Manipulator manipulator("similar", {leg_between({0.0, 0.0}, {0.0, 0.0}), leg_between({2.0, 0.0}, {1.0, 0.0}),
                                            leg_between({6.0, 0.0}, {3.0, 0.0})});
  const Pose pose{{1.0, 1.5}, 0.4};
  const AssemblyModes modes = assembly_modes(manipulator, lengths_at(manipulator, pose));
  BOOST_TEST(!modes.infinitely_many);
  BOOST_TEST(distance_to_nearest(modes.poses, pose) <= 1e-9);
  BOOST_TEST(modes.poses.size() == 4);
  BOOST_TEST(modes_by_scanning(manipulator, lengths_at(manipulator, pose)).size() == 4);
}

BOOST_AUTO_TEST_CASE(all_joints_on_a_line_with_the_legs_stretched_along_it_have_a_finite_mode) {
  // Two legs share a circle there, and the circle of the other touches it: the linear equations are singular.
  const double a = -1.999;
  const Manipulator manipulator("in line", {leg_between({-0.5, -0.5}, {-0.5, -0.5}), leg_between({-0.5, -0.5}, {a, a}),
                                            leg_between({a, a}, {a, a})});
  const Pose pose{{a, a}, 0.0};
  const std::array<double, 3> lengths = lengths_at(manipulator, pose);
  const AssemblyModes modes = assembly_modes(manipulator, lengths);
  BOOST_TEST(!modes.infinitely_many);
  // Where circles touch, a position depends on the lengths like a square root: half the digits are left.
  BOOST_TEST(distance_to_nearest(modes.poses, pose) <= 1e-7);
  for (const Pose& mode : modes.poses) {
    for (std::size_t i = 0; i < 3; ++i) {
      BOOST_TEST(leg_length(manipulator.leg(i), mode) == lengths[i], tt::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_leg_of_length_zero_is_no_obstacle) {
  std::mt19937 random(65);
  for (int sample = 0; sample < 15; ++sample) {
    std::vector<Leg> legs = random_manipulator(random, 3).legs();
    const Pose pose = random_pose(random);
    const std::size_t zero = static_cast<std::size_t>(sample) % 3;
    legs[zero].base_joint += leg_vector(legs[zero], pose);
    const Manipulator manipulator("touching", legs);
    std::array<double, 3> lengths = lengths_at(manipulator, pose);
    lengths[zero] = 0.0;
    const AssemblyModes modes = assembly_modes(manipulator, lengths);
    // Where a leg has no length the pose depends on the lengths like a square root: half the digits are left.
    BOOST_TEST(distance_to_nearest(modes.poses, pose) <= 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(bad_lengths_and_manipulators_are_rejected) {
  std::mt19937 random(66);
  const Manipulator three = random_manipulator(random, 3);
  BOOST_CHECK_THROW(assembly_modes(random_manipulator(random, 2), {1.0, 1.0, 1.0}), std::invalid_argument);
  BOOST_CHECK_THROW(assembly_modes(random_manipulator(random, 4), {1.0, 1.0, 1.0}), std::invalid_argument);
  const Pose start = random_pose(random);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1e-9, nan, std::numeric_limits<double>::infinity()}) {
    BOOST_CHECK_THROW(assembly_modes(three, {1.0, bad, 1.0}), std::invalid_argument);
    BOOST_CHECK_THROW(fit_pose(three, Eigen::Vector3d(1.0, 1.0, bad), start), std::invalid_argument);
  }
  BOOST_CHECK_THROW(fit_pose(three, Eigen::Vector2d(1.0, 1.0), start), std::invalid_argument);
  BOOST_CHECK_THROW(fit_pose(three, Eigen::Vector3d(1.0, 1.0, 1.0), {{nan, 0.0}, 0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(fitting_from_nearby_recovers_the_pose) {
  std::mt19937 random(67);
  for (int sample = 0; sample < 60; ++sample) {
    const std::size_t legs = 3 + static_cast<std::size_t>(sample) % 4;
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    if (kappa_inverse(manipulator, pose) < 0.1) continue;
    const Pose start{pose.position + 0.02 * uniform_vector(random, 2), pose.orientation + uniform(random, -0.02, 0.02)};
    const FittedPose fitted = fit_pose(manipulator, leg_lengths(manipulator, pose), start);
    BOOST_TEST(fitted.converged);
    BOOST_TEST(fitted.residual <= 1e-13);
    BOOST_TEST(distance(fitted.pose, pose) <= 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(fits_from_many_starts_are_all_among_the_modes) {
  std::mt19937 random(68);
  for (int sample = 0; sample < 4; ++sample) {
    const Manipulator manipulator = random_manipulator(random, 3);
    const Eigen::VectorXd lengths = leg_lengths(manipulator, random_pose(random));
    const std::vector<Pose> modes = assembly_modes(manipulator, {lengths[0], lengths[1], lengths[2]}).poses;
    std::vector<Pose> found;
    for (int start = 0; start < 100; ++start) {
      const FittedPose fitted = fit_pose(manipulator, lengths, random_pose(random));
      if (fitted.residual > 1e-12) continue;
      BOOST_TEST(distance_to_nearest(modes, fitted.pose) <= 1e-6);
      if (distance_to_nearest(found, fitted.pose) > 1e-6) found.push_back(fitted.pose);
    }
    BOOST_TEST(found.size() == modes.size());
  }
}

BOOST_AUTO_TEST_CASE(a_fit_to_lengths_out_of_reach_is_stationary) {
  std::mt19937 random(69);
  for (int sample = 0; sample < 30; ++sample) {
    const Manipulator manipulator = random_manipulator(random, 4);
    const Eigen::VectorXd lengths = 3.0 * uniform_vector(random, 4).cwiseAbs();
    const FittedPose fitted = fit_pose(manipulator, lengths, random_pose(random));
    BOOST_TEST(fitted.converged);
    const Eigen::VectorXd residuals = leg_lengths(manipulator, fitted.pose) - lengths;
    BOOST_TEST(fitted.residual == residuals.norm(), tt::tolerance(1e-12));
    BOOST_TEST((jacobian(manipulator, fitted.pose).transpose() * residuals).norm() <= 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(fewer_than_three_legs_can_be_fitted) {
  std::mt19937 random(70);
  for (const std::size_t legs : {1UL, 2UL}) {
    const Manipulator manipulator = random_manipulator(random, legs);
    const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(legs), 2.5);
    const FittedPose fitted = fit_pose(manipulator, lengths, random_pose(random));
    BOOST_TEST(fitted.converged);
    BOOST_TEST(fitted.residual <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(the_thesis_manipulators_assemble_at_their_mean_lengths) {
  const double root2 = std::numbers::sqrt2;
  const double root3 = std::numbers::sqrt3;
  const std::array<Interval, 3> limits = {{{root2, 2.0}, {root2, 2.0}, {1.0, root3}}};
  for (const CollinearDesign& design : {CollinearDesign{-1.0, 0.0, 1.0, 2.0, 1.0}, {-0.75, 0.0, 0.75, 1.5, 0.75}}) {
    const Manipulator manipulator = make_manipulator(design, limits);
    const Eigen::VectorXd mean = mean_lengths(manipulator);
    BOOST_TEST(mean[0] == 0.5 * (root2 + 2.0));
    BOOST_TEST(mean[2] == 0.5 * (1.0 + root3));
    const FittedPose fitted = fit_pose(manipulator, mean, {{1.0, 1.5}, 0.0});
    BOOST_TEST(fitted.converged);
    BOOST_TEST(fitted.residual <= 1e-12);
    const std::vector<Pose> modes = assembly_modes(manipulator, {mean[0], mean[1], mean[2]}).poses;
    BOOST_TEST(distance_to_nearest(modes, fitted.pose) <= 1e-9);
  }
}
