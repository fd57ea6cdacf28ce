#include "reprise/study/synthesis_settings.hpp"

#include <fmt/format.h>

#include "reprise/io/interruption.hpp"

namespace reprise {

bool Stop::time_is_up() const {
  return seconds_ && std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count() >= *seconds_;
}

bool Stop::operator()() const { return interrupted() || time_is_up(); }

std::string Stop::reason() const {
  if (interrupted()) return "Interrupted by a signal";
  return time_is_up() ? fmt::format("Stopped after {} s", *seconds_) : "";
}

void SynthesisSettings::declare(CommandLine& options) {
  options.choice(
      "--formulation", formulation, {"pointwise", "area"},
      "pointwise: every limit and kappa^-1 at many points of the outline, with exact derivatives, and wherever else in "
      "the workspace they count; area: the thesis's, the "
      "area of the workspace that is out of reach, by finite differences");
  options.integer("--points", points, 3, 100'000, "outline points of the pointwise formulation");
  options.number("--chord", chord, NumberRange::positive(largest_length),
                 "chord length of the area formulation (without it, 1/100 of the longest leg)");
  options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on function evaluations of a run");
  options.integer("--seed", seed, 0, 1'000'000'000, "seed of everything random");
  options.number("--time", time, NumberRange::positive(1e9),
                 "seconds after which the search ends with the best design so far, as it does on Ctrl-C");
}

Formulation SynthesisSettings::kind() const { return formulation_called(formulation); }

std::vector<NamedSolver> SynthesisSettings::solvers(const std::vector<std::string>& names) const {
  SolverSettings settings;
  settings.move_limit = 0.1;
  settings.step_tolerance = kind() == Formulation::area ? 1e-4 : 1e-6;
  settings.value_tolerance = kind() == Formulation::area ? 1e-6 : 1e-8;
  settings.search_radius = 1.0;
  settings.max_points = max_evaluations;
  settings.seed = seed;
  return solvers_for(kind(), names, settings);
}

}  // namespace reprise
