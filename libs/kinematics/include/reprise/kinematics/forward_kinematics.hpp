#pragma once

// Forward kinematics: poses from given leg lengths.
//
// All assembly modes of a three-leg manipulator (general base and platform triangles). With w_i = R(phi)(p_i - p_1) -
// (c_i - c_1) and A = a_1 the vector of leg 1, the circle equations |A + w_i|^2 = l_i^2 less the first of them are
//     w_i . A = rho_i = (l_i^2 - l_1^2 - |w_i|^2) / 2,        i = 2, 3,
// linear in A with determinant Delta = w_2 x w_3 and solution A = N / Delta. What remains is
//     E(phi) = |N|^2 - l_1^2 Delta^2 = 0,    |N|^2 = rho_2^2 |w_3|^2 - 2 rho_2 rho_3 w_2.w_3 + rho_3^2 |w_2|^2,
// a trigonometric polynomial of degree 3, that is, a polynomial of degree 6 in tan(phi / 2): at most six modes.
// A = N / Delta then gives the position. Where Delta vanishes as well, one phi can carry two modes, the points at which
// the circles of two legs meet; so it is throughout the thesis, whose base and platform are both collinear and whose
// platform is not turned. The multiplicity of a root phi of E is the sum of those of its modes.
//
// At a multiple root two or more modes have come together: the pose is singular. Rounding of the lengths by 1e-16
// moves an m-fold root by 1e-16^(1/m), apart into several close roots or away from the real axis. So E is solved with
// 64 binary digits, and roots that a change of its coefficients by 1e-14 of the terms they come from would put together
// are taken for one.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// The poses at which three given leg lengths are met.
struct AssemblyModes {
  /// Sorted by orientation (in [-pi, pi]), then x, then y. Empty when the lengths cannot be reached. Modes that
  /// cannot be told apart for rounding of the lengths count as one; at an ordinary double root that is a distance of
  /// about 1e-7 of the manipulator's size.
  std::vector<Pose> poses;
  /// How many solutions of |a_i|^2 = l_i^2 come together at each pose, complex ones included: 1 at an ordinary pose,
  /// more at a singular one, and where a leg has no length. All together are at most 6. 0 at a pose that is an isolated
  /// real one among infinitely many complex ones, such as that of two identical legs with the third stretched out.
  std::vector<int> multiplicities;
  /// The lengths leave a motion free (such as two identical legs, or three equal and parallel ones); `poses` is empty,
  /// even where single modes exist beside that motion.
  bool infinitely_many = false;
};

/// All real assembly modes of a manipulator with three legs. The lengths are met to 1e-12 of the largest of l_i, |p_i -
/// p_1| and |c_i - c_1|. The legs' limits play no part. Throws std::invalid_argument when there are not three legs or a
/// length is negative or above 1e120.
AssemblyModes assembly_modes(const Manipulator& manipulator, const std::array<double, 3>& lengths);

/// The outcome of a least-squares fit of the pose to given leg lengths.
struct FittedPose {
  Pose pose;  ///< of the working point, in the world frame
  /// |v(u, phi) - v|, the Euclidean norm; zero to rounding where the lengths can be reached.
  double residual;
  /// Whether the method ended at a stationary point; otherwise it ran out of evaluations.
  bool converged;
};

/// Solves min |v(u, phi) - lengths|^2 (eq. (5.28)) from the given start by the Levenberg-Marquardt method, for any
/// number of legs. The minimum is a local one. Throws std::invalid_argument when a number of lengths is not n, a length
/// is negative or above 1e120, or the start is not finite.
FittedPose fit_pose(const Manipulator& manipulator, const Eigen::Ref<const Eigen::VectorXd>& lengths,
                    const Pose& start);

/// (v^min + v^max) / 2 (eq. (5.27)), the lengths the thesis assembles a manipulator at.
Eigen::VectorXd mean_lengths(const Manipulator& manipulator);

}  // namespace reprise
