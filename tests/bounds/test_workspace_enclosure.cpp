// Bounds of the least kappa^-1 over a workspace against samples of it.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "reprise/bounds/workspace_enclosure.hpp"
#include "reprise/workspace/exact_workspace.hpp"

using namespace reprise;

namespace {

double uniform(std::mt19937& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

Eigen::Vector2d point(std::mt19937& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size)};
}

/// Legs from a circle of base joints to platform joints near P, of which some have a limit on an angle.
Manipulator random_manipulator(std::mt19937& random, std::size_t legs) {
  std::vector<Leg> list;
  for (std::size_t i = 0; i < legs; ++i) {
    const double angle = uniform(random, 0.0, 6.28);
    Leg leg{2.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle)), point(random, 0.5), {1.2, 2.6}, {}, {}};
    if (i == 0 && uniform(random, 0.0, 1.0) < 0.5) leg.base_angle = Interval{angle + 2.0, angle + 4.3};
    list.push_back(leg);
  }
  return {"random", list};
}

}  // namespace

BOOST_AUTO_TEST_CASE(bounds_hold_for_all_samples_and_the_witness_is_a_pose_of_the_workspace) {
  std::mt19937 random(50);
  int positive = 0;
  int reached = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const std::size_t legs = 2 + static_cast<std::size_t>(sample) % 5;
    const Manipulator manipulator = random_manipulator(random, legs);
    const double phi = uniform(random, -0.5, 0.5);
    const Conditioning conditioning{Normalisation::homogeneous, 0.7};
    const Region region = constant_orientation_workspace(manipulator, phi);
    const ConstantOrientationLimits limits(manipulator, phi);
    const MinimumEnclosure found = enclose_minimum_in_workspace(manipulator, phi, 1e-12, {}, conditioning,
                                                                {.tolerance = 1e-4, .max_evaluations = 20'000});
    BOOST_TEST(found.lower <= found.upper);
    if (region.empty()) {
      BOOST_TEST(!found.witness.has_value());
      continue;
    }
    const Eigen::AlignedBox2d box = limits.box();
    Eigen::VectorXd h(limits.count());
    double least = 1.0;
    for (int k = 0; k < 4000; ++k) {
      const Eigen::Vector2d u =
          box.min() + box.sizes().cwiseProduct(Eigen::Vector2d(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0)));
      limits.evaluate(u, h);
      if (h.maxCoeff() <= 0.0) least = std::min(least, kappa_inverse(manipulator, {u, phi}, conditioning));
    }
    for (const RegionComponent& component : region.components()) {
      for (const Eigen::Vector2d& u : component.outer.sample(0.02)) {
        least = std::min(least, kappa_inverse(manipulator, {u, phi}, conditioning));
      }
    }
    BOOST_TEST(found.lower <= least);
    if (found.witness) {
      limits.evaluate(found.witness->position, h);
      BOOST_TEST(h.maxCoeff() <= 2e-12);
      BOOST_TEST(kappa_inverse(manipulator, *found.witness, conditioning) <= found.upper);
    }
    if (found.reached) {
      ++reached;
      BOOST_TEST(found.upper <= least + 1e-4);
    }
    if (found.lower > 0.0) ++positive;
  }
  BOOST_TEST_MESSAGE(positive << " without singular poses, " << reached << " within the tolerance");
  BOOST_TEST(positive >= 10);
  BOOST_TEST(reached >= 50);
}

// Two legs that end in P: kappa^-1 is the sine of the angle between them. In the lens in which both are at most 2 long,
// from bases 2 apart, and at least 1.2, the least sine is at the corners where one is 1.2 and the other 2, or on the
// line of the bases.
BOOST_AUTO_TEST_CASE(two_legs_have_a_closed_form) {
  const Manipulator two(
      "two", {Leg{{-1.0, 0.0}, {0.0, 0.0}, {1.2, 2.0}, {}, {}}, Leg{{1.0, 0.0}, {0.0, 0.0}, {1.2, 2.0}, {}, {}}});
  const MinimumEnclosure found = enclose_minimum_in_workspace(two, 0.0, 1e-12, {});
  const auto cosine = [](double l, double m) { return (l * l + m * m - 4.0) / (2.0 * l * m); };
  const double least =
      std::min({std::sqrt(1.0 - std::pow(cosine(1.2, 2.0), 2)), std::sqrt(1.0 - std::pow(cosine(2.0, 2.0), 2)),
                std::sqrt(1.0 - std::pow(cosine(1.2, 1.2), 2))});
  BOOST_TEST(found.reached);
  BOOST_TEST(found.lower <= least + 1e-12);
  BOOST_TEST(found.upper >= least - 1e-12);
  BOOST_TEST(found.upper - found.lower <= 1e-6);
}

BOOST_AUTO_TEST_CASE(an_empty_workspace_and_bad_options) {
  const Manipulator apart(
      "apart", {Leg{{-9.0, 0.0}, {0.0, 0.0}, {0.0, 2.0}, {}, {}}, Leg{{1.0, 0.0}, {0.0, 0.0}, {0.0, 2.0}, {}, {}}});
  const MinimumEnclosure found = enclose_minimum_in_workspace(apart, 0.0, 0.0, {});
  BOOST_TEST(found.reached);
  BOOST_TEST(!found.witness.has_value());
  BOOST_TEST(found.lower == std::numeric_limits<double>::infinity());
  BOOST_CHECK_THROW(enclose_minimum_in_workspace(apart, 0.0, -1.0, {}), std::invalid_argument);
  BOOST_CHECK_THROW(enclose_minimum_in_workspace(apart, 0.0, 0.0, {}, {}, {.tolerance = 0.0}), std::invalid_argument);
  BOOST_CHECK_THROW(enclose_minimum_in_workspace(apart, 0.0, 0.0, {}, {}, {.max_evaluations = 0}),
                    std::invalid_argument);
  BOOST_CHECK_THROW(enclose_minimum_in_workspace(apart, std::nan(""), 0.0, {}), std::invalid_argument);
}
