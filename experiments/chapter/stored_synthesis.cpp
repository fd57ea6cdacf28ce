#include "chapter/stored_synthesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "frame/source_tree.hpp"
#include "reprise/study/solvers.hpp"

namespace reprise::experiments {

CollinearDesign read_design(const Table& table, std::size_t row) {
  Eigen::Matrix<double, 5, 1> d;
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = table.number(row, design_columns[static_cast<std::size_t>(i)]);
  return to_collinear_design(d);
}

void SynthesisRun::declare(CommandLine& options) {
  options.choice("--optimizer", optimizer, solver_names(), "the optimizer whose result is pictured");
  options.choice("--formulation", formulation, {"area", "pointwise"}, "the formulation whose result is pictured");
}

Table SynthesisRun::select(const Table& table, const std::string& workspace) const {
  Table rows = table.where("workspace", workspace).where("optimizer", optimizer).where("formulation", formulation);
  if (rows.rows() == 0) {
    throw std::runtime_error(fmt::format("table '{}' has no row for workspace {}, optimizer {}, formulation {}.",
                                         table.title(), workspace, optimizer, formulation));
  }
  return rows;
}

CollinearDesign SynthesisRun::design(const Table& table, const std::string& workspace) const {
  const Table rows = select(table, workspace);
  return read_design(rows, rows.rows() - 1);
}

Table read_misprints() { return read_table(data_folder() / "published" / "misprints.csv"); }

std::vector<StudiedDesign> read_studied_designs(Session& session, const ChapterSynthesis& synthesis) {
  std::vector<StudiedDesign> designs;
  const Table published = read_published(synthesis);
  const Table misprints =
      read_misprints().where("item", fmt::format("Table {}", synthesis.table)).where("quantity", "y_C");
  for (std::size_t row = 0; row < published.rows(); ++row) {
    designs.push_back({published.text(row, "workspace"), "published", "", read_design(published, row)});
    const Table misprint = misprints.where("case", designs.back().workspace);
    if (misprint.rows() == 0) continue;
    designs.push_back(designs.back());
    designs.back().source = "published_corrected";
    designs.back().design.y_c = misprint.number(0, "read_as");
  }
  const Table own = session.read(synthesis.program);
  for (std::size_t row = 0; row < own.rows(); ++row) {
    designs.push_back(
        {own.text(row, "workspace"), own.text(row, "optimizer"), own.text(row, "formulation"), read_design(own, row)});
  }
  return designs;
}

}  // namespace reprise::experiments
