#include "reprise/kinematics/conditioning.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "checks.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/kinematics/conditioning_field.hpp"
#include "reprise/kinematics/kappa_inverse_formula.hpp"

namespace reprise {
namespace {

/// Numbers of several positions side by side. Each operation is that of plain numbers, on all of them.
using Lanes = Eigen::Array<double, 4, 1>;

}  // namespace

/// For the formula.
template <>
struct NumberKind<Lanes> {
  /// Whether all are.
  static bool positive(const Lanes& numbers) { return (numbers > 0.0).all(); }
  static Lanes absolute(const Lanes& numbers) { return numbers.abs(); }
};

namespace {

using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;

/// A value with its derivatives along Width directions, and one with its second derivatives as well.
template <int Width>
using FirstOrder = Eigen::AutoDiffScalar<Eigen::Matrix<double, Width, 1>>;
template <int Width>
using SecondOrder = Eigen::AutoDiffScalar<Eigen::Matrix<FirstOrder<Width>, Width, 1>>;

/// The square; it costs half of what x * x does when derivatives are carried.
using Eigen::numext::abs2;

/// L^2 of platform joints, for `coordinate(i)` the i-th of the 3 + 4 n coordinates.
template <class Scalar, class Coordinate>
Scalar mean_square_radius(std::size_t legs, const Coordinate& coordinate) {
  Scalar sum(0.0);
  for (std::size_t i = 0; i < legs; ++i) {
    const Scalar px = coordinate(coordinate_count(i) + 2);
    const Scalar py = coordinate(coordinate_count(i) + 3);
    sum += abs2(px);
    sum += abs2(py);
  }
  return sum * (1.0 / static_cast<double>(legs));
}

/// Fills the rows; false where the direction of a leg, and so kappa, is undefined.
template <class Scalar, class Rotation, class Coordinate>
bool fill_rows(std::size_t legs, const Coordinate& coordinate, const Rotation& cos_phi, const Rotation& sin_phi,
               const Scalar& turn_factor, JacobianRows<Scalar>& rows) {
  const Scalar x = coordinate(0);
  const Scalar y = coordinate(1);
  for (std::size_t i = 0; i < legs; ++i) {
    const Eigen::Index base = coordinate_count(i);
    const Scalar px = coordinate(base + 2);
    const Scalar py = coordinate(base + 3);
    const Scalar arm_x = px * cos_phi - py * sin_phi;
    const Scalar arm_y = px * sin_phi + py * cos_phi;
    const Scalar leg_x = x + arm_x - coordinate(base);
    const Scalar leg_y = y + arm_y - coordinate(base + 1);
    const Scalar square = abs2(leg_x) + abs2(leg_y);
    if (!NumberKind<Scalar>::positive(square)) return false;
    using std::sqrt;
    const Scalar length = sqrt(square);
    const Scalar inverse_length = 1.0 / length;
    JacobianRow<Scalar>& row = rows[i];
    row.x = leg_x * inverse_length;
    row.y = leg_y * inverse_length;
    const Scalar moment = arm_x * row.y - arm_y * row.x;
    row.turn = moment * turn_factor;
  }
  return true;
}

/// The factor of dl/dphi in a row; zero where L is.
template <class Scalar, class Coordinate>
Scalar turn_factor(std::size_t legs, const Conditioning& conditioning, const Coordinate& coordinate) {
  const bool homogeneous = conditioning.normalisation == Normalisation::homogeneous;
  if (conditioning.characteristic_length) {
    const double length = *conditioning.characteristic_length;
    return Scalar(homogeneous ? 1.0 / length : length);
  }
  const Scalar square = mean_square_radius<Scalar>(legs, coordinate);
  if (!NumberKind<Scalar>::positive(square)) return Scalar(0.0);
  using std::sqrt;
  const Scalar length = sqrt(square);
  return homogeneous ? Scalar(1.0 / length) : length;
}

/// kappa^-1 at positions side by side; false where one of them has to be looked at alone, and the result is not set.
template <class Coordinate>
bool kappa_inverse_of_lanes(std::size_t legs, double turn_factor, const Coordinate& coordinate, double cos_phi,
                            double sin_phi, Lanes& result) {
  JacobianRows<Lanes> rows(legs);
  return fill_rows<Lanes>(legs, coordinate, cos_phi, sin_phi, Lanes(turn_factor), rows) &&
         kappa_inverse_of_rows(legs, rows, result);
}

template <class Scalar, class Rotation, class Coordinate>
Scalar kappa_inverse_of_coordinates(std::size_t legs, const Conditioning& conditioning, const Coordinate& coordinate,
                                    const Rotation& cos_phi, const Rotation& sin_phi) {
  JacobianRows<Scalar> rows(legs);
  const Scalar factor = turn_factor<Scalar>(legs, conditioning, coordinate);
  Scalar result(0.0);
  if (fill_rows(legs, coordinate, cos_phi, sin_phi, factor, rows)) kappa_inverse_of_rows(legs, rows, result);
  return result;
}

/// The numerical value of the i-th coordinate.
double coordinate_value(std::span<const Leg> legs, const Pose& pose, Eigen::Index i) {
  if (i < 2) return pose.position[i];
  if (i == 2) return pose.orientation;
  const Leg& leg = legs[static_cast<std::size_t>(i - 3) / 4];
  const Eigen::Index part = (i - 3) % 4;
  return part < 2 ? leg.base_joint[part] : leg.platform_joint[part - 2];
}

void check_conditioning(const Conditioning& conditioning) {
  if (!conditioning.characteristic_length) return;
  const double length = *conditioning.characteristic_length;
  require(length >= least_characteristic_length && length <= greatest_characteristic_length, "characteristic length",
          length, "between 1e-100 and 1e100");
}

void check(std::span<const Leg> legs, const Pose& pose, const Conditioning& conditioning) {
  if (legs.size() < 2) throw std::invalid_argument("number of legs is 1, but a condition number needs at least 2");
  check_finite("pose", pose);
  check_conditioning(conditioning);
}

double value(std::span<const Leg> legs, const Pose& pose, const Conditioning& conditioning) {
  const auto coordinate = [&](Eigen::Index i) { return coordinate_value(legs, pose, i); };
  const double result = kappa_inverse_of_coordinates<double>(legs.size(), conditioning, coordinate,
                                                             std::cos(pose.orientation), std::sin(pose.orientation));
  return std::min(std::abs(result), 1.0);  // not -0, where the determinant is
}

/// Columns [first, first + Width) of a row of `directions`, filled up with zeros beyond its last column.
template <int Width>
Eigen::Matrix<double, Width, 1> seed(const ConstMatrix& directions, Eigen::Index row, Eigen::Index first) {
  Eigen::Matrix<double, Width, 1> result = Eigen::Matrix<double, Width, 1>::Zero();
  const Eigen::Index count = std::min<Eigen::Index>(Width, directions.cols() - first);
  for (Eigen::Index j = 0; j < count; ++j) result[j] = directions(row, first + j);
  return result;
}

/// Evaluates the formula in `Scalar` with coordinates made by `coordinate`. Where no direction turns the platform the
/// rotation is a pair of plain numbers, which saves a quarter of the work.
template <class Scalar, class Coordinate>
Scalar evaluate(std::span<const Leg> legs, const Pose& pose, const Conditioning& conditioning,
                const Coordinate& coordinate, bool turns) {
  if (!turns) {
    return kappa_inverse_of_coordinates<Scalar>(legs.size(), conditioning, coordinate, std::cos(pose.orientation),
                                                std::sin(pose.orientation));
  }
  const Scalar phi = coordinate(2);
  const Scalar cos_phi = cos(phi);
  const Scalar sin_phi = sin(phi);
  return kappa_inverse_of_coordinates<Scalar>(legs.size(), conditioning, coordinate, cos_phi, sin_phi);
}

template <int Width>
void fill_gradient(std::span<const Leg> legs, const Pose& pose, const Conditioning& conditioning,
                   const ConstMatrix& directions, Eigen::Ref<Eigen::VectorXd> gradient) {
  using Scalar = FirstOrder<Width>;
  const bool turns = !directions.row(2).isZero(0.0);
  for (Eigen::Index first = 0; first < directions.cols(); first += Width) {
    const auto coordinate = [&](Eigen::Index i) {
      return Scalar(coordinate_value(legs, pose, i), seed<Width>(directions, i, first));
    };
    const Scalar result = evaluate<Scalar>(legs, pose, conditioning, coordinate, turns);
    const Eigen::Index count = std::min<Eigen::Index>(Width, directions.cols() - first);
    gradient.segment(first, count) = result.derivatives().head(count);
  }
}

template <int Width>
void fill_hessian(std::span<const Leg> legs, const Pose& pose, const Conditioning& conditioning,
                  const ConstMatrix& directions, Eigen::Ref<Eigen::VectorXd> gradient,
                  Eigen::Ref<Eigen::MatrixXd> hessian) {
  using Inner = FirstOrder<Width>;
  using Scalar = SecondOrder<Width>;
  const bool turns = !directions.row(2).isZero(0.0);
  for (Eigen::Index row = 0; row < directions.cols(); row += Width) {
    for (Eigen::Index column = 0; column <= row; column += Width) {
      const auto coordinate = [&](Eigen::Index i) {
        Scalar result;
        result.value() = Inner(coordinate_value(legs, pose, i), seed<Width>(directions, i, column));
        const Eigen::Matrix<double, Width, 1> outer = seed<Width>(directions, i, row);
        for (Eigen::Index j = 0; j < Width; ++j) result.derivatives()[j] = Inner(outer[j]);
        return result;
      };
      const Scalar result = evaluate<Scalar>(legs, pose, conditioning, coordinate, turns);
      const Eigen::Index rows = std::min<Eigen::Index>(Width, directions.cols() - row);
      const Eigen::Index columns = std::min<Eigen::Index>(Width, directions.cols() - column);
      for (Eigen::Index j = 0; j < rows; ++j) {
        gradient[row + j] = result.derivatives()[j].value();
        for (Eigen::Index k = 0; k < columns; ++k) {
          hessian(row + j, column + k) = result.derivatives()[j].derivatives()[k];
          hessian(column + k, row + j) = hessian(row + j, column + k);
        }
      }
    }
  }
}

double with_gradient(std::span<const Leg> legs, const Pose& pose, const Conditioning& conditioning,
                     const ConstMatrix& directions, Eigen::Ref<Eigen::VectorXd> gradient) {
  check(legs, pose, conditioning);
  check_size("directions' number of rows", directions.rows(), coordinate_count(legs.size()));
  check_size("gradient's size", gradient.size(), directions.cols());
  const double result = value(legs, pose, conditioning);
  if (result == 0.0) {
    gradient.setZero();
  } else if (directions.cols() <= 6) {
    fill_gradient<6>(legs, pose, conditioning, directions, gradient);
  } else {
    fill_gradient<16>(legs, pose, conditioning, directions, gradient);
  }
  return result;
}

}  // namespace

double characteristic_length(const Manipulator& manipulator, const Conditioning& conditioning) {
  check_conditioning(conditioning);
  if (conditioning.characteristic_length) return *conditioning.characteristic_length;
  const auto coordinate = [&](Eigen::Index i) { return coordinate_value(manipulator.legs(), Pose{}, i); };
  return std::sqrt(mean_square_radius<double>(manipulator.size(), coordinate));
}

double kappa_inverse(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning) {
  check(manipulator.legs(), pose, conditioning);
  return value(manipulator.legs(), pose, conditioning);
}

void kappa_inverse_at(const Manipulator& manipulator, double orientation, const Eigen::Ref<const Eigen::ArrayXd>& x,
                      const Eigen::Ref<const Eigen::ArrayXd>& y, const Conditioning& conditioning,
                      Eigen::Ref<Eigen::ArrayXd> values) {
  const std::vector<Leg>& legs = manipulator.legs();
  check_size("y's size", y.size(), x.size());
  check_size("the values' size", values.size(), x.size());
  check(legs, {Eigen::Vector2d::Zero(), orientation}, conditioning);
  const double cos_phi = std::cos(orientation);
  const double sin_phi = std::sin(orientation);
  const double factor =
      turn_factor<double>(legs.size(), conditioning, [&](Eigen::Index i) { return coordinate_value(legs, Pose{}, i); });
  constexpr Eigen::Index width = Lanes::SizeAtCompileTime;
  Eigen::Index first = 0;
  for (; first + width <= x.size(); first += width) {
    const Lanes across = x.segment<width>(first);
    const Lanes up = y.segment<width>(first);
    const auto coordinate = [&](Eigen::Index i) -> Lanes {
      if (i == 0) return across;
      if (i == 1) return up;
      return Lanes::Constant(coordinate_value(legs, Pose{}, i));
    };
    Lanes result;
    if ((across - across + (up - up) == 0.0).all() &&
        kappa_inverse_of_lanes(legs.size(), factor, coordinate, cos_phi, sin_phi, result)) {
      values.segment<width>(first) = result.abs().min(1.0);
    } else {
      for (Eigen::Index i = first; i < first + width; ++i) {
        values[i] = kappa_inverse(manipulator, {{x[i], y[i]}, orientation}, conditioning);
      }
    }
  }
  for (; first < x.size(); ++first) {
    values[first] = kappa_inverse(manipulator, {{x[first], y[first]}, orientation}, conditioning);
  }
}

double kappa(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning) {
  const double inverse = kappa_inverse(manipulator, pose, conditioning);
  return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
}

int singularity_side(const Manipulator& manipulator, const Pose& pose) {
  const std::size_t legs = manipulator.size();
  if (legs != 2 && legs != 3) {
    throw std::invalid_argument("the manipulator has " + std::to_string(legs) +
                                " legs, but the side of a pose is that of 2 or 3");
  }
  // The rows of J times the leg lengths, which are positive.
  Eigen::Matrix3d rows = Eigen::Matrix3d::Identity();
  const Eigen::Rotation2Dd rotation(pose.orientation);
  for (std::size_t i = 0; i < legs; ++i) {
    const Eigen::Vector2d a = leg_vector(manipulator.leg(i), pose);
    const double turn = a.dot(quarter_turned(rotation * manipulator.leg(i).platform_joint));
    rows.row(static_cast<Eigen::Index>(i)) << a.x(), a.y(), turn;
  }
  const double determinant = rows.determinant();
  return (determinant > 0.0) - (determinant < 0.0);
}

double kappa_inverse_2norm(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning) {
  const std::vector<Leg>& legs = manipulator.legs();
  check(legs, pose, conditioning);
  if (value(legs, pose, conditioning) == 0.0) return 0.0;
  const auto coordinate = [&](Eigen::Index i) { return coordinate_value(legs, pose, i); };
  JacobianRows<double> rows(legs.size());
  fill_rows(legs.size(), coordinate, std::cos(pose.orientation), std::sin(pose.orientation),
            turn_factor<double>(legs.size(), conditioning, coordinate), rows);
  const Eigen::Index motions = legs.size() == 2 ? 2 : 3;  // two legs move at a fixed orientation
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(legs.size()), motions);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    jacobian.row(static_cast<Eigen::Index>(i)) = Eigen::Vector3d(rows[i].x, rows[i].y, rows[i].turn).head(motions);
  }
  const Eigen::VectorXd singular_values = Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian).singularValues();
  return singular_values[motions - 1] / singular_values[0];
}

double kappa_inverse(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning,
                     const ConstMatrix& directions, Eigen::Ref<Eigen::VectorXd> gradient) {
  return with_gradient(manipulator.legs(), pose, conditioning, directions, gradient);
}

double kappa_inverse(const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning,
                     const ConstMatrix& directions, Eigen::Ref<Eigen::VectorXd> gradient,
                     Eigen::Ref<Eigen::MatrixXd> hessian) {
  const std::vector<Leg>& legs = manipulator.legs();
  check(legs, pose, conditioning);
  check_size("directions' number of rows", directions.rows(), coordinate_count(legs.size()));
  check_size("gradient's size", gradient.size(), directions.cols());
  check_size("Hessian's number of rows", hessian.rows(), directions.cols());
  check_size("Hessian's number of columns", hessian.cols(), directions.cols());
  const double result = value(legs, pose, conditioning);
  if (result == 0.0) {
    gradient.setZero();
    hessian.setZero();
  } else {
    fill_hessian<5>(legs, pose, conditioning, directions, gradient, hessian);
  }
  return result;
}

CollinearKappaInverse collinear_kappa_inverse(const CollinearDesign& design, const Pose& pose,
                                              const Conditioning& conditioning) {
  const Eigen::Matrix<double, 15, 8> directions = collinear_directions();
  const Manipulator manipulator = make_manipulator(design, {Interval{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}});
  Eigen::Matrix<double, 8, 1> gradient;
  const double result = with_gradient(manipulator.legs(), pose, conditioning, directions, gradient);
  return {result, gradient.head<2>(), gradient[2], gradient.tail<5>()};
}

}  // namespace reprise
