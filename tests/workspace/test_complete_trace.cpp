// Complete tracing, on workspaces whose parts are known.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/hausdorff_distance.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/workspace/complete_trace.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

double area(const TracedBoundary& boundary) { return signed_area(boundary.positions()); }

/// What the counts and the order promise, whatever the workspace.
void check_whole(const TracedWorkspace& workspace) {
  BOOST_TEST(workspace.complete());
  double sum = 0.0;
  std::size_t points = 0;
  std::size_t evaluations = workspace.grid_evaluations;
  double last_outer = std::numeric_limits<double>::infinity();
  for (const TracedComponent& component : workspace.components) {
    BOOST_TEST(component.outer.closed());
    BOOST_TEST(area(component.outer) > 0.0);
    BOOST_TEST(area(component.outer) <= last_outer);
    last_outer = area(component.outer);
    sum += area(component.outer);
    points += component.outer.points.size();
    evaluations += component.outer.evaluations;
    double last_hole = -std::numeric_limits<double>::infinity();
    for (const TracedBoundary& hole : component.holes) {
      BOOST_TEST(hole.closed());
      BOOST_TEST(area(hole) < 0.0);
      BOOST_TEST(area(hole) >= last_hole);
      last_hole = area(hole);
      sum += area(hole);
      points += hole.points.size();
      evaluations += hole.evaluations;
    }
  }
  BOOST_TEST(std::abs(workspace.area() - sum) <= 1e-12);
  BOOST_TEST(workspace.point_count() == points);
  BOOST_TEST(workspace.evaluations == evaluations);
  BOOST_TEST(workspace.polygons().size() == workspace.components.size() + workspace.hole_count());
}

/// |u| <= 1 or 2 <= |u| <= 3: a disc in the hole of a ring, moved off the grid's centre.
class Moat final : public Limits {
 public:
  Eigen::Index count() const override { return 2; }
  void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const override {
    const double r = (u - centre_).norm();
    h[0] = r - 3.0;
    h[1] = 0.5 - std::abs(r - 1.5);
  }
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j) const override {
    const Eigen::Vector2d a = u - centre_;
    const double r = a.norm();
    if (r == 0.0) return Eigen::Vector2d::Zero();
    return (j == 0 || r < 1.5 ? 1.0 : -1.0) / r * a;
  }
  std::string label(Eigen::Index j) const override { return j == 0 ? "rim" : "moat"; }
  Eigen::AlignedBox2d box() const override {
    return {centre_ - Eigen::Vector2d::Constant(3.0), centre_ + Eigen::Vector2d::Constant(3.0)};
  }

 private:
  Eigen::Vector2d centre_{0.123, -0.456};
};

/// A disc about (0.5, 0.5) times a spacing, of a radius in units of it, in a box of 10 by 10 about the origin, whose
/// grid has its points at whole multiples.
class SmallDisc final : public Limits {
 public:
  SmallDisc(double spacing, double radius)
      : spacing_(spacing), centre_(0.5 * spacing, 0.5 * spacing), radius_(radius * spacing) {}
  Eigen::Index count() const override { return 1; }
  void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const override {
    h[0] = (u - centre_).norm() - radius_;
  }
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index) const override { return (u - centre_).normalized(); }
  std::string label(Eigen::Index) const override { return "disc"; }
  Eigen::AlignedBox2d box() const override {
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(5.0 * spacing_);
    return {-half, half};
  }

 private:
  double spacing_;
  Eigen::Vector2d centre_;
  double radius_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_annulus_has_one_component_with_one_hole) {
  const Manipulator manipulator("annulus", {leg_at({0.2, 0.3}, {0.5, 1.0})});
  const ConstantOrientationLimits limits(manipulator, 0.0);
  const TraceOptions options{.chord = 0.05};
  for (const TracedWorkspace& workspace :
       {trace_all_boundaries(limits, constant_orientation_workspace(manipulator, 0.0), options),
        trace_all_boundaries(limits, 0.13, options)}) {
    check_whole(workspace);
    BOOST_TEST(workspace.components.size() == 1u);
    BOOST_TEST(workspace.hole_count() == 1u);
    // Each of the two circles: sweep d^2 / 12.
    BOOST_TEST(std::abs(workspace.area() - 0.75 * pi) <= 2.0 * pi * 0.05 * 0.05 / 12.0);
  }
}

BOOST_AUTO_TEST_CASE(m1_has_two_components_that_mirror_each_other) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  for (const TracedWorkspace& workspace :
       {trace_all_boundaries(limits, constant_orientation_workspace(m1(), 0.0)), trace_all_boundaries(limits, 0.1)}) {
    check_whole(workspace);
    BOOST_TEST_REQUIRE(workspace.components.size() == 2u);
    BOOST_TEST(workspace.hole_count() == 0u);
    BOOST_TEST(std::abs(workspace.area() - 0.726983276093924) <= 0.02 * 0.02);
    BOOST_TEST(std::abs(area(workspace.components[0].outer) - area(workspace.components[1].outer)) <= 0.02 * 0.02);
  }
}

BOOST_AUTO_TEST_CASE(a_hole_belongs_to_the_component_around_it_and_a_component_may_lie_in_a_hole) {
  const TracedWorkspace workspace = trace_all_boundaries(Moat(), 0.3, {.chord = 0.1});
  check_whole(workspace);
  BOOST_TEST_REQUIRE(workspace.components.size() == 2u);
  BOOST_TEST_REQUIRE(workspace.components[0].holes.size() == 1u);
  BOOST_TEST(workspace.components[1].holes.empty());
  const double accuracy = 2.0 * pi * 0.1 * 0.1 / 12.0;
  BOOST_TEST(std::abs(area(workspace.components[0].outer) - 9.0 * pi) <= accuracy);
  BOOST_TEST(std::abs(area(workspace.components[0].holes[0]) + 4.0 * pi) <= accuracy);
  BOOST_TEST(std::abs(area(workspace.components[1].outer) - pi) <= accuracy);
}

BOOST_AUTO_TEST_CASE(a_grid_shows_what_holds_one_of_its_points) {
  for (const double spacing : {0.01, 1.0, 250.0}) {
    const TraceOptions options{.chord = 0.2 * spacing};
    // The nearest grid points are at the distance spacing / sqrt 2.
    const TracedWorkspace unseen = trace_all_boundaries(SmallDisc(spacing, 0.7), spacing, options);
    BOOST_TEST(unseen.components.empty());
    BOOST_TEST(unseen.complete());
    BOOST_TEST(unseen.evaluations == unseen.grid_evaluations);
    const TracedWorkspace seen = trace_all_boundaries(SmallDisc(spacing, 0.71), spacing, options);
    check_whole(seen);
    BOOST_TEST(seen.components.size() == 1u);
    check_whole(trace_all_boundaries(SmallDisc(spacing, 0.7), 0.5 * spacing, options));
  }
}

BOOST_AUTO_TEST_CASE(a_loop_too_small_for_the_chord_is_a_failure_with_a_reason) {
  // An annulus whose hole is less than a chord wide.
  const Manipulator manipulator("small hole", {leg_at({0.0, 0.0}, {0.03, 1.0})});
  const ConstantOrientationLimits limits(manipulator, 0.0);
  const TraceOptions options{.chord = 0.1};
  for (const bool from_region : {true, false}) {
    const TracedWorkspace workspace =
        from_region ? trace_all_boundaries(limits, constant_orientation_workspace(manipulator, 0.0), options)
                    : trace_all_boundaries(limits, 0.01, options);
    BOOST_TEST(workspace.components.size() == 1u);
    BOOST_TEST(workspace.hole_count() == 0u);
    BOOST_TEST(!workspace.complete());
    BOOST_TEST_REQUIRE(workspace.failures.size() == 1u);
    const FailedBoundary& failure = workspace.failures.front();
    BOOST_TEST(!failure.reason.empty());
    BOOST_TEST(!failure.trace.points.empty());
    if (from_region) {
      BOOST_TEST(failure.loop.value() == 1u);
    } else {
      BOOST_TEST(!failure.loop.has_value());
    }
    BOOST_TEST(std::abs(failure.trace.points.front().position.norm() - 0.03) <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_hole_without_its_outer_boundary_is_a_failure) {
  // The hole needs 32 points, the outer circle 63.
  const Manipulator manipulator("annulus", {leg_at({0.0, 0.0}, {0.5, 1.0})});
  const TracedWorkspace workspace =
      trace_all_boundaries(ConstantOrientationLimits(manipulator, 0.0),
                           constant_orientation_workspace(manipulator, 0.0), {.chord = 0.1, .max_points = 40});
  BOOST_TEST(workspace.components.empty());
  BOOST_TEST(workspace.area() == 0.0);
  BOOST_TEST_REQUIRE(workspace.failures.size() == 2u);
  BOOST_TEST((workspace.failures[0].trace.status == TraceStatus::too_many_points));
  BOOST_TEST(workspace.failures[0].loop.value() == 0u);
  BOOST_TEST(workspace.failures[1].trace.closed());
  BOOST_TEST(workspace.failures[1].loop.value() == 1u);
  BOOST_TEST(workspace.failures[1].reason.find("outer boundary") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(every_loop_is_met_first_by_its_own_ray) {
  // max_points = 1 leaves the first point of each walk.
  std::mt19937 random(41);
  std::size_t rays = 0;
  for (int sample = 0; sample < 400; ++sample) {
    const Manipulator manipulator = random_manipulator(random);
    const Interval orientations = random_orientations(random);
    const Region region = dextrous_workspace(manipulator, orientations);
    const TracedWorkspace workspace =
        trace_all_boundaries(DextrousLimits(manipulator, orientations), region, {.chord = 0.05, .max_points = 1});
    const std::vector<BoundaryLoop> all = loops(region);
    BOOST_TEST_REQUIRE(workspace.failures.size() == all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      BOOST_TEST_REQUIRE(workspace.failures[k].loop.value() == k);
      BOOST_TEST_REQUIRE(!workspace.failures[k].trace.points.empty());
      const Eigen::Vector2d& first = workspace.failures[k].trace.points.front().position;
      BOOST_TEST(Region({{all[k], {}}}).distance_to_boundary(first) <= 1e-11);
      ++rays;
    }
  }
  BOOST_TEST(rays >= 200u);
}

BOOST_AUTO_TEST_CASE(a_grid_misses_only_what_is_too_small_for_it) {
  std::mt19937 random(43);
  const double spacing = 0.1;
  const double chord = 0.02;
  std::size_t found = 0;
  std::size_t missed = 0;
  for (int sample = 0; sample < 150; ++sample) {
    const Manipulator manipulator = random_manipulator(random);
    const double orientation = uniform(random, -pi, pi);
    const Region region = constant_orientation_workspace(manipulator, orientation);
    const TracedWorkspace workspace =
        trace_all_boundaries(ConstantOrientationLimits(manipulator, orientation), spacing, {.chord = chord});
    BOOST_TEST(workspace.complete(), "sample " << sample);
    const std::vector<std::vector<Eigen::Vector2d>> polygons = workspace.polygons();
    std::size_t matched = 0;
    for (const BoundaryLoop& loop : loops(region)) {
      const bool known =
          std::any_of(polygons.begin(), polygons.end(), [&](const std::vector<Eigen::Vector2d>& polygon) {
            return hausdorff_distance({&polygon, 1}, Region({{loop, {}}}), 0.1 * chord).value() <= chord;
          });
      if (known) {
        ++matched;
        continue;
      }
      ++missed;
      // Nowhere within it, on its side of the boundary, there is room for a disc that must hold a grid point.
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& point : loop.sample(chord)) box.extend(point);
      const bool is_hole = loop.signed_area() < 0.0;
      double room = 0.0;
      for (double x = box.min().x(); x <= box.max().x(); x += 0.1 * spacing) {
        for (double y = box.min().y(); y <= box.max().y(); y += 0.1 * spacing) {
          if (!loop.encloses({x, y}) || region.contains({x, y}) == is_hole) continue;
          room = std::max(room, region.distance_to_boundary({x, y}));
        }
      }
      BOOST_TEST(room <= spacing / std::numbers::sqrt2, "sample " << sample);
    }
    // No boundary is there twice.
    BOOST_TEST(matched == polygons.size(), "sample " << sample);
    found += matched;
  }
  BOOST_TEST(found >= 100u);
  BOOST_TEST(missed >= 1u);
}

BOOST_AUTO_TEST_CASE(evaluations_are_counted) {
  const ConstantOrientationLimits plain(m1(), 0.1);
  for (const bool from_region : {true, false}) {
    const CountingLimits limits(plain);
    const TracedWorkspace workspace = from_region
                                          ? trace_all_boundaries(limits, constant_orientation_workspace(m1(), 0.1))
                                          : trace_all_boundaries(limits, 0.1);
    check_whole(workspace);
    BOOST_TEST(workspace.evaluations == limits.evaluations);
    BOOST_TEST(workspace.gradients == limits.gradients);
    BOOST_TEST((workspace.grid_evaluations == 0u) == from_region);
  }
}

BOOST_AUTO_TEST_CASE(empty_workspaces_are_complete) {
  const Manipulator apart("apart", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({1.5, 1.5}, {0.0, 1.0})});
  const ConstantOrientationLimits limits(apart, 0.0);
  const Manipulator farther("farther", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({5.0, 0.0}, {0.0, 1.0})});
  for (const TracedWorkspace& workspace :
       {trace_all_boundaries(limits, constant_orientation_workspace(apart, 0.0)), trace_all_boundaries(limits, 0.1),
        trace_all_boundaries(ConstantOrientationLimits(farther, 0.0), 0.1)}) {
    check_whole(workspace);
    BOOST_TEST(workspace.components.empty());
    BOOST_TEST(workspace.area() == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_reported) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double spacing : {0.0, -1.0, nan, std::numeric_limits<double>::infinity(), 1e-7}) {
    BOOST_CHECK_THROW(trace_all_boundaries(limits, spacing), std::invalid_argument);
  }
  BOOST_CHECK_THROW(trace_all_boundaries(limits, 0.1, {.chord = -1.0}), std::invalid_argument);
  BOOST_CHECK_THROW(trace_all_boundaries(limits, Region(), {.chord = nan}), std::invalid_argument);
}
