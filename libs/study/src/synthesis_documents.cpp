#include "reprise/study/synthesis_documents.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace reprise {

namespace {

Json vector_json(const Eigen::VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

Json orientations_json(const std::vector<OrientationRange>& orientations) {
  Json list = Json::array();
  for (const OrientationRange& range : orientations) list.push_back({range.lower / degree, range.upper / degree});
  return list;
}

/// Width of the bounds of kappa^-1 below which it counts as known.
constexpr double kappa_width = 2e-6;

bool is_range(const std::vector<OrientationRange>& orientations) { return std::string(kind_of(orientations)) == "D"; }

/// Where a statement holds: "", " at all orientations of the range", " at all 3 orientations".
std::string over_orientations(const std::vector<OrientationRange>& orientations) {
  if (is_range(orientations)) return " at all orientations of the range";
  return orientations.size() == 1 ? "" : fmt::format(" at all {} orientations", orientations.size());
}

std::string pose_text(const Pose& pose) {
  return fmt::format("x = {}, y = {}, {} degrees", short_number(pose.position.x()), short_number(pose.position.y()),
                     short_number(pose.orientation / degree));
}

}  // namespace

const char* kind_of(const std::vector<OrientationRange>& orientations) {
  if (orientations.size() > 1) return "MO";
  return orientations.front().lower == orientations.front().upper ? "SO" : "D";
}

std::string orientations_text(const std::vector<OrientationRange>& orientations) {
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

const char* reach_word(const DesignProof& proof) {
  if (proof.reaches == Verdict::undecided) return "undecided";
  return proof.reaches == Verdict::proved ? "yes" : "no";
}

std::string ending_text(const SynthesisOutcome& run) {
  return fmt::format("The optimizer {} ended after {} evaluations with: {} ({}).\n", run.optimizer,
                     run.result.counts.function_evaluations(), to_string(run.result.status), run.result.message);
}

std::string proof_text(const DesignProof& proof, const std::vector<OrientationRange>& orientations) {
  const std::string where = over_orientations(orientations);
  std::string text;
  if (proof.reaches == Verdict::proved) {
    text = fmt::format("The design reaches the whole workspace{}: proved.", where);
    if (proof.violation_bound > 0.0) {
      text += fmt::format(" No limit is violated by more than {} anywhere.", upper_number(proof.violation_bound, 3));
    }
  } else if (proof.reaches == Verdict::refuted) {
    text = fmt::format("The design does NOT reach the whole workspace{}: {} is violated by {} at {}.", where,
                       to_string(*proof.limit), short_number(proof.violation), pose_text(*proof.limit_at));
  } else {
    text = fmt::format(
        "Whether the design reaches the whole workspace{} is not decided after {} evaluations of bounds: the largest "
        "violation found is {}, and none is larger than {}.",
        where, proof.evaluations, short_number(proof.violation), upper_number(proof.violation_bound, 3));
  }
  const MinimumEnclosure& least = proof.kappa_inverse;
  const std::string region = std::string("over the whole workspace") + (is_range(orientations) ? " and range" : "");
  if (least.upper <= least.lower + kappa_width && least.lower > 0.0) {
    text += fmt::format("\nkappa^-1 is at least {} {}: proved.", lower_number(least.lower), region);
  } else if (least.upper <= kappa_width) {
    text += fmt::format("\nkappa^-1 is 0, or within {} of it, at {}: the design is singular there.", kappa_width,
                        pose_text(*least.witness));
  } else {
    text += fmt::format(
        "\nHow small kappa^-1 is {} is not decided after {} evaluations of bounds: it is {} at {}, and at least {}.",
        region, least.evaluations, short_number(least.upper), pose_text(*least.witness), lower_number(least.lower));
  }
  return text + "\n";
}

Json proof_json(const DesignProof& proof) {
  const MinimumEnclosure& least = proof.kappa_inverse;
  return {{"kappa_inv_min", least.upper},
          {"kappa_inv_min_bound", least.lower},
          {"violation", proof.violation},
          {"violation_bound", proof.violation_bound},
          {"reaches_workspace", proof.reaches == Verdict::proved},
          {"reach_verdict", std::string(to_string(proof.reaches))}};
}

Json run_json(const SynthesisOutcome& run, double unit) {
  Json json{{"optimizer", run.optimizer},
            {"start", vector_json(run.start * unit)},
            {"design", vector_json(run.design * unit)}};
  json.update(proof_json(run.proof));
  json.update(Json{{"status", std::string(to_string(run.result.status))},
                   {"message", run.result.message},
                   {"evaluations", run.result.counts.function_evaluations()},
                   {"gradient_evaluations", run.result.counts.gradient_evaluations()}});
  return json;
}

Json history_json(const SynthesisOutcome& run, double unit) {
  Json history = Json::array();
  for (const HistoryPoint& point : run.history) {
    history.push_back({{"iteration", point.iteration},
                       {"evaluations", point.evaluations},
                       {"design", vector_json(point.design * unit)},
                       {"kappa_inv", point.kappa_inv},
                       {"violation", point.violation}});
  }
  return history;
}

ManipulatorInput found_manipulator(const ProblemInput& problem, const Eigen::VectorXd& design) {
  const Manipulator found = problem.task.designs.manipulator(design);
  return {Manipulator(found.name().size() < 90 ? found.name() + ", found" : found.name(), found.legs()),
          problem.start.conditioning, problem.start.as_design, problem.start.unit};
}

}  // namespace reprise
