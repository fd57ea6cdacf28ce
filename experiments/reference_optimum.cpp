// How good are the designs of Tables 5.3 to 5.5? The best design for each of the nine synthesis problems, searched for
// from many starts and certified, and every design of the tables judged by the same certificates.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chapter/problems.hpp"
#include "chapter/stored_synthesis.hpp"
#include "frame/experiment.hpp"
#include "reference/gap_figure.hpp"
#include "reference/optimum_search.hpp"
#include "reference/reference_tables.hpp"
#include "reprise/bounds/enclosure.hpp"
#include "reprise/io/progress.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

struct Settings {
  SearchSettings search;
  long general_starts = 2;
  long points = 100;
  long refinement = 60;
};

Study make_study(const ChapterSynthesis& synthesis, const ChapterSynthesis& size, const std::string& workspace,
                 const Lengths& lengths) {
  return {synthesis.table,
          workspace,
          {read_chapter_problem(size, workspace).task.prescribed, read_orientations(synthesis),
           DesignSpace::collinear(lengths), printed_conditioning}};
}

/// All certificates of a design, over the whole prescribed region and range.
Judged judge(const SynthesisTask& task, const Eigen::VectorXd& design) {
  Judged judged{certify_optimality(task, design)};
  const Manipulator manipulator = task.designs.manipulator(design);
  const auto overreach = [&](const Interval& range) {
    const Containment containment =
        prove_containment(manipulator, task.prescribed, range, 0.0, {.tolerance = 1e-9, .max_evaluations = 100'000});
    judged.evaluations += containment.evaluations;
    return std::max(0.0, -containment.limits[containment.tightest].margin.lower);
  };
  for (const OrientationRange& range : task.orientations) {
    const MinimumEnclosure minimum =
        enclose_minimum(manipulator, task.prescribed, range, task.conditioning, {.tolerance = 1e-6});
    judged.lower = std::min(judged.lower, minimum.lower);
    judged.upper = std::min(judged.upper, minimum.upper);
    judged.evaluations += minimum.evaluations;
    judged.overreach = std::max(judged.overreach, overreach(range));
  }
  const bool several = task.orientations.size() > 1;
  judged.throughout =
      several ? overreach({task.orientations.front().lower, task.orientations.back().upper}) : judged.overreach;
  return judged;
}

/// A family of manipulators around a design of the chapter's, whose variables are the base joints' coordinates and,
/// where they are free, the platform joints'. The reference is d = 0.
SynthesisTask general_task(const Study& study, const Eigen::VectorXd& reference, bool platform_free) {
  const Manipulator origin = study.task.designs.manipulator(reference);
  std::vector<std::string> names;
  std::vector<Eigen::Index> rows;
  for (std::size_t leg = 0; leg < origin.size(); ++leg) {
    const auto first = 4 * static_cast<Eigen::Index>(leg);
    const std::string number = std::to_string(leg + 1);
    names.insert(names.end(), {"c_" + number + "x", "c_" + number + "y"});
    rows.insert(rows.end(), {first, first + 1});
    if (!platform_free) continue;
    names.insert(names.end(), {"p_" + number + "x", "p_" + number + "y"});
    rows.insert(rows.end(), {first + 2, first + 3});
  }
  if (!platform_free) names.emplace_back("r");
  const auto k = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(12, k);
  for (std::size_t j = 0; j < rows.size(); ++j) joints(rows[j], static_cast<Eigen::Index>(j)) = 1.0;
  if (!platform_free) joints.col(k - 1) = study.task.designs.joint_map().col(4);
  SynthesisTask task = study.task;
  task.designs = DesignSpace(origin, names, joints, Eigen::MatrixXd::Zero(6, k));
  return task;
}

/// The best of a family, from the reference (d = 0) and starts around it.
void add_general(ReferenceTables& tables, const Study& study, const std::string& family, const SynthesisTask& task,
                 const std::vector<Eigen::VectorXd>& starts, double reference, const Settings& settings) {
  const Search search = search_globally(task, starts, settings.search);
  const LocalOptimum& best = best_of(task, search);
  const OptimalityCertificate certificate = certify_optimality(task, best.design);
  tables.general.add_row({study.table, study.workspace, family, task.designs.size(), search.starts, best.t,
                          best.t - reference, certificate.kkt_residual, certificate.violation});
}

/// The problem's own tasks done, the reference optimum is returned.
Eigen::VectorXd find_reference(const Study& study, const Lengths& lengths, const Settings& settings,
                               ReferenceTables* tables) {
  const Search search = search_both_sides(study.task, lengths, settings.search);
  const LocalOptimum& best = best_of(study.task, search);
  if (!tables) return best.design;
  const IpoptSolver ipopt = make_ipopt();
  // From the optimum, rounded: other optima are so near that a farther start may lead to one of them.
  const Eigen::VectorXd start = (1000.0 * best.design).array().round() / 1000.0;
  const Agreement both{solve_by_exchange(study.task, start, ipopt),
                       solve_discretised(study.task, start, ipopt,
                                         {.points = static_cast<int>(settings.points),
                                          .refinement = static_cast<int>(settings.refinement)})};
  tables->add_starts(study, search);
  tables->add_agreement(study, search, best, both);
  return best.design;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  experiment.reads_results();
  Settings settings;
  CommandLine& options = experiment.options();
  options.integer("--starts", settings.search.starts, 1, 100'000, "starts of the global search for each sign of r");
  options.integer("--general-starts", settings.general_starts, 1, 100'000, "starts for general manipulators");
  options.integer("--sample-points", settings.search.sample_points, 8, 100'000, "outline points of the global search");
  options.number("--smallest-r", settings.search.smallest_r, NumberRange::positive(), "least |r| in the global search");
  options.number("--largest-r", settings.search.largest_r, NumberRange::positive(), "largest |r| in the global search");
  options.integer("--points", settings.points, 8, 100'000, "outline points of the large sparse problem");
  options.integer("--refinement", settings.refinement, 0, 100'000, "points added around each active one");

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        if (session.quick()) {
          settings.search.starts = 3;
          settings.general_starts = 1;
          settings.search.sample_points = 40;
          settings.points = 30;
          settings.refinement = 40;
        }
        const Lengths lengths = read_chapter_manipulator("M1").lengths;
        std::vector<std::vector<StudiedDesign>> stored;
        for (const ChapterSynthesis& studied : chapter_syntheses)
          stored.push_back(read_studied_designs(session, studied));
        ReferenceTables tables;
        Progress progress(9);
        std::map<std::pair<std::string, std::string>, double> optima;
        double search_seconds = 0.0;
        double judge_seconds = 0.0;
        double general_seconds = 0.0;
        const auto timed = [](double& seconds, const auto& work) {
          const auto begin = std::chrono::steady_clock::now();
          work();
          seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        };
        for (std::size_t i = 0; i < stored.size(); ++i) {
          const ChapterSynthesis& studied = chapter_syntheses[i];
          for (const std::string& workspace : workspace_names) {
            progress.begin(fmt::format("Table {}, {}", studied.table, workspace));
            const Study study = make_study(studied, studied, workspace, lengths);
            Eigen::VectorXd reference;
            timed(search_seconds, [&] { reference = find_reference(study, lengths, settings, &tables); });
            Judged judged;
            timed(judge_seconds, [&] { judged = judge(study.task, reference); });
            const double best = judged.certificate.kappa_inverse;
            optima[{studied.table, workspace}] = best;
            timed(judge_seconds, [&] {
              for (const StudiedDesign& one : stored[i]) {
                if (one.workspace != workspace) continue;
                const Eigen::VectorXd design = to_vector(one.design);
                tables.add_design(study, one.source, one.formulation, design, judge(study.task, design), best);
              }
            });
            tables.add_design(study, "reference", "semi_infinite", reference, judged, best);
            tables.add_sensitivities(study, reference, judged.certificate);

            // The optima of Table 5.4 are those of Table 5.5, or of the same kind.
            if (studied.kind == std::string_view("MO")) continue;
            timed(general_seconds, [&] {
              tables.general.add_row({study.table, study.workspace, "collinear", 5, 2 * settings.search.starts, best,
                                      0.0, judged.certificate.kkt_residual, judged.certificate.violation});
              for (const bool platform_free : {false, true}) {
                const SynthesisTask task = general_task(study, reference, platform_free);
                std::vector<Eigen::VectorXd> starts{Eigen::VectorXd::Zero(task.designs.size())};
                for (const Eigen::VectorXd& point : sobol_points(settings.general_starts - 1, task.designs.size())) {
                  starts.emplace_back(0.4 * (point.array() - 0.5));
                }
                add_general(tables, study, platform_free ? "general" : "base", task, starts, best, settings);
              }
            });
          }
        }
        // P1 and P2 are the same in Tables 5.4 and 5.5; P3 is not.
        const auto optimum = [&](const char* kind, const char* size) {
          const Study study = make_study(chapter_synthesis(kind), chapter_synthesis(size), "P3", lengths);
          return assess_outline(study.task, find_reference(study, lengths, settings, nullptr)).kappa_inverse;
        };
        const auto add_claim = [&](const char* workspace, const char* size, double mo, double d) {
          tables.claim.add_row({workspace, size, mo, d, mo - d});
        };
        for (const char* workspace : {"P1", "P2"}) {
          add_claim(workspace, "both", optima[{"5.4", workspace}], optima[{"5.5", workspace}]);
        }
        timed(search_seconds, [&] {
          add_claim("P3", "5.4", optima[{"5.4", "P3"}], optimum("D", "MO"));
          add_claim("P3", "5.5", optimum("MO", "D"), optima[{"5.5", "P3"}]);
        });
        session.write(tables.designs);
        session.write(tables.starts, "starts");
        session.write(tables.agreement, "agreement");
        session.write(tables.sensitivities, "sensitivities");
        session.write(tables.claim, "claim");
        session.write(tables.general, "general");
        session.constant("outline_samples", ExchangeOptions().samples);
        session.constant("violation_tolerance", ExchangeOptions().violation_tolerance);
        session.constant("worth_refining", worth_refining);
        session.constant("lowest_shown", lowest_shown);
        session.constant("highest_shown", highest_shown);
        session.constant("hollow_above", hollow_above);
        session.record("search_seconds", search_seconds);
        session.record("judge_seconds", judge_seconds);
        session.record("general_seconds", general_seconds);
        for (std::size_t row = 0; row < tables.agreement.rows(); ++row) {
          fmt::print("{} {}: t {:.10f}, {} of {} starts, two methods differ by {:.1e} in t, {:.1e} in d\n",
                     tables.agreement.text(row, "table"), tables.agreement.text(row, "workspace"),
                     tables.agreement.number(row, "t_exchange"), tables.agreement.text(row, "reached"),
                     tables.agreement.text(row, "starts"), tables.agreement.number(row, "difference_t"),
                     tables.agreement.number(row, "difference_d"));
        }
      },
      [](Session& session) { session.draw(draw_gaps(session.table())); });
}
