// The expressions of input files (reprise/io/expression.hpp) where muParser is not there: in the page. The notation is
// a part of JavaScript's, which also reads from left to right in double precision; so the page evaluates them
// (page/expression.js).

#include <emscripten.h>

#include <boost/math/special_functions/cos_pi.hpp>
#include <boost/math/special_functions/sin_pi.hpp>
#include <cmath>
#include <limits>

#include "reprise/io/expression.hpp"

EM_JS(double, evaluate_in_page, (const char* text), { return Module["evaluate"](UTF8ToString(text)); });

namespace {

/// The part of a turn that an angle in degrees goes beyond whole ones, in half turns; exact for multiples of 90
/// degrees.
double half_turns(double degrees) { return std::fmod(degrees, 360.0) / 180.0; }

}  // namespace

extern "C" {

/// The sine of an angle in degrees, for JavaScript.
EMSCRIPTEN_KEEPALIVE double explorer_sine(double degrees) {
  return std::isfinite(degrees) ? boost::math::sin_pi(half_turns(degrees)) : std::numeric_limits<double>::quiet_NaN();
}

/// The cosine of an angle in degrees, for JavaScript.
EMSCRIPTEN_KEEPALIVE double explorer_cosine(double degrees) {
  return std::isfinite(degrees) ? boost::math::cos_pi(half_turns(degrees)) : std::numeric_limits<double>::quiet_NaN();
}
}

namespace reprise {

Evaluated evaluate(const std::string& expression) {
  const double value = evaluate_in_page(expression.c_str());
  if (!std::isfinite(value)) return {std::nullopt, "has no finite value or cannot be read"};
  return {value == 0.0 ? 0.0 : value, ""};  // no -0
}

}  // namespace reprise
