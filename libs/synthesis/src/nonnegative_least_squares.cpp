#include "reprise/synthesis/nonnegative_least_squares.hpp"

#include <Eigen/SPQRSupport>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace reprise {
namespace {

using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor>;

/// min |A x - b| over the x that vanish outside of the set.
Eigen::VectorXd solve_on(const Columns& a, const Eigen::VectorXd& b, const std::vector<Eigen::Index>& set) {
  Columns part(a.rows(), static_cast<Eigen::Index>(set.size()));
  for (std::size_t i = 0; i < set.size(); ++i) part.col(static_cast<Eigen::Index>(i)) = a.col(set[i]);
  part.makeCompressed();
  Eigen::SPQR<Columns> factorisation(part);
  const Eigen::VectorXd solution = factorisation.solve(b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  x(set) = solution;
  return x;
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("nonnegative least squares: " + what);
}

}  // namespace

NonnegativeLeastSquares nonnegative_least_squares(const SparseMatrix& given, const Eigen::VectorXd& b) {
  require(b.size() == given.rows(), "the right-hand side has " + std::to_string(b.size()) +
                                        " entries, but it must have " + std::to_string(given.rows()));
  const Columns a = given;
  require(b.allFinite() && Eigen::Map<const Eigen::VectorXd>(a.valuePtr(), a.nonZeros()).allFinite(),
          "an entry is not finite");
  const Eigen::Index n = a.cols();
  const double rounding = 10.0 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm();
  NonnegativeLeastSquares result{Eigen::VectorXd::Zero(n), b.norm(), 0, false};
  std::vector<Eigen::Index> set;
  std::vector<bool> refused(static_cast<std::size_t>(n), false);
  while (result.iterations < 10 * n + 10) {
    const Eigen::VectorXd slope = a.transpose() * (b - a * result.x);
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
    Eigen::VectorXd wanted = solve_on(a, b, set);
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
      wanted = set.empty() ? Eigen::VectorXd::Zero(n) : solve_on(a, b, set);
      ++result.iterations;
    }
    result.x = wanted;
  }
  result.residual = (a * result.x - b).norm();
  return result;
}

}  // namespace reprise
