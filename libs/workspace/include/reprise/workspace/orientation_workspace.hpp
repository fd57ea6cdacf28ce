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
/// pi); [-pi, pi] when every orientation can be attained, and nothing when none can. Single orientations (where a limit
/// is only touched) are left out. Throws std::invalid_argument when u is not finite.
std::vector<Interval> orientation_workspace(const Manipulator& manipulator, const Eigen::Vector2d& u);

}  // namespace reprise
