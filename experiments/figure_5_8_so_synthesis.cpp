// Figure 5.8: the designs found for (a) P2 and (b) P3, with workspace and inverse condition number.

#include <fmt/format.h>

#include "support/data_files.hpp"
#include "support/experiment.hpp"
#include "support/files.hpp"
#include "support/stored_synthesis.hpp"
#include "support/workspace_map.hpp"

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;

  Experiment experiment("figure_5_8_so_synthesis", "SO synthesis: optimal designs for P2 and P3");
  experiment.reads_results();
  SynthesisRun run;
  run.declare(experiment.options());
  MapOptions map;
  map.declare(experiment.options());

  return experiment.run(argc, argv, [&](Session& session) {
    const CollinearManipulator start = read_manipulator(data_folder() / "manipulators.toml", "M1");
    const Table designs = session.read("table_5_3_so_synthesis");
    std::vector<MapPanel> panels;
    for (const SourcedWorkspace& sourced :
         read_prescribed_workspaces(data_folder() / "prescribed_workspaces.toml", "SO")) {
      const std::string& name = sourced.workspace.name();
      if (name != "P2" && name != "P3") continue;
      panels.push_back({fmt::format("({}) optimal design for {}", panels.empty() ? 'a' : 'b', name),
                        make_manipulator(run.design(designs, name), start.lengths),
                        0.0,
                        {sourced.workspace}});
    }
    const Table table = compute_map("Figure 5.8: SO synthesis, optimal designs for P2 and P3", panels, map);
    session.write(table);
    session.draw(draw_map(table));
  });
}
