#include "chapter/synthesis_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "chapter/convergence_figure.hpp"
#include "chapter/problems.hpp"
#include "chapter/stored_synthesis.hpp"
#include "reprise/study/workspace_map.hpp"

namespace reprise::experiments {

namespace {

/// What is known about the origin of the prescribed workspaces.
Table describe_workspaces(const ChapterSynthesis& synthesis) {
  Table table("Prescribed workspaces: where their outlines come from", {{"workspace", "-", "name"},
                                                                        {"kind", "-", "kind of outline"},
                                                                        {"source", "-", "where the outline comes from"},
                                                                        {"certainty", "-", "how sure it is"}});
  for (const std::string& name : workspace_names) {
    const OutlineOrigin origin = read_chapter_problem(synthesis, name).origin;
    table.add_row({name, origin.kind, origin.source, origin.certainty});
  }
  return table;
}

/// "Figure 5.7: SO synthesis: ..."
std::string heading(const ManifestEntry& program) { return program.item + ": " + program.title; }

bool shows_start(const DesignPanel& panel) { return panel.workspace.empty(); }

/// "(b) optimal design for P1", with the orientation where the panels differ in it.
std::string panel_title(const DesignFigure& figure, std::size_t index) {
  const DesignPanel& panel = figure.panels[index];
  std::string title = fmt::format("({}) ", static_cast<char>('a' + index));
  const bool differ = std::any_of(figure.panels.begin(), figure.panels.end(), [&](const DesignPanel& other) {
    return other.orientations_deg.lower != panel.orientations_deg.lower;
  });
  const double phi = panel.orientations_deg.lower;
  if (differ) return title + fmt::format("φ = {}{:g}°", phi < 0.0 ? "−" : "", std::abs(phi));
  return title + (shows_start(panel) ? "starting design" : "optimal design for " + panel.workspace);
}

}  // namespace

int run_design_figure(int argc, const char* const* argv, const DesignFigure& figure) {
  Experiment experiment(figure.program);
  const bool reads_designs = !std::all_of(figure.panels.begin(), figure.panels.end(), shows_start);
  SynthesisRun run;
  if (reads_designs) {
    experiment.reads_results();
    run.declare(experiment.options());
  }
  MapOptions map;
  map.declare(experiment.options());

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        const ChapterSynthesis& synthesis = chapter_synthesis(figure.kind);
        const CollinearManipulator start = read_start(synthesis);
        const std::vector<PrescribedWorkspace> all = read_prescribed_workspaces(synthesis);
        std::optional<Table> designs;
        if (reads_designs) designs = session.read(synthesis.program);
        std::vector<MapPanel> panels;
        for (std::size_t i = 0; i < figure.panels.size(); ++i) {
          const DesignPanel& panel = figure.panels[i];
          std::vector<PrescribedWorkspace> prescribed;
          for (const PrescribedWorkspace& one : all) {
            if (shows_start(panel) || one.name() == panel.workspace) prescribed.push_back(one);
          }
          if (prescribed.empty()) {
            throw std::runtime_error(fmt::format("There is no prescribed workspace {}.", panel.workspace));
          }
          const CollinearDesign design = shows_start(panel) ? start.design : run.design(*designs, panel.workspace);
          panels.push_back({panel_title(figure, i),
                            make_manipulator(design, start.lengths),
                            {panel.orientations_deg.lower * degree, panel.orientations_deg.upper * degree},
                            prescribed});
        }
        const Table table = compute_map(heading(figure.program), panels, map);
        session.write(table);
        session.constant("range_orientations", map.orientations);
        if (shows_start(figure.panels.front())) session.write(describe_workspaces(synthesis), "prescribed");
      },
      [](Session& session) { session.draw(draw_map(session.table())); });
}

int run_convergence_figure(int argc, const char* const* argv, const ManifestEntry& program, const std::string& kind) {
  Experiment experiment(program);
  experiment.reads_results();
  SynthesisRun run;
  run.declare(experiment.options());
  return experiment.run(
      argc, argv,
      [&](Session& session) {
        const Table stored = session.read(chapter_synthesis(kind).program, "history");
        const Table histories = collect_histories(heading(program), stored, run);
        session.write(histories);
      },
      [](Session& session) { session.draw(draw_histories(session.table())); });
}

}  // namespace reprise::experiments
