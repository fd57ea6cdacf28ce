// Every optimizer on the thesis's own problems: which of them finds the best conditioned design, and at what cost.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "chapter/synthesis_study.hpp"
#include "comparison/judge.hpp"
#include "frame/experiment.hpp"
#include "frame/shown_name.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/study/solvers.hpp"

namespace reprise::experiments {
namespace {

constexpr const char* title = "Optimizers on the synthesis";

/// All but the evolution strategy, which needs far more evaluations than the others: compare_evolution runs it.
std::vector<std::string> local_solvers() {
  std::vector<std::string> names = solver_names();
  std::erase(names, "isres");
  return names;
}

struct Settings {
  std::vector<std::string> kinds{"SO", "MO", "D"};
  std::vector<std::string> workspaces{"P1", "P2", "P3"};
  std::vector<std::string> formulations{"area", "pointwise"};
  std::vector<std::string> solvers = local_solvers();
  std::vector<double> targets{1e-2, 1e-3, 1e-4};
  double main_target = 1e-3;
  long points = 300;
  long max_evaluations = 500;

  void declare(CommandLine& options) {
    options.choices("--kind", kinds, kinds, "kinds of synthesis");
    options.choices("--workspace", workspaces, workspaces, "prescribed workspaces");
    options.choices("--formulation", formulations, formulations, "formulations of the synthesis");
    options.choices("--solver", solvers, solvers, "optimizers");
    options.numbers("--target", targets, NumberRange::positive(), "relative errors of the objective to be met");
    options.number("--main-target", main_target, NumberRange::positive(), "the relative error behind the summary");
    options.integer("--points", points, 3, 100'000, "outline points of the pointwise formulation");
    options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on N_f of a run");
  }

  /// Ipopt has no Hessian of the area formulation, so both of its variants would be the same.
  static bool is_run(const std::string& solver, const std::string& formulation) {
    return solver != "ipopt" || formulation == "pointwise";
  }
};

/// A task in one formulation.
struct Formulated {
  std::string kind;
  std::string task;
  std::string formulation;
  SynthesisProblem synthesis;
  ChapterSettings settings;

  double feasibility_tolerance() const { return synthesis.options.feasibility_tolerance; }
};

std::vector<Formulated> formulate_all(const Settings& settings) {
  std::vector<Formulated> all;
  for (const std::string& kind : settings.kinds) {
    const ChapterSynthesis& synthesis = chapter_synthesis(kind);
    ChapterSettings chapter = chapter_settings(synthesis);
    chapter.points = settings.points;
    const SynthesisInputs inputs = read_synthesis_inputs(title, synthesis);
    for (const std::string& workspace : settings.workspaces) {
      const AreaFormulation area = area_formulation(inputs, chapter, workspace);
      for (const std::string& formulation : settings.formulations) {
        all.push_back({kind, kind + "-" + workspace, formulation,
                       formulate(formulation_called(formulation), area.task(), to_vector(inputs.start),
                                 chapter.formulation_settings()),
                       chapter});
      }
    }
  }
  return all;
}

struct Run {
  const Formulated* formulated;
  std::string solver;
  Result result;
};

/// The lowest objective of any feasible point of these runs.
double best_known(const std::vector<Run>& runs, const Formulated& formulated) {
  double best = std::numeric_limits<double>::infinity();
  for (const Run& run : runs) {
    if (run.formulated != &formulated) continue;
    const auto include = [&](double f, double violation) {
      if (violation <= formulated.feasibility_tolerance()) best = std::min(best, f);
    };
    for (const Iterate& iterate : run.result.history) include(iterate.f, iterate.violation);
    include(run.result.f, run.result.violation);
  }
  return best;
}

/// f is between -1 and 0, so that the judge's error, over max(1, |f*|), would be absolute.
Judgement judge_relatively(const Result& result, double best, const Target& target) {
  Judgement judgement = judge(result, best, {target.f_error * std::abs(best), target.violation});
  judgement.f_error /= std::abs(best);
  return judgement;
}

Table make_runs_table(const std::vector<Run>& runs, const Settings& settings) {
  Table table(
      title,
      {{"problem", "-", "kind of synthesis and prescribed workspace (reconstructed, not published)"},
       {"formulation", "-", "area: the thesis's, eqs. (5.34) to (5.40); pointwise: limits at outline points"},
       {"solver", "-", "name of the solver"},
       {"target", "-", "largest relative error of f against the best point of all runs of this formulation"},
       {"solved", "-", "1 when a point of the run met the target, else 0"},
       {"N_g", "-", "gradient evaluations until then, or of the whole run"},
       {"N_f", "-", "function evaluations until then, or of the whole run, finite differences counted in"},
       {"f", "-", "smallest inverse condition number at that point, or at the result"},
       {"f_error", "-", "its relative error"},
       {"violation", "-", "its largest violation: g of (5.35), (5.38) or (5.40), an area, or the pointwise limits"},
       {"status", "-", "what the solver says of its end"}},
      {"A target also demands that the formulation's own constraints hold to its tolerance."});
  for (const Run& run : runs) {
    const Formulated& formulated = *run.formulated;
    const double best = best_known(runs, formulated);
    for (const double f_error : settings.targets) {
      const Judgement judgement = judge_relatively(run.result, best, {f_error, formulated.feasibility_tolerance()});
      table.add_row({formulated.task, formulated.formulation, run.solver, f_error, static_cast<int>(judgement.solved),
                     judgement.counts.gradient_evaluations(), judgement.counts.function_evaluations(), -judgement.f,
                     judgement.f_error, judgement.violation, to_string(run.result.status)});
    }
  }
  return table;
}

/// The best feasible value so far against the function evaluations: a row where it improves, and one at the end of a
/// run.
Table make_progress_table(const std::vector<Run>& runs) {
  Table table(
      std::string(title) + ", progress",
      {{"problem", "-", "kind of synthesis and prescribed workspace"},
       {"formulation", "-", "area or pointwise"},
       {"solver", "-", "name of the solver"},
       {"N_f", "-", "function evaluations, finite differences counted in"},
       {"f", "-", "largest of the smallest inverse condition numbers of feasible points so far, if there are any"}});
  for (const Run& run : runs) {
    double best = std::numeric_limits<double>::infinity();
    const auto add = [&](long evaluations) {
      table.add_row({run.formulated->task, run.formulated->formulation, run.solver, evaluations,
                     std::isfinite(best) ? Field(-best) : Field()});
    };
    for (const Iterate& iterate : run.result.history) {
      if (iterate.violation > run.formulated->feasibility_tolerance() || !(iterate.f < best)) continue;
      best = iterate.f;
      add(iterate.counts.function_evaluations());
    }
    add(run.result.counts.function_evaluations());
  }
  return table;
}

/// Per formulation and solver, over all problems.
Table make_summary_table(const std::vector<Run>& runs, const Settings& settings) {
  Table table(std::string(title) + ", by solver",
              {{"formulation", "-", "area or pointwise"},
               {"solver", "-", "name of the solver"},
               {"problems", "-", "number of problems"},
               {"solved", "-", "problems solved"},
               {"claimed", "-", "runs of which the solver says that they converged"},
               {"false_successes", "-", "runs among them of which no point meets the target"},
               {"N_f", "-", "function evaluations until the target was met, mean over the problems solved"},
               {"N_g", "-", "gradient evaluations until the target was met, mean over the problems solved"}},
              {fmt::format("At the relative error {}.", settings.main_target)});
  for (const std::string& formulation : settings.formulations) {
    for (const std::string& solver : settings.solvers) {
      int problems = 0, solved = 0, claimed = 0, false_successes = 0;
      double functions = 0.0, gradients = 0.0;
      for (const Run& run : runs) {
        if (run.solver != solver || run.formulated->formulation != formulation) continue;
        const Judgement judgement = judge_relatively(run.result, best_known(runs, *run.formulated),
                                                     {settings.main_target, run.formulated->feasibility_tolerance()});
        ++problems;
        claimed += judgement.claimed;
        false_successes += judgement.false_success();
        if (!judgement.solved) continue;
        ++solved;
        functions += static_cast<double>(judgement.counts.function_evaluations());
        gradients += static_cast<double>(judgement.counts.gradient_evaluations());
      }
      if (problems == 0) continue;
      const auto mean = [&](double sum) { return solved > 0 ? Field(sum / solved) : Field(); };
      table.add_row(
          {formulation, solver, problems, solved, claimed, false_successes, mean(functions), mean(gradients)});
    }
  }
  return table;
}

/// Best value against cost, one panel for each problem of the first formulation, those of a kind in a row.
Figure draw_progress(const Table& progress) {
  const Table pictured = progress.where("formulation", progress.text(0, "formulation"));
  const std::vector<std::string> problems = pictured.distinct("problem");
  const std::vector<std::string> solvers = pictured.distinct("solver");
  const std::vector<double> costs = pictured.numbers("N_f");
  const double largest_cost = *std::max_element(costs.begin(), costs.end());
  const auto kind_of = [](const std::string& problem) { return problem.substr(0, problem.find('-')); };
  const auto in_row = static_cast<std::size_t>(std::count_if(
      problems.begin(), problems.end(), [&](const auto& one) { return kind_of(one) == kind_of(problems.front()); }));
  const std::size_t rows = problems.size() / in_row;

  constexpr double panel_width = 196.0, panel_height = 220.0, left = 90.0, gap = 26.0, key_width = 252.0;  // points
  constexpr double bottom = 64.0, top = 34.0, title_height = 48.0;
  const auto columns = static_cast<double>(in_row);
  const auto lines = static_cast<double>(rows);
  const double width = left + columns * panel_width + (columns - 1.0) * gap + key_width;
  const double height = bottom + lines * panel_height + (lines - 1.0) * title_height + top;
  Figure figure(static_cast<int>(width), static_cast<int>(height));
  figure.add("set logscale x");
  figure.add(fmt::format("set xrange [1:{}]", largest_cost));
  figure.add("set xtics (1, 10, 100, 1000, 10000)");
  figure.add(fmt::format("set multiplot layout {},{} margins {}, {}, {}, {} spacing {}, {}", rows, in_row, left / width,
                         1.0 - key_width / width, bottom / height, 1.0 - top / height, gap / width,
                         title_height / height));
  // What is below a start that is none of the worst is not worth the room.
  constexpr double shown = 0.2;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const bool first_in_row = i % in_row == 0;
    if (first_in_row) {
      double most = 0.0;
      for (std::size_t row = 0; row < pictured.rows(); ++row) {
        if (kind_of(pictured.text(row, "problem")) != kind_of(problems[i]) || pictured.text(row, "f").empty()) continue;
        most = std::max(most, pictured.number(row, "f"));
      }
      figure.add(fmt::format("set yrange [{}:{}]", most - shown, most + 0.05 * shown));
    }
    figure.add(i / in_row == rows - 1 ? "set format x '%g'\nset xlabel 'function evaluations'"
                                      : "set format x ''\nunset xlabel");
    figure.add(fmt::format("set title {} offset 0,-0.4",
                           gnuplot_string(fmt::format("({}) {}", static_cast<char>('a' + i), problems[i]))));
    figure.add(first_in_row ? "set ylabel 'best smallest κ⁻¹ so far [-]' offset 0.5,0\nset format y '%g'"
                            : "unset ylabel\nset format y ''");
    figure.add(i == in_row - 1
                   ? fmt::format("set key at screen {}, screen {} left top vertical Left reverse samplen 2.5 "
                                 "spacing 1.3 noenhanced",
                                 1.0 - (key_width - 12.0) / width, 1.0 - top / height)
                   : "unset key");
    const Table panel = pictured.where("problem", problems[i]);
    std::string command = "plot ";
    for (const std::string& solver : solvers) {
      const Table run = panel.where("solver", solver);
      std::vector<std::vector<double>> points;
      for (std::size_t row = 0; row < run.rows(); ++row) {
        if (!run.text(row, "f").empty()) points.push_back({run.number(row, "N_f"), run.number(row, "f")});
      }
      // Without a feasible point there is nothing to draw but the entry in the key.
      if (points.empty()) points.push_back({largest_cost, 2.0});
      command += fmt::format("{} using 1:2 with steps {} title {}, ", figure.add_data(points), line_style(solver),
                             gnuplot_string(shown_name(solver)));
    }
    command.resize(command.size() - 2);
    figure.add(command);
  }
  figure.add("unset multiplot");
  return figure;
}

std::string summarise(const Table& table) {
  std::string text = fmt::format("{:<10} {:<22} {:>6} {:>3} {:>8} {:>16} {:>9} {:>7}\n", "", "solver", "solved", "of",
                                 "claimed", "false successes", "N_f", "N_g");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto mean = [&](const char* column) {
      return table.text(row, column).empty() ? "" : fmt::format("{:.0f}", table.number(row, column));
    };
    text += fmt::format("{:<10} {:<22} {:>6} {:>3} {:>8} {:>16} {:>9} {:>7}\n", table.text(row, "formulation"),
                        table.text(row, "solver"), table.text(row, "solved"), table.text(row, "problems"),
                        table.text(row, "claimed"), table.text(row, "false_successes"), mean("N_f"), mean("N_g"));
  }
  return text;
}

}  // namespace
}  // namespace reprise::experiments

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;

  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  settings.declare(experiment.options());

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        if (session.quick()) {
          settings.max_evaluations = std::min(settings.max_evaluations, 60L);
          settings.points = std::min(settings.points, 40L);
          settings.workspaces.resize(1);
        }
        const std::vector<Formulated> problems = formulate_all(settings);
        std::vector<std::pair<const Formulated*, std::string>> chosen;
        for (const Formulated& formulated : problems) {
          for (const std::string& solver : settings.solvers) {
            if (Settings::is_run(solver, formulated.formulation)) chosen.emplace_back(&formulated, solver);
          }
        }
        Progress progress(chosen.size());
        std::vector<Run> runs;
        std::map<std::string, double> seconds;
        for (const auto& [formulated, solver] : chosen) {
          progress.begin(fmt::format("{}, {}, {}", formulated->task, formulated->formulation, solver));
          const SynthesisProblem& synthesis = formulated->synthesis;
          Options options = synthesis.options;
          options.max_function_evaluations = settings.max_evaluations;
          const auto begin = std::chrono::steady_clock::now();
          runs.push_back({formulated, solver,
                          make_solver(solver, formulation_called(formulated->formulation), formulated->settings)
                              ->minimize(synthesis.problem, synthesis.start, options)});
          const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
          seconds[formulated->formulation + " " + solver] += taken.count();
        }
        const Table summary = make_summary_table(runs, settings);
        session.write(make_runs_table(runs, settings));
        session.write(summary, "solvers");
        session.write(make_progress_table(runs), "progress");
        for (const auto& [what, time] : seconds) session.record(what, time);
        fmt::print("{}", summarise(summary));
      },
      [](Session& session) { session.draw(draw_progress(session.table("progress")), "progress"); });
}
