// Exact workspaces, held against closed forms, invariances, a certified bracket of the area, and the chord method.

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "reprise/workspace/region_vertices.hpp"
#include "reprise/workspace/trace.hpp"
#include "sample_count.hpp"
#include "workspace/families.hpp"
#include "workspace/samples.hpp"
#include "workspace/slices.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

/// A manipulator whose legs all end at P, so that it allows an annulus about each base joint.
Manipulator annuli(const std::vector<std::pair<Eigen::Vector2d, Interval>>& legs) {
  std::vector<Leg> list;
  for (const auto& [base_joint, length] : legs) list.push_back(leg_at(base_joint, length));
  return {"annuli", list};
}

struct Bracket {
  double lower;
  double upper;
};

/// A bracket of the area that is certain, since the limits are 1-Lipschitz: with s the largest limit at a square's
/// centre, the square is inside when s <= -(half its diagonal), and outside when s > half its diagonal. Others are
/// split, until the bracket is narrow enough or there are too many.
Bracket bracket_area(const Limits& limits) {
  const Eigen::AlignedBox2d box = limits.box();
  if (box.isEmpty()) return {0.0, 0.0};
  std::vector<Eigen::Vector2d> open{box.center()};
  double half = 0.5 * box.sizes().maxCoeff();
  double inside = 0.0;
  Eigen::VectorXd h(limits.count());
  while (true) {
    std::vector<Eigen::Vector2d> rest;
    const double area = 4.0 * half * half;
    const double half_diagonal = std::sqrt(2.0) * half;
    for (const Eigen::Vector2d& centre : open) {
      limits.evaluate(centre, h);
      const double largest = h.maxCoeff();
      if (largest <= -half_diagonal) {
        inside += area;
      } else if (largest <= half_diagonal) {
        rest.push_back(centre);
      }
    }
    const double unknown = area * static_cast<double>(rest.size());
    if (unknown <= 0.01 * inside || rest.size() > 30'000 || half < 1e-7) return {inside, inside + unknown};
    half *= 0.5;
    open.clear();
    for (const Eigen::Vector2d& centre : rest) {
      for (const double x : {-half, half}) {
        for (const double y : {-half, half}) open.push_back(centre + Eigen::Vector2d(x, y));
      }
    }
  }
}

struct Sample {
  Manipulator manipulator;
  double orientation;
};

/// So many in Release, see sample_count.hpp.
std::vector<Sample> random_samples(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < test::scaled(count); ++k) {
    Manipulator manipulator = random_manipulator(random);
    samples.push_back({std::move(manipulator), uniform(random, -pi, pi)});
  }
  return samples;
}

/// Manipulators full of tangencies, triple points, coincident curves and touching parts: all joints on a square
/// lattice, lengths that reach from lattice point to lattice point, angles of eighths of a turn.
std::vector<Sample> lattice_samples(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto whole = [&random](int lower, int upper) {
    return std::uniform_int_distribution<int>(lower, upper)(random);
  };
  const auto lattice_angles = [&whole] {
    const double lower = 0.25 * pi * whole(-4, 4);
    return Interval{lower, lower + 0.25 * pi * whole(1, 7)};
  };
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < test::scaled(count); ++k) {
    std::vector<Leg> legs(static_cast<std::size_t>(whole(1, 5)));
    for (Leg& leg : legs) {
      leg.base_joint = Eigen::Vector2d(whole(-2, 2), whole(-2, 2));
      leg.platform_joint = Eigen::Vector2d(whole(-1, 1), whole(-1, 1));
      const int lower = whole(0, 5);
      leg.length = {std::sqrt(lower), std::sqrt(lower + whole(1, 12))};
      if (whole(0, 3) == 0) leg.base_angle = lattice_angles();
      if (whole(0, 3) == 0) leg.platform_angle = lattice_angles();
    }
    samples.push_back({{"lattice", legs}, 0.5 * pi * whole(-2, 2)});
  }
  return samples;
}

/// Moved by u -> R(angle) u * scale + shift, at the orientation phi + angle.
Manipulator moved(const Manipulator& manipulator, double angle, double scale, const Eigen::Vector2d& shift) {
  const Eigen::Rotation2Dd rotation(angle);
  std::vector<Leg> legs = manipulator.legs();
  for (Leg& leg : legs) {
    leg.base_joint = rotation * leg.base_joint * scale + shift;
    leg.platform_joint *= scale;
    leg.length = {leg.length.lower * scale, leg.length.upper * scale};
    if (leg.base_angle) leg.base_angle = Interval{leg.base_angle->lower + angle, leg.base_angle->upper + angle};
  }
  return {"moved", legs};
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_leg_allows_a_disc_or_an_annulus, *boost::unit_test::tolerance(1e-14)) {
  const Region disc = constant_orientation_workspace(annuli({{{1.0, 2.0}, {0.0, 1.5}}}), 0.4);
  BOOST_TEST(disc.area() == 2.25 * pi);
  BOOST_TEST(disc.perimeter() == 3.0 * pi);
  BOOST_TEST(number_of_holes(disc) == 0u);
  const Region ring = constant_orientation_workspace(annuli({{{1.0, 2.0}, {0.5, 1.5}}}), 0.4);
  BOOST_TEST(ring.area() == 2.0 * pi);
  BOOST_TEST(ring.perimeter() == 4.0 * pi);
  BOOST_TEST(ring.components().size() == 1u);
  BOOST_TEST(number_of_holes(ring) == 1u);
  BOOST_TEST(ring.components()[0].outer.edges.size() == 1u);
  const ConstantOrientationLimits limits(annuli({{{1.0, 2.0}, {0.5, 1.5}}}), 0.4);
  BOOST_TEST(vertices(ring, limits).empty());
}

BOOST_AUTO_TEST_CASE(two_legs_allow_a_lens, *boost::unit_test::tolerance(1e-13)) {
  const Region lens = constant_orientation_workspace(annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{1.2, 0.0}, {0.0, 0.7}}}), 0.0);
  BOOST_TEST(lens.area() == lens_area(1.0, 0.7, 1.2));
  BOOST_TEST(lens.components().size() == 1u);
  BOOST_TEST(lens.components()[0].outer.edges.size() == 2u);
}

BOOST_AUTO_TEST_CASE(joint_angle_limits_allow_sectors, *boost::unit_test::tolerance(1e-13)) {
  // Narrow, of half a turn, and wider; the last nearly a full turn.
  for (const double width : {0.4, 2.0, 3.0, pi, 3.5, 5.0, 6.2}) {
    Leg leg = leg_at({0.3, -0.2}, {0.5, 1.25});
    leg.base_angle = Interval{0.7, 0.7 + width};
    const Region sector = constant_orientation_workspace({"sector", {leg}}, 0.3);
    BOOST_TEST(sector.components().size() == 1u);
    BOOST_TEST(number_of_holes(sector) == 0u);
    BOOST_TEST(sector.area() == 0.5 * width * (1.25 * 1.25 - 0.25));
    BOOST_TEST(sector.perimeter() == width * 1.75 + 1.5);
    BOOST_TEST(sector.components()[0].outer.edges.size() == 4u);
    // The same at the platform, where the wedge turns with it.
    leg.platform_angle = leg.base_angle;
    leg.base_angle.reset();
    BOOST_TEST(constant_orientation_workspace({"sector", {leg}}, 0.9).area() == sector.area());
    // Down to the apex: two segments and an arc, or one segment for half a turn.
    leg.length.lower = 0.0;
    const Region whole = constant_orientation_workspace({"sector", {leg}}, 0.9);
    BOOST_TEST(whole.area() == 0.5 * width * 1.25 * 1.25);
    BOOST_TEST(whole.components()[0].outer.edges.size() == (width == pi ? 2u : 3u));
  }
}

BOOST_AUTO_TEST_CASE(m1_has_two_mirror_components_and_four_triple_points) {
  const ConstantOrientationLimits limits(m1(), 0.0);
  const Region region = constant_orientation_workspace(m1(), 0.0);
  BOOST_TEST(std::abs(region.area() - 0.726983276093924) <= 1e-12);
  BOOST_TEST(region.components().size() == 2u);
  BOOST_TEST(number_of_holes(region) == 0u);
  for (const RegionComponent& component : region.components()) {
    BOOST_TEST(component.outer.edges.size() == 4u);
    BOOST_TEST(std::abs(component.outer.signed_area() - 0.5 * region.area()) <= 1e-14);
  }
  const std::vector<RegionVertex> corners = vertices(region, limits);
  BOOST_TEST(corners.size() == 8u);
  std::size_t triple = 0;
  for (const RegionVertex& corner : corners) {
    const Eigen::Vector2d mirrored(corner.position.x(), -corner.position.y());
    BOOST_TEST(std::any_of(corners.begin(), corners.end(), [&](const RegionVertex& other) {
      return (other.position - mirrored).norm() <= 1e-14 && other.limits == corner.limits;
    }));
    if (corner.limits.size() == 2) continue;
    BOOST_TEST(corner.limits.size() == 3u);
    ++triple;
    const double y = std::abs(corner.position.y());
    BOOST_TEST(std::abs(corner.position.x() - 1.0) <= 1e-14);
    BOOST_TEST(std::min(std::abs(y - 1.0), std::abs(y - std::numbers::sqrt3)) <= 1e-14);
  }
  BOOST_TEST(triple == 4u);
}

// A triple point falls apart when the orientation changes by ever so little; the area changes no faster than the
// limits.
BOOST_AUTO_TEST_CASE(the_area_is_continuous_across_triple_points) {
  const double area = constant_orientation_workspace(m1(), 0.0).area();
  for (double step = 1e-17; step < 1e-3; step *= 1.7) {
    for (const double phi : {step, -step}) {
      const Region region = constant_orientation_workspace(m1(), phi);
      BOOST_TEST(std::abs(region.area() - area) <= 20.0 * step + 1e-12, "orientation " << phi << " " << region.area());
    }
  }
}

BOOST_AUTO_TEST_CASE(the_area_is_continuous_across_tangencies_and_coincident_circles) {
  for (double step = 1e-17; step < 1e-3; step *= 1.7) {
    for (const double e : {0.0, step, -step}) {
      const auto area = [](const std::vector<std::pair<Eigen::Vector2d, Interval>>& legs) {
        return constant_orientation_workspace(annuli(legs), 0.0).area();
      };
      const double bound = 20.0 * step + 1e-12;
      // A disc with a hole that touches its rim from within.
      BOOST_TEST(std::abs(area({{{0.0, 0.0}, {0.0, 1.0}}, {{0.5 + e, 0.0}, {0.5, 9.0}}}) - 0.75 * pi) <= bound,
                 "hole " << e);
      // A disc within another, touching.
      BOOST_TEST(std::abs(area({{{0.0, 0.0}, {0.0, 1.0}}, {{0.3, 0.4 + e}, {0.0, 0.5}}}) - 0.25 * pi) <= bound,
                 "disc " << e);
      // Two discs that touch from outside have no area in common.
      BOOST_TEST(area({{{0.0, 0.0}, {0.0, 1.0}}, {{0.9, 1.2 + e}, {0.0, 0.5}}}) <= bound, "outside " << e);
      // Two holes that touch.
      BOOST_TEST(std::abs(area({{{0.0, 0.0}, {0.0, 3.0}}, {{0.6, 0.8 + e}, {1.0, 9.0}}, {{-0.6, -0.8}, {1.0, 9.0}}}) -
                          7.0 * pi) <= bound,
                 "holes " << e);
      // The same disc twice, the same annulus twice.
      BOOST_TEST(std::abs(area({{{0.1, 0.2}, {0.0, 1.0}}, {{0.1 + e, 0.2}, {0.0, 1.0}}}) - pi) <= bound, "twice " << e);
      BOOST_TEST(std::abs(area({{{0.1, 0.2}, {0.5, 1.0}}, {{0.1, 0.2}, {0.5, 1.0 + e}}}) - 0.75 * pi) <= bound,
                 "annulus " << e);
      // Two annuli with one circle in common and nothing else.
      BOOST_TEST(area({{{0.1, 0.2}, {0.5, 1.0}}, {{0.1, 0.2}, {1.0 + e, 2.0}}}) <= bound, "circle " << e);
    }
  }
}

BOOST_AUTO_TEST_CASE(parts_that_touch_are_kept_apart) {
  // A disc without two discs of half its radius that touch each other and its rim: two parts that touch in three
  // points.
  const Region region = constant_orientation_workspace(
      annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{0.0, 0.5}, {0.5, 9.0}}, {{0.0, -0.5}, {0.5, 9.0}}}), 0.0);
  BOOST_TEST(region.area() == 0.5 * pi, tt::tolerance(1e-13));
  BOOST_TEST_REQUIRE(region.components().size() == 2u);
  BOOST_TEST(region.components()[0].outer.signed_area() == 0.25 * pi, tt::tolerance(1e-13));
  BOOST_TEST(region.components()[1].outer.edges.size() == 3u);
  BOOST_TEST(region.contains({0.9, 0.0}));
  BOOST_TEST(!region.contains({0.0, 0.5}));
  // Their three points, each named once.
  const ConstantOrientationLimits limits(
      annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{0.0, 0.5}, {0.5, 9.0}}, {{0.0, -0.5}, {0.5, 9.0}}}), 0.0);
  BOOST_TEST(vertices(region, limits).size() == 3u);
}

BOOST_AUTO_TEST_CASE(narrow_necks_are_open_and_a_point_in_common_is_none) {
  for (const double width : {2e-13, 1e-9, 0.0, -2e-13, -1e-9}) {
    const std::size_t parts = width > 0.0 ? 1 : 2;
    // A disc, and two discs within whose rims are so far apart.
    const double x = 1.0 + 0.5 * width;
    const Region between_discs = constant_orientation_workspace(
        annuli({{{0.0, 0.0}, {0.0, 1.5}}, {{x, 0.0}, {1.0, 9.0}}, {{-x, 0.0}, {1.0, 9.0}}}), 0.0);
    BOOST_TEST(between_discs.components().size() == parts, "discs " << width << " apart");
    // A half of a disc, and a disc so far from its straight edge.
    Leg half = leg_at({0.0, 0.0}, {0.0, 1.5});
    half.base_angle = Interval{0.5 * pi, 1.5 * pi};
    const Region beside_line =
        constant_orientation_workspace({"half", {half, leg_at({-1.0 - width, 0.0}, {1.0, 9.0})}}, 0.0);
    BOOST_TEST(beside_line.components().size() == parts, "disc " << width << " from the line");
    // A disc without another one within, as far from its rim: a ring, which has a hole unless it is pinched.
    const Region ring =
        constant_orientation_workspace(annuli({{{0.0, 0.0}, {0.0, 2.0}}, {{0.0, 1.0 - width}, {1.0, 9.0}}}), 0.0);
    BOOST_TEST(ring.components().size() == 1u);
    BOOST_TEST(number_of_holes(ring) == (width > 0.0 ? 1u : 0u), "ring of width " << width);
  }
}

BOOST_AUTO_TEST_CASE(circles_that_are_hardly_more_than_points_take_no_area) {
  // Legs that end at P, one of them with a wide wedge and a least length that is nearly zero.
  for (const double least : {1e-8, 3e-11, 1e-13}) {
    for (int k = 0; k < scaled(40); ++k) {
      Leg sector = leg_at({0.25, 0.65}, {least, 0.8});
      const double first = -3.0 + 0.15 * k;
      const double sweep = 0.4 + 0.14 * k;
      sector.base_angle = Interval{first, first + sweep};
      const Manipulator manipulator("sector", {sector, leg_at({0.3, 0.6}, {0.0, 5.0})});
      const double area = constant_orientation_workspace(manipulator, -1.0).area();
      BOOST_TEST(std::abs(area - 0.5 * sweep * (0.8 - least) * (0.8 + least)) <= 1e-13, least << " " << sweep);
    }
  }
  const FamilyMember member = family_member(5, 5'039'117);
  Slices slices(member.manipulator, {member.orientation, member.orientation});
  double uncertain = 0.0;
  const double area = slices.area(uncertain);
  const double found = constant_orientation_workspace(member.manipulator, member.orientation).area();
  BOOST_TEST(std::abs(found - area) <= uncertain + 1e-13);
}

// What judges exact regions, where the area is known.
BOOST_AUTO_TEST_CASE(slices_know_closed_forms) {
  const auto area_of = [](const Manipulator& manipulator) {
    double uncertain = 0.0;
    Slices slices(manipulator, {0.3, 0.3});
    const double area = slices.area(uncertain);
    BOOST_TEST(uncertain <= 1e-16);
    return area;
  };
  BOOST_TEST(area_of(annuli({{{1.0, 2.0}, {0.5, 1.5}}})) == 2.0 * pi, tt::tolerance(1e-15));
  BOOST_TEST(area_of(annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{1.2, 0.7}, {0.0, 0.7}}})) ==
                 lens_area(1.0, 0.7, std::hypot(1.2, 0.7)),
             tt::tolerance(1e-13));
  const double e = 1e-7;  // a crescent
  BOOST_TEST(area_of(annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{e, 0.0}, {1.0, 3.0}}})) == 2.0 * e, tt::tolerance(1e-9));
  Leg sector = leg_at({0.25, 0.65}, {0.2, 0.8});
  sector.base_angle = Interval{-2.0, 2.5};
  BOOST_TEST(area_of({"sector", {sector}}) == 0.5 * 4.5 * (0.64 - 0.04), tt::tolerance(1e-14));
}

// Found among 1.3 million random ones: a curve that touches a narrow part, or the outline from within, and workspaces
// much smaller than the numbers they come from.
BOOST_AUTO_TEST_CASE(narrow_parts_that_a_curve_touches_and_tiny_workspaces_have_their_area) {
  for (const std::size_t number :
       {249u, 3144u, 12203u, 19783u, 22689u, 24548u, 25106u, 28223u, 29266u, 1'019'927u, 1'044'681u}) {
    const FamilyMember member = family_member(9, number);
    Slices slices(member.manipulator, {member.orientation, member.orientation});
    double uncertain = 0.0;
    const double area = slices.area(uncertain);
    const double promised = 1e-12 * slices.extent() * slices.extent();
    BOOST_TEST(uncertain <= 0.1 * area);
    const Region region = constant_orientation_workspace(member.manipulator, member.orientation);
    BOOST_TEST(std::abs(region.area() - area) <= uncertain + promised, number << ": " << region.area() << " " << area);
  }
}

// Found among 20,000 random ones: a platform joint so near the working point that the circles about the ends of its arc
// and about the base joint nearly coincide, and a circle whose radius, the difference of two lengths that are the same,
// is zero in one precision and not in another.
BOOST_AUTO_TEST_CASE(dextrous_workspaces_with_circles_that_nearly_coincide_or_are_points_have_their_area) {
  const std::vector<std::pair<std::size_t, std::size_t>> cases{{2, 1'001'510}, {2, 1'001'583}, {2, 1'004'367},
                                                               {2, 1'007'602}, {2, 1'009'071}, {1, 1'001'896},
                                                               {1, 1'002'338}, {2, 1'004'484}};
  for (const auto& [family, number] : cases) {
    const FamilyMember member = family_member(family, number);
    Slices slices(member.manipulator, member.range);
    double uncertain = 0.0;
    const double area = slices.area(uncertain);
    const double promised = 1e-12 * slices.extent() * slices.extent();
    BOOST_TEST(uncertain <= 0.1 * promised);
    const Region region = dextrous_workspace(member.manipulator, member.range);
    BOOST_TEST(std::abs(region.area() - area) <= promised, number << ": " << region.area() << " " << area);
  }
}

// Two random cases whose parts hang together by a neck that no slice shows. With 50 digits: leg 2's circle lies within
// leg 5's, and leg 1's beside leg 3's, with 4.0e-15 and 1.1e-14 between them. The header closes what is that narrow,
// and a neck that is wider is open.
BOOST_AUTO_TEST_CASE(necks_are_closed_below_what_the_header_says_and_open_above) {
  using Real = boost::multiprecision::cpp_bin_float_50;
  struct Case {
    std::size_t number;
    std::size_t inner;  ///< its least length is one side of the neck
    std::size_t other;
    bool is_around;  ///< whether the other's greatest length is the other side; else its least one is
    double gap;
  };
  for (const Case& one : {Case{39330, 1, 4, true, 4.031042e-15}, Case{68393, 0, 2, false, 1.087278e-14}}) {
    const FamilyMember member = family_member(2, one.number);
    const auto centre = [&](std::size_t i) {
      const Leg& leg = member.manipulator.leg(i);
      const Real c = cos(Real(member.orientation));
      const Real s = sin(Real(member.orientation));
      const Real x = leg.platform_joint.x();
      const Real y = leg.platform_joint.y();
      return std::pair<Real, Real>(leg.base_joint.x() - (c * x - s * y), leg.base_joint.y() - (s * x + c * y));
    };
    const auto [x, y] = centre(one.inner);
    const auto [other_x, other_y] = centre(one.other);
    const Real apart = sqrt((x - other_x) * (x - other_x) + (y - other_y) * (y - other_y));
    const Real least = member.manipulator.leg(one.inner).length.lower;
    const Interval& length = member.manipulator.leg(one.other).length;
    const Real gap = one.is_around ? Real(length.upper - apart - least) : Real(apart - least - length.lower);
    BOOST_TEST(static_cast<double>(gap) == one.gap, tt::tolerance(1e-6));
    BOOST_TEST(constant_orientation_workspace(member.manipulator, member.orientation).components().size() == 2u);
    Slices slices(member.manipulator, {member.orientation, member.orientation});
    BOOST_TEST(!slices.topology());
    std::vector<Leg> wider = member.manipulator.legs();
    wider[one.inner].length.lower -= 1e-12;
    const Region joined = constant_orientation_workspace({"wider", wider}, member.orientation);
    BOOST_TEST(joined.components().size() == 1u);
  }
}

// A hole that touches the outline from within is a hole where it is open, or a bay; it is not filled.
BOOST_AUTO_TEST_CASE(a_hole_that_touches_the_outline_is_not_filled) {
  for (const double apart : {-1e-10, -1e-14, -1e-15, 0.0, 1e-15, 1e-14, 1e-10}) {
    for (int k = 0; k < scaled(24); ++k) {
      const Eigen::Vector2d towards = test::unit(0.1 + 0.26 * k);
      const double radius = 1.3;
      const Manipulator manipulator =
          annuli({{{0.2, 0.1}, {0.0, 2.0}},
                  {{0.2, 0.1}, {0.9, 2.0 + 1e-12}},
                  {Eigen::Vector2d(0.2, 0.1) + (2.0 - radius + apart) * towards, {radius, 9.0}}});
      // Outside of both circles: the disc of .9 lies in part outside of that of 1.3.
      const double expected = pi * (4.0 - radius * radius - 0.81) + lens_area(radius, 0.9, 2.0 - radius);
      const double area = constant_orientation_workspace(manipulator, 0.0).area();
      BOOST_TEST(std::abs(area - expected) <= 1e-11 + 10.0 * std::abs(apart),
                 apart << ", " << k << ": " << area << " " << expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_leg_that_restricts_nothing_changes_nothing) {
  const double area = constant_orientation_workspace(m1(), 0.2).area();
  for (const double reach : {10.0, 1e3, 1e6, 1e9}) {
    std::vector<Leg> legs = m1().legs();
    legs.push_back(leg_at({-0.5, 0.25}, {0.0, reach}));
    BOOST_TEST(constant_orientation_workspace({"M1 and a free leg", legs}, 0.2).area() == area, tt::tolerance(1e-13));
  }
}

// Coordinates near 500000 hold the same numbers as near 0, since all of them are binary fractions.
BOOST_AUTO_TEST_CASE(the_distance_from_the_origin_does_not_matter) {
  std::mt19937 random(20);
  const auto binary = [](double value) { return std::round(value * 1048576.0) / 1048576.0; };
  for (int sample = 0; sample < test::scaled(60); ++sample) {
    std::vector<Leg> legs = test::random_manipulator(random).legs();
    for (Leg& leg : legs) leg.base_joint = leg.base_joint.unaryExpr(binary);
    const Eigen::Vector2d shift(500000.0, sample % 2 == 0 ? 0.0 : -3000000.0);
    std::vector<Leg> far = legs;
    for (Leg& leg : far) leg.base_joint += shift;
    const Interval range{-0.1, 0.2};
    const Region here = dextrous_workspace({"here", legs}, range);
    const Region there = dextrous_workspace({"there", far}, range);
    BOOST_TEST(std::abs(there.area() - here.area()) <= 1e-8);
    BOOST_TEST(there.components().size() == here.components().size());
    const Region slice = constant_orientation_workspace({"here", legs}, 0.3);
    const Region far_slice = constant_orientation_workspace({"there", far}, 0.3);
    BOOST_TEST(std::abs(far_slice.area() - slice.area()) <= 1e-8);
    const auto corners = vertices(slice, ConstantOrientationLimits({"here", legs}, 0.3));
    const auto images = vertices(far_slice, ConstantOrientationLimits({"there", far}, 0.3));
    BOOST_TEST_REQUIRE(corners.size() == images.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      BOOST_TEST((images[k].position - shift - corners[k].position).norm() <= 1e-9);
      BOOST_TEST(images[k].limits == corners[k].limits);
    }
  }
  // Two legs given by their numbers, and where they have their area from: the same about the origin.
  const auto two = [](double x) {
    return Manipulator(
        "two", {Leg{{x, 0.0}, {0.5, 0.0}, {0.5, 1.5}, {}, {}}, Leg{{x + 1.0, 0.0}, {-0.3, 0.2}, {0.5, 1.6}, {}, {}}});
  };
  const Interval degrees{10.0 * pi / 180.0, 10.3 * pi / 180.0};
  const double area = dextrous_workspace(two(0.0), degrees).area();
  BOOST_TEST(area == 1.99174, tt::tolerance(1e-5));
  BOOST_TEST(dextrous_workspace(two(500000.0), degrees).area() == area, tt::tolerance(1e-8));
}

// The only circle left passes through the one point that a leg of length zero leaves.
BOOST_AUTO_TEST_CASE(a_leg_without_length_leaves_no_area) {
  for (const double angle : {0.0, 0.7, 2.0}) {
    const Eigen::Vector2d joint = 1.2087 * unit(angle);
    const Manipulator fixed("fixed", {Leg{{6.125, 0.0}, joint, {0.0, 0.0}, {}, {}}});
    for (const double orientation : {0.0, -0.7, 1.1}) {
      BOOST_TEST(dextrous_workspace(fixed, {orientation, orientation}).empty());
      BOOST_TEST(dextrous_workspace(fixed, {orientation, orientation + 0.5}).empty());
      BOOST_TEST(constant_orientation_workspace(fixed, orientation).empty());
    }
  }
}

// Random manipulators of families that are nearly degenerate: nearly equal legs, nearly equal length limits, units of
// 10^4, far from the origin, straight wedges, circles that nearly coincide. Their areas were found by integrals in
// polar coordinates about the first leg's centre, to 13 digits.
BOOST_AUTO_TEST_CASE(nearly_degenerate_workspaces_have_the_areas_of_polar_integrals_and_slices) {
  struct Case {
    Manipulator manipulator;
    double orientation;
    double area;
  };
  const std::vector<Case> cases{
      {{"near",
        {Leg{{1.388320713441078, 0.28650101427335239},
             {0.061299159343141785, 0.014149079945785292},
             {0.038406000682638816, 2.1906104187304973},
             {},
             Interval{2.0201292470794199, 6.6217322355870403}},
         Leg{{1.2504810823473802, 0.9939491007502923},
             {-0.20603111404170688, 0.47731831699566329},
             {0.30488735903224945, 1.6960337380754911},
             Interval{-6.0461114559023317, -1.7388990700163713},
             {}},
         Leg{{0.29068038075998204, 0},
             {0.46821565959759914, 0.10032076343155449},
             {0.56571013065567288, 1.593762088552539},
             Interval{1.7729729059723323, 4.5044045224164782},
             Interval{5.384217112520048, 7.4355361535766367}}}},
       -2.8281198365650817,
       0.5763642372977},
      {{"near",
        {Leg{{-0.51427456318402975, -0.87833946366077842},
             {0.23240350085758099, -0.31069181787753936},
             {0.024881485941632198, 0.68578725984569711},
             {},
             Interval{-0.21372796051674881, 3.6739337616732759}},
         Leg{{-0.51427426744817673, -0.87833946366077842},
             {0.23240350101661761, -0.31069181787753936},
             {0.024881485941632198, 0.68578725984569711},
             {},
             Interval{-0.21372796051674881, 3.6739337616732759}}}},
       -1.1273574126887502,
       0.912987945036},
      {{"near",
        {Leg{{-0.78764586862827313, -1.0584497505353232},
             {0.47431086047110405, -0.0016857699531268588},
             {1.160018072865969, 1.1600188134978546},
             Interval{-0.44864666735532555, 4.6479573880338032},
             Interval{-5.9811805373139038, -1.0631643356797387}},
         Leg{{0.82704642528748495, -1.3108372108828839},
             {0.47771102009347499, 0},
             {1.1408868155903173, 2.3111347828371676},
             Interval{1.5339118464628467, 6.1461376979794586},
             Interval{-3.4029793299645088, 1.610801387767046}}}},
       3.1695525170042913,
       1.371256998032e-06},
      {{"near",
        {Leg{{0.21875220928753336, -1.1754232882178413},
             {0, 0},
             {0.93703521351787178, 2.7676281728251788},
             {},
             Interval{3.1173106772257593, 4.2212795351504138}},
         Leg{{-1.3760933533328581, -1.3826891313582252},
             {0, 0},
             {0.0015946194891812038, 1.6762971063281997},
             {},
             Interval{1.8682231435502954, 3.9940595582877352}},
         Leg{{0.62507882772857171, 0},
             {0, 0},
             {0, 0.8813197148812637},
             Interval{0.98853556329027126, 5.0716217785289341},
             {}}}},
       -1.5901583795992715,
       0.01044241723895},
      {{"near",
        {Leg{{-13968.994887830679, -7442.8490245487055},
             {2101.4574397644478, 0},
             {10194.559026104258, 22202.443923252678},
             {},
             {}},
         Leg{{4898.6827311893021, -2308.6932736716822},
             {-6673.3469925768277, 953.87517173730862},
             {10720.571139946678, 36519.3271555885},
             {},
             Interval{-8.0284121420379755, -2.1770516463990823}}}},
       0.047246136348837009,
       669006811.2017},
      {{"near",
        {Leg{{999999.2007786677, 343693.68658550573},
             {-0.46427111223715023, 0.094285211215966225},
             {0, 1.4926092643111639},
             {},
             {}},
         Leg{{1000000.1660784447, 343694.00394621771},
             {-0.32339254951275548, -0.098732785356084873},
             {0.39602535666749683, 1.9228026378031209},
             {},
             Interval{-4.6864635863777266, -3.3643424456543314}}}},
       2.4938701232234717,
       0.9840710026387},
      {{"near",
        {Leg{{-1.3640904784336252, 0},
             {0.5546133544630899, 0.078652109441048834},
             {0.74870434383774931, 1.7694523560652169},
             Interval{-1.5707963267948966, 1.5707957377864354},
             {}},
         Leg{{-0.4425297012148941, 0},
             {0.32627614037479069, 0.14034724103741358},
             {0.53333862480427863, 1.7589171444600982},
             Interval{-1.0248360555507463, 5.2583492440235116},
             {}}}},
       2.3406843671218898,
       3.264246055149},
      {{"near",
        {Leg{{0.5, -0.5}, {-0.5, 0}, {0, 2}, {}, Interval{-1.5707963267948966, 3.141592653589794}},
         Leg{{0.49999901467991947, -0.5},
             {-0.5, 0},
             {2.7525627560035496e-10, 1.9999999991813378},
             {},
             Interval{-1.5707963267948966, 3.141592653589794}}}},
       3.1415926535897931,
       9.424774016916},
  };
  for (const Case& one : cases) {
    double uncertain = 0.0;
    test::Slices slices(one.manipulator, {one.orientation, one.orientation});
    const double area = slices.area(uncertain);
    const double allowed = 1e-12 * slices.extent() * slices.extent();
    BOOST_TEST(uncertain <= 0.1 * allowed);
    const Region region = constant_orientation_workspace(one.manipulator, one.orientation);
    BOOST_TEST(std::abs(region.area() - one.area) <= allowed, region.area() << " " << one.area);
    BOOST_TEST(std::abs(region.area() - area) <= allowed, region.area() << " " << area);
    BOOST_TEST(std::abs(dextrous_workspace(one.manipulator, {one.orientation, one.orientation}).area() - area) <=
               allowed);
    if (const auto topology = slices.topology()) {
      BOOST_TEST(region.components().size() == topology->components);
      BOOST_TEST(number_of_holes(region) == topology->holes);
    }
  }
}

// A crescent between two circles of radius 1 that are ever so little apart has the area 2 e, until it is too narrow.
BOOST_AUTO_TEST_CASE(crescents_have_their_area_however_narrow_they_are) {
  for (const double e : {1e-3, 1e-6, 1e-9, 1e-11, 1e-13, 1e-14, 1e-15}) {
    const Region region =
        constant_orientation_workspace(annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{e, 0.0}, {1.0, 3.0}}}), 0.0);
    BOOST_TEST(std::abs(region.area() - 2.0 * e) <= 1e-13 + e * e * e);
    if (e >= 1e-12) BOOST_TEST(region.components().size() == 1u, e);
    BOOST_TEST(number_of_holes(region) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(lengths_whose_products_overflow_are_refused) {
  for (const double length : {1e71, 1e100, 1e120}) {
    const Manipulator huge("huge", {Leg{{0.0, 0.0}, {0.0, 0.0}, {0.0, length}, Interval{0.0, 1.0}, {}}});
    BOOST_CHECK_THROW(constant_orientation_workspace(huge, 0.0), std::invalid_argument);
    BOOST_CHECK_THROW(dextrous_workspace(huge, {0.0, 0.1}), std::invalid_argument);
  }
  const Manipulator large("large", {Leg{{0.0, 0.0}, {0.0, 0.0}, {0.0, 1e60}, Interval{0.0, 1.0}, {}}});
  BOOST_TEST(constant_orientation_workspace(large, 0.0).area() == 0.5e120, tt::tolerance(1e-12));
}

// A hundred circles that all pass near the rim of a disc: the region is that of the three that bound it.
BOOST_AUTO_TEST_CASE(a_hundred_legs_are_quick) {
  std::vector<Leg> legs;
  for (int k = 0; k < 100; ++k) {
    const double angle = 2.0 * pi * k / 100.0;
    legs.push_back(Leg{unit(angle), 0.2 * unit(2.0 * angle), {0.2, 1.9}, Interval{angle + 1.8, angle + 4.5}, {}});
  }
  const Manipulator manipulator("hundred", legs);
  const Region region = dextrous_workspace(manipulator, {-0.05, 0.05});
  const Bracket bracket = bracket_area(DextrousLimits(manipulator, {-0.05, 0.05}));
  BOOST_TEST(region.area() >= bracket.lower - 1e-12);
  BOOST_TEST(region.area() <= bracket.upper + 1e-12);
  BOOST_TEST(!region.empty());
}

BOOST_AUTO_TEST_CASE(workspaces_that_are_empty) {
  BOOST_TEST(constant_orientation_workspace(annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{5.0, 0.0}, {0.0, 1.0}}}), 0.0).empty());
  BOOST_TEST(constant_orientation_workspace(annuli({{{0.0, 0.0}, {0.0, 1.0}}, {{0.1, 0.0}, {2.0, 3.0}}}), 0.0).empty());
  BOOST_TEST(constant_orientation_workspace(annuli({{{0.0, 0.0}, {1.0, 1.0}}}), 0.0).empty());
}

BOOST_AUTO_TEST_CASE(an_orientation_that_is_not_finite_is_refused) {
  BOOST_CHECK_THROW(constant_orientation_workspace(m1(), std::numeric_limits<double>::quiet_NaN()),
                    std::invalid_argument);
  BOOST_CHECK_THROW(constant_orientation_workspace(m1(), std::numeric_limits<double>::infinity()),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(workspaces_move_and_grow_with_their_manipulators) {
  std::mt19937 random(3);
  for (const Sample& sample : random_samples(200, 4)) {
    const Region region = constant_orientation_workspace(sample.manipulator, sample.orientation);
    const double angle = uniform(random, -3.0, 3.0);
    const double scale = std::exp(uniform(random, -3.0, 3.0));
    const Eigen::Vector2d shift = scale * uniform_point(random, 2.0);
    const Manipulator other = moved(sample.manipulator, angle, scale, shift);
    const Region image = constant_orientation_workspace(other, sample.orientation + angle);
    BOOST_TEST(image.components().size() == region.components().size());
    BOOST_TEST(number_of_holes(image) == number_of_holes(region));
    BOOST_TEST(std::abs(image.area() / (scale * scale) - region.area()) <= 1e-12);
    BOOST_TEST(std::abs(image.perimeter() / scale - region.perimeter()) <= 1e-11);
    const auto corners = vertices(region, ConstantOrientationLimits(sample.manipulator, sample.orientation));
    const auto images = vertices(image, ConstantOrientationLimits(other, sample.orientation + angle));
    BOOST_TEST(corners.size() == images.size());
    for (const RegionVertex& corner : corners) {
      const Eigen::Vector2d expected = Eigen::Rotation2Dd(angle) * corner.position * scale + shift;
      BOOST_TEST(std::any_of(images.begin(), images.end(), [&](const RegionVertex& vertex) {
        return (vertex.position - expected).norm() <= 1e-11 * scale && vertex.limits == corner.limits;
      }));
    }
  }
}

BOOST_AUTO_TEST_CASE(edges_join_and_their_limits_are_active) {
  std::vector<Sample> samples = random_samples(300, 5);
  const std::vector<Sample> degenerate = lattice_samples(300, 11);
  samples.insert(samples.end(), degenerate.begin(), degenerate.end());
  for (const Sample& sample : samples) {
    const ConstantOrientationLimits limits(sample.manipulator, sample.orientation);
    const Region region = constant_orientation_workspace(sample.manipulator, sample.orientation);
    Eigen::VectorXd h(limits.count());
    for (const BoundaryLoop& loop : loops(region)) {
      for (std::size_t k = 0; k < loop.edges.size(); ++k) {
        const BoundaryEdge& edge = loop.edges[k];
        BOOST_TEST(edge.end == loop.edges[(k + 1) % loop.edges.size()].start);
        BOOST_TEST((edge.at(0.0) - edge.start).norm() <= 1e-12);
        BOOST_TEST((edge.at(1.0) - edge.end).norm() <= 1e-12);
        limits.evaluate(edge.at(0.5), h);
        BOOST_TEST(std::abs(h[edge.limit]) <= 1e-13);
      }
      double farthest = 0.0;
      for (const Eigen::Vector2d& point : loop.sample(0.05)) {
        farthest = std::max(farthest, std::abs(largest_limit(limits, point)));
      }
      BOOST_TEST(farthest <= 1e-11);
    }
    for (const RegionVertex& vertex : vertices(region, limits)) BOOST_TEST(vertex.limits.size() >= 1u);
  }
}

BOOST_AUTO_TEST_CASE(points_are_inside_when_all_limits_are_met) {
  std::mt19937 random(6);
  for (const Sample& sample : random_samples(200, 7)) {
    const ConstantOrientationLimits limits(sample.manipulator, sample.orientation);
    const Region region = constant_orientation_workspace(sample.manipulator, sample.orientation);
    const Eigen::AlignedBox2d box = limits.box();
    if (box.isEmpty()) {
      BOOST_TEST(region.empty());
      continue;
    }
    std::vector<Eigen::Vector2d> boundary;
    constexpr double spacing = 0.01;
    for (const BoundaryLoop& loop : loops(region)) {
      const std::vector<Eigen::Vector2d> points = loop.sample(spacing);
      boundary.insert(boundary.end(), points.begin(), points.end());
    }
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector2d unit_point = uniform_point(random);
      const Eigen::Vector2d u = box.center() + 0.6 * unit_point.cwiseProduct(box.sizes());
      const double largest = largest_limit(limits, u);
      if (std::abs(largest) < 1e-9) continue;
      BOOST_TEST(region.contains(u) == (largest < 0.0));
      if (region.empty()) continue;
      const double distance = region.distance_to_boundary(u);
      // The limits are 1-Lipschitz.
      BOOST_TEST(distance >= std::abs(largest) - 1e-12);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& point : boundary) nearest = std::min(nearest, (point - u).norm());
      BOOST_TEST(distance <= nearest + 1e-12);
      BOOST_TEST(nearest <= distance + 0.5 * spacing);
    }
  }
}

BOOST_AUTO_TEST_CASE(rays_exit_where_the_chord_method_begins) {
  std::mt19937 random(8);
  std::size_t compared = 0;
  for (const Sample& sample : random_samples(200, 9)) {
    const ConstantOrientationLimits limits(sample.manipulator, sample.orientation);
    const InteriorPoint start = find_interior_point(limits);
    if (start.status != InteriorStatus::found) continue;
    const Region region = constant_orientation_workspace(sample.manipulator, sample.orientation);
    for (int k = 0; k < 5; ++k) {
      const double beta = uniform(random, -pi, pi);
      TraceOptions options;
      options.first_direction = unit(beta);
      options.max_points = 1;
      const TracedBoundary boundary = trace_boundary(limits, start.position, options);
      if (boundary.points.empty()) continue;
      const auto exit = region.first_exit(start.position, beta);
      BOOST_TEST_REQUIRE(exit.has_value());
      BOOST_TEST(*exit == (boundary.points.front().position - start.position).norm(), tt::tolerance(1e-9));
      ++compared;
    }
  }
  BOOST_TEST(compared >= test::scaled_minimum(300u));
}

BOOST_AUTO_TEST_CASE(degenerate_areas_lie_within_certified_brackets) {
  std::size_t nonempty = 0;
  for (const Sample& sample : lattice_samples(600, 12)) {
    const ConstantOrientationLimits limits(sample.manipulator, sample.orientation);
    const Region region = constant_orientation_workspace(sample.manipulator, sample.orientation);
    const Bracket bracket = bracket_area(limits);
    BOOST_TEST(region.area() >= bracket.lower - 1e-12);
    BOOST_TEST(region.area() <= bracket.upper + 1e-12);
    if (!region.empty()) ++nonempty;
    // Whatever the decisions at degenerate points, a rigid motion that rounds otherwise must not change the region.
    const Manipulator other = moved(sample.manipulator, 0.3, 1.0, {0.1, -0.7});
    const Region image = constant_orientation_workspace(other, sample.orientation + 0.3);
    BOOST_TEST(std::abs(image.area() - region.area()) <= 1e-12);
    BOOST_TEST(std::abs(image.perimeter() - region.perimeter()) <= 1e-6);
    BOOST_TEST(image.components().size() == region.components().size());
    BOOST_TEST(number_of_holes(image) == number_of_holes(region));
  }
  BOOST_TEST(nonempty >= test::scaled_minimum(200u));
}

BOOST_AUTO_TEST_CASE(dextrous_areas_lie_within_certified_brackets) {
  std::mt19937 random(13);
  std::size_t nonempty = 0;
  for (const Sample& sample : random_samples(500, 14)) {
    const double width = std::pow(uniform(random, 0.0, 1.0), 3.0) * 1.9 * pi;
    const Interval orientations{sample.orientation, sample.orientation + width};
    const Region region = dextrous_workspace(sample.manipulator, orientations);
    const Bracket bracket = bracket_area(DextrousLimits(sample.manipulator, orientations));
    BOOST_TEST(region.area() >= bracket.lower - 1e-12);
    BOOST_TEST(region.area() <= bracket.upper + 1e-12);
    if (!region.empty()) ++nonempty;
  }
  BOOST_TEST(nonempty >= test::scaled_minimum(150u));
}

BOOST_AUTO_TEST_CASE(areas_lie_within_certified_brackets_and_agree_with_traced_ones) {
  std::size_t nonempty = 0;
  std::size_t narrow = 0;
  std::size_t several = 0;
  std::size_t with_holes = 0;
  std::size_t with_segments = 0;
  std::size_t traced = 0;
  constexpr double chord = 0.005;
  for (const Sample& sample : random_samples(400, 10)) {
    const ConstantOrientationLimits limits(sample.manipulator, sample.orientation);
    const Region region = constant_orientation_workspace(sample.manipulator, sample.orientation);
    const Bracket bracket = bracket_area(limits);
    const double rounding = 1e-12;
    BOOST_TEST(region.area() >= bracket.lower - rounding);
    BOOST_TEST(region.area() <= bracket.upper + rounding);
    if (region.empty()) continue;
    ++nonempty;
    if (bracket.upper - bracket.lower <= 0.011 * bracket.upper) ++narrow;
    if (region.components().size() > 1) ++several;
    if (number_of_holes(region) > 0) ++with_holes;
    const std::vector<BoundaryLoop> all = loops(region);
    const bool straight = std::any_of(all.begin(), all.end(), [](const BoundaryLoop& loop) {
      return std::any_of(loop.edges.begin(), loop.edges.end(), [](const BoundaryEdge& edge) { return !edge.is_arc(); });
    });
    if (straight) ++with_segments;

    TraceOptions options;
    options.chord = chord;
    const TracedBoundary boundary = trace_boundary(limits, options);
    if (!boundary.closed()) continue;
    // The loop that was traced is the one that the first point is on.
    const auto loop_distance = [&](const BoundaryLoop& loop) {
      return Region({{loop, {}}}).distance_to_boundary(boundary.points.front().position);
    };
    const auto loop = std::min_element(all.begin(), all.end(), [&](const BoundaryLoop& a, const BoundaryLoop& b) {
      return loop_distance(a) < loop_distance(b);
    });
    const double error = signed_area(boundary.positions()) - loop->signed_area();
    BOOST_TEST(std::abs(error) <= 5.0 * chord * chord, sample.manipulator.size()
                                                           << " legs, traced " << signed_area(boundary.positions())
                                                           << " exact " << loop->signed_area());
    ++traced;
  }
  BOOST_TEST_MESSAGE(nonempty << " not empty, " << narrow << " narrow, " << several << " with several components, "
                              << with_holes << " with holes, " << with_segments << " with segments, " << traced
                              << " traced");
  BOOST_TEST(nonempty >= test::scaled_minimum(200u));
  BOOST_TEST(narrow >= test::scaled_minimum(190u));
  BOOST_TEST(several >= test::scaled_minimum(20u));
  BOOST_TEST(with_holes >= test::scaled_minimum(20u));
  BOOST_TEST(with_segments >= test::scaled_minimum(20u));
  BOOST_TEST(traced >= test::scaled_minimum(190u));
}
