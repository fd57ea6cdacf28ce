#include "support/data_files.hpp"

#include <numbers>

#include "support/toml_reader.hpp"

namespace reprise::experiments {

namespace {

double read_scale(TomlSection& section, const std::string& synthesis) {
  if (!section.has("scaled_down_by")) return section.number_or("scale", 1.0);
  if (section.has("scale")) {
    section.fail(section.need("scale"), "scale and scaled_down_by are given both, but only one of them is allowed.");
  }
  TomlSection divisors = section.section("scaled_down_by");
  return 1.0 / divisors.number(synthesis, NumberRange::positive());
}

}  // namespace

CollinearManipulator read_manipulator(const std::filesystem::path& path, const std::string& name) {
  const toml::table file = parse_toml(path);
  TomlSection root(path, file);
  TomlSection section = root.section("manipulators").section(name);
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
  const toml::table file = parse_toml(path);
  TomlSection root(path, file);
  TomlSection all = root.section("workspaces");
  std::vector<SourcedWorkspace> workspaces;
  for (const auto& [key, node] : all.table()) {
    const std::string name(key.str());
    TomlSection section = all.section(name);
    const Shape shape = read_shape(section);
    const std::vector<double> centre = section.numbers("centre", 2);
    const Placement placement{{centre[0], centre[1]},
                              read_scale(section, synthesis),
                              section.number_or("rotation_deg", 0.0) * std::numbers::pi / 180.0};
    const std::string source = section.text_or("source", "");
    const std::string certainty = section.text_or("certainty", "");
    section.reject_unknown_keys();
    workspaces.push_back({section.make([&] { return PrescribedWorkspace(name, shape, placement); }),
                          section.text("kind"), source, certainty});
  }
  return workspaces;
}

}  // namespace reprise::experiments
