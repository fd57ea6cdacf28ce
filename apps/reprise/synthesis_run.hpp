#pragma once

// One optimizer from one start, and the design it came to as it is seen from outside.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reprise/optimizers/result.hpp"
#include "support/progress.hpp"
#include "synthesis_settings.hpp"

namespace reprise::app {

/// One optimizer from one start.
struct Run {
  std::string optimizer;
  Eigen::VectorXd start;  ///< design, in units
  Result result;
  Eigen::VectorXd design;  ///< in units
  Assessment judged;
  double seconds = 0.0;

  bool reaches() const { return judged.violation <= reach_tolerance; }
};

/// Whether a run is better than another: one that reaches the workspace, then the larger kappa^-1; where neither does,
/// the smaller violation.
bool better(const Run& one, const Run& other);

/// A design as it is seen from outside of any formulation.
Assessment judge(const SynthesisTask& task, const Eigen::VectorXd& design);

/// From a start, on the side of the singular poses where it prevails, and where that leads to no design that reaches
/// the workspace without a singular pose, on the other.
Run solve(const ScaledProblem& scaled, const SynthesisSettings& settings, const experiments::NamedSolver& named,
          const Eigen::VectorXd& start, experiments::Progress& progress);

/// The file's design, then random ones: within the bounds where there are both, about the file's design elsewhere.
std::vector<Eigen::VectorXd> make_starts(const ScaledProblem& scaled, long count, long seed);

}  // namespace reprise::app
