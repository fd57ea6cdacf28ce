#include "chapter/printed_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace reprise::experiments {

PrintedNumber printed_number(const std::string& text) {
  PrintedNumber number{text, 0.0, 0.0};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  if (error != std::errc{} || stop != text.data() + text.size()) {
    throw std::runtime_error(fmt::format("'{}' is not a number.", text));
  }
  const std::size_t mantissa_end = std::min(text.find_first_of("eE"), text.size());
  const std::size_t point = text.find('.');
  int exponent = point < mantissa_end ? -static_cast<int>(mantissa_end - point - 1) : 0;
  if (mantissa_end < text.size()) exponent += std::stoi(text.substr(mantissa_end + 1));
  number.half_unit = 0.5 * std::pow(10.0, exponent);
  return number;
}

}  // namespace reprise::experiments
