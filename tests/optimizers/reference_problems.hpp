#pragma once

// Optimization problems whose solution is known, for testing and comparing solvers.

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/optimizers/problem.hpp"

namespace reprise {

struct ReferenceProblem {
  Problem problem;  ///< with exact first derivatives and the exact Hessian of the Lagrangian
  Eigen::VectorXd start;
  Eigen::VectorXd optimum;  ///< the known global optimum; one of them where there are several
  double f_optimum = 0.0;
  std::string source;  ///< where the problem is taken from
};

/// All problems, in a fixed order.
std::vector<ReferenceProblem> reference_problems();

/// The problem of that name ("hs100", "beale"). Throws std::invalid_argument when there is none.
ReferenceProblem reference_problem(std::string_view name);

}  // namespace reprise
