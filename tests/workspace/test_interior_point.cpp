#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/workspace/interior_point.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;

BOOST_AUTO_TEST_CASE(the_clearance_found_is_at_least_the_asked_part_of_the_best) {
  // An annulus: the best clearance is half its width.
  const ConstantOrientationLimits annulus({"annulus", {leg_at({0.4, -0.3}, {0.6, 1.0})}}, 0.0);
  for (const double quality : {0.5, 0.9, 0.99}) {
    const InteriorPoint point = find_interior_point(annulus, {.quality = quality});
    BOOST_TEST((point.status == InteriorStatus::found));
    BOOST_TEST(point.clearance >= quality * 0.2);
    BOOST_TEST(point.clearance <= 0.2);
    BOOST_TEST(point.clearance_bound >= 0.2 - 1e-15);
    BOOST_TEST(point.clearance == -largest_limit(annulus, point.position));
  }
}

BOOST_AUTO_TEST_CASE(the_bound_is_a_bound) {
  std::mt19937 random(1);
  for (int sample = 0; sample < 100; ++sample) {
    const ConstantOrientationLimits limits(random_manipulator(random), uniform(random, -1.0, 1.0));
    const InteriorPoint point = find_interior_point(limits);
    BOOST_TEST((point.status != InteriorStatus::undecided));
    for (int k = 0; k < 500; ++k) {
      const Eigen::Vector2d u = uniform_point(random, 2.5);
      if (limits.box().contains(u)) BOOST_TEST(-largest_limit(limits, u) <= point.clearance_bound);
    }
    if (point.status == InteriorStatus::found) {
      BOOST_TEST(point.clearance > 0.0);
      BOOST_TEST(largest_limit(limits, point.position) == -point.clearance);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_empty_workspace_is_proved_to_be_empty) {
  // Two unit discs whose boxes overlap, but they do not.
  const ConstantOrientationLimits discs({"discs", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({1.5, 1.5}, {0.0, 1.0})}},
                                        0.0);
  const InteriorPoint none = find_interior_point(discs);
  BOOST_TEST((none.status == InteriorStatus::empty));
  BOOST_TEST(none.clearance_bound <= 1e-4 * discs.box().diagonal().norm());

  // Boxes that do not overlap need no search.
  const ConstantOrientationLimits apart({"apart", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({3.0, 0.0}, {0.0, 1.0})}},
                                        0.0);
  BOOST_TEST((find_interior_point(apart).status == InteriorStatus::empty));
  BOOST_TEST(find_interior_point(apart).evaluations == 0u);

  // A circle line has no interior.
  const ConstantOrientationLimits line({"line", {leg_at({0.1, 0.2}, {1.0, 1.0})}}, 0.0);
  BOOST_TEST((find_interior_point(line, {.resolution = 1e-3}).status == InteriorStatus::empty));
}

BOOST_AUTO_TEST_CASE(the_limit_on_evaluations_is_kept) {
  const ConstantOrientationLimits line({"line", {leg_at({0.1, 0.2}, {1.0, 1.0})}}, 0.0);
  const InteriorPoint point = find_interior_point(line, {.resolution = 1e-6, .max_evaluations = 100});
  BOOST_TEST((point.status == InteriorStatus::undecided));
  BOOST_TEST(point.evaluations <= 100u);
}

BOOST_AUTO_TEST_CASE(bad_options_are_reported) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double quality : {0.0, 1.0, nan}) {
    BOOST_CHECK_THROW(find_interior_point(limits, {.quality = quality}), std::invalid_argument);
  }
  for (const double resolution : {0.0, -1.0, nan}) {
    BOOST_CHECK_THROW(find_interior_point(limits, {.resolution = resolution}), std::invalid_argument);
  }
  BOOST_CHECK_THROW(find_interior_point(limits, {.max_evaluations = 0}), std::invalid_argument);
}
