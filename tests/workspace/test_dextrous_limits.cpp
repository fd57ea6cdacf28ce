#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/region_vertices.hpp"
#include "reprise/workspace/trace.hpp"
#include "workspace/samples.hpp"

namespace {

using namespace reprise;
using namespace reprise::test;
using boost::test_tools::tolerance;

Interval random_range(std::mt19937& random) {
  const double lower = uniform(random, -3.0, 3.0);
  return {lower, lower + uniform(random, 0.0, 1.0) * uniform(random, 0.1, 6.0)};
}

BOOST_AUTO_TEST_SUITE(dextrous_limits)

// The definition: the largest residual over the range, here over many orientations of it. Along phi a residual moves at
// most by |p| or by the distance from the base joint.
BOOST_AUTO_TEST_CASE(each_limit_is_the_largest_over_the_range) {
  std::mt19937 random(1);
  constexpr int steps = 400;
  for (int trial = 0; trial < 300; ++trial) {
    const Manipulator manipulator = random_manipulator(random);
    Interval range = random_range(random);
    if (trial % 4 == 0) range.upper = range.lower + pi;  // half a turn, as it is given most often
    const DextrousLimits limits(manipulator, range);
    const Eigen::Vector2d u = uniform_point(random, 2.0);
    Eigen::VectorXd h(limits.count());
    limits.evaluate(u, h);
    Eigen::VectorXd largest = Eigen::VectorXd::Constant(limits.count(), -std::numeric_limits<double>::infinity());
    Eigen::VectorXd at_one(limits.count());
    const double step = (range.upper - range.lower) / steps;
    for (int k = 0; k <= steps; ++k) {
      ConstantOrientationLimits(manipulator, range.lower + k * step).evaluate(u, at_one);
      largest = largest.cwiseMax(at_one);
    }
    for (Eigen::Index j = 0; j < limits.count(); ++j) {
      BOOST_TEST(h[j] >= largest[j] - 1e-12, limits.label(j));
      BOOST_TEST(h[j] <= largest[j] + 4.0 * step, limits.label(j));
      // The orientation it names is in the range and attains the value.
      const double phi = limits.critical_orientation(u, j);
      BOOST_TEST((phi >= range.lower && phi <= range.upper));
      ConstantOrientationLimits(manipulator, phi).evaluate(u, at_one);
      BOOST_TEST(std::abs(at_one[j] - h[j]) < 1e-9, limits.label(j));
    }
  }
}

// From its base joint a leg is as long as its platform joint is far from P, whatever the orientation.
BOOST_AUTO_TEST_CASE(of_several_critical_orientations_the_lowest_is_named) {
  std::mt19937 random(4);
  const Manipulator manipulator = m1();
  for (int trial = 0; trial < 100; ++trial) {
    const Interval range = random_range(random);
    const DextrousLimits limits(manipulator, range);
    for (Eigen::Index j = 0; j < limits.count(); ++j) {
      const Leg& leg = manipulator.leg(limits.limit(j).leg);
      BOOST_TEST(limits.critical_orientation(leg.base_joint, j) == range.lower);
    }
  }
}

BOOST_AUTO_TEST_CASE(gradients_are_those_of_the_values) {
  std::mt19937 random(2);
  constexpr double step = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    const DextrousLimits limits(random_manipulator(random), random_range(random));
    const Eigen::Vector2d u = uniform_point(random, 2.0);
    const Eigen::MatrixX2d differences = differenced_gradients(limits, u, step);
    for (Eigen::Index j = 0; j < limits.count(); ++j) {
      const Eigen::Vector2d gradient = limits.gradient(u, j);
      BOOST_TEST((differences.row(j).transpose() - gradient).norm() < 1e-5, limits.label(j));
      BOOST_TEST(gradient.norm() <= 1.0 + 1e-12, limits.label(j));  // 1-Lipschitz
    }
  }
}

BOOST_AUTO_TEST_CASE(a_range_of_one_orientation_is_that_orientation) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Manipulator manipulator = random_manipulator(random);
    const double phi = uniform(random, -3.0, 3.0);
    const DextrousLimits dextrous(manipulator, {phi, phi});
    const ConstantOrientationLimits constant(manipulator, phi);
    Eigen::VectorXd h(dextrous.count());
    Eigen::VectorXd expected(constant.count());
    const Eigen::Vector2d u = uniform_point(random, 2.0);
    dextrous.evaluate(u, h);
    constant.evaluate(u, expected);
    BOOST_TEST((h - expected).cwiseAbs().maxCoeff() < 1e-13);
  }
}

// One leg with the arm p along x: q runs on an arc about the base joint c from phi = -width to width. Positions within
// l of all of it lie in the lens of the circles about its ends, whose corner beyond the arc's open side stays; a
// nearest distance of l leaves the corner of those circles beyond the arc.
BOOST_AUTO_TEST_CASE(corners_of_one_limit_are_where_both_ends_of_the_range_meet) {
  const double width = 0.4;
  const double p = 0.5;
  const Eigen::Vector2d c(0.2, -0.1);
  for (const Interval& length : {Interval{0.0, 1.0}, Interval{0.0, 0.3}, Interval{1.0, 2.0}}) {
    for (const double turned : {0.0, 2.0}) {
      const DextrousLimits limits({"one leg", {Leg{c, {p, 0.0}, length, {}, {}}}}, {turned - width, turned + width});
      const Eigen::Vector2d axis = unit(turned);
      std::vector<Eigen::Vector2d> corners;
      for (const double side : {-1.0, 1.0}) {
        const double l = length.lower > 0.0 ? length.lower : length.upper;
        const double t = -p * std::cos(width) + side * std::sqrt(l * l - p * p * std::sin(width) * std::sin(width));
        if ((t < 0.0) == (length.lower == 0.0)) corners.push_back(c + t * axis);
      }
      BOOST_TEST(corners.size() == (length.upper == 0.3 ? 2u : 1u));
      Eigen::VectorXd h(limits.count());
      for (const Eigen::Vector2d& corner : corners) {
        const auto found = limits.corner(0, corner + Eigen::Vector2d(0.01, 0.02));
        BOOST_TEST_REQUIRE(found.has_value());
        BOOST_TEST((*found - corner).norm() < 1e-14);
        limits.evaluate(corner, h);
        BOOST_TEST(std::abs(h[0]) < 1e-14);
      }
    }
  }
  BOOST_TEST(!DextrousLimits(m1(), {0.1, 0.1}).corner(0, {0.0, 0.0}).has_value());
}

// The boundary traced about one leg has the corners that its exact region has.
BOOST_AUTO_TEST_CASE(corners_of_one_limit_are_boundary_points) {
  for (const double p : {0.5, 1.4}) {
    Leg leg{{0.2, -0.1}, {p, 0.0}, {0.0, 1.0}, {}, {}};
    for (const bool at_platform : {false, true}) {
      if (at_platform) leg.platform_angle = Interval{-1.2, 0.9};
      const Manipulator manipulator("one leg", {leg});
      const Interval range{-0.3, 0.4};
      const DextrousLimits limits(manipulator, range);
      const Region region = dextrous_workspace(manipulator, range);
      BOOST_TEST_REQUIRE(!region.empty());
      const TracedBoundary traced = trace_boundary(limits, {.chord = 0.03});
      BOOST_TEST_REQUIRE(traced.closed(), traced.message);
      for (const RegionVertex& vertex : vertices(region, limits)) {
        // Arcs that go over into each other smoothly make vertices, but no corners.
        const auto own = limits.corner(vertex.limits[0], vertex.position);
        if (vertex.limits.size() == 1 && !(own && (*own - vertex.position).norm() < 1e-9)) continue;
        const double nearest = std::transform_reduce(
            traced.points.begin(), traced.points.end(), 1.0, [](double a, double b) { return std::min(a, b); },
            [&](const BoundaryPoint& point) { return (point.position - vertex.position).norm(); });
        BOOST_TEST(nearest < 1e-9);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(bad_ranges_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Interval& range : {Interval{0.1, -0.1}, Interval{0.0, 2.0 * pi}, Interval{nan, 0.0}, Interval{0.0, nan}}) {
    BOOST_CHECK_THROW(DextrousLimits(m1(), range), std::invalid_argument);
  }
}

// One leg, P at a distance p from its platform joint, every orientation of a half turn or more around: what is left is
// the annulus between l_min + p and l_max - p for the directions swept. With nearly a full turn that is nearly all.
BOOST_AUTO_TEST_CASE(one_leg_turning_almost_all_the_way_round) {
  const double p = 0.25;
  const Manipulator manipulator("one leg", {Leg{{0.3, -0.2}, {p, 0.0}, {0.5, 1.5}, {}, {}}});
  const double gap = 1e-5;
  const Region region = dextrous_workspace(manipulator, {0.0, 2.0 * pi - gap});
  BOOST_REQUIRE(region.components().size() == 1U);
  BOOST_TEST(region.components()[0].holes.size() == 1U);
  BOOST_TEST(region.area() == pi * (1.25 * 1.25 - 0.75 * 0.75), tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(exact_region_holds_what_the_limits_allow) {
  std::mt19937 random(4);
  int with_holes = 0;
  int in_parts = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Manipulator manipulator = random_manipulator(random);
    const Interval range = random_range(random);
    const DextrousLimits limits(manipulator, range);
    const Region region = dextrous_workspace(manipulator, range);
    if (limits.box().isEmpty()) {
      BOOST_TEST(region.empty());
      continue;
    }
    for (int k = 0; k < 300; ++k) {
      const Eigen::Vector2d part(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
      const Eigen::Vector2d u = limits.box().min() + part.cwiseProduct(limits.box().sizes());
      const double largest = largest_limit(limits, u);
      if (std::abs(largest) > 1e-9) BOOST_TEST(region.contains(u) == (largest < 0.0), "trial " << trial);
      // A residual is never farther from zero than the boundary is away.
      BOOST_TEST(region.distance_to_boundary(u) >= std::abs(std::min(largest, 0.0)) - 1e-12);
    }
    in_parts += region.components().size() > 1 ? 1 : 0;
    const auto has_holes = [](const RegionComponent& component) { return !component.holes.empty(); };
    with_holes += std::any_of(region.components().begin(), region.components().end(), has_holes) ? 1 : 0;
  }
  BOOST_TEST(with_holes > 10);
  BOOST_TEST(in_parts > 10);
}

// The chord method cuts the boundary by chords: its area approaches the exact one with the square of their length.
BOOST_AUTO_TEST_CASE(traced_dextrous_workspace_of_m1_approaches_the_exact_one) {
  const Interval range{-pi / 36.0, pi / 36.0};
  const DextrousLimits limits(m1(), range);
  const Region region = dextrous_workspace(m1(), range);
  BOOST_REQUIRE(region.components().size() == 2U);  // mirror images
  const double exact = region.area() / 2.0;
  BOOST_TEST(region.components()[0].outer.signed_area() == exact, tolerance(1e-12));
  const auto error = [&](double chord) {
    const TracedBoundary traced = trace_boundary(limits, Eigen::Vector2d(1.0, 1.5), {.chord = chord});
    BOOST_TEST(traced.closed());
    BOOST_TEST(traced.evaluations <= 12 * traced.points.size());
    return std::abs(signed_area(traced.positions()) - exact);
  };
  BOOST_TEST(error(0.04) < 0.02 * 0.04 * 0.04);
  BOOST_TEST(error(0.01) < 0.02 * 0.01 * 0.01);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
