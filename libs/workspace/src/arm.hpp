#pragma once

// The scale on which orientations act on lengths.

#include <algorithm>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// The largest |p_i|: a turn by dphi moves no platform joint by more than this times dphi. Where all platform joints
/// lie at P, so that orientations move nothing, the largest leg length, or 1 if that is zero too.
inline double longest_arm(const Manipulator& manipulator) {
  double arm = 0.0;
  double length = 0.0;
  for (const Leg& leg : manipulator.legs()) {
    arm = std::max(arm, leg.platform_joint.norm());
    length = std::max(length, leg.length.upper);
  }
  if (arm > 0.0) return arm;
  return length > 0.0 ? length : 1.0;
}

}  // namespace reprise
