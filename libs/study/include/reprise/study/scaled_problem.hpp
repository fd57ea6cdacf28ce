#pragma once

// A problem in a unit of length that fits it.

#include <Eigen/Core>

#include "reprise/study/problem_file.hpp"

namespace reprise {

/// A design reaches the workspace when no limit is violated there by more than this, in units.
constexpr double reach_tolerance = 1e-4;

/// A problem with lengths counted in a unit in which the longest leg is 2, as the thesis has it, so that tolerances and
/// move limits fit a manipulator of any size. The printed normalisation depends on the unit of length; there the unit
/// is that of the file.
struct ScaledProblem {
  double unit;            ///< in the file's unit of length
  SynthesisTask task;     ///< in units
  Eigen::VectorXd start;  ///< d, in units
  SynthesisTask own;      ///< in the file's own unit
};

/// The problem in that unit.
ScaledProblem scale(const ProblemInput& problem);

}  // namespace reprise
