#pragma once

// Planar parallel manipulators: a platform joined to the base by legs of variable length.
//
// Leg i joins base joint c_i (world frame) to platform joint p_i (platform frame, whose origin is the working point P
// and which is turned by the platform orientation phi). At the pose (u, phi) the vector from base joint to platform
// joint is
//     a_i(u, phi) = u + R(phi) p_i - c_i,            l_i(u, phi) = |a_i(u, phi)|
// which is the inverse kinematics of thesis chapter 5, eq. (5.7), for any joints and any number of legs.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace reprise {

/// A closed interval [lower, upper] of lengths or angles.
struct Interval {
  double lower;  ///< the least value
  double upper;  ///< the greatest value
};

/// One leg (an RPR chain): a revolute joint on the base, a linear actuator, a revolute joint on the platform.
struct Leg {
  /// c_i, world frame, length unit of the manipulator.
  Eigen::Vector2d base_joint;
  /// p_i, platform frame (origin P), length unit of the manipulator.
  Eigen::Vector2d platform_joint;
  /// [l_i^min, l_i^max] of eq. (5.3); 0 <= lower <= upper <= 1e120 (squares of more overflow).
  Interval length;
  /// Limits (5.4) on the joint at the base: the direction of a_i in the world frame, radians, as an interval that is
  /// swept counter-clockwise from lower to upper; upper - lower in (0, 2 pi).
  std::optional<Interval> base_angle;
  /// Limits (5.4) on the joint at the platform: the direction of a_i in the platform frame, that is, its direction in
  /// the world frame less phi; as above.
  std::optional<Interval> platform_angle;
};

/// Position u of the working point P (world frame) and platform orientation phi (radians, counter-clockwise).
struct Pose {
  Eigen::Vector2d position;  ///< of the working point P, in the world frame
  double orientation = 0.0;  ///< phi, radians
};

/// A manipulator with at least one leg. A value; once built it is valid.
class Manipulator {
 public:
  /// Throws std::invalid_argument, naming the leg, the quantity, its value and what is allowed, when there is no leg or
  /// a leg has a joint coordinate or length beyond +-1e120, a negative or reversed length limit, or an angle interval
  /// that is not finite or whose width is not in (0, 2 pi).
  Manipulator(std::string name, std::vector<Leg> legs);

  const std::string& name() const { return name_; }                    ///< as messages call it
  const std::vector<Leg>& legs() const { return legs_; }               ///< in the order in which they were given
  const Leg& leg(std::size_t index) const { return legs_.at(index); }  ///< from 0; throws std::out_of_range
  std::size_t size() const { return legs_.size(); }                    ///< number of legs

 private:
  std::string name_;
  std::vector<Leg> legs_;
};

/// The thesis's family of 3-RPR manipulators, d = [x_C, y_C, x_D, x_E, r] (eq. (5.36)): base joints C, D, E in line at
/// height y_C; legs 1 and 2 share the platform joint A at (-r, 0), leg 3 ends at B, (r, 0).
struct CollinearDesign {
  double x_c;  ///< x_C
  double y_c;  ///< y_C = y_D = y_E
  double x_d;  ///< x_D
  double x_e;  ///< x_E
  double r;    ///< half the platform's length
};

/// The manipulator of a design, with the length limits of legs 1, 2, 3. Throws as Manipulator does.
Manipulator make_manipulator(const CollinearDesign& design, const std::array<Interval, 3>& lengths,
                             std::string name = "collinear 3-RPR");

/// The design of a manipulator of the family, or nothing when it is not of it (joint coordinates are compared exactly:
/// make_manipulator and collinear_design are inverse to each other to the last bit).
std::optional<CollinearDesign> collinear_design(const Manipulator& manipulator);

/// The design as a vector in the thesis's order [x_C, y_C, x_D, x_E, r], and back.
Eigen::Matrix<double, 5, 1> to_vector(const CollinearDesign& design);
/// The design with these parameters, in the same order.
CollinearDesign to_collinear_design(const Eigen::Matrix<double, 5, 1>& d);

/// The family is linear in its parameters: joint_coordinates = collinear_design_map() * d, with the twelve joint
/// coordinates ordered leg by leg as [c_x, c_y, p_x, p_y].
Eigen::Matrix<double, 12, 5> collinear_design_map();

/// a_i(u, phi), from base joint to platform joint.
Eigen::Vector2d leg_vector(const Leg& leg, const Pose& pose);

/// l_i(u, phi) of eq. (5.7). Defined at every pose, whether or not the leg's limits allow it.
double leg_length(const Leg& leg, const Pose& pose);

/// All leg lengths v = [l_1, ..., l_n].
Eigen::VectorXd leg_lengths(const Manipulator& manipulator, const Pose& pose);

}  // namespace reprise
