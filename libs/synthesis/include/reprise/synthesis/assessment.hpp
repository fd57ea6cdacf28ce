#pragma once

// How good a design is for a synthesis (synthesis_task.hpp), seen from outside of any formulation.

#include <Eigen/Core>
#include <vector>

#include "reprise/synthesis/synthesis_task.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

/// A design seen from outside of any formulation: over `points` directions of the outline and its corners.
struct Assessment {
  double kappa_inverse = 0.0;              ///< smallest kappa^-1 at the ends of the ranges
  Eigen::Vector2d kappa_inverse_at;        ///< where
  double kappa_inverse_orientation = 0.0;  ///< at which end, radians
  /// Smallest kappa^-1 at `orientations` equally spaced orientations of each range, its ends among them.
  double kappa_inverse_throughout = 0.0;
  /// Largest violation of a leg's limit at any orientation of the ranges, in closed form; a length, 0 when none is
  /// violated.
  double violation = 0.0;
  Eigen::Vector2d violation_at;        ///< where the largest value of a limit is, violated or not
  double violation_orientation = 0.0;  ///< at which orientation, radians
  Limit violation_limit;               ///< which limit it is
};

/// Throws std::invalid_argument as validate does, and when points < 1 or orientations < 2.
Assessment assess(const SynthesisTask& task, const Eigen::VectorXd& design, int points = 2000, int orientations = 21);

/// assess for many designs of one task: the points of the outline are found once.
class Assessor {
 public:
  /// Throws as assess does.
  explicit Assessor(SynthesisTask task, int points = 2000, int orientations = 21);

  /// What assess gives for this design.
  Assessment operator()(const Eigen::VectorXd& design) const;

 private:
  SynthesisTask task_;
  int orientations_;
  std::vector<Eigen::Vector2d> positions_;
};

}  // namespace reprise
