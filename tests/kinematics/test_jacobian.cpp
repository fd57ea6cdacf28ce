#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "kinematics/samples.hpp"
#include "reprise/kinematics/jacobian.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

CollinearDesign random_design(std::mt19937& random) {
  Eigen::VectorXd d = uniform_vector(random, 5);
  d[4] += 2.0;
  return to_collinear_design(d);
}

Manipulator collinear(const CollinearDesign& design) {
  return make_manipulator(design, {Interval{0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}});
}

}  // namespace

BOOST_AUTO_TEST_CASE(constraints_vanish_at_the_inverse_kinematics_only) {
  std::mt19937 random(21);
  for (std::size_t legs = 1; legs <= 5; ++legs) {
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    const Eigen::VectorXd lengths = leg_lengths(manipulator, pose);
    BOOST_TEST(constraints(manipulator, pose, lengths).isZero(0.0));
    const Eigen::VectorXd other = lengths.array() + 0.5;
    const Eigen::VectorXd expected = other.array().square() - lengths.array().square();
    BOOST_TEST((constraints(manipulator, pose, other) - expected).norm() <= 1e-13 * expected.norm());
  }
  BOOST_CHECK_THROW(constraints(random_manipulator(random, 3), random_pose(random), Eigen::Vector2d(1.0, 1.0)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(constraint_jacobians_have_the_right_taylor_orders) {
  std::mt19937 random(22);
  TaylorRemainders by_pose;
  for (int sample = 0; sample < 40; ++sample) {
    const Manipulator manipulator = random_manipulator(random, 3);
    const Pose pose = random_pose(random);
    const Eigen::VectorXd lengths = 3.0 * uniform_vector(random, 3).cwiseAbs();
    const Eigen::Vector3d step = uniform_vector(random, 3);
    const Eigen::VectorXd slope = constraint_pose_jacobian(manipulator, pose) * step;
    for (Eigen::Index i = 0; i < 3; ++i) {
      by_pose.add(
          [&](double t) {
            const Pose other{pose.position + t * step.head<2>(), pose.orientation + t * step[2]};
            return constraints(manipulator, other, lengths)[i];
          },
          constraints(manipulator, pose, lengths)[i], slope[i], 0.0);
    }
    // Phi is quadratic in the lengths, so its derivative is the symmetric difference to rounding.
    const Eigen::VectorXd change = 0.1 * uniform_vector(random, 3);
    const Eigen::VectorXd difference =
        0.5 * (constraints(manipulator, pose, lengths + change) - constraints(manipulator, pose, lengths - change));
    BOOST_TEST((constraint_length_jacobian(lengths) * change - difference).norm() <= 1e-14);
  }
  BOOST_TEST(by_pose.first_order() == 2.0, tt::tolerance(0.01));
}

BOOST_AUTO_TEST_CASE(the_constraint_jacobians_are_those_of_equation_5_12) {
  std::mt19937 random(23);
  for (int sample = 0; sample < 20; ++sample) {
    const CollinearDesign d = random_design(random);
    const Pose pose = random_pose(random);
    const double c = std::cos(pose.orientation);
    const double s = std::sin(pose.orientation);
    const Eigen::Vector2d a(pose.position.x() - d.r * c, pose.position.y() - d.r * s);
    const Eigen::Vector2d b(pose.position.x() + d.r * c, pose.position.y() + d.r * s);
    const Eigen::Vector2d ac = a - Eigen::Vector2d(d.x_c, d.y_c);
    const Eigen::Vector2d ad = a - Eigen::Vector2d(d.x_d, d.y_c);
    const Eigen::Vector2d be = b - Eigen::Vector2d(d.x_e, d.y_c);
    const Eigen::Matrix3d printed{{ac.x(), ac.y(), d.r * ac.x() * s - d.r * ac.y() * c},
                                  {ad.x(), ad.y(), d.r * ad.x() * s - d.r * ad.y() * c},
                                  {be.x(), be.y(), -d.r * be.x() * s + d.r * be.y() * c}};
    const Manipulator manipulator = collinear(d);
    const Eigen::VectorXd v = leg_lengths(manipulator, pose);
    BOOST_TEST((constraint_pose_jacobian(manipulator, pose) + 2.0 * printed).norm() <= 1e-13);

    Eigen::Matrix3d normalised = v.cwiseInverse().asDiagonal() * printed;
    normalised.leftCols<2>() /= d.r;
    BOOST_TEST((normalised_jacobian(manipulator, pose, {Normalisation::printed, {}}) - normalised).norm() <= 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(the_jacobian_of_the_inverse_kinematics_follows_from_the_constraint_jacobians) {
  std::mt19937 random(24);
  for (std::size_t legs = 1; legs <= 6; ++legs) {
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    const Eigen::VectorXd lengths = leg_lengths(manipulator, pose);
    const Eigen::MatrixXd expected =
        -1.0 * constraint_length_jacobian(lengths).inverse() * constraint_pose_jacobian(manipulator, pose);
    BOOST_TEST((jacobian(manipulator, pose) - expected).norm() <= 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(normalisations_divide_by_the_characteristic_length) {
  std::mt19937 random(25);
  const Manipulator manipulator = random_manipulator(random, 4);
  const Pose pose = random_pose(random);
  const Eigen::MatrixX3d plain = jacobian(manipulator, pose);
  const Eigen::MatrixX3d printed = normalised_jacobian(manipulator, pose, {Normalisation::printed, 4.0});
  const Eigen::MatrixX3d homogeneous = normalised_jacobian(manipulator, pose, {Normalisation::homogeneous, 4.0});
  BOOST_TEST((4.0 * printed.leftCols<2>() == plain.leftCols<2>()));
  BOOST_TEST((printed.col(2) == plain.col(2)));
  BOOST_TEST((homogeneous.leftCols<2>() == plain.leftCols<2>()));
  BOOST_TEST((4.0 * homogeneous.col(2) == plain.col(2)));
  BOOST_CHECK_THROW(normalised_jacobian(manipulator, pose, {Normalisation::printed, 0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(degenerate_jacobians_are_defined) {
  const Manipulator touching("touching", {leg_between({1.0, 2.0}, {0.5, 0.0}), leg_between({0.0, 0.0}, {0.0, 1.0})});
  const Pose pose{{0.5, 2.0}, 0.0};
  BOOST_TEST(jacobian(touching, pose).row(0).isZero(0.0));
  BOOST_TEST(jacobian(touching, pose).row(1).norm() > 0.0);
  BOOST_TEST(constraint_pose_jacobian(touching, pose).row(0).isZero(0.0));

  const Manipulator point("point", {leg_between({1.0, 0.0}, {0.0, 0.0}), leg_between({0.0, 1.0}, {0.0, 0.0})});
  BOOST_TEST(normalised_jacobian(point, pose, {Normalisation::printed, {}}).isZero(0.0));
  BOOST_TEST(normalised_jacobian(point, pose).allFinite());
}
