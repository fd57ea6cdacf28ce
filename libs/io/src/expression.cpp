#include "reprise/io/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <boost/math/special_functions/cos_pi.hpp>
#include <boost/math/special_functions/sin_pi.hpp>
#include <cmath>
#include <limits>

#include "reprise/base/constants.hpp"

namespace reprise {

namespace {

constexpr std::size_t longest_expression = 1000;  // characters

/// The part of a turn that an angle in degrees goes beyond whole ones, in half turns; exact for multiples of 90
/// degrees.
double half_turns(double degrees) { return std::fmod(degrees, 360.0) / 180.0; }

double sine_of_degrees(double x) {
  return std::isfinite(x) ? boost::math::sin_pi(half_turns(x)) : std::numeric_limits<double>::quiet_NaN();
}

double cosine_of_degrees(double x) {
  return std::isfinite(x) ? boost::math::cos_pi(half_turns(x)) : std::numeric_limits<double>::quiet_NaN();
}

double square_root(double x) { return std::sqrt(x); }

mu::Parser make_parser() {
  mu::Parser parser;
  parser.ClearFun();
  parser.ClearConst();
  parser.DefineConst("pi", pi);
  parser.DefineFun("sqrt", square_root);
  parser.DefineFun("sin", sine_of_degrees);
  parser.DefineFun("cos", cosine_of_degrees);
  return parser;
}

std::string trouble_at(std::size_t position, std::string token) {
  while (token.ends_with(' ')) token.pop_back();
  return fmt::format("cannot be read at character {} ('{}')", position + 1, token);
}

std::string trouble_of(const mu::Parser::exception_type& error) {
  switch (error.GetCode()) {
    case mu::ecEMPTY_EXPRESSION:
      return "is empty";
    case mu::ecUNEXPECTED_EOF:
      return "ends too early";
    case mu::ecMISSING_PARENS:
      return "has a parenthesis that is not closed";
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("has no number in the parentheses of {}", error.GetToken());
    default:
      return trouble_at(static_cast<std::size_t>(error.GetPos()), error.GetToken());
  }
}

}  // namespace

Evaluated evaluate(const std::string& expression) {
  if (expression.size() > longest_expression) {
    return {std::nullopt, fmt::format("is longer than {} characters", longest_expression)};
  }
  // The parser knows more operators than ours.
  const std::size_t stray =
      expression.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.+-*/() ");
  if (stray != std::string::npos) {
    const char c = expression[stray];
    return {std::nullopt, c > ' ' && c < '\x7f' ? trouble_at(stray, std::string(1, c))
                                                : fmt::format("cannot be read at character {}", stray + 1)};
  }
  try {
    thread_local mu::Parser parser = make_parser();
    parser.SetExpr(expression);
    const double value = parser.Eval();
    if (!std::isfinite(value)) return {std::nullopt, "has no finite value"};
    return {value == 0.0 ? 0.0 : value, ""};  // no -0
  } catch (const mu::Parser::exception_type& error) {
    return {std::nullopt, trouble_of(error)};
  }
}

}  // namespace reprise
