#include "reference_problems.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/AutoDiff>
#include <utility>

namespace reprise {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;
using std::numbers::sqrt3;
constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

/// Numbers that carry their gradient, and numbers that carry one row of their Hessian as well.
template <int n>
using First = Eigen::AutoDiffScalar<Eigen::Matrix<double, n, 1>>;
template <int n>
using Second = Eigen::AutoDiffScalar<Eigen::Matrix<First<n>, 1, 1>>;

template <int n>
std::array<double, n> values(const Eigen::VectorXd& x) {
  std::array<double, n> result;
  std::copy(x.begin(), x.end(), result.begin());
  return result;
}

template <int n>
std::array<First<n>, n> with_gradients(const Eigen::VectorXd& x) {
  std::array<First<n>, n> result;
  for (int i = 0; i < n; ++i) result[static_cast<std::size_t>(i)] = First<n>(x[i], n, i);
  return result;
}

template <int n>
std::array<Second<n>, n> with_hessian_rows(const Eigen::VectorXd& x, int row) {
  std::array<Second<n>, n> result;
  for (int i = 0; i < n; ++i) {
    Second<n>& entry = result[static_cast<std::size_t>(i)];
    entry.value() = First<n>(x[i], n, i);
    entry.derivatives()[0] = First<n>(i == row ? 1.0 : 0.0);
  }
  return result;
}

/// Stands for the constraints of a problem that has none.
struct None {
  template <class T, std::size_t n>
  void operator()(const std::array<T, n>& /*x*/, std::array<T, 0>& /*c*/) const {}
};

/// Jacobian of `count` functions times the sign.
template <int n, int count, class Constraints>
std::function<void(const Eigen::VectorXd&, SparseMatrix&)> jacobian_of(Constraints constraints, double sign) {
  return dense_jacobian([constraints, sign](const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) {
    std::array<First<n>, count> c;
    constraints(with_gradients<n>(x), c);
    for (int j = 0; j < count; ++j) jacobian.row(j) = sign * c[static_cast<std::size_t>(j)].derivatives();
  });
}

/// Makes a problem of n variables from its formulas, which are written as in the source: an objective, `inequalities`
/// functions c(x) >= 0 and `equalities` functions h(x) = 0, each a template in the type of number.
template <int n, int inequalities, int equalities, class Objective, class Inequalities, class Equalities>
ReferenceProblem make(std::string name, std::string source, Eigen::VectorXd start, Eigen::VectorXd optimum,
                      double f_optimum, Objective objective, Inequalities inequality, Equalities equality,
                      Eigen::VectorXd lower = {}, Eigen::VectorXd upper = {}) {
  Problem problem;
  problem.name = std::move(name);
  problem.n = n;
  problem.lower = std::move(lower);
  problem.upper = std::move(upper);
  problem.objective = [objective](const Eigen::VectorXd& x) { return objective(values<n>(x)); };
  problem.objective_gradient = [objective](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    const First<n> f = objective(with_gradients<n>(x));
    gradient = f.derivatives();
  };
  if constexpr (inequalities > 0) {
    problem.inequalities = inequalities;
    problem.inequality = [inequality](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
      std::array<double, inequalities> c;
      inequality(values<n>(x), c);
      for (int j = 0; j < inequalities; ++j) g[j] = -c[static_cast<std::size_t>(j)];
    };
    problem.inequality_jacobian = jacobian_of<n, inequalities>(inequality, -1.0);
  }
  if constexpr (equalities > 0) {
    problem.equalities = equalities;
    problem.equality = [equality](const Eigen::VectorXd& x, Eigen::VectorXd& h) {
      std::array<double, equalities> c;
      equality(values<n>(x), c);
      std::copy(c.begin(), c.end(), h.begin());
    };
    problem.equality_jacobian = jacobian_of<n, equalities>(equality, 1.0);
  }
  problem.lagrangian_hessian = [objective, inequality, equality](const Eigen::VectorXd& x, double factor,
                                                                 const Eigen::VectorXd& lambda,
                                                                 const Eigen::VectorXd& mu, SparseMatrix& hessian) {
    std::vector<Eigen::Triplet<double>> lower_triangle;
    for (int i = 0; i < n; ++i) {
      const std::array<Second<n>, n> at = with_hessian_rows<n>(x, i);
      const Second<n> f = objective(at);
      Eigen::Matrix<double, n, 1> sum = factor * f.derivatives()[0].derivatives();
      const auto add = [&sum](double multiplier, const auto& functions, std::size_t j) {
        sum += multiplier * functions[j].derivatives()[0].derivatives();
      };
      if constexpr (inequalities > 0) {
        std::array<Second<n>, inequalities> c;
        inequality(at, c);
        for (int j = 0; j < inequalities; ++j) add(-lambda[j], c, static_cast<std::size_t>(j));
      }
      if constexpr (equalities > 0) {
        std::array<Second<n>, equalities> c;
        equality(at, c);
        for (int j = 0; j < equalities; ++j) add(mu[j], c, static_cast<std::size_t>(j));
      }
      for (int j = 0; j <= i; ++j) lower_triangle.emplace_back(i, j, sum[j]);
    }
    hessian.setFromTriplets(lower_triangle.begin(), lower_triangle.end());
  };
  return {std::move(problem), std::move(start), std::move(optimum), f_optimum, std::move(source)};
}

template <class T>
T squared(const T& x) {
  return x * x;
}

std::string hock_schittkowski(int number) {
  return "W. Hock, K. Schittkowski, Test Examples for Nonlinear Programming Codes, Springer 1981, problem " +
         std::to_string(number);
}

ReferenceProblem beale() {
  return make<2, 0, 0>(
      "beale", "J. J. More, B. S. Garbow, K. E. Hillstrom, ACM Trans. Math. Softw. 7 (1981) 17-41, problem 5",
      vector({1, 1}), vector({3, 0.5}), 0.0,
      []<class T>(const std::array<T, 2>& x) -> T {
        const T& y = x[1];
        const T first = 1.5 - x[0] * (1.0 - y);
        const T second = 2.25 - x[0] * (1.0 - y * y);
        const T third = 2.625 - x[0] * (1.0 - y * y * y);
        return first * first + second * second + third * third;
      },
      None{}, None{});
}

ReferenceProblem hs1() {
  return make<2, 0, 0>(
      "hs1", hock_schittkowski(1), vector({-2, 1}), vector({1, 1}), 0.0,
      []<class T>(const std::array<T, 2>& x) -> T {
        const T valley = x[1] - x[0] * x[0];
        const T along = 1.0 - x[0];
        return 100.0 * valley * valley + along * along;
      },
      None{}, None{}, vector({-infinity, -1.5}));
}

ReferenceProblem hs5() {
  return make<2, 0, 0>(
      "hs5", hock_schittkowski(5), vector({0, 0}), vector({0.5 - pi / 3.0, -0.5 - pi / 3.0}), -sqrt3 / 2.0 - pi / 3.0,
      []<class T>(const std::array<T, 2>& x) -> T {
        const T sum = x[0] + x[1];
        const T difference = x[0] - x[1];
        return sin(sum) + difference * difference - 1.5 * x[0] + 2.5 * x[1] + 1.0;
      },
      None{}, None{}, vector({-1.5, -3}), vector({4, 3}));
}

ReferenceProblem hs6() {
  return make<2, 0, 1>(
      "hs6", hock_schittkowski(6), vector({-1.2, 1}), vector({1, 1}), 0.0,
      []<class T>(const std::array<T, 2>& x) -> T { return squared<T>(1.0 - x[0]); }, None{},
      []<class T>(const std::array<T, 2>& x, std::array<T, 1>& h) { h[0] = 10.0 * (x[1] - x[0] * x[0]); });
}

ReferenceProblem hs10() {
  return make<2, 1, 0>(
      "hs10", hock_schittkowski(10), vector({-10, 10}), vector({0, 1}), -1.0,
      []<class T>(const std::array<T, 2>& x) -> T { return x[0] - x[1]; },
      []<class T>(const std::array<T, 2>& x, std::array<T, 1>& c) {
        c[0] = -3.0 * x[0] * x[0] + 2.0 * x[0] * x[1] - x[1] * x[1] + 1.0;
      },
      None{});
}

ReferenceProblem hs12() {
  return make<2, 1, 0>(
      "hs12", hock_schittkowski(12), vector({0, 0}), vector({2, 3}), -30.0,
      []<class T>(const std::array<T, 2>& x) -> T {
        return 0.5 * x[0] * x[0] + x[1] * x[1] - x[0] * x[1] - 7.0 * x[0] - 7.0 * x[1];
      },
      []<class T>(const std::array<T, 2>& x, std::array<T, 1>& c) { c[0] = 25.0 - 4.0 * x[0] * x[0] - x[1] * x[1]; },
      None{});
}

ReferenceProblem hs21() {
  return make<2, 1, 0>(
      "hs21", hock_schittkowski(21), vector({-1, -1}), vector({2, 0}), -99.96,
      []<class T>(const std::array<T, 2>& x) -> T { return 0.01 * x[0] * x[0] + x[1] * x[1] - 100.0; },
      []<class T>(const std::array<T, 2>& x, std::array<T, 1>& c) { c[0] = 10.0 * x[0] - x[1] - 10.0; }, None{},
      vector({2, -50}), vector({50, 50}));
}

ReferenceProblem hs28() {
  return make<3, 0, 1>(
      "hs28", hock_schittkowski(28), vector({-4, 1, 1}), vector({0.5, -0.5, 0.5}), 0.0,
      []<class T>(const std::array<T, 3>& x) -> T { return squared<T>(x[0] + x[1]) + squared<T>(x[1] + x[2]); }, None{},
      []<class T>(const std::array<T, 3>& x, std::array<T, 1>& h) { h[0] = x[0] + 2.0 * x[1] + 3.0 * x[2] - 1.0; });
}

ReferenceProblem hs29() {
  return make<3, 1, 0>(
      "hs29", hock_schittkowski(29), vector({1, 1, 1}), vector({4, 2 * sqrt2, 2}), -16.0 * sqrt2,
      []<class T>(const std::array<T, 3>& x) -> T { return -x[0] * x[1] * x[2]; },
      []<class T>(const std::array<T, 3>& x, std::array<T, 1>& c) {
        c[0] = 48.0 - x[0] * x[0] - 2.0 * x[1] * x[1] - 4.0 * x[2] * x[2];
      },
      None{});
}

ReferenceProblem hs35() {
  return make<3, 1, 0>(
      "hs35", hock_schittkowski(35), vector({0.5, 0.5, 0.5}), vector({4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0}), 1.0 / 9.0,
      []<class T>(const std::array<T, 3>& x) -> T {
        return 9.0 - 8.0 * x[0] - 6.0 * x[1] - 4.0 * x[2] + 2.0 * x[0] * x[0] + 2.0 * x[1] * x[1] + x[2] * x[2] +
               2.0 * x[0] * x[1] + 2.0 * x[0] * x[2];
      },
      []<class T>(const std::array<T, 3>& x, std::array<T, 1>& c) { c[0] = 3.0 - x[0] - x[1] - 2.0 * x[2]; }, None{},
      vector({0, 0, 0}));
}

ReferenceProblem hs43() {
  return make<4, 3, 0>(
      "hs43", hock_schittkowski(43), vector({0, 0, 0, 0}), vector({0, 1, 2, -1}), -44.0,
      []<class T>(const std::array<T, 4>& x) -> T {
        return x[0] * x[0] + x[1] * x[1] + 2.0 * x[2] * x[2] + x[3] * x[3] - 5.0 * x[0] - 5.0 * x[1] - 21.0 * x[2] +
               7.0 * x[3];
      },
      []<class T>(const std::array<T, 4>& x, std::array<T, 3>& c) {
        c[0] = 8.0 - x[0] * x[0] - x[1] * x[1] - x[2] * x[2] - x[3] * x[3] - x[0] + x[1] - x[2] + x[3];
        c[1] = 10.0 - x[0] * x[0] - 2.0 * x[1] * x[1] - x[2] * x[2] - 2.0 * x[3] * x[3] + x[0] + x[3];
        c[2] = 5.0 - 2.0 * x[0] * x[0] - x[1] * x[1] - x[2] * x[2] - 2.0 * x[0] + x[1] + x[3];
      },
      None{});
}

ReferenceProblem hs45() {
  return make<5, 0, 0>(
      "hs45", hock_schittkowski(45), vector({2, 2, 2, 2, 2}), vector({1, 2, 3, 4, 5}), 1.0,
      []<class T>(const std::array<T, 5>& x) -> T { return 2.0 - x[0] * x[1] * x[2] * x[3] * x[4] / 120.0; }, None{},
      None{}, vector({0, 0, 0, 0, 0}), vector({1, 2, 3, 4, 5}));
}

ReferenceProblem hs65() {
  return make<3, 1, 0>(
      "hs65", hock_schittkowski(65), vector({-5, 5, 0}),
      vector({3.650461725213037, 3.650461725213037, 4.620417555320008}), 0.9535288568047826,
      []<class T>(const std::array<T, 3>& x) -> T {
        return squared<T>(x[0] - x[1]) + squared<T>(x[0] + x[1] - 10.0) / 9.0 + squared<T>(x[2] - 5.0);
      },
      []<class T>(const std::array<T, 3>& x, std::array<T, 1>& c) {
        c[0] = 48.0 - x[0] * x[0] - x[1] * x[1] - x[2] * x[2];
      },
      None{}, vector({-4.5, -4.5, -5}), vector({4.5, 4.5, 5}));
}

ReferenceProblem hs71() {
  return make<4, 1, 1>(
      "hs71", hock_schittkowski(71), vector({1, 5, 5, 1}),
      vector({1, 4.742999637264417, 3.821149984184874, 1.379408293172672}), 17.0140172891563,
      []<class T>(const std::array<T, 4>& x) -> T { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; },
      []<class T>(const std::array<T, 4>& x, std::array<T, 1>& c) { c[0] = x[0] * x[1] * x[2] * x[3] - 25.0; },
      []<class T>(const std::array<T, 4>& x, std::array<T, 1>& h) {
        h[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - 40.0;
      },
      vector({1, 1, 1, 1}), vector({5, 5, 5, 5}));
}

ReferenceProblem hs76() {
  return make<4, 3, 0>(
      "hs76", hock_schittkowski(76), vector({0.5, 0.5, 0.5, 0.5}), vector({3.0 / 11.0, 23.0 / 11.0, 0, 6.0 / 11.0}),
      -103.0 / 22.0,
      []<class T>(const std::array<T, 4>& x) -> T {
        return x[0] * x[0] + 0.5 * x[1] * x[1] + x[2] * x[2] + 0.5 * x[3] * x[3] - x[0] * x[2] + x[2] * x[3] - x[0] -
               3.0 * x[1] + x[2] - x[3];
      },
      []<class T>(const std::array<T, 4>& x, std::array<T, 3>& c) {
        c[0] = 5.0 - x[0] - 2.0 * x[1] - x[2] - x[3];
        c[1] = 4.0 - 3.0 * x[0] - x[1] - 2.0 * x[2] + x[3];
        c[2] = x[1] + 4.0 * x[2] - 1.5;
      },
      None{}, vector({0, 0, 0, 0}));
}

ReferenceProblem hs78() {
  return make<5, 0, 3>(
      "hs78", hock_schittkowski(78), vector({-2, 1.5, 2, -1, -1}),
      vector({-1.717143570394382, 1.595709690183554, 1.827245752927195, -0.7636430781841304, -0.7636430781841304}),
      -2.919700408963679, []<class T>(const std::array<T, 5>& x) -> T { return x[0] * x[1] * x[2] * x[3] * x[4]; },
      None{},
      []<class T>(const std::array<T, 5>& x, std::array<T, 3>& h) {
        h[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + x[4] * x[4] - 10.0;
        h[1] = x[1] * x[2] - 5.0 * x[3] * x[4];
        h[2] = x[0] * x[0] * x[0] + x[1] * x[1] * x[1] + 1.0;
      });
}

ReferenceProblem hs100() {
  return make<7, 4, 0>(
      "hs100", hock_schittkowski(100), vector({1, 2, 0, 4, 0, 1, 1}),
      vector({2.33049937287957, 1.951372372896889, -0.4775413923888717, 4.365726233655811, -0.6244869705268175,
              1.038131018607958, 1.594226711611868}),
      680.630057374402,
      []<class T>(const std::array<T, 7>& x) -> T {
        return squared<T>(x[0] - 10.0) + 5.0 * squared<T>(x[1] - 12.0) + squared<T>(x[2] * x[2]) +
               3.0 * squared<T>(x[3] - 11.0) + 10.0 * squared<T>(x[4] * x[4] * x[4]) + 7.0 * x[5] * x[5] +
               squared<T>(x[6] * x[6]) - 4.0 * x[5] * x[6] - 10.0 * x[5] - 8.0 * x[6];
      },
      []<class T>(const std::array<T, 7>& x, std::array<T, 4>& c) {
        c[0] = 127.0 - 2.0 * x[0] * x[0] - 3.0 * squared<T>(x[1] * x[1]) - x[2] - 4.0 * x[3] * x[3] - 5.0 * x[4];
        c[1] = 282.0 - 7.0 * x[0] - 3.0 * x[1] - 10.0 * x[2] * x[2] - x[3] + x[4];
        c[2] = 196.0 - 23.0 * x[0] - x[1] * x[1] - 6.0 * x[5] * x[5] + 8.0 * x[6];
        c[3] = -4.0 * x[0] * x[0] - x[1] * x[1] + 3.0 * x[0] * x[1] - 2.0 * x[2] * x[2] - 5.0 * x[5] + 11.0 * x[6];
      },
      None{});
}

ReferenceProblem hs113() {
  return make<10, 8, 0>(
      "hs113", hock_schittkowski(113), vector({2, 3, 5, 5, 1, 2, 7, 3, 6, 10}),
      vector({2.171996371255455, 2.36368297369728, 8.77392573847685, 5.095984487948453, 0.9906547649638593,
              1.430573978936316, 1.321644208161703, 9.828725807886322, 8.280091670098345, 8.375926663921323}),
      24.30620906817979,
      []<class T>(const std::array<T, 10>& x) -> T {
        return x[0] * x[0] + x[1] * x[1] + x[0] * x[1] - 14.0 * x[0] - 16.0 * x[1] + squared<T>(x[2] - 10.0) +
               4.0 * squared<T>(x[3] - 5.0) + squared<T>(x[4] - 3.0) + 2.0 * squared<T>(x[5] - 1.0) +
               5.0 * x[6] * x[6] + 7.0 * squared<T>(x[7] - 11.0) + 2.0 * squared<T>(x[8] - 10.0) +
               squared<T>(x[9] - 7.0) + 45.0;
      },
      []<class T>(const std::array<T, 10>& x, std::array<T, 8>& c) {
        c[0] = 105.0 - 4.0 * x[0] - 5.0 * x[1] + 3.0 * x[6] - 9.0 * x[7];
        c[1] = -10.0 * x[0] + 8.0 * x[1] + 17.0 * x[6] - 2.0 * x[7];
        c[2] = 8.0 * x[0] - 2.0 * x[1] - 5.0 * x[8] + 2.0 * x[9] + 12.0;
        c[3] = -3.0 * squared<T>(x[0] - 2.0) - 4.0 * squared<T>(x[1] - 3.0) - 2.0 * x[2] * x[2] + 7.0 * x[3] + 120.0;
        c[4] = -5.0 * x[0] * x[0] - 8.0 * x[1] - squared<T>(x[2] - 6.0) + 2.0 * x[3] + 40.0;
        c[5] = -0.5 * squared<T>(x[0] - 8.0) - 2.0 * squared<T>(x[1] - 4.0) - 3.0 * x[4] * x[4] + x[5] + 30.0;
        c[6] = -x[0] * x[0] - 2.0 * squared<T>(x[1] - 2.0) + 2.0 * x[0] * x[1] - 14.0 * x[4] + 6.0 * x[5];
        c[7] = 3.0 * x[0] - 6.0 * x[1] - 12.0 * squared<T>(x[8] - 8.0) + 7.0 * x[9];
      },
      None{});
}

}  // namespace

std::vector<ReferenceProblem> reference_problems() {
  return {beale(), hs1(),  hs5(),  hs6(),  hs10(), hs12(), hs21(), hs28(),  hs29(),
          hs35(),  hs43(), hs45(), hs65(), hs71(), hs76(), hs78(), hs100(), hs113()};
}

ReferenceProblem reference_problem(std::string_view name) {
  for (ReferenceProblem& reference : reference_problems()) {
    if (reference.problem.name == name) return std::move(reference);
  }
  throw std::invalid_argument("there is no reference problem '" + std::string(name) + "'");
}

}  // namespace reprise
