#pragma once

// Interval arithmetic that encloses the exact result of every operation, by Boost.Interval.
//
// Boost's own rounding switches the processor's rounding mode around every operation. Compilers may move operations
// across such a switch, and whatever else is computed meanwhile is rounded the wrong way too. Here the mode stays at
// "to nearest": every bound is computed there and then moved outwards by one unit in its last place, which is more than
// the half unit that rounding can be wrong by. So the bounds hold with every compiler and every level of optimization,
// as long as operations are those of IEEE 754 in double precision (no -ffast-math), and enclosures are wider by some
// 1e-16 only.
//
// Sines, cosines and powers come from the C library, whose errors are known but not proved: glibc documents at most one
// unit in the last place for them. They are moved by four.

#include <Eigen/Core>
#include <algorithm>
#include <boost/numeric/interval.hpp>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/AutoDiff>

#include "reprise/kinematics/kappa_inverse_formula.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise::rigorous {

static_assert(std::numeric_limits<double>::is_iec559, "bounds need the arithmetic of IEEE 754");

/// At or beyond the neighbouring number, in the direction named. After S. M. Rump, P. Zimmermann, S. Boldo, G.
/// Melquiond, Computing predecessor and successor in rounding to nearest, BIT 49 (2009), Algorithm 1; of infinite
/// numbers the largest finite one is taken where they are the wrong bound.
inline double step_of(double x) {
  constexpr double unit = 0.5 * std::numeric_limits<double>::epsilon();
  return unit * (1.0 + 2.0 * unit) * std::abs(x) + std::numeric_limits<double>::denorm_min();
}
inline double down(double x) {
  return x == std::numeric_limits<double>::infinity() ? std::numeric_limits<double>::max() : x - step_of(x);
}
inline double up(double x) {
  return x == -std::numeric_limits<double>::infinity() ? -std::numeric_limits<double>::max() : x + step_of(x);
}

/// The same for results of the C library.
inline double library_down(double x) { return down(down(down(down(x)))); }
inline double library_up(double x) { return up(up(up(up(x)))); }

/// The rounding policy of Boost.Interval described above.
struct OutwardRounding {
  using unprotected_rounding = OutwardRounding;  // NOLINT(readability-identifier-naming): Boost's name

  static double conv_down(double x) { return x; }
  static double conv_up(double x) { return x; }
  static double add_down(double x, double y) { return down(x + y); }
  static double add_up(double x, double y) { return up(x + y); }
  static double sub_down(double x, double y) { return down(x - y); }
  static double sub_up(double x, double y) { return up(x - y); }
  static double mul_down(double x, double y) { return down(x * y); }
  static double mul_up(double x, double y) { return up(x * y); }
  static double div_down(double x, double y) { return down(x / y); }
  static double div_up(double x, double y) { return up(x / y); }
  static double sqrt_down(double x) { return down(std::sqrt(x)); }
  static double sqrt_up(double x) { return up(std::sqrt(x)); }
  static double median(double x, double y) { return 0.5 * x + 0.5 * y; }
  static double int_down(double x) { return std::floor(x); }
  static double int_up(double x) { return std::ceil(x); }
  static double cos_down(double x) { return std::max(-1.0, library_down(std::cos(x))); }
  static double cos_up(double x) { return std::min(1.0, library_up(std::cos(x))); }
};

/// An interval that holds an exact number. Where an operation is undefined its bounds are not numbers, and no
/// comparison with them holds.
using Enclosure = boost::numeric::interval<
    double,
    boost::numeric::interval_lib::policies<OutwardRounding, boost::numeric::interval_lib::checking_base<double>>>;

inline Enclosure to_enclosure(const Interval& interval) { return {interval.lower, interval.upper}; }
inline Interval to_interval(const Enclosure& enclosure) { return {enclosure.lower(), enclosure.upper()}; }

inline Enclosure everything() {
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

/// Whether a number certainly differs from zero.
inline bool nonzero(const Enclosure& x) { return x.lower() > 0.0 || x.upper() < 0.0; }

/// x^exponent for x >= 0. Its logarithm is bilinear in the exponent and the logarithm of x, so bounds are at corners.
inline Enclosure power(const Enclosure& x, const Enclosure& exponent) {
  const double least = std::max(0.0, x.lower());
  const auto [lower, upper] =
      std::minmax({std::pow(least, exponent.lower()), std::pow(least, exponent.upper()),
                   std::pow(x.upper(), exponent.lower()), std::pow(x.upper(), exponent.upper())});
  return {std::max(0.0, library_down(lower)), library_up(upper)};
}

/// A value with its derivatives along x, y and the orientation.
using Differentiated = Eigen::AutoDiffScalar<Eigen::Matrix<Enclosure, 3, 1>>;

}  // namespace reprise::rigorous

namespace Eigen {

template <>
struct NumTraits<reprise::rigorous::Enclosure> : GenericNumTraits<reprise::rigorous::Enclosure> {};

namespace internal {
/// x * x does not know that both factors are the same number.
template <>
struct abs2_impl<reprise::rigorous::Enclosure> {
  static reprise::rigorous::Enclosure run(const reprise::rigorous::Enclosure& x) { return boost::numeric::square(x); }
};
}  // namespace internal

}  // namespace Eigen

namespace reprise {

template <>
struct NumberKind<rigorous::Enclosure> {
  static bool positive(const rigorous::Enclosure& number) { return number.lower() > 0.0; }
  static rigorous::Enclosure absolute(const rigorous::Enclosure& number) { return boost::numeric::abs(number); }
};

/// Where the number may be zero, the derivatives of the absolute value are the hull of those on both sides: its
/// generalised gradient, which holds zero at every minimum as well.
template <>
struct NumberKind<rigorous::Differentiated> {
  static bool positive(const rigorous::Differentiated& number) { return number.value().lower() > 0.0; }
  static rigorous::Differentiated absolute(const rigorous::Differentiated& number) {
    if (number.value().lower() >= 0.0) return number;
    if (number.value().upper() <= 0.0) return -number;
    rigorous::Differentiated result = number;
    result.value() = boost::numeric::abs(number.value());
    for (rigorous::Enclosure& derivative : result.derivatives()) {
      derivative = boost::numeric::hull(derivative, -derivative);
    }
    return result;
  }
};

}  // namespace reprise
