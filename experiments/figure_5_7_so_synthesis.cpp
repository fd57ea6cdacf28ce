// Figure 5.7: (a) the prescribed workspaces P1-P3 with workspace and inverse condition number of the starting design,
// (b) the design found for P1.

#include "support/data_files.hpp"
#include "support/experiment.hpp"
#include "support/files.hpp"
#include "support/stored_synthesis.hpp"
#include "support/workspace_map.hpp"

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;

  Experiment experiment("figure_5_7_so_synthesis", "SO synthesis: starting design, and optimal design for P1");
  experiment.reads_results();
  SynthesisRun run;
  run.declare(experiment.options());
  MapOptions map;
  map.declare(experiment.options());

  return experiment.run(argc, argv, [&](Session& session) {
    const CollinearManipulator start = read_manipulator(data_folder() / "manipulators.toml", "M1");
    const std::vector<SourcedWorkspace> sourced =
        read_prescribed_workspaces(data_folder() / "prescribed_workspaces.toml", "SO");
    std::vector<PrescribedWorkspace> prescribed;
    for (const SourcedWorkspace& workspace : sourced) prescribed.push_back(workspace.workspace);
    const CollinearDesign optimum = run.design(session.read("table_5_3_so_synthesis"), prescribed.front().name());

    const Table table =
        compute_map("Figure 5.7: SO synthesis, starting design and optimal design for P1",
                    {{"(a) starting design", make_manipulator(start.design, start.lengths), 0.0, prescribed},
                     {"(b) optimal design for " + prescribed.front().name(),
                      make_manipulator(optimum, start.lengths),
                      0.0,
                      {prescribed.front()}}},
                    map);
    session.write(table);
    session.draw(draw_map(table));
  });
}
