#include "reprise/study/problem_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/io/toml_reader.hpp"
#include "reprise/study/shape_reader.hpp"

namespace reprise {

namespace {

const NumberRange coordinate = NumberRange::between(-largest_length, largest_length);
const NumberRange length = NumberRange::between(0.0, largest_length);
const NumberRange positive_length = NumberRange::positive(largest_length);
const NumberRange angle = NumberRange::between(-720.0, 720.0);

/// Polygons are checked edge against edge.
constexpr std::size_t most_vertices = 1000;
constexpr std::size_t most_legs = 100;
constexpr std::size_t most_slices = 100;

constexpr std::size_t longest_name = 100;
constexpr std::size_t longest_unit = 20;
constexpr std::size_t longest_remark = 1000;

/// A text that can stand in titles, labels and messages.
std::string read_label(const TomlSection& section, const std::string& key, std::size_t longest) {
  const std::string label = section.text(key);
  const bool plain =
      std::none_of(label.begin(), label.end(), [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; });
  if (label.empty() || label.size() > longest || !plain) {
    section.reject(key, fmt::format("a text of 1 to {} bytes on one line", longest));
  }
  return label;
}

Eigen::Vector2d read_point(const TomlSection& section, const std::string& key) {
  const std::vector<double> values = section.numbers(key, 2, coordinate);
  return {values[0], values[1]};
}

constexpr const char* length_limits = "[minimum, maximum] with 0 <= minimum <= maximum and maximum above 0";

bool are_length_limits(double minimum, double maximum) { return minimum <= maximum && maximum > 0.0; }

/// Limits of a joint angle, in degrees, as an interval in radians.
std::optional<Interval> read_angle_limits(const TomlSection& section, const std::string& key) {
  if (!section.has(key)) return std::nullopt;
  const std::vector<double> limits = section.numbers(key, 2, angle);
  const double width = limits[1] - limits[0];
  if (!(width > 0.0 && width < 360.0)) {
    section.reject(key, "[lower, upper], degrees, with upper above lower by less than a full turn");
  }
  return Interval{limits[0] * degree, limits[1] * degree};
}

Leg read_leg(const TomlSection& section) {
  section.allow_only({"base", "platform", "length", "base_angle_deg", "platform_angle_deg"});
  Leg leg{.base_joint = read_point(section, "base"),
          .platform_joint = read_point(section, "platform"),
          .length = {},
          .base_angle = read_angle_limits(section, "base_angle_deg"),
          .platform_angle = read_angle_limits(section, "platform_angle_deg")};
  const std::vector<double> limits = section.numbers("length", 2, length);
  if (!are_length_limits(limits[0], limits[1])) section.reject("length", length_limits);
  leg.length = {limits[0], limits[1]};
  return leg;
}

Conditioning read_conditioning(const TomlSection& section) {
  Conditioning conditioning;
  const std::string normalisation = section.text_or("normalisation", "homogeneous");
  if (normalisation == "printed") {
    conditioning.normalisation = Normalisation::printed;
  } else if (normalisation != "homogeneous") {
    section.reject("normalisation", "'homogeneous' or 'printed'");
  }
  if (section.has("characteristic_length")) {
    conditioning.characteristic_length = section.number("characteristic_length", positive_length);
  }
  return conditioning;
}

ManipulatorInput read_manipulator_section(const TomlSection& section) {
  section.allow_only({"name", "unit", "normalisation", "characteristic_length", "leg", "design", "length"});
  const std::string name = read_label(section, "name", longest_name);
  const std::string unit = section.has("unit") ? read_label(section, "unit", longest_unit) : "";
  // Tables have it in brackets.
  if (unit.find_first_of("[]") != std::string::npos) section.reject("unit", "a text without brackets");
  const Conditioning conditioning = read_conditioning(section);
  if (section.has("leg")) {
    for (const char* key : {"design", "length"}) {
      if (section.has(key)) {
        section.fail(section.need(key),
                     fmt::format("both manipulator.{} and manipulator.leg are given, but a manipulator is given either "
                                 "by its legs or by design and length.",
                                 key));
      }
    }
    std::vector<Leg> legs;
    for (const TomlSection& leg : section.sections("leg")) legs.push_back(read_leg(leg));
    if (legs.size() < 2 || legs.size() > most_legs) {
      section.fail(section.need("leg"),
                   fmt::format("the manipulator has {}, but the number of legs must be from 2 to {}.",
                               counted(legs.size(), "leg"), most_legs));
    }
    return {section.make([&] { return Manipulator(name, legs); }), conditioning, false, unit};
  }
  if (!section.has("design")) {
    section.fail(section.table(), "manipulator has neither a key 'design' nor tables [[manipulator.leg]].");
  }
  const std::vector<double> d = section.numbers("design", 5, coordinate);
  const std::vector<std::array<double, 2>> lengths = section.pairs("length", 3, length);
  std::array<Interval, 3> limits{};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    limits[leg] = {lengths[leg][0], lengths[leg][1]};
    if (!are_length_limits(limits[leg].lower, limits[leg].upper)) {
      section.reject("length", fmt::format("three times {}; the one of leg {} is [{}, {}]", length_limits, leg + 1,
                                           limits[leg].lower, limits[leg].upper));
    }
  }
  return {section.make([&] {
            return make_manipulator({d[0], d[1], d[2], d[3], d[4]}, limits, name);
          }),
          conditioning, true, unit};
}

/// Whether two edges that share no vertex meet.
bool edges_cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                 const Eigen::Vector2d& d) {
  const auto side = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& point) {
    const double value = cross(to - from, point - from);
    return (value > 0.0) - (value < 0.0);
  };
  const auto overlap = [](double p, double q, double r, double s) {
    return std::max(std::min(p, q), std::min(r, s)) <= std::min(std::max(p, q), std::max(r, s));
  };
  return overlap(a.x(), b.x(), c.x(), d.x()) && overlap(a.y(), b.y(), c.y(), d.y()) &&
         side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

void check_polygon(const TomlSection& section, const std::vector<Eigen::Vector2d>& vertices) {
  const std::size_t n = vertices.size();
  if (n < 3 || n > most_vertices) {
    section.reject("vertices", fmt::format("a list of 3 to {} points; there are {}", most_vertices, n));
  }
  const auto vertex = [&](std::size_t i) -> const Eigen::Vector2d& { return vertices[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (vertex(i) == vertex(i + 1)) {
      section.reject("vertices",
                     fmt::format("a list without repeats; vertices {} and {} are the same", i + 1, (i + 1) % n + 1));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // these share a vertex
      if (edges_cross(vertex(i), vertex(i + 1), vertex(j), vertex(j + 1))) {
        section.reject("vertices",
                       fmt::format("the corners of a polygon that does not cross itself; its edges from vertex {} "
                                   "and from vertex {} meet",
                                   i + 1, j + 1));
      }
    }
  }
}

/// The centre of the area within a polygon.
Eigen::Vector2d centroid(const std::vector<Eigen::Vector2d>& vertices) {
  const Eigen::Vector2d origin = vertices.front();
  double area = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector2d a = vertices[i] - origin;
    const Eigen::Vector2d b = vertices[(i + 1) % vertices.size()] - origin;
    area += cross(a, b);
    moment += cross(a, b) * (a + b) / 3.0;
  }
  return origin + moment / area;
}

/// A table of a file, and perhaps of the other file that its key `file` names.
struct SharedTable {
  toml::table content;  ///< of the other file
  std::filesystem::path file;

  /// The table of the same name there, which may not name a third file. Throws InputError.
  TomlSection section(const std::string& name) const {
    const TomlSection found = TomlSection(file, content).section(name);
    if (found.has("file")) {
      found.fail(found.need("file"), fmt::format("{0}.file is given in a file that another one takes its {0} from; the "
                                                 "other file must name this one.",
                                                 name));
    }
    return found;
  }
};

/// The file that a table takes what it does not say itself from, seen from the folder of its own file.
SharedTable read_shared(const TomlSection& section) {
  const std::filesystem::path file = section.file().parent_path() / section.text("file");
  return {parse_toml(file), file};
}

/// Where a shape goes: what the first of the sections says, and of the rest what the second one says.
Placement read_placement(const TomlSection& own, const TomlSection& shared) {
  const auto said_by = [&](const char* key) -> const TomlSection& { return own.has(key) ? own : shared; };
  return {.centre = {0.0, 0.0},
          .scale = said_by("scale").number_or("scale", 1.0, positive_length),
          .rotation = said_by("rotation_deg").number_or("rotation_deg", 0.0, angle) * degree};
}

struct WorkspaceInput {
  PrescribedWorkspace workspace;
  OutlineOrigin origin;
};

/// The shape is that of `section`; name, centre, scale and rotation are those of `own` where it says them.
WorkspaceInput read_workspace(const TomlSection& section, const TomlSection& own) {
  std::vector<std::string> keys = shape_keys(section);
  keys.insert(keys.end(), {"name", "centre", "scale", "rotation_deg", "source", "certainty"});
  section.allow_only(keys);
  const TomlSection& named = own.has("name") ? own : section;
  const std::string name =
      named.has("name") ? read_label(named, "name", longest_name) : std::string("prescribed workspace");
  const auto remark = [&](const char* key) { return section.has(key) ? read_label(section, key, longest_remark) : ""; };
  OutlineOrigin origin{section.text("kind"), remark("source"), remark("certainty")};
  Shape shape = read_shape(section);
  Placement placement = read_placement(own, section);
  auto* const polygon = std::get_if<Polygon>(&shape);
  if (polygon != nullptr) check_polygon(section, polygon->vertices);
  if (polygon != nullptr && !section.has("centre")) {
    placement.centre = centroid(polygon->vertices);
    for (Eigen::Vector2d& vertex : polygon->vertices) vertex -= placement.centre;
  }
  const TomlSection& centred = own.has("centre") ? own : section;
  if (polygon == nullptr || centred.has("centre")) placement.centre = read_point(centred, "centre");
  PrescribedWorkspace workspace = section.make([&] { return PrescribedWorkspace(name, shape, placement); });
  double smallest = infinity;
  double largest = 0.0;
  std::vector<double> directions = workspace.corners();
  for (int k = 0; k < 720; ++k) directions.push_back(0.5 * k * degree);
  for (const double beta : directions) {
    const double radius = workspace.radius(beta);
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  constexpr double thinnest = 1e-6;
  if (!(smallest >= thinnest * largest && largest <= largest_length)) {
    section.fail(
        section.table(),
        fmt::format("the outline of the workspace is between {} and {} away from its centre, but these distances "
                    "must be at most {}, and the largest at most {} times the smallest.",
                    smallest, largest, largest_length, 1.0 / thinnest));
  }
  return {std::move(workspace), std::move(origin)};
}

WorkspaceInput read_workspace(const TomlSection& section) {
  if (!section.has("file")) return read_workspace(section, section);
  section.allow_only({"file", "name", "centre", "scale", "rotation_deg"});
  const SharedTable shared = read_shared(section);
  return read_workspace(shared.section("workspace"), section);
}

ManipulatorInput read_manipulator_or_shared(const TomlSection& section) {
  if (!section.has("file")) return read_manipulator_section(section);
  section.allow_only({"file"});
  const SharedTable shared = read_shared(section);
  return read_manipulator_section(shared.section("manipulator"));
}

std::vector<OrientationRange> read_orientations(const TomlSection& section) {
  section.allow_only({"slices_deg", "range_deg"});
  const NumberRange turn = NumberRange::between(-360.0, 360.0);
  if (section.has("slices_deg") == section.has("range_deg")) {
    section.fail(section.table(), "orientations must have either a key 'slices_deg' or a key 'range_deg'.");
  }
  std::vector<OrientationRange> ranges;
  if (section.has("slices_deg")) {
    std::vector<double> slices_deg = section.numbers("slices_deg", 0, turn);
    if (slices_deg.empty() || slices_deg.size() > most_slices) {
      section.reject("slices_deg", fmt::format("a list of 1 to {} orientations, degrees", most_slices));
    }
    for (const double slice : slices_deg) ranges.push_back({slice * degree, slice * degree});
    std::sort(slices_deg.begin(), slices_deg.end());
    if (std::adjacent_find(slices_deg.begin(), slices_deg.end()) != slices_deg.end()) {
      section.reject("slices_deg", "a list without repeats");
    }
  } else {
    const std::vector<double> range = section.numbers("range_deg", 2, turn);
    if (!(range[0] < range[1] && range[1] - range[0] < 360.0)) {
      section.reject("range_deg", "[lower, upper], degrees, with upper above lower by less than a full turn");
    }
    ranges.push_back({range[0] * degree, range[1] * degree});
  }
  return ranges;
}

/// A number that a design may vary.
struct Variable {
  enum class Kind { base, platform, minimum_length, maximum_length, both_lengths };

  std::string name;
  Kind kind;
  std::size_t leg = 0;  ///< of the lengths, and of the joints of general manipulators
  double value = 0.0;
  Eigen::VectorXd joints;   ///< how the 4 n joint coordinates change with it
  Eigen::VectorXd lengths;  ///< how the 2 n length limits change with it

  bool is_length() const { return kind != Kind::base && kind != Kind::platform; }
};

/// All numbers of a manipulator that a design may vary, in their order.
std::vector<Variable> variables_of(const ManipulatorInput& input) {
  const Manipulator& manipulator = input.manipulator;
  const auto n = static_cast<Eigen::Index>(manipulator.size());
  std::vector<Variable> all;
  const auto add = [&](const std::string& name, Variable::Kind kind, std::size_t leg, double value) -> Variable& {
    all.push_back({name, kind, leg, value, Eigen::VectorXd::Zero(4 * n), Eigen::VectorXd::Zero(2 * n)});
    return all.back();
  };
  if (input.as_design) {
    const std::array<const char*, 5> names{"x_C", "y_C", "x_D", "x_E", "r"};
    const auto d = to_vector(*collinear_design(manipulator));
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      add(names[k], k < 4 ? Variable::Kind::base : Variable::Kind::platform, 0, d[column]).joints =
          collinear_design_map().col(column);
    }
  }
  for (std::size_t i = 0; i < manipulator.size(); ++i) {
    const Leg& leg = manipulator.leg(i);
    const auto row = static_cast<Eigen::Index>(i);
    if (!input.as_design) {
      const std::array<double, 4> values{leg.base_joint.x(), leg.base_joint.y(), leg.platform_joint.x(),
                                         leg.platform_joint.y()};
      const std::array<const char*, 4> names{"base_{}_x", "base_{}_y", "platform_{}_x", "platform_{}_y"};
      for (std::size_t k = 0; k < 4; ++k) {
        add(fmt::format(fmt::runtime(names[k]), i + 1), k < 2 ? Variable::Kind::base : Variable::Kind::platform, i,
            values[k])
            .joints[4 * row + static_cast<Eigen::Index>(k)] = 1.0;
      }
    }
    add(fmt::format("length_{}_min", i + 1), Variable::Kind::minimum_length, i, leg.length.lower).lengths[2 * row] =
        1.0;
    add(fmt::format("length_{}_max", i + 1), Variable::Kind::maximum_length, i, leg.length.upper).lengths[2 * row + 1] =
        1.0;
    add(fmt::format("length_{}", i + 1), Variable::Kind::both_lengths, i, leg.length.lower)
        .lengths.segment<2>(2 * row)
        .setOnes();
  }
  return all;
}

/// The names of single variables that a word of `free` stands for; empty for none.
std::set<std::string> expand(const std::string& word, const std::vector<Variable>& all) {
  std::set<std::string> names;
  for (const Variable& variable : all) {
    const bool in_group =
        (word == "base" && variable.kind == Variable::Kind::base) ||
        (word == "platform" && variable.kind == Variable::Kind::platform) ||
        (!variable.is_length() && variable.name.size() == word.size() + 2 && variable.name.starts_with(word) &&
         (variable.name.ends_with("_x") || variable.name.ends_with("_y")));
    if (variable.name == word || in_group) names.insert(variable.name);
  }
  return names;
}

/// What is free, and its bounds.
struct FreeVariables {
  std::vector<Variable> variables;
  Eigen::VectorXd lower, upper;
};

/// The legs' length limits, when they are free, must stay in their order and above zero whatever the optimizer tries.
void check_length_bounds(const TomlSection& section, const toml::node& node, const Manipulator& manipulator,
                         const FreeVariables& free) {
  struct LengthBounds {
    double highest_minimum, lowest_maximum;
    bool together = false, alone = false;
  };
  std::vector<LengthBounds> legs;
  for (const Leg& leg : manipulator.legs()) legs.push_back({leg.length.lower, leg.length.upper});
  for (std::size_t k = 0; k < free.variables.size(); ++k) {
    const Variable& variable = free.variables[k];
    if (!variable.is_length()) continue;
    const double lower = free.lower[static_cast<Eigen::Index>(k)];
    const double upper = free.upper[static_cast<Eigen::Index>(k)];
    if (!std::isfinite(lower) || !std::isfinite(upper)) {
      section.fail(
          node, fmt::format("design.bounds has no key '{}', but a length that is free needs bounds.", variable.name));
    }
    if (!(lower > 0.0)) {
      section.fail(node, fmt::format("the lower bound of {} is {}, but that of a length must be above 0.",
                                     variable.name, lower));
    }
    LengthBounds& leg = legs[variable.leg];
    (variable.kind == Variable::Kind::both_lengths ? leg.together : leg.alone) = true;
    if (variable.kind == Variable::Kind::minimum_length) leg.highest_minimum = upper;
    if (variable.kind == Variable::Kind::maximum_length) leg.lowest_maximum = lower;
  }
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (legs[i].together && legs[i].alone) {
      section.fail(
          node, fmt::format("length_{0} moves both limits of leg {0}, so neither limit can be free as well.", i + 1));
    }
    if (!(legs[i].highest_minimum <= legs[i].lowest_maximum)) {
      section.fail(node, fmt::format("the minimum length of leg {} may become {}, but it must not exceed the maximum "
                                     "length, which may become {}.",
                                     i + 1, legs[i].highest_minimum, legs[i].lowest_maximum));
    }
  }
}

FreeVariables read_design(const TomlSection& section, const ManipulatorInput& input) {
  section.allow_only({"free", "within", "bounds"});
  const std::vector<Variable> all = variables_of(input);
  const auto fail_unknown = [&](const toml::node& node, const std::string& word) {
    std::vector<std::string> names{"base", "platform"};
    for (const Variable& variable : all) names.push_back(variable.name);
    const std::string suggestion = did_you_mean(word, names);
    section.fail(node,
                 fmt::format("'{}' is not a design variable of this manipulator ({}).", word,
                             suggestion.empty() ? fmt::format("these are {}", fmt::join(names, ", ")) : suggestion));
  };
  std::set<std::string> chosen;
  for (const std::string& word : section.texts("free")) {
    const std::set<std::string> names = expand(word, all);
    if (names.empty()) fail_unknown(section.need("free"), word);
    for (const std::string& name : names) {
      if (!chosen.insert(name).second) {
        section.fail(section.need("free"), fmt::format("design.free names the variable {} twice.", name));
      }
    }
  }
  if (chosen.empty()) section.reject("free", "a list of at least one design variable");
  FreeVariables free;
  std::copy_if(all.begin(), all.end(), std::back_inserter(free.variables),
               [&](const Variable& variable) { return chosen.contains(variable.name); });
  const auto k = static_cast<Eigen::Index>(free.variables.size());
  free.lower = Eigen::VectorXd::Constant(k, -infinity);
  free.upper = Eigen::VectorXd::Constant(k, infinity);
  if (section.has("within")) {
    const double within = section.number("within", positive_length);
    for (Eigen::Index i = 0; i < k; ++i) {
      const Variable& variable = free.variables[static_cast<std::size_t>(i)];
      if (variable.is_length()) continue;
      free.lower[i] = variable.value - within;
      free.upper[i] = variable.value + within;
    }
  }
  const toml::node* bounds_node = &section.table();
  if (section.has("bounds")) {
    const TomlSection bounds = section.section("bounds");
    bounds_node = &bounds.table();
    for (const auto& [key, node] : bounds.table()) {
      const std::string name(key.str());
      const auto found = std::find_if(free.variables.begin(), free.variables.end(),
                                      [&](const Variable& variable) { return variable.name == name; });
      if (found == free.variables.end()) {
        if (expand(name, all).empty()) fail_unknown(node, name);
        section.fail(node, fmt::format("design.bounds.{} has no effect, because the variable is not free.", name));
      }
      const std::vector<double> values = bounds.numbers(name, 2, coordinate);
      if (!(values[0] <= values[1])) bounds.reject(name, "[lower, upper] with lower at most upper");
      if (!(values[0] <= found->value && found->value <= values[1])) {
        bounds.reject(name, fmt::format("bounds with the manipulator's own {} between them", found->value));
      }
      const auto i = found - free.variables.begin();
      free.lower[i] = values[0];
      free.upper[i] = values[1];
    }
  }
  check_length_bounds(section, *bounds_node, input.manipulator, free);
  return free;
}

DesignSpace make_designs(const ManipulatorInput& input, const FreeVariables& free, const Eigen::VectorXd& start) {
  const auto n = static_cast<Eigen::Index>(input.manipulator.size());
  const auto k = static_cast<Eigen::Index>(free.variables.size());
  Eigen::MatrixXd joints(4 * n, k);
  Eigen::MatrixXd lengths(2 * n, k);
  std::vector<std::string> names;
  for (Eigen::Index j = 0; j < k; ++j) {
    const Variable& variable = free.variables[static_cast<std::size_t>(j)];
    names.push_back(variable.name);
    joints.col(j) = variable.joints;
    lengths.col(j) = variable.lengths;
  }
  return {input.manipulator, names, joints, lengths, free.lower, free.upper, start};
}

FileInput read(const toml::table& content, const std::filesystem::path& file, bool needs_problem) {
  const TomlSection root(file, content);
  root.allow_only({"manipulator", "workspace", "orientations", "design"});
  FileInput input{read_manipulator_or_shared(root.section("manipulator")), std::nullopt};
  if (needs_problem || root.has("workspace") || root.has("orientations") || root.has("design")) {
    WorkspaceInput prescribed = read_workspace(root.section("workspace"));
    std::vector<OrientationRange> orientations = read_orientations(root.section("orientations"));
    FreeVariables free;
    if (root.has("design")) {
      free = read_design(root.section("design"), input.manipulator);
    } else if (input.manipulator.as_design) {
      const toml::table standard{{"free", toml::array{"base", "platform"}}};
      free = read_design(TomlSection(file, standard, "design"), input.manipulator);
    } else {
      root.fail(content, "the file has no table [design], which says what of the manipulator is free.");
    }
    Eigen::VectorXd start(static_cast<Eigen::Index>(free.variables.size()));
    for (Eigen::Index i = 0; i < start.size(); ++i) start[i] = free.variables[static_cast<std::size_t>(i)].value;
    const SynthesisTask task{std::move(prescribed.workspace), std::move(orientations),
                             make_designs(input.manipulator, free, start), input.manipulator.conditioning};
    input.problem = ProblemInput{input.manipulator, task, start, std::move(prescribed.origin)};
  }
  return input;
}

/// A text in double quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

}  // namespace

FileInput read_input(const std::filesystem::path& file) { return read(parse_toml(file), file, false); }

ManipulatorInput read_manipulator(const std::filesystem::path& file) {
  return read_manipulator(parse_toml(file), file);
}

ProblemInput read_problem(const std::filesystem::path& file) { return read_problem(parse_toml(file), file); }

ManipulatorInput read_manipulator(const toml::table& tables, const std::filesystem::path& file) {
  return read(tables, file, false).manipulator;
}

ProblemInput read_problem(const toml::table& tables, const std::filesystem::path& file) {
  return *read(tables, file, true).problem;
}

std::string to_toml(const ManipulatorInput& input) {
  const Manipulator& manipulator = input.manipulator;
  std::string text = fmt::format("[manipulator]\nname = {}\n", quoted(manipulator.name()));
  if (!input.unit.empty()) text += fmt::format("unit = {}\n", quoted(input.unit));
  text += fmt::format("normalisation = \"{}\"\n",
                      input.conditioning.normalisation == Normalisation::printed ? "printed" : "homogeneous");
  if (input.conditioning.characteristic_length) {
    text += fmt::format("characteristic_length = {}\n", *input.conditioning.characteristic_length);
  }
  if (const auto design = collinear_design(manipulator); input.as_design && design) {
    const auto d = to_vector(*design);
    text += fmt::format("design = [{}] # x_C, y_C, x_D, x_E, r\n", fmt::join(d.begin(), d.end(), ", "));
    std::vector<std::string> lengths;
    for (const Leg& leg : manipulator.legs())
      lengths.push_back(fmt::format("[{}, {}]", leg.length.lower, leg.length.upper));
    return text + fmt::format("length = [{}]\n", fmt::join(lengths, ", "));
  }
  for (const Leg& leg : manipulator.legs()) {
    text += fmt::format("\n[[manipulator.leg]]\nbase = [{}, {}]\nplatform = [{}, {}]\nlength = [{}, {}]\n",
                        leg.base_joint.x(), leg.base_joint.y(), leg.platform_joint.x(), leg.platform_joint.y(),
                        leg.length.lower, leg.length.upper);
    const auto limits = [&](const char* key, const std::optional<Interval>& interval) {
      if (interval) text += fmt::format("{} = [{}, {}]\n", key, interval->lower / degree, interval->upper / degree);
    };
    limits("base_angle_deg", leg.base_angle);
    limits("platform_angle_deg", leg.platform_angle);
  }
  return text;
}

}  // namespace reprise
