#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/study/solvers.hpp"

namespace reprise {

std::vector<NamedSolver> dynamic_q_variants(const SolverSettings& settings) {
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
  return {
      {"dynamic_q", "Dynamic-Q with LFOPC, as in the thesis", std::make_shared<DynamicQ>(thesis)},
      {"dynamic_q_dual", "Dynamic-Q, its approximations minimised exactly", std::make_shared<DynamicQ>(dual)},
      {"dynamic_q_safeguarded", "the same with a unit for each variable and guarded steps",
       std::make_shared<DynamicQ>(safeguarded)},
  };
}

}  // namespace reprise
