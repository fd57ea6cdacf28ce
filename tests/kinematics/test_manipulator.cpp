#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "kinematics/samples.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/kinematics/manipulator.hpp"

using namespace reprise;
using namespace reprise::test;
namespace tt = boost::test_tools;

namespace {

constexpr std::array<Interval, 3> one_to_two = {{{1.0, 2.0}, {1.0, 2.0}, {1.0, 2.0}}};
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Whether building a manipulator with `leg` as its second leg throws with a message that contains `words`.
bool rejects(const Leg& leg, const std::string& words) {
  try {
    const Manipulator manipulator("bad", {leg_between({0.0, 0.0}, {1.0, 0.0}), leg});
  } catch (const std::invalid_argument& error) {
    return std::string(error.what()).find("leg 2") != std::string::npos &&
           std::string(error.what()).find(words) != std::string::npos;
  }
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(leg_lengths_of_the_family_are_those_of_equation_5_7) {
  std::mt19937 random(1);
  for (int sample = 0; sample < 100; ++sample) {
    const CollinearDesign d = to_collinear_design(uniform_vector(random, 5));
    const Pose pose = random_pose(random);
    const double x = pose.position.x();
    const double y = pose.position.y();
    const double c = std::cos(pose.orientation);
    const double s = std::sin(pose.orientation);
    const Eigen::VectorXd lengths = leg_lengths(make_manipulator(d, one_to_two), pose);
    BOOST_TEST(lengths[0] == std::sqrt(std::pow(x - d.r * c - d.x_c, 2) + std::pow(y - d.r * s - d.y_c, 2)),
               tt::tolerance(1e-13));
    BOOST_TEST(lengths[1] == std::sqrt(std::pow(x - d.r * c - d.x_d, 2) + std::pow(y - d.r * s - d.y_c, 2)),
               tt::tolerance(1e-13));
    BOOST_TEST(lengths[2] == std::sqrt(std::pow(x + d.r * c - d.x_e, 2) + std::pow(y + d.r * s - d.y_c, 2)),
               tt::tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(leg_lengths_do_not_depend_on_where_the_world_frame_is) {
  std::mt19937 random(2);
  for (std::size_t legs = 1; legs <= 6; ++legs) {
    const Manipulator manipulator = random_manipulator(random, legs);
    const Pose pose = random_pose(random);
    const auto [other, other_pose] = moved(manipulator, pose, 0.7, {3.0, -2.0}, 1000.0);
    const Eigen::VectorXd difference = leg_lengths(other, other_pose) - 1000.0 * leg_lengths(manipulator, pose);
    BOOST_TEST(difference.norm() <= 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(designs_convert_both_ways_to_the_last_bit) {
  std::mt19937 random(3);
  for (int sample = 0; sample < 100; ++sample) {
    const Eigen::Matrix<double, 5, 1> d = uniform_vector(random, 5);
    const Manipulator manipulator = make_manipulator(to_collinear_design(d), one_to_two);
    const std::optional<CollinearDesign> back = collinear_design(manipulator);
    BOOST_TEST_REQUIRE(back.has_value());
    BOOST_TEST((to_vector(*back) == d));

    Eigen::Matrix<double, 12, 1> joints;
    for (std::size_t i = 0; i < 3; ++i) {
      joints.segment<4>(4 * static_cast<Eigen::Index>(i)) << manipulator.leg(i).base_joint,
          manipulator.leg(i).platform_joint;
    }
    BOOST_TEST((collinear_design_map() * d == joints));
  }
}

BOOST_AUTO_TEST_CASE(manipulators_outside_the_family_have_no_design) {
  std::mt19937 random(4);
  BOOST_TEST(!collinear_design(random_manipulator(random, 3)));
  BOOST_TEST(!collinear_design(random_manipulator(random, 2)));
  std::vector<Leg> legs = make_manipulator({-1.0, 0.0, 1.0, 2.0, 1.0}, one_to_two).legs();
  legs[1].base_joint.y() = std::nextafter(0.0, 1.0);
  BOOST_TEST(!collinear_design(Manipulator("off by one bit", legs)));
}

BOOST_AUTO_TEST_CASE(bad_legs_are_rejected_by_name) {
  const Leg good = leg_between({0.0, 0.0}, {1.0, 0.0});
  BOOST_TEST(!rejects(good, ""));
  for (const double bad : {not_a_number, infinity, -infinity}) {
    Leg leg = good;
    leg.base_joint.y() = bad;
    BOOST_TEST(rejects(leg, "base joint"));
    leg = good;
    leg.platform_joint.x() = bad;
    BOOST_TEST(rejects(leg, "platform joint"));
    leg = good;
    leg.length.lower = bad;
    BOOST_TEST(rejects(leg, "minimum length"));
    leg = good;
    leg.length.upper = bad;
    BOOST_TEST(rejects(leg, "maximum length"));
    leg = good;
    leg.base_angle = Interval{0.0, bad};
    BOOST_TEST(rejects(leg, "base angle"));
    leg.base_angle.reset();
    leg.platform_angle = Interval{bad, 0.0};
    BOOST_TEST(rejects(leg, "platform angle"));
  }
  Leg leg = good;
  leg.length = {-1e-300, 1.0};
  BOOST_TEST(rejects(leg, "minimum length"));
  leg.length = {2.0, 1.0};
  BOOST_TEST(rejects(leg, "maximum length"));
  leg = good;
  leg.base_angle = Interval{1.0, 1.0};
  BOOST_TEST(rejects(leg, "base angle"));
  leg.base_angle = Interval{0.0, 2.0 * pi};
  BOOST_TEST(rejects(leg, "base angle"));
  BOOST_CHECK_THROW(Manipulator("none", {}), std::invalid_argument);
  BOOST_CHECK_THROW(make_manipulator({not_a_number, 0.0, 0.0, 0.0, 0.0}, one_to_two), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_leg_of_fixed_or_zero_length_is_allowed) {
  const Manipulator manipulator("rod", {Leg{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {}, {}}});
  BOOST_TEST(leg_length(manipulator.leg(0), {{0.0, 0.0}, 1.0}) == 0.0);
  BOOST_CHECK_THROW(manipulator.leg(1), std::out_of_range);
}
