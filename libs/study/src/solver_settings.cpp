#include "reprise/study/solvers.hpp"

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

}  // namespace reprise
