#include "reprise/optimizers/problem.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"

namespace reprise {
namespace {

[[noreturn]] void reject(const Problem& problem, const std::string& what) {
  throw std::invalid_argument("problem '" + problem.name + "': " + what);
}

void check_bound(const Problem& problem, const char* which, const Eigen::VectorXd& bound) {
  if (bound.size() != 0 && bound.size() != problem.n) {
    reject(problem, std::string(which) + " has " + std::to_string(bound.size()) + " entries, but it must have " +
                        std::to_string(problem.n) + " or none");
  }
  if (bound.hasNaN()) reject(problem, std::string(which) + " has an entry that is not a number");
}

}  // namespace

void validate(const Problem& problem) {
  if (problem.n < 1) reject(problem, "n is " + std::to_string(problem.n) + ", but it must be at least 1");
  if (!problem.objective) reject(problem, "there is no objective");
  check_bound(problem, "lower", problem.lower);
  check_bound(problem, "upper", problem.upper);
  if ((problem.lower.array() == infinity).any()) reject(problem, "lower has an entry +infinity");
  if ((problem.upper.array() == -infinity).any()) reject(problem, "upper has an entry -infinity");
  if (problem.lower.size() != 0 && problem.upper.size() != 0) {
    for (Eigen::Index i = 0; i < problem.n; ++i) {
      if (problem.lower[i] > problem.upper[i]) {
        reject(problem, "the bounds of variable " + std::to_string(i + 1) + " are [" + shown(problem.lower[i]) + ", " +
                            shown(problem.upper[i]) + "], but the lower must not exceed the upper");
      }
    }
  }
  if (problem.inequalities < 0) reject(problem, "the number of inequalities is negative");
  if (problem.equalities < 0) reject(problem, "the number of equalities is negative");
  if ((problem.inequalities > 0) != static_cast<bool>(problem.inequality)) {
    reject(problem, "the number of inequalities does not fit: it must be positive exactly when there is a function");
  }
  if ((problem.equalities > 0) != static_cast<bool>(problem.equality)) {
    reject(problem, "the number of equalities does not fit: it must be positive exactly when there is a function");
  }
}

void assign_dense(const Eigen::MatrixXd& dense, SparseMatrix& sparse) {
  const Eigen::Index entries = dense.size();
  if (sparse.rows() != dense.rows() || sparse.cols() != dense.cols() || sparse.nonZeros() != entries) {
    sparse.resize(dense.rows(), dense.cols());
    sparse.reserve(Eigen::VectorXi::Constant(dense.rows(), static_cast<int>(dense.cols())));
    for (Eigen::Index i = 0; i < dense.rows(); ++i) {
      for (Eigen::Index j = 0; j < dense.cols(); ++j) sparse.insert(i, j) = 0.0;
    }
    sparse.makeCompressed();
  }
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(sparse.valuePtr(), dense.rows(),
                                                                                     dense.cols()) = dense;
}

std::function<void(const Eigen::VectorXd&, SparseMatrix&)> dense_jacobian(
    std::function<void(const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian)> function) {
  return [function = std::move(function)](const Eigen::VectorXd& x, SparseMatrix& jacobian) {
    Eigen::MatrixXd dense(jacobian.rows(), jacobian.cols());
    function(x, dense);
    assign_dense(dense, jacobian);
  };
}

double largest_violation(const Problem& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& g,
                         const Eigen::VectorXd& h) {
  double largest = 0.0;
  // NaN must win: std::max would drop it.
  const auto include = [&largest](double violation) {
    if (std::isnan(violation) || violation > largest) largest = violation;
  };
  for (const double value : g) include(value);
  for (const double value : h) include(std::abs(value));
  if (problem.lower.size() != 0) include((problem.lower - x).maxCoeff<Eigen::PropagateNaN>());
  if (problem.upper.size() != 0) include((x - problem.upper).maxCoeff<Eigen::PropagateNaN>());
  return largest;
}

double largest_violation(const Problem& problem, const Eigen::VectorXd& x) {
  Eigen::VectorXd g(problem.inequalities);
  Eigen::VectorXd h(problem.equalities);
  if (problem.inequality) problem.inequality(x, g);
  if (problem.equality) problem.equality(x, h);
  return largest_violation(problem, x, g, h);
}

}  // namespace reprise
