#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "kinematics/samples.hpp"
#include "reprise/kinematics/coordinates.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_CASE(derivatives_of_leg_lengths_have_the_right_taylor_orders) {
  std::mt19937 random(11);
  TaylorRemainders remainders;
  for (int sample = 0; sample < 60; ++sample) {
    const std::size_t legs = 1 + static_cast<std::size_t>(sample) % 5;
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    const std::size_t leg = static_cast<std::size_t>(sample) % legs;
    const Eigen::VectorXd direction = uniform_vector(random, coordinate_count(legs));
    Eigen::VectorXd gradient(1);
    Eigen::MatrixXd hessian(1, 1);
    const double value = leg_length(manipulator, leg, pose, direction, gradient, hessian);
    BOOST_TEST(value == leg_length(manipulator.leg(leg), pose));
    remainders.add(
        [&](double t) {
          const auto [other, other_pose] = displaced(manipulator, pose, t * direction);
          return leg_length(other.leg(leg), other_pose);
        },
        value, gradient[0], hessian(0, 0));
  }
  BOOST_TEST(remainders.first_order() == 2.0, tt::tolerance(0.01));
  BOOST_TEST(remainders.second_order() == 3.0, tt::tolerance(0.01));
}

BOOST_AUTO_TEST_CASE(derivatives_along_directions_are_those_along_all_coordinates_projected) {
  std::mt19937 random(12);
  const Manipulator manipulator = random_manipulator(random, 3);
  const Pose pose = random_pose(random);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(15, 15);
  const Eigen::MatrixXd directions = Eigen::MatrixXd::Random(15, 7);
  for (std::size_t leg = 0; leg < 3; ++leg) {
    Eigen::VectorXd all_gradient(15), gradient(7), gradient_only(7);
    Eigen::MatrixXd all_hessian(15, 15), hessian(7, 7);
    leg_length(manipulator, leg, pose, identity, all_gradient, all_hessian);
    leg_length(manipulator, leg, pose, directions, gradient, hessian);
    leg_length(manipulator, leg, pose, directions, gradient_only);
    BOOST_TEST((gradient - directions.transpose() * all_gradient).norm() <= 1e-13);
    BOOST_TEST((hessian - directions.transpose() * all_hessian * directions).norm() <= 1e-12);
    BOOST_TEST((hessian == hessian.transpose()));
    BOOST_TEST((gradient == gradient_only));
    // Moving platform and base joint alike changes nothing.
    const Eigen::Index base = coordinate_count(leg);
    BOOST_TEST((all_gradient.head<2>() + all_gradient.segment<2>(base)).norm() <= 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(collinear_directions_move_pose_and_design) {
  std::mt19937 random(13);
  const Eigen::VectorXd z = uniform_vector(random, 8);
  const Eigen::VectorXd step = uniform_vector(random, 8);
  const auto build = [](const Eigen::VectorXd& v) {
    return make_manipulator(to_collinear_design(v.tail<5>()), {Interval{0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}});
  };
  const Pose pose{z.head<2>(), z[2]};
  const auto [manipulator, moved_pose] = displaced(build(z), pose, collinear_directions() * step);
  const Eigen::VectorXd sum = z + step;
  const Eigen::VectorXd expected = leg_lengths(build(sum), {sum.head<2>(), sum[2]});
  BOOST_TEST((leg_lengths(manipulator, moved_pose) - expected).norm() <= 1e-14);
}

BOOST_AUTO_TEST_CASE(a_leg_of_length_zero_has_zero_derivatives) {
  const Manipulator manipulator("touching", {leg_between({1.0, 2.0}, {0.5, 0.0})});
  Eigen::VectorXd gradient = Eigen::VectorXd::Ones(7);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Ones(7, 7);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(7, 7);
  BOOST_TEST(leg_length(manipulator, 0, {{0.5, 2.0}, 0.0}, identity, gradient, hessian) == 0.0);
  BOOST_TEST(gradient.isZero(0.0));
  BOOST_TEST(hessian.isZero(0.0));
}

BOOST_AUTO_TEST_CASE(sizes_that_do_not_fit_are_rejected) {
  std::mt19937 random(14);
  const Manipulator manipulator = random_manipulator(random, 2);
  const Pose pose = random_pose(random);
  const Eigen::MatrixXd directions = Eigen::MatrixXd::Identity(11, 4);
  Eigen::VectorXd gradient(4), short_gradient(3);
  Eigen::MatrixXd wide_hessian(4, 5), high_hessian(5, 4), hessian(4, 4);
  BOOST_CHECK_THROW(leg_length(manipulator, 2, pose, directions, gradient), std::invalid_argument);
  BOOST_CHECK_THROW(leg_length(manipulator, 0, pose, directions, short_gradient), std::invalid_argument);
  BOOST_CHECK_THROW(leg_length(manipulator, 0, pose, directions.topRows(10), gradient), std::invalid_argument);
  BOOST_CHECK_THROW(leg_length(manipulator, 0, pose, directions, gradient, wide_hessian), std::invalid_argument);
  BOOST_CHECK_THROW(leg_length(manipulator, 0, pose, directions, gradient, high_hessian), std::invalid_argument);
  BOOST_CHECK_NO_THROW(leg_length(manipulator, 0, pose, directions, gradient, hessian));
}
