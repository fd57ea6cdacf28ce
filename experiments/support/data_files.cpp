#include "support/data_files.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "support/files.hpp"

namespace reprise::experiments {

namespace {

constexpr const char* whole_file = "the file";

/// A number, or a text such as "sqrt(2)".
std::optional<double> number_of(const toml::node& node) {
  if (const auto value = node.value_exact<double>()) return *value;
  if (const auto value = node.value_exact<int64_t>()) return static_cast<double>(*value);
  const auto text = node.value_exact<std::string>();
  if (!text || !text->starts_with("sqrt(") || !text->ends_with(')')) return std::nullopt;
  const std::string digits = text->substr(5, text->size() - 6);
  std::size_t used = 0;
  try {
    const double value = std::stod(digits, &used);
    return used == digits.size() && value >= 0.0 ? std::optional(std::sqrt(value)) : std::nullopt;
  } catch (const std::logic_error&) {
    return std::nullopt;
  }
}

/// One table of a file. It knows where it stands, and which of its keys were read, so that unknown keys are found.
class Section {
 public:
  Section(const std::filesystem::path& file, const toml::table& table, std::string name)
      : file_(file), table_(table), name_(std::move(name)) {}

  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}, line {}: {}", file_.string(), node.source().begin.line, what));
  }

  bool has(const std::string& key) const { return table_.contains(key); }

  const toml::node& need(const std::string& key) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) fail(table_, fmt::format("{} has no key '{}'.", name_, key));
    read_.insert(key);
    return *node;
  }

  double number(const std::string& key) {
    const toml::node& node = need(key);
    const auto value = number_of(node);
    if (!value) fail(node, fmt::format("{}.{} must be a number.", name_, key));
    return *value;
  }

  double number(const std::string& key, double standard) { return has(key) ? number(key) : standard; }

  std::string text(const std::string& key) {
    const toml::node& node = need(key);
    const auto value = node.value_exact<std::string>();
    if (!value) fail(node, fmt::format("{}.{} must be a text.", name_, key));
    return *value;
  }

  /// An array of numbers; of any length when `size` is 0.
  std::vector<double> numbers(const std::string& key, std::size_t size = 0) {
    return numbers(need(key), fmt::format("{}.{}", name_, key), size);
  }

  /// An array of arrays of two numbers each; of any length when `size` is 0.
  std::vector<std::array<double, 2>> pairs(const std::string& key, std::size_t size = 0) {
    const toml::node& node = need(key);
    const std::string name = fmt::format("{}.{}", name_, key);
    const toml::array* array = node.as_array();
    if (array == nullptr || (size != 0 && array->size() != size)) {
      fail(node,
           fmt::format("{} must be a list of {}pairs of numbers.", name, size == 0 ? "" : fmt::format("{} ", size)));
    }
    std::vector<std::array<double, 2>> values;
    for (const toml::node& pair : *array) {
      const std::vector<double> read = numbers(pair, "each item of " + name, 2);
      values.push_back({read[0], read[1]});
    }
    return values;
  }

  Section section(const std::string& key) {
    const toml::node& node = need(key);
    if (!node.is_table()) fail(node, fmt::format("{}.{} must be a table.", name_, key));
    return Section(file_, *node.as_table(), name_ == whole_file ? key : fmt::format("{}.{}", name_, key));
  }

  void reject_unknown_keys() const {
    for (const auto& [key, node] : table_) {
      if (!read_.contains(std::string(key.str()))) {
        fail(node, fmt::format("{} has an unknown key '{}'.", name_, key.str()));
      }
    }
  }

  /// What the libraries reject becomes an error of this section.
  template <typename Make>
  auto make(const Make& function) const {
    try {
      return function();
    } catch (const std::invalid_argument& error) {
      fail(table_, error.what());
    }
  }

  const toml::table& table() const { return table_; }

 private:
  std::vector<double> numbers(const toml::node& node, const std::string& name, std::size_t size) const {
    std::vector<double> values;
    const toml::array* array = node.as_array();
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
      const auto value = number_of(*array->get(i));
      if (!value) break;
      values.push_back(*value);
    }
    if (array == nullptr || values.size() != array->size() || (size != 0 && values.size() != size)) {
      fail(node, fmt::format("{} must be a list of {}numbers.", name, size == 0 ? "" : fmt::format("{} ", size)));
    }
    return values;
  }

  const std::filesystem::path& file_;
  const toml::table& table_;
  std::string name_;
  std::set<std::string> read_;
};

toml::table parse(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  try {
    return toml::parse(content, path.string());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(
        fmt::format("{}, line {}: {}.", path.string(), error.source().begin.line, error.description()));
  }
}

Shape read_shape(Section& section, const std::string& kind) {
  const auto pair = [&](const std::string& key) {
    const std::vector<double> values = section.numbers(key, 2);
    return Eigen::Vector2d(values[0], values[1]);
  };
  if (kind == "superellipse") return Superellipse{pair("semi_axes"), section.number("exponent")};
  if (kind == "ellipse") return Ellipse{pair("semi_axes")};
  if (kind == "quarter_ellipses") {
    return QuarterEllipses{section.number("right"), section.number("up"), section.number("left"),
                           section.number("down")};
  }
  if (kind == "circle") return Circle{section.number("radius")};
  if (kind == "rectangle") return Rectangle{section.number("width"), section.number("height")};
  if (kind == "polygon") {
    Polygon polygon;
    for (const auto& [x, y] : section.pairs("vertices")) polygon.vertices.emplace_back(x, y);
    return polygon;
  }
  if (kind == "polar_table") {
    PolarTable table{section.numbers("angles_deg"), section.numbers("radii")};
    for (double& angle : table.angles) angle *= std::numbers::pi / 180.0;
    return table;
  }
  section.fail(
      section.need("kind"),
      fmt::format("kind is '{}', but must be one of superellipse, ellipse, quarter_ellipses, circle, rectangle, "
                  "polygon, polar_table.",
                  kind));
}

double read_scale(Section& section, const std::string& synthesis) {
  if (!section.has("scaled_down_by")) return section.number("scale", 1.0);
  if (section.has("scale")) {
    section.fail(section.need("scale"), "scale and scaled_down_by are given both, but only one of them is allowed.");
  }
  Section divisors = section.section("scaled_down_by");
  const double divisor = divisors.number(synthesis);
  if (!(divisor > 0.0)) section.fail(divisors.need(synthesis), fmt::format("{} must be above 0.", synthesis));
  return 1.0 / divisor;
}

}  // namespace

CollinearManipulator read_manipulator(const std::filesystem::path& path, const std::string& name) {
  const toml::table file = parse(path);
  Section root(path, file, whole_file);
  Section section = root.section("manipulators").section(name);
  const std::vector<double> d = section.numbers("design", 5);
  const std::vector<std::array<double, 2>> lengths = section.pairs("length", 3);
  section.reject_unknown_keys();

  CollinearManipulator manipulator{name, {d[0], d[1], d[2], d[3], d[4]}, {}};
  for (std::size_t leg = 0; leg < 3; ++leg) manipulator.lengths[leg] = {lengths[leg][0], lengths[leg][1]};
  section.make([&] { return make_manipulator(manipulator.design, manipulator.lengths, name); });
  return manipulator;
}

std::vector<SourcedWorkspace> read_prescribed_workspaces(const std::filesystem::path& path,
                                                         const std::string& synthesis) {
  const toml::table file = parse(path);
  Section root(path, file, whole_file);
  Section all = root.section("workspaces");
  std::vector<SourcedWorkspace> workspaces;
  for (const auto& [key, node] : all.table()) {
    const std::string name(key.str());
    Section section = all.section(name);
    const std::string kind = section.text("kind");
    const Shape shape = read_shape(section, kind);
    const std::vector<double> centre = section.numbers("centre", 2);
    const Placement placement{{centre[0], centre[1]},
                              read_scale(section, synthesis),
                              section.number("rotation_deg", 0.0) * std::numbers::pi / 180.0};
    const std::string source = section.has("source") ? section.text("source") : "";
    const std::string certainty = section.has("certainty") ? section.text("certainty") : "";
    section.reject_unknown_keys();
    workspaces.push_back(
        {section.make([&] { return PrescribedWorkspace(name, shape, placement); }), kind, source, certainty});
  }
  return workspaces;
}

}  // namespace reprise::experiments
