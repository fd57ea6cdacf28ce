#pragma once

// Makes a problem of its formulas, which are written as in the source:
//
//     StandardProblem hs14() {
//       return Definition<2>(14, {2, 2},
//                            [](const auto& x) {
//                              const auto& [x1, x2] = x;
//                              return squared(x1 - 2.0) + squared(x2 - 1.0);
//                            })
//           .inequalities([](const auto& x) { ... return std::array{c1, c2}; })   // c(x) >= 0
//           .equalities([](const auto& x) { ... return std::array{h1}; })         // h(x) = 0
//           .lower({0, 0})
//           .optimum({...}, f);
//     }
//
// A formula takes the variables as an array of numbers of any kind (double, Taylor) and returns such numbers.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <initializer_list>
#include <string>
#include <tuple>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/standard_problems.hpp"
#include "taylor.hpp"

namespace reprise::standard {

/// Several functions with their derivatives.
struct Functions {
  Eigen::Index count = 0;
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& values)> values;
  std::function<void(const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian)> jacobian;
  /// Adds the sum of the multiplied Hessians to the lower triangle.
  std::function<void(const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers, Eigen::MatrixXd& hessian)>
      add_hessians;
};

template <int order, int n>
std::array<Taylor<order>, n> variables(const Eigen::VectorXd& x) {
  std::array<Taylor<order>, n> result;
  for (int i = 0; i < n; ++i) result[static_cast<std::size_t>(i)] = Taylor<order>::variable(x[i], i, n);
  return result;
}

template <int n>
std::array<double, n> numbers(const Eigen::VectorXd& x) {
  std::array<double, n> result;
  for (int i = 0; i < n; ++i) result[static_cast<std::size_t>(i)] = x[i];
  return result;
}

/// The functions of a formula times the sign.
template <int n, class Formula>
Functions functions_of(const Formula& formula, double sign) {
  static_assert(n <= most_variables);
  constexpr int count = std::tuple_size_v<decltype(formula(std::array<double, n>{}))>;
  Functions result;
  result.count = count;
  result.values = [formula, sign](const Eigen::VectorXd& x, Eigen::VectorXd& values) {
    const auto c = formula(numbers<n>(x));
    for (int j = 0; j < count; ++j) values[j] = sign * c[static_cast<std::size_t>(j)];
  };
  result.jacobian = [formula, sign](const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) {
    const auto c = formula(variables<1, n>(x));
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < n; ++i) jacobian(j, i) = sign * c[static_cast<std::size_t>(j)].first(i);
    }
  };
  result.add_hessians = [formula, sign](const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers,
                                        Eigen::MatrixXd& hessian) {
    const auto c = formula(variables<2, n>(x));
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
          hessian(i, j) += sign * multipliers[k] * c[static_cast<std::size_t>(k)].second(i, j);
        }
      }
    }
  };
  return result;
}

/// Puts functions into a problem that has its name, n and objective; the inequalities are g(x) <= 0.
void set_functions(Problem& problem, const Functions& objective, const Functions& inequalities,
                   const Functions& equalities);

std::string hock_schittkowski(int number);

/// A problem of n variables in the making.
template <int n>
class Definition {
 public:
  using Numbers = std::initializer_list<double>;

  template <class Formula>
  Definition(std::string name, std::string source, Numbers start, const Formula& objective)
      : objective_(functions_of<n>([objective](const auto& x) { return std::array{objective(x)}; }, 1.0)) {
    made_.problem.name = std::move(name);
    made_.problem.n = n;
    made_.problem.objective = [objective](const Eigen::VectorXd& x) { return objective(numbers<n>(x)); };
    made_.source = std::move(source);
    made_.start = vector(start);
  }

  template <class Formula>
  Definition(int number, Numbers start, const Formula& objective)
      : Definition("hs" + std::to_string(number), hock_schittkowski(number), start, objective) {}

  /// c(x) >= 0.
  template <class Formula>
  Definition& inequalities(const Formula& formula) {
    inequalities_ = functions_of<n>(formula, -1.0);
    return *this;
  }

  /// h(x) = 0.
  template <class Formula>
  Definition& equalities(const Formula& formula) {
    equalities_ = functions_of<n>(formula, 1.0);
    return *this;
  }

  /// A list of one number is for all variables.
  Definition& lower(Numbers values) {
    made_.problem.lower = vector(values);
    return *this;
  }
  Definition& upper(Numbers values) {
    made_.problem.upper = vector(values);
    return *this;
  }

  Definition& remark(std::string text) {
    made_.remark = std::move(text);
    return *this;
  }

  StandardProblem optimum(Numbers x, double f) {
    made_.optimum = vector(x);
    made_.f_optimum = f;
    set_functions(made_.problem, objective_, inequalities_, equalities_);
    return std::move(made_);
  }

 private:
  static Eigen::VectorXd vector(Numbers values) {
    if (values.size() == 1) return Eigen::VectorXd::Constant(n, *values.begin());
    return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
  }

  StandardProblem made_;
  Functions objective_, inequalities_, equalities_;
};

std::vector<StandardProblem> hock_schittkowski_1_30();
std::vector<StandardProblem> hock_schittkowski_31_60();
std::vector<StandardProblem> hock_schittkowski_61_99();
std::vector<StandardProblem> hock_schittkowski_100_119();

}  // namespace reprise::standard
