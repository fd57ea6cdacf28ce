#include "frame/power_tics.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "reprise/io/figure.hpp"

namespace reprise::experiments {

std::string power_tics(const std::string& axis, double lower, double upper, bool labelled, int step) {
  constexpr std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string tics;
  for (int power = static_cast<int>(std::ceil(std::log10(lower) - 1e-9)); std::pow(10.0, power) <= upper;
       power += step) {
    std::string label = power < 0 ? "10⁻" : "10";
    for (const char digit : fmt::format("{}", std::abs(power)))
      label += digits.at(static_cast<std::size_t>(digit - '0'));
    tics += fmt::format("{}{} 1e{}", tics.empty() ? "" : ", ", gnuplot_string(labelled ? label : ""), power);
  }
  return fmt::format("set {}tics ({})", axis, tics);
}

}  // namespace reprise::experiments
