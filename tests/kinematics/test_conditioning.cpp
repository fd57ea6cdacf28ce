#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "kinematics/samples.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/conditioning_field.hpp"
#include "reprise/kinematics/jacobian.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const Conditioning printed{Normalisation::printed, {}};
const Conditioning homogeneous{Normalisation::homogeneous, {}};
const std::array<Conditioning, 4> conditionings = {printed, homogeneous, Conditioning{Normalisation::printed, 0.8},
                                                   Conditioning{Normalisation::homogeneous, 1.7}};

Manipulator collinear(const CollinearDesign& design) {
  return make_manipulator(design, {Interval{0.0, 9.0}, {0.0, 9.0}, {0.0, 9.0}});
}

/// n platform joints evenly spread on a circle of radius r about P, legs of length 2 along its tangents. At the pose
/// zero row i of J is [-sin t_i, cos t_i, r], so J^T J = diag(n/2, n/2, n r^2).
Manipulator tangential(std::size_t legs, double r) {
  std::vector<Leg> result;
  for (std::size_t i = 0; i < legs; ++i) {
    const double t = 2.0 * pi * static_cast<double>(i) / static_cast<double>(legs);
    const Eigen::Vector2d joint(r * std::cos(t), r * std::sin(t));
    result.push_back(leg_between(joint - 2.0 * Eigen::Vector2d(-std::sin(t), std::cos(t)), joint));
  }
  return {"tangential", result};
}

const Pose origin_pose{{0.0, 0.0}, 0.0};

}  // namespace

BOOST_AUTO_TEST_CASE(tangential_legs_have_a_closed_form) {
  for (std::size_t legs = 3; legs <= 7; ++legs) {
    for (const double r : {0.3, 1.0, 2.0}) {
      for (const double length : {0.1, 0.5, 1.0, 4.0}) {
        for (const Normalisation normalisation : {Normalisation::printed, Normalisation::homogeneous}) {
          // The singular values of J / sqrt(n), up to a common factor, are sqrt(1/2) twice and q.
          const double q = normalisation == Normalisation::printed ? r * length : r / length;
          const double frobenius = 3.0 / std::sqrt((1.0 + q * q) * (4.0 + 1.0 / (q * q)));
          const double ratio = std::sqrt(2.0) * q;
          const Conditioning conditioning{normalisation, length};
          const Manipulator manipulator = tangential(legs, r);
          BOOST_TEST(kappa_inverse(manipulator, origin_pose, conditioning) == frobenius, tt::tolerance(1e-13));
          BOOST_TEST(kappa(manipulator, origin_pose, conditioning) == 1.0 / frobenius, tt::tolerance(1e-13));
          BOOST_TEST(kappa_inverse_2norm(manipulator, origin_pose, conditioning) == std::min(ratio, 1.0 / ratio),
                     tt::tolerance(1e-13));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(an_isotropic_pose_has_condition_number_one_and_no_slope_along_the_pose) {
  const Conditioning isotropic{Normalisation::homogeneous, std::sqrt(2.0)};
  for (std::size_t legs = 3; legs <= 6; ++legs) {
    const Manipulator manipulator = tangential(legs, 1.0);
    const Eigen::MatrixXd pose_directions = Eigen::MatrixXd::Identity(coordinate_count(legs), 3);
    Eigen::VectorXd gradient(3);
    BOOST_TEST(kappa_inverse(manipulator, origin_pose, isotropic, pose_directions, gradient) == 1.0,
               tt::tolerance(1e-14));
    BOOST_TEST(gradient.norm() <= 1e-14);
    BOOST_TEST(kappa_inverse_2norm(manipulator, origin_pose, isotropic) == 1.0, tt::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(two_legs_give_the_sine_of_the_angle_between_them) {
  for (const double angle : {0.1, 1.0, 0.5 * pi, 2.5, -2.0}) {
    const Manipulator manipulator("2-dof", {leg_between({-3.0, 0.0}, {0.0, 0.0}),
                                            leg_between({2.0 * std::cos(angle), 2.0 * std::sin(angle)}, {0.0, 0.0})});
    for (const Conditioning& conditioning : conditionings) {
      const double sine = std::abs(std::sin(angle));
      BOOST_TEST(kappa_inverse(manipulator, origin_pose, conditioning) == sine, tt::tolerance(1e-14));
      // The two singular values of rows at an angle are sqrt(1 +- cos).
      const double cosine = std::abs(std::cos(angle));
      BOOST_TEST(
          kappa_inverse_2norm(manipulator, origin_pose, conditioning) == std::sqrt((1.0 - cosine) / (1.0 + cosine)),
          tt::tolerance(1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_characteristic_length_of_the_family_is_its_radius) {
  BOOST_TEST(characteristic_length(collinear({-1.0, 0.0, 1.0, 2.0, 0.75})) == 0.75, tt::tolerance(1e-15));
  BOOST_TEST(characteristic_length(collinear({-1.0, 0.0, 1.0, 2.0, 0.75}), {Normalisation::printed, 3.0}) == 3.0);
  BOOST_TEST(characteristic_length(collinear({-1.0, 0.0, 1.0, 2.0, 0.0})) == 0.0);
}

BOOST_AUTO_TEST_CASE(the_formula_agrees_with_inverse_and_singular_values) {
  std::mt19937 random(41);
  for (int sample = 0; sample < 300; ++sample) {
    const std::size_t legs = 3 + static_cast<std::size_t>(sample) % 4;
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    for (const Conditioning& conditioning : conditionings) {
      const Eigen::MatrixXd j = normalised_jacobian(manipulator, pose, conditioning);
      const Eigen::Matrix3d square = j.transpose() * j;
      const double frobenius = std::sqrt(square.trace() * square.inverse().trace()) / 3.0;
      // Forming J^T J squares the condition number; the comparison can be no better than that.
      const double tolerance = 1e-14 * frobenius * frobenius + 1e-13;
      const double inverse = kappa_inverse(manipulator, pose, conditioning);
      BOOST_TEST(std::abs(inverse * frobenius - 1.0) <= tolerance);
      if (legs == 3) {
        const double direct = j.norm() * Eigen::Matrix3d(j).inverse().norm() / 3.0;
        BOOST_TEST(std::abs(inverse * direct - 1.0) <= 1e-14 * direct + 1e-13);
      }
      BOOST_TEST(inverse >= 0.0);
      BOOST_TEST(inverse <= 1.0);

      const Eigen::Vector3d eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(square).eigenvalues();
      const double two_norm = kappa_inverse_2norm(manipulator, pose, conditioning);
      BOOST_TEST(std::abs(two_norm * two_norm - eigenvalues[0] / eigenvalues[2]) <= 1e-14);
      // 1/3 kappa_2 <= kappa_F <= kappa_2 for 3 columns.
      BOOST_TEST(two_norm <= inverse * (1.0 + 1e-12));
      BOOST_TEST(inverse <= 3.0 * two_norm * (1.0 + 1e-12));
    }
  }
}

// Many legs against the sums of the Cauchy-Binet formula, in the longer numbers of the processor.
BOOST_AUTO_TEST_CASE(many_legs_agree_with_the_sums_of_the_formula) {
  std::mt19937 random(49);
  using Long = long double;
  for (const std::size_t legs : {4U, 5U, 9U, 30U}) {
    for (const double spread : {1.0, 1e-3, 1e-6}) {
      // Platform joints near one point make the third column of J nearly a combination of the others.
      std::vector<Leg> list;
      const Eigen::Vector2d middle = uniform_vector(random, 2);
      for (std::size_t i = 0; i < legs; ++i) {
        list.push_back(leg_between(2.0 * uniform_vector(random, 2), middle + spread * uniform_vector(random, 2)));
      }
      const Manipulator manipulator("many", list);
      const Pose pose = random_pose(random);
      const Conditioning conditioning{Normalisation::homogeneous, 0.8};
      std::vector<Eigen::Matrix<Long, 3, 1>> rows;
      const Long c = std::cos(pose.orientation);
      const Long s = std::sin(pose.orientation);
      Long squares = 0, crosses = 0, determinants = 0;
      for (const Leg& leg : manipulator.legs()) {
        const Long bx = c * leg.platform_joint.x() - s * leg.platform_joint.y();
        const Long by = s * leg.platform_joint.x() + c * leg.platform_joint.y();
        const Long ax = bx + pose.position.x() - leg.base_joint.x();
        const Long ay = by + pose.position.y() - leg.base_joint.y();
        rows.push_back(Eigen::Matrix<Long, 3, 1>(ax, ay, (bx * ay - by * ax) / Long(0.8)) / std::hypot(ax, ay));
      }
      for (std::size_t i = 0; i < legs; ++i) {
        squares += rows[i].squaredNorm();
        for (std::size_t j = 0; j < i; ++j) {
          crosses += rows[i].cross(rows[j]).squaredNorm();
          for (std::size_t k = 0; k < j; ++k) {
            const Long determinant = rows[i].cross(rows[j]).dot(rows[k]);
            determinants += determinant * determinant;
          }
        }
      }
      const auto expected = static_cast<double>(3 * std::sqrt(determinants / (squares * crosses)));
      // What is lost is what rounding of the rows costs, not its square root.
      BOOST_TEST(std::abs(kappa_inverse(manipulator, pose, conditioning) - expected) <=
                 1e-15 * 10.0 + 1e-14 * expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(neither_world_frame_nor_order_of_legs_nor_unit_of_length_matter) {
  std::mt19937 random(42);
  double largest_change_of_printed = 0.0;
  for (int sample = 0; sample < 60; ++sample) {
    const std::size_t legs = 2 + static_cast<std::size_t>(sample) % 4;
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    std::vector<Leg> reversed(manipulator.legs().rbegin(), manipulator.legs().rend());
    for (const Conditioning& conditioning : conditionings) {
      const double expected = kappa_inverse(manipulator, pose, conditioning);
      const auto [other, other_pose] = moved(manipulator, pose, 1.1, {5.0, -3.0}, 1.0);
      BOOST_TEST(std::abs(kappa_inverse(other, other_pose, conditioning) - expected) <= 1e-13);
      BOOST_TEST(std::abs(kappa_inverse(Manipulator("reversed", reversed), pose, conditioning) - expected) <= 1e-13);
    }
    const auto [millimetres, scaled_pose] = moved(manipulator, pose, 0.0, {0.0, 0.0}, 1000.0);
    const double expected = kappa_inverse(manipulator, pose, homogeneous);
    BOOST_TEST(std::abs(kappa_inverse(millimetres, scaled_pose, homogeneous) - expected) <= 1e-13);
    const double expected_given = kappa_inverse(manipulator, pose, {Normalisation::homogeneous, 0.5});
    const Conditioning given{Normalisation::homogeneous, 500.0};
    BOOST_TEST(std::abs(kappa_inverse(millimetres, scaled_pose, given) - expected_given) <= 1e-13);
    if (legs > 2) {
      const double change =
          kappa_inverse(millimetres, scaled_pose, printed) - kappa_inverse(manipulator, pose, printed);
      largest_change_of_printed = std::max(largest_change_of_printed, std::abs(change));
    }
  }
  BOOST_TEST(largest_change_of_printed > 0.1);
}

BOOST_AUTO_TEST_CASE(the_unit_of_length_may_be_extreme) {
  std::mt19937 random(43);
  const Manipulator manipulator = random_manipulator(random, 3);
  const Pose pose = random_pose(random);
  const double expected = kappa_inverse(manipulator, pose);
  for (const double unit : {1e-100, 1e-30, 1e30, 1e100}) {
    const auto [other, other_pose] = moved(manipulator, pose, 0.0, {0.0, 0.0}, unit);
    BOOST_TEST(kappa_inverse(other, other_pose) == expected, tt::tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(singular_poses_have_kappa_inverse_zero) {
  const auto check_singular = [](const std::vector<Leg>& legs) {
    const Manipulator manipulator("singular", legs);
    for (const Conditioning& conditioning : conditionings) {
      BOOST_TEST(kappa_inverse(manipulator, origin_pose, conditioning) <= 1e-15);
      BOOST_TEST(kappa_inverse_2norm(manipulator, origin_pose, conditioning) <= 1e-15);
      BOOST_TEST(kappa(manipulator, origin_pose, conditioning) >= 1e15);
    }
  };
  // Parallel legs.
  check_singular({leg_between({-1.0, -1.0}, {-1.0, 0.0}), leg_between({0.0, -2.0}, {0.0, 0.5}),
                  leg_between({2.0, -3.0}, {2.0, 0.0})});
  // Lines of all legs through one point (3, 1).
  check_singular({leg_between({3.0, -2.0}, {3.0, 0.0}), leg_between({-1.0, 1.0}, {2.0, 1.0}),
                  leg_between({0.0, -2.0}, {2.0, 0.0})});
  check_singular({leg_between({0.0, -1.0}, {1.0, 0.0}), leg_between({0.0, -1.0}, {1.0, 0.0}),
                  leg_between({3.0, 3.0}, {0.0, 1.0})});

  // Exactly zero by definition: a leg without direction, and all platform joints at P.
  const Manipulator touching("touching", {leg_between({1.0, 0.0}, {1.0, 0.0}), leg_between({-1.0, 1.0}, {0.0, 1.0}),
                                          leg_between({0.0, -3.0}, {-1.0, 0.0})});
  const Manipulator point("point", {leg_between({1.0, 0.0}, {0.0, 0.0}), leg_between({-1.0, 1.0}, {0.0, 0.0}),
                                    leg_between({0.0, -3.0}, {0.0, 0.0})});
  for (const Manipulator& manipulator : {touching, point}) {
    for (const Conditioning& conditioning : conditionings) {
      BOOST_TEST(kappa_inverse(manipulator, origin_pose, conditioning) == 0.0);
      BOOST_TEST(kappa_inverse_2norm(manipulator, origin_pose, conditioning) == 0.0);
      BOOST_TEST(kappa(manipulator, origin_pose, conditioning) == infinity);
      Eigen::VectorXd gradient = Eigen::VectorXd::Ones(15);
      Eigen::MatrixXd hessian = Eigen::MatrixXd::Ones(15, 15);
      const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(15, 15);
      BOOST_TEST(kappa_inverse(manipulator, origin_pose, conditioning, identity, gradient) == 0.0);
      BOOST_TEST(gradient.isZero(0.0));
      gradient.setOnes();
      BOOST_TEST(kappa_inverse(manipulator, origin_pose, conditioning, identity, gradient, hessian) == 0.0);
      BOOST_TEST(gradient.isZero(0.0));
      BOOST_TEST(hessian.isZero(0.0));
    }
  }
}

BOOST_AUTO_TEST_CASE(kappa_inverse_goes_to_zero_linearly_at_a_singular_pose) {
  // Legs through one point but for a shift of one base joint: det J is proportional to the shift.
  const auto at = [](double shift) {
    const Manipulator manipulator("nearly singular",
                                  {leg_between({3.0 + shift, -2.0}, {3.0, 0.0}), leg_between({-1.0, 1.0}, {2.0, 1.0}),
                                   leg_between({0.0, -2.0}, {2.0, 0.0})});
    return kappa_inverse(manipulator, origin_pose) / shift;
  };
  const double limit = at(1e-6);
  BOOST_TEST(at(1e-9) == limit, tt::tolerance(1e-5));
  BOOST_TEST(at(1e-12) == limit, tt::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(derivatives_have_the_right_taylor_orders) {
  std::mt19937 random(44);
  for (std::size_t legs = 2; legs <= 5; ++legs) {
    for (const Conditioning& conditioning : conditionings) {
      TaylorRemainders remainders;
      for (int sample = 0; sample < 40;) {
        const Manipulator manipulator = random_manipulator(random, legs);
        const Pose pose = random_pose(random);
        // Close to a singular pose the series converges too slowly for the step to show the order.
        if (kappa_inverse(manipulator, pose, conditioning) < 0.1) continue;
        const Eigen::VectorXd direction = uniform_vector(random, coordinate_count(legs));
        Eigen::VectorXd gradient(1);
        Eigen::MatrixXd hessian(1, 1);
        const double value = kappa_inverse(manipulator, pose, conditioning, direction, gradient, hessian);
        BOOST_TEST(value == kappa_inverse(manipulator, pose, conditioning), tt::tolerance(1e-14));
        remainders.add(
            [&](double t) {
              const auto [other, other_pose] = displaced(manipulator, pose, t * direction);
              return kappa_inverse(other, other_pose, conditioning);
            },
            value, gradient[0], hessian(0, 0));
        ++sample;
      }
      BOOST_TEST(remainders.first_order() == 2.0, tt::tolerance(0.02));
      BOOST_TEST(remainders.second_order() == 3.0, tt::tolerance(0.02));
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_along_directions_are_those_along_all_coordinates_projected) {
  std::mt19937 random(45);
  const Manipulator manipulator = random_manipulator(random, 3);
  const Pose pose = random_pose(random);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(15, 15);
  for (const Conditioning& conditioning : conditionings) {
    Eigen::VectorXd all_gradient(15);
    Eigen::MatrixXd all_hessian(15, 15);
    kappa_inverse(manipulator, pose, conditioning, identity, all_gradient, all_hessian);
    BOOST_TEST((all_hessian == all_hessian.transpose()));
    for (const Eigen::Index k : {0, 1, 2, 5, 6, 7, 12, 16, 20, 33}) {
      for (const bool turning : {true, false}) {
        Eigen::MatrixXd directions(15, k);
        for (Eigen::Index j = 0; j < k; ++j) directions.col(j) = uniform_vector(random, 15);
        if (!turning) directions.row(2).setZero();
        Eigen::VectorXd gradient(k), gradient_only(k);
        Eigen::MatrixXd hessian(k, k);
        kappa_inverse(manipulator, pose, conditioning, directions, gradient, hessian);
        kappa_inverse(manipulator, pose, conditioning, directions, gradient_only);
        BOOST_TEST((gradient - directions.transpose() * all_gradient).norm() <= 1e-12 * (1.0 + gradient.norm()));
        BOOST_TEST((gradient - gradient_only).norm() <= 1e-12 * (1.0 + gradient.norm()));
        BOOST_TEST((hessian - directions.transpose() * all_hessian * directions).norm() <=
                   1e-12 * (1.0 + hessian.norm()));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(invariances_hold_for_the_gradient) {
  std::mt19937 random(46);
  for (std::size_t legs = 3; legs <= 5; ++legs) {
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    const Eigen::Index count = coordinate_count(legs);
    // Columns: a shift of the world along x, a change of the unit of length, a turn of the world about its origin.
    Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(count, 3);
    directions(0, 0) = 1.0;
    directions.col(1).head<2>() = pose.position;
    directions.col(2).head<3>() << -pose.position.y(), pose.position.x(), 1.0;
    for (std::size_t i = 0; i < legs; ++i) {
      const Leg& leg = manipulator.leg(i);
      directions(coordinate_count(i), 0) = 1.0;
      directions.col(1).segment<4>(coordinate_count(i)) << leg.base_joint, leg.platform_joint;
      directions.col(2).segment<2>(coordinate_count(i)) << -leg.base_joint.y(), leg.base_joint.x();
    }
    Eigen::VectorXd gradient(3);
    kappa_inverse(manipulator, pose, homogeneous, directions, gradient);
    BOOST_TEST(gradient.norm() <= 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(the_family_has_its_gradient_along_position_orientation_and_design) {
  std::mt19937 random(47);
  for (const Conditioning& conditioning : conditionings) {
    TaylorRemainders remainders;
    for (int sample = 0; sample < 30; ++sample) {
      const CollinearDesign design{-1.0 + 0.2 * uniform(random, -1.0, 1.0), 0.1, 1.2, 1.8, 0.9};
      const Pose pose{{1.0 + 0.3 * uniform(random, -1.0, 1.0), 1.5}, uniform(random, -0.2, 0.2)};
      const CollinearKappaInverse result = collinear_kappa_inverse(design, pose, conditioning);
      BOOST_TEST(result.value == kappa_inverse(collinear(design), pose, conditioning));
      const Eigen::VectorXd step = uniform_vector(random, 8);
      const double slope =
          result.position.dot(step.head<2>()) + result.orientation * step[2] + result.design.dot(step.tail<5>());
      remainders.add(
          [&](double t) {
            const Eigen::Matrix<double, 5, 1> d = to_vector(design) + t * step.tail<5>();
            const Pose other{pose.position + t * step.head<2>(), pose.orientation + t * step[2]};
            return kappa_inverse(collinear(to_collinear_design(d)), other, conditioning);
          },
          result.value, slope, 0.0);
    }
    BOOST_TEST(remainders.first_order() == 2.0, tt::tolerance(0.02));
  }
  BOOST_CHECK_THROW(collinear_kappa_inverse({not_a_number, 0.0, 1.0, 2.0, 1.0}, origin_pose), std::invalid_argument);
}

// Table 5.3 of the thesis prints f(d0) = 0.768 for prescribed workspace P2. Its outline, here an ellipse, is a
// reconstruction (the thesis's Section 4.7 is not available).
BOOST_AUTO_TEST_CASE(the_printed_value_at_the_start_of_the_synthesis_for_p2_is_met) {
  const Manipulator manipulator = collinear({-1.0, 0.0, 1.0, 2.0, 1.0});
  double smallest = 1.0;
  for (int i = 0; i < 20000; ++i) {
    const double t = 2.0 * pi * i / 20000.0;
    const Pose pose{{1.0 + 1.75 / 5.0 * std::cos(t), 1.5 + 1.0 / 5.0 * std::sin(t)}, 0.0};
    smallest = std::min(smallest, kappa_inverse(manipulator, pose, printed));
  }
  BOOST_TEST(std::abs(smallest - 0.768) <= 0.0005);
}

// The sign of a determinant that is zero must not show.
BOOST_AUTO_TEST_CASE(zero_has_no_sign) {
  for (const double side : {1.0, -1.0}) {
    const Manipulator two("two", {leg_between({-side, 0.0}, {0.0, 0.0}), leg_between({2.0 * side, 0.0}, {0.0, 0.0})});
    const Manipulator three("three", {leg_between({0.0, -side}, {0.0, 0.0}), leg_between({side, 0.0}, {0.0, 0.0}),
                                      leg_between({-side, 0.0}, {0.0, 0.0})});
    for (const Manipulator& manipulator : {two, three}) {
      const double value = kappa_inverse(manipulator, origin_pose, {Normalisation::homogeneous, 1.0});
      BOOST_TEST(value == 0.0);
      BOOST_TEST(!std::signbit(value));
    }
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_rejected) {
  std::mt19937 random(48);
  const Manipulator manipulator = random_manipulator(random, 3);
  const Pose pose = random_pose(random);
  BOOST_CHECK_THROW(kappa_inverse(random_manipulator(random, 1), pose), std::invalid_argument);
  BOOST_CHECK_THROW(kappa_inverse_2norm(random_manipulator(random, 1), pose), std::invalid_argument);
  for (const double bad : {not_a_number, infinity, -infinity}) {
    BOOST_CHECK_THROW(kappa_inverse(manipulator, {{bad, 0.0}, 0.0}), std::invalid_argument);
    BOOST_CHECK_THROW(kappa(manipulator, {{0.0, bad}, 0.0}), std::invalid_argument);
    BOOST_CHECK_THROW(kappa_inverse_2norm(manipulator, {{0.0, 0.0}, bad}), std::invalid_argument);
  }
  Eigen::VectorXd gradient(4), short_gradient(3);
  Eigen::MatrixXd hessian(4, 4), wide_hessian(4, 5), high_hessian(5, 4);
  const Eigen::MatrixXd directions = Eigen::MatrixXd::Identity(15, 4);
  for (const double bad : {0.0, -1.0, not_a_number, infinity, 8e298, 1e-101}) {
    const Conditioning conditioning{Normalisation::homogeneous, bad};
    BOOST_CHECK_THROW(kappa_inverse(manipulator, pose, conditioning), std::invalid_argument);
    BOOST_CHECK_THROW(kappa_inverse_2norm(manipulator, pose, conditioning), std::invalid_argument);
    BOOST_CHECK_THROW(characteristic_length(manipulator, conditioning), std::invalid_argument);
    BOOST_CHECK_THROW(kappa_inverse(manipulator, pose, conditioning, directions, gradient), std::invalid_argument);
  }
  BOOST_CHECK_THROW(kappa_inverse(manipulator, pose, {}, directions, short_gradient), std::invalid_argument);
  BOOST_CHECK_THROW(kappa_inverse(manipulator, pose, {}, directions.topRows(14), gradient), std::invalid_argument);
  BOOST_CHECK_THROW(kappa_inverse(manipulator, pose, {}, directions, gradient, wide_hessian), std::invalid_argument);
  BOOST_CHECK_THROW(kappa_inverse(manipulator, pose, {}, directions, gradient, high_hessian), std::invalid_argument);
  BOOST_CHECK_NO_THROW(kappa_inverse(manipulator, pose, {}, directions, gradient, hessian));
}

BOOST_AUTO_TEST_CASE(the_side_is_the_sign_of_the_jacobians_determinant) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 100; ++trial) {
    const Manipulator three = random_manipulator(random, 3);
    const Manipulator two = random_manipulator(random, 2);
    const Pose pose = random_pose(random);
    BOOST_TEST(singularity_side(three, pose) == (jacobian(three, pose).topRows<3>().determinant() > 0.0 ? 1 : -1));
    BOOST_TEST(singularity_side(two, pose) == (jacobian(two, pose).topLeftCorner<2, 2>().determinant() > 0.0 ? 1 : -1));
  }
  BOOST_CHECK_THROW(singularity_side(random_manipulator(random, 4), Pose{{0.0, 0.0}, 0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(many_positions_are_as_each_alone) {
  std::mt19937 random(61);
  for (std::size_t legs = 2; legs <= 5; ++legs) {
    for (Eigen::Index count = 0; count <= 13; ++count) {
      const Manipulator manipulator = random_manipulator(random, legs);
      const double orientation = uniform(random, -pi, pi);
      Eigen::ArrayXd x = 2.0 * uniform_vector(random, count);
      Eigen::ArrayXd y = 2.0 * uniform_vector(random, count);
      if (count > 5) {
        // Here the first leg has length zero.
        const Eigen::Vector2d at = -leg_vector(manipulator.leg(0), {Eigen::Vector2d::Zero(), orientation});
        x[5] = at.x();
        y[5] = at.y();
      }
      for (const Conditioning& conditioning : conditionings) {
        Eigen::ArrayXd values(count);
        kappa_inverse_at(manipulator, orientation, x, y, conditioning, values);
        for (Eigen::Index i = 0; i < count; ++i) {
          BOOST_TEST(values[i] == kappa_inverse(manipulator, {{x[i], y[i]}, orientation}, conditioning));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(many_positions_must_be_finite_and_have_as_many_values) {
  const Manipulator manipulator = tangential(3, 1.0);
  const Eigen::ArrayXd zeros = Eigen::ArrayXd::Zero(9);
  Eigen::ArrayXd values(9);
  Eigen::ArrayXd too_few(8);
  BOOST_CHECK_THROW(kappa_inverse_at(manipulator, 0.0, zeros, zeros, homogeneous, too_few), std::invalid_argument);
  BOOST_CHECK_THROW(kappa_inverse_at(manipulator, 0.0, zeros, too_few, homogeneous, values), std::invalid_argument);
  BOOST_CHECK_THROW(kappa_inverse_at(manipulator, not_a_number, zeros, zeros, homogeneous, values),
                    std::invalid_argument);
  for (const Eigen::Index i : {1, 8}) {
    for (const double wrong : {not_a_number, std::numeric_limits<double>::infinity()}) {
      Eigen::ArrayXd x = zeros;
      x[i] = wrong;
      BOOST_CHECK_THROW(kappa_inverse_at(manipulator, 0.0, x, zeros, homogeneous, values), std::invalid_argument);
      BOOST_CHECK_THROW(kappa_inverse_at(manipulator, 0.0, zeros, x, homogeneous, values), std::invalid_argument);
    }
  }
}
