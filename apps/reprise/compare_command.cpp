// reprise compare: the same synthesis by all optimizers.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "reprise/io/interruption.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/study/synthesis_documents.hpp"
#include "synthesis_commands.hpp"

namespace reprise::app {

namespace {

class CompareCommand final : public Command {
 public:
  CompareCommand()
      : Command("compare", "The same synthesis by all optimizers",
                "Solves a problem as synthesize does, by every optimizer from the same start, and judges the designs "
                "alike:\n"
                "least inverse condition number and violation over the whole workspace and range, evaluations, time.",
                "reprise compare examples/P2.toml\n"
                "reprise compare examples/rectangle.toml --optimizer slsqp,ipopt_lbfgs,dynamic_q --plot progress.svg\n"
                "reprise compare examples/P3.toml --formulation area --out results --json") {
    options().choices("--optimizer", optimizers_, synthesis_solver_names(), "the optimizers");
    settings_.declare(options());
    draws();
    writes_files({"comparison.csv", "history.csv"});
  }

 private:
  Output compute() override {
    const ProblemInput problem = read_problem(file());
    const ScaledProblem scaled = scale(problem);
    const PolledInterruption polled;
    const Stop stop(settings_.time);
    std::vector<SynthesisOutcome> runs;
    {
      Progress progress(optimizers_.size());
      for (const NamedSolver& named : settings_.solvers(optimizers_)) {
        progress.begin(named.name);
        runs.push_back(solve(scaled, settings_, named, scaled.start, stop, progress));
        if (stop()) break;
      }
    }
    const std::string cut_short = stop.reason();
    Output output;
    output.unit = problem.start.unit;
    output.document = problem_json(problem, settings_);
    Json list = Json::array();
    Table table(
        "Comparison of optimizers",
        {{"optimizer", "-", "name of the optimizer"},
         {"kappa_inv_min", "-", "least inverse condition number over the whole workspace and range"},
         {"violation", "length", "largest violation of a limit there"},
         {"reaches_workspace", "-", "1 when it is proved that the design reaches the prescribed workspace, else 0"},
         {"status", "-", "how the optimizer ended"},
         {"evaluations", "-", "function evaluations, finite differences counted in"},
         {"gradient_evaluations", "-", "gradient evaluations"}});
    Table history(
        "History of the comparison",
        {{"optimizer", "-", "name of the optimizer"},
         {"evaluations", "-", "function evaluations, finite differences counted in"},
         {"kappa_inv", "-",
          "least inverse condition number at 100 points of the outline, at the slices or the ends of the range"},
         {"violation", "length", "largest violation of a limit there, at any orientation asked for"}});
    output.text = fmt::format("{} for {}: {} synthesis, {}, {} formulation\n\n", problem.start.manipulator.name(),
                              problem.task.prescribed.name(), kind_of(problem.task.orientations),
                              orientations_text(problem.task.orientations), settings_.formulation);
    output.text +=
        "optimizer              least kappa^-1  violation     reaches  status             evaluations  gradients  "
        "seconds\n";
    for (const SynthesisOutcome& run : runs) {
      Json one = run_json(run, scaled.unit);
      one["seconds"] = run.seconds;
      one["history"] = history_json(run, scaled.unit);
      list.push_back(one);
      const Counts& counts = run.result.counts;
      table.add_row({run.optimizer, run.proof.kappa_inverse.upper, run.proof.violation, static_cast<int>(run.reaches()),
                     to_string(run.result.status), counts.function_evaluations(), counts.gradient_evaluations()});
      for (const HistoryPoint& point : run.history) {
        history.add_row({run.optimizer, point.evaluations, point.kappa_inv, point.violation});
      }
      output.text += fmt::format("{:<22} {:<15} {:<13} {:<8} {:<18} {:>11} {:>10} {:>8.4g}\n", run.optimizer,
                                 short_number(run.proof.kappa_inverse.upper), short_number(run.proof.violation),
                                 reach_word(run.proof), to_string(run.result.status), counts.function_evaluations(),
                                 counts.gradient_evaluations(), run.seconds);
    }
    if (!cut_short.empty()) {
      output.text += fmt::format("\n{}: these are the best designs so far of {} of {} optimizers.\n", cut_short,
                                 runs.size(), optimizers_.size());
    }
    const bool reached =
        std::any_of(runs.begin(), runs.end(), [](const SynthesisOutcome& run) { return run.reaches(); });
    if (!reached) {
      output.text +=
          "\nNo design was found that reaches the workspace; reprise synthesize says what would have to give.\n";
    }
    output.exit_code = reached && runs.size() == optimizers_.size() ? 0 : 1;
    output.document["cut_short"] = cut_short.empty() ? Json() : Json(cut_short);
    output.document["runs"] = list;
    output.tables = {{"comparison", table}, {"history", history}};
    output.picture = [runs, tolerance = reach_tolerance * scaled.unit] {
      std::vector<ProgressCurve> curves;
      for (const SynthesisOutcome& run : runs) {
        ProgressCurve& curve = curves.emplace_back(ProgressCurve{run.optimizer, {}});
        double best = -std::numeric_limits<double>::infinity();
        for (const HistoryPoint& point : run.history) {
          if (point.violation > tolerance || point.kappa_inv <= best) continue;
          best = point.kappa_inv;
          curve.points.emplace_back(static_cast<double>(std::max(1L, point.evaluations)), best);
        }
      }
      return draw_progress(curves);
    };
    return output;
  }

  std::vector<std::string> optimizers_ = synthesis_solver_names();
  SynthesisSettings settings_;
};

}  // namespace

std::unique_ptr<Command> compare_command() { return std::make_unique<CompareCommand>(); }

}  // namespace reprise::app
