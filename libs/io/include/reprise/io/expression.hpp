#pragma once

// Numbers as papers print them: "10*sqrt(3)/3".

#include <optional>
#include <string>

namespace reprise {

/// What a text is worth as a number, or what is wrong with it.
struct Evaluated {
  std::optional<double> value;  ///< finite
  std::string trouble;  ///< a clause such as "cannot be read at character 4 ('sqr')"; empty where there is a value
};

/// What an expression may hold, as messages say it.
inline constexpr const char* expression_parts = "+ - * / ( ), sqrt, pi, and sin and cos of degrees";

/// The value of an expression of decimal numbers, + - * / ( ), sqrt(x), sin(x), cos(x) with x in degrees, and pi, read
/// from left to right with the usual precedence, in double precision. Sine and cosine of whole multiples of 90 degrees
/// are exact. Does not depend on the locale. At most 1000 characters, nested as deeply as these allow.
Evaluated evaluate(const std::string& expression);

}  // namespace reprise
