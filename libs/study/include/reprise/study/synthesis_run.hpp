#pragma once

// One optimizer from one start, and the design it came to as it is seen from outside.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reprise/bounds/design_proof.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/result.hpp"
#include "reprise/study/synthesis_settings.hpp"

namespace reprise {

/// A design on the way, whatever the formulation that it was found by.
struct HistoryPoint {
  long iteration;          ///< 0 for the start
  long evaluations;        ///< up to there
  Eigen::VectorXd design;  ///< in units
  double kappa_inv;        ///< least kappa^-1 at history_points of the outline, at the slices or the ends of the range
  double violation;        ///< largest violation of a limit there, at any orientation asked for; a length of the file
};

/// Points of the outline at which a design on the way is judged.
constexpr int history_points = 100;

/// One optimizer from one start.
struct SynthesisOutcome {
  std::string optimizer;              ///< its name
  Eigen::VectorXd start;              ///< design, in units
  Result result;                      ///< of the solver, in units
  Eigen::VectorXd design;             ///< in units
  DesignProof proof;                  ///< of the design, with the numbers and lengths of the file
  std::vector<HistoryPoint> history;  ///< in the order of the iterates
  double seconds = 0.0;               ///< of wall-clock time

  bool reaches() const { return proof.reaches == Verdict::proved; }  ///< the whole prescribed workspace, proved
};

/// Whether a run is better than another: one that reaches the workspace, then the larger kappa^-1; where neither does,
/// the smaller violation.
bool better(const SynthesisOutcome& one, const SynthesisOutcome& other);

/// What is proved of a design (in units) over the whole workspace and range, with the numbers and lengths of the file.
DesignProof prove(const ScaledProblem& scaled, const Eigen::VectorXd& design);

/// From a start, on the side of the singular poses where it prevails, and where that leads to no design that reaches
/// the workspace without a singular pose, on the other. Ends soon after `stop` says true.
SynthesisOutcome solve(const ScaledProblem& scaled, const SynthesisSettings& settings, const NamedSolver& named,
                       const Eigen::VectorXd& start, const Stop& stop, Progress& progress);

/// The file's design, then random ones: within the bounds where there are both, about the file's design elsewhere.
std::vector<Eigen::VectorXd> make_starts(const ScaledProblem& scaled, long count, long seed);

}  // namespace reprise
