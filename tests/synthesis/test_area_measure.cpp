#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/synthesis/area_measure.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

std::vector<Eigen::Vector2d> polygonal_circle(const Eigen::Vector2d& centre, double radius, int vertices) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2.0 * pi * i / vertices;
    points.emplace_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// Area common to two circles of radii a and b whose centres are a distance e apart, |a - b| < e < a + b.
double lens_area(double a, double b, double e) {
  const double alpha = std::acos((e * e + a * a - b * b) / (2.0 * e * a));
  const double beta = std::acos((e * e + b * b - a * a) / (2.0 * e * b));
  return a * a * (alpha - 0.5 * std::sin(2.0 * alpha)) + b * b * (beta - 0.5 * std::sin(2.0 * beta));
}

BOOST_AUTO_TEST_SUITE(area_measure)

BOOST_AUTO_TEST_CASE(concentric_circles) {
  const Eigen::Vector2d centre(1.0, 1.5);
  const PolarBoundary computed(polygonal_circle(centre, 0.5, 4000), centre);
  for (const double radius : {0.3, 0.7}) {
    const PrescribedWorkspace prescribed("c", Circle{radius}, {centre});
    const AreaMeasure measure = measure_area(prescribed, &computed, prescribed.angles(3000));
    const double difference = pi * (radius * radius - 0.25);
    BOOST_TEST(measure.prescribed_outside == std::max(difference, 0.0), tolerance(1e-5));
    BOOST_TEST(measure.computed_outside == std::max(-difference, 0.0), tolerance(1e-5));
    BOOST_TEST(measure.clearance == 0.5 - radius, tolerance(1e-5));
  }
}

BOOST_AUTO_TEST_CASE(overlapping_circles_leave_crescents) {
  const double a = 0.4;
  const double b = 0.5;
  const double e = 0.3;
  const PolarBoundary computed(polygonal_circle({e, 0.0}, b, 4000), {0.0, 0.0});
  const PrescribedWorkspace prescribed("c", Circle{a});
  const AreaMeasure measure = measure_area(prescribed, &computed, prescribed.angles(3000));
  BOOST_TEST(measure.prescribed_outside == pi * a * a - lens_area(a, b, e), tolerance(1e-4));
  BOOST_TEST(measure.computed_outside == pi * b * b - lens_area(a, b, e), tolerance(1e-4));
  BOOST_TEST(measure.clearance == (b - e) - a, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(error_falls_with_the_square_of_the_sectors) {
  const PolarBoundary computed(polygonal_circle({0.3, 0.0}, 0.5, 40000), {0.0, 0.0});
  const PrescribedWorkspace prescribed("c", Circle{0.4});
  const double exact = pi * 0.16 - lens_area(0.4, 0.5, 0.3);
  const auto error = [&](int sectors) {
    return std::abs(measure_area(prescribed, &computed, prescribed.angles(sectors)).prescribed_outside - exact);
  };
  BOOST_TEST(error(1600) < error(100) / 100.0);  // 256 if it were exact
}

BOOST_AUTO_TEST_CASE(without_a_boundary_all_is_outside) {
  const PrescribedWorkspace prescribed("e", Ellipse{{0.35, 0.2}}, {{3.0, 4.0}});
  const AreaMeasure measure = measure_area(prescribed, nullptr, prescribed.angles(2000));
  BOOST_TEST(measure.prescribed_outside == pi * 0.07, tolerance(1e-5));
  BOOST_TEST(measure.computed_outside == 0.0);
  BOOST_TEST(measure.clearance == -0.35, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(one_direction_is_refused) {
  const PrescribedWorkspace prescribed("c", Circle{1.0});
  BOOST_CHECK_THROW(measure_area(prescribed, nullptr, std::vector<double>{0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
