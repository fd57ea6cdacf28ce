// The polynomial of the singular positions against the Jacobian's determinant, and its degenerate cases.

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "kinematics/samples.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/singular_positions.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

/// det J times the leg lengths, from the Jacobian.
double determinant(const Manipulator& manipulator, const Pose& pose) {
  const Eigen::MatrixX3d rows = jacobian(manipulator, pose);
  const double determinant =
      manipulator.size() == 2 ? rows.topLeftCorner<2, 2>().determinant() : rows.topRows<3>().determinant();
  return determinant * leg_lengths(manipulator, pose).prod();
}

double magnitude(const SingularityPolynomial& polynomial) {
  return std::abs(polynomial.constant) + polynomial.linear.norm() + polynomial.quadratic.norm();
}

/// Mirrored in the y-axis, with the first two legs exchanged by the mirror.
Manipulator mirrored_pair(const Eigen::Vector2d& base, const Eigen::Vector2d& platform, double third_base,
                          double third_platform) {
  return {"symmetric",
          {leg_between(base, platform), leg_between({-base.x(), base.y()}, {-platform.x(), platform.y()}),
           leg_between({0.0, third_base}, {0.0, third_platform})}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(it_is_the_determinant_up_to_a_positive_factor) {
  std::mt19937 random(3);
  for (int sample = 0; sample < 200; ++sample) {
    const std::size_t legs = 2 + static_cast<std::size_t>(sample) % 2;
    const double size = std::pow(10.0, uniform(random, -3.0, 3.0));
    const auto [manipulator, pose] = moved(random_manipulator(random, legs, size), random_pose(random, size), 0.0,
                                           size * uniform_vector(random, 2), 1.0);
    const SingularityPolynomial polynomial = singularity_polynomial(manipulator, pose.orientation);
    double factor = 0.0;
    for (int point = 0; point < 10; ++point) {
      const Pose other{pose.position + size * uniform_vector(random, 2), pose.orientation};
      const double expected = determinant(manipulator, other);
      const double actual = polynomial.at(other.position);
      // The factor is that of the first point; to rounding of the terms.
      if (point == 0) factor = expected / actual;
      BOOST_TEST(factor > 0.0);
      const double reach = 1.0 + (other.position - polynomial.centre).norm() / polynomial.unit;
      BOOST_TEST(std::abs(expected / factor - actual) <= 1e-10 * magnitude(polynomial) * reach * reach);
      const double step = 1e-5 * size;
      for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0)}) {
        const double slope =
            (polynomial.at(other.position + step * axis) - polynomial.at(other.position - step * axis)) / (2.0 * step);
        BOOST_TEST(std::abs(slope - polynomial.gradient(other.position).dot(axis)) * size <=
                   1e-9 * magnitude(polynomial) * reach * reach * size / polynomial.unit);
      }
    }
    BOOST_TEST(!polynomial.vanishes());
    // The legs of length zero are on it.
    for (const Leg& leg : manipulator.legs()) {
      const Eigen::Vector2d q = -leg_vector(leg, {Eigen::Vector2d::Zero(), pose.orientation});
      BOOST_TEST(std::abs(polynomial.at(q)) <= 1e-12 * magnitude(polynomial));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_mirror_line_is_singular) {
  std::mt19937 random(4);
  for (int sample = 0; sample < 50; ++sample) {
    const Manipulator manipulator = mirrored_pair(2.0 * uniform_vector(random, 2), uniform_vector(random, 2),
                                                  uniform(random, -2.0, 2.0), uniform(random, -1.0, 1.0));
    const SingularityPolynomial polynomial = singularity_polynomial(manipulator, 0.0);
    for (const double y : {-3.0, 0.1, 2.0}) {
      BOOST_TEST(std::abs(polynomial.at({0.0, y})) <= 1e-13 * magnitude(polynomial) * (1.0 + std::pow(3.0, 2)));
    }
    // D is odd across the line: the other line crosses it or is parallel to it.
    for (const double x : {0.3, 1.7}) {
      BOOST_TEST(std::abs(polynomial.at({x, 0.4}) + polynomial.at({-x, 0.4})) <= 1e-12 * magnitude(polynomial) * 10.0);
    }
    BOOST_TEST(polynomial.quadratic.determinant() <= 1e-14);
  }
}

// With p_1 = p_2 = -p_3 = p, b_i x a_i = +-(b x a_i), and with all base joints on a line along b the determinant is a
// multiple of the square of the distance from the line through the q_i.
BOOST_AUTO_TEST_CASE(a_line_may_be_double) {
  const Manipulator collinear = make_manipulator({-1.0, 0.5, 1.0, 2.0, 0.7}, {Interval{0, 9}, {0, 9}, {0, 9}});
  const SingularityPolynomial polynomial = singularity_polynomial(collinear, 0.0);
  const Eigen::Vector2d eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(polynomial.quadratic).eigenvalues();
  BOOST_TEST(std::min(std::abs(eigenvalues[0]), std::abs(eigenvalues[1])) <= 1e-14);
  const double above = polynomial.at({0.3, 1.5});
  BOOST_TEST(above != 0.0);
  BOOST_TEST(polynomial.at({-2.0, -0.5}) == above, tt::tolerance(1e-13));
  BOOST_TEST(polynomial.at({5.0, 2.5}) == 4.0 * above, tt::tolerance(1e-13));
  for (const double x : {-4.0, 0.0, 3.0}) BOOST_TEST(std::abs(polynomial.at({x, 0.5})) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(everything_may_be_singular) {
  std::mt19937 random(5);
  for (int sample = 0; sample < 100; ++sample) {
    const double shift = std::pow(10.0, uniform(random, 0.0, 4.0));
    const auto point = [&] { return Eigen::Vector2d(uniform_vector(random, 2)); };
    const Eigen::Vector2d far = shift * point();
    const double phi = uniform(random, -3.0, 3.0);
    const Eigen::Vector2d p = point();
    std::vector<Leg> shared_platform, shared_base, twins, similar, together;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d c = far + point();
      shared_platform.push_back(leg_between(c, p));
      shared_base.push_back(leg_between(far, point()));
      twins.push_back(i == 2 ? twins.front() : leg_between(c, point()));
      const Eigen::Vector2d joint = point();
      similar.push_back(leg_between(far + 2.0 * joint, Eigen::Rotation2Dd(-phi) * joint + p));
      together.push_back(leg_between(far + Eigen::Rotation2Dd(phi) * joint, joint));
    }
    for (const std::vector<Leg>& legs : {shared_platform, shared_base, twins, similar, together}) {
      BOOST_TEST(singularity_polynomial({"singular", legs}, phi).vanishes());
    }
    BOOST_TEST(singularity_polynomial({"singular", {together[0], together[1]}}, phi).vanishes());
    BOOST_TEST(!singularity_polynomial({"regular", {shared_platform[0], shared_platform[1]}}, phi).vanishes());
  }
}

// Legs whose lines pass through one point at a pose; started nearby, the pose is found again. With three legs it is one
// of a curve.
BOOST_AUTO_TEST_CASE(singular_poses_are_found_from_nearby) {
  std::mt19937 random(7);
  for (int sample = 0; sample < 100; ++sample) {
    const std::size_t legs = 2 + static_cast<std::size_t>(sample) % 5;
    const Pose pose{uniform_vector(random, 2), uniform(random, -3.0, 3.0)};
    const Eigen::Vector2d meeting = pose.position + 5.0 * uniform_vector(random, 2);
    std::vector<Leg> list;
    for (std::size_t i = 0; i < legs; ++i) {
      const Eigen::Vector2d joint = legs == 2 ? Eigen::Vector2d::Zero() : Eigen::Vector2d(uniform_vector(random, 2));
      const Eigen::Vector2d here = pose.position + Eigen::Rotation2Dd(pose.orientation) * joint;
      const double part = legs == 2 ? (i == 0 ? 0.4 : -0.5) : uniform(random, 0.3, 0.6);
      list.push_back(leg_between(here + part * (meeting - here), joint));
    }
    const Manipulator manipulator("meeting", list);
    const Conditioning conditioning{Normalisation::homogeneous, 1.0};
    BOOST_TEST(kappa_inverse_2norm(manipulator, pose, conditioning) <= 1e-13);
    const Eigen::Vector2d found =
        approach_singular(manipulator, {pose.position + 1e-3 * uniform_vector(random, 2), pose.orientation});
    BOOST_TEST(kappa_inverse_2norm(manipulator, {found, pose.orientation}, conditioning) <= 1e-12);
    if (legs > 3) BOOST_TEST((found - pose.position).norm() <= 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(other_numbers_of_legs_are_refused) {
  std::mt19937 random(6);
  for (const std::size_t legs : {1U, 4U}) {
    BOOST_CHECK_THROW(singularity_polynomial(random_manipulator(random, legs), 0.0), std::invalid_argument);
  }
  BOOST_CHECK_THROW(singularity_polynomial(random_manipulator(random, 3), std::numeric_limits<double>::quiet_NaN()),
                    std::invalid_argument);
}
