// What a solver's claim is worth: convex quadratic programs at random, each with a known optimum, in three units of the
// objective.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "comparison/judge.hpp"
#include "frame/experiment.hpp"
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
  double target = 1e-4;
  double violation = 1e-6;
  long max_evaluations = 2000;
  long threads = 2;

  void declare(CommandLine& options) {
    options.choices("--solver", solvers, solver_names(), "optimizers");
    options.numbers("--factors", factors, NumberRange::positive(), "factors of the objective, as other units would be");
    options.integer("--programs", programs, 1, 100'000, "number of programs");
    options.number("--target", target, NumberRange::positive(), "relative error of the objective to be met");
    options.number("--violation", violation, NumberRange::positive(), "largest violation allowed");
    options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on N_f of a run");
    options.integer("--threads", threads, 1, 256, "threads; the results do not depend on them");
  }
};

struct Run {
  bool claimed = false;
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
  // The same whatever the unit of the objective.
  run.error = relative_error(result.f / factor, program.f_optimum / factor);
  run.solved = run.error <= settings.target && result.violation <= settings.violation;
  run.cost = cost_in_gradients(result.counts, program.problem.n);
  return run;
}

Table make_table(const std::vector<Run>& runs, const std::vector<NamedSolver>& solvers, const Settings& settings) {
  Table table(title,
              {{"solver", "-", "name of the solver"},
               {"factor", "-", "factor of the objective"},
               {"programs", "-", "number of programs"},
               {"solved", "-", "results that meet the target"},
               {"claimed", "-", "runs of which the solver says that they converged"},
               {"false_claims", "-", "runs among them whose result does not meet the target"},
               {"worst", "-",
                "largest relative error of a claimed result, (f - f*) / max(1, |f*|) with the factor "
                "taken out; empty where nothing is claimed"},
               {"cost", "-", "gradient evaluations of a run, (N_f + n N_g) / (n + 1): median over all runs"}},
              {fmt::format("The target is a relative error of {} and a violation of at most {}.", settings.target,
                           settings.violation)});
  auto run = runs.begin();
  for (const NamedSolver& named : solvers) {
    for (const double factor : settings.factors) {
      long solved = 0, claimed = 0, false_claims = 0;
      double worst = 0.0;
      std::vector<double> costs;
      for (long k = 0; k < settings.programs; ++k, ++run) {
        solved += run->solved;
        claimed += run->claimed;
        false_claims += run->claimed && !run->solved;
        if (run->claimed) worst = std::max(worst, run->error);
        costs.push_back(run->cost);
      }
      table.add_row({named.name, factor, settings.programs, solved, claimed, false_claims,
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
    if (session.quick()) settings.programs = std::min(settings.programs, 3L);
    SolverSettings solver_settings;
    solver_settings.max_points = settings.max_evaluations;
    const std::vector<NamedSolver> solvers = select_solvers(settings.solvers, solver_settings);
    const auto programs = static_cast<std::size_t>(settings.programs);
    const std::size_t factors = settings.factors.size();
    std::vector<Run> runs(solvers.size() * factors * programs);
    Progress progress(runs.size());
    std::mutex mutex;
    in_threads(runs.size(), settings.threads, [&](std::size_t k) {
      const NamedSolver& named = solvers[k / (factors * programs)];
      const double factor = settings.factors[k / programs % factors];
      const std::size_t seed = k % programs;
      {
        const std::lock_guard lock(mutex);
        progress.begin(fmt::format("{}, objective times {}, program {}", named.name, factor, seed));
      }
      runs[k] = run_one(named, reprise::random_quadratic_program(seed, factor), factor, settings);
    });
    session.write(make_table(runs, solvers, settings));
    Eigen::Index most_variables = 0, most_inequalities = 0;
    for (std::size_t seed = 0; seed < programs; ++seed) {
      const Problem problem = random_quadratic_program(seed).problem;
      most_variables = std::max(most_variables, problem.n);
      most_inequalities = std::max(most_inequalities, problem.inequalities);
    }
    session.constant("most_variables", static_cast<double>(most_variables));
    session.constant("most_inequalities", static_cast<double>(most_inequalities));
  });
}
