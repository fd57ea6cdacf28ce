#include "reprise/optimizers/nonnegative_least_squares.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "reprise/base/require.hpp"
#include "sparse_qr.hpp"

namespace reprise {
namespace {

/// min |A x - b| over the x that vanish outside of the set. Rows without an entry there play no part.
Eigen::VectorXd solve_on(const SparseColumns& a, const Eigen::VectorXd& b, const std::vector<Eigen::Index>& set,
                         std::vector<int>& position) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (SparseColumns::InnerIterator entry(a, set[i]); entry; ++entry) {
      int& place = position[static_cast<std::size_t>(entry.row())];
      if (place < 0) {
        place = static_cast<int>(rows.size());
        rows.push_back(entry.row());
      }
      entries.emplace_back(place, static_cast<int>(i), entry.value());
    }
  }
  // A column without entries is no reason to have fewer rows than columns.
  SparseColumns part(std::max(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(set.size())),
                     static_cast<Eigen::Index>(set.size()));
  part.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(part.rows());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    right[static_cast<Eigen::Index>(k)] = b[rows[k]];
    position[static_cast<std::size_t>(rows[k])] = -1;
  }
  const SparseQr factorisation(part);
  const Eigen::VectorXd solution = factorisation.solve(right);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  x(set) = solution;
  return x;
}

}  // namespace

NonnegativeLeastSquares nonnegative_least_squares(const SparseMatrix& given, const Eigen::VectorXd& b,
                                                  NonnegativeLeastSquaresOptions options) {
  require(b.size() == given.rows(), "nonnegative least squares: the number of entries of the right-hand side", b.size(),
          "the number of rows of the matrix");
  const SparseColumns a = given;
  require(b.allFinite(), "nonnegative least squares: the right-hand side", b, "finite");
  require(Eigen::Map<const Eigen::VectorXd>(a.valuePtr(), a.nonZeros()).allFinite(),
          "nonnegative least squares: an entry of the matrix", "not finite", "finite");
  const Eigen::Index n = a.cols();
  if (n == 0) return {Eigen::VectorXd::Zero(0), b.norm(), 0, true};  // Eigen has no norm of an empty sparse matrix
  const double rounding = 10.0 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm();
  std::vector<int> position(static_cast<std::size_t>(a.rows()), -1);
  NonnegativeLeastSquares result{Eigen::VectorXd::Zero(n), b.norm(), 0, false};
  std::vector<Eigen::Index> set;
  std::vector<bool> refused(static_cast<std::size_t>(n), false);
  const Eigen::Index limit = options.max_iterations.value_or(10 * n + 10);
  while (result.iterations < limit) {
    const Eigen::VectorXd rest = b - a * result.x;
    if (rest.norm() <= options.residual_tolerance) {
      result.converged = true;
      break;
    }
    const Eigen::VectorXd slope = a.transpose() * rest;
    Eigen::Index best = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (refused[static_cast<std::size_t>(j)] || std::find(set.begin(), set.end(), j) != set.end()) continue;
      if (slope[j] > rounding && (best < 0 || slope[j] > slope[best])) best = j;
    }
    if (best < 0) {
      result.converged = true;
      break;
    }
    set.push_back(best);
    Eigen::VectorXd wanted = solve_on(a, b, set, position);
    ++result.iterations;
    if (wanted[best] <= 0.0) {  // by rounding: a column that depends on those of the set
      set.pop_back();
      refused[static_cast<std::size_t>(best)] = true;
      continue;
    }
    std::fill(refused.begin(), refused.end(), false);
    while (!set.empty() && wanted(set).minCoeff() <= 0.0) {
      double step = 1.0;
      for (const Eigen::Index j : set) {
        if (wanted[j] <= 0.0) step = std::min(step, result.x[j] / (result.x[j] - wanted[j]));
      }
      for (const Eigen::Index j : set) {
        const bool leaves = wanted[j] <= 0.0 && result.x[j] <= step * (result.x[j] - wanted[j]);
        result.x[j] = leaves ? 0.0 : result.x[j] + step * (wanted[j] - result.x[j]);
      }
      std::erase_if(set, [&](Eigen::Index j) { return result.x[j] <= 0.0; });
      wanted = set.empty() ? Eigen::VectorXd::Zero(n) : solve_on(a, b, set, position);
      ++result.iterations;
    }
    result.x = wanted;
  }
  result.residual = (a * result.x - b).norm();
  return result;
}

}  // namespace reprise
