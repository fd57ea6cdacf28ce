#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/prescribed_workspace.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

/// Area by the polar formula, exact in the limit; the midpoint rule keeps clear of corners.
double polar_area(const PrescribedWorkspace& workspace, int sectors) {
  double area = 0.0;
  for (int i = 0; i < sectors; ++i) {
    const double radius = workspace.radius((i + 0.5) * 2.0 * pi / sectors);
    area += 0.5 * radius * radius * 2.0 * pi / sectors;
  }
  return area;
}

/// The square with corners on the axes, whose outline is |x| + |y| = 1.
Polygon diamond() { return {{{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}}; }

BOOST_AUTO_TEST_SUITE(prescribed_workspace)

BOOST_AUTO_TEST_CASE(areas_agree_with_closed_forms) {
  BOOST_TEST(polar_area({"circle", Circle{0.7}}, 1000) == pi * 0.49, tolerance(1e-12));
  BOOST_TEST(polar_area({"ellipse", Ellipse{{1.75, 1.0}}}, 1000) == pi * 1.75, tolerance(1e-12));
  BOOST_TEST(polar_area({"rectangle", Rectangle{2.0, 0.5}}, 200000) == 1.0, tolerance(1e-8));
  BOOST_TEST(polar_area({"diamond", diamond()}, 200000) == 2.0, tolerance(1e-8));
  BOOST_TEST(polar_area({"quarters", QuarterEllipses{2.0, 2.0, 0.3, 1.14}}, 200000) == pi / 4.0 * 2.3 * 3.14,
             tolerance(1e-8));
  // |x/a|^p + |y/b|^p <= 1 has the area 4 a b Gamma(1 + 1/p)^2 / Gamma(1 + 2/p).
  const double p = 2.5;
  const double exact = 4.0 * 1.42 * 1.185 * std::pow(std::tgamma(1.0 + 1.0 / p), 2) / std::tgamma(1.0 + 2.0 / p);
  BOOST_TEST(polar_area({"superellipse", Superellipse{{1.42, 1.185}, p}}, 20000) == exact, tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(outline_points_satisfy_the_shape_equation) {
  const PrescribedWorkspace workspace("P", Superellipse{{1.42, 1.185}, 2.5}, {{1.0, 1.5}, 0.2, 0.0});
  for (const double beta : workspace.angles(97)) {
    const Eigen::Vector2d local = (workspace.point(beta) - Eigen::Vector2d(1.0, 1.5)) / 0.2;
    const double value = std::pow(std::abs(local.x()) / 1.42, 2.5) + std::pow(std::abs(local.y()) / 1.185, 2.5);
    BOOST_TEST(value == 1.0, tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(outline_has_exact_derivatives) {
  const Placement placed{{1.0, 1.5}, 0.3, 0.4};
  const std::vector<PrescribedWorkspace> workspaces{{"superellipse", Superellipse{{1.34, 1.175}, 2.85}, placed},
                                                    {"astroid", Superellipse{{1.0, 0.8}, 0.7}, placed},
                                                    {"ellipse", Ellipse{{1.75, 1.0}}, placed},
                                                    {"quarters", QuarterEllipses{2.0, 2.0, 0.3, 1.14}, placed},
                                                    {"circle", Circle{0.7}, placed},
                                                    {"rectangle", Rectangle{2.0, 0.5}, placed},
                                                    {"diamond", diamond(), placed},
                                                    {"table", PolarTable{{-1.0, 0.5, 3.0}, {2.0, 1.0, 1.5}}, placed}};
  const double h = 1e-4;
  for (const PrescribedWorkspace& workspace : workspaces) {
    for (double beta = 0.45; beta < 2.0 * pi; beta += 0.37) {
      const OutlinePoint at = workspace.outline(beta);
      const Eigen::Vector2d before = workspace.point(beta - h);
      const Eigen::Vector2d after = workspace.point(beta + h);
      BOOST_TEST_CONTEXT(workspace.name() << " at " << beta) {
        BOOST_TEST((at.position - workspace.point(beta)).norm() == 0.0);
        BOOST_TEST(((after - before) / (2.0 * h) - at.slope).norm() < 1e-5 * at.slope.norm());
        BOOST_TEST(((after - 2.0 * at.position + before) / (h * h) - at.bend).norm() < 1e-4 * (1.0 + at.bend.norm()));
      }
    }
  }
  // On an axis, where a superellipse of exponent above 2 is flat.
  const OutlinePoint top = PrescribedWorkspace("flat", Superellipse{{1.0, 2.0}, 4.0}).outline(0.5 * pi);
  BOOST_TEST((top.slope - Eigen::Vector2d(-2.0, 0.0)).norm() < 1e-15);
  BOOST_TEST(std::abs(top.bend.y()) < 1e-15);
}

BOOST_AUTO_TEST_CASE(shapes_that_are_the_same_have_the_same_radius) {
  const PrescribedWorkspace ellipse("e", Ellipse{{1.75, 1.0}});
  const PrescribedWorkspace superellipse("s", Superellipse{{1.75, 1.0}, 2.0});
  const PrescribedWorkspace quarters("q", QuarterEllipses{1.75, 1.0, 1.75, 1.0});
  const PrescribedWorkspace rectangle("r", Rectangle{2.0, 1.0});
  const PrescribedWorkspace clockwise("p", Polygon{{{1.0, -0.5}, {-1.0, -0.5}, {-1.0, 0.5}, {1.0, 0.5}}});
  const PrescribedWorkspace rhombus("d", diamond());
  const PrescribedWorkspace one_norm("1", Superellipse{{1.0, 1.0}, 1.0});
  for (int i = 0; i < 360; ++i) {
    const double beta = -7.0 + 0.04 * i;
    BOOST_TEST(superellipse.radius(beta) == ellipse.radius(beta), tolerance(1e-13));
    BOOST_TEST(quarters.radius(beta) == ellipse.radius(beta), tolerance(1e-13));
    BOOST_TEST(clockwise.radius(beta) == rectangle.radius(beta), tolerance(1e-13));
    BOOST_TEST(rhombus.radius(beta) == one_norm.radius(beta), tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(placement_scales_rotates_and_moves) {
  const double turn = 0.3;
  const PrescribedWorkspace own("own", QuarterEllipses{2.0, 1.5, 0.3, 1.14});
  const PrescribedWorkspace placed("placed", QuarterEllipses{2.0, 1.5, 0.3, 1.14}, {{1.0, 1.5}, 0.25, turn});
  const Eigen::Rotation2Dd rotation(turn);
  for (int i = 0; i < 100; ++i) {
    const double beta = 0.0628 * i;
    const Eigen::Vector2d expected = Eigen::Vector2d(1.0, 1.5) + rotation * (0.25 * own.point(beta));
    BOOST_TEST((placed.point(beta + turn) - expected).norm() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(polar_table_interpolates_and_closes) {
  const PrescribedWorkspace table("table", PolarTable{{0.5, 2.0, 4.0}, {1.0, 2.0, 1.5}});
  BOOST_TEST(table.radius(0.5) == 1.0, tolerance(1e-14));
  BOOST_TEST(table.radius(1.25) == 1.5, tolerance(1e-14));
  BOOST_TEST(table.radius(4.0) == 1.5, tolerance(1e-14));
  const double gap = 0.5 + 2.0 * pi - 4.0;
  BOOST_TEST(table.radius(4.0 + gap / 2.0) == 1.25, tolerance(1e-14));
  BOOST_TEST(table.radius(0.0) == 1.5 + (2.0 * pi - 4.0) / gap * -0.5, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(angles_hold_the_corners) {
  const PrescribedWorkspace rectangle("r", Rectangle{2.0, 1.0}, {{0.0, 0.0}, 1.0, 0.2});
  BOOST_TEST(rectangle.corners().size() == 4U);
  const std::vector<double> angles = rectangle.angles(50);
  BOOST_TEST(angles.size() == 54U);
  BOOST_TEST(std::is_sorted(angles.begin(), angles.end()));
  double farthest = 0.0;
  for (const double beta : angles) farthest = std::max(farthest, rectangle.radius(beta));
  BOOST_TEST(farthest == std::hypot(1.0, 0.5), tolerance(1e-13));
  BOOST_TEST(PrescribedWorkspace("e", Ellipse{{1.0, 2.0}}).corners().empty());
}

BOOST_AUTO_TEST_CASE(sampled_points_leave_neither_gaps_nor_bulges) {
  constexpr int count = 500;
  const auto largest_gap_and_bulge = [](const PrescribedWorkspace& outline) {
    const std::vector<double> angles = outline.angles(count);
    BOOST_TEST(angles.size() == static_cast<std::size_t>(count));
    BOOST_TEST(angles.front() == 0.0);
    double gap = 0.0;
    double bulge = 0.0;
    double length = 0.0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double from = angles[i];
      const double to = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * pi;
      const Eigen::Vector2d chord = outline.point(to) - outline.point(from);
      gap = std::max(gap, chord.norm());
      for (int k = 0; k < 20; ++k) {
        const Eigen::Vector2d before = outline.point(from + (to - from) * k / 20) - outline.point(from);
        bulge = std::max(bulge, std::abs(chord.x() * before.y() - chord.y() * before.x()) / chord.norm());
        length += (outline.point(from + (to - from) * (k + 1) / 20) - outline.point(from) - before).norm();
      }
    }
    return std::array{gap / length, bulge / length};
  };
  // Thin and eccentric, with a bend of radius 0.005 at its tip.
  for (const Shape& shape :
       {Shape(QuarterEllipses{2.0, 2.0, 0.1, 1.14}), Shape(Superellipse{{1.42, 1.185}, 2.5}), Shape(Circle{1.0})}) {
    const auto [gap, bulge] = largest_gap_and_bulge(PrescribedWorkspace("w", shape));
    BOOST_TEST(gap < 2.01 / count);
    BOOST_TEST(bulge < 1.02 * pi / (count * count));
  }
  // Along a circle they are equally spaced.
  const auto [gap, bulge] = largest_gap_and_bulge(PrescribedWorkspace("c", Circle{1.0}));
  BOOST_TEST(gap == 1.0 / count, tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_by_name) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](Shape shape, Placement placement, const std::string& part) {
    BOOST_CHECK_EXCEPTION(PrescribedWorkspace("W", std::move(shape), placement), std::invalid_argument,
                          [&](const std::invalid_argument& error) {
                            const std::string message = error.what();
                            return message.find("'W'") != std::string::npos && message.find(part) != std::string::npos;
                          });
  };
  refused(Circle{-1.0}, {}, "radius is -1");
  refused(Ellipse{{1.0, 0.0}}, {}, "second semi-axis");
  refused(Superellipse{{1.0, 1.0}, nan}, {}, "exponent");
  refused(Rectangle{1.0, -2.0}, {}, "height");
  refused(QuarterEllipses{1.0, 1.0, 0.0, 1.0}, {}, "to the left");
  refused(Circle{1.0}, {{0.0, 0.0}, 0.0, 0.0}, "scale");
  refused(Circle{1.0}, {{nan, 0.0}, 1.0, 0.0}, "centre's x");
  refused(Polygon{{{0.0, 0.0}, {1.0, 0.0}}}, {}, "number of vertices");
  refused(Polygon{{{1.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}}}, {}, "number of turns");       // centre outside
  refused(Polygon{{{1.0, 1.0}, {-1.0, -1.0}, {-1.0, 1.0}, {1.0, -1.0}}}, {}, "turn");  // crossing
  refused(Polygon{{{2.0, -1.0}, {2.0, 2.0}, {1.0, 0.2}, {-1.0, 2.0}, {1.5, 1.6}, {-2.0, -1.0}}}, {}, "turn");
  refused(PolarTable{{0.0, 1.0, 0.5}, {1.0, 1.0, 1.0}}, {}, "angle 3");
  refused(PolarTable{{0.0, 3.0, 6.5}, {1.0, 1.0, 1.0}}, {}, "span");
  refused(PolarTable{{0.0, 1.0, 2.0}, {1.0, 1.0}}, {}, "number of radii");
  BOOST_CHECK_THROW(PrescribedWorkspace("c", Circle{1.0}).angles(0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
