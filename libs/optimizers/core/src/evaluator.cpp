#include "reprise/optimizers/evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace reprise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

bool is_better(double f, double violation, double other_f, double other_violation, double tolerance) {
  if (!std::isfinite(f) || std::isnan(violation)) return false;
  if (!std::isfinite(other_f) || std::isnan(other_violation)) return true;
  const bool feasible = violation <= tolerance;
  const bool other_feasible = other_violation <= tolerance;
  if (feasible != other_feasible) return feasible;
  return feasible ? f < other_f : violation < other_violation;
}

Evaluator::Evaluator(const Problem& problem, const Eigen::VectorXd& x0, const Options& options, Observer observer,
                     bool every_point_is_an_iterate)
    : problem_(problem),
      options_(options),
      observer_(std::move(observer)),
      every_point_is_an_iterate_(every_point_is_an_iterate),
      position_of_(static_cast<std::size_t>(problem.n), -1),
      full_x_(x0),
      g_(problem.inequalities),
      h_(problem.equalities),
      full_gradient_(problem.n),
      full_inequality_jacobian_(problem.inequalities, problem.n),
      full_equality_jacobian_(problem.equalities, problem.n),
      full_hessian_(problem.n, problem.n) {
  const bool bounded_below = problem.lower.size() != 0;
  const bool bounded_above = problem.upper.size() != 0;
  for (Eigen::Index i = 0; i < problem.n; ++i) {
    const bool fixed = bounded_below && bounded_above && problem.lower[i] == problem.upper[i];
    if (fixed) {
      full_x_[i] = problem.lower[i];
    } else {
      position_of_[static_cast<std::size_t>(i)] = n();
      free_.push_back(i);
    }
  }
  full_start_ = full_x_;
  own_lower_ = bounded_below ? gather(problem.lower) : Eigen::VectorXd::Constant(n(), -infinity);
  own_upper_ = bounded_above ? gather(problem.upper) : Eigen::VectorXd::Constant(n(), infinity);
  lower_ = own_lower_;
  upper_ = own_upper_;
  units_.setOnes(n());
  gradient_.resize(n());
}

Eigen::VectorXd Evaluator::gather(const Eigen::VectorXd& full) const {
  Eigen::VectorXd result(n());
  for (Eigen::Index i = 0; i < n(); ++i) result[i] = full[free_[static_cast<std::size_t>(i)]];
  return result;
}

Eigen::VectorXd Evaluator::measure(const Eigen::VectorXd& start, Measured measured) {
  if (known_.point) point_ = point_.cwiseProduct(units_);
  units_.setOnes();
  objective_unit_ = 1.0;
  lower_ = own_lower_;
  upper_ = own_upper_;
  known_.objective_gradient = known_.inequality_jacobian = known_.equality_jacobian = known_.differences = false;
  Eigen::VectorXd units = units_;
  if (measured.variables) {
    units = start.cwiseAbs().cwiseMax(1.0).cwiseMin(own_upper_ - own_lower_);
  }
  double objective_unit = 1.0;
  if (measured.slope > 0.0) {
    constexpr double least = 1e-9;
    const Eigen::VectorXd slope = units.cwiseProduct(objective_gradient(start));
    const double largest = slope.allFinite() ? slope.lpNorm<Eigen::Infinity>() : 0.0;
    if (largest >= least) objective_unit = largest / measured.slope;
  }
  units_ = units;
  objective_unit_ = objective_unit;
  lower_ = own_lower_.cwiseQuotient(units_);
  upper_ = own_upper_.cwiseQuotient(units_);
  Eigen::VectorXd measured_start = start.cwiseQuotient(units_);
  if (known_.point && point_ == start) {
    point_ = measured_start;
    gradient_ = gradient_.cwiseProduct(units_) / objective_unit_;
  }
  return measured_start;
}

void Evaluator::spread(const Eigen::VectorXd& x) {
  for (Eigen::Index i = 0; i < n(); ++i) {
    double value = units_[i] * x[i];
    if (x[i] <= lower_[i] || value < own_lower_[i]) value = own_lower_[i];
    if (x[i] >= upper_[i] || value > own_upper_[i]) value = own_upper_[i];
    full_x_[free_[static_cast<std::size_t>(i)]] = value;
  }
}

void Evaluator::move_to(const Eigen::VectorXd& x) {
  if (known_.point && point_ == x) return;
  point_ = x;
  known_ = Known{.point = true};
  spread(x);
}

void Evaluator::count_point(long& count) {
  if (options_.stop && !settling_ && options_.stop()) {
    stop_status_ = Status::stopped;
    stop_reason_ = "it was asked to stop";
    throw StopRequest{};
  }
  if (!settling_ && count >= options_.max_function_evaluations) {
    stop_status_ = Status::evaluation_limit;
    stop_reason_ = "the limit on function evaluations was reached";
    throw StopRequest{};
  }
  ++count;
}

double Evaluator::call_objective() {
  count_point(counts_.objective);
  return problem_.objective(full_x_);
}

void Evaluator::call_inequality(Eigen::VectorXd& g) {
  count_point(counts_.inequality);
  problem_.inequality(full_x_, g);
}

void Evaluator::call_equality(Eigen::VectorXd& h) {
  count_point(counts_.equality);
  problem_.equality(full_x_, h);
}

double Evaluator::objective(const Eigen::VectorXd& x) {
  move_to(x);
  if (!known_.objective) {
    f_ = call_objective();
    known_.objective = true;
  }
  if (every_point_is_an_iterate_) record();
  return f_ / objective_unit_;
}

const Eigen::VectorXd& Evaluator::inequality(const Eigen::VectorXd& x) {
  move_to(x);
  if (!known_.inequality && problem_.inequality) call_inequality(g_);
  known_.inequality = true;
  return g_;
}

const Eigen::VectorXd& Evaluator::equality(const Eigen::VectorXd& x) {
  move_to(x);
  if (!known_.equality && problem_.equality) call_equality(h_);
  known_.equality = true;
  return h_;
}

double Evaluator::violation(const Eigen::VectorXd& x) {
  inequality(x);
  equality(x);
  return largest_violation(problem_, full_x_, g_, h_);
}

void Evaluator::record() {
  if (known_.recorded) return;
  known_.recorded = true;
  Iterate iterate;
  iterate.index = iterates_++;
  objective(point_);
  iterate.f = f_;
  iterate.violation = violation(point_);
  iterate.x = full_x_;
  iterate.counts = counts_;
  if (!best_ || is_better(iterate.f, iterate.violation, best_->f, best_->violation, options_.feasibility_tolerance)) {
    best_ = iterate;
  }
  const bool go_on = !observer_ || observer_(iterate);
  if (options_.record_history) history_.push_back(std::move(iterate));
  if (!go_on) {
    stop_status_ = Status::stopped;
    stop_reason_ = "the observer asked to stop";
    throw StopRequest{};
  }
}

Iterate Evaluator::settle(const std::optional<Eigen::VectorXd>& x, bool at_best) {
  const bool given = x && x->allFinite();
  if (best_ && (at_best || !given)) return *best_;
  if (given) {
    move_to(*x);
    // A difference that was broken off may have left the full point beside the remembered one.
    spread(*x);
  } else {
    if (known_.point) spread(point_);
    if (full_x_ != full_start_) known_ = Known{};
    full_x_ = full_start_;
  }
  if (best_ && best_->x == full_x_) return *best_;
  settling_ = true;
  if (!known_.objective) f_ = call_objective();
  if (!known_.inequality && problem_.inequality) call_inequality(g_);
  if (!known_.equality && problem_.equality) call_equality(h_);
  known_.objective = known_.inequality = known_.equality = true;
  settling_ = false;
  Iterate result;
  result.x = full_x_;
  result.f = f_;
  result.violation = largest_violation(problem_, full_x_, g_, h_);
  return result;
}

void Evaluator::differentiate() {
  if (known_.differences) return;
  const bool of_objective = !is_exact(static_cast<bool>(problem_.objective_gradient));
  const bool of_inequality = problem_.inequality && !is_exact(static_cast<bool>(problem_.inequality_jacobian));
  const bool of_equality = problem_.equality && !is_exact(static_cast<bool>(problem_.equality_jacobian));
  if (of_objective) objective(point_);
  if (of_inequality) inequality(point_);
  if (of_equality) equality(point_);
  if (of_inequality) inequality_differences_.resize(g_.size(), n());
  if (of_equality) equality_differences_.resize(h_.size(), n());
  g_above_.resize(g_.size());
  g_below_.resize(g_.size());
  h_above_.resize(h_.size());
  h_below_.resize(h_.size());

  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const bool central = options_.derivatives != Derivatives::forward;
  for (Eigen::Index i = 0; i < n(); ++i) {
    const Eigen::Index full = free_[static_cast<std::size_t>(i)];
    const double x = full_x_[full];
    const double natural_step = (central ? std::cbrt(epsilon) : std::sqrt(epsilon)) * std::max(1.0, std::abs(x));
    const double step = options_.difference_step.value_or(natural_step);
    // Bounds are kept: a step is cut where they end, and a forward difference turns where there is more room behind.
    double above = std::min(x + step, own_upper_[i]);
    double below = std::max(x - step, own_lower_[i]);
    if (!central) (above - x >= x - below ? below : above) = x;

    const auto evaluate_at = [&](double value, double& f, Eigen::VectorXd& g, Eigen::VectorXd& h) {
      if (value == x) {
        f = f_;
        g = g_;
        h = h_;
        return;
      }
      full_x_[full] = value;
      if (of_objective) f = call_objective();
      if (of_inequality) call_inequality(g);
      if (of_equality) call_equality(h);
      full_x_[full] = x;
    };
    double f_above = 0.0;
    double f_below = 0.0;
    evaluate_at(above, f_above, g_above_, h_above_);
    evaluate_at(below, f_below, g_below_, h_below_);
    const double width = above - below;
    if (of_objective) gradient_[i] = units_[i] * (f_above - f_below) / width / objective_unit_;
    if (of_inequality) inequality_differences_.col(i) = (g_above_ - g_below_) / width;
    if (of_equality) equality_differences_.col(i) = (h_above_ - h_below_) / width;
  }
  known_.differences = true;
}

void Evaluator::scale_columns(SparseMatrix& jacobian) const {
  for (Eigen::Index row = 0; row < jacobian.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator entry(jacobian, row); entry; ++entry) entry.valueRef() *= units_[entry.col()];
  }
}

void Evaluator::restrict_columns(const SparseMatrix& full, SparseMatrix& reduced) const {
  if (n() == problem_.n) {
    reduced = full;
    return;
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(full.nonZeros()));
  for (Eigen::Index row = 0; row < full.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator entry(full, row); entry; ++entry) {
      const Eigen::Index column = position_of_[static_cast<std::size_t>(entry.col())];
      if (column >= 0) entries.emplace_back(static_cast<int>(row), static_cast<int>(column), entry.value());
    }
  }
  reduced.resize(full.rows(), n());
  reduced.setFromTriplets(entries.begin(), entries.end());
}

const Eigen::VectorXd& Evaluator::objective_gradient(const Eigen::VectorXd& x) {
  objective(x);
  record();
  if (known_.objective_gradient) return gradient_;
  ++counts_.objective_gradient;
  if (is_exact(static_cast<bool>(problem_.objective_gradient))) {
    problem_.objective_gradient(full_x_, full_gradient_);
    for (Eigen::Index i = 0; i < n(); ++i) {
      gradient_[i] = units_[i] * full_gradient_[free_[static_cast<std::size_t>(i)]] / objective_unit_;
    }
  } else {
    differentiate();
  }
  known_.objective_gradient = true;
  return gradient_;
}

const SparseMatrix& Evaluator::inequality_jacobian(const Eigen::VectorXd& x) {
  inequality(x);
  if (known_.inequality_jacobian) return inequality_jacobian_;
  if (problem_.inequality) {
    ++counts_.inequality_jacobian;
    if (is_exact(static_cast<bool>(problem_.inequality_jacobian))) {
      problem_.inequality_jacobian(full_x_, full_inequality_jacobian_);
      restrict_columns(full_inequality_jacobian_, inequality_jacobian_);
    } else {
      differentiate();
      assign_dense(inequality_differences_, inequality_jacobian_);
    }
    scale_columns(inequality_jacobian_);
  } else {
    inequality_jacobian_.resize(0, n());
  }
  known_.inequality_jacobian = true;
  return inequality_jacobian_;
}

const SparseMatrix& Evaluator::equality_jacobian(const Eigen::VectorXd& x) {
  equality(x);
  if (known_.equality_jacobian) return equality_jacobian_;
  if (problem_.equality) {
    ++counts_.equality_jacobian;
    if (is_exact(static_cast<bool>(problem_.equality_jacobian))) {
      problem_.equality_jacobian(full_x_, full_equality_jacobian_);
      restrict_columns(full_equality_jacobian_, equality_jacobian_);
    } else {
      differentiate();
      assign_dense(equality_differences_, equality_jacobian_);
    }
    scale_columns(equality_jacobian_);
  } else {
    equality_jacobian_.resize(0, n());
  }
  known_.equality_jacobian = true;
  return equality_jacobian_;
}

const SparseMatrix& Evaluator::lagrangian_hessian(const Eigen::VectorXd& x, double objective_factor,
                                                  const Eigen::VectorXd& inequality_multipliers,
                                                  const Eigen::VectorXd& equality_multipliers) {
  move_to(x);
  ++counts_.lagrangian_hessian;
  problem_.lagrangian_hessian(full_x_, objective_factor / objective_unit_, inequality_multipliers, equality_multipliers,
                              full_hessian_);
  restrict_columns(full_hessian_, hessian_);
  if (n() != problem_.n) {
    // The rows of the fixed variables go too; the transpose turns rows into columns for the same restriction.
    const SparseMatrix transposed = hessian_.transpose();
    SparseMatrix reduced;
    restrict_columns(transposed, reduced);
    hessian_ = reduced.transpose();
  }
  for (Eigen::Index row = 0; row < hessian_.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator entry(hessian_, row); entry; ++entry) {
      entry.valueRef() *= units_[row] * units_[entry.col()];
    }
  }
  return hessian_;
}

}  // namespace reprise
