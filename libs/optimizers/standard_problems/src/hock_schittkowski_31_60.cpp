#include <cmath>
#include <numbers>

#include "definition.hpp"
#include "reprise/base/constants.hpp"

namespace reprise::standard {
namespace {

using std::numbers::sqrt2;
using std::numbers::sqrt3;

StandardProblem hs31() {
  return Definition<3>(31, {1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return 9.0 * squared(x1) + squared(x2) + 9.0 * squared(x3);
                       })
      .inequalities([](const auto& x) { return std::array{x[0] * x[1] - 1.0}; })
      .lower({-10, 1, -10})
      .upper({10, 10, 1})
      .optimum({1.0 / sqrt3, sqrt3, 0}, 6.0);
}

StandardProblem hs32() {
  return Definition<3>(32, {0.1, 0.7, 0.2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return squared(x1 + 3.0 * x2 + x3) + 4.0 * squared(x1 - x2);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{6.0 * x2 + 4.0 * x3 - cubed(x1) - 3.0};
      })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{1.0 - x1 - x2 - x3};
      })
      .lower({0})
      .optimum({0, 0, 1}, 1.0);
}

StandardProblem hs33() {
  return Definition<3>(33, {0, 0, 3},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return (x1 - 1.0) * (x1 - 2.0) * (x1 - 3.0) + x3;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{squared(x3) - squared(x2) - squared(x1), squared(x1) + squared(x2) + squared(x3) - 4.0};
      })
      .lower({0})
      .upper({infinity, infinity, 5})
      .remark("a method of first order that starts at x_2 = 0 may stay there and end at (0, 0, 2) with f = -4")
      .optimum({0, sqrt2, sqrt2}, sqrt2 - 6.0);
}

StandardProblem hs34() {
  return Definition<3>(34, {0, 1.05, 2.9}, [](const auto& x) { return -x[0]; })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{x2 - exp(x1), x3 - exp(x2)};
      })
      .lower({0})
      .upper({100, 100, 10})
      .optimum({std::log(std::log(10.0)), std::log(10.0), 10}, -std::log(std::log(10.0)));
}

StandardProblem hs35() {
  return Definition<3>(35, {0.5, 0.5, 0.5},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return 9.0 - 8.0 * x1 - 6.0 * x2 - 4.0 * x3 + 2.0 * squared(x1) + 2.0 * squared(x2) +
                                squared(x3) + 2.0 * x1 * x2 + 2.0 * x1 * x3;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{3.0 - x1 - x2 - 2.0 * x3};
      })
      .lower({0})
      .optimum({4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0}, 1.0 / 9.0);
}

/// The objective of problems 36 and 37.
constexpr auto negative_volume = [](const auto& x) {
  const auto& [x1, x2, x3] = x;
  return -x1 * x2 * x3;
};

StandardProblem hs36() {
  return Definition<3>(36, {10, 10, 10}, negative_volume)
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{72.0 - x1 - 2.0 * x2 - 2.0 * x3};
      })
      .lower({0})
      .upper({20, 11, 42})
      .optimum({20, 11, 15}, -3300.0);
}

StandardProblem hs37() {
  return Definition<3>(37, {10, 10, 10}, negative_volume)
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{72.0 - x1 - 2.0 * x2 - 2.0 * x3, x1 + 2.0 * x2 + 2.0 * x3};
      })
      .lower({0})
      .upper({42})
      .optimum({24, 12, 12}, -3456.0);
}

StandardProblem hs38() {
  return Definition<4>(38, {-3, -1, -3, -1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return 100.0 * squared(x2 - squared(x1)) + squared(1.0 - x1) +
                                90.0 * squared(x4 - squared(x3)) + squared(1.0 - x3) +
                                10.1 * (squared(x2 - 1.0) + squared(x4 - 1.0)) + 19.8 * (x2 - 1.0) * (x4 - 1.0);
                       })
      .lower({-10})
      .upper({10})
      .optimum({1, 1, 1, 1}, 0.0);
}

StandardProblem hs39() {
  return Definition<4>(39, {2, 2, 2, 2}, [](const auto& x) { return -x[0]; })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{x2 - cubed(x1) - squared(x3), squared(x1) - x2 - squared(x4)};
      })
      .optimum({1, 1, 0, 0}, -1.0);
}

StandardProblem hs40() {
  return Definition<4>(40, {0.8, 0.8, 0.8, 0.8},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return -x1 * x2 * x3 * x4;
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{cubed(x1) + squared(x2) - 1.0, squared(x1) * x4 - x3, squared(x4) - x2};
      })
      .optimum({std::exp2(-1.0 / 3.0), std::exp2(-0.5), std::exp2(-11.0 / 12.0), std::exp2(-0.25)}, -0.25);
}

StandardProblem hs41() {
  return Definition<4>(41, {2, 2, 2, 2}, [](const auto& x) { return 2.0 - x[0] * x[1] * x[2]; })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{x1 + 2.0 * x2 + 2.0 * x3 - x4};
      })
      .lower({0})
      .upper({1, 1, 1, 2})
      .optimum({2.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 2}, 52.0 / 27.0);
}

StandardProblem hs42() {
  return Definition<4>(42, {1, 1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return squared(x1 - 1.0) + squared(x2 - 2.0) + squared(x3 - 3.0) + squared(x4 - 4.0);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{x1 - 2.0, squared(x3) + squared(x4) - 2.0};
      })
      .optimum({2, 2, 0.6 * sqrt2, 0.8 * sqrt2}, 28.0 - 10.0 * sqrt2);
}

StandardProblem hs43() {
  return Definition<4>(43, {0, 0, 0, 0},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return squared(x1) + squared(x2) + 2.0 * squared(x3) + squared(x4) - 5.0 * x1 - 5.0 * x2 -
                                21.0 * x3 + 7.0 * x4;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{
            8.0 - squared(x1) - squared(x2) - squared(x3) - squared(x4) - x1 + x2 - x3 + x4,
            10.0 - squared(x1) - 2.0 * squared(x2) - squared(x3) - 2.0 * squared(x4) + x1 + x4,
            5.0 - 2.0 * squared(x1) - squared(x2) - squared(x3) - 2.0 * x1 + x2 + x4,
        };
      })
      .optimum({0, 1, 2, -1}, -44.0);
}

StandardProblem hs44() {
  return Definition<4>(44, {0, 0, 0, 0},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return x1 - x2 - x3 - x1 * x3 + x1 * x4 + x2 * x3 - x2 * x4;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{8.0 - x1 - 2.0 * x2, 12.0 - 4.0 * x1 - x2, 12.0 - 3.0 * x1 - 4.0 * x2,
                          8.0 - 2.0 * x3 - x4, 8.0 - x3 - 2.0 * x4,  5.0 - x3 - x4};
      })
      .lower({0})
      .remark("another local minimum, f = -13, at x = (3, 0, 4, 0)")
      .optimum({0, 3, 0, 4}, -15.0);
}

StandardProblem hs45() {
  return Definition<5>(45, {2, 2, 2, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return 2.0 - x1 * x2 * x3 * x4 * x5 / 120.0;
                       })
      .lower({0})
      .upper({1, 2, 3, 4, 5})
      .optimum({1, 2, 3, 4, 5}, 1.0);
}

StandardProblem hs46() {
  return Definition<5>(46, {sqrt2 / 2.0, 1.75, 0.5, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(x1 - x2) + squared(x3 - 1.0) + to_the_fourth(x4 - 1.0) +
                                squared(cubed(x5 - 1.0));
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        return std::array{squared(x1) * x4 + sin(x4 - x5) - 1.0, x2 + to_the_fourth(x3) * squared(x4) - 2.0};
      })
      .optimum({1, 1, 1, 1, 1}, 0.0);
}

StandardProblem hs47() {
  return Definition<5>(47, {2, sqrt2, -1, 2.0 - sqrt2, 0.5},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(x1 - x2) + cubed(x2 - x3) + to_the_fourth(x3 - x4) + to_the_fourth(x4 - x5);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        return std::array{x1 + squared(x2) + cubed(x3) - 3.0, x2 - squared(x3) + x4 - 1.0, x1 * x5 - 1.0};
      })
      .remark(
          "published is f = 0 at x = (1, 1, 1, 1, 1), which is stationary but no minimum: x_2 - x_3 comes with the "
          "exponent 3")
      .optimum({0.6770043948666407, 0.7260894726520324, 1.2154912142370973, 1.7513294192355409, 1.4770952856177313},
               -0.026714182693940703);
}

StandardProblem hs48() {
  return Definition<5>(48, {3, 5, -3, 2, -2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(x1 - 1.0) + squared(x2 - x3) + squared(x4 - x5);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        return std::array{x1 + x2 + x3 + x4 + x5 - 5.0, x3 - 2.0 * (x4 + x5) + 3.0};
      })
      .optimum({1, 1, 1, 1, 1}, 0.0);
}

StandardProblem hs49() {
  return Definition<5>(49, {10, 7, 2, -3, 0.8},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(x1 - x2) + squared(x3 - 1.0) + to_the_fourth(x4 - 1.0) +
                                squared(cubed(x5 - 1.0));
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        return std::array{x1 + x2 + x3 + 4.0 * x4 - 7.0, x3 + 5.0 * x5 - 6.0};
      })
      .optimum({1, 1, 1, 1, 1}, 0.0);
}

StandardProblem hs50() {
  return Definition<5>(50, {35, -31, 11, 5, -5},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(x1 - x2) + squared(x2 - x3) + to_the_fourth(x3 - x4) + squared(x4 - x5);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        return std::array{x1 + 2.0 * x2 + 3.0 * x3 - 6.0, x2 + 2.0 * x3 + 3.0 * x4 - 6.0,
                          x3 + 2.0 * x4 + 3.0 * x5 - 6.0};
      })
      .optimum({1, 1, 1, 1, 1}, 0.0);
}

/// The equalities of problems 51 to 53, the first of which has another right-hand side in 51.
template <class Numbers>
auto three_planes(const Numbers& x, double right_hand_side) {
  const auto& [x1, x2, x3, x4, x5] = x;
  return std::array{x1 + 3.0 * x2 - right_hand_side, x3 + x4 - 2.0 * x5, x2 - x5};
}

/// The objective of problems 51 and 53.
constexpr auto four_squares = [](const auto& x) {
  const auto& [x1, x2, x3, x4, x5] = x;
  return squared(x1 - x2) + squared(x2 + x3 - 2.0) + squared(x4 - 1.0) + squared(x5 - 1.0);
};

StandardProblem hs51() {
  return Definition<5>(51, {2.5, 0.5, 2, -1, 0.5}, four_squares)
      .equalities([](const auto& x) { return three_planes(x, 4.0); })
      .optimum({1, 1, 1, 1, 1}, 0.0);
}

StandardProblem hs52() {
  return Definition<5>(52, {2, 2, 2, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(4.0 * x1 - x2) + squared(x2 + x3 - 2.0) + squared(x4 - 1.0) + squared(x5 - 1.0);
                       })
      .equalities([](const auto& x) { return three_planes(x, 0.0); })
      .optimum({-33.0 / 349.0, 11.0 / 349.0, 180.0 / 349.0, -158.0 / 349.0, 11.0 / 349.0}, 1859.0 / 349.0);
}

StandardProblem hs53() {
  return Definition<5>(53, {2, 2, 2, 2, 2}, four_squares)
      .equalities([](const auto& x) { return three_planes(x, 0.0); })
      .lower({-10})
      .upper({10})
      .optimum({-33.0 / 43.0, 11.0 / 43.0, 27.0 / 43.0, -5.0 / 43.0, 11.0 / 43.0}, 176.0 / 43.0);
}

StandardProblem hs54() {
  return Definition<6>(54, {6e3, 1.5, 4e6, 2, 3e-3, 5e7},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5, x6] = x;
                         const auto correlated =
                             squared(x1 - 1e4) / 6.4e7 + (x1 - 1e4) * (x2 - 1.0) / 2e4 + squared(x2 - 1.0);
                         const auto others = squared(x3 - 2e6) / 4.9e13 + squared(x4 - 10.0) / 2.5e3 +
                                             squared(x5 - 1e-3) / 2.5e-3 + squared(x6 - 1e8) / 2.5e17;
                         return -exp(-0.5 * (correlated / 0.96 + others));
                       })
      .equalities([](const auto& x) { return std::array{x[0] + 4e3 * x[1] - 1.76e4}; })
      .lower({0, -10, 0, 0, -1, 0})
      .upper({2e4, 10, 1e7, 20, 1, 2e8})
      .remark("other copies drop the exponential, or multiply by 0.96 where it is divided by it here")
      .optimum({91600.0 / 7.0, 79.0 / 70.0, 2e6, 10, 1e-3, 1e8}, -std::exp(-27.0 / 280.0));
}

StandardProblem hs55() {
  return Definition<6>(55, {1, 2, 0, 0, 0, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5, x6] = x;
                         return x1 + 2.0 * x2 + 4.0 * x5 + exp(x1 * x4);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6] = x;
        return std::array{x1 + 2.0 * x2 + 5.0 * x5 - 6.0,
                          x1 + x2 + x3 - 3.0,
                          x4 + x5 + x6 - 2.0,
                          x1 + x4 - 1.0,
                          x2 + x5 - 2.0,
                          x3 + x6 - 2.0};
      })
      .lower({0})
      .upper({1, infinity, infinity, 1, infinity, infinity})
      .remark(
          "the equalities are dependent (rank 5); another local minimum, f = 6.667, at x = (1, 5/3, 1/3, 0, 1/3, 5/3)")
      .optimum({0, 4.0 / 3.0, 5.0 / 3.0, 1, 2.0 / 3.0, 1.0 / 3.0}, 19.0 / 3.0);
}

StandardProblem hs56() {
  const double a = std::asin(std::sqrt(1.0 / 4.2));
  const double b = std::asin(std::sqrt(5.0 / 7.2));
  const double c = std::asin(std::sqrt(4.0 / 7.0));
  const double d = std::asin(std::sqrt(2.0 / 7.0));
  return Definition<7>(56, {1, 1, 1, a, a, a, b}, [](const auto& x) { return -x[0] * x[1] * x[2]; })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7] = x;
        return std::array{x1 - 4.2 * squared(sin(x4)), x2 - 4.2 * squared(sin(x5)), x3 - 4.2 * squared(sin(x6)),
                          x1 + 2.0 * x2 + 2.0 * x3 - 7.2 * squared(sin(x7))};
      })
      .optimum({2.4, 1.2, 1.2, c, d, d, pi / 2.0}, -3.456);
}

StandardProblem hs57() {
  return Definition<2>(57, {0.42, 5},
                       [](const auto& x) {
                         struct Sample {
                           int a;
                           double b[4];
                           int count;
                         };
                         // Chlorine in a product against its age.
                         constexpr Sample samples[] = {{8, {0.49, 0.49}, 2},
                                                       {10, {0.48, 0.47, 0.48, 0.47}, 4},
                                                       {12, {0.46, 0.46, 0.45, 0.43}, 4},
                                                       {14, {0.45, 0.43, 0.43}, 3},
                                                       {16, {0.44, 0.43, 0.43}, 3},
                                                       {18, {0.46, 0.45}, 2},
                                                       {20, {0.42, 0.42, 0.43}, 3},
                                                       {22, {0.41, 0.41, 0.40}, 3},
                                                       {24, {0.42, 0.40, 0.40}, 3},
                                                       {26, {0.41, 0.40, 0.41}, 3},
                                                       {28, {0.41, 0.40}, 2},
                                                       {30, {0.40, 0.40, 0.38}, 3},
                                                       {32, {0.41, 0.40}, 2},
                                                       {34, {0.40}, 1},
                                                       {36, {0.41, 0.38}, 2},
                                                       {38, {0.40, 0.40}, 2},
                                                       {40, {0.39}, 1},
                                                       {42, {0.39}, 1}};
                         const auto& [x1, x2] = x;
                         auto sum = 0.0 * x1;
                         for (const Sample& sample : samples) {
                           const auto model = x1 + (0.49 - x1) * exp(-x2 * (sample.a - 8.0));
                           for (int k = 0; k < sample.count; ++k) sum += squared(sample.b[k] - model);
                         }
                         return sum;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{0.49 * x2 - x1 * x2 - 0.09};
      })
      .lower({0.4, -4})
      .remark("Schittkowski's programs multiply the objective by 100")
      .optimum({0.41995265075780125, 1.284845193624846}, 0.028459669722986695);
}

StandardProblem hs58() {
  // x_2 = x_1^2 on the unit circle.
  const double golden = 2.0 / (1.0 + std::sqrt(5.0));
  return Definition<2>(58, {-2, 1},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         return 100.0 * squared(x2 - squared(x1)) + squared(1.0 - x1);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{squared(x2) - x1, squared(x1) - x2, squared(x1) + squared(x2) - 1.0};
      })
      .lower({-2, -infinity})
      .upper({0.5, infinity})
      .remark("the lower bound of x_1 is -0.5 in Schittkowski's programs, which their optimum violates")
      .optimum({-std::sqrt(golden), golden}, squared(1.0 + std::sqrt(golden)));
}

StandardProblem hs59() {
  return Definition<2>(59, {90, 10},
                       [](const auto& x) {
                         const auto& [x1, x2] = x;
                         const auto x1_2 = squared(x1);
                         const auto x1_3 = cubed(x1);
                         const auto x1_4 = squared(x1_2);
                         const auto x2_2 = squared(x2);
                         const auto x2_3 = cubed(x2);
                         return -75.196 + 3.8112 * x1 - 0.12694 * x1_2 + 2.0567e-3 * x1_3 - 1.0345e-5 * x1_4 +
                                6.8306 * x2 - 0.030234 * x1 * x2 + 1.28134e-3 * x1_2 * x2 - 3.5256e-5 * x1_3 * x2 +
                                2.266e-7 * x1_4 * x2 - 0.25645 * x2_2 + 3.4604e-3 * x2_3 - 1.3514e-5 * squared(x2_2) +
                                28.106 / (x2 + 1.0) + 5.2375e-6 * x1_2 * x2_2 + 6.3e-8 * x1_3 * x2_2 -
                                7e-10 * x1_3 * x2_3 - 3.4054e-4 * x1 * x2_2 + 1.6638e-6 * x1 * x2_3 +
                                2.8673 * exp(0.0005 * x1 * x2);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2] = x;
        return std::array{x1 * x2 - 700.0, x2 - squared(x1) / 125.0, squared(x2 - 50.0) - 5.0 * (x1 - 55.0)};
      })
      .lower({0})
      .upper({75, 65})
      .remark(
          "copies differ in the terms x_1^2 and x_1^4 x_2; the published optimum, f = -7.804226324, is not quite "
          "optimal; another local minimum, f = -6.7546, at x = (46.40, 52.22)")
      .optimum({13.55008884043414, 51.66017789574671}, -7.804235953664699);
}

StandardProblem hs60() {
  return Definition<3>(60, {2, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return squared(x1 - 1.0) + squared(x1 - x2) + to_the_fourth(x2 - x3);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{x1 * (1.0 + squared(x2)) + to_the_fourth(x3) - 4.0 - 3.0 * sqrt2};
      })
      .lower({-10})
      .upper({10})
      .optimum({1.1048590197333163, 1.1966741822882567, 1.5352622603253263}, 0.03256820025506986);
}

}  // namespace

std::vector<StandardProblem> hock_schittkowski_31_60() {
  return {hs31(), hs32(), hs33(), hs34(), hs35(), hs36(), hs37(), hs38(), hs39(), hs40(),
          hs41(), hs42(), hs43(), hs44(), hs45(), hs46(), hs47(), hs48(), hs49(), hs50(),
          hs51(), hs52(), hs53(), hs54(), hs55(), hs56(), hs57(), hs58(), hs59(), hs60()};
}

}  // namespace reprise::standard
