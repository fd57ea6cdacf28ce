#pragma once

// What synthesize and compare have in common: what the user may choose.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "reprise/io/options.hpp"
#include "reprise/study/formulation.hpp"
#include "reprise/study/scaled_problem.hpp"
#include "reprise/study/solvers.hpp"

namespace reprise {

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
