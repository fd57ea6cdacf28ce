#include <cmath>
#include <numbers>

#include "colville.hpp"
#include "definition.hpp"
#include "reprise/base/constants.hpp"

namespace reprise::standard {
namespace {

StandardProblem hs100() {
  return Definition<7>(100, {1, 2, 0, 4, 0, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5, x6, x7] = x;
                         return squared(x1 - 10.0) + 5.0 * squared(x2 - 12.0) + to_the_fourth(x3) +
                                3.0 * squared(x4 - 11.0) + 10.0 * squared(cubed(x5)) + 7.0 * squared(x6) +
                                to_the_fourth(x7) - 4.0 * x6 * x7 - 10.0 * x6 - 8.0 * x7;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7] = x;
        return std::array{
            127.0 - 2.0 * squared(x1) - 3.0 * to_the_fourth(x2) - x3 - 4.0 * squared(x4) - 5.0 * x5,
            282.0 - 7.0 * x1 - 3.0 * x2 - 10.0 * squared(x3) - x4 + x5,
            196.0 - 23.0 * x1 - squared(x2) - 6.0 * squared(x6) + 8.0 * x7,
            -4.0 * squared(x1) - squared(x2) + 3.0 * x1 * x2 - 2.0 * squared(x3) - 5.0 * x6 + 11.0 * x7,
        };
      })
      .optimum({2.33049937287957, 1.951372372896889, -0.4775413923888717, 4.365726233655811, -0.6244869705268175,
                1.038131018607958, 1.594226711611868},
               680.630057374402);
}

/// The objective of problems 101 to 103, a posynomial with one exponent left open.
template <class Numbers>
auto posynomial(const Numbers& x, double exponent) {
  const auto& [x1, x2, x3, x4, x5, x6, x7] = x;
  return 10.0 * x1 * squared(x4) * pow(x7, exponent) / (x2 * cubed(x6)) +
         15.0 * x3 * x4 / (x1 * squared(x2) * x5 * sqrt(x7)) + 20.0 * x2 * x6 / (squared(x1) * x4 * squared(x5)) +
         25.0 * squared(x1) * squared(x2) * sqrt(x5) * x7 / (x3 * squared(x6));
}

/// Problems 101 to 103.
Definition<7> geometric_program(int number, double exponent) {
  Definition<7> definition(number, {6, 6, 6, 6, 6, 6, 6},
                           [exponent](const auto& x) { return posynomial(x, exponent); });
  definition
      .inequalities([exponent](const auto& x) {
        constexpr double third = 1.0 / 3.0;
        const auto& [x1, x2, x3, x4, x5, x6, x7] = x;
        const auto f = posynomial(x, exponent);
        return std::array{
            1.0 - 0.5 * sqrt(x1) * x7 / (x3 * squared(x6)) - 0.7 * cubed(x1) * x2 * x6 * sqrt(x7) / squared(x3) -
                0.2 * x3 * pow(x6, 2.0 * third) * pow(x7, 0.25) / (x2 * sqrt(x4)),
            1.0 - 1.3 * x2 * x6 / (sqrt(x1) * x3 * x5) - 0.8 * x3 * squared(x6) / (x4 * x5) -
                3.1 * sqrt(x2) * pow(x6, third) / (x1 * squared(x4) * x5),
            1.0 - 2.0 * x1 * x5 * pow(x7, third) / (pow(x3, 1.5) * x6) - 0.1 * x2 * x5 / (sqrt(x3) * x6 * sqrt(x7)) -
                x2 * sqrt(x3) * x5 / x1 - 0.65 * x3 * x5 * x7 / (squared(x2) * x6),
            1.0 - 0.2 * x2 * sqrt(x5) * pow(x7, third) / (squared(x1) * x4) -
                0.3 * sqrt(x1) * squared(x2) * x3 * pow(x4, third) * pow(x7, 0.25) / pow(x5, 2.0 * third) -
                0.4 * x3 * x5 * pow(x7, 0.75) / (cubed(x1) * squared(x2)) - 0.5 * x4 * sqrt(x7) / squared(x3),
            f - 100.0,
            3000.0 - f,
        };
      })
      .lower({0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.01})
      .upper({10});
  return definition;
}

StandardProblem hs101() {
  return geometric_program(101, -0.25)
      .optimum({2.8561585557551417, 0.61082303080345, 2.150812562164472, 4.712873709241227, 0.9994875408574639,
                1.3475075048283303, 0.0316527665027743},
               1809.7647655714138);
}

StandardProblem hs102() {
  return geometric_program(102, 0.125)
      .optimum({3.8962531910702816, 0.8093587601054145, 2.66438599377549, 4.300912874794019, 0.8535549352485835,
                1.0952874445761025, 0.02731045965771925},
               911.8805714301091);
}

StandardProblem hs103() {
  return geometric_program(103, 0.5).optimum(
      {4.3941045105264, 0.8544687387974249, 2.8432303139508925, 3.3999786676865633, 0.7229261330073026,
       0.870406381804458, 0.024638826327228566},
      543.6679584662809);
}

/// The objective of problem 104.
constexpr auto reactor_cost = [](const auto& x) {
  return 0.4 * pow(x[0], 0.67) * pow(x[6], -0.67) + 0.4 * pow(x[1], 0.67) * pow(x[7], -0.67) + 10.0 - x[0] - x[1];
};

StandardProblem hs104() {
  return Definition<8>(104, {6, 3, 0.4, 0.2, 6, 6, 1, 0.5}, reactor_cost)
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8] = x;
        const auto f = reactor_cost(x);
        return std::array{1.0 - 0.0588 * x5 * x7 - 0.1 * x1,
                          1.0 - 0.0588 * x6 * x8 - 0.1 * x1 - 0.1 * x2,
                          1.0 - 4.0 * x3 / x5 - 2.0 / (pow(x3, 0.71) * x5) - 0.0588 * x7 / pow(x3, 1.3),
                          1.0 - 4.0 * x4 / x6 - 2.0 / (pow(x4, 0.71) * x6) - 0.0588 * x8 / pow(x4, 1.3),
                          f - 1.0,
                          4.2 - f};
      })
      .lower({0.1})
      .upper({10})
      .optimum({6.465114028369103, 2.2327086479852247, 0.6673974912866293, 0.5957564229003711, 5.932675677909848,
                5.527234564976939, 1.0133220089025603, 0.400668229125703},
               3.951163440103357);
}

StandardProblem hs105() {
  return Definition<8>(105, {0.1, 0.2, 100, 125, 175, 11.2, 13.2, 15.8},
                       [](const auto& x) {
                         struct Sample {
                           double value;
                           int count;
                         };
                         constexpr Sample samples[] = {{95, 1},   {105, 1},  {110, 4},  {115, 4},  {120, 15}, {125, 15},
                                                       {130, 15}, {135, 13}, {140, 21}, {145, 12}, {150, 17}, {155, 4},
                                                       {160, 20}, {165, 8},  {170, 17}, {175, 8},  {180, 6},  {185, 6},
                                                       {190, 7},  {195, 4},  {200, 3},  {205, 3},  {210, 8},  {215, 1},
                                                       {220, 6},  {230, 5},  {235, 1},  {240, 7},  {245, 1},  {260, 2}};
                         const auto& [x1, x2, x3, x4, x5, x6, x7, x8] = x;
                         auto sum = 0.0 * x1;
                         for (const Sample& sample : samples) {
                           const double y = sample.value;
                           const auto density = x1 / x6 * exp(-0.5 * squared((y - x3) / x6)) +
                                                x2 / x7 * exp(-0.5 * squared((y - x4) / x7)) +
                                                (1.0 - x1 - x2) / x8 * exp(-0.5 * squared((y - x5) / x8));
                           sum -= static_cast<double>(sample.count) * log(density / std::sqrt(2.0 * pi));
                         }
                         return sum;
                       })
      .inequalities([](const auto& x) { return std::array{1.0 - x[0] - x[1]}; })
      .lower({0.001, 0.001, 100, 130, 170, 5, 5, 5})
      .upper({0.499, 0.499, 180, 210, 240, 25, 25, 25})
      .remark(
          "in other copies the two largest observations are 250 in place of 260, x_2 is at most 0.449, and the optimum "
          "is f = 1136.31; the published optimum, f = 1138.4162, is not quite stationary")
      .optimum({0.3971113207486213, 0.42703964263875865, 130.89648260431574, 163.89480252353368, 218.6846153229668,
                12.159066207739219, 16.616301676963015, 20.019202065413275},
               1138.410663672131);
}

StandardProblem hs106() {
  return Definition<8>(106, {5000, 5000, 5000, 200, 350, 150, 225, 425},
                       [](const auto& x) { return x[0] + x[1] + x[2]; })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8] = x;
        return std::array{1.0 - 0.0025 * (x4 + x6),
                          1.0 - 0.0025 * (x5 + x7 - x4),
                          1.0 - 0.01 * (x8 - x5),
                          x1 * x6 - 833.33252 * x4 - 100.0 * x1 + 83333.333,
                          x2 * x7 - 1250.0 * x5 - x2 * x4 + 1250.0 * x4,
                          x3 * x8 - 1250000.0 - x3 * x5 + 2500.0 * x5};
      })
      .lower({100, 1000, 1000, 10, 10, 10, 10, 10})
      .upper({10000, 10000, 10000, 1000, 1000, 1000, 1000, 1000})
      .remark(
          "the published optimum, f = 7049.330923, is not quite optimal; the AMPL model rounds the constants of the "
          "fourth inequality")
      .optimum({579.3066844253534, 1359.9706680516658, 5109.970668051639, 182.01769958111962, 295.6011732779344,
                217.98230041888002, 286.4165263031858, 395.6011732779344},
               7049.248020528658);
}

StandardProblem hs107() {
  return Definition<9>(
             107, {0.8, 0.8, 0.2, 0.2, 1.0454, 1.0454, 1.0454, 0, 0},
             [](const auto& x) { return 3000.0 * x[0] + 1000.0 * cubed(x[0]) + 2000.0 * x[1] + 666.667 * cubed(x[1]); })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9] = x;
        const double c = 48.4 / 50.176 * std::sin(0.25);
        const double d = 48.4 / 50.176 * std::cos(0.25);
        const auto y1 = sin(x8);
        const auto y2 = cos(x8);
        const auto y3 = sin(x9);
        const auto y4 = cos(x9);
        const auto y5 = sin(x8 - x9);
        const auto y6 = cos(x8 - x9);
        return std::array{
            0.4 - x1 + 2.0 * c * squared(x5) - x5 * x6 * (d * y1 + c * y2) - x5 * x7 * (d * y3 + c * y4),
            0.4 - x2 + 2.0 * c * squared(x6) + x5 * x6 * (d * y1 - c * y2) + x6 * x7 * (d * y5 - c * y6),
            0.8 + 2.0 * c * squared(x7) + x5 * x7 * (d * y3 - c * y4) - x6 * x7 * (d * y5 + c * y6),
            0.2 - x3 + 2.0 * d * squared(x5) + x5 * x6 * (c * y1 - d * y2) + x5 * x7 * (c * y3 - d * y4),
            0.2 - x4 + 2.0 * d * squared(x6) - x5 * x6 * (c * y1 + d * y2) - x6 * x7 * (c * y5 + d * y6),
            -0.337 + 2.0 * d * squared(x7) - x5 * x7 * (c * y3 + d * y4) + x6 * x7 * (c * y5 - d * y6),
        };
      })
      .lower({0, 0, -infinity, -infinity, 0.90909, 0.90909, 0.90909, -infinity, -infinity})
      .upper({infinity, infinity, infinity, infinity, 1.0909, 1.0909, 1.0909, infinity, infinity})
      .optimum({0.6670127623153291, 1.0223847170508327, 0.2282871446675214, 0.1848217561297523, 1.0909, 1.0909,
                1.06903600314282, 0.10661062240656421, -0.33878761906990756},
               5055.011803543823);
}

StandardProblem hs108() {
  return Definition<9>(108, {1, 1, 1, 1, 1, 1, 1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9] = x;
                         return -0.5 * (x1 * x4 - x2 * x3 + x3 * x9 - x5 * x9 + x5 * x8 - x6 * x7);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9] = x;
        return std::array{1.0 - squared(x3) - squared(x4),
                          1.0 - squared(x5) - squared(x6),
                          1.0 - squared(x9),
                          1.0 - squared(x1) - squared(x2 - x9),
                          1.0 - squared(x1 - x5) - squared(x2 - x6),
                          1.0 - squared(x1 - x7) - squared(x2 - x8),
                          1.0 - squared(x3 - x5) - squared(x4 - x6),
                          1.0 - squared(x3 - x7) - squared(x4 - x8),
                          1.0 - squared(x7) - squared(x8 - x9),
                          x1 * x4 - x2 * x3,
                          x3 * x9,
                          -x5 * x9,
                          x5 * x8 - x6 * x7};
      })
      .lower({-infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity, 0})
      .remark("another local minimum, f = -0.67498")
      .optimum({0.884129209809512, 0.46724248561277876, 0.03742074263670449, 0.9992995987292889, 0.884129209809512,
                0.46724248561277887, 0.037420742636704515, 0.9992995987292888, 0},
               -0.5 * std::numbers::sqrt3);
}

StandardProblem hs109() {
  return Definition<9>(
             109, {0, 0, 0, 0, 0, 0, 0, 0, 0},
             [](const auto& x) { return 3.0 * x[0] + 1e-6 * cubed(x[0]) + 2.0 * x[1] + 0.522074e-6 * cubed(x[1]); })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9] = x;
        return std::array{x4 - x3 + 0.55, x3 - x4 + 0.55, 2250000.0 - squared(x1) - squared(x8),
                          2250000.0 - squared(x2) - squared(x9)};
      })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9] = x;
        constexpr double a = 50.176;
        const double b = std::sin(0.25);
        const double c = std::cos(0.25);
        return std::array{
            x5 * x6 * sin(-x3 - 0.25) + x5 * x7 * sin(-x4 - 0.25) + 2.0 * b * squared(x5) - a * x1 + 400.0 * a,
            x5 * x6 * sin(x3 - 0.25) + x6 * x7 * sin(x3 - x4 - 0.25) + 2.0 * b * squared(x6) - a * x2 + 400.0 * a,
            x5 * x7 * sin(x4 - 0.25) + x6 * x7 * sin(x4 - x3 - 0.25) + 2.0 * b * squared(x7) + 881.779 * a,
            a * x8 + x5 * x6 * cos(-x3 - 0.25) + x5 * x7 * cos(-x4 - 0.25) - 200.0 * a - 2.0 * c * squared(x5) +
                0.7533e-3 * a * squared(x5),
            a * x9 + x5 * x6 * cos(x3 - 0.25) + x6 * x7 * cos(x3 - x4 - 0.25) - 2.0 * c * squared(x6) +
                0.7533e-3 * a * squared(x6) - 200.0 * a,
            x5 * x7 * cos(x4 - 0.25) + x6 * x7 * cos(x4 - x3 - 0.25) - 2.0 * c * squared(x7) - 22.938 * a +
                0.7533e-3 * a * squared(x7),
        };
      })
      .lower({0, 0, -0.55, -0.55, 196, 196, 196, -400, -400})
      .upper({infinity, infinity, 0.55, 0.55, 252, 252, 252, 800, 800})
      .remark(
          "the last equality has + 22.938 a in other copies, the optimum of which is f = 5326.85; the published one, f "
          "= 5362.069, belongs to this")
      .optimum({675.0253392598597, 1134.0210897147128, 0.13348505091820353, -0.3711902626478124, 252, 252,
                201.46585773381398, 426.6190056620822, 368.48819908751665},
               5362.069181109595);
}

StandardProblem hs110() {
  return Definition<10>(110, {9, 9, 9, 9, 9, 9, 9, 9, 9, 9},
                        [](const auto& x) {
                          auto sum = 0.0 * x[0];
                          auto product = 1.0 + 0.0 * x[0];
                          for (const auto& one : x) {
                            sum += squared(log(one - 2.0)) + squared(log(10.0 - one));
                            product *= one;
                          }
                          return sum - pow(product, 0.2);
                        })
      .lower({2.001})
      .upper({9.999})
      .optimum({9.350265833069384}, -45.77846970744628);
}

/// The free energies of problems 111 and 112: chemical equilibrium, in logarithms and in the amounts themselves.
constexpr std::array<double, 10> free_energy{-6.089,  -17.164, -34.054, -5.914,  -24.721,
                                             -14.986, -24.1,   -10.708, -26.662, -22.179};

/// Balances of the three elements.
template <class Numbers>
auto balances(const Numbers& x) {
  return std::array{x[0] + 2.0 * x[1] + 2.0 * x[2] + x[5] + x[9] - 2.0, x[3] + 2.0 * x[4] + x[5] + x[6] - 1.0,
                    x[2] + x[6] + x[7] + 2.0 * x[8] + x[9] - 1.0};
}

template <class Number>
std::array<Number, 10> exponentials(const std::array<Number, 10>& x) {
  std::array<Number, 10> result;
  for (std::size_t j = 0; j < 10; ++j) result[j] = exp(x[j]);
  return result;
}

StandardProblem hs111() {
  return Definition<10>(111, {-2.3, -2.3, -2.3, -2.3, -2.3, -2.3, -2.3, -2.3, -2.3, -2.3},
                        [](const auto& x) {
                          const auto amounts = exponentials(x);
                          auto total = 0.0 * x[0];
                          for (const auto& amount : amounts) total += amount;
                          auto sum = 0.0 * x[0];
                          for (std::size_t j = 0; j < 10; ++j) sum += amounts[j] * (free_energy[j] + x[j] - log(total));
                          return sum;
                        })
      .equalities([](const auto& x) { return balances(exponentials(x)); })
      .lower({-100})
      .upper({100})
      .optimum({-3.202311588551231, -1.9123665970809778, -0.2444267477503839, -6.561177271657035, -0.7230979632953068,
                -7.274232280188076, -3.597237422327777, -4.020316730690856, -3.2883768813602505, -2.334371739220618},
               -47.76109085936587);
}

StandardProblem hs112() {
  return Definition<10>(112, {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1},
                        [](const auto& x) {
                          auto total = 0.0 * x[0];
                          for (const auto& amount : x) total += amount;
                          auto sum = 0.0 * x[0];
                          for (std::size_t j = 0; j < 10; ++j) sum += x[j] * (free_energy[j] + log(x[j] / total));
                          return sum;
                        })
      .equalities([](const auto& x) { return balances(x); })
      .lower({1e-6})
      .remark("published in the book is f = -47.707579, at a point that is not optimal")
      .optimum(
          {0.04066808735569017, 0.14773035434082155, 0.7831533540092344, 0.0014142198090301146, 0.48524664869927336,
           0.0006931720784210636, 0.027399310714003287, 0.017947279584925393, 0.03731436591302985, 0.09687132386577685},
          -47.761090859365886);
}

StandardProblem hs113() {
  return Definition<10>(113, {2, 3, 5, 5, 1, 2, 7, 3, 6, 10},
                        [](const auto& x) {
                          const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9, x10] = x;
                          return squared(x1) + squared(x2) + x1 * x2 - 14.0 * x1 - 16.0 * x2 + squared(x3 - 10.0) +
                                 4.0 * squared(x4 - 5.0) + squared(x5 - 3.0) + 2.0 * squared(x6 - 1.0) +
                                 5.0 * squared(x7) + 7.0 * squared(x8 - 11.0) + 2.0 * squared(x9 - 10.0) +
                                 squared(x10 - 7.0) + 45.0;
                        })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9, x10] = x;
        return std::array{
            105.0 - 4.0 * x1 - 5.0 * x2 + 3.0 * x7 - 9.0 * x8,
            -10.0 * x1 + 8.0 * x2 + 17.0 * x7 - 2.0 * x8,
            8.0 * x1 - 2.0 * x2 - 5.0 * x9 + 2.0 * x10 + 12.0,
            -3.0 * squared(x1 - 2.0) - 4.0 * squared(x2 - 3.0) - 2.0 * squared(x3) + 7.0 * x4 + 120.0,
            -5.0 * squared(x1) - 8.0 * x2 - squared(x3 - 6.0) + 2.0 * x4 + 40.0,
            -0.5 * squared(x1 - 8.0) - 2.0 * squared(x2 - 4.0) - 3.0 * squared(x5) + x6 + 30.0,
            -squared(x1) - 2.0 * squared(x2 - 2.0) + 2.0 * x1 * x2 - 14.0 * x5 + 6.0 * x6,
            3.0 * x1 - 6.0 * x2 - 12.0 * squared(x9 - 8.0) + 7.0 * x10,
        };
      })
      .optimum({2.171996371255455, 2.36368297369728, 8.77392573847685, 5.095984487948453, 0.9906547649638593,
                1.430573978936316, 1.321644208161703, 9.828725807886322, 8.280091670098345, 8.375926663921323},
               24.30620906817979);
}

StandardProblem hs114() {
  return Definition<10>(
             114, {1745, 12000, 110, 3048, 1974, 89.2, 92.8, 8, 3.6, 145},
             [](const auto& x) { return 5.04 * x[0] + 0.035 * x[1] + 10.0 * x[2] + 3.36 * x[4] - 0.063 * x[3] * x[6]; })
      .inequalities([](const auto& x) {
        constexpr double a = 0.99;
        constexpr double b = 0.9;
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9, x10] = x;
        const auto c1 = 35.82 - 0.222 * x10 - b * x9;
        const auto c2 = -133.0 + 3.0 * x7 - a * x10;
        const auto c5 = 1.12 * x1 + 0.13167 * x1 * x8 - 0.00667 * x1 * squared(x8) - a * x4;
        const auto c6 = 57.425 + 1.098 * x8 - 0.038 * squared(x8) + 0.325 * x6 - a * x7;
        return std::array{c1, c2, -c1 + x9 * (1.0 / b - b), -c2 + x10 * (1.0 / a - a),
                          c5, c6, -c5 + x4 * (1.0 / a - a), -c6 + x7 * (1.0 / a - a)};
      })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9, x10] = x;
        return std::array{1.22 * x4 - x1 - x5, 98000.0 * x3 / (x4 * x9 + 1000.0 * x3) - x6, (x2 + x5) / x1 - x8};
      })
      .lower({1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 85, 90, 3, 1.2, 145})
      .upper({2000, 16000, 120, 5000, 2000, 93, 95, 12, 4, 162})
      .remark("Schittkowski's programs state the optimum as -17.688, a hundredth of it")
      .optimum({1698.094765188972, 15818.614924183463, 54.10268233324524, 3031.22521736801, 2000, 90.11542219898641, 95,
                10.493298306705825, 1.56163636363636, 153.53535353535355},
               -1768.8069637162462);
}

StandardProblem hs116() {
  return Definition<13>(116, {0.5, 0.8, 0.9, 0.1, 0.14, 0.5, 489, 80, 650, 450, 150, 150, 150},
                        [](const auto& x) { return x[10] + x[11] + x[12]; })
      .inequalities([](const auto& x) {
        constexpr double a = 0.002;
        constexpr double b = 1.262626;
        constexpr double c = 1.231059;
        constexpr double d = 0.03475;
        constexpr double e = 0.975;
        constexpr double f = 0.00975;
        const auto& [x1, x2, x3, x4, x5, x6, x7, x8, x9, x10, x11, x12, x13] = x;
        return std::array{x3 - x2,
                          x2 - x1,
                          1.0 - a * (x7 - x8),
                          x11 + x12 + x13 - 50.0,
                          250.0 - x11 - x12 - x13,
                          x13 - b * x10 + c * x3 * x10,
                          x5 - d * x2 - e * x2 * x5 + f * squared(x2),
                          x6 - d * x3 - e * x3 * x6 + f * squared(x3),
                          x4 - d * x1 - e * x1 * x4 + f * squared(x1),
                          x12 - b * x9 + c * x2 * x9,
                          x11 - b * x8 + c * x1 * x8,
                          x5 * x7 - x1 * x8 - x4 * x7 + x4 * x8,
                          1.0 - a * (x2 * x9 + x5 * x8 - x1 * x8 - x6 * x9) - x5 - x6,
                          x2 * x9 - x3 * x10 - x6 * x9 - 500.0 * x2 + 500.0 * x6 + x2 * x10,
                          x2 - 0.9 - a * (x2 * x10 - x3 * x10)};
      })
      .lower({0.1, 0.1, 0.1, 0.0001, 0.1, 0.1, 0.1, 0.1, 500, 0.1, 1, 0.0001, 0.0001})
      .upper({1, 1, 1, 0.1, 0.9, 0.9, 1000, 1000, 1000, 500, 150, 150, 150})
      .remark("published is f = 97.588409, at a point that is neither optimal nor quite feasible")
      .optimum({0.8037731573766544, 0.8999858006730378, 0.9709824354838074, 0.1, 0.19081317621550659,
                0.46065478285224526, 574.0775735827616, 74.07757358276187, 500.0161601689685, 0.1, 20.23309069736744,
                77.34768992730748, 0.006728933395573946},
               97.58750955807051);
}

StandardProblem hs117() {
  return Definition<15>(
             117,
             {0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 60, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001},
             [](const auto& x) {
               auto sum = 0.0 * x[0];
               for (std::size_t j = 0; j < 10; ++j) sum -= colville::b[j] * x[j];
               for (std::size_t j = 0; j < 5; ++j) {
                 sum += 2.0 * colville::d[j] * cubed(x[10 + j]);
                 for (std::size_t k = 0; k < 5; ++k) sum += colville::c[k][j] * x[10 + k] * x[10 + j];
               }
               return sum;
             })
      .inequalities([](const auto& x) {
        std::array<std::decay_t<decltype(x[0])>, 5> result;
        for (std::size_t j = 0; j < 5; ++j) {
          result[j] = colville::e[j] + 3.0 * colville::d[j] * squared(x[10 + j]);
          for (std::size_t k = 0; k < 5; ++k) result[j] += 2.0 * colville::c[k][j] * x[10 + k];
          for (std::size_t k = 0; k < 10; ++k) result[j] -= colville::a[k][j] * x[k];
        }
        return result;
      })
      .lower({0})
      .optimum({0, 0, 5.174040727698153, 0, 3.061108687758446, 11.839545664800735, 0, 0, 0.10389619077061976, 0, 0.3,
                0.3334676065346077, 0.4, 0.42831010478169945, 0.22396487356079844},
               32.348678965722975);
}

StandardProblem hs118() {
  return Definition<15>(118, {20, 55, 15, 20, 60, 20, 20, 60, 20, 20, 60, 20, 20, 60, 20},
                        [](const auto& x) {
                          auto sum = 0.0 * x[0];
                          for (std::size_t k = 0; k < 15; k += 3) {
                            sum += 2.3 * x[k] + 1e-4 * squared(x[k]) + 1.7 * x[k + 1] + 1e-4 * squared(x[k + 1]) +
                                   2.2 * x[k + 2] + 1.5e-4 * squared(x[k + 2]);
                          }
                          return sum;
                        })
      .inequalities([](const auto& x) {
        constexpr double largest_rise[] = {6, 7, 6};
        constexpr double demand[] = {60, 50, 70, 85, 100};
        std::array<std::decay_t<decltype(x[0])>, 29> result;
        std::size_t row = 0;
        for (std::size_t i = 3; i < 15; ++i) {
          const auto rise = x[i] - x[i - 3];
          result[row++] = rise + 7.0;
          result[row++] = largest_rise[i % 3] - rise;
        }
        for (std::size_t k = 0; k < 5; ++k) result[row++] = x[3 * k] + x[3 * k + 1] + x[3 * k + 2] - demand[k];
        return result;
      })
      .lower({8, 43, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})
      .upper({21, 57, 16, 90, 120, 60, 90, 120, 60, 90, 120, 60, 90, 120, 60})
      .optimum({8, 49, 3, 1, 56, 0, 1, 63, 6, 3, 70, 12, 5, 77, 18}, 664.8204499999999);
}

StandardProblem hs119() {
  return Definition<16>(119, {10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10},
                        [](const auto& x) {
                          // Row and column of the ones of the matrix, counted from 1, beside its diagonal without 12.
                          constexpr int pairs[][2] = {{1, 4},   {1, 7},   {1, 8},  {1, 16}, {2, 3},  {2, 7},   {2, 10},
                                                      {3, 7},   {3, 9},   {3, 10}, {3, 14}, {4, 7},  {4, 11},  {4, 15},
                                                      {5, 6},   {5, 10},  {5, 12}, {5, 16}, {6, 8},  {6, 15},  {7, 11},
                                                      {7, 13},  {8, 10},  {8, 15}, {9, 12}, {9, 16}, {10, 14}, {11, 12},
                                                      {11, 13}, {12, 14}, {13, 14}};
                          std::array<std::decay_t<decltype(x[0])>, 16> y;
                          auto sum = 0.0 * x[0];
                          for (std::size_t i = 0; i < 16; ++i) {
                            y[i] = squared(x[i]) + x[i] + 1.0;
                            if (i != 11) sum += squared(y[i]);
                          }
                          for (const auto& [i, j] : pairs) {
                            sum += y[static_cast<std::size_t>(i - 1)] * y[static_cast<std::size_t>(j - 1)];
                          }
                          return sum;
                        })
      .equalities([](const auto& x) {
        constexpr double b[8][8] = {{0.22, 0.20, 0.19, 0.25, 0.15, 0.11, 0.12, 0.13},
                                    {-1.46, 0, -1.30, 1.82, -1.15, 0, 0.80, 0},
                                    {1.29, -0.89, 0, 0, -1.16, -0.96, 0, -0.49},
                                    {-1.10, -1.06, 0.95, -0.54, 0, -1.78, -0.41, 0},
                                    {0, 0, 0, -1.43, 1.51, 0.59, -0.33, -0.43},
                                    {0, -1.72, -0.33, 0, 1.62, 1.24, 0.21, -0.26},
                                    {1.12, 0, 0, 0.31, 0, 0, 1.12, 0},
                                    {0, 0.45, 0.26, -1.10, 0.58, 0, -1.03, 0.10}};
        constexpr double c[8] = {2.5, 1.1, -3.1, -3.5, 1.3, 2.1, 2.3, -1.5};
        std::array<std::decay_t<decltype(x[0])>, 8> result;
        for (std::size_t i = 0; i < 8; ++i) {
          result[i] = x[8 + i] - c[i];
          for (std::size_t j = 0; j < 8; ++j) result[i] += b[i][j] * x[j];
        }
        result[6] -= 0.36 * x[8];
        return result;
      })
      .lower({0})
      .upper({5})
      .optimum({0.03984735141112207, 0.7919831556883811, 0.2028703302510379, 0.8443579163656747, 1.2699064528665018,
                0.9347387078246439, 1.6819619692469188, 0.15530087738956772, 1.5678703335517998, 0, 0, 0,
                0.6602040660869546, 0, 0.6742559268682812, 0},
               244.89969751680076);
}

}  // namespace

std::vector<StandardProblem> hock_schittkowski_100_119() {
  return {hs100(), hs101(), hs102(), hs103(), hs104(), hs105(), hs106(), hs107(), hs108(), hs109(),
          hs110(), hs111(), hs112(), hs113(), hs114(), hs116(), hs117(), hs118(), hs119()};
}

}  // namespace reprise::standard
