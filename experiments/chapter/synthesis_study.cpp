#include "chapter/synthesis_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "frame/spread.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/study/formulation.hpp"
#include "reprise/study/solvers.hpp"
#include "reprise/synthesis/assessment.hpp"

namespace reprise::experiments {
namespace {

/// Number of outline points at which every final design is judged.
constexpr int dense_points = 2000;

/// Number of orientations, from the lowest to the highest, at which every final design is judged.
constexpr int range_orientations = 21;

/// Ipopt's barrier at the start; its default outweighs the objective where the inequalities are hundreds.
constexpr double pointwise_barrier = 1e-4;

/// Number of the restarts.
constexpr long restart_count = 50;

/// How far, in every variable, the starts of the restarts are at most from d^0.
constexpr double restart_distance = 1e-6;

Table make_table(const std::string& title, const std::vector<std::string>& notes) {
  return {
      title,
      {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
       {"optimizer", "-", "optimizer, dynamic_q for the thesis's, slsqp and mma, say, for those of NLopt"},
       {"formulation", "-", "area: the thesis's, eqs. (5.34) to (5.40); pointwise: limits at every outline point"},
       {"N_g", "-", "points at which gradients were evaluated, N^g"},
       {"N_f", "-", "points at which functions were evaluated, finite differences counted in"},
       {"f_d0", "-", "smallest inverse condition number of the starting design, f(d^0), as the formulation sees it"},
       {"f_star", "-", "smallest inverse condition number of the final design, f*, as the formulation sees it"},
       {"g_star", "length^2", "constraint (5.35), (5.38) or (5.40) of the final design, g*, for either formulation"},
       {"x_C", "length", "final design, x coordinate of base joint C"},
       {"y_C", "length", "final design, y coordinate of the base joints"},
       {"x_D", "length", "final design, x coordinate of base joint D"},
       {"x_E", "length", "final design, x coordinate of base joint E"},
       {"r", "length", "final design, half the length of the platform"},
       {"kappa_inv_dense", "-",
        fmt::format("smallest inverse condition number over {} outline points, at the slices or both ends of the range",
                    dense_points)},
       {"violation_dense", "length",
        fmt::format("largest violation of a leg's limit over {} outline points, at the slices or throughout the range",
                    dense_points)},
       {"kappa_inv_range", "-",
        fmt::format("the smallest inverse condition number there at {} orientations from the lowest to the highest",
                    range_orientations)},
       {"violation_range", "length", "the largest violation there at any orientation from the lowest to the highest"},
       {"status", "-", "how the optimizer ended"},
       {"published_N_g", "-", "N^g as printed"},
       {"published_f_d0", "-", "f(d^0) as printed"},
       {"published_f_star", "-", "f* as printed"},
       {"published_g_star", "length^2", "g* as printed"},
       {"published_x_C", "length", "x_C as printed"},
       {"published_y_C", "length", "y_C as printed"},
       {"published_x_D", "length", "x_D as printed"},
       {"published_x_E", "length", "x_E as printed"},
       {"published_r", "length", "r as printed"},
       {"message", "-", "what the optimizer says of its end"}},
      notes};
}

Table make_history(const std::string& title) {
  return {title + ", histories",
          {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
           {"optimizer", "-", "optimizer, dynamic_q for the thesis's, slsqp and mma, say, for those of NLopt"},
           {"formulation", "-", "area or pointwise"},
           {"iteration", "-", "number of the gradient evaluation, 0 for the start"},
           {"f", "-", "objective: smallest inverse condition number, or t of the pointwise formulation"},
           {"g", "length^2", "constraint (5.35), (5.38) or (5.40) of the design"},
           {"violation", "-", "largest violation of the formulation's own constraints"},
           {"x_C", "length", "design, x coordinate of base joint C"},
           {"y_C", "length", "design, y coordinate of the base joints"},
           {"x_D", "length", "design, x coordinate of base joint D"},
           {"x_E", "length", "design, x coordinate of base joint E"},
           {"r", "length", "design, half the length of the platform"}}};
}

/// One line for each run, for the terminal.
std::string summarise_synthesis(const Table& table) {
  std::string text = fmt::format("{:<10} {:<12} {:<10} {:>5} {:>6}  {:>8} {:>9}  {:>10}  {}\n", "workspace",
                                 "formulation", "optimizer", "N_g", "N_f", "f*", "printed", "violation", "status");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    text +=
        fmt::format("{:<10} {:<12} {:<10} {:>5} {:>6}  {:>8.5f} {:>9}  {:>10.1e}  {}\n", table.text(row, "workspace"),
                    table.text(row, "formulation"), table.text(row, "optimizer"), table.text(row, "N_g"),
                    table.text(row, "N_f"), table.number(row, "kappa_inv_dense"), table.text(row, "published_f_star"),
                    table.number(row, "violation_dense"), table.text(row, "status"));
  }
  return text;
}

const PrescribedWorkspace& find_workspace(const SynthesisInputs& inputs, const std::string& name) {
  const auto found = std::find_if(inputs.workspaces.begin(), inputs.workspaces.end(),
                                  [&](const PrescribedWorkspace& one) { return one.name() == name; });
  if (found == inputs.workspaces.end()) throw std::runtime_error("There is no prescribed workspace " + name + ".");
  return *found;
}

std::vector<OrientationRange> orientations_of(const ChapterSettings& settings) {
  std::vector<double> orientations;
  for (const double degrees : settings.orientations_deg) orientations.push_back(degrees * degree);
  if (!settings.dextrous) return slices(orientations);
  if (orientations.size() != 2) {
    throw std::invalid_argument(
        fmt::format("--orientations holds {} numbers, but it must hold the two ends of a range", orientations.size()));
  }
  return {{orientations[0], orientations[1]}};
}

/// The task for all orientations from the lowest to the highest one.
SynthesisTask over_whole_range(SynthesisTask task) {
  Interval whole = task.orientations.front();
  for (const OrientationRange& range : task.orientations) {
    whole = {std::min(whole.lower, range.lower), std::max(whole.upper, range.upper)};
  }
  task.orientations = {whole};
  return task;
}

}  // namespace

AreaFormulation area_formulation(const SynthesisInputs& inputs, const ChapterSettings& settings,
                                 const std::string& workspace) {
  return AreaFormulation({find_workspace(inputs, workspace), orientations_of(settings),
                          DesignSpace::collinear(inputs.lengths), printed_conditioning},
                         {.chord_length = settings.chord});
}

FormulationSettings ChapterSettings::formulation_settings() const {
  return {.chord = chord,
          .difference_step = difference_step,
          .differences = differences == "central" ? Derivatives::central : Derivatives::forward,
          .area_tolerance = area_tolerance,
          .points = points,
          .max_evaluations = max_evaluations};
}

std::shared_ptr<const Solver> make_solver(const std::string& name, Formulation formulation,
                                          const ChapterSettings& settings) {
  SolverSettings solvers;
  solvers.move_limit = settings.move_limit;
  if (formulation == Formulation::area) {
    solvers.step_tolerance = settings.step_tolerance;
    solvers.value_tolerance = settings.value_tolerance;
    solvers.max_iterations = DynamicQOptions().max_iterations;
  } else {
    solvers.step_tolerance = settings.pointwise_step_tolerance;
    solvers.value_tolerance = settings.pointwise_value_tolerance;
    solvers.initial_barrier = pointwise_barrier;
  }
  return solvers_for(formulation, {name}, solvers).front().solver;
}

void ChapterSettings::declare(CommandLine& options) {
  options.choices("--workspace", workspaces, workspaces, "prescribed workspaces");
  options.choices("--formulation", formulations, formulations, "formulations of the synthesis");
  options.choices("--optimizer", optimizers, solver_names(), "optimizers");
  options.number("--move-limit", move_limit, NumberRange::positive(), "rho, the move limit of Dynamic-Q, length");
  options.number("--step-tolerance", step_tolerance, NumberRange::positive(), "eps_x of Dynamic-Q, area formulation");
  options.number("--value-tolerance", value_tolerance, NumberRange::positive(), "eps_f of Dynamic-Q, area formulation");
  options.number("--difference-step", difference_step, NumberRange::positive(),
                 "Gamma, the interval of finite differences, area formulation, length");
  options.choice("--differences", differences, {"forward", "central"}, "finite differences, area formulation");
  options.number("--chord", chord, NumberRange::positive(), "d, the chord length, length");
  options.numbers("--orientations", orientations_deg, NumberRange::between(-180.0, 180.0),
                  dextrous ? "lowest and highest orientation phi, degrees" : "slices phi, degrees");
  options.number("--area-tolerance", area_tolerance, NumberRange::at_least(0.0),
                 "g at most this counts as feasible, area formulation, length^2");
  options.integer("--points", points, 3, 100'000, "outline points of the pointwise formulation");
  options.number("--pointwise-step-tolerance", pointwise_step_tolerance, NumberRange::positive(),
                 "eps_x of Dynamic-Q, pointwise formulation");
  options.number("--pointwise-value-tolerance", pointwise_value_tolerance, NumberRange::positive(),
                 "eps_f of Dynamic-Q, pointwise formulation");
  options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on function evaluations of one run");
  options.integer("--seed", seed, 0, 1'000'000'000, "seed of the starts of the restarts");
}

ChapterSettings chapter_settings(const ChapterSynthesis& synthesis) {
  ChapterSettings settings;
  const std::vector<OrientationRange> orientations = read_orientations(synthesis);
  settings.dextrous = !orientations.front().is_slice();
  settings.orientations_deg.clear();
  for (const OrientationRange& range : orientations) {
    settings.orientations_deg.push_back(range.lower / degree);
    if (settings.dextrous) settings.orientations_deg.push_back(range.upper / degree);
  }
  if (synthesis.kind == std::string_view("MO")) {
    settings.value_tolerance = 1e-5;
  } else if (synthesis.kind == std::string_view("D")) {
    settings.move_limit = 0.05;
    settings.differences = "central";
    settings.difference_step = 1e-3;
  }
  return settings;
}

SynthesisInputs read_synthesis_inputs(const std::string& title, const ChapterSynthesis& synthesis) {
  const CollinearManipulator start = read_start(synthesis);
  return {title, read_prescribed_workspaces(synthesis), start.design, start.lengths, read_published(synthesis)};
}

std::pair<Table, Table> run_synthesis_study(const SynthesisInputs& inputs, const ChapterSettings& settings) {
  Table table =
      make_table(inputs.title, {"Prescribed workspaces are reconstructed from the printed results, not published."});
  Table history = make_history(inputs.title);
  const Eigen::VectorXd d0 = to_vector(inputs.start);

  Progress progress(settings.workspaces.size() * settings.formulations.size() * settings.optimizers.size());
  for (const std::string& workspace : settings.workspaces) {
    const AreaFormulation area = area_formulation(inputs, settings, workspace);
    const Table published = inputs.published.where("workspace", workspace);
    for (const std::string& name : settings.formulations) {
      const Formulation kind = formulation_called(name);
      const SynthesisProblem formulation = formulate(kind, area.task(), d0, settings.formulation_settings());
      for (const std::string& optimizer : settings.optimizers) {
        progress.begin(fmt::format("{}, {}, {}", workspace, name, optimizer));
        const Result result = make_solver(optimizer, kind, settings)
                                  ->minimize(formulation.problem, formulation.start, formulation.options);
        const Eigen::VectorXd design = result.x.head(d0.size());
        const Assessment dense = assess(area.task(), design, dense_points);
        const Assessment over_range = assess(over_whole_range(area.task()), design, dense_points, range_orientations);
        const double f_start =
            kind == Formulation::area ? area.evaluate(d0).kappa_inverse : formulation.start[d0.size()];

        std::vector<Field> row{workspace,
                               optimizer,
                               name,
                               result.counts.gradient_evaluations(),
                               result.counts.function_evaluations(),
                               f_start,
                               -result.f,
                               area.evaluate(design).constraint};
        for (const double value : design) row.emplace_back(value);
        row.insert(row.end(), {dense.kappa_inverse, dense.violation, over_range.kappa_inverse_throughout,
                               over_range.violation, to_string(result.status)});
        for (const char* column : {"N_g", "f_d0", "f_star", "g_star"}) row.emplace_back(published.text(0, column));
        for (const char* column : design_columns) row.emplace_back(published.text(0, column));
        row.emplace_back(result.message);
        table.add_row(row);

        for (const Iterate& iterate : result.history) {
          const Eigen::VectorXd d = iterate.x.head(d0.size());
          // The area formulation has no other constraint; the pointwise one knows nothing of areas.
          const double constraint = name == "area" ? iterate.g[0] : area.evaluate(d).constraint;
          std::vector<Field> line{workspace, optimizer, name, iterate.index, -iterate.f, constraint, iterate.violation};
          for (const double value : d) line.emplace_back(value);
          history.add_row(line);
        }
      }
    }
  }
  return {std::move(table), std::move(history)};
}

std::pair<Table, Table> run_restarts(const SynthesisInputs& inputs, const ChapterSettings& settings, long runs) {
  const std::string title = fmt::format("{}, Dynamic-Q with the area formulation from starts within {:g} of d^0",
                                        inputs.title, restart_distance);
  Table table(title,
              {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
               {"run", "-", "number of the run"},
               {"N_g", "-", "points at which gradients were evaluated"},
               {"kappa_inv_dense", "-", "smallest inverse condition number of the final design, as in the table"},
               {"violation_dense", "length", "largest violation of a leg's limit, as in the table"},
               {"status", "-", "how the optimizer ended"}});
  Table summary(title + ", summary", {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
                                      {"runs", "-", "number of runs"},
                                      {"N_g_least", "-", "smallest number of gradient evaluations"},
                                      {"N_g_most", "-", "greatest number of gradient evaluations"},
                                      {"kappa_inv_least", "-", "smallest of the runs' inverse condition numbers"},
                                      {"kappa_inv_median", "-", "their median"},
                                      {"kappa_inv_most", "-", "the greatest of them"},
                                      {"violation_most", "length", "the greatest of the runs' violations"},
                                      {"published_f_star", "-", "f* as printed"}});
  const Eigen::VectorXd d0 = to_vector(inputs.start);
  Progress progress(settings.workspaces.size() * static_cast<std::size_t>(runs));
  for (const std::string& workspace : settings.workspaces) {
    const AreaFormulation area = area_formulation(inputs, settings, workspace);
    boost::random::mt19937 random(static_cast<std::uint32_t>(settings.seed));
    boost::random::uniform_real_distribution<double> uniform(-restart_distance, restart_distance);
    std::vector<double> gradients;
    std::vector<double> conditioning;
    double violation = 0.0;
    for (long run = 1; run <= runs; ++run) {
      progress.begin(fmt::format("{}, restart {}", workspace, run));
      Eigen::VectorXd start = d0;
      for (double& value : start) value += uniform(random);
      const SynthesisProblem formulation =
          formulate(Formulation::area, area.task(), start, settings.formulation_settings());
      const Result result = make_solver("dynamic_q", Formulation::area, settings)
                                ->minimize(formulation.problem, formulation.start, formulation.options);
      const Assessment dense = assess(area.task(), result.x, dense_points);
      table.add_row({workspace, run, result.counts.gradient_evaluations(), dense.kappa_inverse, dense.violation,
                     to_string(result.status)});
      gradients.push_back(static_cast<double>(result.counts.gradient_evaluations()));
      conditioning.push_back(dense.kappa_inverse);
      violation = std::max(violation, dense.violation);
    }
    const auto [fewest, most] = std::minmax_element(gradients.begin(), gradients.end());
    const Spread spread = spread_of(conditioning);
    summary.add_row({workspace, runs, *fewest, *most, spread.lowest, spread.median, spread.highest, violation,
                     inputs.published.where("workspace", workspace).text(0, "f_star")});
  }
  return {std::move(table), std::move(summary)};
}

void write_synthesis_study(Session& session, const SynthesisInputs& inputs, ChapterSettings settings) {
  if (session.quick()) {
    settings.points = 150;
    settings.max_evaluations = std::min(settings.max_evaluations, 200L);
  }
  const auto [table, history] = run_synthesis_study(inputs, settings);
  const auto [restarts, summary] = run_restarts(inputs, settings, session.quick() ? 2 : restart_count);
  session.write(table);
  session.write(history, "history");
  session.write(restarts, "restarts");
  session.write(summary, "restarts_summary");
  session.constant("dense_points", dense_points);
  session.constant("range_orientations", range_orientations);
  session.constant("pointwise_barrier", pointwise_barrier);
  session.constant("pointwise_iterations", pointwise_iterations);
  session.constant("restart_distance", restart_distance);
  session.constant("area_directions", AreaOptions().outline_points);
  fmt::print("{}", summarise_synthesis(table));
}

}  // namespace reprise::experiments
