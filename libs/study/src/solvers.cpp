#include "reprise/study/solvers.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"

namespace reprise {

void SolverSettings::declare(CommandLine& options) {
  options.number("--move-limit", move_limit, NumberRange::positive(), "rho of dynamic_q and dynamic_q_dual");
  options.number("--relative-move-limit", relative_move_limit, NumberRange::positive(),
                 "rho of dynamic_q_safeguarded, in units of max(1, |x_i|) of the start");
  options.number("--step-tolerance", step_tolerance, NumberRange::positive(), "eps_x of every Dynamic-Q");
  options.number("--value-tolerance", value_tolerance, NumberRange::at_least(0.0), "eps_f of every Dynamic-Q");
  options.integer("--max-iterations", max_iterations, 1, 1'000'000, "limit on iterations of every Dynamic-Q");
  options.integer("--seed", seed, 0, 1'000'000'000, "seed of isres");
  options.number("--search-radius", search_radius, NumberRange::positive(),
                 "half the box of isres where a variable has no bound, in units of max(1, |x_i|) of the start");
}

std::vector<NamedSolver> named_solvers(const SolverSettings& settings) {
  DynamicQOptions thesis;
  thesis.move_limit = settings.move_limit;
  thesis.step_tolerance = settings.step_tolerance;
  thesis.value_tolerance = settings.value_tolerance;
  thesis.max_iterations = settings.max_iterations;
  DynamicQOptions dual = thesis;
  dual.subproblem = SubproblemSolver::dual;
  dual.scale_objective = true;
  DynamicQOptions safeguarded = dual;
  safeguarded.move_limit = settings.relative_move_limit;
  safeguarded.scale_variables = true;
  safeguarded.safeguard.active = true;
  const auto nlopt = [&](NloptAlgorithm algorithm) {
    NloptOptions options;
    options.algorithm = algorithm;
    options.max_iterations = settings.max_points;
    options.seed = static_cast<unsigned long>(settings.seed);
    options.search_radius = settings.search_radius;
    return std::make_shared<NloptSolver>(options);
  };
  IpoptOptions exact;
  exact.initial_barrier = settings.initial_barrier;
  IpoptOptions limited_memory = exact;
  limited_memory.hessian = IpoptHessian::limited_memory;
  return {
      {"dynamic_q", "Dynamic-Q with LFOPC, as in the thesis", std::make_shared<DynamicQ>(thesis)},
      {"dynamic_q_dual", "Dynamic-Q, its approximations minimised exactly", std::make_shared<DynamicQ>(dual)},
      {"dynamic_q_safeguarded", "the same with a unit for each variable and guarded steps",
       std::make_shared<DynamicQ>(safeguarded)},
      {"slsqp", "sequential quadratic programming (NLopt)", nlopt(NloptAlgorithm::slsqp)},
      {"ccsaq", "conservative convex separable quadratic approximations (NLopt)", nlopt(NloptAlgorithm::ccsaq)},
      {"mma", "method of moving asymptotes (NLopt)", nlopt(NloptAlgorithm::mma)},
      {"ipopt_lbfgs", "interior point with limited-memory BFGS (Ipopt)", std::make_shared<IpoptSolver>(limited_memory)},
      {"ipopt", "interior point with exact Hessians (Ipopt)", std::make_shared<IpoptSolver>(exact)},
      {"cobyla", "linear approximations without derivatives (NLopt)", nlopt(NloptAlgorithm::cobyla)},
      {"isres", "evolution strategy with stochastic ranking (NLopt)", nlopt(NloptAlgorithm::isres)},
  };
}

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const NamedSolver& one : named_solvers()) names.push_back(one.name);
  return names;
}

std::vector<std::string> synthesis_solver_names() {
  std::vector<std::string> names = solver_names();
  names.erase(std::remove(names.begin(), names.end(), "ipopt"), names.end());
  return names;
}

std::vector<NamedSolver> select_solvers(const std::vector<std::string>& names, const SolverSettings& settings) {
  const std::vector<NamedSolver> all = named_solvers(settings);
  std::vector<NamedSolver> selected;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const NamedSolver& one) { return one.name == name; });
    if (found == all.end()) throw std::logic_error("no solver is called " + name);
    selected.push_back(*found);
  }
  return selected;
}

}  // namespace reprise
