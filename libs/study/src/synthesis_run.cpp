#include "reprise/study/synthesis_run.hpp"

#include <fmt/format.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

#include "reprise/bounds/whole_region.hpp"
#include "reprise/synthesis/assessment.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"

namespace reprise {

namespace {

/// What is aimed at by proofs, in units: the width of the bounds of limits.
constexpr double margin_tolerance = 1e-6;

/// A least kappa^-1 that is not above this counts as 0: the proofs' tolerance.
constexpr double singular_tolerance = 1e-6;

/// How far from the file's design, in units, further starts may be along a variable that has no bounds.
constexpr double start_spread = 0.25;

/// Records every design that an optimizer tries.
class Recorder {
 public:
  Recorder(const ScaledProblem& scaled, Progress& progress, std::vector<HistoryPoint>& history)
      : assess_(scaled.task, history_points, 2),
        size_(scaled.start.size()),
        unit_(scaled.unit),
        progress_(progress),
        history_(history) {}

  bool operator()(const Iterate& iterate) {
    const Eigen::VectorXd design = iterate.x.head(size_);
    const Assessment seen = assess_(design);
    history_.push_back(
        {iterate.index, iterate.counts.function_evaluations(), design, seen.kappa_inverse, seen.violation * unit_});
    progress_.note(fmt::format("iteration {}: kappa^-1 {:.5g}, violation {:.2g}", iterate.index, seen.kappa_inverse,
                               seen.violation * unit_));
    return true;
  }

 private:
  Assessor assess_;
  Eigen::Index size_;
  double unit_;
  Progress& progress_;
  std::vector<HistoryPoint>& history_;
};

FormulationSettings formulation_settings(const ScaledProblem& scaled, const SynthesisSettings& settings) {
  FormulationSettings given;
  given.points = settings.points;
  given.max_evaluations = settings.max_evaluations;
  if (settings.chord) given.chord = *settings.chord / scaled.unit;
  return given;
}

Result solve_area(const ScaledProblem& scaled, const FormulationSettings& settings, const Solver& solver,
                  const Eigen::VectorXd& start, const Options& options, const Observer& observer) {
  const SynthesisProblem posed = formulate(Formulation::area, scaled.task, start, settings);
  return solver.minimize(posed.problem, posed.start, options, observer);
}

/// The pointwise formulation, to which constraints wherever else in the region they count join.
Result solve_pointwise(const ScaledProblem& scaled, const FormulationSettings& settings, const Solver& solver,
                       const Eigen::VectorXd& start, SingularitySide side, const Options& options,
                       const Observer& observer) {
  WholeRegionOptions whole;
  whole.pointwise = {static_cast<int>(settings.points), side};
  whole.solver = options;
  whole.proof.margin_tolerance = margin_tolerance;
  return solve_whole_region(scaled.task, start, solver, whole, observer).solved;
}

SynthesisOutcome solve_on_side(const ScaledProblem& scaled, const SynthesisSettings& settings, const NamedSolver& named,
                               const Eigen::VectorXd& start, SingularitySide side, const Stop& stop,
                               Progress& progress) {
  const FormulationSettings given = formulation_settings(scaled, settings);
  Options options = run_options(settings.kind(), given);
  options.record_history = false;
  options.stop = [&stop] { return stop(); };
  const auto begin = std::chrono::steady_clock::now();
  SynthesisOutcome run;
  run.optimizer = named.name;
  run.start = start;
  Recorder recorder(scaled, progress, run.history);
  const Observer observer = [&](const Iterate& iterate) { return recorder(iterate); };
  run.result = settings.kind() == Formulation::area
                   ? solve_area(scaled, given, *named.solver, start, options, observer)
                   : solve_pointwise(scaled, given, *named.solver, start, side, options, observer);
  run.design = run.result.x.head(start.size());
  run.proof = prove(scaled, run.design);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

}  // namespace

bool better(const SynthesisOutcome& one, const SynthesisOutcome& other) {
  if (one.reaches() != other.reaches()) return one.reaches();
  return one.reaches() ? one.proof.kappa_inverse.upper > other.proof.kappa_inverse.upper
                       : one.proof.violation < other.proof.violation;
}

DesignProof prove(const ScaledProblem& scaled, const Eigen::VectorXd& design) {
  return prove_design(scaled.own, design * scaled.unit,
                      {.allowance = reach_tolerance * scaled.unit, .margin_tolerance = margin_tolerance * scaled.unit});
}

SynthesisOutcome solve(const ScaledProblem& scaled, const SynthesisSettings& settings, const NamedSolver& named,
                       const Eigen::VectorXd& start, const Stop& stop, Progress& progress) {
  const SingularitySide side =
      settings.kind() == Formulation::area ? SingularitySide::either : prevailing_side(scaled.task, start);
  SynthesisOutcome run = solve_on_side(scaled, settings, named, start, side, stop, progress);
  if (side == SingularitySide::either || stop() ||
      (run.reaches() && run.proof.kappa_inverse.upper > singular_tolerance))
    return run;
  const SingularitySide opposite =
      side == SingularitySide::positive ? SingularitySide::negative : SingularitySide::positive;
  SynthesisOutcome other = solve_on_side(scaled, settings, named, start, opposite, stop, progress);
  return better(other, run) ? other : run;
}

std::vector<Eigen::VectorXd> make_starts(const ScaledProblem& scaled, long count, long seed) {
  std::vector<Eigen::VectorXd> starts{scaled.start};
  boost::random::mt19937_64 random(static_cast<std::uint64_t>(seed));
  boost::random::uniform_real_distribution<double> part;  // from 0 to 1
  const DesignSpace& designs = scaled.task.designs;
  for (long k = 1; k < count; ++k) {
    Eigen::VectorXd start = scaled.start;
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      const bool bounded = std::isfinite(designs.lower()[i]) && std::isfinite(designs.upper()[i]);
      const double lower = bounded ? designs.lower()[i] : start[i] - start_spread;
      const double upper = bounded ? designs.upper()[i] : start[i] + start_spread;
      start[i] = lower + part(random) * (upper - lower);
    }
    starts.push_back(start);
  }
  return starts;
}

}  // namespace reprise
