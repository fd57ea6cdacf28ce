#include "reprise/study/documents.hpp"

#include <fmt/format.h>

namespace reprise {

Json to_json(const Eigen::Vector2d& point) { return Json::array({point.x(), point.y()}); }

Json to_json(const std::vector<Eigen::Vector2d>& points) {
  Json list = Json::array();
  for (const Eigen::Vector2d& point : points) list.push_back(to_json(point));
  return list;
}

std::string short_number(double value) { return fmt::format("{:.6g}", value == 0.0 ? 0.0 : value); }

std::string with_unit(double value, const std::string& unit, int power) {
  if (unit.empty()) return short_number(value);
  return fmt::format("{} {}{}", short_number(value), unit, power == 1 ? "" : fmt::format("^{}", power));
}

}  // namespace reprise
