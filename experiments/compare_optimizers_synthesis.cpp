// Every optimizer on the thesis's own problems: which of them finds the best conditioned design, and at what cost.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "reprise/synthesis/synthesis.hpp"
#include "support/data_files.hpp"
#include "support/experiment.hpp"
#include "support/files.hpp"
#include "support/judge.hpp"
#include "support/progress.hpp"
#include "support/solvers.hpp"

namespace reprise::experiments {
namespace {

constexpr const char* title = "Optimizers on the synthesis";

/// A kind of synthesis: the slices, and the manipulator whose design is the start. Another kind that the two
/// formulations can express is one more line.
struct Kind {
  std::string name;
  std::string manipulator;
  std::vector<double> orientations_deg;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"SO", "M1", {0.0}}};
  return all;
}

struct Settings {
  std::vector<std::string> workspaces{"P1", "P2", "P3"};
  std::vector<std::string> formulations{"area", "pointwise"};
  std::vector<std::string> solvers = solver_names();
  std::vector<double> targets{1e-2, 1e-3, 1e-4};
  double main_target = 1e-3;
  double difference_step = 1e-6;
  double chord = 0.02;
  double area_tolerance = 1e-5;
  double pointwise_tolerance = 1e-7;
  long points = 100;
  long max_evaluations = 20'000;
  SolverSettings area_solvers, pointwise_solvers;

  Settings() {
    area_solvers.move_limit = pointwise_solvers.move_limit = 0.1;
    // The thesis's, and with smooth functions what they allow.
    area_solvers.step_tolerance = 1e-4;
    area_solvers.value_tolerance = 1e-6;
    pointwise_solvers.step_tolerance = 1e-6;
    pointwise_solvers.value_tolerance = 1e-8;
    area_solvers.search_radius = pointwise_solvers.search_radius = 1.0;
  }

  void declare(Options& options) {
    options.choices("--workspace", workspaces, workspaces, "prescribed workspaces");
    options.choices("--formulation", formulations, formulations, "formulations of the synthesis");
    options.choices("--solver", solvers, solvers, "optimizers");
    options.numbers("--target", targets, NumberRange::positive(), "relative errors of the objective to be met");
    options.number("--main-target", main_target, NumberRange::positive(), "the relative error behind the summary");
    options.number("--difference-step", difference_step, NumberRange::positive(),
                   "Gamma, the interval of forward differences, area formulation, length");
    options.number("--chord", chord, NumberRange::positive(), "d, the chord length, length");
    options.number("--area-tolerance", area_tolerance, NumberRange::positive(),
                   "g at most this counts as feasible, area formulation, length^2");
    options.number("--pointwise-tolerance", pointwise_tolerance, NumberRange::positive(),
                   "largest violation that counts as feasible, pointwise formulation");
    options.integer("--points", points, 3, 100'000, "outline points of the pointwise formulation");
    options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on N_f of a run");
  }
};

/// A task in one formulation.
struct Formulated {
  std::string task;
  std::string formulation;
  Problem problem;
  Eigen::VectorXd start;
  reprise::Options options;
};

std::vector<Formulated> formulate(const Settings& settings) {
  std::vector<Formulated> all;
  for (const Kind& kind : kinds()) {
    const CollinearManipulator manipulator = read_manipulator(data_folder() / "manipulators.toml", kind.manipulator);
    std::vector<double> orientations;
    for (const double degrees : kind.orientations_deg) orientations.push_back(degrees * std::numbers::pi / 180.0);
    for (const SourcedWorkspace& sourced :
         read_prescribed_workspaces(data_folder() / "prescribed_workspaces.toml", kind.name)) {
      const std::string& name = sourced.workspace.name();
      if (std::find(settings.workspaces.begin(), settings.workspaces.end(), name) == settings.workspaces.end()) {
        continue;
      }
      const SynthesisTask task{sourced.workspace,
                               slices(orientations),
                               DesignSpace::collinear(manipulator.lengths),
                               {Normalisation::printed, {}}};
      for (const std::string& formulation : settings.formulations) {
        Formulated one{kind.name + "-" + name, formulation, {}, to_vector(manipulator.design), {}};
        one.options.max_function_evaluations = settings.max_evaluations;
        if (formulation == "area") {
          one.problem = AreaFormulation(task, {.chord_length = settings.chord}).problem();
          one.options.derivatives = Derivatives::forward;
          one.options.difference_step = settings.difference_step;
          one.options.feasibility_tolerance = settings.area_tolerance;
        } else {
          const PointwiseOptions options{static_cast<int>(settings.points)};
          one.problem = pointwise_problem(task, options);
          one.start = pointwise_start(task, one.start, options);
          one.options.feasibility_tolerance = settings.pointwise_tolerance;
        }
        all.push_back(std::move(one));
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
      if (violation <= formulated.options.feasibility_tolerance) best = std::min(best, f);
    };
    for (const Iterate& iterate : run.result.history) include(iterate.f, iterate.violation);
    include(run.result.f, run.result.violation);
  }
  return best;
}

/// f is between -1 and 0, so that the judge's error, over max(1, |f*|), would be absolute.
Verdict judge_relatively(const Result& result, double best, const Target& target) {
  Verdict verdict = judge(result, best, {target.f_error * std::abs(best), target.violation});
  verdict.f_error /= std::abs(best);
  return verdict;
}

Table make_runs_table(const std::vector<Run>& runs, const Settings& settings) {
  Table table(title,
              {{"problem", "-", "kind of synthesis and prescribed workspace (reconstructed, not published)"},
               {"formulation", "-", "area: the thesis's, eqs. (5.34), (5.35); pointwise: limits at outline points"},
               {"solver", "-", "name of the solver"},
               {"target", "-", "largest relative error of f against the best point of all runs of this formulation"},
               {"solved", "-", "1 when a point of the run met the target, else 0"},
               {"N_g", "-", "gradient evaluations until then, or of the whole run"},
               {"N_f", "-", "function evaluations until then, or of the whole run, finite differences counted in"},
               {"f", "-", "smallest inverse condition number at that point, or at the result"},
               {"f_error", "-", "its relative error"},
               {"violation", "-", "its largest violation: g of (5.35), an area, or the pointwise limits"},
               {"status", "-", "what the solver says of its end"}},
              {fmt::format("A target also demands a violation of at most {} (area) or {} (pointwise).",
                           settings.area_tolerance, settings.pointwise_tolerance)});
  for (const Run& run : runs) {
    const Formulated& formulated = *run.formulated;
    const double best = best_known(runs, formulated);
    for (const double f_error : settings.targets) {
      const Verdict verdict = judge_relatively(run.result, best, {f_error, formulated.options.feasibility_tolerance});
      table.add_row({formulated.task, formulated.formulation, run.solver, f_error, static_cast<int>(verdict.solved),
                     verdict.counts.gradient_evaluations(), verdict.counts.function_evaluations(), -verdict.f,
                     verdict.f_error, verdict.violation, to_string(run.result.status)});
    }
  }
  return table;
}

/// What the chapter says of evolutionary algorithms, measured: their function evaluations against those of Dynamic-Q,
/// where both meet a target.
Table make_evolution_table(const std::vector<Run>& runs, const Settings& settings) {
  Table table(std::string(title) + ", evolution strategy against Dynamic-Q",
              {{"problem", "-", "kind of synthesis and prescribed workspace"},
               {"formulation", "-", "area or pointwise"},
               {"target", "-", "largest relative error of f"},
               {"N_f_dynamic_q", "-", "function evaluations of dynamic_q; empty where it does not meet the target"},
               {"N_f_isres", "-", "function evaluations of isres; empty where it does not meet the target"},
               {"ratio", "-", "the second over the first"}});
  for (const Run& evolution : runs) {
    if (evolution.solver != "isres") continue;
    const Formulated& formulated = *evolution.formulated;
    const double best = best_known(runs, formulated);
    for (const double f_error : settings.targets) {
      const auto evaluations = [&](const std::string& solver) -> std::optional<long> {
        for (const Run& run : runs) {
          if (run.formulated != &formulated || run.solver != solver) continue;
          const Verdict verdict =
              judge_relatively(run.result, best, {f_error, formulated.options.feasibility_tolerance});
          if (verdict.solved) return verdict.counts.function_evaluations();
        }
        return std::nullopt;
      };
      const std::optional<long> ours = evaluations("dynamic_q");
      const std::optional<long> theirs = evaluations("isres");
      const auto field = [](const std::optional<long>& value) { return value ? Field(*value) : Field(); };
      table.add_row({formulated.task, formulated.formulation, f_error, field(ours), field(theirs),
                     ours && theirs ? Field(static_cast<double>(*theirs) / static_cast<double>(*ours)) : Field()});
    }
  }
  return table;
}

/// The best feasible value so far against the function evaluations, row by row where it improves.
Table make_progress_table(const std::vector<Run>& runs) {
  Table table(std::string(title) + ", progress",
              {{"problem", "-", "kind of synthesis and prescribed workspace"},
               {"formulation", "-", "area or pointwise"},
               {"solver", "-", "name of the solver"},
               {"N_f", "-", "function evaluations, finite differences counted in"},
               {"f", "-", "largest of the smallest inverse condition numbers of feasible points so far"}});
  for (const Run& run : runs) {
    double best = std::numeric_limits<double>::infinity();
    for (const Iterate& iterate : run.result.history) {
      if (iterate.violation > run.formulated->options.feasibility_tolerance || !(iterate.f < best)) continue;
      best = iterate.f;
      table.add_row({run.formulated->task, run.formulated->formulation, run.solver,
                     iterate.counts.function_evaluations(), -best});
    }
  }
  return table;
}

/// Per formulation and solver, over all problems.
Table make_summary_table(const std::vector<Run>& runs, const std::vector<NamedSolver>& solvers,
                         const Settings& settings) {
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
    for (const NamedSolver& named : solvers) {
      int problems = 0, solved = 0, claimed = 0, false_successes = 0;
      double functions = 0.0, gradients = 0.0;
      for (const Run& run : runs) {
        if (run.solver != named.name || run.formulated->formulation != formulation) continue;
        const Verdict verdict = judge_relatively(run.result, best_known(runs, *run.formulated),
                                                 {settings.main_target, run.formulated->options.feasibility_tolerance});
        ++problems;
        claimed += verdict.claimed;
        false_successes += verdict.false_success();
        if (!verdict.solved) continue;
        ++solved;
        functions += static_cast<double>(verdict.counts.function_evaluations());
        gradients += static_cast<double>(verdict.counts.gradient_evaluations());
      }
      const auto mean = [&](double sum) { return solved > 0 ? Field(sum / solved) : Field(); };
      table.add_row(
          {formulation, named.name, problems, solved, claimed, false_successes, mean(functions), mean(gradients)});
    }
  }
  return table;
}

/// Best value against cost, area formulation, one panel for each problem.
Figure draw_progress(const Table& progress, double largest_cost) {
  const Table area = progress.where("formulation", "area");
  const std::vector<std::string> panels = area.distinct("problem");
  constexpr double panel_width = 270.0, left = 90.0, gap = 26.0, key_width = 232.0;  // points
  const auto columns = static_cast<double>(panels.size());
  const double width = left + columns * panel_width + (columns - 1.0) * gap + key_width;
  Figure figure(static_cast<int>(width), 360);
  // What is below a start that is none of the worst is not worth the room.
  const std::vector<double> values = area.numbers("f");
  const double most = *std::max_element(values.begin(), values.end());
  constexpr double shown = 0.2;
  figure.add("set logscale x");
  figure.add(fmt::format("set xrange [1:{}]", largest_cost));
  figure.add("set xtics (1, 10, 100, 1000, '10000' 10000)");
  figure.add(fmt::format("set yrange [{}:{}]", most - shown, most + 0.05 * shown));
  figure.add("set xlabel 'function evaluations N_f' noenhanced");
  figure.add(fmt::format("set multiplot layout 1,{} margins {}, {}, 0.19, 0.9 spacing {}, 0", panels.size(),
                         left / width, 1.0 - key_width / width, gap / width));
  char letter = 'a';
  for (const std::string& panel : panels) {
    const Table rows = area.where("problem", panel);
    figure.add(fmt::format("set title {} offset 0,-0.4", gnuplot_string(fmt::format("({}) {}", letter++, panel))));
    figure.add(panel == panels.front() ? "set ylabel 'best smallest κ⁻¹ so far [-]' offset 0.5,0"
                                       : "unset ylabel\nset format y ''");
    figure.add(panel == panels.back()
                   ? fmt::format("set key at screen {}, screen 0.9 left top Left reverse samplen 2.5 spacing 1.3 "
                                 "noenhanced",
                                 1.0 - (key_width - 12.0) / width)
                   : "unset key");
    std::string command = "plot ";
    for (const std::string& solver : area.distinct("solver")) {
      const Table line = rows.where("solver", solver);
      std::vector<std::vector<double>> points;
      for (std::size_t row = 0; row < line.rows(); ++row) {
        points.push_back({line.number(row, "N_f"), line.number(row, "f")});
      }
      // Without a feasible point there is nothing to draw but the entry in the key.
      if (points.empty()) points.push_back({largest_cost, most + shown});
      points.push_back({largest_cost, points.back()[1]});
      command += fmt::format("{} using 1:2 with steps {} title {}, ", figure.add_data(points), line_style(solver),
                             gnuplot_string(solver));
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
    text += fmt::format("{:<10} {:<22} {:>6} {:>3} {:>8} {:>16} {:>9.7} {:>7.5}\n", table.text(row, "formulation"),
                        table.text(row, "solver"), table.text(row, "solved"), table.text(row, "problems"),
                        table.text(row, "claimed"), table.text(row, "false_successes"), table.text(row, "N_f"),
                        table.text(row, "N_g"));
  }
  return text;
}

}  // namespace
}  // namespace reprise::experiments

int main(int argc, char** argv) {
  using namespace reprise::experiments;

  Experiment experiment("compare_optimizers_synthesis", title);
  Settings settings;
  settings.declare(experiment.options());

  return experiment.run(argc, argv, [&](Session& session) {
    if (session.quick()) {
      settings.max_evaluations = std::min(settings.max_evaluations, 200L);
      settings.points = std::min(settings.points, 60L);
      settings.workspaces.resize(1);
    }
    settings.area_solvers.max_points = settings.pointwise_solvers.max_points = settings.max_evaluations;
    const std::vector<Formulated> problems = formulate(settings);
    Progress progress(problems.size() * settings.solvers.size());
    std::vector<Run> runs;
    std::map<std::string, double> seconds;
    for (const Formulated& formulated : problems) {
      const bool area = formulated.formulation == "area";
      for (const NamedSolver& named :
           select_solvers(settings.solvers, area ? settings.area_solvers : settings.pointwise_solvers)) {
        progress.begin(fmt::format("{}, {}, {}", formulated.task, formulated.formulation, named.name));
        const auto begin = std::chrono::steady_clock::now();
        runs.push_back({&formulated, named.name,
                        named.solver->minimize(formulated.problem, formulated.start, formulated.options)});
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        seconds[formulated.formulation + " " + named.name] += taken.count();
      }
    }
    const Table summary = make_summary_table(runs, select_solvers(settings.solvers, settings.area_solvers), settings);
    session.write(make_runs_table(runs, settings));
    session.write(summary, "solvers");
    session.write(make_evolution_table(runs, settings), "evolution");
    const Table progress_table = make_progress_table(runs);
    session.write(progress_table, "progress");
    const auto& formulations = settings.formulations;
    if (std::find(formulations.begin(), formulations.end(), "area") != formulations.end()) {
      session.draw(draw_progress(progress_table, static_cast<double>(settings.max_evaluations)), "progress");
    }
    for (const auto& [what, time] : seconds) session.record(what, time);
    fmt::print("{}", summarise(summary));
  });
}
