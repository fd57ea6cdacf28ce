// reprise synthesize, reprise compare: the best conditioned design for a prescribed workspace.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "command.hpp"
#include "drawing.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "support/progress.hpp"
#include "support/solvers.hpp"
#include "support/workspace_map.hpp"

namespace reprise::app {

namespace {

using experiments::Field;
using experiments::NamedSolver;
using experiments::NumberRange;
using experiments::Progress;
using experiments::Table;

/// Points of the outline, and orientations of a range, at which final designs are judged.
constexpr int judged_points = 2000;
constexpr int judged_orientations = 21;

/// A design reaches the workspace when no limit is violated there by more than this, in units.
constexpr double reach_tolerance = 1e-4;

/// The thesis's settings, in units: the area g that counts as none, chord length and difference interval.
constexpr double area_tolerance = 1e-5;
constexpr double area_chord = 0.02;
constexpr double area_difference = 1e-6;
/// For the pointwise formulation, whose functions are smooth.
constexpr double pointwise_tolerance = 1e-7;

/// How far from the file's design, in units, further starts may be along a variable that has no bounds.
constexpr double start_spread = 0.25;

/// A problem with lengths counted in a unit in which the longest leg is 2, as the thesis has it, so that tolerances and
/// move limits fit a manipulator of any size. The printed normalisation depends on the unit of length; there the unit
/// is that of the file.
struct ScaledProblem {
  double unit;
  SynthesisTask task;
  Eigen::VectorXd start;
};

double unit_of(const ManipulatorInput& input) {
  if (input.conditioning.normalisation == Normalisation::printed) return 1.0;
  double longest = 0.0;
  for (const Leg& leg : input.manipulator.legs()) longest = std::max(longest, leg.length.upper);
  return longest / 2.0;
}

ScaledProblem scale(const ProblemInput& problem) {
  const double unit = unit_of(problem.start);
  const DesignSpace& designs = problem.task.designs;
  std::vector<Leg> legs = designs.origin().legs();
  for (Leg& leg : legs) {
    leg.base_joint /= unit;
    leg.platform_joint /= unit;
    leg.length = {leg.length.lower / unit, leg.length.upper / unit};
  }
  const PrescribedWorkspace& prescribed = problem.task.prescribed;
  Placement placement = prescribed.placement();
  placement.centre /= unit;
  placement.scale /= unit;
  Conditioning conditioning = problem.task.conditioning;
  if (conditioning.characteristic_length) *conditioning.characteristic_length /= unit;
  return {unit,
          {PrescribedWorkspace(prescribed.name(), prescribed.shape(), placement), problem.task.orientations,
           DesignSpace(Manipulator(designs.origin().name(), legs), designs.names(), designs.joint_map(),
                       designs.length_map(), designs.lower() / unit, designs.upper() / unit, problem.design / unit),
           conditioning},
          problem.design / unit};
}

/// What both commands let the user choose.
struct Settings {
  std::string formulation = "pointwise";
  long points = 1000;
  std::optional<double> chord;
  long max_evaluations = 5000;
  long seed = 1;

  void declare(experiments::Options& options) {
    options.choice(
        "--formulation", formulation, {"pointwise", "area"},
        "pointwise: every limit at many points of the outline, with exact derivatives; area: the thesis's, the "
        "area of the workspace that is out of reach, by finite differences");
    options.integer("--points", points, 3, 100'000, "outline points of the pointwise formulation");
    options.number("--chord", chord, NumberRange::positive(largest_length),
                   "chord length of the area formulation (without it, 1/100 of the longest leg)");
    options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on function evaluations of a run");
    options.integer("--seed", seed, 0, 1'000'000'000, "seed of everything random");
  }

  std::vector<NamedSolver> solvers(const std::vector<std::string>& names) const {
    experiments::SolverSettings settings;
    const bool area = formulation == "area";
    settings.move_limit = 0.1;
    settings.step_tolerance = area ? 1e-4 : 1e-6;
    settings.value_tolerance = area ? 1e-6 : 1e-8;
    settings.search_radius = 1.0;
    // Dynamic-Q sometimes circles around a flat optimum; it then goes on in the next round of the exchange.
    if (!area) settings.max_iterations = 100;
    settings.max_points = max_evaluations;
    settings.seed = seed;
    std::vector<NamedSolver> all = experiments::select_solvers(names, settings);
    if (!area) {
      for (NamedSolver& named : all) named.solver = std::make_shared<ConstraintExchange>(named.solver);
    }
    return all;
  }
};

/// One optimizer from one start.
struct Run {
  std::string optimizer;
  Eigen::VectorXd start;  ///< design, in units
  Result result;
  Eigen::VectorXd design;  ///< in units
  Assessment judged;
  double seconds = 0.0;

  bool reaches() const { return judged.violation <= reach_tolerance; }
};

/// Whether a run is better than another: one that reaches the workspace, then the larger kappa^-1; where neither does,
/// the smaller violation.
bool better(const Run& one, const Run& other) {
  if (one.reaches() != other.reaches()) return one.reaches();
  return one.reaches() ? one.judged.kappa_inverse > other.judged.kappa_inverse
                       : one.judged.violation < other.judged.violation;
}

Run solve(const ScaledProblem& scaled, const Settings& settings, const NamedSolver& named, const Eigen::VectorXd& start,
          int side, Progress& progress) {
  Problem problem;
  Eigen::VectorXd x0 = start;
  reprise::Options options;
  options.max_function_evaluations = settings.max_evaluations;
  if (settings.formulation == "area") {
    problem =
        AreaFormulation(scaled.task, {.chord_length = settings.chord ? *settings.chord / scaled.unit : area_chord})
            .problem();
    options.derivatives = Derivatives::forward;
    options.difference_step = area_difference;
    options.feasibility_tolerance = area_tolerance;
  } else {
    const PointwiseOptions points{static_cast<int>(settings.points), side};
    problem = pointwise_problem(scaled.task, points);
    x0 = pointwise_start(scaled.task, start, points);
    options.feasibility_tolerance = pointwise_tolerance;
  }
  const auto begin = std::chrono::steady_clock::now();
  Run run;
  run.optimizer = named.name;
  run.start = start;
  run.result = named.solver->minimize(problem, x0, options, [&](const Iterate& iterate) {
    progress.note(
        fmt::format("iteration {}: kappa^-1 {:.5f}, violation {:.2g}", iterate.index, -iterate.f, iterate.violation));
    return true;
  });
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.design = run.result.x.head(start.size());
  run.judged = assess(scaled.task, run.design, judged_points, judged_orientations);
  return run;
}

/// From a start, on the side of the singular poses where it prevails, and where that leads to no design that reaches
/// the workspace without a singular pose, on the other.
Run solve(const ScaledProblem& scaled, const Settings& settings, const NamedSolver& named, const Eigen::VectorXd& start,
          Progress& progress) {
  if (settings.formulation == "area") return solve(scaled, settings, named, start, 0, progress);
  const int side = prevailing_side(scaled.task, start);
  Run run = solve(scaled, settings, named, start, side, progress);
  if (side == 0 || (run.reaches() && run.result.f < 0.0)) return run;
  Run other = solve(scaled, settings, named, start, -side, progress);
  return better(other, run) ? other : run;
}

/// The file's design, then random ones: within the bounds where there are both, about the file's design elsewhere.
std::vector<Eigen::VectorXd> make_starts(const ScaledProblem& scaled, long count, long seed) {
  std::vector<Eigen::VectorXd> starts{scaled.start};
  std::mt19937_64 random(static_cast<std::mt19937_64::result_type>(seed));
  const DesignSpace& designs = scaled.task.designs;
  for (long k = 1; k < count; ++k) {
    Eigen::VectorXd start = scaled.start;
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      const bool bounded = std::isfinite(designs.lower()[i]) && std::isfinite(designs.upper()[i]);
      const double lower = bounded ? designs.lower()[i] : start[i] - start_spread;
      const double upper = bounded ? designs.upper()[i] : start[i] + start_spread;
      // 53 random bits, so that every standard library gives the same starts.
      const double part = static_cast<double>(random() >> 11) * 0x1p-53;
      start[i] = lower + part * (upper - lower);
    }
    starts.push_back(start);
  }
  return starts;
}

/// SO, MO or D, as the thesis calls the kinds of synthesis.
const char* kind_of(const std::vector<Interval>& orientations) {
  if (orientations.size() > 1) return "MO";
  return orientations.front().lower == orientations.front().upper ? "SO" : "D";
}

Json vector_json(const Eigen::VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

Json orientations_json(const std::vector<Interval>& orientations) {
  Json list = Json::array();
  for (const Interval& range : orientations) list.push_back({range.lower / degree, range.upper / degree});
  return list;
}

std::string orientations_text(const std::vector<Interval>& orientations) {
  if (std::string(kind_of(orientations)) == "D") {
    return fmt::format("all orientations from {} to {} degrees", short_number(orientations.front().lower / degree),
                       short_number(orientations.front().upper / degree));
  }
  std::vector<std::string> slices;
  slices.reserve(orientations.size());
  for (const Interval& slice : orientations) slices.push_back(short_number(slice.lower / degree));
  return fmt::format("orientation {} degrees", fmt::join(slices, ", "));
}

/// What both documents begin with.
Json problem_json(const ProblemInput& problem, const Settings& settings) {
  const Conditioning& conditioning = problem.task.conditioning;
  return {{"manipulator", problem.start.manipulator.name()},
          {"workspace", problem.task.prescribed.name()},
          {"synthesis", kind_of(problem.task.orientations)},
          {"orientations_deg", orientations_json(problem.task.orientations)},
          {"formulation", settings.formulation},
          {"normalisation", conditioning.normalisation == Normalisation::printed ? "printed" : "homogeneous"},
          {"design_variables", problem.task.designs.names()}};
}

/// The outcome of a run as documents have it, lengths in the file's unit.
Json run_json(const Run& run, double unit) {
  return {{"optimizer", run.optimizer},
          {"start", vector_json(run.start * unit)},
          {"design", vector_json(run.design * unit)},
          {"kappa_inv_min", run.judged.kappa_inverse},
          {"violation", run.judged.violation * unit},
          {"reaches_workspace", run.reaches()},
          {"status", std::string(to_string(run.result.status))},
          {"message", run.result.message},
          {"evaluations", run.result.counts.function_evaluations()},
          {"gradient_evaluations", run.result.counts.gradient_evaluations()}};
}

Json history_json(const Run& run) {
  Json history = Json::array();
  for (const Iterate& iterate : run.result.history) {
    history.push_back({{"iteration", iterate.index},
                       {"evaluations", iterate.counts.function_evaluations()},
                       {"kappa_inv", -iterate.f},
                       {"violation", iterate.violation}});
  }
  return history;
}

ManipulatorInput found_manipulator(const ProblemInput& problem, const Eigen::VectorXd& design) {
  const Manipulator found = problem.task.designs.manipulator(design);
  return {Manipulator(found.name().size() < 90 ? found.name() + ", found" : found.name(), found.legs()),
          problem.start.conditioning, problem.start.as_design};
}

class SynthesizeCommand final : public Command {
 public:
  SynthesizeCommand()
      : Command(
            "synthesize", "The best conditioned design that reaches a prescribed workspace",
            "Varies what the problem's table [design] leaves free until the manipulator reaches the whole prescribed\n"
            "workspace at the prescribed orientations, and the least inverse condition number there is as large as\n"
            "possible: SO synthesis for one orientation, MO for several, D for a range. The design found is a local\n"
            "optimum; --starts tries further, random starts. What --out writes: manipulator.toml (the design found, a\n"
            "file for the other commands), history.csv and runs.csv.",
            "reprise synthesize examples/P2.toml\n"
            "reprise synthesize examples/rectangle.toml --starts 10 --out results --plot found.svg\n"
            "reprise synthesize examples/P1.toml --optimizer dynamic_q --formulation area --json") {
    options().choice("--optimizer", optimizer_, experiments::solver_names(), "the optimizer");
    options().integer("--starts", starts_, 1, 10'000, "number of starts; the first is the manipulator of the file");
    settings_.declare(options());
    draws();
    writes_tables();
  }

 private:
  Output compute() override {
    problem_ = read_problem(file());
    const ScaledProblem scaled = scale(*problem_);
    const NamedSolver named = settings_.solvers({optimizer_}).front();
    std::vector<Run> runs;
    {
      Progress progress(static_cast<std::size_t>(starts_));
      for (const Eigen::VectorXd& start : make_starts(scaled, starts_, settings_.seed)) {
        progress.begin(fmt::format("start {}", runs.size() + 1));
        runs.push_back(solve(scaled, settings_, named, start, progress));
      }
    }
    const Run& best = *std::min_element(runs.begin(), runs.end(), better);
    const Assessment before = assess(scaled.task, scaled.start, judged_points, judged_orientations);
    const Eigen::VectorXd design = best.design * scaled.unit;
    const ManipulatorInput found = found_manipulator(*problem_, design);

    Output output;
    Json& document = output.document;
    document = problem_json(*problem_, settings_);
    document.update(run_json(best, scaled.unit));
    document["start_kappa_inv_min"] = before.kappa_inverse;
    document["start_violation"] = before.violation * scaled.unit;
    document["kappa_inv_min_at"] = to_json(Eigen::Vector2d(best.judged.kappa_inverse_at * scaled.unit));
    document["kappa_inv_min_orientation_deg"] = best.judged.kappa_inverse_orientation / degree;
    document["kappa_inv_min_throughout"] = best.judged.kappa_inverse_throughout;
    document["violation_limit"] = best.judged.violation > 0.0 ? Json(to_string(best.judged.violation_limit)) : Json();
    document["history"] = history_json(best);
    Json all = Json::array();
    for (const Run& run : runs) all.push_back(run_json(run, scaled.unit));
    document["runs"] = all;
    document["manipulator_toml"] = to_toml(found);

    output.text = text(scaled, best, before, runs, found);
    output.tables = {{"history", history_table(best)}, {"runs", runs_table(runs, scaled.unit)}};
    output.files = {{"manipulator.toml", to_toml(found)}};
    output.picture = [this, found] { return picture(found.manipulator); };
    return output;
  }

  std::string text(const ScaledProblem& scaled, const Run& best, const Assessment& before, const std::vector<Run>& runs,
                   const ManipulatorInput& found) const {
    const SynthesisTask& task = problem_->task;
    std::string text = fmt::format("{} for {}: {} synthesis, {}\noptimizer {}, {} formulation, the best of {} {}\n\n",
                                   problem_->start.manipulator.name(), task.prescribed.name(),
                                   kind_of(task.orientations), orientations_text(task.orientations), best.optimizer,
                                   settings_.formulation, runs.size(), runs.size() == 1 ? "start" : "starts");
    text += fmt::format(
        "                   start         found\nleast kappa^-1     {:<12}  {}\nviolation          {:<12}  {}\n",
        short_number(before.kappa_inverse), short_number(best.judged.kappa_inverse),
        short_number(before.violation * scaled.unit), short_number(best.judged.violation * scaled.unit));
    for (Eigen::Index i = 0; i < task.designs.size(); ++i) {
      text += fmt::format("{:<17}  {:<12}  {}\n", task.designs.names()[static_cast<std::size_t>(i)],
                          short_number(problem_->design[i]), short_number(best.design[i] * scaled.unit));
    }
    text += fmt::format("\n{} after {} evaluations ({})\n", to_string(best.result.status),
                        best.result.counts.function_evaluations(), best.result.message);
    text += best.reaches()
                ? "The design reaches the whole workspace.\n"
                : fmt::format(
                      "The design does NOT reach the whole workspace: {} is violated by {} at x = {}, y = "
                      "{}.\n",
                      to_string(best.judged.violation_limit), short_number(best.judged.violation * scaled.unit),
                      short_number(best.judged.violation_at.x() * scaled.unit),
                      short_number(best.judged.violation_at.y() * scaled.unit));
    return text + "\n" + to_toml(found);
  }

  static Table history_table(const Run& run) {
    Table table("History of the synthesis",
                {{"iteration", "-", "number of the iterate, 0 for the start"},
                 {"evaluations", "-", "function evaluations up to there, finite differences counted in"},
                 {"kappa_inv", "-", "least inverse condition number, as the formulation sees it"},
                 {"violation", "-", "largest violation, as the formulation counts it, lengths in half longest legs"}});
    for (const Iterate& iterate : run.result.history) {
      table.add_row({iterate.index, iterate.counts.function_evaluations(), -iterate.f, iterate.violation});
    }
    return table;
  }

  Table runs_table(const std::vector<Run>& runs, double unit) const {
    std::vector<experiments::Column> columns{
        {"start", "-", "number of the start"},
        {"kappa_inv_min", "-", "least inverse condition number over the outline"},
        {"violation", "length", "largest violation of a limit there"},
        {"status", "-", "how the optimizer ended"},
        {"evaluations", "-", "function evaluations, finite differences counted in"}};
    for (const std::string& name : problem_->task.designs.names()) columns.push_back({name, "length", "design found"});
    Table table("Runs of the synthesis", columns);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const Run& run = runs[k];
      std::vector<Field> row{k + 1, run.judged.kappa_inverse, run.judged.violation * unit, to_string(run.result.status),
                             run.result.counts.function_evaluations()};
      for (const double value : run.design) row.emplace_back(value * unit);
      table.add_row(row);
    }
    return table;
  }

  /// The workspace of start and found design with the prescribed one in it; over several slices, that of the design
  /// found at the first, the middle and the last. Where the centre is out of reach there is no panel.
  experiments::Figure picture(const Manipulator& found) const {
    const SynthesisTask& task = problem_->task;
    const std::vector<Interval>& ranges = task.orientations;
    // The legend has no room for long names.
    constexpr std::size_t longest_name = 14;
    const PrescribedWorkspace& prescribed = task.prescribed;
    const PrescribedWorkspace named(prescribed.name().size() <= longest_name ? prescribed.name() : "prescribed",
                                    prescribed.shape(), prescribed.placement());
    std::vector<experiments::MapPanel> panels;
    const auto add = [&](const std::string& title, const Manipulator& manipulator, const Interval& range) {
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
    if (panels.empty()) return draw_poses(found, {{task.prescribed.centre(), ranges.front().lower}});
    double longest = 0.0;
    for (const Leg& leg : found.legs()) longest = std::max(longest, leg.length.upper);
    const experiments::MapOptions options{.chord = longest / 200.0};
    return draw_map(compute_map("synthesis", panels, options));
  }

  std::string optimizer_ = "dynamic_q_safeguarded";
  long starts_ = 1;
  Settings settings_;
  std::optional<ProblemInput> problem_;
};

class CompareCommand final : public Command {
 public:
  CompareCommand()
      : Command("compare", "The same synthesis by all optimizers",
                "Solves a problem as synthesize does, by every optimizer from the same start, and judges the designs "
                "alike:\n"
                "least inverse condition number and violation over the outline, evaluations, time.",
                "reprise compare examples/P2.toml\n"
                "reprise compare examples/rectangle.toml --optimizer slsqp,ipopt,dynamic_q --plot progress.svg\n"
                "reprise compare examples/P3.toml --formulation area --out results --json") {
    options().choices("--optimizer", optimizers_, experiments::solver_names(), "the optimizers");
    settings_.declare(options());
    draws();
    writes_tables();
  }

 private:
  Output compute() override {
    const ProblemInput problem = read_problem(file());
    const ScaledProblem scaled = scale(problem);
    std::vector<Run> runs;
    {
      Progress progress(optimizers_.size());
      for (const NamedSolver& named : settings_.solvers(optimizers_)) {
        progress.begin(named.name);
        runs.push_back(solve(scaled, settings_, named, scaled.start, progress));
      }
    }
    Output output;
    output.document = problem_json(problem, settings_);
    Json list = Json::array();
    Table table("Comparison of optimizers",
                {{"optimizer", "-", "name of the optimizer"},
                 {"kappa_inv_min", "-", "least inverse condition number over the outline"},
                 {"violation", "length", "largest violation of a limit there"},
                 {"reaches_workspace", "-", "1 when the design reaches the prescribed workspace, else 0"},
                 {"status", "-", "how the optimizer ended"},
                 {"evaluations", "-", "function evaluations, finite differences counted in"},
                 {"gradient_evaluations", "-", "gradient evaluations"}});
    Table history("History of the comparison",
                  {{"optimizer", "-", "name of the optimizer"},
                   {"evaluations", "-", "function evaluations, finite differences counted in"},
                   {"kappa_inv", "-", "least inverse condition number, as the formulation sees it"},
                   {"violation", "-", "largest violation, as the formulation counts it"}});
    output.text = fmt::format("{} for {}: {} synthesis, {}, {} formulation\n\n", problem.start.manipulator.name(),
                              problem.task.prescribed.name(), kind_of(problem.task.orientations),
                              orientations_text(problem.task.orientations), settings_.formulation);
    output.text +=
        "optimizer              least kappa^-1  violation     reaches  status             evaluations  gradients  "
        "seconds\n";
    for (const Run& run : runs) {
      Json one = run_json(run, scaled.unit);
      one["seconds"] = run.seconds;
      one["history"] = history_json(run);
      list.push_back(one);
      const Counts& counts = run.result.counts;
      table.add_row({run.optimizer, run.judged.kappa_inverse, run.judged.violation * scaled.unit,
                     static_cast<int>(run.reaches()), to_string(run.result.status), counts.function_evaluations(),
                     counts.gradient_evaluations()});
      for (const Iterate& iterate : run.result.history) {
        history.add_row({run.optimizer, iterate.counts.function_evaluations(), -iterate.f, iterate.violation});
      }
      output.text +=
          fmt::format("{:<22} {:<15} {:<13} {:<8} {:<18} {:>11} {:>10} {:>8.3f}\n", run.optimizer,
                      short_number(run.judged.kappa_inverse), short_number(run.judged.violation * scaled.unit),
                      run.reaches() ? "yes" : "no", to_string(run.result.status), counts.function_evaluations(),
                      counts.gradient_evaluations(), run.seconds);
    }
    output.document["runs"] = list;
    output.tables = {{"comparison", table}, {"history", history}};
    output.picture = [runs, tolerance = settings_.formulation == "area" ? area_tolerance : pointwise_tolerance] {
      std::vector<ProgressCurve> curves;
      for (const Run& run : runs) {
        ProgressCurve& curve = curves.emplace_back(ProgressCurve{run.optimizer, {}});
        double best = -std::numeric_limits<double>::infinity();
        for (const Iterate& iterate : run.result.history) {
          if (iterate.violation > 10.0 * tolerance || -iterate.f <= best) continue;
          best = -iterate.f;
          curve.points.emplace_back(static_cast<double>(std::max(1L, iterate.counts.function_evaluations())), best);
        }
      }
      return draw_progress(curves);
    };
    return output;
  }

  std::vector<std::string> optimizers_ = experiments::solver_names();
  Settings settings_;
};

}  // namespace

std::vector<std::unique_ptr<Command>> synthesis_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<SynthesizeCommand>());
  commands.push_back(std::make_unique<CompareCommand>());
  return commands;
}

}  // namespace reprise::app
