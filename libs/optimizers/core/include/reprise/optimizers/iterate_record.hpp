#pragma once

// For authors of solvers: what is kept of the way of a run.

#include <optional>
#include <utility>
#include <vector>

#include "reprise/optimizers/result.hpp"
#include "reprise/optimizers/solver.hpp"

namespace reprise {

/// True when a point with the first value and violation is the one to keep: finite before not finite, feasible within
/// the tolerance before infeasible, then the lower value or, of two infeasible points, the smaller violation.
bool is_better(double f, double violation, double other_f, double other_violation, double tolerance);

/// The iterates of a run: numbered, shown to the observer, kept as its history, and the best of them by itself.
class IterateRecord {
 public:
  /// The options are kept by reference.
  IterateRecord(const Options& options, Observer observer);

  /// Numbers the iterate and takes it in. Returns false when the observer wants the run to stop.
  bool add(Iterate iterate);

  /// How many have been taken in.
  long size() const { return iterates_; }
  /// None before the first iterate.
  const std::optional<Iterate>& best() const { return best_; }
  /// Empty when the options want none; leaves none behind.
  std::vector<Iterate> take_history() { return std::move(history_); }

 private:
  const Options& options_;
  Observer observer_;
  long iterates_ = 0;
  std::vector<Iterate> history_;
  std::optional<Iterate> best_;
};

}  // namespace reprise
