// reprise synthesize: the best conditioned design for a prescribed workspace.

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>

#include "global_proof.hpp"
#include "reprise/base/require.hpp"
#include "reprise/bounds/global_optimum.hpp"
#include "reprise/io/interruption.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/study/reach_search.hpp"
#include "reprise/study/synthesis_advice.hpp"
#include "reprise/study/synthesis_documents.hpp"
#include "reprise/study/workspace_map.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "synthesis_commands.hpp"

namespace reprise::app {

namespace {

class SynthesizeCommand final : public Command {
 public:
  SynthesizeCommand()
      : Command(
            "synthesize", "The best conditioned design that reaches a prescribed workspace",
            "Varies what the problem's table [design] leaves free until the manipulator reaches the whole prescribed\n"
            "workspace at the prescribed orientations, and the least inverse condition number there is as large as\n"
            "possible: SO synthesis for one orientation, MO for several, D for a range. Both are proved for the\n"
            "design found, over the whole workspace, inside and outline, and over the whole range. The optimizer\n"
            "finds a local optimum; --starts tries further, random starts. For manipulators of the thesis's family\n"
            "a proof follows that no design is better, or it finds a better one. It ends unsettled where it would\n"
            "take much more than a second; --prove goes on until it is settled. --time and Ctrl-C end the search\n"
            "with the best so far. --out writes manipulator.toml (the design found, a file for the other commands),\n"
            "history.csv (the designs on the way), runs.csv, and the certificates of the proof for reprise check.",
            "reprise synthesize examples/P2.toml\n"
            "reprise synthesize examples/rectangle.toml --starts 10 --out results --plot found.svg\n"
            "reprise synthesize examples/P1.toml --optimizer dynamic_q --formulation area --json") {
    options().choice("--optimizer", optimizer_, synthesis_solver_names(),
                     "the optimizer; ipopt, with exact Hessians, takes tens of times as long as ipopt_lbfgs here");
    options().integer("--starts", starts_, 1, 10'000, "number of starts; the first is the manipulator of the file");
    options().flag("--prove", prove_, "go on with the proof that no design is better, however long it takes");
    options().flag("--no-prove", leave_unproved_, "leave out the proof that no design is better");
    options().number("--gap", gap_, NumberRange::between(1e-8, 1.0), "between the design and the bound that is proved");
    settings_.declare(options());
    draws();
    std::vector<std::string> names{"manipulator.toml", "history.csv", "runs.csv"};
    names.insert(names.end(), certificate_files.begin(), certificate_files.end());
    writes_files(names);
  }

 private:
  Output compute() override {
    require(!prove_ || !leave_unproved_, "--no-prove", "given", "left out beside --prove");
    problem_ = read_problem(file());
    const std::optional<std::string> obstacle = leave_unproved_ ? std::nullopt : not_provable(*problem_);
    if (prove_ && obstacle) throw std::invalid_argument(*obstacle);
    const ScaledProblem scaled = scale(*problem_);
    const NamedSolver named = settings_.solvers({optimizer_}).front();
    const PolledInterruption polled;
    const Stop stop(settings_.time);
    const std::function<bool()> stopped = [&stop] { return stop(); };
    std::vector<SynthesisOutcome> runs;
    {
      Progress progress(static_cast<std::size_t>(starts_));
      const auto from = [&](const Eigen::VectorXd& start) {
        return solve(scaled, settings_, named, start, stop, progress);
      };
      for (const Eigen::VectorXd& start : make_starts(scaled, starts_, settings_.seed)) {
        progress.begin(fmt::format("start {}", runs.size() + 1));
        runs.push_back(solve_where_reached(scaled, named.name, start, stopped, from));
        if (stop()) break;
      }
      const bool reached =
          std::any_of(runs.begin(), runs.end(), [](const SynthesisOutcome& run) { return run.reaches(); });
      if (!reached && !stop()) {
        progress.begin("further starts");
        runs.push_back(solve_from_further_starts(scaled, named.name, settings_.seed, stopped, from));
      }
    }
    const std::string cut_short = stop.reason();
    SynthesisOutcome best = *std::min_element(runs.begin(), runs.end(), better);
    const DesignProof before = prove(scaled, scaled.start);
    std::string ending = ending_text(best);
    std::optional<GlobalProof> global;
    if (!leave_unproved_ && !obstacle && cut_short.empty()) {
      const double reached = best.reaches() ? best.proof.kappa_inverse.lower : 0.0;
      const long most_boxes = prove_ ? GlobalOptions().max_boxes : unasked_boxes;
      global = prove_globally(*problem_, file(), gap_, reached, most_boxes, stopped);
      if (global->design && (!best.reaches() || global->lower > reached + gap_)) {
        best.design = *global->design / scaled.unit;
        best.proof = prove(scaled, best.design);
        ending += "The proof found a better design than the optimizer: this one.\n";
      }
    }
    const ManipulatorInput found = found_manipulator(*problem_, best.design * scaled.unit);
    Advice advice;
    if (!best.reaches() && cut_short.empty()) {
      advice = advise(scaled, settings_, best, stopped);
    }

    Output output;
    Json& document = output.document;
    output.unit = problem_->start.unit;
    document = problem_json(*problem_, settings_);
    document.update(run_json(best, scaled.unit));
    document["cut_short"] = cut_short.empty() ? Json() : Json(cut_short);
    document["start_kappa_inv_min"] = before.kappa_inverse.upper;
    document["start_kappa_inv_min_bound"] = before.kappa_inverse.lower;
    document["start_violation"] = before.violation;
    document["kappa_inv_min_at"] = to_json(best.proof.kappa_inverse.witness->position);
    document["kappa_inv_min_orientation_deg"] = best.proof.kappa_inverse.witness->orientation / degree;
    document["kappa_inv_min_throughout"] = best.proof.kappa_inverse.upper;
    const bool violated = best.proof.violation > 0.0;
    document["violation_limit"] = violated ? Json(to_string(*best.proof.limit)) : Json();
    document["violation_at"] = violated ? to_json(best.proof.limit_at->position) : Json();
    document["violation_orientation_deg"] = violated ? Json(best.proof.limit_at->orientation / degree) : Json();
    document["advice"] = advice.document;
    document["global"] = global ? global->document : Json();
    document["history"] = history_json(best, scaled.unit);
    Json all = Json::array();
    for (const SynthesisOutcome& run : runs) all.push_back(run_json(run, scaled.unit));
    document["runs"] = all;
    document["manipulator_toml"] = to_toml(found);

    output.exit_code = best.reaches() ? 0 : 1;
    output.text = text(scaled, best, before, runs, found, cut_short, ending + (global ? global->text : ""), advice);
    output.tables = {{"history", history_table(best, scaled.unit)}, {"runs", runs_table(runs, scaled.unit)}};
    output.files = {{"manipulator.toml", to_toml(found)}};
    if (global) output.files.insert(output.files.end(), global->files.begin(), global->files.end());
    output.picture = [this, found] { return picture(found.manipulator); };
    return output;
  }

  std::string text(const ScaledProblem& scaled, const SynthesisOutcome& best, const DesignProof& before,
                   const std::vector<SynthesisOutcome>& runs, const ManipulatorInput& found,
                   const std::string& cut_short, const std::string& ending, const Advice& advice) const {
    const SynthesisTask& task = problem_->task;
    std::string text = fmt::format("{} for {}: {} synthesis, {}\noptimizer {}, {} formulation, the best of {} {}\n\n",
                                   problem_->start.manipulator.name(), task.prescribed.name(),
                                   kind_of(task.orientations), orientations_text(task.orientations), best.optimizer,
                                   settings_.formulation, runs.size(), runs.size() == 1 ? "start" : "starts");
    text += fmt::format(
        "                   start         found\nleast kappa^-1     {:<12}  {}\nviolation          {:<12}  {}\n",
        short_number(before.kappa_inverse.upper), short_number(best.proof.kappa_inverse.upper),
        short_number(before.violation), short_number(best.proof.violation));
    for (Eigen::Index i = 0; i < task.designs.size(); ++i) {
      text += fmt::format("{:<17}  {:<12}  {}\n", task.designs.names()[static_cast<std::size_t>(i)],
                          short_number(problem_->design[i]), short_number(best.design[i] * scaled.unit));
    }
    text += "\n";
    if (!cut_short.empty()) text += cut_short + ": this is the best design so far.\n";
    text += proof_text(best.proof, task.orientations) + ending;
    return text + advice.text + "\n" + to_toml(found);
  }

  Table history_table(const SynthesisOutcome& run, double unit) const {
    std::vector<Column> columns{
        {"iteration", "-", "number of the iterate, 0 for the start"},
        {"evaluations", "-", "function evaluations up to there, finite differences counted in"},
        {"kappa_inv", "-",
         "least inverse condition number at 100 points of the outline, at the slices or the ends of the range"},
        {"violation", "length", "largest violation of a limit there, at any orientation asked for"}};
    for (const std::string& name : problem_->task.designs.names()) columns.push_back({name, "length", "of the design"});
    Table table("History of the synthesis", columns);
    for (const HistoryPoint& point : run.history) {
      std::vector<Field> row{point.iteration, point.evaluations, point.kappa_inv, point.violation};
      for (const double value : point.design) row.emplace_back(value * unit);
      table.add_row(row);
    }
    return table;
  }

  Table runs_table(const std::vector<SynthesisOutcome>& runs, double unit) const {
    std::vector<Column> columns{
        {"start", "-", "number of the start"},
        {"kappa_inv_min", "-", "least inverse condition number over the whole workspace and range"},
        {"violation", "length", "largest violation of a limit there"},
        {"status", "-", "how the optimizer ended"},
        {"evaluations", "-", "function evaluations, finite differences counted in"}};
    for (const std::string& name : problem_->task.designs.names()) columns.push_back({name, "length", "design found"});
    Table table("Runs of the synthesis", columns);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const SynthesisOutcome& run = runs[k];
      std::vector<Field> row{k + 1, run.proof.kappa_inverse.upper, run.proof.violation, to_string(run.result.status),
                             run.result.counts.function_evaluations()};
      for (const double value : run.design) row.emplace_back(value * unit);
      table.add_row(row);
    }
    return table;
  }

  /// The workspace of start and found design with the prescribed one in it; over several slices, that of the design
  /// found at the first, the middle and the last. Where the centre is out of reach there is no panel.
  Figure picture(const Manipulator& found) const {
    const SynthesisTask& task = problem_->task;
    const std::vector<OrientationRange>& ranges = task.orientations;
    // The legend has no room for long names.
    constexpr std::size_t longest_name = 14;
    const PrescribedWorkspace& prescribed = task.prescribed;
    const PrescribedWorkspace named(prescribed.name().size() <= longest_name ? prescribed.name() : "prescribed",
                                    prescribed.shape(), prescribed.placement());
    std::vector<MapPanel> panels;
    const auto add = [&](const std::string& title, const Manipulator& manipulator, const OrientationRange& range) {
      const DextrousLimits limits(manipulator, range);
      Eigen::VectorXd h(limits.count());
      limits.evaluate(task.prescribed.centre(), h);
      if (h.maxCoeff() >= 0.0) return;
      panels.push_back({title, manipulator, range, {named}, task.conditioning});
    };
    if (ranges.size() == 1) {
      add("start", problem_->start.manipulator, ranges.front());
      add("found", found, ranges.front());
    } else {
      std::vector<std::size_t> chosen{0, ranges.size() / 2, ranges.size() - 1};
      chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
      for (const std::size_t k : chosen) {
        add(fmt::format("found, {}°", short_number(ranges[k].lower / degree)), found, ranges[k]);
      }
    }
    if (panels.empty())
      return draw_poses(found, {{task.prescribed.centre(), ranges.front().lower}}, problem_->start.column_unit());
    double longest = 0.0;
    for (const Leg& leg : found.legs()) longest = std::max(longest, leg.length.upper);
    const MapOptions options{.chord = longest / 200.0, .unit = problem_->start.column_unit()};
    return draw_map(compute_map("synthesis", panels, options));
  }

  std::string optimizer_ = "dynamic_q_safeguarded";
  long starts_ = 1;
  bool prove_ = false;
  bool leave_unproved_ = false;
  double gap_ = 1e-6;
  SynthesisSettings settings_;
  std::optional<ProblemInput> problem_;
};

}  // namespace

std::unique_ptr<Command> synthesize_command() { return std::make_unique<SynthesizeCommand>(); }

}  // namespace reprise::app
