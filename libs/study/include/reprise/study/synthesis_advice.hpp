#pragma once

// What would have to give, where no design that reaches the prescribed workspace was found.

#include <functional>
#include <string>

#include "reprise/study/documents.hpp"
#include "reprise/study/synthesis_run.hpp"

namespace reprise {

/// What would have to give for a workspace to be reached.
struct Advice {      // NOLINT(bugprone-exception-escape): moving a Json throws nothing, clang-tidy cannot see that
  std::string text;  ///< whole lines; empty when there is nothing to say
  Json document;     ///< the key `advice`; null when there is nothing to say
};

/// Called when none of the runs reaches the workspace. `best` is the one that violates the limits least; lengths of
/// `scaled` and `best` are in units of scaled.unit. Ends soon after `stop` (which may be empty) says true.
Advice advise(const ScaledProblem& scaled, const SynthesisSettings& settings, const SynthesisOutcome& best,
              const std::function<bool()>& stop);

}  // namespace reprise
