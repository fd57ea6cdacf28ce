#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "reprise/workspace/orientation_workspace.hpp"
#include "sample_count.hpp"
#include "workspace/samples.hpp"

namespace {

using namespace reprise;
using namespace reprise::test;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_SUITE(orientation_workspace_at_a_point)

BOOST_AUTO_TEST_CASE(intervals_are_where_all_limits_hold) {
  std::mt19937 random(1);
  int several = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Manipulator manipulator = random_manipulator(random);
    const Eigen::Vector2d u = uniform_point(random, 1.5);
    const std::vector<Interval> intervals = orientation_workspace(manipulator, u);
    several += intervals.size() > 1 ? 1 : 0;
    for (std::size_t k = 0; k < intervals.size(); ++k) {
      BOOST_TEST(intervals[k].lower < intervals[k].upper);
      BOOST_TEST((intervals[k].lower >= -pi && intervals[k].lower < pi));
      if (k > 0) BOOST_TEST(intervals[k - 1].upper < intervals[k].lower);
      // At the ends a limit is active.
      if (intervals[k].upper - intervals[k].lower >= 2.0 * pi) continue;
      for (const double phi : {intervals[k].lower, intervals[k].upper}) {
        BOOST_TEST(std::abs(largest_limit(ConstantOrientationLimits(manipulator, phi), u)) < 1e-7);
      }
    }
    for (int k = 0; k < 100; ++k) {
      const double phi = uniform(random, -pi, pi);
      const double largest = largest_limit(ConstantOrientationLimits(manipulator, phi), u);
      const bool inside = std::any_of(intervals.begin(), intervals.end(), [phi](const Interval& interval) {
        return (interval.lower <= phi && phi <= interval.upper) || phi + 2.0 * pi <= interval.upper;
      });
      if (std::abs(largest) > 1e-9) BOOST_TEST(inside == (largest < 0.0));
    }
  }
  BOOST_TEST(several > 20);  // the case is among those tried
}

// M1 at P = (1, 1.5): A = (1 - cos phi, 1.5 - sin phi) is at the distances l_1, l_2 from (-1, 0) and (1, 0), and so on;
// at phi = 0 legs 1 and 2 measure sqrt(1 + 2.25), leg 3 measures 1.5.
BOOST_AUTO_TEST_CASE(leg_of_m1_in_closed_form) {
  // A single leg of M1: |u + R p - c|^2 = 1 + |u - c|^2 - 2 (u - c) . (cos phi, sin phi) <= 4.
  const Manipulator leg_1("leg 1", {m1().leg(0)});
  const Eigen::Vector2d u(1.0, 1.5);
  const Eigen::Vector2d w = u - Eigen::Vector2d(-1.0, 0.0);
  const double middle = std::atan2(w.y(), w.x());
  const auto reach = [&](double length) {
    return std::acos((1.0 + w.squaredNorm() - length * length) / (2.0 * w.norm()));
  };
  // |w| = 2.5, so the shortest length attained is 1.5, above sqrt 2: only the longest one limits.
  const std::vector<Interval> intervals = orientation_workspace(leg_1, u);
  BOOST_REQUIRE(intervals.size() == 1U);
  BOOST_TEST(intervals[0].lower == middle - reach(2.0), tolerance(1e-13));
  BOOST_TEST(intervals[0].upper == middle + reach(2.0), tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(all_orientations_or_none) {
  const Manipulator reaching("reaching", {Leg{{0.0, 0.0}, {0.3, 0.0}, {0.0, 2.0}, {}, {}}});
  const std::vector<Interval> all = orientation_workspace(reaching, {1.0, 0.0});
  BOOST_REQUIRE(all.size() == 1U);
  BOOST_TEST(all[0].upper - all[0].lower == 2.0 * pi, tolerance(1e-15));
  BOOST_TEST(orientation_workspace(reaching, {5.0, 0.0}).empty());
}

// A leg passes a forbidden wedge of 1.8e-10 rad, which is a gap, however narrow; in the other manipulator a limit is
// touched from inside at a quarter turn, which is none.
BOOST_AUTO_TEST_CASE(a_gap_is_told_from_a_touch) {
  const Manipulator two("two", {Leg{{-0.34460533926404757, 0.22055264244822625},
                                    {0.42354860157625718, 0.0},
                                    {0.015526753668409209, 1.5250833677178166},
                                    Interval{-4.7123889803846897, 1.5707963266153104},
                                    {}},
                                Leg{{0.17376176427600232, 0.0},
                                    {0.43858574648440285, 0.46489096952536324},
                                    {0.52179389494202033, 1.5607952387271817},
                                    {},
                                    {}}});
  const std::vector<Interval> first = orientation_workspace(two, {-0.62401465672735801, 1.5365893487992799});
  BOOST_REQUIRE(first.size() == 2U);
  BOOST_TEST(first[0].lower == -3.0235355517361, tolerance(1e-12));
  BOOST_TEST(first[1].upper == -0.78931065294938, tolerance(1e-12));
  BOOST_TEST(first[0].upper == -0.850394713330501, tolerance(1e-12));
  BOOST_TEST(first[1].lower == -0.850394712767606, tolerance(1e-12));
  const double between = 0.5 * (first[0].upper + first[1].lower);
  const Leg& leg = two.leg(0);
  const double direction = base_angle(leg, {{-0.62401465672735801, 1.5365893487992799}, between});
  BOOST_TEST(direction > leg.base_angle->upper);
  BOOST_TEST(direction < leg.base_angle->lower + 2.0 * pi);

  const Manipulator five(
      "five", {Leg{{0.5, 1.5}, {-0.5, 0.0}, {1.0, 3.0}, Interval{-2.3561944901923448, -0.78539816339744828}, {}},
               Leg{{-1.0, 0.0}, {0.0, 0.0}, {0.5, 2.0}, {}, {}},
               Leg{{1.5, 0.5}, {0.0, 0.0}, {0.5, 3.0}, Interval{-3.1415926535897931, 2.3561944901923448}, {}},
               Leg{{-1.0, 0.5}, {0.0, 0.5}, {0.0, 1.0}, Interval{-1.5707963267948966, 0.78539816339744828}, {}},
               Leg{{1.0, 0.5},
                   {0.0, -0.5},
                   {1.0, 3.0},
                   Interval{-3.1415926535897931, 1.5707963267948966},
                   Interval{-3.1415926535897931, 2.3561944901923448}}});
  const std::vector<Interval> second = orientation_workspace(five, {-0.5, 0.0});
  BOOST_REQUIRE(second.size() == 2U);
  BOOST_TEST(std::abs(second[0].lower) <= 1e-14);
  BOOST_TEST(second[0].upper == 0.643501108793284, tolerance(1e-12));
  BOOST_TEST(second[1].lower == 1.33266212369222, tolerance(1e-12));
  BOOST_TEST(second[1].upper == 2.71756161409905, tolerance(1e-12));
}

// A leg whose greatest length over a full turn is its maximum, or whose least length is its minimum, is free; one whose
// least length is its maximum, or whose greatest is its minimum, attains a single orientation. A gap or an interval
// that is more than rounding is not closed or left out.
BOOST_AUTO_TEST_CASE(limits_that_are_touched_from_inside_and_from_outside) {
  std::mt19937 random(7);
  for (int trial = 0; trial < test::scaled(10'000); ++trial) {
    const Eigen::Vector2d base = uniform_point(random);
    const Eigen::Vector2d arm = uniform(random, 0.1, 0.7) * unit(uniform(random, -pi, pi));
    const Eigen::Vector2d u = base + uniform(random, 1.0, 2.0) * unit(uniform(random, -pi, pi));
    const double longest = (u - base).norm() + arm.norm();
    const double shortest = (u - base).norm() - arm.norm();
    const auto intervals = [&](double lower, double upper) {
      return orientation_workspace({"touching", {Leg{base, arm, {lower, upper}, {}, {}}}}, u);
    };
    for (const auto& [lower, upper] : {Interval{0.0, longest}, Interval{shortest, 9.0}, Interval{shortest, longest}}) {
      const std::vector<Interval> all = intervals(lower, upper);
      BOOST_REQUIRE(all.size() == 1U);
      BOOST_TEST(all[0].upper - all[0].lower >= 2.0 * pi - 1e-6);
    }
    BOOST_TEST(intervals(0.0, shortest).empty());
    BOOST_TEST(intervals(longest, 9.0).empty());
    const double more = std::pow(10.0, uniform(random, -11.0, -3.0));
    const std::vector<Interval> open = intervals(0.0, longest - more);
    BOOST_REQUIRE(open.size() == 1U);
    BOOST_TEST(open[0].upper - open[0].lower < 2.0 * pi - 1e-6);
    BOOST_TEST(intervals(0.0, shortest + more).size() == 1U);
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(orientation_workspace(m1(), {nan, 0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
