#include "reprise/optimizers/standard_problems.hpp"

#include <iterator>
#include <stdexcept>
#include <utility>

#include "definition.hpp"

namespace reprise {
namespace {

StandardProblem beale() {
  return standard::Definition<2>(
             "beale", "J. J. More, B. S. Garbow, K. E. Hillstrom, ACM Trans. Math. Softw. 7 (1981) 17-41, problem 5",
             {1, 1},
             [](const auto& x) {
               using standard::squared;
               const auto& [x1, x2] = x;
               return squared(1.5 - x1 * (1.0 - x2)) + squared(2.25 - x1 * (1.0 - squared(x2))) +
                      squared(2.625 - x1 * (1.0 - standard::cubed(x2)));
             })
      .optimum({3, 0.5}, 0.0);
}

}  // namespace

std::vector<StandardProblem> standard_problems() {
  std::vector<StandardProblem> all{beale()};
  for (auto* part : {standard::hock_schittkowski_1_30, standard::hock_schittkowski_31_60,
                     standard::hock_schittkowski_61_99, standard::hock_schittkowski_100_119}) {
    std::vector<StandardProblem> some = part();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

StandardProblem standard_problem(std::string_view name) {
  for (StandardProblem& one : standard_problems()) {
    if (one.problem.name == name) return std::move(one);
  }
  throw std::invalid_argument("there is no standard problem '" + std::string(name) + "'");
}

}  // namespace reprise
