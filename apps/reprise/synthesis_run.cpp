#include "synthesis_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <random>

namespace reprise::app {

using experiments::NamedSolver;
using experiments::Progress;

namespace {

/// Points of the outline, and orientations of a range, at which final designs are judged.
constexpr int judged_points = 2000;
constexpr int judged_orientations = 21;

/// The thesis's chord length and difference interval, in units.
constexpr double area_chord = 0.02;
constexpr double area_difference = 1e-6;

/// How far from the file's design, in units, further starts may be along a variable that has no bounds.
constexpr double start_spread = 0.25;

Run solve(const ScaledProblem& scaled, const SynthesisSettings& settings, const NamedSolver& named,
          const Eigen::VectorXd& start, int side, Progress& progress) {
  Problem problem;
  Eigen::VectorXd x0 = start;
  reprise::Options options;
  options.max_function_evaluations = settings.max_evaluations;
  if (settings.area()) {
    problem =
        AreaFormulation(scaled.task, {.chord_length = settings.chord ? *settings.chord / scaled.unit : area_chord})
            .problem();
    options.derivatives = Derivatives::forward;
    options.difference_step = area_difference;
    options.feasibility_tolerance = area_tolerance;
  } else {
    const PointwiseOptions points{static_cast<int>(settings.points), side};
    problem = pointwise_problem(scaled.task, points);
    x0 = pointwise_start(scaled.task, start, points);
    options.feasibility_tolerance = pointwise_tolerance;
  }
  const auto begin = std::chrono::steady_clock::now();
  Run run;
  run.optimizer = named.name;
  run.start = start;
  run.result = named.solver->minimize(problem, x0, options, [&](const Iterate& iterate) {
    progress.note(
        fmt::format("iteration {}: kappa^-1 {:.5f}, violation {:.2g}", iterate.index, -iterate.f, iterate.violation));
    return true;
  });
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.design = run.result.x.head(start.size());
  run.judged = judge(scaled.task, run.design);
  return run;
}

}  // namespace

bool better(const Run& one, const Run& other) {
  if (one.reaches() != other.reaches()) return one.reaches();
  return one.reaches() ? one.judged.kappa_inverse > other.judged.kappa_inverse
                       : one.judged.violation < other.judged.violation;
}

Assessment judge(const SynthesisTask& task, const Eigen::VectorXd& design) {
  return assess(task, design, judged_points, judged_orientations);
}

Run solve(const ScaledProblem& scaled, const SynthesisSettings& settings, const NamedSolver& named,
          const Eigen::VectorXd& start, Progress& progress) {
  if (settings.area()) return solve(scaled, settings, named, start, 0, progress);
  const int side = prevailing_side(scaled.task, start);
  Run run = solve(scaled, settings, named, start, side, progress);
  if (side == 0 || (run.reaches() && run.result.f < 0.0)) return run;
  Run other = solve(scaled, settings, named, start, -side, progress);
  return better(other, run) ? other : run;
}

std::vector<Eigen::VectorXd> make_starts(const ScaledProblem& scaled, long count, long seed) {
  std::vector<Eigen::VectorXd> starts{scaled.start};
  std::mt19937_64 random(static_cast<std::mt19937_64::result_type>(seed));
  const DesignSpace& designs = scaled.task.designs;
  for (long k = 1; k < count; ++k) {
    Eigen::VectorXd start = scaled.start;
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      const bool bounded = std::isfinite(designs.lower()[i]) && std::isfinite(designs.upper()[i]);
      const double lower = bounded ? designs.lower()[i] : start[i] - start_spread;
      const double upper = bounded ? designs.upper()[i] : start[i] + start_spread;
      // 53 random bits, so that every standard library gives the same starts.
      const double part = static_cast<double>(random() >> 11) * 0x1p-53;
      start[i] = lower + part * (upper - lower);
    }
    starts.push_back(start);
  }
  return starts;
}

}  // namespace reprise::app
