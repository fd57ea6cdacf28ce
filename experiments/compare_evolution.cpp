// What the chapter says of evolutionary algorithms, measured: the function evaluations that three of them need for the
// synthesis of Table 5.3, each with several seeds, against those of Dynamic-Q.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "chapter/synthesis_study.hpp"
#include "comparison/judge.hpp"
#include "frame/experiment.hpp"
#include "frame/spread.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/nlopt.hpp"

namespace reprise::experiments {
namespace {

constexpr const char* title = "Evolutionary algorithms on the synthesis";

struct Settings {
  std::vector<std::string> workspaces{"P1", "P2", "P3"};
  std::vector<std::string> algorithms{"isres", "crs2", "esch"};
  std::vector<double> targets{1e-1, 1e-2, 1e-3};
  long seeds = 10;
  long max_evaluations = 2000;
  double search_radius = 0.5;
  double start_spread = 1e-6;

  void declare(CommandLine& options) {
    options.choices("--workspace", workspaces, workspaces, "prescribed workspaces");
    options.choices("--algorithm", algorithms, algorithms, "evolutionary algorithms");
    options.numbers("--target", targets, NumberRange::positive(), "relative errors of the objective to be met");
    options.integer("--seeds", seeds, 1, 1000, "runs of each algorithm, with the seeds 1, 2, ...; starts of Dynamic-Q");
    options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on N_f of a run");
    options.number("--search-radius", search_radius, NumberRange::positive(),
                   "half the box that is searched, about the start, in units of max(1, |x_i|) of the start");
    options.number("--start-spread", start_spread, NumberRange::positive(),
                   "how far the starts of Dynamic-Q are moved, in the same units");
  }
};

NloptAlgorithm algorithm_called(const std::string& name) {
  if (name == "crs2") return NloptAlgorithm::crs2;
  return name == "esch" ? NloptAlgorithm::esch : NloptAlgorithm::isres;
}

/// The constrained problem as one with an objective only, for methods that rank points by their values and take no
/// constraint: a feasible point has its f, which is -kappa^-1 and not positive; another one has g, which is.
Problem ranked(const Problem& constrained, double tolerance) {
  Problem problem = constrained;
  problem.inequalities = 0;
  problem.inequality = {};
  problem.objective = [constrained, tolerance, g = Eigen::VectorXd(1)](const Eigen::VectorXd& d) mutable {
    constrained.inequality(d, g);
    return g[0] <= tolerance ? constrained.objective(d) : g[0];
  };
  return problem;
}

/// What one run needs.
struct Run {
  std::string workspace;
  std::string algorithm;
  long seed;
  Result result;
};

/// f is between -1 and 0, so that the judge's error, over max(1, |f*|), would be absolute.
Judgement judge_relatively(const Result& result, double best, double target, double tolerance) {
  return judge(result, -best, {target * best, tolerance});
}

Table make_runs_table(const std::vector<Run>& runs, const std::map<std::string, double>& best, double tolerance,
                      const Settings& settings) {
  Table table(title,
              {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
               {"algorithm", "-", "dynamic_q, or an evolutionary algorithm of NLopt"},
               {"seed", "-", "of the random numbers; for dynamic_q of the move of its start"},
               {"target", "-", "largest relative error of the smallest kappa^-1 against the reference"},
               {"solved", "-", "1 when a feasible point of the run met the target, else 0"},
               {"N_f", "-", "function evaluations until then, finite differences counted in; empty when not solved"}},
              {"SO synthesis in the area formulation. The reference is the best value of the pointwise formulation."});
  for (const Run& run : runs) {
    for (const double target : settings.targets) {
      const Judgement judgement = judge_relatively(run.result, best.at(run.workspace), target, tolerance);
      table.add_row({run.workspace, run.algorithm, run.seed, target, static_cast<int>(judgement.solved),
                     judgement.solved ? Field(judgement.counts.function_evaluations()) : Field()});
    }
  }
  return table;
}

/// Over the runs of an algorithm for one workspace.
Table summarise(const Table& runs) {
  Table table(std::string(title) + ", summed up",
              {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
               {"algorithm", "-", "dynamic_q, or an evolutionary algorithm of NLopt"},
               {"target", "-", "largest relative error of the smallest kappa^-1 against the reference"},
               {"runs", "-", "number of runs"},
               {"solved", "-", "runs that met the target"},
               {"N_f_least", "-", "fewest function evaluations of these"},
               {"N_f_median", "-", "median of these"},
               {"N_f_most", "-", "most of these"},
               {"ratio", "-", "the median over that of dynamic_q; empty where one of them solves no run"}});
  const auto costs = [&](const std::string& workspace, const std::string& algorithm, const std::string& target) {
    const Table some =
        runs.where("workspace", workspace).where("algorithm", algorithm).where("target", target).where("solved", "1");
    return some.numbers("N_f");
  };
  for (const std::string& workspace : runs.distinct("workspace")) {
    for (const std::string& algorithm : runs.distinct("algorithm")) {
      for (const std::string& target : runs.distinct("target")) {
        const std::size_t number =
            runs.where("workspace", workspace).where("algorithm", algorithm).where("target", target).rows();
        const std::vector<double> found = costs(workspace, algorithm, target);
        const std::vector<double> ours = costs(workspace, "dynamic_q", target);
        std::vector<Field> row{workspace, algorithm, target, number, found.size()};
        if (found.empty()) {
          row.insert(row.end(), 4, Field());
        } else {
          const Spread spread = spread_of(found);
          row.insert(row.end(), {spread.lowest, spread.median, spread.highest});
          row.push_back(ours.empty() ? Field() : Field(spread.median / spread_of(ours).median));
        }
        table.add_row(row);
      }
    }
  }
  return table;
}

}  // namespace
}  // namespace reprise::experiments

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;

  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  settings.declare(experiment.options());
  experiment.reads_results();

  return experiment.run(argc, argv, [&](Session& session) {
    if (session.quick()) {
      settings.workspaces.resize(1);
      settings.seeds = 2;
      settings.max_evaluations = 100;
    }
    const ChapterSynthesis& synthesis = chapter_synthesis("SO");
    const ChapterSettings chapter = chapter_settings(synthesis);
    const SynthesisInputs inputs = read_synthesis_inputs(title, synthesis);
    const Table found = session.read(synthesis.program).where("formulation", "pointwise");
    const double tightest = *std::min_element(settings.targets.begin(), settings.targets.end());

    Progress progress(settings.workspaces.size() * (settings.algorithms.size() + 1));
    std::map<std::string, double> best;
    std::vector<Run> runs;
    double tolerance = 0.0;
    for (const std::string& workspace : settings.workspaces) {
      const std::vector<double> values = found.where("workspace", workspace).numbers("kappa_inv_dense");
      best[workspace] = *std::max_element(values.begin(), values.end());
      const SynthesisProblem posed = formulate(Formulation::area, area_formulation(inputs, chapter, workspace).task(),
                                               to_vector(inputs.start), chapter.formulation_settings());
      Options options = posed.options;
      options.max_function_evaluations = settings.max_evaluations;
      tolerance = options.feasibility_tolerance;
      // What comes after the last target is of no interest here.
      const auto until_met = [&](const Iterate& iterate) {
        return iterate.violation > tolerance || iterate.f > -best[workspace] * (1.0 - tightest);
      };

      progress.begin(workspace + ", dynamic_q");
      const std::shared_ptr<const Solver> dynamic_q = make_solver("dynamic_q", Formulation::area, chapter);
      for (long seed = 1; seed <= settings.seeds; ++seed) {
        const Eigen::VectorXd start = moved_start(posed.start, settings.start_spread, static_cast<std::uint64_t>(seed));
        runs.push_back({workspace, "dynamic_q", seed, dynamic_q->minimize(posed.problem, start, options, until_met)});
      }
      for (const std::string& algorithm : settings.algorithms) {
        progress.begin(workspace + ", " + algorithm);
        const Problem problem = algorithm == "isres" ? posed.problem : ranked(posed.problem, tolerance);
        for (long seed = 1; seed <= settings.seeds; ++seed) {
          NloptOptions chosen;
          chosen.algorithm = algorithm_called(algorithm);
          chosen.seed = static_cast<unsigned long>(seed);
          chosen.search_radius = settings.search_radius;
          chosen.max_iterations = settings.max_evaluations;
          runs.push_back(
              {workspace, algorithm, seed, NloptSolver(chosen).minimize(problem, posed.start, options, until_met)});
        }
      }
    }
    const Table table = make_runs_table(runs, best, tolerance, settings);
    const Table summary = summarise(table);
    session.write(table);
    session.write(summary, "summary");
    fmt::print("{:<10}{:<11}{:>8}{:>9}{:>11}{:>9}\n", "", "", "target", "solved", "N_f", "ratio");
    for (std::size_t row = 0; row < summary.rows(); ++row) {
      fmt::print("{:<10}{:<11}{:>8}{:>9}{:>11}{:>9.4}\n", summary.text(row, "workspace"),
                 summary.text(row, "algorithm"), summary.text(row, "target"), summary.text(row, "solved"),
                 summary.text(row, "N_f_median"), summary.text(row, "ratio"));
    }
  });
}
