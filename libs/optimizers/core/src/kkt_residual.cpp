#include "reprise/optimizers/kkt_residual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/nonnegative_least_squares.hpp"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double lower_of(const Problem& problem, Index i) { return problem.lower.size() != 0 ? problem.lower[i] : -infinity; }
double upper_of(const Problem& problem, Index i) { return problem.upper.size() != 0 ? problem.upper[i] : infinity; }

VectorXd within_bounds(const Problem& problem, VectorXd x) {
  if (problem.lower.size() != 0) x = x.cwiseMax(problem.lower);
  if (problem.upper.size() != 0) x = x.cwiseMin(problem.upper);
  return x;
}

bool is_finite(const SparseMatrix& matrix) {
  for (Index row = 0; row < matrix.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
      if (!std::isfinite(entry.value())) return false;
    }
  }
  return true;
}

/// The first derivatives at a point.
struct Slopes {
  VectorXd objective;
  SparseMatrix inequality, equality;

  bool finite() const { return objective.allFinite() && is_finite(inequality) && is_finite(equality); }
  /// Of the Lagrangian.
  VectorXd lagrangian(const VectorXd& inequality_multipliers, const VectorXd& equality_multipliers) const {
    return objective + inequality.transpose() * inequality_multipliers + equality.transpose() * equality_multipliers;
  }
};

/// Central differences of `count` functions in every variable that is not fixed, within the bounds.
template <class Function>
MatrixXd differences(const Problem& problem, const VectorXd& x, const VectorXd& units, Index count,
                     const Function& function) {
  const double relative = std::cbrt(std::numeric_limits<double>::epsilon());
  MatrixXd result = MatrixXd::Zero(count, x.size());
  VectorXd above(count), below(count);
  for (Index i = 0; i < x.size(); ++i) {
    if (units[i] == 0.0) continue;
    VectorXd moved = x;
    moved[i] = std::min(x[i] + relative * units[i], upper_of(problem, i));
    function(moved, above);
    double width = moved[i];
    moved[i] = std::max(x[i] - relative * units[i], lower_of(problem, i));
    function(moved, below);
    width -= moved[i];
    result.col(i) = (above - below) / width;
  }
  return result;
}

Slopes slopes(const Problem& problem, const VectorXd& x, const VectorXd& units) {
  Slopes result{VectorXd(problem.n), SparseMatrix(problem.inequalities, problem.n),
                SparseMatrix(problem.equalities, problem.n)};
  if (problem.objective_gradient) {
    problem.objective_gradient(x, result.objective);
  } else {
    result.objective = differences(problem, x, units, 1, [&](const VectorXd& at, VectorXd& value) {
                         value[0] = problem.objective(at);
                       }).transpose();
  }
  if (problem.inequality_jacobian) {
    problem.inequality_jacobian(x, result.inequality);
  } else if (problem.inequality) {
    assign_dense(differences(problem, x, units, problem.inequalities, problem.inequality), result.inequality);
  }
  if (problem.equality_jacobian) {
    problem.equality_jacobian(x, result.equality);
  } else if (problem.equality) {
    assign_dense(differences(problem, x, units, problem.equalities, problem.equality), result.equality);
  }
  return result;
}

/// The gradient of the Lagrangian, for which constraints whose multiplier is zero count nothing.
VectorXd lagrangian_slope(const Problem& problem, const VectorXd& x, const VectorXd& units,
                          const VectorXd& inequality_multipliers, const VectorXd& equality_multipliers) {
  if (!problem.inequality_jacobian || !problem.inequality_jacobian_rows) {
    return slopes(problem, x, units).lagrangian(inequality_multipliers, equality_multipliers);
  }
  std::vector<Index> rows;
  for (Index j = 0; j < problem.inequalities; ++j) {
    if (inequality_multipliers[j] != 0.0) rows.push_back(j);
  }
  Problem bearing = problem;
  bearing.inequalities = static_cast<Index>(rows.size());
  bearing.inequality_jacobian = [&](const VectorXd& at, SparseMatrix& jacobian) {
    problem.inequality_jacobian_rows(at, rows, jacobian);
  };
  return slopes(bearing, x, units).lagrangian(inequality_multipliers(rows), equality_multipliers);
}

/// The columns of the least-squares problem, each of length 1, and that length.
class Columns {
 public:
  /// Of constraints those count whose value is within `nearness` times the length of the gradient.
  Columns(Index n, double nearness) : rows_(n), nearness_(nearness) {}

  /// Adds the scaled gradient of a constraint with its value where it is not violated, once for each sign.
  void add(const std::vector<std::pair<Index, double>>& gradient, double value, bool both_signs) {
    double square = 0.0;
    for (const auto& [row, entry] : gradient) square += entry * entry;
    const bool near = value * value <= nearness_ * nearness_ * square;
    const double length = near ? std::sqrt(square + value * value) : 0.0;
    for (int side = 0; side < (both_signs ? 2 : 1); ++side) {
      const double sign = side == 0 ? 1.0 : -1.0;
      const auto column = static_cast<int>(lengths_.size());
      lengths_.push_back(length);
      if (length == 0.0) continue;
      for (const auto& [row, entry] : gradient) {
        entries_.emplace_back(static_cast<int>(row), column, sign * entry / length);
      }
      if (value != 0.0) entries_.emplace_back(static_cast<int>(rows_), column, value / length);
    }
    if (length > 0.0 && value != 0.0) ++rows_;
  }

  NonnegativeLeastSquares solve(const VectorXd& slope) const {
    const Index most = 100 + 10 * slope.size();
    SparseMatrix matrix(rows_, static_cast<Index>(lengths_.size()));
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    VectorXd right = VectorXd::Zero(rows_);
    right.head(slope.size()) = -slope;
    NonnegativeLeastSquares solved =
        nonnegative_least_squares(matrix, right, {small_kkt_residual * slope.norm(), most});
    for (Index k = 0; k < solved.x.size(); ++k) {
      const double length = lengths_[static_cast<std::size_t>(k)];
      if (length > 0.0) solved.x[k] /= length;
    }
    return solved;
  }

 private:
  Index rows_;
  double nearness_;
  std::vector<double> lengths_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Puts a row, in the units, in the place of another.
void scale_row(const SparseMatrix& jacobian, Index row, const VectorXd& units,
               std::vector<std::pair<Index, double>>& result) {
  result.clear();
  for (SparseMatrix::InnerIterator entry(jacobian, row); entry; ++entry) {
    result.emplace_back(entry.col(), units[entry.col()] * entry.value());
  }
}

}  // namespace

VectorXd variable_units(const Problem& problem, const VectorXd& x) {
  VectorXd units(problem.n);
  for (Index i = 0; i < problem.n; ++i) {
    units[i] = std::min(std::max(1.0, std::abs(x[i])), upper_of(problem, i) - lower_of(problem, i));
  }
  return units;
}

double kkt_residual(const Problem& problem, const VectorXd& x) {
  validate(problem);
  if (x.size() != problem.n || !x.allFinite()) {
    throw std::invalid_argument("x has " + std::to_string(x.size()) + " entries, but problem '" + problem.name +
                                "' needs " + std::to_string(problem.n) + " finite ones");
  }
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const VectorXd units = variable_units(problem, x);
  const Slopes here = slopes(problem, x, units);
  VectorXd g(problem.inequalities);
  if (problem.inequality) problem.inequality(x, g);
  if (!here.finite() || !g.allFinite()) return not_a_number;

  std::vector<std::pair<Index, double>> bounds;  // the variable, and the sign of the bound's gradient
  const auto multipliers = [&](double nearness) {
    Columns columns(problem.n, nearness);
    std::vector<std::pair<Index, double>> row;
    for (Index j = 0; j < problem.inequalities; ++j) {
      scale_row(here.inequality, j, units, row);
      columns.add(row, std::min(g[j], 0.0), false);
    }
    for (Index k = 0; k < problem.equalities; ++k) {
      scale_row(here.equality, k, units, row);
      columns.add(row, 0.0, true);
    }
    bounds.clear();
    const auto add_bound = [&](Index i, double sign, double value) {
      if (!std::isfinite(value) || units[i] == 0.0) return;
      columns.add({{i, sign * units[i]}}, std::min(value, 0.0), false);
      bounds.emplace_back(i, sign);
    };
    for (Index i = 0; i < problem.n; ++i) {
      add_bound(i, -1.0, lower_of(problem, i) - x[i]);
      add_bound(i, 1.0, x[i] - upper_of(problem, i));
    }
    return columns.solve(units.cwiseProduct(here.objective));
  };
  const VectorXd slope = units.cwiseProduct(here.objective);
  NonnegativeLeastSquares solved = multipliers(nearest_constraints);
  for (double nearness = constraints_step_outwards * nearest_constraints;
       nearness <= farthest_constraints && solved.residual > small_kkt_residual * slope.norm();
       nearness *= constraints_step_outwards) {
    NonnegativeLeastSquares more = multipliers(nearness);
    if (more.residual < solved.residual) solved = std::move(more);
  }

  const VectorXd lambda = solved.x.head(problem.inequalities);
  VectorXd mu(problem.equalities);
  for (Index k = 0; k < problem.equalities; ++k) {
    mu[k] = solved.x[problem.inequalities + 2 * k] - solved.x[problem.inequalities + 2 * k + 1];
  }
  const VectorXd gradient = here.lagrangian(lambda, mu);
  VectorXd left = units.cwiseProduct(gradient);
  for (std::size_t b = 0; b < bounds.size(); ++b) {
    const auto& [i, sign] = bounds[b];
    left[i] += sign * units[i] * solved.x[problem.inequalities + 2 * problem.equalities + static_cast<Index>(b)];
  }

  double size = slope.norm();
  if (const double length = left.norm(); length > 0.0) {
    const VectorXd moved = within_bounds(problem, x - curvature_step / length * units.cwiseProduct(left));
    VectorXd direction = moved - x;
    for (Index i = 0; i < problem.n; ++i) direction[i] = units[i] > 0.0 ? direction[i] / units[i] : 0.0;
    if (direction.squaredNorm() > 0.0) {
      const VectorXd change = lagrangian_slope(problem, moved, units, lambda, mu) - gradient;
      const double curvature = direction.dot(units.cwiseProduct(change)) / direction.squaredNorm();
      if (std::isfinite(curvature)) size = std::max(size, curvature);
    }
  }
  return size > 0.0 ? solved.residual / size : 0.0;
}

}  // namespace reprise
