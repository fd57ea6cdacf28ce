// Table 5.3: SO synthesis, the best conditioned design that reaches a prescribed workspace at one orientation.

#include "chapter/synthesis_study.hpp"
#include "frame/experiment.hpp"

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;

  Experiment experiment(REPRISE_PROGRAM);
  const ChapterSynthesis& synthesis = chapter_synthesis("SO");
  ChapterSettings settings;
  experiment.prepares([&](CommandLine& options) {
    settings = chapter_settings(synthesis);
    settings.declare(options);
  });

  return experiment.run(argc, argv, [&](Session& session) {
    write_synthesis_study(session, read_synthesis_inputs("Table 5.3: SO synthesis", synthesis), settings);
  });
}
