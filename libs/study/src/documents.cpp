#include "reprise/study/documents.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace reprise {

Json to_json(const Eigen::Vector2d& point) { return Json::array({point.x(), point.y()}); }

Json to_json(const std::vector<Eigen::Vector2d>& points) {
  Json list = Json::array();
  for (const Eigen::Vector2d& point : points) list.push_back(to_json(point));
  return list;
}

std::string short_number(double value) { return fmt::format("{:.6g}", value == 0.0 ? 0.0 : value); }

std::string lower_number(double bound, int digits) {
  const auto text = [digits](double value) { return fmt::format("{:.{}g}", value == 0.0 ? 0.0 : value, digits); };
  // The nearest number of so many digits, or that of a value which is smaller by one in the last of them.
  const std::string nearest = text(bound);
  double read = 0.0;
  std::from_chars(nearest.data(), nearest.data() + nearest.size(), read);
  if (read <= bound) return nearest;
  const double last = std::pow(10.0, std::floor(std::log10(std::abs(bound))) + 1.0 - digits);
  return text(bound - last);
}

std::string upper_number(double bound, int digits) {
  const std::string lower = lower_number(-bound, digits);
  return lower.starts_with('-') ? lower.substr(1) : lower == "0" ? lower : "-" + lower;
}

std::string with_unit(double value, const std::string& unit, int power) {
  if (unit.empty()) return short_number(value);
  return fmt::format("{} {}{}", short_number(value), unit, power == 1 ? "" : fmt::format("^{}", power));
}

}  // namespace reprise
