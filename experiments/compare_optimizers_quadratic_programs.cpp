// What a solver's claim is worth: convex quadratic programs at random, each with a known optimum, in three units of the
// objective, and the same in bent coordinates, which are nonlinear and have no other stationary point.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "comparison/judge.hpp"
#include "frame/experiment.hpp"
#include "frame/spread.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/random_quadratic_programs.hpp"
#include "reprise/study/solvers.hpp"

namespace reprise::experiments {
namespace {

constexpr const char* title = "Optimizers on random quadratic programs";

/// All but the evolution strategy, which claims nothing.
std::vector<std::string> claiming_solvers() {
  std::vector<std::string> names = solver_names();
  names.erase(std::remove(names.begin(), names.end(), "isres"), names.end());
  return names;
}

struct Settings {
  std::vector<std::string> solvers = claiming_solvers();
  std::vector<double> factors{1.0, 1e6, 1e-6};
  long programs = 24;
  long bent = 8;
  double target = 1e-4;
  double violation = 1e-6;
  long max_evaluations = 2000;
  long threads = 2;

  void declare(CommandLine& options) {
    options.choices("--solver", solvers, solver_names(), "optimizers");
    options.numbers("--factors", factors, NumberRange::positive(), "factors of the objective, as other units would be");
    options.integer("--programs", programs, 1, 100'000, "number of convex programs");
    options.integer("--bent", bent, 1, 100'000, "number of programs in bent coordinates; the factor is 1");
    options.number("--target", target, NumberRange::positive(), "relative error of the objective to be met");
    options.number("--violation", violation, NumberRange::positive(), "largest violation allowed");
    options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on N_f of a run");
    options.integer("--threads", threads, 1, 256, "threads; the results do not depend on them");
  }
};

/// Programs of one kind, with one factor of the objective.
struct Series {
  bool is_bent;
  double factor;
  long programs;

  const char* kind() const { return is_bent ? "bent" : "convex"; }
  RandomQuadraticProgram program(std::uint64_t seed) const {
    return is_bent ? bent_quadratic_program(seed, factor) : random_quadratic_program(seed, factor);
  }
};

std::vector<Series> list_series(const Settings& settings) {
  std::vector<Series> list;
  for (const double factor : settings.factors) list.push_back({false, factor, settings.programs});
  list.push_back({true, 1.0, settings.bent});
  return list;
}

struct Run {
  bool claimed = false;
  bool refused = false;
  bool solved = false;
  double error = 0.0;
  double cost = 0.0;
};

Run run_one(const NamedSolver& named, const RandomQuadraticProgram& program, double factor, const Settings& settings) {
  Options options;
  options.feasibility_tolerance = settings.violation;
  options.max_function_evaluations = settings.max_evaluations;
  options.record_history = false;
  const Result result = named.solver->minimize(program.problem, program.start, options);
  Run run;
  run.claimed = result.status == Status::converged;
  run.refused = result.status == Status::not_stationary;
  // The same whatever the unit of the objective.
  run.error = relative_error(result.f / factor, program.f_optimum / factor);
  run.solved = run.error <= settings.target && result.violation <= settings.violation;
  run.cost = cost_in_gradients(result.counts, program.problem.n);
  return run;
}

Table make_table(const std::vector<Run>& runs, const std::vector<NamedSolver>& solvers, const std::vector<Series>& list,
                 const Settings& settings) {
  Table table(title,
              {{"solver", "-", "name of the solver"},
               {"kind", "-", "convex, or bent: the same in bent coordinates"},
               {"factor", "-", "factor of the objective"},
               {"programs", "-", "number of programs"},
               {"solved", "-", "results that meet the target"},
               {"claimed", "-", "runs of which the solver says that they converged"},
               {"false_claims", "-", "runs among them whose result does not meet the target"},
               {"refused", "-", "runs whose claim is not believed, because the conditions of optimality do not hold"},
               {"worst", "-",
                "largest relative error of a claimed result, (f - f*) / max(1, |f*|) with the factor "
                "taken out; empty where nothing is claimed"},
               {"cost", "-", "gradient evaluations of a run, (N_f + n N_g) / (n + 1): median over all runs"}},
              {fmt::format("The target is a relative error of {} and a violation of at most {}.", settings.target,
                           settings.violation)});
  auto run = runs.begin();
  for (const NamedSolver& named : solvers) {
    for (const Series& series : list) {
      long solved = 0, claimed = 0, false_claims = 0, refused = 0;
      double worst = 0.0;
      std::vector<double> costs;
      for (long k = 0; k < series.programs; ++k, ++run) {
        solved += run->solved;
        claimed += run->claimed;
        false_claims += run->claimed && !run->solved;
        refused += run->refused;
        if (run->claimed) worst = std::max(worst, run->error);
        costs.push_back(run->cost);
      }
      table.add_row({named.name, series.kind(), series.factor, series.programs, solved, claimed, false_claims, refused,
                     claimed > 0 ? Field(worst) : Field(), spread_of(costs).median});
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

  return experiment.run(argc, argv, [&](Session& session) {
    if (session.quick()) settings.programs = settings.bent = 3;
    SolverSettings solver_settings;
    solver_settings.max_points = settings.max_evaluations;
    const std::vector<NamedSolver> solvers = select_solvers(settings.solvers, solver_settings);
    const std::vector<Series> list = list_series(settings);
    struct Task {
      const NamedSolver* solver;
      const Series* series;
      std::uint64_t seed;
    };
    std::vector<Task> tasks;
    for (const NamedSolver& named : solvers) {
      for (const Series& series : list) {
        for (long seed = 0; seed < series.programs; ++seed) {
          tasks.push_back({&named, &series, static_cast<std::uint64_t>(seed)});
        }
      }
    }
    std::vector<Run> runs(tasks.size());
    Progress progress(runs.size());
    std::mutex mutex;
    in_threads(runs.size(), settings.threads, [&](std::size_t k) {
      const Task& task = tasks[k];
      {
        const std::lock_guard lock(mutex);
        progress.begin(fmt::format("{}, {}, objective times {}, program {}", task.solver->name, task.series->kind(),
                                   task.series->factor, task.seed));
      }
      runs[k] = run_one(*task.solver, task.series->program(task.seed), task.series->factor, settings);
    });
    session.write(make_table(runs, solvers, list, settings));
    Eigen::Index most_variables = 0, most_inequalities = 0;
    for (long seed = 0; seed < settings.programs; ++seed) {
      const Problem problem = random_quadratic_program(static_cast<std::uint64_t>(seed)).problem;
      most_variables = std::max(most_variables, problem.n);
      most_inequalities = std::max(most_inequalities, problem.inequalities);
    }
    session.constant("most_variables", static_cast<double>(most_variables));
    session.constant("most_inequalities", static_cast<double>(most_inequalities));
  });
}
