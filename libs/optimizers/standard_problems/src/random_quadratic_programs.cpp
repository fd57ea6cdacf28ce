#include "reprise/optimizers/random_quadratic_programs.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace reprise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  double between(double lower, double upper) {
    return lower + static_cast<double>(next() >> 11) * 0x1p-53 * (upper - lower);
  }
  /// From 0 to `largest`.
  int up_to(int largest) { return std::min(largest, static_cast<int>(between(0.0, largest + 1.0))); }
  VectorXd vector(Eigen::Index n, double lower, double upper) {
    VectorXd result(n);
    for (double& one : result) one = between(lower, upper);
    return result;
  }
  MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    MatrixXd result(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i) result.row(i) = vector(columns, -1.0, 1.0).transpose();
    return result;
  }

 private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace

RandomQuadraticProgram random_quadratic_program(std::uint64_t seed, double factor) {
  if (!(factor > 0.0 && std::isfinite(factor))) {
    throw std::invalid_argument("the factor of the objective is " + std::to_string(factor) +
                                ", but it must be positive and finite");
  }
  Random random(seed);
  const Eigen::Index n = 1 + random.up_to(11);
  const Eigen::Index m = random.up_to(2 * static_cast<int>(n));
  RandomQuadraticProgram result;
  result.active = random.up_to(static_cast<int>(std::min(n, m)));
  const MatrixXd root = random.matrix(n, n);
  const MatrixXd q = root.transpose() * root + 0.1 * MatrixXd::Identity(n, n);
  const MatrixXd a = random.matrix(m, n);
  result.optimum = random.vector(n, -10.0, 10.0);
  VectorXd b = a * result.optimum;
  VectorXd c = -q * result.optimum;
  for (Eigen::Index j = 0; j < m; ++j) {
    if (j < result.active) {
      c -= random.between(0.1, 2.0) * a.row(j).transpose();
    } else {
      b[j] += random.between(0.1, 5.0);
    }
  }
  result.start = random.vector(n, -5.0, 5.0);

  Problem& problem = result.problem;
  problem.name = "quadratic program " + std::to_string(seed);
  problem.n = n;
  problem.lower = VectorXd::Constant(n, -50.0);
  problem.upper = VectorXd::Constant(n, 50.0);
  problem.objective = [q, c, factor](const VectorXd& x) { return factor * (0.5 * x.dot(q * x) + c.dot(x)); };
  problem.objective_gradient = [q, c, factor](const VectorXd& x, VectorXd& gradient) {
    gradient = factor * (q * x + c);
  };
  problem.inequalities = m;
  if (m > 0) {
    problem.inequality = [a, b](const VectorXd& x, VectorXd& g) { g = a * x - b; };
    problem.inequality_jacobian = dense_jacobian([a](const VectorXd&, MatrixXd& jacobian) { jacobian = a; });
  }
  problem.lagrangian_hessian = [q, factor](const VectorXd&, double objective_factor, const VectorXd&, const VectorXd&,
                                           SparseMatrix& hessian) {
    if (hessian.nonZeros() == 0) {
      for (Eigen::Index i = 0; i < q.rows(); ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) hessian.insert(i, j) = 0.0;
      }
      hessian.makeCompressed();
    }
    double* entry = hessian.valuePtr();
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) *entry++ = objective_factor * factor * q(i, j);
    }
  };
  result.f_optimum = problem.objective(result.optimum);
  return result;
}

}  // namespace reprise
