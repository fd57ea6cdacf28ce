#include <memory>

#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/study/formulation.hpp"

namespace reprise {

std::vector<NamedSolver> solvers_for(Formulation formulation, const std::vector<std::string>& names,
                                     SolverSettings settings) {
  if (formulation == Formulation::area) return select_solvers(names, settings);
  settings.max_iterations = pointwise_iterations;
  std::vector<NamedSolver> all = select_solvers(names, settings);
  for (NamedSolver& named : all) named.solver = std::make_shared<ConstraintExchange>(named.solver);
  return all;
}

}  // namespace reprise
