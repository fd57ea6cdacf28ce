#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/workspace/dextrous_derivatives.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "workspace/samples.hpp"

namespace {

using namespace reprise;
using namespace reprise::test;
using boost::test_tools::tolerance;

Interval random_range(std::mt19937& random) {
  const double lower = uniform(random, -3.0, 3.0);
  return {lower, lower + uniform(random, 0.0, 1.0) * uniform(random, 0.1, 6.0)};
}

/// The limits of one leg over a range as the inequalities of a problem in z = [w, p]. The base joint is at the origin.
class LimitsOfLeg {
 public:
  LimitsOfLeg(Leg leg, const Interval& range) : leg_(std::move(leg)), range_(range) {}

  DextrousLimits at(const Eigen::VectorXd& z) const { return {Manipulator("one leg", {leg_at(z)}), range_}; }

  DextrousLimitDerivatives derivatives(const Eigen::VectorXd& z, Eigen::Index j) const {
    const DextrousLimits limits = at(z);
    const Eigen::Vector2d w = z.head<2>();
    return dextrous_limit_derivatives(leg_at(z), limits.limit(j).kind, w, range_, limits.critical_orientation(w, j));
  }

  Problem problem() const {
    Problem problem;
    problem.name = "limits of one leg";
    problem.n = 4;
    problem.objective = [](const Eigen::VectorXd&) { return 0.0; };
    problem.inequalities = at(Eigen::VectorXd::Ones(4)).count();
    problem.inequality = [*this](const Eigen::VectorXd& z, Eigen::VectorXd& g) { at(z).evaluate(z.head<2>(), g); };
    problem.inequality_jacobian = dense_jacobian([*this](const Eigen::VectorXd& z, Eigen::MatrixXd& jacobian) {
      for (Eigen::Index j = 0; j < jacobian.rows(); ++j) jacobian.row(j) = derivatives(z, j).gradient.transpose();
    });
    problem.lagrangian_hessian = [*this](const Eigen::VectorXd& z, double, const Eigen::VectorXd& multipliers,
                                         const Eigen::VectorXd&, SparseMatrix& hessian) {
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(4, 4);
      for (Eigen::Index j = 0; j < multipliers.size(); ++j) {
        const DextrousLimitDerivatives h = derivatives(z, j);
        BOOST_TEST((h.hessian - h.hessian.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * (1.0 + h.hessian.norm()));
        sum += multipliers[j] * h.hessian;
      }
      sum.triangularView<Eigen::StrictlyUpper>().setZero();
      assign_dense(sum, hessian);
    };
    return problem;
  }

 private:
  Leg leg_at(const Eigen::VectorXd& z) const {
    Leg leg = leg_;
    leg.base_joint.setZero();
    leg.platform_joint = z.tail<2>();
    return leg;
  }

  Leg leg_;
  Interval range_;
};

BOOST_AUTO_TEST_SUITE(dextrous_derivatives)

// Against differences and by the order of the Taylor remainder, where the largest value is taken at an end of the
// range, within it, and where both edges of a wide wedge are equal. At the draws of this seed no limit has a kink
// closer than the steps of the differences.
BOOST_AUTO_TEST_CASE(derivatives_along_position_and_platform_joint_are_exact) {
  std::mt19937 random(5);
  int at_end = 0;
  int within = 0;
  int at_equal_edges = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Manipulator manipulator = random_manipulator(random);
    const Interval range = random_range(random);
    for (const Leg& leg : manipulator.legs()) {
      Eigen::Vector4d z;
      z << uniform_point(random, 2.0), leg.platform_joint;
      const LimitsOfLeg limits_of_leg(leg, range);
      for (const DerivativeCheck& one : check_derivatives(limits_of_leg.problem(), z, 1e-5).checks) {
        BOOST_TEST(one.passed, "trial " << trial << ", " << one.function << ": " << one.coordinate_error << ", "
                                        << one.direction_error << ", order " << one.remainder_order);
      }
      const DextrousLimits limits = limits_of_leg.at(z);
      for (Eigen::Index j = 0; j < limits.count(); ++j) {
        const double phi = limits.critical_orientation(z.head<2>(), j);
        const bool is_within = phi > range.lower + 1e-9 && phi < range.upper - 1e-9;
        ++(is_within ? within : at_end);
        if (!is_within) continue;
        // Turned a little, the smaller of two equal edges falls with a slope; a stationary one does not.
        const auto value = [&](double orientation) {
          const Eigen::Vector2d a = z.head<2>() + Eigen::Rotation2Dd(orientation) * leg.platform_joint;
          return limit_value(leg, limits.limit(j).kind, a, orientation);
        };
        constexpr double turn = 1e-6;
        if (value(phi) - value(phi + turn) > 1e-3 * turn) ++at_equal_edges;
      }
    }
  }
  BOOST_TEST(at_end > 100);
  BOOST_TEST(within > 100);
  BOOST_TEST(at_equal_edges > 5);
}

BOOST_AUTO_TEST_CASE(along_the_position_they_are_those_of_the_workspace) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Manipulator manipulator = random_manipulator(random);
    const DextrousLimits limits(manipulator, random_range(random));
    const Eigen::Vector2d u = uniform_point(random, 2.0);
    for (Eigen::Index j = 0; j < limits.count(); ++j) {
      const Leg& leg = manipulator.leg(limits.limit(j).leg);
      const DextrousLimitDerivatives h = dextrous_limit_derivatives(
          leg, limits.limit(j).kind, u - leg.base_joint, limits.orientations(), limits.critical_orientation(u, j));
      BOOST_TEST((h.gradient.head<2>() - limits.gradient(u, j)).norm() < 1e-9, limits.label(j));
    }
  }
}

// Where a limit is alike at both ends of one half of a range and has its kink, the other half is the larger one.
BOOST_AUTO_TEST_CASE(halves_of_a_range_have_no_kink_where_they_are_the_larger_one) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 1000; ++trial) {
    Leg leg = random_manipulator(random).leg(0);
    leg.base_joint.setZero();
    const Interval range = random_range(random);
    if (range.upper - range.lower < 1e-3) continue;  // too narrow to tell the halves apart
    const double middle = 0.5 * (range.lower + range.upper);
    const Eigen::Vector2d w = uniform_point(random, 2.0);
    for (const LimitKind kind : {LimitKind::minimum_length, LimitKind::maximum_length}) {
      // R(phi) p is along w, or against it, at the middle of the lower half: there the limit is farthest from violated.
      const double turn = kind == LimitKind::minimum_length ? 0.0 : pi;
      const double platform_angle = std::atan2(w.y(), w.x()) + turn - 0.5 * (range.lower + middle);
      leg.platform_joint = leg.platform_joint.norm() * unit(platform_angle);
      leg.length.lower = 1.0;
      leg.length.upper = 2.0;
      const auto largest = [&](const Interval& part) {
        const DextrousLimits limits(Manipulator("one leg", {leg}), part);
        Eigen::VectorXd h(limits.count());
        limits.evaluate(w, h);
        return h[kind == LimitKind::minimum_length ? 0 : 1];
      };
      const double lower_half = largest({range.lower, middle});
      const double upper_half = largest({middle, range.upper});
      BOOST_TEST(upper_half > lower_half);
      BOOST_TEST(largest(range) == upper_half, tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
