#pragma once

// Derivatives of the limits of the dextrous workspace (dextrous_limits.hpp) along position and joints, for whoever
// varies them.

#include "reprise/workspace/limits.hpp"

namespace reprise {

/// First and second derivatives of h, the largest value of a leg's limit over a range of orientations, along
/// z = [w, p] in R^4 with w = u - c. Along position and joints they follow from the chain rule with dw/du = I,
/// dw/dc = -I.
struct DextrousLimitDerivatives {
  Eigen::Vector4d gradient;  ///< dh/dz
  Eigen::Matrix4d hessian;   ///< symmetric
};

/// The derivatives where h is taken at the critical orientation (radians; DextrousLimits::critical_orientation at u).
/// The gradient is that at this orientation, held fixed (Danskin's theorem). The Hessian is so too where the
/// orientation is an end of the range; within the range it adds what the orientation's own change with z contributes.
///
/// h is smooth except where
///   - it is taken at both ends of the range alike: a kink; the orientation given decides;
///   - the critical orientation comes to an end of the range: the Hessian jumps, the gradient does not;
///   - w = 0 or p = 0, and where limit_derivatives says so.
/// Cut the range in two at its middle, and h is the larger of two functions neither of which has a kink of the first
/// kind where it is the larger one: a sinusoid that is alike at both ends of one half, and lower between, rises on
/// through the other half.
///
/// The kind must be one that the leg has (as for limit_value).
DextrousLimitDerivatives dextrous_limit_derivatives(const Leg& leg, LimitKind kind, const Eigen::Vector2d& w,
                                                    const Interval& orientations, double critical_orientation);

}  // namespace reprise
