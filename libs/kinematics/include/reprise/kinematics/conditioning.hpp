#pragma once

// The condition number kappa of the manipulator Jacobian, and the exact derivatives of its inverse.
//
// Row i of the Jacobian J holds the derivatives of leg length l_i with respect to the pose (thesis chapter 5,
// eq. (5.11)), made comparable by a characteristic length L in one of two ways:
//     printed       [dl/dx / L,  dl/dy / L,  dl/dphi]        eq. (5.13); kappa then depends on the unit of length
//     homogeneous   [dl/dx,      dl/dy,      dl/dphi / L]    free of units; kappa is the same in metres and millimetres
// Unless it is given, L is the root mean square distance of the platform joints from P. In the thesis's family that is
// the platform radius r, so that `printed` is eq. (5.13) to the letter.
//
// With the norm ||J||^2 = tr(J J^T) / 3 of eqs. (4.19), (4.20), n >= 3 legs have, by the Cauchy-Binet formula,
//     kappa^-1 = 1 / (||J|| ||J^+||)
//              = 3 sqrt( sum_{i<j<k} det[J_i, J_j, J_k]^2 / ( sum_i |J_i|^2  sum_{i<j} |J_i x J_j|^2 ) ),
// which for three legs is 3 |det J| / (||J||_F ||adj J||_F). (That the thesis means this norm is a reconstruction: its
// chapter 4 is not available, but this norm reproduces the numbers printed in Table 5.3.)
//
// A manipulator with two legs has two degrees of freedom at a fixed orientation; its Jacobian is the 2 x 2 matrix of
// rows [dl/dx, dl/dy], and kappa^-1 = 2 |det J| / ||J||_F^2 is the same with either normalisation.
//
// In every case 0 <= kappa^-1 <= 1. It is 1 at an isotropic pose and 0 where J is singular. It is defined to be 0 as
// well where a leg has length zero (no direction), and where all platform joints of three or more legs lie at P (L =
// 0).

#include <Eigen/Core>
#include <optional>

#include "reprise/kinematics/coordinates.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// How the rows of J are made comparable, eq. (5.13) or free of units; see the head of this file.
enum class Normalisation { printed, homogeneous };

/// How the Jacobian is made comparable. A given length must be in [1e-100, 1e100].
struct Conditioning {
  Normalisation normalisation = Normalisation::homogeneous;    ///< see the head of this file
  std::optional<double> characteristic_length = std::nullopt;  ///< L, a length; none: see characteristic_length()
};

/// L: the given one, or the root mean square distance of the platform joints from P (zero if all lie there). Throws
/// std::invalid_argument when a given length is out of its bounds.
double characteristic_length(const Manipulator& manipulator, const Conditioning& conditioning = {});

/// kappa^-1 in the Frobenius norm; its cost is linear in n. Allocates nothing for two and three legs. Throws
/// std::invalid_argument for one leg, a pose that is not finite and a characteristic length out of its bounds.
double kappa_inverse(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning = {});

/// kappa = 1 / kappa_inverse, infinity where that is zero. Throws as kappa_inverse.
double kappa(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning = {});

/// The inverse condition number in the 2-norm: the smallest singular value of J over the largest, and 0 where
/// kappa_inverse is defined to be 0. Throws as kappa_inverse.
double kappa_inverse_2norm(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning = {});

/// On which side of the singular poses a pose of two or three legs lies: the sign (1, -1, or 0 at a singular pose) of
/// det J. kappa^-1 is 0 between poses of different sign; times this sign it is smooth there. Throws
/// std::invalid_argument for another number of legs.
int singularity_side(const Manipulator& manipulator, const Pose& pose);

/// kappa_inverse with its exact gradient (size k) along the columns of `directions` ((3 + 4 n) x k, see
/// coordinates.hpp; L varies with the platform joints unless it is given). Where kappa^-1 is zero it is not
/// differentiable and the derivatives are given as zero, which is a subgradient of that minimum. Allocates nothing for
/// two and three legs. Throws as kappa_inverse, and when a size does not fit.
double kappa_inverse(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning,
                     const Eigen::Ref<const Eigen::MatrixXd>& directions, Eigen::Ref<Eigen::VectorXd> gradient);

/// The same with the exact Hessian (k x k), both of its triangles.
double kappa_inverse(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning,
                     const Eigen::Ref<const Eigen::MatrixXd>& directions, Eigen::Ref<Eigen::VectorXd> gradient,
                     Eigen::Ref<Eigen::MatrixXd> hessian);

/// kappa^-1 of a manipulator of the thesis's family with its gradient along position, orientation and design.
struct CollinearKappaInverse {
  double value;                        ///< kappa^-1
  Eigen::Vector2d position;            ///< along [x, y]
  double orientation;                  ///< along phi, per radian
  Eigen::Matrix<double, 5, 1> design;  ///< along [x_C, y_C, x_D, x_E, r]
};

/// The derivatives above for a design of the thesis's family. Throws as kappa_inverse, and when the design is not
/// finite.
CollinearKappaInverse collinear_kappa_inverse(const CollinearDesign& design, const Pose& pose,
                                              const Conditioning& conditioning = {});

}  // namespace reprise
