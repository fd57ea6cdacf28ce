// Complete tracing against exact workspaces: 500 random manipulators at one orientation and 500 over ranges of
// orientations, among them workspaces that are not convex, have several components, and have holes.
//
// The area between chords and arcs is at most the sum of sweep d^2 / 12 over all arcs, so 5 d^2 allows for arcs of 60
// radians together, or for a few features that are shorter than a chord.
//
// A loop less than three chords across is too small for the chord (trace.hpp asks for a chord of at most a third of a
// workspace's width). Such a loop may be among the failures; any other may not.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>
#include <sstream>

#include "reprise/geometry/hausdorff_distance.hpp"
#include "reprise/workspace/complete_trace.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

struct Workspace {
  std::unique_ptr<Limits> limits;
  Region region;
};

/// The next workspace that is not empty.
Workspace next_workspace(std::mt19937& random, bool dextrous) {
  while (true) {
    const Manipulator manipulator = random_manipulator(random);
    const Interval orientations = random_orientations(random);
    Workspace workspace;
    if (dextrous) {
      workspace.region = dextrous_workspace(manipulator, orientations);
      workspace.limits = std::make_unique<DextrousLimits>(manipulator, orientations);
    } else {
      workspace.region = constant_orientation_workspace(manipulator, orientations.lower);
      workspace.limits = std::make_unique<ConstantOrientationLimits>(manipulator, orientations.lower);
    }
    if (!workspace.region.empty()) return workspace;
  }
}

double diameter(const BoundaryLoop& loop, double spacing) {
  const std::vector<Eigen::Vector2d> points = loop.sample(spacing);
  double widest = 0.0;
  for (const Eigen::Vector2d& a : points) {
    for (const Eigen::Vector2d& b : points) widest = std::max(widest, (a - b).norm());
  }
  return widest;
}

/// Whether the boundary bends inward somewhere.
bool is_certainly_not_convex(const BoundaryLoop& outer) {
  return std::any_of(outer.edges.begin(), outer.edges.end(), [](const BoundaryEdge& edge) { return edge.sweep < 0.0; });
}

struct Counts {
  std::size_t several = 0;
  std::size_t with_holes = 0;
  std::size_t not_convex = 0;
  std::size_t too_small = 0;
};

void check(bool dextrous, unsigned seed) {
  std::mt19937 random(seed);
  Counts counts;
  double worst = 0.0;
  for (int sample = 0; sample < 500; ++sample) {
    const auto [limits, region] = next_workspace(random, dextrous);
    const std::vector<BoundaryLoop> all = loops(region);
    const double d = std::clamp(region.perimeter() / 150.0, 0.01, 0.05);
    const TracedWorkspace traced = trace_all_boundaries(*limits, region, {.chord = d});

    std::size_t lost_components = 0;
    for (const FailedBoundary& failure : traced.failures) {
      const BoundaryLoop& loop = all[failure.loop.value()];
      const bool too_small = diameter(loop, 0.1 * d) < 3.0 * d;
      BOOST_TEST(too_small, "sample " << sample << ": " << failure.reason);
      ++counts.too_small;
      if (loop.signed_area() > 0.0) ++lost_components;
    }
    const std::size_t lost_holes = traced.failures.size() - lost_components;
    BOOST_TEST(traced.components.size() + lost_components == region.components().size(), "sample " << sample);
    BOOST_TEST(traced.hole_count() + lost_holes == number_of_holes(region), "sample " << sample);
    const double error = (traced.area() - region.area()) / (d * d);
    BOOST_TEST(std::abs(error) <= 5.0, "sample " << sample << ": error of the area " << error << " d^2");
    worst = std::max(worst, std::abs(error));
    // Where nothing is lost, no point is farther off than a chord, whatever its area.
    if (traced.complete()) {
      BOOST_TEST(hausdorff_distance(traced.polygons(), region, 0.1 * d).value() <= d, "sample " << sample);
    }
    if (region.components().size() > 1) ++counts.several;
    if (number_of_holes(region) > 0) ++counts.with_holes;
    if (is_certainly_not_convex(region.components().front().outer)) ++counts.not_convex;
  }
  BOOST_TEST_MESSAGE(counts.several << " with several components, " << counts.with_holes << " with holes, "
                                    << counts.not_convex << " not convex, " << counts.too_small
                                    << " loops too small; largest error of the area " << worst << " d^2");
  BOOST_TEST(counts.several >= 40u);
  BOOST_TEST(counts.with_holes >= 40u);
  BOOST_TEST(counts.not_convex >= 100u);
  BOOST_TEST(counts.too_small <= 20u);
}

}  // namespace

BOOST_AUTO_TEST_CASE(constant_orientation_workspaces) { check(false, 51); }

BOOST_AUTO_TEST_CASE(dextrous_workspaces) { check(true, 52); }
