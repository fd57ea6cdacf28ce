#pragma once

// What synthesize and compare have in common: the problem in a unit that fits it, and what the user may choose.

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "reprise/io/options.hpp"
#include "reprise/study/formulation.hpp"
#include "reprise/study/problem_file.hpp"
#include "reprise/study/solvers.hpp"

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

/// When a search is to end early: at a time limit, or by a signal such as that of Ctrl-C.
class Stop {
 public:
  /// The time counts from here.
  explicit Stop(std::optional<double> seconds) : seconds_(seconds), begin_(std::chrono::steady_clock::now()) {}

  bool operator()() const;  ///< whether it is time to end

  /// Why the search has ended early, as the beginning of a sentence: "Stopped after 10 s". Empty when it was not to.
  std::string reason() const;

 private:
  bool time_is_up() const;

  std::optional<double> seconds_;
  std::chrono::steady_clock::time_point begin_;
};

/// The problem in that unit.
ScaledProblem scale(const ProblemInput& problem);

/// What both commands let the user choose.
struct SynthesisSettings {
  std::string formulation = "pointwise";  ///< "pointwise" or "area"
  long points = 1000;                     ///< of the outline, in the pointwise formulation
  std::optional<double> chord;            ///< d, a length; none: the standard of the formulation
  long max_evaluations = 5000;            ///< of one optimizer from one start
  long seed = 1;                          ///< of the starts that are drawn
  std::optional<double> time;             ///< seconds for the whole search; none: no limit

  /// Adds the options to a command line.
  void declare(CommandLine& options);

  Formulation kind() const;  ///< the formulation of that name

  /// Solvers by name, with options that fit the formulation.
  std::vector<NamedSolver> solvers(const std::vector<std::string>& names) const;
};

}  // namespace reprise
