#pragma once

// The formula of kappa^-1 (conditioning.hpp) for any kind of number: plain numbers, numbers with derivatives,
// intervals.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

namespace reprise {

/// One row of the Jacobian divided by a factor common to all rows, on which kappa does not depend: the direction of the
/// leg, a unit vector, and dl/dphi times 1 / L (homogeneous) or L (printed).
template <class Scalar>
struct JacobianRow {
  Scalar x;     ///< dl/dx
  Scalar y;     ///< dl/dy
  Scalar turn;  ///< dl/dphi, scaled
};

/// The rows of up to three legs on the stack, of more on the heap.
template <class Scalar>
class JacobianRows {
 public:
  /// Rows for so many legs, not set.
  explicit JacobianRows(std::size_t size) : more_(size > few_.size() ? size : 0) {}
  JacobianRow<Scalar>& operator[](std::size_t i) { return more_.empty() ? few_[i] : more_[i]; }  ///< row i, from 0

 private:
  std::array<JacobianRow<Scalar>, 3> few_;
  std::vector<JacobianRow<Scalar>> more_;
};

/// What the formula asks of a kind of number in addition to arithmetic, sqrt and abs2. This is for plain numbers and
/// their automatic derivatives; another kind specialises it.
template <class Scalar>
struct NumberKind {
  /// Whether a number is positive, for certain.
  static bool positive(const Scalar& number) { return value_of(number) > 0.0; }
  static Scalar absolute(const Scalar& number) {
    return number * (value_of(number) < 0.0 ? -1.0 : 1.0);
  }  ///< the absolute value

 private:
  template <class Number>
  static Number value_of(const Number& number) {
    return number;
  }
  template <class Derivatives>
  static auto value_of(const Eigen::AutoDiffScalar<Derivatives>& number) {
    return value_of(number.value());
  }
};

/// Puts the triangular factor R of J = Q R (Q^T Q = I) into the first three of more than three rows, by the modified
/// Gram-Schmidt method. Returns false where its first two columns are parallel, or may be.
template <class Scalar>
bool reduce_to_triangle(std::size_t legs, JacobianRows<Scalar>& rows) {
  using Eigen::numext::abs2;
  using std::sqrt;
  constexpr std::array columns{&JacobianRow<Scalar>::x, &JacobianRow<Scalar>::y, &JacobianRow<Scalar>::turn};
  std::array<JacobianRow<Scalar>, 3> factor;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = columns[k];
    Scalar square(0.0);
    for (std::size_t i = 0; i < legs; ++i) square += abs2(rows[i].*column);
    if (k < 2 && !NumberKind<Scalar>::positive(square)) return false;
    for (std::size_t j = 0; j < k; ++j) factor[k].*columns[j] = Scalar(0.0);
    factor[k].*column = sqrt(square);
    if (k == 2) break;
    const Scalar inverse = 1.0 / (factor[k].*column);
    for (std::size_t i = 0; i < legs; ++i) rows[i].*column *= inverse;
    for (std::size_t j = k + 1; j < 3; ++j) {
      const auto other = columns[j];
      Scalar part(0.0);
      for (std::size_t i = 0; i < legs; ++i) part += rows[i].*column * rows[i].*other;
      for (std::size_t i = 0; i < legs; ++i) rows[i].*other -= part * rows[i].*column;
      factor[k].*other = part;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) rows[k] = factor[k];
  return true;
}

/// kappa^-1 of at least two rows, of which more than three are overwritten. Their triangular factor R stands in for
/// them: R^T R = J^T J, so that sum_{i<j<k} det[J_i, J_j, J_k]^2 = det R^2 and sum_{i<j} |J_i x J_j|^2 = ||adj R||^2,
/// at a cost that grows with the number of legs, not with its third power, and without the digits that squaring J would
/// lose. Returns false, and leaves the result as it is, where the quotient is 0 / 0 or cannot
/// be distinguished from it: where all rows are parallel, and kappa^-1 is 0.
template <class Scalar>
bool kappa_inverse_of_rows(std::size_t legs, JacobianRows<Scalar>& rows, Scalar& result) {
  using Eigen::numext::abs2;  // the square; it costs half of what x * x does when derivatives are carried
  using std::sqrt;
  using Kind = NumberKind<Scalar>;
  if (legs == 2) {
    const Scalar determinant = rows[0].x * rows[1].y - rows[0].y * rows[1].x;
    result = Kind::absolute(determinant);
    return true;
  }
  Scalar squares(static_cast<double>(legs));  // the directions are unit vectors
  for (std::size_t i = 0; i < legs; ++i) squares += abs2(rows[i].turn);
  if (legs > 3 && !reduce_to_triangle(legs, rows)) return false;
  Scalar crosses(0.0);
  Scalar determinant(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 3; ++j) {
      const Scalar cross_x = rows[i].y * rows[j].turn - rows[i].turn * rows[j].y;
      const Scalar cross_y = rows[i].turn * rows[j].x - rows[i].x * rows[j].turn;
      const Scalar cross_turn = rows[i].x * rows[j].y - rows[i].y * rows[j].x;
      crosses += abs2(cross_x);
      crosses += abs2(cross_y);
      crosses += abs2(cross_turn);
      if (j == 1) {
        determinant = cross_x * rows[2].x + cross_y * rows[2].y + cross_turn * rows[2].turn;
      }
    }
  }
  if (!Kind::positive(crosses)) return false;
  const Scalar denominator = squares * crosses;
  const Scalar norms = sqrt(denominator);
  const Scalar ratio = determinant / norms;
  result = Kind::absolute(ratio) * 3.0;
  return true;
}

}  // namespace reprise
