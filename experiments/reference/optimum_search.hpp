#pragma once

// The best design for a synthesis problem of the chapter, searched for from many starts.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "reprise/optimizers/ipopt.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise::experiments {

/// Optima closer than this in t and in every variable are one.
inline constexpr double same_value = 1e-7;
inline constexpr double same_design = 1e-3;

/// Runs that end this far below the best are poor local optima; they are listed as they are.
inline constexpr double worth_refining = 0.03;

/// The length limits of legs 1, 2, 3.
using Lengths = std::array<Interval, 3>;

struct SearchSettings {
  long starts = 24;         ///< for each sign of r
  long sample_points = 80;  ///< of the outline
  double smallest_r = 0.1;
  double largest_r = 2.0;
};

/// A local optimum and how many starts came to it.
struct LocalOptimum {
  Eigen::VectorXd sampled;  ///< design of the first run, on the sample
  Eigen::VectorXd design;   ///< refined, where it is worth it
  double t;                 ///< smallest kappa^-1
  bool refined;
  long starts;
};

struct Search {
  std::vector<LocalOptimum> optima;  ///< from the best on
  long starts = 0;
  long failed = 0;  ///< runs that did not converge to a design that is feasible on the sample
};

/// Points of Sobol's sequence in the unit cube, its first one (the origin) left out.
std::vector<Eigen::VectorXd> sobol_points(long count, Eigen::Index dimension);

/// Ipopt, accurate to the exchange's tolerance, and so that it keeps to its start: optima lie close to each other.
IpoptSolver make_ipopt();

/// SLSQP from all starts on a sample of the outline, then exchange and Newton's method from the good ends.
Search search_globally(const SynthesisTask& task, const std::vector<Eigen::VectorXd>& starts,
                       const SearchSettings& settings);

/// Both signs of r, each from as many starts.
Search search_both_sides(const SynthesisTask& task, const Lengths& lengths, const SearchSettings& settings);

/// The best of the refined optima that is certified to be one; of those that are alike to rounding, one with the
/// platform as the chapter has it, r > 0, and of these the lower base. Throws std::runtime_error when no start came to
/// a feasible design.
const LocalOptimum& best_of(const SynthesisTask& task, const Search& search);

}  // namespace reprise::experiments
