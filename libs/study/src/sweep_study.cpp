#include "reprise/study/sweep_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cctype>
#include <cmath>

#include "reprise/io/expression.hpp"
#include "reprise/io/toml_reader.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise {

namespace {

constexpr std::size_t most_axes = 10;
constexpr std::size_t most_values = 1'000'000;

const NumberRange count_range = NumberRange::between(1.0, static_cast<double>(most_sweep_points));

/// A whole number.
std::size_t read_count(const TomlSection& section, const std::string& key, const NumberRange& range) {
  const double count = section.number(key, range);
  if (count != std::floor(count)) section.reject(key, "a whole number");
  return static_cast<std::size_t>(count);
}

/// A key without the sign before it.
std::string path_of(const std::string& key) { return key.starts_with('-') ? key.substr(1) : key; }

/// Throws where a problem has no number at a path.
void check_path(const TomlSection& axis, const std::string& key, const SweepStudy& study) {
  const std::string path = path_of(key);
  const auto fail = [&](const std::string& why) {
    axis.fail(axis.table(), fmt::format("{} is '{}', but {} {}.", axis.name(), key, study.problem_file.string(), why));
  };
  const auto found = toml::at_path(study.problem, path);
  const std::string top = path.substr(0, path.find('.'));
  if (!found) {
    const bool elsewhere = study.problem[top]["file"].is_string();
    fail(elsewhere ? fmt::format("takes its {} from another file: write it out there to vary it", top)
                   : "has nothing of that name; a path is written as in 'manipulator.leg[0].length[1]'");
  }
  const auto text = found.value_exact<std::string>();
  if (!found.is_number() && !(text && evaluate(*text).value)) fail("has no number there");
}

/// The name of a column that is made from a key.
std::string column_name(const std::string& key) {
  std::string name;
  for (const char c : path_of(key)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (name.ends_with('_')) name.pop_back();
  return name;
}

std::vector<double> range_values(double from, double to, std::size_t count, bool logarithmic) {
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double part = count == 1 ? 0.0 : static_cast<double>(k) / static_cast<double>(count - 1);
    values[k] = logarithmic ? from * std::pow(to / from, part) : from + part * (to - from);
  }
  if (count > 1) values.back() = to;
  return values;
}

SweepAxis read_axis(const TomlSection& section, const SweepStudy& study) {
  section.allow_only({"key", "keys", "name", "values", "from", "to", "count", "spacing"});
  SweepAxis axis;
  if (section.has("key") == section.has("keys")) {
    section.fail(section.table(), fmt::format("{} must have either 'key' or 'keys'.", section.name()));
  }
  axis.keys = section.has("key") ? std::vector<std::string>{section.text("key")} : section.texts("keys");
  if (axis.keys.empty()) section.reject("keys", "a list of at least one path");
  for (const std::string& key : axis.keys) check_path(section, key, study);
  axis.name = section.text_or("name", column_name(axis.keys.front()));
  const bool proper =
      !axis.name.empty() && std::isalpha(static_cast<unsigned char>(axis.name.front())) != 0 &&
      std::all_of(axis.name.begin(), axis.name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (!proper) section.reject("name", "a letter, then letters, digits and underscores");
  const std::string spacing = section.text_or("spacing", "linear");
  if (spacing != "linear" && spacing != "logarithmic") section.reject("spacing", "'linear' or 'logarithmic'");
  axis.logarithmic = spacing == "logarithmic";
  if (section.has("values")) {
    if (study.sample) {
      section.fail(section.need("values"),
                   fmt::format("{} has 'values', but a sample needs 'from' and 'to'.", section.name()));
    }
    for (const char* key : {"from", "to", "count", "spacing"}) {
      if (section.has(key)) {
        section.fail(section.need(key), fmt::format("{} has both 'values' and '{}'.", section.name(), key));
      }
    }
    axis.values = section.numbers("values");
    if (axis.values.empty() || axis.values.size() > most_values) {
      section.reject("values", fmt::format("a list of 1 to {} numbers", most_values));
    }
    return axis;
  }
  const double from = section.number("from");
  const double to = section.number("to");
  if (axis.logarithmic && !(from > 0.0)) section.reject("from", "above 0, since the spacing is logarithmic");
  if (!(to > from)) section.reject("to", fmt::format("above 'from', which is {}", from));
  if (study.sample) {
    if (section.has("count")) {
      section.fail(
          section.need("count"),
          fmt::format("{} has 'count', but a sample has its number of points in sweep.sample.", section.name()));
    }
    axis.values = {from, to};
  } else {
    const std::size_t count = read_count(section, "count", NumberRange::between(2.0, most_values));
    axis.values = range_values(from, to, count, axis.logarithmic);
  }
  return axis;
}

SweepKind read_kind(const TomlSection& section) {
  const std::string kind = section.text("compute");
  if (kind == "pose") return SweepKind::pose;
  if (kind == "workspace") return SweepKind::workspace;
  if (kind == "dextrous") return SweepKind::dextrous;
  if (kind != "synthesize") section.reject("compute", "'pose', 'workspace', 'dextrous' or 'synthesize'");
  return SweepKind::synthesis;
}

/// The keys of [sweep] that a kind has of its own.
std::vector<std::string> own_keys(SweepKind kind) {
  switch (kind) {
    case SweepKind::pose:
      return {"at", "orientation_deg"};
    case SweepKind::workspace:
      return {"orientation_deg"};
    case SweepKind::dextrous:
      return {"range_deg"};
    case SweepKind::synthesis:
      break;
  }
  return {};
}

}  // namespace

std::size_t SweepStudy::size() const {
  if (sample) return *sample;
  std::size_t size = 1;
  for (const SweepAxis& axis : axes) size *= axis.values.size();
  return size;
}

std::vector<double> SweepStudy::point(std::size_t index) const {
  std::vector<double> values(axes.size());
  if (sample) {
    boost::random::sobol sequence(axes.size());
    // Its first point is a corner of the box.
    sequence.seed(index + 1);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const double part = std::ldexp(static_cast<double>(sequence()), -64);
      const double from = axes[k].values.front();
      const double to = axes[k].values.back();
      values[k] = axes[k].logarithmic ? from * std::pow(to / from, part) : from + part * (to - from);
    }
    return values;
  }
  for (std::size_t k = axes.size(); k-- > 0;) {
    values[k] = axes[k].values[index % axes[k].values.size()];
    index /= axes[k].values.size();
  }
  return values;
}

toml::table SweepStudy::problem_at(const std::vector<double>& values) const {
  toml::table tables = problem;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    for (const std::string& key : axes[k].keys) {
      const auto node = toml::at_path(tables, path_of(key));
      const double value = key.starts_with('-') ? -values[k] : values[k];
      // A number that was a whole one, or a text, becomes another kind of node.
      const std::string path = path_of(key);
      const std::size_t end = path.find_last_of(".[");
      const auto parent = toml::at_path(tables, path.substr(0, end));
      if (node.is_floating_point()) {
        *node.as_floating_point() = value;
      } else if (toml::array* array = parent.as_array()) {
        array->replace(array->cbegin() + std::stol(path.substr(end + 1)), value);
      } else if (toml::table* table = parent.as_table()) {
        table->insert_or_assign(path.substr(end + 1), value);
      }
    }
  }
  return tables;
}

SweepStudy read_study(const std::filesystem::path& file) {
  const toml::table content = parse_toml(file);
  const TomlSection root(file, content);
  root.allow_only({"sweep", "vary"});
  const TomlSection sweep = root.section("sweep");
  SweepStudy study;
  study.file = file;
  study.kind = read_kind(sweep);
  std::vector<std::string> keys = own_keys(study.kind);
  keys.insert(keys.end(), {"problem", "compute", "sample"});
  sweep.allow_only(keys);
  study.problem_file = file.parent_path() / sweep.text("problem");
  study.problem = parse_toml(study.problem_file);
  if (study.kind == SweepKind::synthesis) {
    read_problem(study.problem, study.problem_file);
  } else {
    read_manipulator(study.problem, study.problem_file);
  }
  const NumberRange orientation = NumberRange::between(-1e6, 1e6);
  if (study.kind == SweepKind::pose) {
    const std::vector<double> at = sweep.numbers("at", 2, NumberRange::between(-largest_length, largest_length));
    study.position = {at[0], at[1]};
  }
  if (study.kind == SweepKind::pose || study.kind == SweepKind::workspace) {
    study.orientation_deg = sweep.number_or("orientation_deg", 0.0, orientation);
  }
  if (study.kind == SweepKind::dextrous) {
    const std::vector<double> range = sweep.numbers("range_deg", 2, orientation);
    if (!(range[0] <= range[1] && range[1] - range[0] < 360.0)) {
      sweep.reject("range_deg", "[lower, upper], degrees, with upper not below lower and less than a full turn above");
    }
    study.range_deg = {range[0], range[1]};
  }
  if (sweep.has("sample")) study.sample = read_count(sweep, "sample", count_range);
  const std::vector<TomlSection> axes = root.sections("vary");
  if (axes.empty() || axes.size() > most_axes) {
    root.fail(content, fmt::format("{} of the problem vary, but 1 to {} must.", axes.size(), most_axes));
  }
  double points = 1.0;
  for (const TomlSection& section : axes) {
    study.axes.push_back(read_axis(section, study));
    points *= static_cast<double>(study.axes.back().values.size());
    for (std::size_t k = 0; k + 1 < study.axes.size(); ++k) {
      if (study.axes[k].name == study.axes.back().name) {
        section.fail(section.table(), fmt::format("two numbers that vary have the name '{}'; a key 'name' gives "
                                                  "another one.",
                                                  study.axes[k].name));
      }
    }
  }
  if (!study.sample && points > static_cast<double>(most_sweep_points)) {
    root.fail(content, fmt::format("the study has {} points, but at most {} are allowed.", points, most_sweep_points));
  }
  return study;
}

}  // namespace reprise
