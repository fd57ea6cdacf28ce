#pragma once

// The orientation workspace W^O[u] (thesis chapter 5, eq. (5.24)): all orientations that can be attained at a position.
//
// Each limit allows the orientations where a sinusoid in phi (see dextrous_limits.hpp) has one sign, so its ends are
// known in closed form, and W^O is the intersection of all: any number of intervals. The thesis computes, by the
// optimization (5.26), the ends of the one that holds a given orientation w_ave: see orientation_solver.hpp.

#include <Eigen/Core>
#include <vector>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// All intervals of W^O[u], radians, in increasing order, with lower ends in [-pi, pi) (an interval may reach beyond
/// pi); [-pi, pi] when every orientation can be attained, and nothing when none can. Throws std::invalid_argument when
/// u is not finite.
///
/// Where a limit is only touched, rounding must not decide. An orientation counts as attained when no limit is violated
/// by more than 1e-14 s there, s being the largest of the lengths of leg and arm and the distance of u from the base
/// joints. So an interval in which a limit is touched from inside is one interval; two intervals have a gap between
/// them in which some limit is violated by more. Single orientations, where a limit is only touched from outside, are
/// left out: an interval narrower than 1e-6 rad belongs to the result only when all limits hold in it with 1e-14 s to
/// spare. Ends at which a limit is crossed are accurate to rounding, those near a tangency to its square root, some
/// 1e-7 rad.
std::vector<Interval> orientation_workspace(const Manipulator& manipulator, const Eigen::Vector2d& u);

}  // namespace reprise
