#include "reprise/optimizers/iterate_record.hpp"

#include <cmath>
#include <utility>

namespace reprise {

bool is_better(double f, double violation, double other_f, double other_violation, double tolerance) {
  if (!std::isfinite(f) || std::isnan(violation)) return false;
  if (!std::isfinite(other_f) || std::isnan(other_violation)) return true;
  const bool feasible = violation <= tolerance;
  const bool other_feasible = other_violation <= tolerance;
  if (feasible != other_feasible) return feasible;
  return feasible ? f < other_f : violation < other_violation;
}

IterateRecord::IterateRecord(const Options& options, Observer observer)
    : options_(options), observer_(std::move(observer)) {}

bool IterateRecord::add(Iterate iterate) {
  iterate.index = iterates_++;
  if (!best_ || is_better(iterate.f, iterate.violation, best_->f, best_->violation, options_.feasibility_tolerance)) {
    best_ = iterate;
  }
  const bool go_on = !observer_ || observer_(iterate);
  if (options_.record_history) history_.push_back(std::move(iterate));
  return go_on;
}

}  // namespace reprise
