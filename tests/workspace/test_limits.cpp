#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "reprise/workspace/limits.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

/// One leg with every kind of limit: a narrow wedge at one joint and a wide one at the other, or the other way around.
Leg leg_with_all_limits(std::mt19937& random, bool narrow_at_base) {
  const double lower = uniform(random, -4.0, 4.0);
  const Interval narrow{lower, lower + uniform(random, 0.3, 3.0)};
  const Interval wide{lower - 1.0, lower - 1.0 + uniform(random, 3.3, 6.0)};
  return {uniform_point(random),
          uniform_point(random),
          {0.4, 1.1},
          narrow_at_base ? narrow : wide,
          narrow_at_base ? wide : narrow};
}

}  // namespace

BOOST_AUTO_TEST_CASE(limits_are_listed_leg_by_leg) {
  std::mt19937 random(1);
  Leg free = leg_at({0.0, 0.0}, {0.0, 1.0});
  const Manipulator manipulator("two legs", {free, leg_with_all_limits(random, true)});
  const std::vector<Limit> expected = {{0, LimitKind::maximum_length},   {1, LimitKind::minimum_length},
                                       {1, LimitKind::maximum_length},   {1, LimitKind::base_angle_lower},
                                       {1, LimitKind::base_angle_upper}, {1, LimitKind::platform_angle}};
  BOOST_TEST((list_limits(manipulator) == expected));
  BOOST_TEST(to_string(expected[0]) == "leg 1, maximum length");
  BOOST_TEST(to_string(expected[3]) == "leg 2, lower base angle");
  const ConstantOrientationLimits limits(manipulator, 0.3);
  BOOST_TEST(limits.count() == 6);
  BOOST_TEST(limits.label(5) == "leg 2, platform angle");
  BOOST_TEST(limits.orientation() == 0.3);
}

BOOST_AUTO_TEST_CASE(limits_hold_exactly_where_lengths_and_joint_angles_are_allowed) {
  std::mt19937 random(2);
  int inside = 0;
  for (int sample = 0; sample < 5000; ++sample) {
    const Leg leg = leg_with_all_limits(random, sample % 2 == 0);
    const double orientation = uniform(random, -4.0, 4.0);
    const ConstantOrientationLimits limits({"one leg", {leg}}, orientation);
    const Pose pose{uniform_point(random, 2.5), orientation};
    const double length = leg_length(leg, pose);
    const bool allowed = leg.length.lower <= length && length <= leg.length.upper &&
                         contains_angle(*leg.base_angle, base_angle(leg, pose)) &&
                         contains_angle(*leg.platform_angle, platform_angle(leg, pose));
    BOOST_TEST((largest_limit(limits, pose.position) <= 0.0) == allowed);
    inside += allowed ? 1 : 0;
  }
  BOOST_TEST(inside > 100);
}

BOOST_AUTO_TEST_CASE(limits_are_1_lipschitz) {
  std::mt19937 random(3);
  for (int sample = 0; sample < 2000; ++sample) {
    const ConstantOrientationLimits limits({"one leg", {leg_with_all_limits(random, sample % 2 == 0)}},
                                           uniform(random, -4.0, 4.0));
    const Eigen::Vector2d u = uniform_point(random, 2.0);
    const Eigen::Vector2d v = u + uniform(random, 0.0, 2.0) * uniform_point(random);
    Eigen::VectorXd at_u(limits.count());
    Eigen::VectorXd at_v(limits.count());
    limits.evaluate(u, at_u);
    limits.evaluate(v, at_v);
    BOOST_TEST((at_u - at_v).cwiseAbs().maxCoeff() <= (u - v).norm() * (1.0 + 1e-14) + 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(derivatives_agree_with_differences) {
  std::mt19937 random(4);
  const double step = 1e-6;
  for (int sample = 0; sample < 200; ++sample) {
    const Leg leg = leg_with_all_limits(random, sample % 2 == 0);
    const double orientation = uniform(random, -4.0, 4.0);
    const Eigen::Vector2d a = uniform(random, 0.3, 2.0) * unit(uniform(random, -pi, pi));
    for (const Limit& limit : list_limits({"one leg", {leg}})) {
      const LimitDerivatives d = limit_derivatives(leg, limit.kind, a, orientation);
      BOOST_TEST(d.value == limit_value(leg, limit.kind, a, orientation));
      BOOST_TEST(d.gradient.norm() == 1.0, tt::tolerance(1e-14));
      BOOST_TEST((d.hessian == d.hessian.transpose()));
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d e = step * Eigen::Vector2d::Unit(k);
        const double slope =
            (limit_value(leg, limit.kind, a + e, orientation) - limit_value(leg, limit.kind, a - e, orientation)) /
            (2.0 * step);
        BOOST_TEST(std::abs(d.gradient[k] - slope) <= 1e-8);
        const Eigen::Vector2d column = (limit_derivatives(leg, limit.kind, a + e, orientation).gradient -
                                        limit_derivatives(leg, limit.kind, a - e, orientation).gradient) /
                                       (2.0 * step);
        BOOST_TEST((d.hessian.col(k) - column).norm() <= 1e-8);
      }
      // At a fixed a only the limits at the platform turn with it.
      const bool at_platform = limit.kind >= LimitKind::platform_angle_lower;
      const double expected = at_platform ? -d.gradient.dot(Eigen::Vector2d(-a.y(), a.x())) : 0.0;
      const double turned =
          (limit_value(leg, limit.kind, a, orientation + step) - limit_value(leg, limit.kind, a, orientation - step)) /
          (2.0 * step);
      BOOST_TEST(std::abs(expected - turned) <= 1e-8);
    }
  }
}

BOOST_AUTO_TEST_CASE(limits_at_a_fixed_orientation_are_those_of_the_leg_vectors) {
  std::mt19937 random(5);
  for (int sample = 0; sample < 200; ++sample) {
    const Manipulator manipulator = random_manipulator(random);
    const double orientation = uniform(random, -4.0, 4.0);
    const ConstantOrientationLimits limits(manipulator, orientation);
    const Eigen::Vector2d u = uniform_point(random, 2.0);
    Eigen::VectorXd h(limits.count());
    limits.evaluate(u, h);
    for (Eigen::Index j = 0; j < limits.count(); ++j) {
      const Leg& leg = manipulator.leg(limits.limit(j).leg);
      const Eigen::Vector2d a = leg_vector(leg, {u, orientation});
      const LimitDerivatives d = limit_derivatives(leg, limits.limit(j).kind, a, orientation);
      BOOST_TEST(std::abs(h[j] - d.value) <= 1e-15);
      BOOST_TEST((limits.gradient(u, j) - d.gradient).norm() <= 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_leg_of_length_zero_has_a_zero_gradient) {
  const Leg leg = leg_at({0.0, 0.0}, {0.5, 1.0});
  for (const LimitKind kind : {LimitKind::minimum_length, LimitKind::maximum_length}) {
    const LimitDerivatives d = limit_derivatives(leg, kind, Eigen::Vector2d::Zero(), 0.0);
    BOOST_TEST(d.value == (kind == LimitKind::minimum_length ? 0.5 : -1.0));
    BOOST_TEST(d.gradient.isZero());
    BOOST_TEST(d.hessian.isZero());
  }
}

BOOST_AUTO_TEST_CASE(the_box_holds_the_workspace) {
  std::mt19937 random(6);
  for (int sample = 0; sample < 200; ++sample) {
    const ConstantOrientationLimits limits(random_manipulator(random), uniform(random, -1.0, 1.0));
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector2d u = uniform_point(random, 3.0);
      if (largest_limit(limits, u) <= 0.0) BOOST_TEST(limits.box().contains(u));
    }
  }
  // Legs that reach one unit each, three units apart.
  const Manipulator apart("apart", {leg_at({0.0, 0.0}, {0.0, 1.0}), leg_at({3.0, 0.0}, {0.0, 1.0})});
  BOOST_TEST(ConstantOrientationLimits(apart, 0.0).box().isEmpty());
}

BOOST_AUTO_TEST_CASE(bad_input_is_reported) {
  BOOST_CHECK_THROW(ConstantOrientationLimits(m1(), std::numeric_limits<double>::infinity()), std::invalid_argument);
  BOOST_CHECK_THROW(limit_value(m1().leg(0), LimitKind::base_angle, {1.0, 0.0}, 0.0), std::invalid_argument);
}
