#include <cmath>
#include <numbers>

#include "colville.hpp"
#include "definition.hpp"

namespace reprise::standard {
namespace {

using std::numbers::sqrt2;

StandardProblem hs61() {
  return Definition<3>(61, {0, 0, 0},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return 4.0 * squared(x1) + 2.0 * squared(x2) + 2.0 * squared(x3) - 33.0 * x1 + 16.0 * x2 -
                                24.0 * x3;
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{3.0 * x1 - 2.0 * squared(x2) - 7.0, 4.0 * x1 - squared(x3) - 11.0};
      })
      .remark("the gradients of the equalities are parallel at the start")
      .optimum({5.326770135563928, -2.118998632218976, 3.2104642253505506}, -143.64614219778025);
}

StandardProblem hs62() {
  return Definition<3>(62, {0.7, 0.2, 0.1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         const auto b3 = x3 + 0.03;
                         const auto b2 = x2 + b3;
                         const auto b1 = x1 + b2;
                         return -32.174 * (255.0 * log(b1 / (0.09 * x1 + b2)) + 280.0 * log(b2 / (0.07 * x2 + b3)) +
                                           290.0 * log(b3 / (0.13 * x3 + 0.03)));
                       })
      .equalities([](const auto& x) { return std::array{x[0] + x[1] + x[2] - 1.0}; })
      .lower({0})
      .upper({1})
      .optimum({0.6178126908126925, 0.32820222311966907, 0.05398508606763848}, -26272.514487318258);
}

StandardProblem hs63() {
  return Definition<3>(63, {2, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return 1000.0 - squared(x1) - 2.0 * squared(x2) - squared(x3) - x1 * x2 - x1 * x3;
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{8.0 * x1 + 14.0 * x2 + 7.0 * x3 - 56.0, squared(x1) + squared(x2) + squared(x3) - 25.0};
      })
      .lower({0})
      .optimum({3.512121341874721, 0.21698794151522324, 3.5521711548270156}, 961.7151721300521);
}

StandardProblem hs64() {
  return Definition<3>(64, {1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return 5.0 * x1 + 5e4 / x1 + 20.0 * x2 + 7.2e4 / x2 + 10.0 * x3 + 1.44e5 / x3;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{1.0 - 4.0 / x1 - 32.0 / x2 - 120.0 / x3};
      })
      .lower({1e-5})
      .optimum({108.73470491089891, 85.1262127908938, 204.32459661260555}, 6299.8424279215205);
}

StandardProblem hs65() {
  return Definition<3>(65, {-5, 5, 0},
                       [](const auto& x) {
                         const auto& [x1, x2, x3] = x;
                         return squared(x1 - x2) + squared(x1 + x2 - 10.0) / 9.0 + squared(x3 - 5.0);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{48.0 - squared(x1) - squared(x2) - squared(x3)};
      })
      .lower({-4.5, -4.5, -5})
      .upper({4.5, 4.5, 5})
      .optimum({3.6504617252130367, 3.6504617252130367, 4.620417555320008}, 0.9535288568047826);
}

StandardProblem hs66() {
  return Definition<3>(66, {0, 1.05, 2.9}, [](const auto& x) { return 0.2 * x[2] - 0.8 * x[0]; })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3] = x;
        return std::array{x2 - exp(x1), x3 - exp(x2)};
      })
      .lower({0})
      .upper({100, 100, 10})
      .optimum({0.1841264879228477, 1.2021678731970429, 3.3273223225990955}, 0.518163274181541);
}

/// Problems 68 and 69: cost of an inspection plan.
Definition<4> inspection_plan(int number, double a, double b, double samples) {
  const double root = std::sqrt(samples);
  Definition<4> definition(number, {1, 1, 1, 1}, [=](const auto& x) {
    const auto& [x1, x2, x3, x4] = x;
    const auto growth = exp(x1) - 1.0;
    return (a * samples - (b * growth - x3) * x4 / (growth + x4)) / x1;
  });
  definition
      .equalities([=](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{x3 - 2.0 * normal_distribution(-x2),
                          x4 - normal_distribution(root - x2) - normal_distribution(-x2 - root)};
      })
      .lower({1e-4, 0, 0, 0})
      .upper({100, 100, 2, 2});
  return definition;
}

StandardProblem hs68() {
  return inspection_plan(68, 1e-4, 1.0, 24.0)
      .optimum({0.06785857708551381, 3.646210855688174, 0.00026613562521542216, 0.8948550393735536},
               -0.9204250036397491);
}

StandardProblem hs69() {
  return inspection_plan(69, 0.1, 1000.0, 4.0)
      .optimum({0.02937141742170966, 1.1902534504068099, 0.23394679066745871, 0.7916678112438332}, -956.7128866500254);
}

StandardProblem hs70() {
  return Definition<4>(70, {2, 4, 0.04, 2},
                       [](const auto& x) {
                         constexpr double observed[] = {0.00189, 0.1038, 0.268,  0.506,   0.577,  0.604, 0.725,
                                                        0.898,   0.947,  0.845,  0.702,   0.528,  0.385, 0.257,
                                                        0.159,   0.0869, 0.0453, 0.01509, 0.00189};
                         const auto& [x1, x2, x3, x4] = x;
                         const auto b = x3 + (1.0 - x3) * x4;
                         const auto b4 = b / x4;
                         // The two gamma distributions without what depends on the sample, by Stirling's formula.
                         const auto first = x3 * pow(b, x2) * sqrt(x2 / 6.2832) * (12.0 * x2 / (12.0 * x2 + 1.0));
                         const auto second =
                             (1.0 - x3) * pow(b4, x1) * sqrt(x1 / 6.2832) * (12.0 * x1 / (12.0 * x1 + 1.0));
                         auto sum = 0.0 * x1;
                         for (int i = 0; i < 19; ++i) {
                           const double c = (i == 0 ? 0.1 : static_cast<double>(i)) / 7.658;
                           const double log_c = std::log(c);
                           const auto model = first * exp((x2 - 1.0) * log_c + x2 * (1.0 - c * b)) +
                                              second * exp((x1 - 1.0) * log_c + x1 * (1.0 - c * b4));
                           sum += squared(model - observed[i]);
                         }
                         return sum;
                       })
      .inequalities([](const auto& x) { return std::array{x[2] + (1.0 - x[2]) * x[3]}; })
      .lower({1e-5})
      .upper({100, 100, 1, 100})
      .remark(
          "misprinted in the book; these are the formulas of Schittkowski's programs, whose optimum is the printed one")
      .optimum({12.276979127629124, 4.63174816285486, 0.312864630225692, 2.029282825341488}, 0.007498463574427664);
}

StandardProblem hs71() {
  return Definition<4>(71, {1, 5, 5, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return x1 * x4 * (x1 + x2 + x3) + x3;
                       })
      .inequalities([](const auto& x) { return std::array{x[0] * x[1] * x[2] * x[3] - 25.0}; })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{squared(x1) + squared(x2) + squared(x3) + squared(x4) - 40.0};
      })
      .lower({1})
      .upper({5})
      .optimum({1, 4.742999637264417, 3.821149984184874, 1.379408293172672}, 17.0140172891563);
}

StandardProblem hs72() {
  return Definition<4>(72, {1, 1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return 1.0 + x1 + x2 + x3 + x4;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{0.0401 - 4.0 / x1 - 2.25 / x2 - 1.0 / x3 - 0.25 / x4,
                          0.010085 - 0.16 / x1 - 0.36 / x2 - 0.64 / x3 - 0.64 / x4};
      })
      .lower({0.001})
      .upper({4e5, 3e5, 2e5, 1e5})
      .optimum({193.40742727194632, 179.54707603227453, 185.01806335815152, 168.70679112724056}, 727.6793577896129);
}

StandardProblem hs73() {
  return Definition<4>(73, {1, 1, 1, 1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return 24.55 * x1 + 26.75 * x2 + 39.0 * x3 + 40.5 * x4;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{
            2.3 * x1 + 5.6 * x2 + 11.1 * x3 + 1.3 * x4 - 5.0,
            12.0 * x1 + 11.9 * x2 + 41.8 * x3 + 52.1 * x4 - 21.0 -
                1.645 * sqrt(0.28 * squared(x1) + 0.19 * squared(x2) + 20.5 * squared(x3) + 0.62 * squared(x4))};
      })
      .equalities([](const auto& x) { return std::array{x[0] + x[1] + x[2] + x[3] - 1.0}; })
      .lower({0})
      .optimum({0.6355215686350703, 0, 0.312701880751523, 0.05177655061340685}, 29.89437815914337);
}

/// Problems 74 and 75: load of an electrical network; the largest angle differs.
Definition<4> network_load(int number, double angle) {
  Definition<4> definition(number, {0, 0, 0, 0}, [](const auto& x) {
    const auto& [x1, x2, x3, x4] = x;
    return 3.0 * x1 + 1e-6 * cubed(x1) + 2.0 * x2 + 2e-6 / 3.0 * cubed(x2);
  });
  definition.inequalities([=](const auto& x) {
              return std::array{x[3] - x[2] + angle, x[2] - x[3] + angle};
            })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{1000.0 * (sin(-x3 - 0.25) + sin(-x4 - 0.25)) + 894.8 - x1,
                          1000.0 * (sin(x3 - 0.25) + sin(x3 - x4 - 0.25)) + 894.8 - x2,
                          1000.0 * (sin(x4 - 0.25) + sin(x4 - x3 - 0.25)) + 1294.8};
      })
      .lower({0, 0, -angle, -angle})
      .upper({1200, 1200, angle, angle});
  return definition;
}

StandardProblem hs74() {
  return network_load(74, 0.55).optimum(
      {679.9453198513988, 1026.0671326102643, 0.1188763644929681, -0.39623355320327364}, 5126.49810959527);
}

StandardProblem hs75() {
  return network_load(75, 0.48).optimum(
      {776.159026586053, 925.1951384690983, 0.05110892853835576, -0.42889107146164657}, 5174.412695377733);
}

StandardProblem hs76() {
  return Definition<4>(76, {0.5, 0.5, 0.5, 0.5},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4] = x;
                         return squared(x1) + 0.5 * squared(x2) + squared(x3) + 0.5 * squared(x4) - x1 * x3 + x3 * x4 -
                                x1 - 3.0 * x2 + x3 - x4;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4] = x;
        return std::array{5.0 - x1 - 2.0 * x2 - x3 - x4, 4.0 - 3.0 * x1 - x2 - 2.0 * x3 + x4, x2 + 4.0 * x3 - 1.5};
      })
      .lower({0})
      .optimum({3.0 / 11.0, 23.0 / 11.0, 0, 6.0 / 11.0}, -103.0 / 22.0);
}

StandardProblem hs77() {
  return Definition<5>(77, {2, 2, 2, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(x1 - 1.0) + squared(x1 - x2) + squared(x3 - 1.0) + to_the_fourth(x4 - 1.0) +
                                squared(cubed(x5 - 1.0));
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        return std::array{squared(x1) * x4 + sin(x4 - x5) - 2.0 * sqrt2,
                          x2 + to_the_fourth(x3) * squared(x4) - 8.0 - sqrt2};
      })
      .optimum({1.1661721897092985, 1.1821113888027044, 1.3802570431454597, 1.5060362736230457, 0.6109201960430908},
               0.24150512879017869);
}

/// The equalities of problems 78, 80 and 81.
constexpr auto three_curved = [](const auto& x) {
  const auto& [x1, x2, x3, x4, x5] = x;
  return std::array{squared(x1) + squared(x2) + squared(x3) + squared(x4) + squared(x5) - 10.0, x2 * x3 - 5.0 * x4 * x5,
                    cubed(x1) + cubed(x2) + 1.0};
};

StandardProblem hs78() {
  return Definition<5>(78, {-2, 1.5, 2, -1, -1}, [](const auto& x) { return x[0] * x[1] * x[2] * x[3] * x[4]; })
      .equalities(three_curved)
      .optimum({-1.717143570394382, 1.595709690183554, 1.827245752927195, -0.7636430781841304, -0.7636430781841304},
               -2.919700408963679);
}

StandardProblem hs79() {
  return Definition<5>(79, {2, 2, 2, 2, 2},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return squared(x1 - 1.0) + squared(x1 - x2) + squared(x2 - x3) + to_the_fourth(x3 - x4) +
                                to_the_fourth(x4 - x5);
                       })
      .equalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        return std::array{x1 + squared(x2) + cubed(x3) - 2.0 - 3.0 * sqrt2, x2 - squared(x3) + x4 + 2.0 - 2.0 * sqrt2,
                          x1 * x5 - 2.0};
      })
      .optimum({1.1911274563110514, 1.3626031649617423, 1.4728179315120877, 1.635016619167993, 1.6790814361664075},
               0.07877682087105692);
}

StandardProblem hs80() {
  return Definition<5>(80, {-2, 2, 2, -1, -1}, [](const auto& x) { return exp(x[0] * x[1] * x[2] * x[3] * x[4]); })
      .equalities(three_curved)
      .lower({-2.3, -2.3, -3.2, -3.2, -3.2})
      .upper({2.3, 2.3, 3.2, 3.2, 3.2})
      .optimum({-1.7171435703943823, 1.5957096901835544, 1.8272457529271946, -0.7636430781841305, -0.7636430781841304},
               0.053949847770272);
}

StandardProblem hs81() {
  return Definition<5>(81, {-2, 2, 2, -1, -1},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return exp(x1 * x2 * x3 * x4 * x5) - 0.5 * squared(cubed(x1) + cubed(x2) + 1.0);
                       })
      .equalities(three_curved)
      .lower({-2.3, -2.3, -3.2, -3.2, -3.2})
      .upper({2.3, 2.3, 3.2, 3.2, 3.2})
      .optimum({-1.717143570394382, 1.5957096901835544, 1.8272457529271946, -0.7636430781841302, -0.7636430781841304},
               0.05394984777027205);
}

StandardProblem hs83() {
  return Definition<5>(83, {78, 33, 27, 27, 27},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return 5.3578547 * squared(x3) + 0.8356891 * x1 * x5 + 37.293239 * x1 - 40792.141;
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        const auto c1 = 85.334407 + 0.0056858 * x2 * x5 + 0.0006262 * x1 * x4 - 0.0022053 * x3 * x5;
        const auto c2 = 80.51249 + 0.0071317 * x2 * x5 + 0.0029955 * x1 * x2 + 0.0021813 * squared(x3) - 90.0;
        const auto c3 = 9.300961 + 0.0047026 * x3 * x5 + 0.0012547 * x1 * x3 + 0.0019085 * x3 * x4 - 20.0;
        return std::array{c1, c2, c3, 92.0 - c1, 20.0 - c2, 5.0 - c3};
      })
      .lower({78, 33, 27, 27, 27})
      .upper({102, 45, 45, 45, 45})
      .optimum({78, 33, 29.99525602568156, 45, 36.77581290578821}, -30665.53867178333);
}

StandardProblem hs84() {
  return Definition<5>(84, {2.52, 2, 37.5, 9.25, 6.8},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5] = x;
                         return 24345.0 + x1 * (8720288.849 - 150512.5253 * x2 + 156.6950325 * x3 - 476470.3222 * x4 -
                                                729482.8271 * x5);
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5] = x;
        const auto c1 = x1 * (-145421.402 + 2931.1506 * x2 - 40.427932 * x3 + 5106.192 * x4 + 15711.36 * x5);
        const auto c2 = x1 * (-155011.1084 + 4360.53352 * x2 + 12.9492344 * x3 + 10236.884 * x4 + 13176.786 * x5);
        const auto c3 = x1 * (-326669.5104 + 7390.68412 * x2 - 27.8986976 * x3 + 16643.076 * x4 + 30988.146 * x5);
        return std::array{c1, c2, c3, 294000.0 - c1, 294000.0 - c2, 277200.0 - c3};
      })
      .lower({0, 1.2, 20, 9, 6.5})
      .upper({1000, 2.4, 60, 9.3, 7})
      .remark("Schittkowski's programs state the optimum as -52.80, a hundred-thousandth of it")
      .optimum({4.537430974655399, 2.4, 60, 9.3, 7}, -5280335.133214757);
}

StandardProblem hs86() {
  return Definition<5>(86, {0, 0, 0, 0, 1},
                       [](const auto& x) {
                         auto sum = 0.0 * x[0];
                         for (std::size_t j = 0; j < 5; ++j) {
                           sum += colville::e[j] * x[j] + colville::d[j] * cubed(x[j]);
                           for (std::size_t i = 0; i < 5; ++i) sum += colville::c[i][j] * x[i] * x[j];
                         }
                         return sum;
                       })
      .inequalities([](const auto& x) {
        std::array<std::decay_t<decltype(x[0])>, 10> result;
        for (std::size_t i = 0; i < 10; ++i) {
          result[i] = -colville::b[i];
          for (std::size_t j = 0; j < 5; ++j) result[i] += colville::a[i][j] * x[j];
        }
        return result;
      })
      .lower({0})
      .optimum({0.3, 0.3334676065346073, 0.4, 0.4283101047816992, 0.22396487356079814}, -32.34867896572269);
}

StandardProblem hs93() {
  return Definition<6>(93, {5.54, 4.4, 12.02, 11.82, 0.702, 0.852},
                       [](const auto& x) {
                         const auto& [x1, x2, x3, x4, x5, x6] = x;
                         return x1 * x4 * (x1 + x2 + x3) * (0.0204 + 0.0607 * squared(x5)) +
                                x2 * x3 * (x1 + 1.57 * x2 + x4) * (0.0187 + 0.0437 * squared(x6));
                       })
      .inequalities([](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6] = x;
        return std::array{0.001 * x1 * x2 * x3 * x4 * x5 * x6 - 2.07,
                          1.0 - 0.00062 * x1 * x4 * squared(x5) * (x1 + x2 + x3) -
                              0.00058 * x2 * x3 * squared(x6) * (x1 + 1.57 * x2 + x4)};
      })
      .lower({0})
      .optimum({5.332666335528824, 4.6567440591720395, 10.432991940468176, 12.082306340063731, 0.7526074362238317,
                0.8786508746591405},
               135.07596282915182);
}

/// Problems 95 to 98: the right-hand sides of the four inequalities differ.
Definition<6> blending(int number, std::array<double, 4> b) {
  Definition<6> definition(number, {0, 0, 0, 0, 0, 0}, [](const auto& x) {
    const auto& [x1, x2, x3, x4, x5, x6] = x;
    return 4.3 * x1 + 31.8 * x2 + 63.3 * x3 + 15.8 * x4 + 68.5 * x5 + 4.7 * x6;
  });
  definition
      .inequalities([b](const auto& x) {
        const auto& [x1, x2, x3, x4, x5, x6] = x;
        return std::array{17.1 * x1 + 38.2 * x2 + 204.2 * x3 + 212.3 * x4 + 623.4 * x5 + 1495.5 * x6 - 169.0 * x1 * x3 -
                              3580.0 * x3 * x5 - 3810.0 * x4 * x5 - 18500.0 * x4 * x6 - 24300.0 * x5 * x6 - b[0],
                          17.9 * x1 + 36.8 * x2 + 113.9 * x3 + 169.7 * x4 + 337.8 * x5 + 1385.2 * x6 - 139.0 * x1 * x3 -
                              2450.0 * x4 * x5 - 16600.0 * x4 * x6 - 17200.0 * x5 * x6 - b[1],
                          -273.0 * x2 - 70.0 * x4 - 819.0 * x5 + 26000.0 * x4 * x5 - b[2],
                          159.9 * x1 - 311.0 * x2 + 587.0 * x4 + 391.0 * x5 + 2198.0 * x6 - 14000.0 * x1 * x6 - b[3]};
      })
      .lower({0})
      .upper({0.31, 0.046, 0.068, 0.042, 0.028, 0.0134});
  return definition;
}

StandardProblem hs95() {
  return blending(95, {4.97, -1.88, -29.08, -78.02}).optimum({0, 0, 0, 0, 0, 4.97 / 1495.5}, 4.7 * 4.97 / 1495.5);
}

StandardProblem hs96() {
  return blending(96, {4.97, -1.88, -69.08, -118.02}).optimum({0, 0, 0, 0, 0, 4.97 / 1495.5}, 4.7 * 4.97 / 1495.5);
}

StandardProblem hs97() {
  return blending(97, {32.97, 25.12, -29.08, -78.02})
      .optimum({0.26856491228070145, 0, 0, 0, 0.028, 0.0134}, 3.1358091228070273);
}

StandardProblem hs98() {
  return blending(98, {32.97, 25.12, -124.08, -173.02})
      .remark("another local minimum, f = 4.0712, at x = (0, 0, 0.0633, 0, 0, 0.0134)")
      .optimum({0.26856491228070145, 0, 0, 0, 0.028, 0.0134}, 3.1358091228070273);
}

/// Thrust per mass and duration of the stages of a rocket, for problem 99.
struct Stage {
  double thrust, duration;
};
constexpr Stage stages[] = {{50, 25}, {50, 25}, {75, 50}, {75, 50}, {75, 50}, {100, 90}, {100, 90}};

StandardProblem hs99() {
  return Definition<7>(99, {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5},
                       [](const auto& x) {
                         auto r = 0.0 * x[0];
                         for (std::size_t i = 0; i < 7; ++i) r += stages[i].thrust * stages[i].duration * cos(x[i]);
                         return -squared(r);
                       })
      .equalities([](const auto& x) {
        auto height = 0.0 * x[0];
        auto speed = 0.0 * x[0];
        for (std::size_t i = 0; i < 7; ++i) {
          const double duration = stages[i].duration;
          const auto acceleration = stages[i].thrust * sin(x[i]) - 32.0;
          height += 0.5 * squared(duration) * acceleration + duration * speed;
          speed += duration * acceleration;
        }
        return std::array{height - 1e5, speed - 1e3};
      })
      .lower({0})
      .upper({1.58})
      .optimum({0.5424678162123169, 0.5290214242019766, 0.5084491553164, 0.4802688509618158, 0.45123634979664684,
                0.4091830824209854, 0.3527878917811231},
               -831079891.5101074);
}

}  // namespace

std::vector<StandardProblem> hock_schittkowski_61_99() {
  return {hs61(), hs62(), hs63(), hs64(), hs65(), hs66(), hs68(), hs69(), hs70(), hs71(),
          hs72(), hs73(), hs74(), hs75(), hs76(), hs77(), hs78(), hs79(), hs80(), hs81(),
          hs83(), hs84(), hs86(), hs93(), hs95(), hs96(), hs97(), hs98(), hs99()};
}

}  // namespace reprise::standard
