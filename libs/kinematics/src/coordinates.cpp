#include "reprise/kinematics/coordinates.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "checks.hpp"

namespace reprise {
namespace {

using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;

/// What the derivatives of one leg's length need: its direction e, the normal to e, and the joint arm R p.
struct LegGeometry {
  double length;
  Eigen::Vector2d direction;
  Eigen::Vector2d normal;
  Eigen::Vector2d arm;
  Eigen::Matrix2d rotation;
  Eigen::Matrix2d rotation_slope;  // dR / dphi
  Eigen::Index base_row;

  LegGeometry(const Manipulator& manipulator, std::size_t index, const Pose& pose) : base_row(coordinate_count(index)) {
    const Leg& leg = manipulator.leg(index);
    const double c = std::cos(pose.orientation);
    const double s = std::sin(pose.orientation);
    rotation << c, -s, s, c;
    rotation_slope << -s, -c, c, -s;
    arm = rotation * leg.platform_joint;
    const Eigen::Vector2d a = leg_vector(leg, pose);
    length = a.norm();
    direction = length > 0.0 ? Eigen::Vector2d(a / length) : Eigen::Vector2d::Zero();
    normal = {-direction.y(), direction.x()};
  }

  /// The derivative of the leg vector along column j.
  Eigen::Vector2d slope(const ConstMatrix& directions, Eigen::Index j) const {
    return directions.block<2, 1>(0, j) + directions(2, j) * Eigen::Vector2d(-arm.y(), arm.x()) -
           directions.block<2, 1>(base_row, j) + rotation * directions.block<2, 1>(base_row + 2, j);
  }

  /// The second derivative of the leg vector along columns j and k, projected on the leg's direction: the only products
  /// of coordinates in it are phi phi and phi p.
  double curvature(const ConstMatrix& directions, Eigen::Index j, Eigen::Index k) const {
    const double phi_j = directions(2, j);
    const double phi_k = directions(2, k);
    return direction.dot(rotation_slope * (phi_k * directions.block<2, 1>(base_row + 2, j) +
                                           phi_j * directions.block<2, 1>(base_row + 2, k)) -
                         phi_j * phi_k * arm);
  }
};

LegGeometry checked_geometry(const Manipulator& manipulator, std::size_t leg, const Pose& pose,
                             const ConstMatrix& directions, Eigen::Index gradient_size) {
  if (leg >= manipulator.size()) {
    std::ostringstream message;
    message << "leg index is " << leg << ", but it must be below " << manipulator.size();
    throw std::invalid_argument(message.str());
  }
  check_size("directions' number of rows", directions.rows(), coordinate_count(manipulator.size()));
  check_size("gradient's size", gradient_size, directions.cols());
  return {manipulator, leg, pose};
}

}  // namespace

Eigen::Matrix<double, 15, 8> collinear_directions() {
  Eigen::Matrix<double, 15, 8> directions = Eigen::Matrix<double, 15, 8>::Zero();
  directions.topLeftCorner<3, 3>().setIdentity();
  directions.bottomRightCorner<12, 5>() = collinear_design_map();
  return directions;
}

double leg_length(const Manipulator& manipulator, std::size_t leg, const Pose& pose, const ConstMatrix& directions,
                  Eigen::Ref<Eigen::VectorXd> gradient) {
  const LegGeometry geometry = checked_geometry(manipulator, leg, pose, directions, gradient.size());
  for (Eigen::Index j = 0; j < directions.cols(); ++j) {
    gradient[j] = geometry.direction.dot(geometry.slope(directions, j));
  }
  return geometry.length;
}

double leg_length(const Manipulator& manipulator, std::size_t leg, const Pose& pose, const ConstMatrix& directions,
                  Eigen::Ref<Eigen::VectorXd> gradient, Eigen::Ref<Eigen::MatrixXd> hessian) {
  const LegGeometry geometry = checked_geometry(manipulator, leg, pose, directions, gradient.size());
  check_size("Hessian's number of rows", hessian.rows(), directions.cols());
  check_size("Hessian's number of columns", hessian.cols(), directions.cols());
  const double inverse_length = geometry.length > 0.0 ? 1.0 / geometry.length : 0.0;
  for (Eigen::Index j = 0; j < directions.cols(); ++j) {
    const Eigen::Vector2d slope_j = geometry.slope(directions, j);
    gradient[j] = geometry.direction.dot(slope_j);
    const double turn_j = geometry.normal.dot(slope_j) * inverse_length;
    for (Eigen::Index k = 0; k <= j; ++k) {
      hessian(j, k) =
          turn_j * geometry.normal.dot(geometry.slope(directions, k)) + geometry.curvature(directions, j, k);
      hessian(k, j) = hessian(j, k);
    }
  }
  return geometry.length;
}

}  // namespace reprise
