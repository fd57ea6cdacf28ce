#pragma once

// Angles of the revolute joints and their limits (thesis chapter 5, eq. (5.4)). All angles are radians,
// counter-clockwise. Angles are returned in [-pi, pi].

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// The same angle in [-pi, pi]; not a number for an angle that is not finite.
double wrap_angle(double angle);

/// The angle at the base joint: the direction of a_i in the world frame. A leg of length zero has no direction; its
/// angle is not a number, which lies in no interval.
double base_angle(const Leg& leg, const Pose& pose);

/// The angle at the platform joint: the direction of a_i in the platform frame, that is, base_angle less phi. Not a
/// number for a leg of length zero.
double platform_angle(const Leg& leg, const Pose& pose);

/// How far an angle lies inside an interval that is swept counter-clockwise from lower to upper: the angular distance
/// to the nearer end, positive inside, zero at the ends, negative outside. It depends on the angle modulo 2 pi only and
/// is continuous in it, so that limits may be used as constraints. Throws std::invalid_argument unless the bounds are
/// finite and upper - lower is in (0, 2 pi].
double angle_margin(const Interval& interval, double angle);

/// Whether the angle lies in the swept interval (ends included, up to rounding). Throws as angle_margin.
bool contains_angle(const Interval& interval, double angle);

}  // namespace reprise
