#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/polygon.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

using Points = std::vector<Eigen::Vector2d>;

const Points square = {{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}};
/// A spiral arm: from the origin the direction 0 meets the edges x = 1, x = 2 and x = 3.
const Points hook = {{-1.0, -1.0}, {3.0, -1.0}, {3.0, 1.0}, {2.0, 1.0},
                     {2.0, -0.5},  {1.0, -0.5}, {1.0, 1.0}, {-1.0, 1.0}};

/// The definition: the nearest of all crossings.
double nearest_crossing(const Points& vertices, const Eigen::Vector2d& centre, double beta) {
  double nearest = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d e = unit(beta);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector2d a = vertices[i] - centre;
    const Eigen::Vector2d along = vertices[(i + 1) % vertices.size()] - vertices[i];
    const double t = -cross(e, a) / cross(e, along);
    const double r = e.dot(a + t * along);
    if (t >= 0.0 && t <= 1.0 && r > 0.0) nearest = std::min(nearest, r);
  }
  return nearest;
}

/// A polygon around the origin; star-shaped, or with the angles of its vertices shuffled a little so that it is not.
Points random_polygon(std::mt19937& random, std::size_t n, bool star_shaped) {
  Points vertices;
  for (std::size_t i = 0; i < n; ++i) {
    const double jitter = star_shaped ? uniform(random, -0.4, 0.4) : uniform(random, -1.5, 1.5);
    const double angle = 2.0 * pi * (static_cast<double>(i) + jitter) / static_cast<double>(n);
    vertices.push_back(uniform(random, 0.5, 1.5) * unit(angle));
  }
  return vertices;
}

}  // namespace

BOOST_AUTO_TEST_CASE(areas_have_the_sign_of_the_order) {
  BOOST_TEST(signed_area(square) == 4.0);
  Points reversed = square;
  std::reverse(reversed.begin(), reversed.end());
  BOOST_TEST(signed_area(reversed) == -4.0);
  BOOST_TEST(signed_area(hook) == 4.0 + 0.5 + 2.0);
  BOOST_TEST(signed_area(Points{}) == 0.0);
  BOOST_TEST(signed_area(Points{{0.0, 0.0}, {1.0, 1.0}}) == 0.0);
}

BOOST_AUTO_TEST_CASE(the_area_of_a_regular_polygon_far_from_the_origin) {
  for (const int n : {3, 10, 1000}) {
    Points vertices;
    for (int i = 0; i < n; ++i) vertices.push_back(Eigen::Vector2d(1e4, -1e4) + 2.0 * unit(2.0 * pi * i / n));
    BOOST_TEST(signed_area(vertices) == 2.0 * n * std::sin(2.0 * pi / n), tt::tolerance(1e-11));
  }
}

BOOST_AUTO_TEST_CASE(points_inside_and_outside) {
  for (const Eigen::Vector2d& inside : Points{{0.0, 0.0}, {2.5, 0.5}, {1.5, -0.75}, {0.5, 0.9}}) {
    BOOST_TEST(contains(hook, inside));
  }
  for (const Eigen::Vector2d& outside : Points{{1.5, 0.0}, {4.0, 0.0}, {-1.1, 0.0}, {1.5, -1.1}, {0.0, 7.0}}) {
    BOOST_TEST(!contains(hook, outside));
  }
}

BOOST_AUTO_TEST_CASE(the_polar_form_of_a_square) {
  const PolarBoundary polar(square, {0.0, 0.0});
  BOOST_TEST(polar.centre_inside());
  for (int k = -50; k <= 50; ++k) {
    const double beta = 0.17 * k;
    const double expected = 1.0 / std::max(std::abs(std::cos(beta)), std::abs(std::sin(beta)));
    BOOST_TEST(polar.radius(beta) == expected, tt::tolerance(1e-14));
  }
  const std::vector<double> expected = {-0.75 * pi, -0.25 * pi, 0.25 * pi, 0.75 * pi};
  BOOST_TEST(polar.angles() == expected, tt::per_element());
  for (const double beta : expected) BOOST_TEST(polar.radius(beta) == std::numbers::sqrt2, tt::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(the_first_of_several_crossings_counts) {
  BOOST_TEST(PolarBoundary(hook, {0.0, 0.0}).radius(0.0) == 1.0);
  BOOST_TEST(PolarBoundary(hook, {2.5, 0.0}).radius(0.0) == 0.5);
  BOOST_TEST(PolarBoundary(hook, {2.5, 0.0}).radius(pi) == 0.5);
  // Below the gap the whole width is seen.
  BOOST_TEST(PolarBoundary(hook, {0.0, -0.75}).radius(0.0) == 3.0);
}

BOOST_AUTO_TEST_CASE(the_polar_form_agrees_with_its_definition) {
  std::mt19937 random(1);
  for (int sample = 0; sample < 60; ++sample) {
    Points vertices = random_polygon(random, 16 + static_cast<std::size_t>(sample), sample % 2 == 0);
    const Eigen::Vector2d centre = 0.1 * uniform_point(random);
    const PolarBoundary polar(vertices, centre);
    std::reverse(vertices.begin(), vertices.end());
    const PolarBoundary reversed(vertices, centre);
    BOOST_TEST(polar.centre_inside());
    BOOST_TEST(std::is_sorted(polar.angles().begin(), polar.angles().end()));
    BOOST_TEST(polar.angles().size() == vertices.size());
    for (int k = 0; k < 200; ++k) {
      const double beta = uniform(random, -10.0, 10.0);
      BOOST_TEST(polar.radius(beta) == nearest_crossing(vertices, centre, beta), tt::tolerance(1e-10));
      BOOST_TEST(reversed.radius(beta) == polar.radius(beta), tt::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_star_shaped_boundary_passes_through_its_vertices) {
  std::mt19937 random(2);
  const Points vertices = random_polygon(random, 40, true);
  const PolarBoundary polar(vertices, {0.0, 0.0});
  for (const Eigen::Vector2d& vertex : vertices) {
    BOOST_TEST(polar.radius(std::atan2(vertex.y(), vertex.x())) == vertex.norm(), tt::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(a_centre_outside_sees_radius_zero) {
  const PolarBoundary polar(hook, {1.5, 0.0});
  BOOST_TEST(!polar.centre_inside());
  for (const double beta : {0.0, 1.0, 3.0, -2.0}) BOOST_TEST(polar.radius(beta) == 0.0);
}

BOOST_AUTO_TEST_CASE(distances_to_a_segment_are_those_to_its_ends_or_across) {
  const Eigen::Vector2d from(1.0, 1.0);
  const Eigen::Vector2d to(4.0, 5.0);
  BOOST_TEST(distance_to_segment({1.0, 1.0}, from, to) == 0.0);
  BOOST_TEST(distance_to_segment({-2.0, -3.0}, from, to) == 5.0);
  BOOST_TEST(distance_to_segment({4.0, 7.0}, from, to) == 2.0);
  // From the middle by 5 across.
  BOOST_TEST(distance_to_segment({2.5 - 4.0, 3.0 + 3.0}, from, to) == 5.0, tt::tolerance(1e-15));
  BOOST_TEST(distance_to_segment({1.0, 3.0}, from, from) == 2.0);
}

BOOST_AUTO_TEST_CASE(bad_input_is_reported) {
  BOOST_CHECK_THROW(PolarBoundary(Points{{0.0, 0.0}, {1.0, 0.0}}, {0.0, 0.0}), std::invalid_argument);
  Points broken = square;
  broken[1].x() = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(PolarBoundary(broken, {0.0, 0.0}), std::invalid_argument);
}
