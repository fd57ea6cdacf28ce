#include <boost/test/unit_test.hpp>
#include <limits>

#include "reprise/synthesis/design_space.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;

BOOST_AUTO_TEST_SUITE(design_space)

BOOST_AUTO_TEST_CASE(collinear_designs_are_those_of_the_kinematics) {
  const DesignSpace space = DesignSpace::collinear(samples::thesis_lengths());
  BOOST_TEST(space.size() == 5);
  BOOST_TEST(space.names()[1] == "y_C");
  const CollinearDesign design{-1.153, 0.3003, 1.275, 1.906, 0.9401};
  const Manipulator made = space.manipulator(to_vector(design));
  const auto back = collinear_design(made);
  BOOST_REQUIRE(back.has_value());
  BOOST_TEST((to_vector(*back) == to_vector(design)));
  BOOST_TEST(made.leg(2).length.upper == std::numbers::sqrt3);
}

BOOST_AUTO_TEST_CASE(designs_depend_affinely_on_their_vector) {
  const DesignSpace space = samples::general_space();
  const Eigen::Vector4d a(0.1, -0.05, 0.02, 0.03);
  const Eigen::Vector4d b(-0.02, 0.08, 0.04, -0.06);
  const Manipulator at_a = space.manipulator(a);
  const Manipulator at_b = space.manipulator(b);
  const Manipulator between = space.manipulator(0.25 * a + 0.75 * b);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto mixed = [](const auto& of_a, const auto& of_b) { return (0.25 * of_a + 0.75 * of_b).eval(); };
    BOOST_TEST((between.leg(i).base_joint - mixed(at_a.leg(i).base_joint, at_b.leg(i).base_joint)).norm() < 1e-15);
    BOOST_TEST((between.leg(i).platform_joint - mixed(at_a.leg(i).platform_joint, at_b.leg(i).platform_joint)).norm() <
               1e-15);
    BOOST_TEST(between.leg(i).base_angle.has_value() == (i == 0));
  }
  BOOST_TEST(at_a.leg(1).length.lower == 1.1 + 0.3 * a[1]);
  BOOST_TEST(at_a.leg(1).length.upper == 2.6 - 0.4 * a[2]);
}

// The same family written about another of its designs.
BOOST_AUTO_TEST_CASE(the_origin_is_the_manipulator_of_the_reference) {
  const DesignSpace space = samples::general_space();
  const Eigen::Vector4d reference(0.1, -0.05, 0.02, 0.03);
  const DesignSpace about(space.manipulator(reference), space.names(), space.joint_map(), space.length_map(), {}, {},
                          reference);
  const Eigen::Vector4d d(-0.02, 0.08, 0.04, -0.06);
  for (std::size_t i = 0; i < 3; ++i) {
    const Leg leg = space.manipulator(d).leg(i);
    const Leg same = about.manipulator(d).leg(i);
    BOOST_TEST((leg.base_joint - same.base_joint).norm() < 1e-15);
    BOOST_TEST((leg.platform_joint - same.platform_joint).norm() < 1e-15);
    BOOST_TEST(std::abs(leg.length.upper - same.length.upper) < 1e-15);
    BOOST_TEST((about.origin().leg(i).base_joint == about.manipulator(reference).leg(i).base_joint));
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  const Manipulator origin = samples::general_manipulator();
  const Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(12, 2);
  const Eigen::MatrixXd lengths = Eigen::MatrixXd::Zero(6, 2);
  const std::vector<std::string> names{"a", "b"};
  BOOST_CHECK_NO_THROW(DesignSpace(origin, names, joints, lengths));
  BOOST_CHECK_THROW(DesignSpace(origin, {}, joints, lengths), std::invalid_argument);
  BOOST_CHECK_THROW(DesignSpace(origin, {"a"}, joints, lengths), std::invalid_argument);
  BOOST_CHECK_THROW(DesignSpace(origin, names, joints.topRows(11), lengths), std::invalid_argument);
  BOOST_CHECK_THROW(DesignSpace(origin, names, joints, lengths.topRows(5)), std::invalid_argument);
  BOOST_CHECK_THROW(DesignSpace(origin, names, joints.array() + std::numeric_limits<double>::infinity(), lengths),
                    std::invalid_argument);
  BOOST_CHECK_THROW(DesignSpace(origin, names, joints, lengths, Eigen::VectorXd::Zero(1)), std::invalid_argument);
  BOOST_CHECK_THROW(DesignSpace(origin, names, joints, lengths, Eigen::Vector2d(0.0, 2.0), Eigen::Vector2d(1.0, 1.0)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(DesignSpace(origin, names, joints, lengths, {}, {}, Eigen::VectorXd::Zero(3)),
                    std::invalid_argument);
  const DesignSpace space(origin, names, joints, lengths);
  BOOST_CHECK_THROW(space.manipulator(Eigen::VectorXd::Zero(3)), std::invalid_argument);
  BOOST_CHECK_THROW(space.manipulator(Eigen::Vector2d(0.0, std::numeric_limits<double>::quiet_NaN())),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
