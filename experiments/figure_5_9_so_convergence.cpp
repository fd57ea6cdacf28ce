// Figure 5.9: how objective and constraint develop over the iterations for (a) P1, (b) P2 and (c) P3.

#include "support/convergence_figure.hpp"
#include "support/experiment.hpp"
#include "support/stored_synthesis.hpp"

int main(int argc, char** argv) {
  using namespace reprise::experiments;

  Experiment experiment("figure_5_9_so_convergence", "SO synthesis: convergence histories");
  experiment.reads_results();
  SynthesisRun run;
  run.declare(experiment.options());

  return experiment.run(argc, argv, [&](Session& session) {
    const Table table = collect_histories("Figure 5.9: SO synthesis, convergence histories",
                                          session.read("table_5_3_so_synthesis", "history"), run);
    session.write(table);
    session.draw(draw_histories(table));
  });
}
