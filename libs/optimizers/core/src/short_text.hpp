#pragma once

#include <array>
#include <charconv>
#include <string>

namespace reprise {

/// A number in at most that many digits, whatever the locale: "17.014", "2.1e-09", "nan".
inline std::string short_text(double value, int digits) {
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return {text.data(), end};
}

}  // namespace reprise
