#include "support/stored_synthesis.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "support/solvers.hpp"

namespace reprise::experiments {

CollinearDesign read_design(const Table& table, std::size_t row) {
  return {table.number(row, "x_C"), table.number(row, "y_C"), table.number(row, "x_D"), table.number(row, "x_E"),
          table.number(row, "r")};
}

void SynthesisRun::declare(Options& options) {
  options.choice("--optimizer", optimizer, solver_names(), "the optimizer whose result is pictured");
  options.choice("--formulation", formulation, {"area", "pointwise"}, "the formulation whose result is pictured");
}

Table SynthesisRun::select(const Table& table, const std::string& workspace) const {
  const Table rows =
      table.where("workspace", workspace).where("optimizer", optimizer).where("formulation", formulation);
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

}  // namespace reprise::experiments
