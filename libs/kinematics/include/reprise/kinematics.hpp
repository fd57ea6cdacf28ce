#pragma once

// The whole library: manipulators, poses and their conditioning.

#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/conditioning_field.hpp"
#include "reprise/kinematics/coordinates.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "reprise/kinematics/kappa_inverse_formula.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/kinematics/orientation_range.hpp"
#include "reprise/kinematics/singular_positions.hpp"
