// The best design there is, for each of the nine syntheses of Tables 5.3 to 5.5 and each sign of r: what was found,
// what is proved that no design exceeds, and the certificate of it, which an independent program checks.

#include "reprise/bounds/global_optimum.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "frame/source_tree.hpp"
#include "reprise/io/compression.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/study/bound_claim.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

/// Sizes |r| that are searched. At both ends and beyond kappa^-1 is below 0.86, as the root box's lemma says.
constexpr Interval sizes{0.5, 2.6};

Table make_table() {
  std::vector<Column> columns{
      {"table", "-", "table of the chapter that the problem belongs to"},
      {"workspace", "-", "prescribed workspace (reconstructed, not published)"},
      {"side", "-", "sign of r; with -1 the platform is turned round"},
      {"f", "-", "proved: smallest inverse condition number of the design found, over the whole workspace and range"},
      {"bound", "-", "proved: no design of that side that reaches the workspace has a larger one"},
      {"gap", "-", "the bound less f"},
      {"boxes", "-", "boxes of designs examined"},
      {"seconds", "s", "processor time of the proof divided by the number of threads; not the same in each run"},
      {"checked", "-", "1: the independent checker accepts the certificate"}};
  for (const char* name : design_columns) columns.push_back({name, "length", "the design found"});
  columns.insert(columns.end(), {{"split", "-", "boxes split"},
                                 {"limits", "-", "boxes and slabs left out by one limit at one pose"},
                                 {"conditioning", "-", "boxes left out by the condition number at one pose"},
                                 {"combinations", "-", "boxes left out by multipliers of a linear program"},
                                 {"infeasible", "-", "boxes left out by multipliers of limits alone"},
                                 {"certificate_bytes", "byte", "size of the certificate, compressed"},
                                 {"status", "-", "how the search ended"}});
  return {"The best design there is: what was found, and what is proved that no design exceeds",
          columns,
          {"Prescribed workspaces are reconstructed from the printed results, not published."}};
}

std::string certificate_name(const ChapterSynthesis& synthesis, const std::string& workspace, int side) {
  return fmt::format("{}_{}{}", synthesis.kind, workspace, side > 0 ? "" : "_turned");
}

/// Stores the certificate and what it claims, and reads them back for the checker.
CheckResult store_and_check(Session& session, const ChapterSynthesis& synthesis, const std::string& workspace,
                            const BoundClaim& claim, const std::string& compressed) {
  const std::filesystem::path folder = "certificates";
  const std::string name = certificate_name(synthesis, workspace, claim.side);
  const std::filesystem::path tree = session.store(folder / (name + ".cert.gz"), compressed);
  const std::filesystem::path problem = examples_folder() / (workspace + synthesis.file + ".toml");
  const StoredClaim stored{std::filesystem::proximate(problem, tree.parent_path()), tree.filename(), claim};
  return check_claim(session.store(folder / (name + ".toml"), to_toml(stored))).result;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  GlobalOptions options{.gap = 1e-7, .threads = 2, .sizes = sizes};
  experiment.options().number("--gap", options.gap, NumberRange::between(1e-8, 1.0), "between bound and found design");
  experiment.options().integer("--threads", options.threads, 1, 256, "threads; the results do not depend on them");

  return experiment.run(argc, argv, [&](Session& session) {
    Table table = make_table();
    Progress progress(18);
    for (const ChapterSynthesis& synthesis : chapter_syntheses) {
      if (session.quick() && synthesis.kind != std::string_view("SO")) continue;
      for (const std::string& workspace : workspace_names) {
        if (session.quick() && workspace == "P3") continue;
        const ProblemInput problem = read_chapter_problem(synthesis, workspace);
        for (const int side : {1, -1}) {
          progress.begin(certificate_name(synthesis, workspace, side));
          options.side = side;
          options.observe = [&](const GlobalProgress& now) {
            progress.note(fmt::format("{} boxes, {:.7f} to {:.7f}", now.boxes, now.lower, now.upper));
          };
          const std::clock_t begin = std::clock();
          const GlobalOptimum found = prove_global_optimum(problem.task, options);
          const double seconds =
              static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / static_cast<double>(options.threads);
          if (!found.design) throw std::runtime_error("No design was found for " + workspace + ".");
          const std::string compressed = compress(to_text(found.certificate));
          const BoundClaim claim{side, found.upper, found.certificate.root};
          const CheckResult check = store_and_check(session, synthesis, workspace, claim, compressed);
          const BoxCounts& counts = found.counts;
          std::vector<Field> row{synthesis.table,           workspace,       side,    found.lower,         found.upper,
                                 found.upper - found.lower, counts.examined, seconds, check.proved ? 1 : 0};
          row.insert(row.end(), found.design->begin(), found.design->end());
          row.insert(row.end(), {counts.split, counts.limits, counts.conditioning, counts.combinations,
                                 counts.infeasible, compressed.size(), std::string(to_string(found.status))});
          table.add_row(row);
          fmt::print("Table {} {} r {} 0: {:.9f} <= f* <= {:.9f}, {} boxes, certificate {}\n", synthesis.table,
                     workspace, side > 0 ? ">" : "<", found.lower, found.upper, counts.examined,
                     check.proved ? "checked" : check.failure);
        }
      }
    }
    session.write(table);
  });
}
