#include "chapter/data_files.hpp"

#include <numbers>

#include "reprise/io/toml_reader.hpp"
#include "reprise/study/shape_reader.hpp"

namespace reprise::experiments {

namespace {

double read_scale(const TomlSection& section, const std::string& synthesis) {
  if (!section.has("scaled_down_by")) return section.number_or("scale", 1.0);
  if (section.has("scale")) {
    section.fail(section.need("scale"), "both scale and scaled_down_by are given, but only one of them is allowed.");
  }
  const TomlSection divisors = section.section("scaled_down_by");
  return 1.0 / divisors.number(synthesis, NumberRange::positive());
}

}  // namespace

CollinearManipulator read_manipulator(const std::filesystem::path& path, const std::string& name) {
  const toml::table file = parse_toml(path);
  const TomlSection section = TomlSection(path, file).section("manipulators").section(name);
  section.allow_only({"design", "length"});
  const std::vector<double> d = section.numbers("design", 5);
  const std::vector<std::array<double, 2>> lengths = section.pairs("length", 3);

  CollinearManipulator manipulator{name, {d[0], d[1], d[2], d[3], d[4]}, {}};
  for (std::size_t leg = 0; leg < 3; ++leg) manipulator.lengths[leg] = {lengths[leg][0], lengths[leg][1]};
  section.make([&] { return make_manipulator(manipulator.design, manipulator.lengths, name); });
  return manipulator;
}

std::vector<SourcedWorkspace> read_prescribed_workspaces(const std::filesystem::path& path,
                                                         const std::string& synthesis) {
  const toml::table file = parse_toml(path);
  const TomlSection all = TomlSection(path, file).section("workspaces");
  std::vector<SourcedWorkspace> workspaces;
  for (const auto& [key, node] : all.table()) {
    const std::string name(key.str());
    const TomlSection section = all.section(name);
    std::vector<std::string> keys = shape_keys(section);
    keys.insert(keys.end(), {"centre", "scale", "scaled_down_by", "rotation_deg", "source", "certainty"});
    section.allow_only(keys);
    const Shape shape = read_shape(section);
    const std::vector<double> centre = section.numbers("centre", 2);
    const Placement placement{{centre[0], centre[1]},
                              read_scale(section, synthesis),
                              section.number_or("rotation_deg", 0.0) * std::numbers::pi / 180.0};
    const std::string source = section.text_or("source", "");
    const std::string certainty = section.text_or("certainty", "");
    workspaces.push_back({section.make([&] { return PrescribedWorkspace(name, shape, placement); }),
                          section.text("kind"), source, certainty});
  }
  return workspaces;
}

}  // namespace reprise::experiments
