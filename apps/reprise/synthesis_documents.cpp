#include "synthesis_documents.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace reprise::app {

namespace {

Json vector_json(const Eigen::VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

Json orientations_json(const std::vector<Interval>& orientations) {
  Json list = Json::array();
  for (const Interval& range : orientations) list.push_back({range.lower / degree, range.upper / degree});
  return list;
}

}  // namespace

const char* kind_of(const std::vector<Interval>& orientations) {
  if (orientations.size() > 1) return "MO";
  return orientations.front().lower == orientations.front().upper ? "SO" : "D";
}

std::string orientations_text(const std::vector<Interval>& orientations) {
  if (std::string(kind_of(orientations)) == "D") {
    return fmt::format("all orientations from {} to {} degrees", short_number(orientations.front().lower / degree),
                       short_number(orientations.front().upper / degree));
  }
  std::vector<std::string> slices;
  slices.reserve(orientations.size());
  for (const Interval& slice : orientations) slices.push_back(short_number(slice.lower / degree));
  return fmt::format("orientation {} degrees", fmt::join(slices, ", "));
}

Json problem_json(const ProblemInput& problem, const SynthesisSettings& settings) {
  const Conditioning& conditioning = problem.task.conditioning;
  return {{"manipulator", problem.start.manipulator.name()},
          {"workspace", problem.task.prescribed.name()},
          {"synthesis", kind_of(problem.task.orientations)},
          {"orientations_deg", orientations_json(problem.task.orientations)},
          {"formulation", settings.formulation},
          {"normalisation", conditioning.normalisation == Normalisation::printed ? "printed" : "homogeneous"},
          {"design_variables", problem.task.designs.names()}};
}

Json run_json(const Run& run, double unit) {
  return {{"optimizer", run.optimizer},
          {"start", vector_json(run.start * unit)},
          {"design", vector_json(run.design * unit)},
          {"kappa_inv_min", run.judged.kappa_inverse},
          {"violation", run.judged.violation * unit},
          {"reaches_workspace", run.reaches()},
          {"status", std::string(to_string(run.result.status))},
          {"message", run.result.message},
          {"evaluations", run.result.counts.function_evaluations()},
          {"gradient_evaluations", run.result.counts.gradient_evaluations()}};
}

Json history_json(const Run& run) {
  Json history = Json::array();
  for (const Iterate& iterate : run.result.history) {
    history.push_back({{"iteration", iterate.index},
                       {"evaluations", iterate.counts.function_evaluations()},
                       {"kappa_inv", -iterate.f},
                       {"violation", iterate.violation}});
  }
  return history;
}

ManipulatorInput found_manipulator(const ProblemInput& problem, const Eigen::VectorXd& design) {
  const Manipulator found = problem.task.designs.manipulator(design);
  return {Manipulator(found.name().size() < 90 ? found.name() + ", found" : found.name(), found.legs()),
          problem.start.conditioning, problem.start.as_design, problem.start.unit};
}

}  // namespace reprise::app
