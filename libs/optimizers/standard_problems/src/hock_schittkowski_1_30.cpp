#include <cmath>
#include <numbers>

#include "definition.hpp"
#include "reprise/base/constants.hpp"

namespace reprise::standard {
namespace {

using std::numbers::sqrt2;
using std::numbers::sqrt3;

/// The objective of problems 1, 2, 15 to 17 and 20: Rosenbrock's valley.
constexpr auto valley = [](const auto& x) {
  const auto& [x1, x2] = x;
  return 100.0 * squared(x2 - squared(x1)) + squared(1.0 - x1);
};

StandardProblem hs1() { return Definition<2>(1, {-2, 1}, valley).lower({-infinity, -1.5}).optimum({1, 1}, 0.0); }

StandardProblem hs2() {
  const double a = std::sqrt(598.0 / 1200.0);
  const double root = 2.0 * a * std::cos(std::acos(1.0 / (400.0 * a * a * a)) / 3.0);
  return Definition<2>(2, {-2, 1}, valley)
      .lower({-infinity, 1.5})
      .remark("another local minimum, f = 4.94, at x_1 = -1.221")
      .optimum({root, 1.5}, valley(std::array{root, 1.5}));
}

StandardProblem hs3() {
  return Definition<2>(3, {10, 1},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return x2 + 1e-5 * squared(x2 - x1);
                       })
      .lower({-infinity, 0})
      .optimum({0, 0}, 0.0);
}

StandardProblem hs4() {
  return Definition<2>(4, {1.125, 0.125},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return cubed(x1 + 1.0) / 3.0 + x2;
                       })
      .lower({1, 0})
      .optimum({1, 0}, 8.0 / 3.0);
}

StandardProblem hs5() {
  return Definition<2>(5, {0, 0},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return sin(x1 + x2) + squared(x1 - x2) - 1.5 * x1 + 2.5 * x2 + 1.0;
                       })
      .lower({-1.5, -3})
      .upper({4, 3})
      .optimum({0.5 - pi / 3.0, -0.5 - pi / 3.0}, -sqrt3 / 2.0 - pi / 3.0);
}

StandardProblem hs6() {
  return Definition<2>(6, {-1.2, 1}, [](const auto& x) { return squared(1.0 - x[0]); })
      .equalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{10.0 * (x2 - squared(x1))};
      })
      .optimum({1, 1}, 0.0);
}

StandardProblem hs7() {
  return Definition<2>(7, {2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return log(1.0 + squared(x1)) - x2;
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{squared(1.0 + squared(x1)) + squared(x2) - 4.0};
      })
      .optimum({0, sqrt3}, -sqrt3);
}

StandardProblem hs8() {
  const double larger = std::sqrt((25.0 + std::sqrt(301.0)) / 2.0);
  return Definition<2>(8, {2, 1}, [](const auto& x) { return 0.0 * x[0] - 1.0; })
      .equalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{squared(x1) + squared(x2) - 25.0, x1 * x2 - 9.0};
      })
      .optimum({larger, 9.0 / larger}, -1.0);
}

StandardProblem hs9() {
  return Definition<2>(9, {0, 0},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return sin(pi * x1 / 12.0) * cos(pi * x2 / 16.0);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{4.0 * x1 - 3.0 * x2};
      })
      .optimum({-3, -4}, -0.5);
}

StandardProblem hs10() {
  return Definition<2>(10, {-10, 10}, [](const auto& x) { return x[0] - x[1]; })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{-3.0 * squared(x1) + 2.0 * x1 * x2 - squared(x2) + 1.0};
      })
      .optimum({0, 1}, -1.0);
}

StandardProblem hs11() {
  // x_2 = x_1^2 with 2 x_1^3 + x_1 = 5.
  const double discriminant = std::sqrt(25.0 / 16.0 + 1.0 / 216.0);
  const double root = std::cbrt(1.25 + discriminant) + std::cbrt(1.25 - discriminant);
  const auto objective = [](const auto& x) {
    const auto& [x1, x2] = x;
    return squared(x1 - 5.0) + squared(x2) - 25.0;
  };
  return Definition<2>(11, {4.9, 0.1}, objective)
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x2 - squared(x1)};
      })
      .optimum({root, root * root}, objective(std::array{root, root * root}));
}

StandardProblem hs12() {
  return Definition<2>(12, {0, 0},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return 0.5 * squared(x1) + squared(x2) - x1 * x2 - 7.0 * x1 - 7.0 * x2;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{25.0 - 4.0 * squared(x1) - squared(x2)};
      })
      .optimum({2, 3}, -30.0);
}

StandardProblem hs13() {
  return Definition<2>(13, {-2, -2},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return squared(x1 - 2.0) + squared(x2);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{cubed(1.0 - x1) - x2};
      })
      .lower({0})
      .remark(
          "no multipliers exist at the optimum: the gradients of the constraint and of the bound x_2 >= 0 are "
          "opposite there. A violation e gives f = (1 - e^(1/3))^2, lower by 2 % for e = 1e-6")
      .optimum({1, 0}, 1.0);
}

StandardProblem hs14() {
  const double sqrt7 = std::sqrt(7.0);
  return Definition<2>(14, {2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return squared(x1 - 2.0) + squared(x2 - 1.0);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{-0.25 * squared(x1) - squared(x2) + 1.0};
      })
      .equalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 - 2.0 * x2 + 1.0};
      })
      .optimum({0.5 * (sqrt7 - 1.0), 0.25 * (sqrt7 + 1.0)}, 9.0 - 2.875 * sqrt7);
}

StandardProblem hs15() {
  return Definition<2>(15, {-2, 1}, valley)
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 * x2 - 1.0, x1 + squared(x2)};
      })
      .upper({0.5, infinity})
      .remark("another local minimum, f = 360.38, at x = (-0.792, -1.262)")
      .optimum({0.5, 2}, 306.5);
}

StandardProblem hs16() {
  return Definition<2>(16, {-2, 1}, valley)
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 + squared(x2), squared(x1) + x2};
      })
      .lower({-0.5, -infinity})
      .upper({0.5, 1})
      .remark("another local minimum, f = 23.14, at x = (-0.5, 0.707)")
      .optimum({0.5, 0.25}, 0.25);
}

StandardProblem hs17() {
  return Definition<2>(17, {-2, 1}, valley)
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{squared(x2) - x1, squared(x1) - x2};
      })
      .lower({-0.5, -infinity})
      .upper({0.5, 1})
      .remark("Schittkowski's programs state the optimum as 0.01, a hundredth of it")
      .optimum({0, 0}, 1.0);
}

StandardProblem hs18() {
  return Definition<2>(18, {2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return 0.01 * squared(x1) + squared(x2);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 * x2 - 25.0, squared(x1) + squared(x2) - 25.0};
      })
      .lower({2, 0})
      .upper({50})
      .optimum({std::sqrt(250.0), std::sqrt(2.5)}, 5.0);
}

StandardProblem hs19() {
  // Both circles meet there.
  const double height = 5.0 - std::sqrt(82.81 - squared(14.095 - 6.0));
  return Definition<2>(19, {20.1, 5.84},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return cubed(x1 - 10.0) + cubed(x2 - 20.0);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{squared(x1 - 5.0) + squared(x2 - 5.0) - 100.0, 82.81 - squared(x1 - 6.0) - squared(x2 - 5.0)};
      })
      .lower({13, 0})
      .upper({100})
      .optimum({14.095, height}, cubed(4.095) + cubed(height - 20.0));
}

StandardProblem hs20() {
  return Definition<2>(20, {-2, 1}, valley)
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 + squared(x2), squared(x1) + x2, squared(x1) + squared(x2) - 1.0};
      })
      .lower({-0.5, -infinity})
      .upper({0.5, infinity})
      .remark("another local minimum, f = 40.20, at x = (-0.5, 0.866)")
      .optimum({0.5, sqrt3 / 2.0}, 81.5 - 25.0 * sqrt3);
}

StandardProblem hs21() {
  return Definition<2>(21, {-1, -1},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return 0.01 * squared(x1) + squared(x2) - 100.0;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{10.0 * x1 - x2 - 10.0};
      })
      .lower({2, -50})
      .upper({50})
      .remark("Schittkowski's programs state the optimum as -0.9996, a hundredth of it")
      .optimum({2, 0}, -99.96);
}

StandardProblem hs22() {
  return Definition<2>(22, {2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return squared(x1 - 2.0) + squared(x2 - 1.0);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{2.0 - x1 - x2, x2 - squared(x1)};
      })
      .optimum({1, 1}, 1.0);
}

StandardProblem hs23() {
  return Definition<2>(23, {3, 1}, [](const auto& x) { return squared(x[0]) + squared(x[1]); })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 + x2 - 1.0, squared(x1) + squared(x2) - 1.0, 9.0 * squared(x1) + squared(x2) - 9.0,
                          squared(x1) - x2, squared(x2) - x1};
      })
      .lower({-50})
      .upper({50})
      .optimum({1, 1}, 2.0);
}

StandardProblem hs24() {
  return Definition<2>(24, {1, 0.5},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return (squared(x1 - 3.0) - 9.0) * cubed(x2) / (27.0 * sqrt3);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 / sqrt3 - x2, x1 + sqrt3 * x2, 6.0 - x1 - sqrt3 * x2};
      })
      .lower({0})
      .optimum({3, sqrt3}, -1.0);
}

StandardProblem hs25() {
  return Definition<3>(25, {100, 12.5, 3},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         auto sum = 0.0 * x1;
                         for (int i = 1; i <= 99; ++i) {
                           const double u = 25.0 + std::cbrt(squared(-50.0 * std::log(0.01 * i)));
                           sum += squared(exp(-pow(u - x2, x3) / x1) - 0.01 * i);
                         }
                         return sum;
                       })
      .lower({0.1, 0, 0})
      .upper({100, 25.6, 5})
      .remark("all derivatives are tiny at the start, where f = 32.835")
      .optimum({50, 25, 1.5}, 0.0);
}

StandardProblem hs26() {
  return Definition<3>(26, {-2.6, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return squared(x1 - x2) + to_the_fourth(x2 - x3);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{(1.0 + squared(x2)) * x1 + to_the_fourth(x3) - 3.0};
      })
      .optimum({1, 1, 1}, 0.0);
}

StandardProblem hs27() {
  return Definition<3>(27, {2, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return 0.01 * squared(x1 - 1.0) + squared(x2 - squared(x1));
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{x1 + squared(x3) + 1.0};
      })
      .optimum({-1, 1, 0}, 0.04);
}

StandardProblem hs28() {
  return Definition<3>(28, {-4, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return squared(x1 + x2) + squared(x2 + x3);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{x1 + 2.0 * x2 + 3.0 * x3 - 1.0};
      })
      .optimum({0.5, -0.5, 0.5}, 0.0);
}

StandardProblem hs29() {
  return Definition<3>(29, {1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return -x1 * x2 * x3;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{48.0 - squared(x1) - 2.0 * squared(x2) - 4.0 * squared(x3)};
      })
      .optimum({4, 2.0 * sqrt2, 2}, -16.0 * sqrt2);
}

StandardProblem hs30() {
  return Definition<3>(30, {1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return squared(x1) + squared(x2) + squared(x3);
                       })
      .inequalities([](const auto& x) { return std::array{squared(x[0]) + squared(x[1]) - 1.0}; })
      .lower({1, -10, -10})
      .upper({10})
      .optimum({1, 0, 0}, 1.0);
}

}  // namespace

std::vector<StandardProblem> hock_schittkowski_1_30() {
  return {hs1(),  hs2(),  hs3(),  hs4(),  hs5(),  hs6(),  hs7(),  hs8(),  hs9(),  hs10(),
          hs11(), hs12(), hs13(), hs14(), hs15(), hs16(), hs17(), hs18(), hs19(), hs20(),
          hs21(), hs22(), hs23(), hs24(), hs25(), hs26(), hs27(), hs28(), hs29(), hs30()};
}

}  // namespace reprise::standard
