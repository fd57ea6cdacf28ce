// Table 5.1: the designs M1 to M3, as the programs use them and as printed, with what they can reach at phi = 0.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "frame/source_tree.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/workspace/exact_workspace.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

Table make_table(const Eigen::Vector2d& centre) {
  std::vector<Column> columns{{"manipulator", "-", "name of the design"}};
  const std::array<const char*, 5> meanings{"x coordinate of base joint C", "y coordinate of the base joints",
                                            "x coordinate of base joint D", "x coordinate of base joint E",
                                            "half the length of the platform"};
  for (std::size_t i = 0; i < design_columns.size(); ++i) columns.push_back({design_columns[i], "length", meanings[i]});
  for (int leg = 1; leg <= 3; ++leg) {
    columns.push_back({fmt::format("l_{}_min", leg), "length", fmt::format("shortest length of leg {}", leg)});
    columns.push_back({fmt::format("l_{}_max", leg), "length", fmt::format("greatest length of leg {}", leg)});
  }
  columns.push_back({"printed_name", "-", "name as printed"});
  for (const char* column : design_columns) {
    columns.push_back({fmt::format("published_{}", column), "length", fmt::format("{} as printed", column)});
  }
  columns.push_back(
      {"largest_difference", "length", "largest difference of the five parameters from the printed ones"});
  columns.push_back({"area", "length^2", "exact area of the constant-orientation workspace at phi = 0"});
  columns.push_back({"components", "-", "number of its components"});
  columns.push_back({"holes", "-", "number of its holes"});
  columns.push_back({"kappa_inverse", "-",
                     fmt::format("inverse condition number, normalised as in (5.13), at phi = 0 and O' = [{}, {}], the "
                                 "centre of the prescribed workspaces",
                                 centre.x(), centre.y())});
  return {"Table 5.1: geometric parameters for manipulator designs M1-M3", std::move(columns)};
}

std::size_t count_holes(const reprise::Region& region) {
  std::size_t holes = 0;
  for (const reprise::RegionComponent& component : region.components()) holes += component.holes.size();
  return holes;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace reprise;

  Experiment experiment(REPRISE_PROGRAM);

  return experiment.run(argc, argv, [](Session& session) {
    const Table published = read_table(data_folder() / "published" / "table_5_1.csv");
    const Eigen::Vector2d centre = read_prescribed_workspaces(chapter_synthesis("SO")).front().centre();
    Table table = make_table(centre);
    for (std::size_t printed = 0; printed < published.rows(); ++printed) {
      const std::string& name = published.text(printed, "manipulator");
      const auto [_, design, lengths] = read_chapter_manipulator(name);
      const Eigen::Matrix<double, 5, 1> parameters = to_vector(design);
      const Manipulator manipulator = make_manipulator(design, lengths, name);
      const Region workspace = constant_orientation_workspace(manipulator, 0.0);

      double largest_difference = 0.0;
      std::vector<Field> row{name};
      row.insert(row.end(), parameters.begin(), parameters.end());
      for (const Interval& length : lengths) row.insert(row.end(), {length.lower, length.upper});
      row.emplace_back(published.text(printed, "printed_name"));
      for (Eigen::Index i = 0; i < parameters.size(); ++i) {
        const char* column = design_columns[static_cast<std::size_t>(i)];
        row.emplace_back(published.text(printed, column));
        largest_difference = std::max(largest_difference, std::abs(parameters[i] - published.number(printed, column)));
      }
      row.insert(row.end(),
                 {largest_difference, workspace.area(), workspace.components().size(), count_holes(workspace),
                  kappa_inverse(manipulator, {centre, 0.0}, {.normalisation = Normalisation::printed})});
      table.add_row(row);
      fmt::print("{}: area {:.6f}, {} components, {} holes, largest difference from the printed parameters {}\n", name,
                 workspace.area(), workspace.components().size(), count_holes(workspace), largest_difference);
    }
    session.write(table);
  });
}
