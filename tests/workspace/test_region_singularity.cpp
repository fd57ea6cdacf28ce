// Singular positions in a region against dense samples of the determinant's sign, and where the curve only touches.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/region_singularity.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

const Conditioning unit_length{Normalisation::homogeneous, 1.0};

bool singular(const Manipulator& manipulator, const Pose& pose) {
  return kappa_inverse_2norm(manipulator, pose, unit_length) <= 1e-12;
}

/// Whether samples of a region have both signs of the determinant.
bool has_both_signs(const Manipulator& manipulator, double orientation, const Region& region) {
  Eigen::AlignedBox2d box;
  for (const BoundaryLoop& loop : loops(region)) {
    for (const Eigen::Vector2d& point : loop.sample(0.01)) box.extend(point);
  }
  bool positive = false;
  bool negative = false;
  // One component at a time, since two of them may lie on different sides.
  for (const RegionComponent& component : region.components()) {
    const Region alone({component});
    positive = negative = false;
    constexpr int steps = 60;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps; ++j) {
        const Eigen::Vector2d u = box.min() + box.sizes().cwiseProduct(Eigen::Vector2d(i, j)) / steps;
        if (!alone.contains(u)) continue;
        const int side = singularity_side(manipulator, {u, orientation});
        positive = positive || side > 0;
        negative = negative || side < 0;
      }
    }
    if (positive && negative) return true;
  }
  return false;
}

/// Annuli about the base joints; the platform joints play no part.
Region annuli(const std::vector<std::pair<Eigen::Vector2d, Interval>>& list) {
  std::vector<Leg> legs;
  for (const auto& [centre, length] : list) legs.push_back(leg_at(centre, length));
  return constant_orientation_workspace({"annuli", legs}, 0.0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(they_are_found_where_the_determinant_changes_its_sign) {
  std::mt19937 random(30);
  std::size_t with = 0;
  std::size_t without = 0;
  while (with + without < 150) {
    const Manipulator manipulator = random_manipulator(random);
    const double phi = uniform(random, -pi, pi);
    if (manipulator.size() < 2 || manipulator.size() > 3) continue;
    const Region region = constant_orientation_workspace(manipulator, phi);
    const auto nearest = nearest_to_singular(region, singularity_polynomial(manipulator, phi));
    BOOST_TEST(nearest.empty() == region.empty());
    if (nearest.empty()) continue;
    bool found = false;
    for (const Eigen::Vector2d& u : nearest) {
      found = found || singular(manipulator, {u, phi});
      BOOST_TEST((region.contains(u) || region.distance_to_boundary(u) <= 1e-12));
    }
    if (has_both_signs(manipulator, phi, region)) {
      BOOST_TEST(found);
      ++with;
    } else if (!found) {
      ++without;
      // No position sampled is nearer to being singular.
      const SingularityPolynomial polynomial = singularity_polynomial(manipulator, phi);
      double least = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& u : nearest) least = std::min(least, std::abs(polynomial.at(u)));
      for (const BoundaryLoop& loop : loops(region)) {
        for (const Eigen::Vector2d& point : loop.sample(0.02)) {
          BOOST_TEST(std::abs(polynomial.at(point)) >= least * (1.0 - 1e-12));
        }
      }
    }
  }
  BOOST_TEST(with >= 30U);
  BOOST_TEST(without >= 20U);
}

// A curve that lies wholly inside, one that only touches from outside, one that runs around a hole, one that misses by
// little.
BOOST_AUTO_TEST_CASE(touching_and_enclosed_curves_are_found) {
  SingularityPolynomial circle;  // x^2 + y^2 - 1
  circle.constant = -1.0;
  circle.quadratic = Eigen::Matrix2d::Identity();
  const auto least = [](const Region& region, const SingularityPolynomial& polynomial) {
    double value = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& u : nearest_to_singular(region, polynomial)) {
      BOOST_TEST((region.contains(u) || region.distance_to_boundary(u) <= 1e-12));
      value = std::min(value, std::abs(polynomial.at(u)));
    }
    return value;
  };
  BOOST_TEST(least(annuli({{{0.0, 0.0}, {0.0, 3.0}}}), circle) <= 1e-15);
  BOOST_TEST(least(annuli({{{0.1, 0.0}, {0.0, 1.5}}}), circle) <= 1e-15);
  BOOST_TEST(least(annuli({{{0.1, 0.2}, {0.5, 2.0}}}), circle) <= 1e-15);
  BOOST_TEST(least(annuli({{{3.0, 4.0}, {0.0, 4.0}}}), circle) <= 1e-14);
  BOOST_TEST(least(annuli({{{3.0, 4.0}, {0.0, 3.99}}}), circle) > 0.01);
  BOOST_TEST(least(annuli({{{0.0, 0.0}, {0.0, 0.99}}}), circle) > 0.01);
  BOOST_TEST(least(annuli({{{0.0, 0.0}, {1.01, 3.0}}}), circle) > 0.01);
  // The line x = 1, single and double; it touches, crosses or misses.
  SingularityPolynomial line;
  line.constant = -1.0;
  line.linear = {1.0, 0.0};
  SingularityPolynomial double_line;
  double_line.constant = 1.0;
  double_line.linear = {-2.0, 0.0};
  double_line.quadratic(0, 0) = 1.0;
  for (const SingularityPolynomial& polynomial : {line, double_line}) {
    BOOST_TEST(least(annuli({{{0.0, 0.3}, {0.0, 1.0}}}), polynomial) <= 1e-15);
    BOOST_TEST(least(annuli({{{0.3, 0.3}, {0.0, 1.0}}}), polynomial) <= 1e-15);
    BOOST_TEST(least(annuli({{{0.0, 0.3}, {0.0, 0.99}}}), polynomial) > 1e-5);
  }
  BOOST_TEST(nearest_to_singular(Region(), line).empty());
}

// Mirror-symmetric manipulators: their mirror line is singular, whatever else is.
BOOST_AUTO_TEST_CASE(mirror_lines_are_found) {
  std::mt19937 random(31);
  for (int sample = 0; sample < 60; ++sample) {
    const Eigen::Vector2d base(uniform(random, 0.5, 2.0), uniform(random, -2.0, 0.0));
    const Eigen::Vector2d joint = uniform_point(random, 0.5);
    const Interval length{uniform(random, 0.2, 1.0), uniform(random, 2.0, 3.0)};
    const Manipulator manipulator(
        "symmetric",
        {Leg{base, joint, length, {}, {}}, Leg{{-base.x(), base.y()}, {-joint.x(), joint.y()}, length, {}, {}},
         Leg{{0.0, uniform(random, 0.5, 2.0)}, {0.0, uniform(random, -0.5, 0.5)}, {0.3, 2.5}, {}, {}}});
    const Region region = constant_orientation_workspace(manipulator, 0.0);
    const auto nearest = nearest_to_singular(region, singularity_polynomial(manipulator, 0.0));
    bool on_line = false;
    for (double y = -4.0; y < 4.0; y += 0.01) on_line = on_line || region.contains({0.0, y});
    const bool found = std::any_of(nearest.begin(), nearest.end(), [&](const Eigen::Vector2d& u) {
      return singular(manipulator, {u, 0.0});
    });
    if (on_line) BOOST_TEST(found);
  }
}
