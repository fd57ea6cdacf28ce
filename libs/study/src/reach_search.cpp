#include "reprise/study/reach_search.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "reprise/study/solvers.hpp"

namespace reprise {

namespace {

SynthesisOutcome unreached(const ScaledProblem& scaled, const std::string& optimizer, const Eigen::VectorXd& start,
                           const LeastViolation& least, const std::function<bool()>& stop) {
  SynthesisOutcome run;
  run.optimizer = optimizer;
  run.start = start;
  run.design = least.design;
  run.result.x = least.design;
  const bool cut_short = stop && stop();
  run.result.status = cut_short ? Status::stopped : Status::infeasible;
  run.result.message = cut_short ? "the search for a design that reaches the workspace was cut short"
                                 : "no design near the start reaches the workspace; this one violates the limits least";
  run.result.counts.inequality = least.cost.evaluations;
  run.proof = prove(scaled, run.design);
  return run;
}

}  // namespace

const Solver& reach_solver() {
  static const std::shared_ptr<const Solver> solver = select_solvers({"slsqp"}, {}).front().solver;
  return *solver;
}

LeastViolation search_reach(const ScaledProblem& scaled, const Eigen::VectorXd& start,
                            const std::function<bool()>& stop) {
  ReachOptions options;
  options.stop = stop;
  return find_least_violation(scaled.task, start, reach_solver(), options);
}

bool reaches(const LeastViolation& least) { return least.largest <= reach_tolerance; }

std::vector<Eigen::VectorXd> reach_starts(const ScaledProblem& scaled, long seed) {
  // A search costs some milliseconds with twelve variables, and grows with about the third power of their number.
  constexpr long most = 20;
  const long fewer = 400 / static_cast<long>(scaled.start.size());
  return make_starts(scaled, std::clamp(fewer, 2L, most), seed);
}

SynthesisOutcome solve_where_reached(const ScaledProblem& scaled, const std::string& optimizer,
                                     const Eigen::VectorXd& start, const std::function<bool()>& stop,
                                     const std::function<SynthesisOutcome(const Eigen::VectorXd&)>& solve) {
  const LeastViolation least = search_reach(scaled, start, stop);
  if (reaches(least)) {
    SynthesisOutcome run = solve(start);
    if (run.reaches() || (stop && stop())) return run;
    SynthesisOutcome again = solve(least.design);
    return better(again, run) ? again : run;
  }
  return unreached(scaled, optimizer, start, least, stop);
}

SynthesisOutcome solve_from_further_starts(const ScaledProblem& scaled, const std::string& optimizer, long seed,
                                           const std::function<bool()>& stop,
                                           const std::function<SynthesisOutcome(const Eigen::VectorXd&)>& solve) {
  Eigen::VectorXd best_start;
  std::optional<LeastViolation> best;
  for (const Eigen::VectorXd& start : reach_starts(scaled, seed)) {
    LeastViolation least = search_reach(scaled, start, stop);
    if (reaches(least)) return solve(least.design);
    if (!best || least.largest < best->largest) {
      best = std::move(least);
      best_start = start;
    }
    if (stop && stop()) break;
  }
  return unreached(scaled, optimizer, best_start, *best, stop);
}

}  // namespace reprise
