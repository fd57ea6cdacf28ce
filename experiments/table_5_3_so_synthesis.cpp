// Table 5.3: SO synthesis, the best conditioned design that reaches a prescribed workspace at one orientation.

#include <fmt/format.h>

#include "support/data_files.hpp"
#include "support/experiment.hpp"
#include "support/files.hpp"
#include "support/synthesis_study.hpp"

int main(int argc, char** argv) {
  using namespace reprise::experiments;

  Experiment experiment("table_5_3_so_synthesis", "SO synthesis solutions");
  SynthesisSettings settings;
  settings.declare(experiment.options());

  return experiment.run(argc, argv, [&](Session& session) {
    const auto start = read_manipulator(data_folder() / "manipulators.toml", "M1");
    SynthesisInputs inputs{"Table 5.3: SO synthesis",
                           {},
                           start.design,
                           start.lengths,
                           read_table(data_folder() / "published" / "table_5_3.csv")};
    for (const SourcedWorkspace& one : read_prescribed_workspaces(data_folder() / "prescribed_workspaces.toml", "SO")) {
      inputs.workspaces.push_back(one.workspace);
    }
    if (session.quick()) settings.points = 150;

    const auto [table, history] = run_synthesis_study(inputs, settings);
    session.write(table);
    session.write(history, "history");
    fmt::print("{}", summarise_synthesis(table));
  });
}
