#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/workspace/complete_trace.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "reprise/workspace/region_vertices.hpp"
#include "reprise/workspace/trace.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

double traced_area(const TracedBoundary& boundary) { return signed_area(boundary.positions()); }

/// Every point is on the boundary; consecutive points are at the distance d, or nearer at bifurcation points and at the
/// end; bifurcation points have two active limits.
void check_boundary(const Limits& limits, const TracedBoundary& boundary, double chord) {
  BOOST_TEST_REQUIRE(boundary.closed(), boundary.message);
  BOOST_TEST(boundary.message.empty());
  BOOST_TEST(boundary.unresolved_bifurcations == 0u);
  Eigen::VectorXd h(limits.count());
  const auto is_extra = [&](const BoundaryPoint& point) {
    return point.is_bifurcation() || limits.corner(point.active[0], point.position) == point.position;
  };
  const BoundaryPoint* last_regular = &boundary.points.front();
  double farthest = 0.0;  // of any point from the boundary or from a limit said to be active there
  bool spaced = true;
  for (std::size_t i = 0; i < boundary.points.size(); ++i) {
    const BoundaryPoint& point = boundary.points[i];
    limits.evaluate(point.position, h);
    farthest = std::max({farthest, std::abs(h.maxCoeff()), std::abs(h[point.active[0]]), std::abs(h[point.active[1]])});
    // A point may be at a corner and a chord away both.
    const bool is_regular = std::abs((point.position - last_regular->position).norm() - chord) <= 1e-12 * chord;
    spaced = spaced && (is_regular || is_extra(point) || i == 0);
    if (is_regular) last_regular = &point;
  }
  BOOST_TEST(farthest <= 1e-12);
  BOOST_TEST(spaced);
  // What is left for the last chord is at most one chord, unless it goes around a tip.
  BOOST_TEST((boundary.points.front().position - last_regular->position).norm() <= 2.5 * chord);
}

/// Area between a chord and an arc of radius R, summed over a boundary of length s: each chord of length d leaves out
/// R^2 (t - sin t) / 2 < d^3 / (12 R) (1 + d^2 / R^2) with d = 2 R sin(t/2).
double sagitta_area(double length, double chord, double smallest_radius) {
  return length * chord * chord / (12.0 * smallest_radius) * 1.1;
}

/// Least-squares slope of log(error) over log(step).
double fitted_order(const std::vector<double>& steps, const std::vector<double>& errors) {
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double x = std::log(steps[i]);
    const double y = std::log(std::abs(errors[i]));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double n = static_cast<double>(steps.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// The ellipse x^2 / 4 + y^2 <= 1, as a limit with no Lipschitz constant given, cut by the half plane x <= 1.
class CutEllipse final : public Limits {
 public:
  Eigen::Index count() const override { return 2; }
  void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const override {
    h[0] = 0.25 * u.x() * u.x() + u.y() * u.y() - 1.0;
    h[1] = u.x() - 1.0;
  }
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j) const override {
    return j == 0 ? Eigen::Vector2d(0.5 * u.x(), 2.0 * u.y()) : Eigen::Vector2d::UnitX();
  }
  std::string label(Eigen::Index j) const override { return j == 0 ? "ellipse" : "half plane"; }
  Eigen::AlignedBox2d box() const override { return {Eigen::Vector2d(-2.0, -1.0), Eigen::Vector2d(2.0, 1.0)}; }
  double lipschitz_constant() const override { return infinity; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(one_leg_gives_a_full_circle) {
  const Eigen::Vector2d centre(0.3, -0.2);
  const ConstantOrientationLimits limits({"disc", {leg_at(centre, {0.0, 1.0})}}, 0.0);
  for (const double d : {1.2, 0.3, 0.02}) {
    const TracedBoundary boundary = trace_boundary(limits, {0.4, 0.1}, {.chord = d});
    check_boundary(limits, boundary, d);
    // n - 1 chords that subtend t each, and a last one for the rest of the turn.
    const double t = 2.0 * std::asin(0.5 * d);
    const double n = static_cast<double>(boundary.points.size());
    BOOST_TEST(n == std::ceil(2.0 * pi / t));
    BOOST_TEST(traced_area(boundary) == 0.5 * ((n - 1.0) * std::sin(t) + std::sin(2.0 * pi - (n - 1.0) * t)),
               tt::tolerance(1e-12));
    BOOST_TEST((boundary.points[0].position - centre).norm() == 1.0, tt::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(a_ray_that_meets_a_hole_first_gives_the_hole_clockwise) {
  const ConstantOrientationLimits limits({"annulus", {leg_at({0.0, 0.0}, {0.5, 1.0})}}, 0.0);
  const TracedBoundary hole = trace_boundary(limits, {0.75, 0.0}, {.chord = 0.01, .first_direction = {-1.0, 0.0}});
  check_boundary(limits, hole, 0.01);
  BOOST_TEST(traced_area(hole) < 0.0);
  BOOST_TEST(std::abs(traced_area(hole) + 0.25 * pi) <= sagitta_area(pi, 0.01, 0.5));
  const TracedBoundary outer = trace_boundary(limits, {0.75, 0.0}, {.chord = 0.01});
  check_boundary(limits, outer, 0.01);
  BOOST_TEST(std::abs(traced_area(outer) - pi) <= sagitta_area(2.0 * pi, 0.01, 1.0));
}

BOOST_AUTO_TEST_CASE(two_legs_give_a_lens) {
  for (const double distance : {0.4, 1.0, 1.6, 1.79}) {
    const ConstantOrientationLimits limits(
        {"lens", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({distance, 0.0}, {0.0, 0.8})}}, 0.0);
    for (const double d : {0.05, 0.02, 0.005}) {
      const TracedBoundary boundary = trace_boundary(limits, {.chord = d});
      check_boundary(limits, boundary, d);
      const double exact = lens_area(1.0, 0.8, distance);
      BOOST_TEST(traced_area(boundary) < exact);
      BOOST_TEST(traced_area(boundary) > exact - sagitta_area(2.0 * pi, d, 0.8));
    }
  }
}

BOOST_AUTO_TEST_CASE(joint_angle_limits_give_straight_edges) {
  // The wedge of a disc, narrow and wide, at the base or at the platform; its area is R^2 width / 2.
  const double orientation = 0.7;
  for (const double width : {0.3, 1.1, 2.9, pi, 4.0, 5.9}) {
    for (const bool at_base : {true, false}) {
      Leg leg = leg_at({0.2, 0.1}, {0.0, 1.0});
      const Interval angle{-0.4, -0.4 + width};
      (at_base ? leg.base_angle : leg.platform_angle) = angle;
      const ConstantOrientationLimits limits({"wedge", {leg}}, orientation);
      const Eigen::Vector2d start = leg.base_joint + 0.5 * unit(-0.4 + 0.5 * width + (at_base ? 0.0 : orientation));
      // The ray meets the circle, and an edge.
      for (const Eigen::Vector2d& direction : {Eigen::Vector2d(start - leg.base_joint), Eigen::Vector2d(0.1, 1.0)}) {
        const TracedBoundary boundary = trace_boundary(limits, start, {.chord = 0.01, .first_direction = direction});
        check_boundary(limits, boundary, 0.01);
        BOOST_TEST(traced_area(boundary) <= 0.5 * width + 1e-12);
        BOOST_TEST(traced_area(boundary) >= 0.5 * width - sagitta_area(width, 0.01, 1.0));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_polygon_of_straight_edges_is_exact) {
  // A square cut out by the edges of two wedges with apexes far away: no arc, so no error but at its corners, and those
  // are bifurcation points.
  Leg first = leg_at({0.0, 0.0}, {0.0, 10.0});
  first.base_angle = Interval{0.0, 0.5 * pi};
  Leg second = leg_at({1.0, 1.0}, {0.0, 10.0});
  second.base_angle = Interval{pi, 1.5 * pi};
  const ConstantOrientationLimits limits({"square", {first, second}}, 0.0);
  for (const double d : {0.3, 0.1, 0.07}) {
    const TracedBoundary boundary = trace_boundary(limits, {0.4, 0.6}, {.chord = d});
    check_boundary(limits, boundary, d);
    BOOST_TEST(traced_area(boundary) == 1.0, tt::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(m1_is_traced_within_its_budget) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const TracedBoundary boundary = trace_boundary(limits, {1.0, 1.5}, {.chord = 0.02});
  check_boundary(limits, boundary, 0.02);
  // Closed form: half of 0.726983276093924.
  BOOST_TEST(std::abs(traced_area(boundary) - 0.5 * 0.726983276093924) <= 1e-4);
  BOOST_TEST(boundary.evaluations <= 12 * boundary.points.size());

  // Where legs 1 and 2 are at a limit both; at the first and third of these points leg 3 is as well.
  const double s3 = std::numbers::sqrt3;
  const double s7 = std::sqrt(7.0);
  const std::vector<Eigen::Vector2d> corners = {{1.0, s3}, {0.5, 0.5 * s7}, {1.0, 1.0}, {1.5, 0.5 * s7}};
  std::vector<Eigen::Vector2d> found;
  for (const BoundaryPoint& point : boundary.points) {
    if (point.is_bifurcation()) found.push_back(point.position);
  }
  BOOST_TEST_REQUIRE(found.size() == corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) BOOST_TEST((found[k] - corners[k]).norm() <= 1e-12);
}

BOOST_AUTO_TEST_CASE(m1_is_survived_from_every_start_and_with_every_chord) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const double exact = 0.5 * 0.726983276093924;
  for (int k = 0; k < 48; ++k) {
    // From (1, 1.3): among the directions are those of the triple points.
    const Eigen::Vector2d direction = unit(2.0 * pi * k / 48.0);
    for (const double d : {0.1, 0.03, 0.01}) {
      for (const double side : {1.0, -1.0}) {
        const TracedBoundary boundary =
            trace_boundary(limits, {1.0, side * 1.3}, {.chord = d, .first_direction = direction});
        check_boundary(limits, boundary, d);
        BOOST_TEST(std::abs(traced_area(boundary) - exact) <= sagitta_area(3.2, d, std::numbers::sqrt2));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_error_of_the_area_is_of_second_order) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const std::vector<double> chords = {0.1, 0.05, 0.025, 0.0125, 0.00625};
  std::vector<double> errors;
  errors.reserve(chords.size());
  for (const double d : chords) {
    errors.push_back(traced_area(trace_boundary(limits, {1.0, 1.5}, {.chord = d})) - 0.5 * 0.726983276093924);
  }
  BOOST_TEST(fitted_order(chords, errors) == 2.0, tt::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(without_bifurcation_points_corners_are_cut) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const TracedBoundary with = trace_boundary(limits, {1.0, 1.5});
  const TracedBoundary without = trace_boundary(limits, {1.0, 1.5}, {.bifurcation_points = false});
  BOOST_TEST(without.closed());
  BOOST_TEST(std::none_of(without.points.begin() + 1, without.points.end(),
                          [](const BoundaryPoint& point) { return point.is_bifurcation(); }));
  BOOST_TEST(without.points.size() + 4 == with.points.size());
  BOOST_TEST(traced_area(without) < traced_area(with));
}

BOOST_AUTO_TEST_CASE(without_bifurcation_points_a_walk_goes_around_once) {
  // Whatever the place of b^1, also within the corner that the last chord cuts off: the rays go to the corners and
  // beside them. A cut corner is a triangle with two sides that are at most about a chord long.
  const Interval range{-5.0 * pi / 180.0, 5.0 * pi / 180.0};
  const DextrousLimits limits(m1(), range);
  const Region region = dextrous_workspace(m1(), range);
  for (const RegionVertex& corner : vertices(region, limits)) {
    const Eigen::Vector2d start(1.0, corner.position.y() > 0.0 ? 1.3 : -1.3);
    const Eigen::Vector2d along = corner.position - start;
    for (int k = -10; k <= 10; ++k) {
      const Eigen::Vector2d direction = Eigen::Rotation2Dd(0.01 * k) * along;
      for (const double d : {0.1, 0.06, 0.03}) {
        const TracedBoundary boundary =
            trace_boundary(limits, start, {.chord = d, .first_direction = direction, .bifurcation_points = false});
        BOOST_TEST_REQUIRE(boundary.closed(), boundary.message);
        BOOST_TEST(std::abs(traced_area(boundary) - 0.5 * region.area()) <= 4.0 * 0.5 * d * d);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(coincident_limits_count_as_one) {
  // Every leg twice.
  const Manipulator manipulator = m1();
  std::vector<Leg> legs = manipulator.legs();
  legs.insert(legs.end(), manipulator.legs().begin(), manipulator.legs().end());
  const ConstantOrientationLimits twice({"M1 twice", legs}, 0.0);
  const TracedBoundary boundary = trace_boundary(twice, {1.0, 1.5});
  check_boundary(twice, boundary, 0.02);
  const TracedBoundary once = trace_boundary(ConstantOrientationLimits(manipulator, 0.0), {1.0, 1.5});
  BOOST_TEST_REQUIRE(boundary.points.size() == once.points.size());
  BOOST_TEST(traced_area(boundary) == traced_area(once), tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(limits_that_touch_without_cutting_leave_no_trace) {
  // A disc of radius 1, and inside a disc of radius 2 that touches it at (1, 0); and the hole of an annulus that does.
  for (const bool hole : {false, true}) {
    const Leg touching = hole ? leg_at({1.5, 0.0}, {0.5, 9.0}) : leg_at({-1.0, 0.0}, {0.0, 2.0});
    const ConstantOrientationLimits limits({"touching", {leg_at({0.0, 0.0}, {0.0, 1.0}), touching}}, 0.0);
    for (const double d : {0.05, 0.02}) {
      const TracedBoundary boundary = trace_boundary(limits, {0.3, 0.1}, {.chord = d, .first_direction = {0.0, 1.0}});
      check_boundary(limits, boundary, d);
      BOOST_TEST(std::abs(traced_area(boundary) - pi) <= sagitta_area(2.0 * pi, d, 1.0));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_limit_that_enters_and_leaves_within_one_chord_is_seen) {
  // The disc of radius 1 about the origin, cut off at x = 1 - depth by the edge of a far wedge.
  for (const double depth : {1e-3, 1e-4, 1e-5, 1e-8}) {
    Leg edge = leg_at({1.0 - depth, -5.0}, {0.0, 20.0});
    edge.base_angle = Interval{0.5 * pi, 1.2 * pi};
    const ConstantOrientationLimits limits({"cut disc", {leg_at({0.0, 0.0}, {0.0, 1.0}), edge}}, 0.0);
    const double half_angle = std::acos(1.0 - depth);
    const double exact = pi - half_angle + std::sin(half_angle) * std::cos(half_angle);
    const double width = 2.0 * std::sin(half_angle);
    // The cut is shorter than the chord, and in its middle half.
    const double d = 2.5 * width;
    if (d > 0.3) continue;
    for (const double shift : {-0.1, 0.0, 0.1}) {
      const Eigen::Vector2d direction = unit(-std::asin(0.5 * d) + shift * d);
      const TracedBoundary boundary = trace_boundary(limits, {0.0, 0.0}, {.chord = d, .first_direction = direction});
      check_boundary(limits, boundary, d);
      const auto bifurcations = std::count_if(boundary.points.begin(), boundary.points.end(),
                                              [](const BoundaryPoint& point) { return point.is_bifurcation(); });
      BOOST_TEST(bifurcations == 2);
      BOOST_TEST(boundary.points[1].position.x() == 1.0 - depth, tt::tolerance(1e-12));
      BOOST_TEST(std::abs(traced_area(boundary) - exact) <= sagitta_area(2.0 * pi, d, 1.0));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_gap_narrower_than_a_chord_is_not_jumped) {
  // The strip 0 <= y <= 0.3 of a large disc, parted by a disc of radius 0.152 about (0, 0.15), which leaves gaps of
  // 0.049 in its edges: the part on the left, whose ends at the gaps are tips.
  const double radius = 0.152;
  Leg lower = leg_at({-6.0, 0.0}, {0.0, 8.0});
  lower.base_angle = Interval{0.0, pi};
  Leg upper = leg_at({6.0, 0.3}, {0.0, 8.0});
  upper.base_angle = Interval{pi, 2.0 * pi};
  const ConstantOrientationLimits limits({"strip", {leg_at({0.0, 0.15}, {radius, 1.0}), lower, upper}}, 0.0);
  const double half_gap = std::sqrt(radius * radius - 0.15 * 0.15);
  // Half of the outer disc within the strip, less half of the inner one.
  const auto half_band = [](double r) { return 0.15 * std::sqrt(r * r - 0.15 * 0.15) + r * r * std::asin(0.15 / r); };
  const double exact = half_band(1.0) - half_band(radius);
  for (const double d : {0.1, 0.07, 0.055}) {
    for (int k = 0; k < 20; ++k) {
      // From all phases along the lower edge.
      const Eigen::Vector2d start(-0.5 - d * k / 20.0, 0.1);
      const TracedBoundary boundary = trace_boundary(limits, start, {.chord = d, .first_direction = {0.0, -1.0}});
      BOOST_TEST_REQUIRE(boundary.closed(), boundary.message);
      BOOST_TEST(boundary.unresolved_bifurcations == 0u);
      BOOST_TEST(std::abs(traced_area(boundary) - exact) <= sagitta_area(2.0, d, radius));
      for (const double y : {0.0, 0.3}) {
        BOOST_TEST(std::any_of(boundary.points.begin(), boundary.points.end(), [&](const BoundaryPoint& point) {
          return (point.position - Eigen::Vector2d(-half_gap, y)).norm() <= 1e-12;
        }));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(random_workspaces) {
  std::mt19937 random(1);
  const double d = 0.02;
  int closed = 0;
  int holes = 0;
  for (int sample = 0; sample < 300; ++sample) {
    const ConstantOrientationLimits limits(random_manipulator(random), uniform(random, -1.0, 1.0));
    const InteriorPoint interior = find_interior_point(limits);
    if (interior.status != InteriorStatus::found || interior.clearance < 2.0 * d) continue;
    const TracedBoundary boundary = trace_boundary(limits, {.chord = d});
    check_boundary(limits, boundary, d);
    ++closed;
    const std::vector<Eigen::Vector2d> polygon = boundary.positions();
    const bool is_hole = signed_area(polygon) < 0.0;
    holes += is_hole ? 1 : 0;
    // The start is inside the workspace, hence inside the outer boundary, and outside of a hole.
    BOOST_TEST(contains(polygon, interior.position) != is_hole);

    // To the right of each chord is the outside.
    bool outside = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d along = polygon[(i + 1) % polygon.size()] - polygon[i];
      if (along.norm() < 0.5 * d) continue;
      const Eigen::Vector2d right(along.y(), -along.x());
      outside = outside && largest_limit(limits, polygon[i] + 0.5 * along + 0.1 * right) > 0.0;
    }
    BOOST_TEST(outside);

    // What is seen from the start along a line inside the workspace is not beyond the boundary.
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector2d direction = unit(uniform(random, -pi, pi));
      double r = 0.0;
      for (double s = largest_limit(limits, interior.position); s < -0.1 * d;
           s = largest_limit(limits, interior.position + r * direction)) {
        r -= s;
      }
      const Eigen::Vector2d seen = interior.position + r * direction;
      if (largest_limit(limits, seen) < -0.05 * d) BOOST_TEST(contains(polygon, seen) != is_hole);
    }
  }
  BOOST_TEST(closed > 100);
  BOOST_TEST(holes > 0);
}

BOOST_AUTO_TEST_CASE(a_rigid_motion_moves_the_boundary) {
  std::mt19937 random(2);
  int compared = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const Manipulator manipulator = random_manipulator(random);
    const double orientation = uniform(random, -1.0, 1.0);
    const ConstantOrientationLimits limits(manipulator, orientation);
    const InteriorPoint interior = find_interior_point(limits);
    if (interior.status != InteriorStatus::found || interior.clearance < 0.1) continue;

    const double angle = uniform(random, -3.0, 3.0);
    const Eigen::Rotation2Dd rotation(angle);
    const Eigen::Vector2d shift = uniform_point(random);
    std::vector<Leg> moved = manipulator.legs();
    for (Leg& leg : moved) {
      leg.base_joint = rotation * leg.base_joint + shift;
      if (leg.base_angle) leg.base_angle = Interval{leg.base_angle->lower + angle, leg.base_angle->upper + angle};
    }
    const Eigen::Vector2d direction = unit(uniform(random, -pi, pi));
    const TracedBoundary here = trace_boundary(limits, interior.position, {.first_direction = direction});
    const TracedBoundary there =
        trace_boundary(ConstantOrientationLimits({"moved", moved}, orientation + angle),
                       rotation * interior.position + shift, {.first_direction = rotation * direction});
    BOOST_TEST_REQUIRE(here.closed());
    BOOST_TEST_REQUIRE(there.closed());
    BOOST_TEST_REQUIRE(here.points.size() == there.points.size());
    for (std::size_t i = 0; i < here.points.size(); ++i) {
      BOOST_TEST((rotation * here.points[i].position + shift - there.points[i].position).norm() <= 1e-9);
    }
    ++compared;
  }
  BOOST_TEST(compared > 10);
}

BOOST_AUTO_TEST_CASE(the_unit_of_length_does_not_matter) {
  const double millimetres = 1000.0;
  std::vector<Leg> legs = m1().legs();
  for (Leg& leg : legs) {
    leg.base_joint *= millimetres;
    leg.platform_joint *= millimetres;
    leg.length = {millimetres * leg.length.lower, millimetres * leg.length.upper};
  }
  const TracedBoundary metres = trace_boundary(ConstantOrientationLimits(m1(), 0.1), {1.0, 1.5});
  const TracedBoundary scaled = trace_boundary(ConstantOrientationLimits({"M1 in millimetres", legs}, 0.1),
                                               millimetres * Eigen::Vector2d(1.0, 1.5), {.chord = millimetres * 0.02});
  BOOST_TEST_REQUIRE(metres.closed());
  BOOST_TEST_REQUIRE(scaled.closed());
  BOOST_TEST_REQUIRE(metres.points.size() == scaled.points.size());
  BOOST_TEST(traced_area(scaled) == millimetres * millimetres * traced_area(metres), tt::tolerance(1e-11));
}

BOOST_AUTO_TEST_CASE(the_area_varies_smoothly_with_the_design) {
  // Finite differences of the traced area with step 1e-6 are as good as the area's noise allows: their spread over
  // steps stays small.
  const auto area = [](double x_e) {
    const double s2 = std::numbers::sqrt2;
    const Manipulator manipulator =
        make_manipulator({-1.01, 0.02, 1.03, x_e, 1.02}, {{{s2, 2.0}, {s2, 2.0}, {1.0, std::numbers::sqrt3}}});
    return traced_area(trace_boundary(ConstantOrientationLimits(manipulator, 0.0), {1.0, 1.5}));
  };
  const double reference = (area(2.1 + 1e-4) - area(2.1 - 1e-4)) / 2e-4;
  const double differenced = (area(2.1 + 1e-6) - area(2.1 - 1e-6)) / 2e-6;
  // The difference quotients differ by 1e-8 times the third derivative and by noise / 1e-6.
  BOOST_TEST(std::abs(differenced - reference) <= 1e-6);
}

BOOST_AUTO_TEST_CASE(any_limits_can_be_traced) {
  const CutEllipse limits;
  const TracedBoundary boundary = trace_boundary(limits, {-0.5, 0.2}, {.chord = 0.02});
  check_boundary(limits, boundary, 0.02);
  // The ellipse is a unit disc stretched by 2: 2 (pi - segment beyond 1/2).
  const double exact = 2.0 * (pi - (std::acos(0.5) - 0.5 * std::sin(std::acos(0.5))));
  BOOST_TEST(std::abs(traced_area(boundary) - exact) <= sagitta_area(10.0, 0.02, 0.5));
  // A start cannot be searched for without a Lipschitz constant.
  BOOST_CHECK_THROW(trace_boundary(limits), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(evaluations_are_counted) {
  const ConstantOrientationLimits plain(m1(), 0.2);
  for (const bool with_start : {true, false}) {
    const CountingLimits limits(plain);
    const TracedBoundary boundary = with_start ? trace_boundary(limits, {1.0, 1.5}) : trace_boundary(limits);
    BOOST_TEST(boundary.closed());
    BOOST_TEST(boundary.evaluations == limits.evaluations);
    BOOST_TEST(boundary.gradients == limits.gradients);
  }
}

BOOST_AUTO_TEST_CASE(the_first_direction_has_any_length) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const TracedBoundary one = trace_boundary(limits, {1.0, 1.5}, {.first_direction = {0.6, 0.8}});
  const TracedBoundary other = trace_boundary(limits, {1.0, 1.5}, {.first_direction = {600.0, 800.0}});
  BOOST_TEST((one.points.front().position - other.points.front().position).norm() <= 1e-14);
}

BOOST_AUTO_TEST_CASE(a_start_outside_has_its_status) {
  const TracedBoundary boundary = trace_boundary(ConstantOrientationLimits(m1(), 0.0), {5.0, 0.0});
  BOOST_TEST((boundary.status == TraceStatus::start_outside));
  BOOST_TEST(boundary.message.find("leg 1, maximum length") != std::string::npos);
  BOOST_TEST(boundary.points.empty());
}

BOOST_AUTO_TEST_CASE(an_empty_workspace_has_its_status) {
  const ConstantOrientationLimits discs({"discs", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({1.5, 1.5}, {0.0, 1.0})}},
                                        0.0);
  BOOST_TEST((trace_boundary(discs).status == TraceStatus::empty));
  BOOST_TEST(!trace_boundary(discs).message.empty());
  BOOST_TEST((trace_boundary(discs, {0.75, 0.75}).status == TraceStatus::start_outside));
}

BOOST_AUTO_TEST_CASE(a_chord_longer_than_the_workspace_has_its_status) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  for (const double d : {1.5, 10.0}) {
    const TracedBoundary boundary = trace_boundary(limits, {1.0, 1.5}, {.chord = d});
    BOOST_TEST((boundary.status == TraceStatus::chord_too_long), to_string(boundary.status));
    BOOST_TEST(!boundary.message.empty());
  }
}

BOOST_AUTO_TEST_CASE(too_many_points_have_their_status) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const TracedBoundary boundary = trace_boundary(limits, {1.0, 1.5}, {.max_points = 10});
  BOOST_TEST((boundary.status == TraceStatus::too_many_points));
  BOOST_TEST(boundary.points.size() >= 10u);
  BOOST_TEST(boundary.points.size() <= 12u);
}

BOOST_AUTO_TEST_CASE(statuses_have_different_names) {
  std::set<std::string_view> names;
  for (const TraceStatus status :
       {TraceStatus::closed, TraceStatus::start_outside, TraceStatus::empty, TraceStatus::no_start,
        TraceStatus::chord_too_long, TraceStatus::point_solver_failed, TraceStatus::too_many_points}) {
    names.insert(to_string(status));
  }
  BOOST_TEST(names.size() == 7u);
  BOOST_TEST(to_string(TraceStatus::chord_too_long) == "chord_too_long");
}

BOOST_AUTO_TEST_CASE(bad_options_are_reported) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto rejects = [&](const TraceOptions& options, const std::string& name) {
    try {
      trace_boundary(limits, {1.0, 1.5}, options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).starts_with(name);
    }
    return false;
  };
  for (const double chord : {0.0, -0.1, nan, infinity}) BOOST_TEST(rejects({.chord = chord}, "chord"));
  for (const Eigen::Vector2d& s : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(nan, 1.0)}) {
    BOOST_TEST(rejects({.first_direction = s}, "first_direction"));
  }
  BOOST_TEST(rejects({.max_points = 0}, "max_points"));
  for (const double tolerance : {0.0, 1e-16, 0.1, nan}) BOOST_TEST(rejects({.tolerance = tolerance}, "tolerance"));
  BOOST_CHECK_THROW(trace_boundary(limits, {nan, 0.0}), std::invalid_argument);
}

// Where coordinates are too large for the chord, points cannot be told apart.
BOOST_AUTO_TEST_CASE(chords_that_rounding_would_swallow_are_refused) {
  for (const double far : {1e13, 1e14, 1e16, 1e30}) {
    const ConstantOrientationLimits limits({"far", {Leg{{0.0, 0.0}, {far, 0.0}, {0.0, 1.0}, {}, {}}}}, 0.0);
    BOOST_CHECK_THROW(trace_boundary(limits), std::invalid_argument);
    BOOST_CHECK_THROW(trace_boundary(limits, Eigen::Vector2d(-far, 0.0)), std::invalid_argument);
    BOOST_CHECK_THROW(trace_all_boundaries(limits, 0.1), std::invalid_argument);
  }
  const ConstantOrientationLimits limits({"far", {Leg{{0.0, 0.0}, {1e6, 0.0}, {0.0, 1.0}, {}, {}}}}, 0.0);
  const TracedBoundary boundary = trace_boundary(limits);
  BOOST_TEST_REQUIRE(boundary.closed());
  BOOST_TEST(signed_area(boundary.positions()) == pi, tt::tolerance(1e-3));
}
