#include "reprise/kinematics/jacobian.hpp"

#include "checks.hpp"
#include "reprise/kinematics/coordinates.hpp"

namespace reprise {

Eigen::VectorXd constraints(const Manipulator& manipulator, const Pose& pose,
                            const Eigen::Ref<const Eigen::VectorXd>& lengths) {
  check_size("number of lengths", lengths.size(), static_cast<Eigen::Index>(manipulator.size()));
  // A difference of squares loses accuracy near the solution, the product of sum and difference does not.
  const Eigen::ArrayXd actual = leg_lengths(manipulator, pose);
  return (lengths.array() - actual) * (lengths.array() + actual);
}

Eigen::MatrixX3d constraint_pose_jacobian(const Manipulator& manipulator, const Pose& pose) {
  return -2.0 * leg_lengths(manipulator, pose).asDiagonal() * jacobian(manipulator, pose);
}

Eigen::DiagonalMatrix<double, Eigen::Dynamic> constraint_length_jacobian(
    const Eigen::Ref<const Eigen::VectorXd>& lengths) {
  return Eigen::DiagonalMatrix<double, Eigen::Dynamic>(2.0 * lengths);
}

Eigen::MatrixX3d jacobian(const Manipulator& manipulator, const Pose& pose) {
  const Eigen::MatrixXd pose_directions = Eigen::MatrixXd::Identity(coordinate_count(manipulator.size()), 3);
  Eigen::MatrixX3d result(static_cast<Eigen::Index>(manipulator.size()), 3);
  Eigen::Vector3d gradient;
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    leg_length(manipulator, static_cast<std::size_t>(i), pose, pose_directions, gradient);
    result.row(i) = gradient;
  }
  return result;
}

Eigen::MatrixX3d normalised_jacobian(const Manipulator& manipulator, const Pose& pose,
                                     const Conditioning& conditioning) {
  const double length = characteristic_length(manipulator, conditioning);
  const double inverse = length > 0.0 ? 1.0 / length : 0.0;
  Eigen::MatrixX3d result = jacobian(manipulator, pose);
  if (conditioning.normalisation == Normalisation::printed) {
    result.leftCols<2>() *= inverse;
  } else {
    result.col(2) *= inverse;
  }
  return result;
}

}  // namespace reprise
