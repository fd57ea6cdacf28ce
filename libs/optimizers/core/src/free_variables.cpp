#include "reprise/optimizers/free_variables.hpp"

#include "reprise/base/constants.hpp"

namespace reprise {

FreeVariables::FreeVariables(const Problem& problem) : position_of_(static_cast<std::size_t>(problem.n), -1) {
  const bool bounded_below = problem.lower.size() != 0;
  const bool bounded_above = problem.upper.size() != 0;
  for (Eigen::Index i = 0; i < problem.n; ++i) {
    if (bounded_below && bounded_above && problem.lower[i] == problem.upper[i]) continue;
    position_of_[static_cast<std::size_t>(i)] = n();
    places_.push_back(i);
  }
  own_lower_ = bounded_below ? gather(problem.lower) : Eigen::VectorXd::Constant(n(), -infinity);
  own_upper_ = bounded_above ? gather(problem.upper) : Eigen::VectorXd::Constant(n(), infinity);
  set_units(Eigen::VectorXd::Ones(n()));
}

void FreeVariables::set_units(const Eigen::VectorXd& units) {
  units_ = units;
  lower_ = own_lower_.cwiseQuotient(units_);
  upper_ = own_upper_.cwiseQuotient(units_);
}

Eigen::VectorXd FreeVariables::gather(const Eigen::VectorXd& full) const {
  Eigen::VectorXd result(n());
  for (Eigen::Index i = 0; i < n(); ++i) result[i] = full[place(i)];
  return result;
}

void FreeVariables::spread(const Eigen::VectorXd& x, Eigen::VectorXd& full) const {
  for (Eigen::Index i = 0; i < n(); ++i) {
    double value = units_[i] * x[i];
    if (x[i] <= lower_[i] || value < own_lower_[i]) value = own_lower_[i];
    if (x[i] >= upper_[i] || value > own_upper_[i]) value = own_upper_[i];
    full[place(i)] = value;
  }
}

void FreeVariables::restrict_columns(const SparseMatrix& full, SparseMatrix& reduced) const {
  if (n() == full.cols()) {
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

void FreeVariables::restrict_both(const SparseMatrix& full, SparseMatrix& reduced) const {
  restrict_columns(full, reduced);
  if (n() == full.rows()) return;
  // The transpose turns rows into columns for the same restriction.
  const SparseMatrix transposed = reduced.transpose();
  SparseMatrix both;
  restrict_columns(transposed, both);
  reduced = both.transpose();
}

void FreeVariables::to_solver(SparseMatrix& jacobian) const {
  for (Eigen::Index row = 0; row < jacobian.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator entry(jacobian, row); entry; ++entry) entry.valueRef() *= units_[entry.col()];
  }
}

void FreeVariables::to_solver_twice(SparseMatrix& hessian) const {
  for (Eigen::Index row = 0; row < hessian.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator entry(hessian, row); entry; ++entry) {
      entry.valueRef() *= units_[row] * units_[entry.col()];
    }
  }
}

}  // namespace reprise
