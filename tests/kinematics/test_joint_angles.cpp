#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "kinematics/samples.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/kinematics/joint_angles.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

BOOST_AUTO_TEST_CASE(wrapping_keeps_the_angle) {
  std::mt19937 random(31);
  for (int sample = 0; sample < 200; ++sample) {
    const double angle = uniform(random, -40.0, 40.0);
    const double wrapped = wrap_angle(angle);
    BOOST_TEST(std::abs(wrapped) <= pi);
    BOOST_TEST(std::abs(std::cos(wrapped) - std::cos(angle)) <= 1e-13);
    BOOST_TEST(std::abs(std::sin(wrapped) - std::sin(angle)) <= 1e-13);
  }
  BOOST_TEST(std::isnan(wrap_angle(std::numeric_limits<double>::infinity())));
}

BOOST_AUTO_TEST_CASE(joint_angles_give_the_direction_of_the_leg) {
  std::mt19937 random(32);
  for (int sample = 0; sample < 100; ++sample) {
    const Manipulator manipulator = random_manipulator(random, 1);
    const Pose pose = random_pose(random);
    const Leg& leg = manipulator.leg(0);
    const double angle = base_angle(leg, pose);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    BOOST_TEST((leg_length(leg, pose) * direction - leg_vector(leg, pose)).norm() <= 1e-14);
    BOOST_TEST(std::abs(wrap_angle(platform_angle(leg, pose) - angle + pose.orientation)) <= 1e-14);
    // Turning the whole world turns the base angle and leaves the platform angle.
    const auto [other, other_pose] = moved(manipulator, pose, 2.0, {1.0, -1.0}, 5.0);
    BOOST_TEST(std::abs(wrap_angle(base_angle(other.leg(0), other_pose) - angle - 2.0)) <= 1e-13);
    BOOST_TEST(std::abs(wrap_angle(platform_angle(other.leg(0), other_pose) - platform_angle(leg, pose))) <= 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(a_leg_of_length_zero_has_no_angle_and_lies_in_no_interval) {
  const Leg leg = leg_between({1.0, 0.0}, {0.0, 0.0});
  const Pose pose{{1.0, 0.0}, 0.3};
  BOOST_TEST(std::isnan(base_angle(leg, pose)));
  BOOST_TEST(std::isnan(platform_angle(leg, pose)));
  BOOST_TEST(!contains_angle({-3.0, 3.0}, base_angle(leg, pose)));
}

BOOST_AUTO_TEST_CASE(swept_intervals_wrap_around) {
  const Interval across{pi - 0.2, pi + 0.2};  // holds the direction -x
  BOOST_TEST(contains_angle(across, pi));
  BOOST_TEST(contains_angle(across, -pi));
  BOOST_TEST(contains_angle(across, -pi + 0.1));
  BOOST_TEST(!contains_angle(across, -pi + 0.3));
  BOOST_TEST(!contains_angle(across, 0.0));
  const Interval far{20.0 * pi - 0.5, 20.0 * pi + 0.5};
  BOOST_TEST(contains_angle(far, 0.4));
  BOOST_TEST(!contains_angle(far, 0.6));
  const Interval almost_all{0.1, 2.0 * pi};  // all but the gap (0, 0.1)
  BOOST_TEST(contains_angle(almost_all, -0.1));
  BOOST_TEST(contains_angle(almost_all, pi));
  BOOST_TEST(!contains_angle(almost_all, 0.05));
  for (const double angle : {-pi, -1.0, 0.0, 1.0, pi}) BOOST_TEST(contains_angle({0.0, 2.0 * pi}, angle));
}

BOOST_AUTO_TEST_CASE(the_margin_is_the_distance_to_the_nearer_end) {
  const Interval interval{1.0, 2.0};
  BOOST_TEST(angle_margin(interval, 1.25) == 0.25, tt::tolerance(1e-14));
  BOOST_TEST(angle_margin(interval, 1.9 - 2.0 * pi) == 0.1, tt::tolerance(1e-13));
  BOOST_TEST(angle_margin(interval, 0.7) == -0.3, tt::tolerance(1e-14));
  BOOST_TEST(std::abs(angle_margin(interval, 2.0)) <= 1e-15);
  // Continuous and with slope 1 or -1 all the way round, also opposite the interval's middle.
  double before = angle_margin(interval, 0.0);
  for (double angle = 1e-3; angle < 7.0; angle += 1e-3) {
    const double now = angle_margin(interval, angle);
    BOOST_TEST_REQUIRE(std::abs(now - before) <= 1e-3 * (1.0 + 1e-9));
    before = now;
  }
}

BOOST_AUTO_TEST_CASE(bad_intervals_are_rejected) {
  for (const Interval& bad : {Interval{1.0, 1.0}, Interval{1.0, 0.0}, Interval{0.0, 6.3}, Interval{not_a_number, 1.0},
                              Interval{0.0, not_a_number}, Interval{-infinity, 0.0}, Interval{0.0, infinity}}) {
    BOOST_CHECK_THROW(angle_margin(bad, 0.0), std::invalid_argument);
    BOOST_CHECK_THROW(contains_angle(bad, 0.0), std::invalid_argument);
  }
}
