#pragma once

// The judge of a comparison. It looks from outside at the points a solver came by, and asks no solver for its opinion.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "reprise/io/figure.hpp"
#include "reprise/io/table.hpp"
#include "reprise/optimizers/result.hpp"

namespace reprise::experiments {

/// A point meets the target when (f - f*) / max(1, |f*|) and its largest violation are at most these. A point that is
/// better than the known optimum meets it as well.
struct Target {
  double f_error = 1e-5;
  double violation = 1e-6;
};

/// (f - f*) / max(1, |f*|).
double relative_error(double f, double f_optimum);

bool meets(double f, double violation, double f_optimum, const Target& target);

struct Judgement {
  bool solved = false;
  /// Up to the first iterate that meets the target (a gradient there is not needed any more); of the whole run when
  /// none does.
  Counts counts;
  double f = 0.0;  ///< of that iterate; of the result when none meets the target
  double f_error = 0.0;
  double violation = 0.0;
  bool claimed = false;  ///< the solver says that it converged

  /// The solver says that it converged, and no point of its run meets the target.
  bool false_success() const { return claimed && !solved; }
};

/// Judges a run with its history.
Judgement judge(const Result& result, double f_optimum, const Target& target);

/// What a run costs, in gradient evaluations: (N_f + n N_g) / (n + 1). A gradient is worth n function values, as
/// forward differences are; for a method that takes one function value with every gradient the cost is N_g, for one
/// without gradients N_f / (n + 1).
double cost_in_gradients(const Counts& counts, Eigen::Index n);

/// The start with every coordinate moved by a random part of size max(1, |x_i|). The random numbers are our own
/// (splitmix64; S. Vigna, public domain), so that a seed means the same start with every standard library.
Eigen::VectorXd moved_start(const Eigen::VectorXd& start, double size, std::uint64_t seed);

/// A run in a profile; the cost is infinite where the target was not met.
struct RunCost {
  std::string problem;
  std::string solver;
  double cost;
  int start = 0;  ///< number of the start: a solver has one run for every problem from each
};

/// The profiles of several sets of runs, in panels: rows panel, profile, solver, x, fraction, lowest, highest. From
/// each start, the fraction of the panel's problems that a solver solves steps up at some x; these are the median, the
/// lowest and the highest of it over the solver's starts. Profile `data`: x is the cost (J. J. More, S. M. Wild, SIAM
/// J. Optim. 20 (2009) 172-191). Profile `performance`: x is the cost over the least cost of any solver of the panel
/// for that problem from that start (E. D. Dolan, J. J. More, Math. Program. 91 (2002) 201-213). The first row of every
/// solver is at x = 1.
Table compute_profiles(const std::string& title,
                       const std::vector<std::pair<std::string, std::vector<RunCost>>>& panels,
                       const std::vector<std::string>& notes = {});

/// How the line of a solver looks in every picture, as options of gnuplot's plot command; one colour for each family.
std::string line_style(const std::string& solver);

/// Draws one of the profiles of such a table, the median as a line in its range, with x up to the given value.
Figure draw_profiles(const Table& profiles, const std::string& profile, double largest_x);

}  // namespace reprise::experiments
