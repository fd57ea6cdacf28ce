#include "reprise/study/solvers.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"

namespace reprise {

std::vector<NamedSolver> named_solvers(const SolverSettings& settings) {
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
  std::vector<NamedSolver> all = dynamic_q_variants(settings);
  const std::vector<NamedSolver> others{
      {"slsqp", "sequential quadratic programming (NLopt)", nlopt(NloptAlgorithm::slsqp)},
      {"ccsaq", "conservative convex separable quadratic approximations (NLopt)", nlopt(NloptAlgorithm::ccsaq)},
      {"mma", "method of moving asymptotes (NLopt)", nlopt(NloptAlgorithm::mma)},
      {"ipopt_lbfgs", "interior point with limited-memory BFGS (Ipopt)", std::make_shared<IpoptSolver>(limited_memory)},
      {"ipopt", "interior point with exact Hessians (Ipopt)", std::make_shared<IpoptSolver>(exact)},
      {"cobyla", "linear approximations without derivatives (NLopt)", nlopt(NloptAlgorithm::cobyla)},
      {"isres", "evolution strategy with stochastic ranking (NLopt)", nlopt(NloptAlgorithm::isres)},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
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
