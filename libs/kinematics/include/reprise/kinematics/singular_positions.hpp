#pragma once

// The singular positions at a fixed orientation, as the zeros of a polynomial of second degree.
//
// With b_i = R(phi) p_i and q_i = c_i - b_i the leg vectors are a_i = u - q_i, and row i of the Jacobian times the leg
// length is [a_ix, a_iy, b_i x a_i] (eq. (5.11)). So a pose of three legs is singular, or has a leg of length zero,
// where
//     D(u) = det [u - q_i, b_i x (u - q_i)] = 0.
// Row i is the sum of u-terms and of constants: with the columns 1 = (1, 1, 1), q_x, q_y, b_x, b_y and m_i = b_i x q_i,
// the third column is u_y b_x - u_x b_y - m, and the rule for sums of columns leaves (square brackets are determinants
// of three columns)
//     D(u) =   [1, q_y, b_y] u_x^2 + ([q_x, 1, b_y] - [1, q_y, b_x]) u_x u_y - [q_x, 1, b_x] u_y^2
//            + ([1, q_y, m] - [q_x, q_y, b_y]) u_x + ([q_x, 1, m] + [q_x, q_y, b_x]) u_y - [q_x, q_y, m],
// a conic through all q_i. No term of third degree is left, since two of its columns are equal. For two legs,
//     D(u) = (u - q_1) x (u - q_2) = (q_2 - q_1) x u + q_1 x q_2,
// the line through q_1 and q_2.
//
// D does not change when all b_i are shifted alike, for the third column then changes by a multiple of the others, nor
// when u and all q_i are; it is computed from b_i less their mean, and about the mean of the q_i.
//
// Degenerate cases:
//     pair of lines    among others, a mirror-symmetric manipulator in a mirror-symmetric pose: the mirror line is one
//                      of them. Both may be the same line, on both sides of which D has the same sign; one may be at
//                      infinity, which leaves a single line
//     everything       D is zero with all its coefficients: among others, where all legs end in one platform joint, or
//                      in one base joint, where two legs are the same, where all q_i are one point (two legs: q_1 =
//                      q_2), and where base and platform are similar and not turned against each other
// There is no other: neither nothing nor a single point is left, since D is zero at all q_i.
//
// More than three legs are singular where D = 0 for every three of them, which is nowhere in general; see
// approach_singular.

#include <Eigen/Core>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// D(u) divided by a positive number that does not depend on u: with w = (u - centre) / unit,
/// constant + linear . w + w . quadratic w.
struct SingularityPolynomial {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();     ///< where w = 0
  double unit = 1.0;                                    ///< a length: the farthest q_i is so far from the centre
  double constant = 0.0;                                ///< D at the centre
  Eigen::Vector2d linear = Eigen::Vector2d::Zero();     ///< coefficients of w
  Eigen::Matrix2d quadratic = Eigen::Matrix2d::Zero();  ///< symmetric

  /// The value at a position u.
  double at(const Eigen::Vector2d& position) const;
  /// Along the position, per length.
  Eigen::Vector2d gradient(const Eigen::Vector2d& position) const;
  /// Whether every position is singular. Coefficients that rounding can make up (some 1e-14 of the terms that they are
  /// summed from) are given as zero.
  bool vanishes() const;
};

/// D at an orientation (radians) for two or three legs. Throws std::invalid_argument for another number of legs, and
/// when the orientation is not finite.
SingularityPolynomial singularity_polynomial(const Manipulator& manipulator, double orientation);

/// A singular position near a position at the same orientation, for any number of legs from two, by the Gauss-Newton
/// method; the position that comes nearest to one, where the method does not reach any. A pose is singular where the
/// lines of all legs pass through one point, which may be at infinity: where the platform has a motion t = [v_x, v_y,
/// omega], not zero, that changes no leg length, [a_ix, a_iy, b_i x a_i] . t = 0 for all i. Throws
/// std::invalid_argument for one leg and when the pose is not finite.
Eigen::Vector2d approach_singular(const Manipulator& manipulator, const Pose& start);

}  // namespace reprise
