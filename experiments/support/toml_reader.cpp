#include "support/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "support/files.hpp"

namespace reprise::experiments {

namespace {

constexpr std::size_t longest_file = 1'000'000;  // bytes

/// A number, or a text such as "sqrt(2)".
std::optional<double> number_of(const toml::node& node) {
  if (const auto value = node.value_exact<double>()) return *value;
  if (const auto value = node.value_exact<int64_t>()) return static_cast<double>(*value);
  const auto text = node.value_exact<std::string>();
  if (!text || !text->starts_with("sqrt(") || !text->ends_with(')')) return std::nullopt;
  const char* const end = text->data() + text->size() - 1;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text->data() + 5, end, value);
  return error == std::errc{} && stop == end && value >= 0.0 ? std::optional(std::sqrt(value)) : std::nullopt;
}

/// A value as messages show it: a number or a short text; nothing for the rest.
std::string shown(const toml::node& node) {
  constexpr std::size_t longest = 60;
  if (const auto value = node.value_exact<double>()) return fmt::format(" is {}, but", *value);
  if (const auto value = node.value_exact<int64_t>()) return fmt::format(" is {}, but", *value);
  const auto text = node.value_exact<std::string>();
  const bool printable = text && text->size() <= longest &&
                         std::all_of(text->begin(), text->end(), [](char c) { return c >= ' ' && c <= '~'; });
  return printable ? fmt::format(" is '{}', but", *text) : "";
}

/// A list of items, as messages say it: "a list of 2 numbers".
std::string list_of(std::size_t size, const char* items) {
  return size == 0 ? fmt::format("a list of {}", items) : fmt::format("a list of {} {}", size, items);
}

}  // namespace

TomlSection::TomlSection(std::filesystem::path file, const toml::table& table, std::string name)
    : file_(std::move(file)), table_(table), name_(std::move(name)) {}

void TomlSection::fail(const toml::node& node, const std::string& what) const {
  const bool sentence = what.ends_with('.');
  throw InputError(fmt::format("{}, line {}: {}{}", file_.string(),
                               std::max<toml::source_index>(node.source().begin.line, 1), what, sentence ? "" : "."));
}

void TomlSection::reject(const std::string& key, const std::string& must_be) const {
  const toml::node& node = *table_.get(key);
  fail(node, fmt::format("{}{} must be {}.", path_of(key), shown(node), must_be));
}

const toml::node& TomlSection::need(const std::string& key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) fail(table_, fmt::format("{} has no key '{}'.", name_.empty() ? "the file" : name_, key));
  read_.insert(key);
  return *node;
}

double TomlSection::number(const std::string& key, const NumberRange& range) {
  const auto value = number_of(need(key));
  if (!value || !range.contains(*value)) reject(key, range.description());
  return *value;
}

double TomlSection::number_or(const std::string& key, double standard, const NumberRange& range) {
  return has(key) ? number(key, range) : standard;
}

std::string TomlSection::text(const std::string& key) {
  const auto value = need(key).value_exact<std::string>();
  if (!value) reject(key, "a text");
  return *value;
}

std::string TomlSection::text_or(const std::string& key, const std::string& standard) {
  return has(key) ? text(key) : standard;
}

std::vector<double> TomlSection::numbers(const std::string& key, std::size_t size, const NumberRange& range) {
  return numbers(need(key), path_of(key), size, range);
}

std::vector<double> TomlSection::numbers(const toml::node& node, const std::string& name, std::size_t size,
                                         const NumberRange& range) const {
  const toml::array* array = node.as_array();
  if (array == nullptr || (size != 0 && array->size() != size)) {
    fail(node, fmt::format("{} must be {}.", name, list_of(size, "numbers")));
  }
  std::vector<double> values;
  for (const toml::node& item : *array) {
    const auto value = number_of(item);
    if (!value || !range.contains(*value)) {
      fail(item, fmt::format("{} must be {}; one{} must be {}.", name, list_of(size, "numbers"), shown(item),
                             range.description()));
    }
    values.push_back(*value);
  }
  return values;
}

std::vector<std::array<double, 2>> TomlSection::pairs(const std::string& key, std::size_t size,
                                                      const NumberRange& range) {
  const toml::array* array = need(key).as_array();
  if (array == nullptr || (size != 0 && array->size() != size)) reject(key, list_of(size, "pairs of numbers"));
  std::vector<std::array<double, 2>> values;
  for (const toml::node& pair : *array) {
    const std::vector<double> read = numbers(pair, "each item of " + path_of(key), 2, range);
    values.push_back({read[0], read[1]});
  }
  return values;
}

std::vector<std::string> TomlSection::texts(const std::string& key) {
  const toml::array* array = need(key).as_array();
  if (array == nullptr) reject(key, "a list of texts");
  std::vector<std::string> values;
  for (const toml::node& item : *array) {
    const auto value = item.value_exact<std::string>();
    if (!value) reject(key, "a list of texts");
    values.push_back(*value);
  }
  return values;
}

TomlSection TomlSection::section(const std::string& key) {
  const toml::table* table = need(key).as_table();
  if (table == nullptr) reject(key, "a table");
  return {file_, *table, path_of(key)};
}

std::vector<TomlSection> TomlSection::sections(const std::string& key) {
  const toml::array* array = need(key).as_array();
  if (array == nullptr || array->empty())
    reject(key, fmt::format("a list of tables, each of them a [[{}]]", path_of(key)));
  std::vector<TomlSection> all;
  for (const toml::node& item : *array) {
    if (!item.is_table()) fail(item, fmt::format("{} must be a list of tables.", path_of(key)));
    all.emplace_back(file_, *item.as_table(), fmt::format("{} {}", path_of(key), all.size() + 1));
  }
  return all;
}

void TomlSection::reject_unknown_keys() const {
  for (const auto& [key, node] : table_) {
    if (!read_.contains(std::string(key.str()))) {
      fail(node, fmt::format("{} has an unknown key '{}'.", name_.empty() ? "the file" : name_, key.str()));
    }
  }
}

toml::table parse_toml(const std::filesystem::path& file) {
  const std::string content = [&] {
    try {
      return read_file(file, longest_file);
    } catch (const std::runtime_error& error) {
      throw InputError(error.what());
    }
  }();
  if (content.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(fmt::format("{}, line 1: the file is empty.", file.string()));
  }
  try {
    return toml::parse(content, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}, line {}: {}.", file.string(), error.source().begin.line, error.description()));
  }
}

Shape read_shape(TomlSection& section) {
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
    for (double& angle : table.angles) angle *= std::numbers::pi / 180.0;
    return table;
  }
  section.fail(
      section.need("kind"),
      fmt::format("{}.kind is '{}', but must be one of superellipse, ellipse, quarter_ellipses, circle, rectangle, "
                  "polygon, polar_table.",
                  section.name(), kind));
}

}  // namespace reprise::experiments
