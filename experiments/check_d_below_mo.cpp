// Section 5.8.2 says that f_D* <= f_MO*. Both syntheses, for every prescribed workspace in the size it has in Table 5.4
// and in that of Table 5.5.

#include <fmt/format.h>

#include "chapter/synthesis_study.hpp"
#include "frame/experiment.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

/// The optima for the workspaces in one size, at the orientations of one kind of synthesis.
Table solve(const char* size, const char* kind, long points) {
  const ChapterSynthesis& synthesis = chapter_synthesis(kind);
  ChapterSettings settings = chapter_settings(synthesis);
  settings.formulations = {"pointwise"};
  settings.optimizers = {"slsqp"};
  settings.points = points;
  SynthesisInputs inputs = read_synthesis_inputs(synthesis.published, synthesis);
  inputs.workspaces = read_prescribed_workspaces(chapter_synthesis(size));
  return run_synthesis_study(inputs, settings).first;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  long points = ChapterSettings().points;
  experiment.options().integer("--points", points, 3, 100'000, "outline points");

  return experiment.run(argc, argv, [&](Session& session) {
    if (session.quick()) points = 150;
    Table table("Section 5.8.2: MO and D synthesis of the same prescribed workspaces",
                {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
                 {"size", "-", "the table whose size it has, 5.4 or 5.5"},
                 {"f_MO", "-", "smallest inverse condition number of the best design for the slices -5, 0, 5 degrees"},
                 {"f_D", "-", "that of the best design for all orientations from -5 to 5 degrees"},
                 {"violation_MO", "length", "largest violation of a leg's limit, MO design at the slices"},
                 {"violation_MO_range", "length", "MO design, at any orientation from -5 to 5 degrees"},
                 {"violation_D", "length", "D design, at any orientation from -5 to 5 degrees"},
                 {"status_MO", "-", "how the optimizer ended"},
                 {"status_D", "-", "how the optimizer ended"},
                 {"published_f_MO", "-", "f* as printed in Table 5.4, where the size is its"},
                 {"published_f_D", "-", "f* as printed in Table 5.5, where the size is its"}},
                {"Pointwise formulation, SLSQP with constraint exchange, from the chapter's start."});
    for (const char* size : {"MO", "D"}) {
      const Table mo = solve(size, "MO", points);
      const Table d = solve(size, "D", points);
      for (std::size_t row = 0; row < mo.rows(); ++row) {
        const auto published = [&](const Table& of, const char* kind) {
          return size == std::string_view(kind) ? Field(of.text(row, "published_f_star")) : Field();
        };
        table.add_row({mo.text(row, "workspace"), chapter_synthesis(size).table, mo.number(row, "kappa_inv_dense"),
                       d.number(row, "kappa_inv_dense"), mo.number(row, "violation_dense"),
                       mo.number(row, "violation_range"), d.number(row, "violation_dense"), mo.text(row, "status"),
                       d.text(row, "status"), published(mo, "MO"), published(d, "D")});
      }
    }
    session.write(table);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      fmt::print("{} in the size of Table {}: f_MO* {:.6f}, f_D* {:.6f}\n", table.text(row, "workspace"),
                 table.text(row, "size"), table.number(row, "f_MO"), table.number(row, "f_D"));
    }
  });
}
