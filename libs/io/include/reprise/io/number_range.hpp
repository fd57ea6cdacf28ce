#pragma once

// Ranges of numbers, as options and keys of files allow them.

#include <limits>
#include <string>

namespace reprise {

/// The numbers that are allowed. NaN and infinities are never allowed.
struct NumberRange {
  double lower = -std::numeric_limits<double>::infinity();  ///< the least number allowed
  double upper = std::numeric_limits<double>::infinity();   ///< the greatest number allowed
  bool lower_excluded = false;                              ///< the least number itself is not allowed

  bool contains(double value) const;  ///< false for NaN and infinities
  /// As in "a number above 0 and at most 1".
  std::string description() const;

  static NumberRange any() { return {}; }  ///< every finite number
  static NumberRange positive(double most = std::numeric_limits<double>::infinity()) {
    return {0.0, most, true};
  }  ///< above 0, and at most `most`
  static NumberRange at_least(double least) {
    return {least, std::numeric_limits<double>::infinity(), false};
  }                                                                                       ///< `least` or more
  static NumberRange between(double least, double most) { return {least, most, false}; }  ///< both ends are allowed
};

}  // namespace reprise
