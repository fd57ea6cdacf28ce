// The functions on hot paths allocate nothing.

#include <boost/test/unit_test.hpp>
#include <cstddef>

#include "allocation_counter.hpp"
#include "kinematics/samples.hpp"
#include "reprise/kinematics/conditioning_field.hpp"

#ifndef __SANITIZE_ADDRESS__

using namespace reprise;
using namespace reprise::test;

namespace {

template <class Function>
std::size_t count_allocations(const Function& function) {
  const std::size_t before = allocations;
  function();
  return allocations - before;
}

}  // namespace

BOOST_AUTO_TEST_CASE(allocations_are_seen) {
  BOOST_TEST(count_allocations([] { Eigen::VectorXd::Ones(9).eval(); }) == 1);
}

BOOST_AUTO_TEST_CASE(hot_paths_allocate_nothing) {
  std::mt19937 random(51);
  for (const std::size_t legs : {2UL, 3UL}) {
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    const Eigen::MatrixXd directions = Eigen::MatrixXd::Identity(coordinate_count(legs), coordinate_count(legs));
    const Eigen::ArrayXd positions = Eigen::ArrayXd::LinSpaced(9, -1.0, 1.0);
    Eigen::ArrayXd values(positions.size());
    Eigen::VectorXd gradient(directions.cols());
    Eigen::MatrixXd hessian(directions.cols(), directions.cols());
    for (const Normalisation normalisation : {Normalisation::printed, Normalisation::homogeneous}) {
      const Conditioning c{normalisation, {}};
      BOOST_TEST(count_allocations([&] { kappa_inverse(manipulator, pose, c); }) == 0);
      BOOST_TEST(count_allocations([&] { kappa_inverse_at(manipulator, 0.1, positions, positions, c, values); }) == 0);
      BOOST_TEST(count_allocations([&] { kappa_inverse(manipulator, pose, c, directions, gradient); }) == 0);
      BOOST_TEST(count_allocations([&] { kappa_inverse(manipulator, pose, c, directions, gradient, hessian); }) == 0);
    }
    BOOST_TEST(count_allocations([&] { leg_length(manipulator.leg(0), pose); }) == 0);
    BOOST_TEST(count_allocations([&] { leg_length(manipulator, 0, pose, directions, gradient); }) == 0);
    BOOST_TEST(count_allocations([&] { leg_length(manipulator, 0, pose, directions, gradient, hessian); }) == 0);
  }
}

#else

BOOST_AUTO_TEST_CASE(nothing_to_count) { BOOST_TEST_MESSAGE("nothing is counted under the address sanitizer"); }

#endif
