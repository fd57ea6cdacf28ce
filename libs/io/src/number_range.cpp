#include "reprise/io/number_range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace reprise {

bool NumberRange::contains(double value) const {
  return std::isfinite(value) && value <= upper && (lower_excluded ? value > lower : value >= lower);
}

std::string NumberRange::description() const {
  std::string text = "a number";
  if (std::isfinite(lower)) text += fmt::format(" {} {}", lower_excluded ? "above" : "of at least", lower);
  if (std::isfinite(upper)) text += fmt::format("{} at most {}", std::isfinite(lower) ? " and" : " of", upper);
  return text;
}

}  // namespace reprise
