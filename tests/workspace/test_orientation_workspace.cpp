#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "reprise/workspace/orientation_workspace.hpp"
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
      BOOST_TEST((intervals[k].lower >= -kPi && intervals[k].lower < kPi));
      if (k > 0) BOOST_TEST(intervals[k - 1].upper < intervals[k].lower);
      // At the ends a limit is active.
      if (intervals[k].upper - intervals[k].lower >= 2.0 * kPi) continue;
      for (const double phi : {intervals[k].lower, intervals[k].upper}) {
        BOOST_TEST(std::abs(largest_limit(ConstantOrientationLimits(manipulator, phi), u)) < 1e-7);
      }
    }
    for (int k = 0; k < 100; ++k) {
      const double phi = uniform(random, -kPi, kPi);
      const double largest = largest_limit(ConstantOrientationLimits(manipulator, phi), u);
      const bool inside = std::any_of(intervals.begin(), intervals.end(), [phi](const Interval& interval) {
        return (interval.lower <= phi && phi <= interval.upper) || phi + 2.0 * kPi <= interval.upper;
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
  BOOST_TEST(all[0].upper - all[0].lower == 2.0 * kPi, tolerance(1e-15));
  BOOST_TEST(orientation_workspace(reaching, {5.0, 0.0}).empty());
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(orientation_workspace(m1(), {nan, 0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
