#pragma once

// Constraint equations and Jacobians (thesis chapter 5, eqs. (5.8) to (5.13)) for any number of legs n.
//
// With theta = [x, y, phi] and the input lengths v = [l_1, ..., l_n] the constraint equations are
//     Phi_i(theta, v) = v_i^2 - |a_i(theta)|^2 = 0                                                 (5.8)
// and their Jacobians, with b_i = R(phi) p_i turned by a quarter as b_i' = [-b_iy, b_ix],
//     J_theta = dPhi / dtheta = -2 [a_ix, a_iy, a_i . b_i'],          J_v = dPhi / dv = 2 diag(v).   (5.10)
// (Eq. (5.12) prints -J_theta / 2 and J_v / 2.) The inverse kinematics v(theta) has the Jacobian
//     J = dv / dtheta = -J_v^-1 J_theta,    row i: [a_ix, a_iy, a_i . b_i'] / l_i.                   (5.11)
// Columns 1 and 2 of J have no unit, column 3 is a length per radian.

#include <Eigen/Core>

#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// Phi (size n), in squared lengths. Throws std::invalid_argument unless `lengths` has size n.
Eigen::VectorXd constraints(const Manipulator& manipulator, const Pose& pose,
                            const Eigen::Ref<const Eigen::VectorXd>& lengths);

/// J_theta (n x 3); it does not depend on the lengths.
Eigen::MatrixX3d constraint_pose_jacobian(const Manipulator& manipulator, const Pose& pose);

/// J_v (n x n, diagonal); it depends on nothing but the lengths.
Eigen::DiagonalMatrix<double, Eigen::Dynamic> constraint_length_jacobian(
    const Eigen::Ref<const Eigen::VectorXd>& lengths);

/// J (n x 3) of the inverse kinematics. A leg of length zero has no direction; its row is given as zero.
Eigen::MatrixX3d jacobian(const Manipulator& manipulator, const Pose& pose);

/// J normalised for the condition number as conditioning.hpp says; for `printed` that is eq. (5.13). Where the
/// characteristic length L is zero, a column that would be divided by it is given as zero. Throws
/// std::invalid_argument when a given L is out of its bounds.
Eigen::MatrixX3d normalised_jacobian(const Manipulator& manipulator, const Pose& pose,
                                     const Conditioning& conditioning = {});

}  // namespace reprise
