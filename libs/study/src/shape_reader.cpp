#include "reprise/study/shape_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/io/messages.hpp"

namespace reprise {

namespace {

/// The kinds of shapes, with their keys.
const std::vector<std::pair<std::string, std::vector<std::string>>> shape_kinds{
    {"superellipse", {"semi_axes", "exponent"}},
    {"ellipse", {"semi_axes"}},
    {"quarter_ellipses", {"right", "up", "left", "down"}},
    {"circle", {"radius"}},
    {"rectangle", {"width", "height"}},
    {"polygon", {"vertices"}},
    {"polar_table", {"angles_deg", "radii"}}};

}  // namespace

std::vector<std::string> shape_keys(const TomlSection& section) {
  const std::string kind = section.has("kind") ? section.text("kind") : "";
  const bool known =
      std::any_of(shape_kinds.begin(), shape_kinds.end(), [&](const auto& one) { return one.first == kind; });
  std::vector<std::string> all{"kind"};
  for (const auto& [name, keys] : shape_kinds) {
    if (known && name != kind) continue;
    std::copy_if(keys.begin(), keys.end(), std::back_inserter(all),
                 [&](const std::string& key) { return std::find(all.begin(), all.end(), key) == all.end(); });
  }
  return all;
}

Shape read_shape(const TomlSection& section) {
  const NumberRange positive = NumberRange::positive();
  const auto semi_axes = [&] {
    const std::vector<double> values = section.numbers("semi_axes", 2, positive);
    return Eigen::Vector2d(values[0], values[1]);
  };
  const std::string kind = section.text("kind");
  if (kind == "superellipse") return Superellipse{semi_axes(), section.number("exponent", positive)};
  if (kind == "ellipse") return Ellipse{semi_axes()};
  if (kind == "quarter_ellipses") {
    return QuarterEllipses{section.number("right", positive), section.number("up", positive),
                           section.number("left", positive), section.number("down", positive)};
  }
  if (kind == "circle") return Circle{section.number("radius", positive)};
  if (kind == "rectangle") return Rectangle{section.number("width", positive), section.number("height", positive)};
  if (kind == "polygon") {
    Polygon polygon;
    for (const auto& [x, y] : section.pairs("vertices")) polygon.vertices.emplace_back(x, y);
    return polygon;
  }
  if (kind == "polar_table") {
    PolarTable table{section.numbers("angles_deg"), section.numbers("radii", 0, positive)};
    for (double& angle : table.angles) angle *= pi / 180.0;
    return table;
  }
  std::vector<std::string> kinds;
  for (const auto& [name, keys] : shape_kinds) kinds.push_back(name);
  const std::string suggestion = did_you_mean(kind, kinds);
  section.reject("kind",
                 fmt::format("one of {}{}", fmt::join(kinds, ", "), suggestion.empty() ? "" : " (" + suggestion + ")"));
}

}  // namespace reprise
