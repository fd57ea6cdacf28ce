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
  Scalar x;
  Scalar y;
  Scalar turn;
};

/// The rows of up to three legs on the stack, of more on the heap.
template <class Scalar>
class JacobianRows {
 public:
  explicit JacobianRows(std::size_t size) : more_(size > few_.size() ? size : 0) {}
  JacobianRow<Scalar>& operator[](std::size_t i) { return more_.empty() ? few_[i] : more_[i]; }

 private:
  std::array<JacobianRow<Scalar>, 3> few_;
  std::vector<JacobianRow<Scalar>> more_;
};

/// What the formula asks of a kind of number besides arithmetic, sqrt and abs2. This is for plain numbers and their
/// automatic derivatives; another kind specialises it.
template <class Scalar>
struct NumberKind {
  /// Whether a number is positive, for certain.
  static bool positive(const Scalar& number) { return value_of(number) > 0.0; }
  static Scalar absolute(const Scalar& number) { return number * (value_of(number) < 0.0 ? -1.0 : 1.0); }

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

/// kappa^-1 of at least two rows. Returns false, and leaves the result as it is, where the quotient is 0 / 0 or cannot
/// be told from it: where all rows are parallel, at which kappa^-1 is 0.
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
  Scalar crosses(0.0);
  Scalar determinants(0.0);
  for (std::size_t i = 0; i < legs; ++i) {
    squares += abs2(rows[i].turn);
    for (std::size_t j = i + 1; j < legs; ++j) {
      const Scalar cross_x = rows[i].y * rows[j].turn - rows[i].turn * rows[j].y;
      const Scalar cross_y = rows[i].turn * rows[j].x - rows[i].x * rows[j].turn;
      const Scalar cross_turn = rows[i].x * rows[j].y - rows[i].y * rows[j].x;
      crosses += abs2(cross_x);
      crosses += abs2(cross_y);
      crosses += abs2(cross_turn);
      for (std::size_t k = j + 1; k < legs; ++k) {
        const Scalar determinant = cross_x * rows[k].x + cross_y * rows[k].y + cross_turn * rows[k].turn;
        if (legs == 3) {
          determinants = determinant;
        } else {
          determinants += abs2(determinant);
        }
      }
    }
  }
  if (!Kind::positive(crosses)) return false;
  const Scalar denominator = squares * crosses;
  if (legs == 3) {
    const Scalar norms = sqrt(denominator);
    const Scalar ratio = determinants / norms;
    result = Kind::absolute(ratio) * 3.0;
  } else {
    const Scalar ratio = determinants / denominator;
    const Scalar root = sqrt(ratio);
    result = root * 3.0;
  }
  return true;
}

}  // namespace reprise
