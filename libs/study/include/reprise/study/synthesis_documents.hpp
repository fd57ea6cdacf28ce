#pragma once

// Problems and runs of a synthesis, as documents, texts and files have them.

#include <string>
#include <vector>

#include "reprise/study/documents.hpp"
#include "reprise/study/synthesis_run.hpp"

namespace reprise {

/// SO, MO or D, as the thesis calls the kinds of synthesis.
const char* kind_of(const std::vector<OrientationRange>& orientations);

/// "orientation -5, 0 degrees", "all orientations from -5 to 5 degrees".
std::string orientations_text(const std::vector<OrientationRange>& orientations);

/// What both documents begin with.
Json problem_json(const ProblemInput& problem, const SynthesisSettings& settings);

/// What is proved of a design over the whole workspace and range, in sentences, a line each.
std::string proof_text(const DesignProof& proof, const std::vector<OrientationRange>& orientations);

/// How a run ended, in the optimizer's own words, said to be that; one line.
std::string ending_text(const SynthesisOutcome& run);

/// "yes", "no" or "undecided".
const char* reach_word(const DesignProof& proof);

/// The keys of what is proved.
Json proof_json(const DesignProof& proof);

/// The outcome of a run as documents have it, lengths in the file's unit.
Json run_json(const SynthesisOutcome& run, double unit);

/// The history of a run, point by point, lengths in the file's unit.
Json history_json(const SynthesisOutcome& run, double unit);

/// The manipulator of a design, with the unit and the conditioning of the file.
ManipulatorInput found_manipulator(const ProblemInput& problem, const Eigen::VectorXd& design);

}  // namespace reprise
