#include "reprise/study/formulation.hpp"

#include <stdexcept>

namespace reprise {

std::string to_string(Formulation formulation) { return formulation == Formulation::area ? "area" : "pointwise"; }

Formulation formulation_called(const std::string& name) {
  for (const Formulation one : {Formulation::area, Formulation::pointwise}) {
    if (to_string(one) == name) return one;
  }
  throw std::logic_error("there is no formulation called " + name);
}

Options run_options(Formulation formulation, const FormulationSettings& settings) {
  Options options;
  options.max_function_evaluations = settings.max_evaluations;
  if (formulation == Formulation::area) {
    options.derivatives = settings.differences;
    options.difference_step = settings.difference_step;
    options.feasibility_tolerance = settings.area_tolerance;
  } else {
    options.feasibility_tolerance = pointwise_tolerance;
  }
  return options;
}

SynthesisProblem formulate(Formulation formulation, const SynthesisTask& task, const Eigen::VectorXd& d0,
                           const FormulationSettings& settings) {
  if (formulation == Formulation::area) {
    return {AreaFormulation(task, {.chord_length = settings.chord}).problem(), d0, run_options(formulation, settings)};
  }
  const PointwiseOptions points{static_cast<int>(settings.points)};
  return {pointwise_problem(task, points), pointwise_start(task, d0, points), run_options(formulation, settings)};
}

}  // namespace reprise
