#include "reprise/kinematics/singular_positions.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "checks.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

/// Rounding errors of a coefficient, to the size of its terms.
constexpr double rounding = 1e-14;

double determinant(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
}

/// Points less their mean, with the farthest at the distance 1; false where rounding may be all that tells them apart.
bool normalise(Eigen::MatrixX2d& points, Eigen::RowVector2d& mean, double& unit, double magnitude) {
  mean = points.colwise().mean();
  points.rowwise() -= mean;
  unit = points.rowwise().norm().maxCoeff();
  if (unit <= rounding * magnitude) return false;
  points /= unit;
  return true;
}

}  // namespace

double SingularityPolynomial::at(const Eigen::Vector2d& position) const {
  const Eigen::Vector2d w = (position - centre) / unit;
  return constant + linear.dot(w) + w.dot(quadratic * w);
}

Eigen::Vector2d SingularityPolynomial::gradient(const Eigen::Vector2d& position) const {
  const Eigen::Vector2d w = (position - centre) / unit;
  return (linear + 2.0 * quadratic * w) / unit;
}

bool SingularityPolynomial::vanishes() const { return constant == 0.0 && linear.isZero(0.0) && quadratic.isZero(0.0); }

SingularityPolynomial singularity_polynomial(const Manipulator& manipulator, double orientation) {
  const auto legs = static_cast<Eigen::Index>(manipulator.size());
  if (legs != 2) check_size("number of legs", legs, 3);
  check_finite("orientation", Pose{Eigen::Vector2d::Zero(), orientation});
  const Eigen::Rotation2Dd rotation(orientation);
  Eigen::MatrixX2d q(legs, 2);
  Eigen::MatrixX2d b(legs, 2);
  double magnitude = 0.0;
  double arm = 0.0;
  for (Eigen::Index i = 0; i < legs; ++i) {
    const Leg& leg = manipulator.leg(static_cast<std::size_t>(i));
    b.row(i) = (rotation * leg.platform_joint).transpose();
    q.row(i) = leg.base_joint.transpose() - b.row(i);
    arm = std::max(arm, leg.platform_joint.norm());
    magnitude = std::max(magnitude, leg.base_joint.norm());
  }
  magnitude += arm;
  SingularityPolynomial result;
  Eigen::RowVector2d centre;
  Eigen::RowVector2d mean_arm;
  double arm_unit = 1.0;
  double unit = 1.0;
  if (!normalise(q, centre, unit, magnitude)) return result;
  result.centre = centre.transpose();
  result.unit = unit;
  if (legs == 2) {
    const Eigen::Vector2d between = (q.row(1) - q.row(0)).transpose();
    result.linear = quarter_turned(between);
    return result;
  }
  if (!normalise(b, mean_arm, arm_unit, arm)) return result;
  const double tolerance = rounding * (1.0 + magnitude / unit + arm / arm_unit);
  const Eigen::Vector3d ones = Eigen::Vector3d::Ones();
  const Eigen::Vector3d qx = q.col(0);
  const Eigen::Vector3d qy = q.col(1);
  const Eigen::Vector3d bx = b.col(0);
  const Eigen::Vector3d by = b.col(1);
  const Eigen::Vector3d m = bx.cwiseProduct(qy) - by.cwiseProduct(qx);
  const auto rounded = [&](double coefficient) { return std::abs(coefficient) <= tolerance ? 0.0 : coefficient; };
  result.quadratic(0, 0) = rounded(determinant(ones, qy, by));
  result.quadratic(1, 1) = rounded(-determinant(qx, ones, bx));
  result.quadratic(0, 1) = result.quadratic(1, 0) =
      0.5 * rounded(determinant(qx, ones, by) - determinant(ones, qy, bx));
  result.linear = {rounded(determinant(ones, qy, m) - determinant(qx, qy, by)),
                   rounded(determinant(qx, ones, m) + determinant(qx, qy, bx))};
  result.constant = rounded(-determinant(qx, qy, m));
  return result;
}

Eigen::Vector2d approach_singular(const Manipulator& manipulator, const Pose& start) {
  const auto legs = static_cast<Eigen::Index>(manipulator.size());
  if (legs < 2) check_size("number of legs", legs, 2);
  check_finite("start", start);
  // Two legs move at a fixed orientation only: omega is left out.
  const Eigen::Index motions = legs == 2 ? 2 : 3;
  const Eigen::Rotation2Dd rotation(start.orientation);
  Eigen::MatrixX2d arms(legs, 2);
  double size = 0.0;
  for (Eigen::Index i = 0; i < legs; ++i) {
    arms.row(i) = (rotation * manipulator.leg(static_cast<std::size_t>(i)).platform_joint).transpose();
    size = std::max(size, arms.row(i).norm());
  }
  if (size == 0.0 && legs > 2) return start.position;  // all legs meet in P
  if (size == 0.0) size = 1.0;
  Eigen::MatrixX3d rows(legs, 3);
  const auto fill = [&](const Eigen::Vector2d& position) {
    for (Eigen::Index i = 0; i < legs; ++i) {
      const Eigen::Vector2d a = leg_vector(manipulator.leg(static_cast<std::size_t>(i)), {position, start.orientation});
      const double length = a.norm();
      if (length == 0.0) return false;
      rows.row(i) << a.x() / length, a.y() / length, cross(arms.row(i).transpose(), a) / (length * size);
    }
    return true;
  };
  Eigen::Vector2d position = start.position;
  Eigen::Vector2d best = position;
  double least = std::numeric_limits<double>::infinity();
  constexpr int iterations = 30;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    if (!fill(position)) return position;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows.leftCols(motions), Eigen::ComputeThinU | Eigen::ComputeFullV);
    const double smallest = svd.singularValues()[motions - 1];
    if (!(smallest < least)) break;
    least = smallest;
    best = position;
    Eigen::Vector3d t = Eigen::Vector3d::Zero();
    t.head(motions) = svd.matrixV().col(motions - 1);
    // How rows . t changes with the position and with the motion, which keeps its length.
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(legs + 1, 2 + motions);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(legs + 1);
    for (Eigen::Index i = 0; i < legs; ++i) {
      const double length = leg_length(manipulator.leg(static_cast<std::size_t>(i)), {position, start.orientation});
      slopes(i, 0) = (t.x() - t.z() * arms(i, 1) / size) / length;
      slopes(i, 1) = (t.y() + t.z() * arms(i, 0) / size) / length;
      slopes.row(i).tail(motions) = rows.row(i).head(motions);
      values[i] = rows.row(i).dot(t);
    }
    slopes.row(legs).tail(motions) = t.head(motions).transpose();
    const Eigen::VectorXd step = slopes.completeOrthogonalDecomposition().solve(values);
    if (!step.allFinite()) break;
    position -= step.head<2>();
  }
  return best;
}

}  // namespace reprise
