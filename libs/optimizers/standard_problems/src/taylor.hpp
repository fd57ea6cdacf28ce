#pragma once

// Numbers that carry derivatives, so that a formula written once gives its gradient and its Hessian as well.
//
// Eigen's AutoDiff does the same, but nested for second derivatives its expression templates take three seconds of
// compile time for each problem of the set; here every operation is a call of one function.

#include <array>
#include <cmath>
#include <numbers>

#include "reprise/base/constants.hpp"

namespace reprise::standard {

/// The largest problem of the set has this many variables.
inline constexpr int most_variables = 16;

/// The value of a function of at most most_variables variables with its gradient and, of order 2, its Hessian. A plain
/// number is a constant.
template <int order>
class Taylor {
  static_assert(order == 1 || order == 2);

 public:
  Taylor(double value = 0.0) : value_(value) {}

  /// The variable of that index (from 0) among n, at a value.
  static Taylor variable(double value, int index, int n);

  double value() const { return value_; }
  double first(int i) const { return first_[static_cast<std::size_t>(i)]; }
  /// Second derivative by the variables i and j <= i.
  double second(int i, int j) const { return second_[position(i, j)]; }

  /// F(a), and F(a, b), with the value and the partial derivatives of F.
  friend Taylor chain(const Taylor& a, double f, double f_a, double f_aa) {
    Taylor result(f);
    result.add(a, f_a, f_aa);
    return result;
  }
  friend Taylor chain(const Taylor& a, const Taylor& b, double f, double f_a, double f_b, double f_aa, double f_ab,
                      double f_bb) {
    Taylor result(f);
    result.add(a, f_a, f_aa);
    result.add(b, f_b, f_bb);
    if (f_ab != 0.0) result.add_mixed(a, b, f_ab);
    return result;
  }

  friend Taylor operator-(const Taylor& a) { return chain(a, -a.value_, -1.0, 0.0); }
  friend Taylor operator+(const Taylor& a, const Taylor& b) {
    return chain(a, b, a.value_ + b.value_, 1.0, 1.0, 0.0, 0.0, 0.0);
  }
  friend Taylor operator-(const Taylor& a, const Taylor& b) {
    return chain(a, b, a.value_ - b.value_, 1.0, -1.0, 0.0, 0.0, 0.0);
  }
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    return chain(a, b, a.value_ * b.value_, b.value_, a.value_, 0.0, 1.0, 0.0);
  }
  friend Taylor operator/(const Taylor& a, const Taylor& b) {
    const double inverse = 1.0 / b.value_;
    const double f = a.value_ * inverse;
    return chain(a, b, f, inverse, -f * inverse, 0.0, -inverse * inverse, 2.0 * f * inverse * inverse);
  }
  Taylor& operator+=(const Taylor& other) { return *this = *this + other; }
  Taylor& operator-=(const Taylor& other) { return *this = *this - other; }
  Taylor& operator*=(const Taylor& other) { return *this = *this * other; }

  friend Taylor exp(const Taylor& a) {
    const double f = std::exp(a.value_);
    return chain(a, f, f, f);
  }
  friend Taylor log(const Taylor& a) {
    const double inverse = 1.0 / a.value_;
    return chain(a, std::log(a.value_), inverse, -inverse * inverse);
  }
  friend Taylor sqrt(const Taylor& a) {
    const double f = std::sqrt(a.value_);
    return chain(a, f, 0.5 / f, -0.25 / (f * a.value_));
  }
  friend Taylor sin(const Taylor& a) {
    const double f = std::sin(a.value_);
    return chain(a, f, std::cos(a.value_), -f);
  }
  friend Taylor cos(const Taylor& a) {
    const double f = std::cos(a.value_);
    return chain(a, f, -std::sin(a.value_), -f);
  }
  friend Taylor pow(const Taylor& a, double p) {
    return chain(a, std::pow(a.value_, p), p * std::pow(a.value_, p - 1.0),
                 p * (p - 1.0) * std::pow(a.value_, p - 2.0));
  }
  friend Taylor pow(const Taylor& a, const Taylor& b) { return exp(b * log(a)); }
  friend Taylor normal_distribution(const Taylor& a) {
    const double density = std::exp(-0.5 * a.value_ * a.value_) / std::sqrt(2.0 * pi);
    return chain(a, 0.5 * std::erfc(-a.value_ / std::numbers::sqrt2), density, -a.value_ * density);
  }

 private:
  /// Where the lower triangle keeps the entry (i, j), j <= i.
  static std::size_t position(int i, int j) { return static_cast<std::size_t>(i * (i + 1) / 2 + j); }

  /// Adds f_a grad a to the gradient, and f_a Hess a + f_aa grad a grad a^T to the Hessian.
  void add(const Taylor& a, double f_a, double f_aa);
  /// Adds f_ab (grad a grad b^T + grad b grad a^T) to the Hessian.
  void add_mixed(const Taylor& a, const Taylor& b, double f_ab);

  double value_;
  int n_ = 0;  ///< derivatives by variables from here on are zero
  std::array<double, most_variables> first_{};
  std::array<double, (order == 2 ? most_variables * (most_variables + 1) / 2 : 0)> second_{};
};

// The same formulas with plain numbers.
using std::cos;
using std::exp;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;

/// Distribution function of the standard normal distribution.
inline double normal_distribution(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

template <class T>
T squared(const T& x) {
  return x * x;
}

template <class T>
T cubed(const T& x) {
  return x * x * x;
}

template <class T>
T to_the_fourth(const T& x) {
  return squared(squared(x));
}

}  // namespace reprise::standard
