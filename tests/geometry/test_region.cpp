// Regions made by hand: what follows from their edges alone.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/geometry/region.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

BoundaryEdge arc(const Eigen::Vector2d& centre, double radius, double start_angle, double sweep) {
  BoundaryEdge edge;
  edge.centre = centre;
  edge.radius = radius;
  edge.start_angle = start_angle;
  edge.sweep = sweep;
  edge.start = centre + radius * unit(start_angle);
  edge.end = std::abs(sweep) == 2.0 * pi ? edge.start : Eigen::Vector2d(centre + radius * unit(start_angle + sweep));
  return edge;
}

BoundaryEdge segment(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  BoundaryEdge edge;
  edge.start = start;
  edge.end = end;
  return edge;
}

Region annulus(const Eigen::Vector2d& centre, double inner, double outer) {
  return Region({{{{arc(centre, outer, 0.3, 2.0 * pi)}}, {{{arc(centre, inner, 2.0, -2.0 * pi)}}}}});
}

/// The half disc y >= 0 of radius 2 about the origin.
Region half_disc() {
  return Region({{{{segment({-2.0, 0.0}, {2.0, 0.0}), arc(Eigen::Vector2d::Zero(), 2.0, 0.0, pi)}}, {}}});
}

/// Three quarters of the unit disc: all but the fourth quadrant.
Region three_quarters() {
  return Region({{{{arc(Eigen::Vector2d::Zero(), 1.0, 0.0, 1.5 * pi), segment({0.0, -1.0}, {0.0, 0.0}),
                    segment({0.0, 0.0}, {1.0, 0.0})}},
                  {}}});
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_empty_region) {
  const Region region;
  BOOST_TEST(region.empty());
  BOOST_TEST(region.area() == 0.0);
  BOOST_TEST(region.perimeter() == 0.0);
  BOOST_TEST(!region.contains(Eigen::Vector2d::Zero()));
  BOOST_TEST(region.distance_to_boundary(Eigen::Vector2d::Zero()) == std::numeric_limits<double>::infinity());
  BOOST_TEST(!region.first_exit(Eigen::Vector2d::Zero(), 0.0).has_value());
}

BOOST_AUTO_TEST_CASE(area_and_perimeter_in_closed_form, *boost::unit_test::tolerance(1e-14)) {
  const Region ring = annulus({3.0, -4.0}, 1.0, 2.0);
  BOOST_TEST(ring.area() == 3.0 * pi);
  BOOST_TEST(ring.perimeter() == 6.0 * pi);
  BOOST_TEST(half_disc().area() == 2.0 * pi);
  BOOST_TEST(half_disc().perimeter() == 4.0 + 2.0 * pi);
  BOOST_TEST(three_quarters().area() == 0.75 * pi);
  BOOST_TEST(three_quarters().perimeter() == 2.0 + 1.5 * pi);
}

BOOST_AUTO_TEST_CASE(area_keeps_its_digits_far_from_the_origin) {
  BOOST_TEST(annulus({1e6, -2e6}, 1.0, 2.0).area() == 3.0 * pi, tt::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(contains_tells_inside_from_hole_and_outside) {
  const Region ring = annulus({3.0, -4.0}, 1.0, 2.0);
  BOOST_TEST(ring.contains({4.5, -4.0}));
  BOOST_TEST(!ring.contains({3.0, -4.0}));
  BOOST_TEST(!ring.contains({5.5, -4.0}));
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector2d u = uniform_point(random, 2.5);
    BOOST_TEST(half_disc().contains(u) == (u.norm() < 2.0 && u.y() > 0.0));
    BOOST_TEST(three_quarters().contains(u) == (u.norm() < 1.0 && !(u.x() > 0.0 && u.y() < 0.0)));
  }
}

// On the chord of an arc the arc is seen under exactly pi.
BOOST_AUTO_TEST_CASE(contains_holds_on_the_chords_of_arcs) {
  const Region disc({{{{arc(Eigen::Vector2d::Zero(), 1.0, 0.0, pi), arc(Eigen::Vector2d::Zero(), 1.0, pi, pi)}}, {}}});
  for (const double x : {-0.9, -0.3, 0.0, 0.2, 0.7}) BOOST_TEST(disc.contains({x, 0.0}));
  // With vertices that have no rounding at all.
  BoundaryEdge upper = arc(Eigen::Vector2d::Zero(), 1.0, 0.0, pi);
  upper.end = {-1.0, 0.0};
  BoundaryEdge lower = arc(Eigen::Vector2d::Zero(), 1.0, pi, pi);
  lower.start = {-1.0, 0.0};
  lower.end = {1.0, 0.0};
  const Region exact({{{{upper, lower}}, {}}});
  for (const double x : {-0.9, -0.3, 0.0, 0.2, 0.7}) BOOST_TEST(exact.contains({x, 0.0}));
  for (const double x : {-1.5, 1.5}) BOOST_TEST(!exact.contains({x, 0.0}));
}

BOOST_AUTO_TEST_CASE(distance_to_boundary_in_closed_form, *boost::unit_test::tolerance(1e-14)) {
  const Region ring = annulus({3.0, -4.0}, 1.0, 2.0);
  BOOST_TEST(ring.distance_to_boundary({3.0, -4.0}) == 1.0);
  BOOST_TEST(ring.distance_to_boundary({3.0, -2.25}) == 0.25);
  BOOST_TEST(ring.distance_to_boundary({8.0, -4.0}) == 3.0);
  BOOST_TEST(half_disc().distance_to_boundary({0.5, -1.0}) == 1.0);
  BOOST_TEST(half_disc().distance_to_boundary({3.0, -1.0}) == std::sqrt(2.0));
  BOOST_TEST(three_quarters().distance_to_boundary({0.5, -0.3}) == 0.3);
  BOOST_TEST(three_quarters().distance_to_boundary({-0.6, 0.0}) == 0.4);
  // The arc's own centre, a vertex.
  BOOST_TEST(three_quarters().distance_to_boundary({0.0, 0.0}) == 0.0);
}

BOOST_AUTO_TEST_CASE(first_exit_in_closed_form, *boost::unit_test::tolerance(1e-14)) {
  const Region ring = annulus(Eigen::Vector2d::Zero(), 1.0, 2.0);
  BOOST_TEST(*ring.first_exit({1.5, 0.0}, 0.0) == 0.5);
  BOOST_TEST(*ring.first_exit({1.5, 0.0}, pi) == 0.5);
  BOOST_TEST(*ring.first_exit({1.5, 0.0}, 0.5 * pi) == std::sqrt(1.75));
  BOOST_TEST(*ring.first_exit({3.0, 0.0}, pi) == 1.0);
  BOOST_TEST(!ring.first_exit({3.0, 0.0}, 0.0).has_value());
  BOOST_TEST(*half_disc().first_exit({0.5, 1.0}, -0.5 * pi) == 1.0);
  BOOST_TEST(*half_disc().first_exit({0.0, 1.0}, 0.5 * pi) == 1.0);
}

// A ray through a vertex must not slip through between its two edges.
BOOST_AUTO_TEST_CASE(rays_through_vertices_exit) {
  const Region region = half_disc();
  std::mt19937 random(2);
  for (int k = 0; k < 1000; ++k) {
    const double r = uniform(random, 0.1, 1.8);
    const Eigen::Vector2d from = r * unit(uniform(random, 0.1, 3.0));
    for (const Eigen::Vector2d& vertex : {Eigen::Vector2d(2.0, 0.0), Eigen::Vector2d(-2.0, 0.0)}) {
      const Eigen::Vector2d ray = vertex - from;
      const auto exit = region.first_exit(from, std::atan2(ray.y(), ray.x()));
      BOOST_TEST_REQUIRE(exit.has_value());
      BOOST_TEST(*exit == ray.norm(), tt::tolerance(1e-11));
    }
  }
}

BOOST_AUTO_TEST_CASE(samples_are_on_the_boundary_in_order_and_no_farther_apart_than_the_spacing) {
  for (const double spacing : {5.0, 0.7, 0.01}) {
    const Region region = three_quarters();
    const BoundaryLoop& loop = region.components()[0].outer;
    const std::vector<Eigen::Vector2d> points = loop.sample(spacing);
    for (std::size_t k = 0; k < points.size(); ++k) {
      BOOST_TEST(region.distance_to_boundary(points[k]) <= 1e-15);
      BOOST_TEST((points[(k + 1) % points.size()] - points[k]).norm() <= spacing * (1.0 + 1e-12));
    }
    for (const BoundaryEdge& edge : loop.edges) BOOST_TEST(std::count(points.begin(), points.end(), edge.start) == 1);
    if (spacing < 0.1) {
      BOOST_TEST(signed_area(points) == loop.signed_area(), tt::tolerance(spacing * spacing));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_spacing_that_is_not_positive_is_refused) {
  const Region region = half_disc();
  for (const double spacing :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    BOOST_CHECK_THROW(region.components()[0].outer.sample(spacing), std::invalid_argument);
  }
}
