// The Hausdorff distance between polygons and a region's boundary, held against closed forms and dense samples.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/hausdorff_distance.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/trace.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

using Polygon = std::vector<Eigen::Vector2d>;

constexpr double resolution = 1e-12;

/// A disc or, with a shortest length, an annulus.
Region ring(const Eigen::Vector2d& centre, const Interval& length) {
  return constant_orientation_workspace({"ring", {leg_at(centre, length)}}, 0.0);
}

Polygon regular_polygon(const Eigen::Vector2d& centre, double radius, int count) {
  Polygon polygon;
  for (int k = 0; k < count; ++k) polygon.push_back(centre + radius * unit(2.0 * pi * k / count));
  return polygon;
}

/// What the header promises of a part found.
void check_part(double found, double exact) {
  BOOST_TEST(found <= exact + 1e-13);
  BOOST_TEST(exact <= 1.001 * found + resolution);
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_inscribed_polygon_is_off_by_the_sagitta) {
  const Eigen::Vector2d centre(0.3, -0.7);
  const double radius = 1.5;
  for (const int count : {3, 7, 100, 3000}) {
    const std::vector<Polygon> polygons{regular_polygon(centre, radius, count)};
    const HausdorffDistance distance = hausdorff_distance(polygons, ring(centre, {0.0, radius}), resolution);
    const double sagitta = 2.0 * radius * std::pow(std::sin(0.5 * pi / count), 2.0);
    check_part(distance.polygons_to_region, sagitta);
    check_part(distance.region_to_polygons, sagitta);
  }
}

BOOST_AUTO_TEST_CASE(the_two_parts_differ) {
  // A disc of radius 1 in a square of side 3: the corners are far from the circle; of the circle, what is seen in the
  // direction of the corners is far from the square.
  const Polygon square{{1.5, 1.5}, {-1.5, 1.5}, {-1.5, -1.5}, {1.5, -1.5}};
  const HausdorffDistance around =
      hausdorff_distance(std::vector<Polygon>{square}, ring({0.0, 0.0}, {0.0, 1.0}), resolution);
  check_part(around.polygons_to_region, 1.5 * std::numbers::sqrt2 - 1.0);
  check_part(around.region_to_polygons, 1.5 - 0.5 * std::numbers::sqrt2);
  BOOST_TEST(around.value() == around.polygons_to_region);

  // Of an annulus only the outer circle.
  const std::vector<Polygon> outer{regular_polygon({0.0, 0.0}, 1.0, 1000)};
  const Region annulus = ring({0.0, 0.0}, {0.25, 1.0});
  const HausdorffDistance without_hole = hausdorff_distance(outer, annulus, resolution);
  BOOST_TEST(without_hole.polygons_to_region < 1e-5);
  // From the hole's circle to the nearest side.
  BOOST_TEST(std::abs(without_hole.region_to_polygons - 0.75) <= 1e-3);
  BOOST_TEST(without_hole.value() == without_hole.region_to_polygons);
}

BOOST_AUTO_TEST_CASE(a_corner_cut_off_is_seen_from_both_sides) {
  // The square [0, 1]^2, and the same without the triangle of legs 0.3 and 0.4 at (1, 1).
  Leg first = leg_at({0.0, 0.0}, {0.0, 10.0});
  first.base_angle = Interval{0.0, 0.5 * pi};
  Leg second = leg_at({1.0, 1.0}, {0.0, 10.0});
  second.base_angle = Interval{pi, 1.5 * pi};
  const Region region = constant_orientation_workspace({"square", {first, second}}, 0.0);
  const std::vector<Polygon> cut{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.6}, {0.7, 1.0}, {0.0, 1.0}}};
  const HausdorffDistance distance = hausdorff_distance(cut, region, resolution);
  // The triangle's height, and the point of its longest side that is as far from one leg as from the other.
  check_part(distance.region_to_polygons, 0.3 * 0.4 / 0.5);
  check_part(distance.polygons_to_region, 0.3 * 0.4 / 0.7);
}

BOOST_AUTO_TEST_CASE(dense_samples_agree) {
  std::mt19937 random(21);
  std::size_t compared = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const Manipulator manipulator = random_manipulator(random);
    const double orientation = uniform(random, -pi, pi);
    const Region region = constant_orientation_workspace(manipulator, orientation);
    if (region.empty()) continue;
    // Polygons on the boundary, coarse and displaced, some left out.
    std::vector<Polygon> polygons;
    for (const BoundaryLoop& loop : loops(region)) {
      if (!polygons.empty() && uniform(random, 0.0, 1.0) < 0.5) continue;
      polygons.push_back(loop.sample(0.3));
      for (Eigen::Vector2d& vertex : polygons.back()) vertex += uniform_point(random, 0.05);
    }
    const HausdorffDistance distance = hausdorff_distance(polygons, region, resolution);

    constexpr double spacing = 0.005;
    double polygons_to_region = 0.0;
    for (const Polygon& polygon : polygons) {
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Eigen::Vector2d along = polygon[(k + 1) % polygon.size()] - polygon[k];
        const double parts = std::ceil(along.norm() / spacing);
        for (double i = 0.0; i < parts; ++i) {
          polygons_to_region =
              std::max(polygons_to_region, region.distance_to_boundary(polygon[k] + i / parts * along));
        }
      }
    }
    double region_to_polygons = 0.0;
    for (const BoundaryLoop& loop : loops(region)) {
      for (const Eigen::Vector2d& point : loop.sample(spacing)) {
        double nearest = infinity;
        for (const Polygon& polygon : polygons) {
          for (std::size_t k = 0; k < polygon.size(); ++k) {
            nearest = std::min(nearest, distance_to_segment(point, polygon[k], polygon[(k + 1) % polygon.size()]));
          }
        }
        region_to_polygons = std::max(region_to_polygons, nearest);
      }
    }
    // Distances are 1-Lipschitz.
    const auto agree = [](double found, double sampled) {
      return sampled <= 1.001 * found + resolution && found <= sampled + 0.5 * spacing;
    };
    BOOST_TEST(agree(distance.polygons_to_region, polygons_to_region));
    BOOST_TEST(agree(distance.region_to_polygons, region_to_polygons));
    ++compared;
  }
  BOOST_TEST(compared >= 30u);
}

BOOST_AUTO_TEST_CASE(the_boundary_of_m1_is_off_by_its_sagittas) {
  // Arcs of radii 2 and sqrt 2, many chords long; around an acute corner a step may be longer than a chord.
  const ConstantOrientationLimits limits(m1(), 0.0);
  const Region region = constant_orientation_workspace(m1(), 0.0);
  const Region upper(
      {*std::find_if(region.components().begin(), region.components().end(), [](const RegionComponent& one) {
        return one.outer.encloses({1.0, 1.5});
      })});
  const auto sagitta = [](double step) { return std::numbers::sqrt2 - std::sqrt(2.0 - 0.25 * step * step); };
  for (const double d : {0.05, 0.01, 0.001}) {
    const Polygon polygon = trace_boundary(limits, {1.0, 1.5}, {.chord = d}).positions();
    double longest = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      longest = std::max(longest, (polygon[(k + 1) % polygon.size()] - polygon[k]).norm());
    }
    BOOST_TEST(longest <= 1.2 * d);
    const HausdorffDistance distance = hausdorff_distance(std::vector<Polygon>{polygon}, upper, resolution);
    for (const double part : {distance.polygons_to_region, distance.region_to_polygons}) {
      BOOST_TEST(1.001 * part + resolution >= sagitta(d));
      BOOST_TEST(part <= sagitta(longest) + resolution);
    }
  }
}

BOOST_AUTO_TEST_CASE(empty_sets_are_infinitely_far) {
  const Region disc = ring({0.0, 0.0}, {0.0, 1.0});
  const std::vector<Polygon> none;
  const std::vector<Polygon> triangle{regular_polygon({0.0, 0.0}, 1.0, 3)};
  BOOST_TEST(hausdorff_distance(none, disc, 0.1).region_to_polygons == infinity);
  BOOST_TEST(hausdorff_distance(none, disc, 0.1).polygons_to_region == 0.0);
  BOOST_TEST(hausdorff_distance(triangle, Region(), 0.1).polygons_to_region == infinity);
  BOOST_TEST(hausdorff_distance(triangle, Region(), 0.1).region_to_polygons == 0.0);
  BOOST_TEST(hausdorff_distance(none, Region(), 0.1).value() == 0.0);
  // A polygon of one vertex is a point.
  const std::vector<Polygon> point{{{3.0, 0.0}}, {}};
  check_part(hausdorff_distance(point, disc, resolution).polygons_to_region, 2.0);
  check_part(hausdorff_distance(point, disc, resolution).region_to_polygons, 4.0);
}

BOOST_AUTO_TEST_CASE(bad_input_is_reported) {
  const Region disc = ring({0.0, 0.0}, {0.0, 1.0});
  const std::vector<Polygon> triangle{regular_polygon({0.0, 0.0}, 1.0, 3)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double refused : {0.0, -1.0, nan, infinity}) {
    BOOST_CHECK_THROW(hausdorff_distance(triangle, disc, refused), std::invalid_argument);
  }
  const std::vector<Polygon> broken{{{0.0, 0.0}, {nan, 1.0}, {1.0, 0.0}}};
  BOOST_CHECK_THROW(hausdorff_distance(broken, disc, 0.1), std::invalid_argument);
}
