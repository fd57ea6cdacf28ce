#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/region_quadrature.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "workspace/samples.hpp"

namespace {

using namespace reprise;
using namespace reprise::test;
using boost::test_tools::tolerance;

template <class Function>
double integral(const Region& region, int panels, const Function& f) {
  double sum = 0.0;
  for (const QuadratureLine& line : region_quadrature(region, panels)) {
    for (const QuadratureNode& node : line) sum += node.weight * f(node.position);
  }
  return sum;
}

double one(const Eigen::Vector2d&) { return 1.0; }

/// Regions of all kinds, some of them empty.
std::vector<Region> random_regions() {
  std::mt19937 random(11);
  std::vector<Region> regions;
  for (int k = 0; k < 60; ++k) {
    regions.push_back(constant_orientation_workspace(random_manipulator(random), uniform(random, -pi, pi)));
  }
  for (const Manipulator& manipulator : thesis_manipulators()) {
    regions.push_back(constant_orientation_workspace(manipulator, 0.0));
  }
  return regions;
}

/// The annulus from radius 1 to 2 about (0.3, -0.2), as the workspace of two equal legs.
Region annulus() {
  const Leg leg{.base_joint = {0.3, -0.2},
                .platform_joint = {0.0, 0.0},
                .length = {1.0, 2.0},
                .base_angle = {},
                .platform_angle = {}};
  return constant_orientation_workspace(Manipulator("annulus", {leg, leg}), 0.0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(moments_of_an_annulus_are_those_of_the_closed_form) {
  const Eigen::Vector2d centre(0.3, -0.2);
  const auto about = [&](const auto& f) {
    return integral(annulus(), 2, [&](const Eigen::Vector2d& u) { return f(Eigen::Vector2d(u - centre)); });
  };
  BOOST_TEST(about([](const Eigen::Vector2d&) { return 1.0; }) == 3.0 * pi, tolerance(1e-11));
  BOOST_TEST(std::abs(about([](const Eigen::Vector2d& v) { return v.x(); })) < 1e-11);
  // The integral of r^2 cos^2, r from 1 to 2, and of exp(-r^2).
  BOOST_TEST(about([](const Eigen::Vector2d& v) { return v.x() * v.x(); }) == pi * 15.0 / 4.0, tolerance(1e-10));
  BOOST_TEST(about([](const Eigen::Vector2d& v) { return v.y() * v.y(); }) == pi * 15.0 / 4.0, tolerance(1e-10));
  BOOST_TEST(about([](const Eigen::Vector2d& v) { return std::exp(-v.squaredNorm()); }) ==
                 pi * (std::exp(-1.0) - std::exp(-4.0)),
             tolerance(1e-9));
}

// An area has another formula, along the boundary.
BOOST_AUTO_TEST_CASE(the_integral_of_one_is_the_area) {
  for (const Region& region : random_regions()) {
    BOOST_TEST(std::abs(integral(region, 2, one) - region.area()) < 1e-6);
    BOOST_TEST(std::abs(integral(region, 8, one) - region.area()) < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(nodes_lie_inside_and_lines_do_not_leave_the_region) {
  for (const Region& region : random_regions()) {
    bool inside = true;
    bool in_order = true;
    for (const QuadratureLine& line : region_quadrature(region)) {
      for (std::size_t k = 0; k < line.size(); ++k) {
        inside = inside && region.contains(line[k].position) && line[k].weight > 0.0;
        if (k == 0) continue;
        in_order = in_order && line[k].position.x() == line[k - 1].position.x() &&
                   line[k].position.y() > line[k - 1].position.y();
        inside = inside && region.contains(0.5 * (line[k].position + line[k - 1].position));
      }
    }
    BOOST_TEST(inside);
    BOOST_TEST(in_order);
  }
}

// |x - a| has a kink along a line, which the nodes do not know of: the error falls with the square of the panels, on
// the average over places of the kink.
BOOST_AUTO_TEST_CASE(kinks_cost_accuracy_but_not_convergence) {
  const auto error = [](int panels) {
    double sum = 0.0;
    for (int k = 0; k < 20; ++k) {
      const auto kinked = [a = -0.5 + 0.0712 * k](const Eigen::Vector2d& u) { return std::abs(u.x() - a); };
      sum += std::abs(integral(annulus(), panels, kinked) - integral(annulus(), 40, kinked));
    }
    return sum / 20.0;
  };
  const double coarse = error(2);
  const double fine = error(8);
  BOOST_TEST(fine < coarse / 8.0);
  BOOST_TEST(fine < 1e-3);
}

BOOST_AUTO_TEST_CASE(an_empty_region_has_no_nodes_and_wrong_panels_are_refused) {
  BOOST_TEST(region_quadrature(Region()).empty());
  BOOST_CHECK_THROW(region_quadrature(annulus(), 0), std::invalid_argument);
}
