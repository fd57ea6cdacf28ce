#pragma once

// Wraps a problem's functions so that their calls are counted apart from what a solver says.

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/result.hpp"

namespace reprise {

struct CountedProblem {
  Problem problem;
  std::shared_ptr<Counts> calls = std::make_shared<Counts>();
};

inline CountedProblem counted(Problem original) {
  CountedProblem result;
  const auto calls = result.calls;
  const auto wrap = [calls](auto& function, long Counts::*count) {
    if (!function) return;
    function = [calls, count, inner = function](auto&&... arguments) {
      ++((*calls).*count);
      return inner(std::forward<decltype(arguments)>(arguments)...);
    };
  };
  wrap(original.objective, &Counts::objective);
  wrap(original.inequality, &Counts::inequality);
  wrap(original.equality, &Counts::equality);
  wrap(original.objective_gradient, &Counts::objective_gradient);
  wrap(original.inequality_jacobian, &Counts::inequality_jacobian);
  wrap(original.equality_jacobian, &Counts::equality_jacobian);
  wrap(original.lagrangian_hessian, &Counts::lagrangian_hessian);
  result.problem = std::move(original);
  return result;
}

/// All seven counts in one order, for comparison.
inline std::vector<long> as_list(const Counts& counts) {
  return {counts.objective,           counts.inequality,        counts.equality,          counts.objective_gradient,
          counts.inequality_jacobian, counts.equality_jacobian, counts.lagrangian_hessian};
}

/// What a test lets a function of a problem throw.
struct Thrown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace reprise
