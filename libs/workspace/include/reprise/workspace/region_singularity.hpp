#pragma once

// Where the singular positions of singular_positions.hpp meet a region.
//
// A component of the region is connected. So it holds a zero of the polynomial D where D has both signs in it, and
// where its least |D| is zero: the curve then only touches the component, or D has one sign on both sides of it (a
// double line). Both are decided by the extremes of D, which lie on the boundary, where D is a polynomial of second
// degree along a segment and a trigonometric polynomial of second order along an arc, or at the one stationary position
// of D, its centre. (A curve that lies wholly inside is an ellipse about that centre.)

#include <Eigen/Core>
#include <vector>

#include "reprise/geometry/region.hpp"
#include "reprise/kinematics/singular_positions.hpp"

namespace reprise {

/// Positions of a region at which D is zero, to rounding: where its curve crosses the boundary and, where it crosses
/// none, one on it. Last comes, for each component, the position at which |D| is least of those looked at, which is
/// zero where the curve only touches. So there are singular positions where one of these is singular. (Some may be
/// where a leg has length zero, to rounding: there D is zero, but the leg's direction is made up by rounding.) Empty
/// for an empty region.
std::vector<Eigen::Vector2d> nearest_to_singular(const Region& region, const SingularityPolynomial& polynomial);

}  // namespace reprise
