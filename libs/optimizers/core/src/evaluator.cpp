#include "reprise/optimizers/evaluator.hpp"

#include <utility>

#include "reprise/optimizers/tolerances.hpp"

namespace reprise {

Evaluator::Evaluator(const Problem& problem, const Eigen::VectorXd& x0, const Options& options, Observer observer,
                     bool every_point_is_an_iterate)
    : problem_(problem),
      options_(options),
      every_point_is_an_iterate_(every_point_is_an_iterate),
      variables_(problem),
      functions_(problem, options),
      record_(options, std::move(observer)),
      full_x_(x0),
      full_start_(x0),
      g_(problem.inequalities),
      h_(problem.equalities),
      gradient_(variables_.n()),
      full_gradient_(problem.n),
      full_inequality_jacobian_(problem.inequalities, problem.n),
      full_equality_jacobian_(problem.equalities, problem.n),
      full_hessian_(problem.n, problem.n) {}

Eigen::VectorXd Evaluator::measure(const Eigen::VectorXd& start, Measured measured) {
  if (known_.point) point_ = point_.cwiseProduct(variables_.units());
  variables_.set_units(Eigen::VectorXd::Ones(n()));
  objective_unit_ = 1.0;
  known_.objective_gradient = known_.inequality_jacobian = known_.equality_jacobian = known_.differences = false;
  Eigen::VectorXd units = variables_.units();
  if (measured.variables) units = start.cwiseAbs().cwiseMax(1.0).cwiseMin(upper() - lower());
  double objective_unit = 1.0;
  if (measured.slope > 0.0) {
    const Eigen::VectorXd slope = units.cwiseProduct(objective_gradient(start));
    const double largest = slope.allFinite() ? slope.lpNorm<Eigen::Infinity>() : 0.0;
    if (largest >= least_slope) objective_unit = largest / measured.slope;
  }
  variables_.set_units(units);
  objective_unit_ = objective_unit;
  Eigen::VectorXd measured_start = start.cwiseQuotient(units);
  if (known_.point && point_ == start) {
    point_ = measured_start;
    gradient_ = gradient_.cwiseProduct(units) / objective_unit_;
  }
  return measured_start;
}

void Evaluator::move_to(const Eigen::VectorXd& x) {
  if (known_.point && point_ == x) return;
  point_ = x;
  known_ = Known{.point = true};
  variables_.spread(x, full_x_);
}

void Evaluator::know_objective() {
  if (!known_.objective) f_ = functions_.objective(full_x_);
  known_.objective = true;
}

void Evaluator::know_inequality() {
  if (!known_.inequality) functions_.inequality(full_x_, g_);
  known_.inequality = true;
}

void Evaluator::know_equality() {
  if (!known_.equality) functions_.equality(full_x_, h_);
  known_.equality = true;
}

double Evaluator::objective(const Eigen::VectorXd& x) {
  move_to(x);
  know_objective();
  if (every_point_is_an_iterate_) record_iterate();
  return f_ / objective_unit_;
}

const Eigen::VectorXd& Evaluator::inequality(const Eigen::VectorXd& x) {
  move_to(x);
  know_inequality();
  return g_;
}

const Eigen::VectorXd& Evaluator::equality(const Eigen::VectorXd& x) {
  move_to(x);
  know_equality();
  return h_;
}

double Evaluator::violation(const Eigen::VectorXd& x) {
  inequality(x);
  equality(x);
  return largest_violation(problem_, full_x_, g_, h_);
}

Iterate Evaluator::iterate() const {
  Iterate result;
  result.x = full_x_;
  result.f = f_;
  result.g = g_;
  result.h = h_;
  result.violation = largest_violation(problem_, full_x_, g_, h_);
  result.counts = functions_.counts();
  return result;
}

void Evaluator::record_iterate() {
  if (known_.recorded) return;
  known_.recorded = true;
  know_objective();
  know_inequality();
  know_equality();
  if (!record_.add(iterate())) throw StopRequest{Status::stopped, "the observer asked to stop", &problem_};
}

Iterate Evaluator::settle(const std::optional<Eigen::VectorXd>& x) {
  if (x) {
    move_to(*x);
  } else {
    if (full_x_ != full_start_) known_ = Known{};
    full_x_ = full_start_;
  }
  if (record_.best() && record_.best()->x == full_x_) return *record_.best();
  functions_.set_limited(false);
  know_objective();
  know_inequality();
  know_equality();
  functions_.set_limited(true);
  return iterate();
}

void Evaluator::take_differences() {
  if (known_.differences) return;
  if (!functions_.has_objective_gradient()) objective(point_);
  if (!functions_.has_inequality_jacobian()) know_inequality();
  if (!functions_.has_equality_jacobian()) know_equality();
  differences_.take(functions_, variables_, options_, full_x_, f_, g_, h_);
  known_.differences = true;
}

const Eigen::VectorXd& Evaluator::objective_gradient(const Eigen::VectorXd& x) {
  objective(x);
  record_iterate();
  if (known_.objective_gradient) return gradient_;
  if (functions_.objective_gradient(full_x_, full_gradient_)) {
    for (Eigen::Index i = 0; i < n(); ++i) {
      gradient_[i] = variables_.units()[i] * full_gradient_[variables_.place(i)] / objective_unit_;
    }
  } else {
    take_differences();
    gradient_ = variables_.units().cwiseProduct(differences_.objective_changes()).cwiseQuotient(differences_.widths()) /
                objective_unit_;
  }
  known_.objective_gradient = true;
  return gradient_;
}

const SparseMatrix& Evaluator::inequality_jacobian(const Eigen::VectorXd& x) {
  inequality(x);
  if (known_.inequality_jacobian) return inequality_jacobian_;
  if (!problem_.inequality) {
    inequality_jacobian_.resize(0, n());
  } else if (functions_.inequality_jacobian(full_x_, full_inequality_jacobian_, !known_.some_rows)) {
    variables_.restrict_columns(full_inequality_jacobian_, inequality_jacobian_);
  } else {
    take_differences();
    assign_dense(differences_.inequality(), inequality_jacobian_);
  }
  variables_.to_solver(inequality_jacobian_);
  known_.inequality_jacobian = true;
  return inequality_jacobian_;
}

SparseMatrix Evaluator::inequality_jacobian_rows(const Eigen::VectorXd& x, const std::vector<Eigen::Index>& rows) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  inequality(x);
  SparseMatrix some(count, n());
  if (!known_.inequality_jacobian && functions_.has_inequality_jacobian_rows()) {
    SparseMatrix full(count, problem_.n);
    functions_.inequality_jacobian_rows(full_x_, rows, full, !known_.some_rows);
    known_.some_rows = true;
    variables_.restrict_columns(full, some);
    variables_.to_solver(some);
    return some;
  }
  const SparseMatrix& whole = inequality_jacobian(x);
  for (Eigen::Index i = 0; i < count; ++i) {
    some.startVec(i);
    for (SparseMatrix::InnerIterator entry(whole, rows[static_cast<std::size_t>(i)]); entry; ++entry) {
      some.insertBack(i, entry.col()) = entry.value();
    }
  }
  some.finalize();
  return some;
}

const SparseMatrix& Evaluator::equality_jacobian(const Eigen::VectorXd& x) {
  equality(x);
  if (known_.equality_jacobian) return equality_jacobian_;
  if (!problem_.equality) {
    equality_jacobian_.resize(0, n());
  } else if (functions_.equality_jacobian(full_x_, full_equality_jacobian_)) {
    variables_.restrict_columns(full_equality_jacobian_, equality_jacobian_);
  } else {
    take_differences();
    assign_dense(differences_.equality(), equality_jacobian_);
  }
  variables_.to_solver(equality_jacobian_);
  known_.equality_jacobian = true;
  return equality_jacobian_;
}

const SparseMatrix& Evaluator::lagrangian_hessian(const Eigen::VectorXd& x, double objective_factor,
                                                  const Eigen::VectorXd& inequality_multipliers,
                                                  const Eigen::VectorXd& equality_multipliers) {
  move_to(x);
  functions_.lagrangian_hessian(full_x_, objective_factor / objective_unit_, inequality_multipliers,
                                equality_multipliers, full_hessian_);
  variables_.restrict_both(full_hessian_, hessian_);
  variables_.to_solver_twice(hessian_);
  return hessian_;
}

}  // namespace reprise
