#pragma once

// The coordinates in which derivatives are given, and the derivatives of leg lengths in them.
//
// A manipulator with n legs at a pose has the 3 + 4 n coordinates
//     q = [x, y, phi,  c_1x, c_1y, p_1x, p_1y,  ...,  c_nx, c_ny, p_nx, p_ny],
// position and orientation of the platform, then leg by leg the base joint and the platform joint.
//
// A caller seldom wants the derivatives along all of them. Every derivative here is therefore taken along the columns
// of a matrix S of size (3 + 4 n) x k: for the k variables z with q = q_0 + S z, the gradient of a function f is
// S^T df/dq and its Hessian S^T (d2f/dq2) S. The identity gives the derivatives along all coordinates; the last five
// columns of collinear_directions() give those along the thesis's design parameters.

#include <Eigen/Core>
#include <cstddef>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// 3 + 4 n.
constexpr Eigen::Index coordinate_count(std::size_t legs) { return 3 + 4 * static_cast<Eigen::Index>(legs); }

/// The directions of [x, y, phi, x_C, y_C, x_D, x_E, r] for the thesis's family (eq. (5.36)).
Eigen::Matrix<double, 15, 8> collinear_directions();

/// l_i with its gradient (size k) along the columns of `directions` ((3 + 4 n) x k). A leg of length zero has no
/// direction; its derivatives are then given as zero, which is a subgradient. Allocates nothing. Throws
/// std::invalid_argument when `leg` is not below n or a size does not fit.
double leg_length(const Manipulator& manipulator, std::size_t leg, const Pose& pose,
                  const Eigen::Ref<const Eigen::MatrixXd>& directions, Eigen::Ref<Eigen::VectorXd> gradient);

/// The same with the Hessian (k x k), both of its triangles.
double leg_length(const Manipulator& manipulator, std::size_t leg, const Pose& pose,
                  const Eigen::Ref<const Eigen::MatrixXd>& directions, Eigen::Ref<Eigen::VectorXd> gradient,
                  Eigen::Ref<Eigen::MatrixXd> hessian);

}  // namespace reprise
