// The inverse problem, held against a closed form for two legs, and against syntheses whose prescribed workspace is
// known: the truth is always among the compatible outlines.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "reconstruction/compatible_outlines.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;
using boost::test_tools::tolerance;

constexpr double five_degrees = pi / 36.0;
const Eigen::Vector2d centre(1.0, 1.5);

/// Two legs that meet at P, with base joints at (-d, 0) and (d, 0): kappa^-1 is the sine of the angle between them.
DesignSpace two_legs() {
  Eigen::MatrixXd joint_map = Eigen::MatrixXd::Zero(8, 1);
  joint_map(0, 0) = -1.0;
  joint_map(4, 0) = 1.0;
  const Leg leg{{0.0, 0.0}, {0.0, 0.0}, {0.0, 10.0}, {}, {}};
  return {{"two legs", {leg, leg}}, {"d"}, joint_map, Eigen::MatrixXd::Zero(4, 1)};
}

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

ReportedSynthesis two_leg_synthesis(double least) {
  return {two_legs(), {}, {0.0}, {}, one(1.0), {0.0, 1.0}, one(1.0), {least, 1.0}, {}, 0.0};
}

/// Radius at which a ray leaves a circle that it starts in.
double exit_radius(const Eigen::Vector2d& from, double beta, const Eigen::Vector2d& circle_centre, double radius) {
  const Eigen::Vector2d w = from - circle_centre;
  const double along = w.dot(unit(beta));
  return -along + std::sqrt(along * along - w.squaredNorm() + radius * radius);
}

/// The designs of the synthesis reported below; the final one reaches all of the outline.
Eigen::VectorXd reached_from() { return samples::thesis_start(); }
Eigen::VectorXd reaching() { return to_vector({-1.12, 0.29, 1.27, 1.95, 0.92}); }

/// A synthesis of an outline that is known: scaled to touch the final design's workspace, its values taken from a dense
/// sample and known to half a unit of the third decimal.
struct KnownSynthesis {
  ReportedSynthesis reported;
  PrescribedWorkspace outline;
};

KnownSynthesis know(const Shape& shape, const std::vector<double>& orientations, bool dextrous) {
  ReportedSynthesis reported{DesignSpace::collinear(samples::thesis_lengths()),
                             {Normalisation::printed, {}},
                             orientations,
                             {},
                             reached_from(),
                             {},
                             reaching(),
                             {},
                             {},
                             0.0};
  if (dextrous) reported.dextrous_range = Interval{orientations.front(), orientations.back()};
  const Manipulator final_design = reported.designs.manipulator(reaching());
  std::vector<Region> regions;
  if (dextrous) {
    regions.push_back(dextrous_workspace(final_design, *reported.dextrous_range));
  } else {
    for (const double phi : orientations) regions.push_back(constant_orientation_workspace(final_design, phi));
  }
  const PrescribedWorkspace unscaled("known", shape, {centre, 1.0, 0.0});
  double scale = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3600; ++i) {
    const double beta = 2.0 * pi * i / 3600.0;
    for (const Region& region : regions) {
      scale = std::min(scale, region.first_exit(centre, beta).value() / unscaled.radius(beta));
    }
  }
  PrescribedWorkspace outline("known", shape, {centre, scale, 0.0});
  const auto smallest = [&](const Eigen::VectorXd& design) {
    const Manipulator manipulator = reported.designs.manipulator(design);
    double value = 1.0;
    for (int i = 0; i < 3600; ++i) {
      for (const double phi : orientations) {
        value = std::min(
            value, kappa_inverse(manipulator, {outline.point(2.0 * pi * i / 3600.0), phi}, reported.conditioning));
      }
    }
    return value;
  };
  const double start = smallest(reached_from());
  const double final_value = smallest(reaching());
  reported.start_value = {start - 5e-4, start + 5e-4};
  reported.final_value = {final_value - 5e-4, final_value + 5e-4};
  return {reported, outline};
}

std::vector<double> radii(const PrescribedWorkspace& outline, const CompatibleOutlines& compatible) {
  std::vector<double> result;
  for (std::size_t i = 0; i < compatible.directions(); ++i) result.push_back(outline.radius(compatible.direction(i)));
  return result;
}

const std::vector<Shape> shapes{Ellipse{{1.75, 1.0}}, Superellipse{{1.3, 1.2}, 3.0},
                                QuarterEllipses{2.0, 2.0, 0.6, 1.1}};

BOOST_AUTO_TEST_SUITE(compatible_outlines)

// An angle of at least gamma between the legs is a disc through both base joints, by the theorem of the inscribed
// angle; from a centre where the angle is right, the largest region ends at two such circles.
BOOST_AUTO_TEST_CASE(two_legs_have_arcs_of_circles) {
  const double gamma = 1.1;
  const CompatibleOutlines compatible(two_leg_synthesis(std::sin(gamma)), {0.0, 1.0}, {90, 4000});
  const double radius = 1.0 / std::sin(gamma);
  const Eigen::Vector2d acute(0.0, 1.0 / std::tan(gamma));
  const Eigen::Vector2d obtuse = -acute;
  for (std::size_t i = 0; i < compatible.directions(); ++i) {
    const double beta = compatible.direction(i);
    double expected = exit_radius({0.0, 1.0}, beta, acute, radius);
    const Eigen::Vector2d w = Eigen::Vector2d(0.0, 1.0) - obtuse;
    const double along = w.dot(unit(beta));
    const double square = along * along - w.squaredNorm() + radius * radius;
    if (along < 0.0 && square > 0.0) expected = std::min(expected, -along - std::sqrt(square));
    BOOST_TEST(compatible.largest()[i] == expected, tolerance(1e-5));
  }
  BOOST_TEST(compatible.largest() == compatible.largest_for_final_design(), boost::test_tools::per_element());
  // Below the base joints the angle is right again, on the other side of the singular line between them.
  BOOST_TEST(compatible.rays_with_gaps() > 0);
}

BOOST_AUTO_TEST_CASE(one_step_and_the_length_limits_alone) {
  ReportedSynthesis reported = two_leg_synthesis(0.0);
  const CompatibleOutlines compatible(reported, {0.0, 1.0}, {12, 1});
  for (std::size_t i = 0; i < 12; ++i) {
    const double beta = compatible.direction(i);
    const double expected =
        std::min(exit_radius({0.0, 1.0}, beta, {-1.0, 0.0}, 10.0), exit_radius({0.0, 1.0}, beta, {1.0, 0.0}, 10.0));
    BOOST_TEST(compatible.workspace()[i] == expected, tolerance(1e-12));
    BOOST_TEST(compatible.largest()[i] == expected, tolerance(1e-12));
  }
  BOOST_TEST(compatible.rays_with_gaps() == 0);
  BOOST_TEST(std::abs(compatible.attained(compatible.largest()).gap) < 1e-12);
}

BOOST_AUTO_TEST_CASE(the_truth_is_compatible) {
  for (const Shape& shape : shapes) {
    for (const auto& [orientations, dextrous] :
         {std::pair(std::vector<double>{0.0}, false), std::pair(std::vector{-five_degrees, 0.0, five_degrees}, false),
          std::pair(std::vector{-five_degrees, five_degrees}, true)}) {
      const KnownSynthesis known = know(shape, orientations, dextrous);
      const CompatibleOutlines compatible(known.reported, centre, {180, 100});
      const std::vector<double> truth = radii(known.outline, compatible);
      for (std::size_t i = 0; i < truth.size(); ++i) {
        BOOST_TEST(truth[i] <= compatible.largest()[i] + 1e-6);
        BOOST_TEST(compatible.largest()[i] <= compatible.largest_for_final_design()[i]);
        BOOST_TEST(compatible.largest_for_final_design()[i] <= compatible.workspace()[i] + 1e-15);
      }
      BOOST_TEST(compatible.satisfied_by(compatible.attained(compatible.largest())));
      BOOST_TEST(compatible.rays_with_gaps() == 0);
      // What the known outline attains is what was reported, up to what lies between two rays.
      const CompatibleOutlines::Attained attained = compatible.attained(truth);
      BOOST_TEST(std::abs(attained.start_value - known.reported.start_value.upper + 5e-4) < 2e-4);
      BOOST_TEST(std::abs(attained.final_value - known.reported.final_value.upper + 5e-4) < 2e-4);
      BOOST_TEST(std::abs(attained.gap) < 1e-3);
    }
  }
}

BOOST_AUTO_TEST_CASE(values_out_of_reach_are_refuted) {
  KnownSynthesis known = know(shapes[0], {0.0}, false);
  // No outline with the reported f* reaches down to a much smaller f(d^0).
  known.reported.start_value = {0.4, 0.5};
  const CompatibleOutlines compatible(known.reported, centre, {180, 100});
  const CompatibleOutlines::Attained attained = compatible.attained(compatible.largest());
  BOOST_TEST(attained.start_value > 0.5);
  BOOST_TEST(!compatible.satisfied_by(attained));
}

BOOST_AUTO_TEST_CASE(a_rounded_design_stays_compatible) {
  for (const Shape& shape : shapes) {
    KnownSynthesis known = know(shape, {-five_degrees, 0.0, five_degrees}, false);
    Eigen::VectorXd rounded = known.reported.final_design;
    for (Eigen::Index j = 0; j < rounded.size(); ++j) rounded[j] += (j % 2 == 0 ? 4e-3 : -4e-3);
    known.reported.final_design = rounded;
    known.reported.rounding = Eigen::VectorXd::Constant(5, 5e-3);
    const CompatibleOutlines compatible(known.reported, centre, {180, 100});
    const std::vector<double> truth = radii(known.outline, compatible);
    for (std::size_t i = 0; i < truth.size(); ++i) BOOST_TEST(truth[i] <= compatible.largest()[i] + 1e-6);
    BOOST_TEST(compatible.satisfied_by(compatible.attained(compatible.largest())));
  }
}

BOOST_AUTO_TEST_CASE(allowances_widen_the_largest_region) {
  KnownSynthesis known = know(shapes[2], {0.0}, false);
  const CompatibleOutlines exact(known.reported, centre, {180, 100});
  known.reported.rounding = Eigen::VectorXd::Constant(5, 1e-3);
  const CompatibleOutlines rounded(known.reported, centre, {180, 100});
  known.reported.protrusion = 0.01;
  const CompatibleOutlines protruding(known.reported, centre, {180, 100});
  for (std::size_t i = 0; i < exact.directions(); ++i) {
    BOOST_TEST(exact.workspace()[i] < rounded.workspace()[i]);
    BOOST_TEST(rounded.workspace()[i] + 0.0099 < protruding.workspace()[i]);
    BOOST_TEST(exact.largest()[i] <= rounded.largest()[i] + 1e-5);
    BOOST_TEST(rounded.largest()[i] <= protruding.largest()[i] + 1e-5);
  }
}

BOOST_AUTO_TEST_CASE(two_sizes_of_one_outline) {
  const KnownSynthesis single = know(shapes[0], {0.0}, false);
  const KnownSynthesis several = know(shapes[0], {-five_degrees, 0.0, five_degrees}, false);
  const CompatibleOutlines first(single.reported, centre, {180, 100});
  const CompatibleOutlines second(several.reported, centre, {180, 100});
  const double ratio = single.outline.placement().scale / several.outline.placement().scale;
  const auto common = [&](double divisor) {
    return common_outline(std::vector<SizedOutlines>{{&first, 1.0}, {&second, divisor}});
  };
  // The sampled rays may miss the touching point, and the true sizes with it, by very little.
  BOOST_TEST((common(ratio).compatible || common(ratio * 1.0001).compatible || common(ratio / 1.0001).compatible));
  BOOST_TEST(!common(ratio * 1.6).compatible);
  BOOST_TEST(!common(ratio / 1.6).compatible);
  const CommonOutline outline = common(1.25);
  for (std::size_t i = 0; i < outline.radii.size(); ++i) {
    BOOST_TEST(outline.radii[i] == std::min(first.largest()[i], 1.25 * second.largest()[i]), tolerance(1e-14));
  }
  BOOST_TEST(outline.attained.size() == 2U);
}

BOOST_AUTO_TEST_CASE(moving_everything_changes_nothing) {
  const Eigen::Vector2d shift(3.0, -2.0);
  const auto build = [&](const Eigen::Vector2d& by) {
    Manipulator manipulator = make_manipulator({-1.12, 0.29, 1.27, 1.95, 0.92}, samples::thesis_lengths());
    std::vector<Leg> legs = manipulator.legs();
    for (Leg& leg : legs) leg.base_joint += by;
    Eigen::MatrixXd joint_map = Eigen::MatrixXd::Zero(12, 1);
    joint_map(0, 0) = 1.0;
    const DesignSpace designs({"moved", legs}, {"x_C"}, joint_map, Eigen::MatrixXd::Zero(6, 1));
    return CompatibleOutlines({designs,
                               {Normalisation::printed, {}},
                               {0.0},
                               {},
                               one(0.1),
                               {0.8, 0.801},
                               one(0.0),
                               {0.93, 0.931},
                               one(1e-3),
                               0.0},
                              centre + by, {60, 50});
  };
  const CompatibleOutlines here = build({0.0, 0.0});
  const CompatibleOutlines there = build(shift);
  for (std::size_t i = 0; i < here.directions(); ++i) {
    BOOST_TEST(here.largest()[i] == there.largest()[i], tolerance(1e-9));
    BOOST_TEST(here.workspace()[i] == there.workspace()[i], tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(a_centre_out_of_reach_has_no_outline) {
  ReportedSynthesis reported = know(shapes[0], {0.0}, false).reported;
  const CompatibleOutlines compatible(reported, {10.0, 10.0}, {36, 20});
  for (const double radius : compatible.largest()) BOOST_TEST(radius == 0.0);
  BOOST_TEST(!compatible.satisfied_by(compatible.attained(compatible.largest())));
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  const ReportedSynthesis good = two_leg_synthesis(0.5);
  const Eigen::Vector2d origin(0.0, 1.0);
  const auto refuses = [&](auto&& change) {
    ReportedSynthesis bad = good;
    change(bad);
    BOOST_CHECK_THROW(CompatibleOutlines(bad, origin, {12, 5}), std::invalid_argument);
  };
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  refuses([](ReportedSynthesis& bad) { bad.orientations.clear(); });
  refuses([&](ReportedSynthesis& bad) { bad.orientations = {not_a_number}; });
  refuses([](ReportedSynthesis& bad) { bad.start = Eigen::VectorXd::Zero(2); });
  refuses([&](ReportedSynthesis& bad) { bad.final_design = one(not_a_number); });
  refuses([](ReportedSynthesis& bad) { bad.rounding = one(-1e-3); });
  refuses([](ReportedSynthesis& bad) { bad.rounding = Eigen::VectorXd::Zero(3); });
  refuses([](ReportedSynthesis& bad) { bad.start_value = {0.6, 0.5}; });
  refuses([&](ReportedSynthesis& bad) { bad.final_value = {not_a_number, 1.0}; });
  refuses([](ReportedSynthesis& bad) { bad.protrusion = -1.0; });
  BOOST_CHECK_THROW(CompatibleOutlines(good, {not_a_number, 0.0}, {12, 5}), std::invalid_argument);
  BOOST_CHECK_THROW(CompatibleOutlines(good, origin, {2, 5}), std::invalid_argument);
  BOOST_CHECK_THROW(CompatibleOutlines(good, origin, {12, 0}), std::invalid_argument);
  const CompatibleOutlines twelve(good, origin, {12, 5});
  const CompatibleOutlines thirteen(good, origin, {13, 5});
  BOOST_CHECK_THROW(static_cast<void>(twelve.attained(thirteen.largest())), std::invalid_argument);
  BOOST_CHECK_THROW(static_cast<void>(common_outline({})), std::invalid_argument);
  BOOST_CHECK_THROW(static_cast<void>(common_outline(std::vector<SizedOutlines>{{&twelve, 1.0}, {&thirteen, 1.0}})),
                    std::invalid_argument);
  BOOST_CHECK_THROW(static_cast<void>(common_outline(std::vector<SizedOutlines>{{&twelve, 0.0}})),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
