#include "reprise/optimizers/random_quadratic_programs.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

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

/// factor (x . q x / 2 + c . x) with a x <= b.
struct Formula {
  double factor;
  MatrixXd q;
  VectorXd c;
  MatrixXd a;
  VectorXd b;

  double value(const VectorXd& x) const { return factor * (0.5 * x.dot(q * x) + c.dot(x)); }
  VectorXd gradient(const VectorXd& x) const { return factor * (q * x + c); }
};

/// x = y + alpha sin y + beta sin of the variable before.
struct Bend {
  VectorXd alpha;
  VectorXd beta;  ///< the first is 0

  VectorXd straight(const VectorXd& y) const {
    VectorXd x = y;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      x[i] += alpha[i] * std::sin(y[i]) + (i > 0 ? beta[i] * std::sin(y[i - 1]) : 0.0);
    }
    return x;
  }

  MatrixXd jacobian(const VectorXd& y) const {
    MatrixXd result = MatrixXd::Zero(y.size(), y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      result(i, i) = 1.0 + alpha[i] * std::cos(y[i]);
      if (i > 0) result(i, i - 1) = beta[i] * std::cos(y[i - 1]);
    }
    return result;
  }

  /// The diagonal of sum_k slopes_k Hessian(x_k), which has no other entries.
  VectorXd curvature(const VectorXd& y, const VectorXd& slopes) const {
    VectorXd result(y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const double next = i + 1 < y.size() ? beta[i + 1] * slopes[i + 1] : 0.0;
      result[i] = -std::sin(y[i]) * (alpha[i] * slopes[i] + next);
    }
    return result;
  }

  /// The y of an x, one variable after the other, each by halving.
  VectorXd bent(const VectorXd& x) const {
    VectorXd y(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double target = x[i] - (i > 0 ? beta[i] * std::sin(y[i - 1]) : 0.0);
      double lower = target - 1.0;
      double upper = target + 1.0;
      constexpr int halvings = 60;
      for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (lower + upper);
        (middle + alpha[i] * std::sin(middle) < target ? lower : upper) = middle;
      }
      y[i] = 0.5 * (lower + upper);
    }
    return y;
  }
};

/// Sets the lower triangle of a Hessian, every entry of which belongs to the pattern.
void set_lower_triangle(const MatrixXd& values, SparseMatrix& hessian) {
  if (hessian.nonZeros() == 0) {
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) hessian.insert(i, j) = 0.0;
    }
    hessian.makeCompressed();
  }
  double* entry = hessian.valuePtr();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) *entry++ = values(i, j);
  }
}

/// Start, optimum and formula of a seed; the problem is left to be made.
std::pair<RandomQuadraticProgram, Formula> draw(std::uint64_t seed, double factor) {
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
  result.problem.n = n;
  result.problem.inequalities = m;
  Formula formula{factor, q, c, a, b};
  result.f_optimum = formula.value(result.optimum);
  return {result, formula};
}

}  // namespace

RandomQuadraticProgram random_quadratic_program(std::uint64_t seed, double factor) {
  auto [result, formula] = draw(seed, factor);
  Problem& problem = result.problem;
  problem.name = "quadratic program " + std::to_string(seed);
  problem.lower = VectorXd::Constant(problem.n, -50.0);
  problem.upper = VectorXd::Constant(problem.n, 50.0);
  problem.objective = [formula = formula](const VectorXd& x) { return formula.value(x); };
  problem.objective_gradient = [formula = formula](const VectorXd& x, VectorXd& gradient) {
    gradient = formula.gradient(x);
  };
  if (problem.inequalities > 0) {
    problem.inequality = [formula = formula](const VectorXd& x, VectorXd& g) { g = formula.a * x - formula.b; };
    problem.inequality_jacobian =
        dense_jacobian([formula = formula](const VectorXd&, MatrixXd& jacobian) { jacobian = formula.a; });
  }
  problem.lagrangian_hessian = [formula = formula](const VectorXd&, double objective_factor, const VectorXd&,
                                                   const VectorXd&, SparseMatrix& hessian) {
    set_lower_triangle(objective_factor * formula.factor * formula.q, hessian);
  };
  return result;
}

RandomQuadraticProgram bent_quadratic_program(std::uint64_t seed, double factor) {
  auto [result, formula] = draw(seed, factor);
  Problem& problem = result.problem;
  Random random(~seed);
  Bend bend{random.vector(problem.n, -0.8, 0.8), random.vector(problem.n, -1.5, 1.5)};
  bend.beta[0] = 0.0;
  result.optimum = bend.bent(result.optimum);
  problem.name = "bent quadratic program " + std::to_string(seed);
  problem.objective = [formula = formula, bend](const VectorXd& y) { return formula.value(bend.straight(y)); };
  problem.objective_gradient = [formula = formula, bend](const VectorXd& y, VectorXd& gradient) {
    gradient = bend.jacobian(y).transpose() * formula.gradient(bend.straight(y));
  };
  if (problem.inequalities > 0) {
    problem.inequality = [formula = formula, bend](const VectorXd& y, VectorXd& g) {
      g = formula.a * bend.straight(y) - formula.b;
    };
    problem.inequality_jacobian = dense_jacobian(
        [formula = formula, bend](const VectorXd& y, MatrixXd& jacobian) { jacobian = formula.a * bend.jacobian(y); });
  }
  problem.lagrangian_hessian = [formula = formula, bend](const VectorXd& y, double objective_factor,
                                                         const VectorXd& multipliers, const VectorXd&,
                                                         SparseMatrix& hessian) {
    VectorXd slopes = objective_factor * formula.gradient(bend.straight(y));
    if (formula.b.size() > 0) slopes += formula.a.transpose() * multipliers;
    const MatrixXd jacobian = bend.jacobian(y);
    MatrixXd values = objective_factor * formula.factor * (jacobian.transpose() * formula.q * jacobian);
    values.diagonal() += bend.curvature(y, slopes);
    set_lower_triangle(values, hessian);
  };
  return result;
}

}  // namespace reprise
