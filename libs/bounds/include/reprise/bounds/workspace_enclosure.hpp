#pragma once

// Rigorous bounds of the smallest kappa^-1 over a manipulator's own workspace at one orientation.
//
// Branch and bound over the positions: boxes of positions are bounded in interval arithmetic as enclosure.hpp says, and
// thrown away where a limit is violated in all of the box, and where all limits hold with room and kappa^-1 has a
// slope. At the boundary, where the smallest value mostly is, kappa^-1 has a slope and a box reaches beyond the limits.
// There the bounds are those of a Lagrangian: with factors lambda_j >= 0, whatever they are,
//     f(u) >= f(u) + sum_j lambda_j h_j(u)    where all h_j(u) <= 0,
// and with the factors of the smallest value the right-hand side has no slope, so that its mean value form is sharp.

#include <Eigen/Core>
#include <span>

#include "reprise/bounds/enclosure.hpp"

namespace reprise {

/// Encloses the smallest kappa^-1 over the constant-orientation workspace (radians). `lower` holds for all positions at
/// which every limit holds. The witness violates none by more than `allowance` (a length, at least 0; rounding puts
/// most positions on a boundary a little beyond it). `candidates` are positions at which the value is believed to be
/// small; any will do. An empty workspace, proved to be, gives lower = upper = infinity and no witness. `evaluations`
/// are those of kappa^-1 over boxes and at positions.
///
/// Throws std::invalid_argument as ConstantOrientationLimits and kappa_inverse do, for an allowance that is negative or
/// not finite, and for options out of their range.
MinimumEnclosure enclose_minimum_in_workspace(const Manipulator& manipulator, double orientation, double allowance,
                                              std::span<const Eigen::Vector2d> candidates,
                                              const Conditioning& conditioning = {},
                                              const EnclosureOptions& options = {});

}  // namespace reprise
