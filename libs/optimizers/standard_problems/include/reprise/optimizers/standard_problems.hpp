#pragma once

// Optimization problems with a known solution, for testing and comparing solvers.
//
// The problems hs1 to hs119 are those of
//     W. Hock, K. Schittkowski, Test Examples for Nonlinear Programming Codes, Springer 1981,
// as public copies give them: the AMPL models of R. J. Vanderbei and E. Bobrovnikova, the JAX versions of
// the CUTEst models (sif2jax) and the translation of Schittkowski's own Fortran programs in Simbody. Where these
// disagree, the formulas are those whose optimum is the published one, and `remark` says what differs. Of the 116
// problems of the collection 108 are here. Left out are 67 (an iteration inside of the functions), 85 (two pages of
// intermediate values), 87 (an objective that jumps) and 88 to 92 (truncated series). The numbers 82, 94 and 115 do
// not exist. None of them is without constraints and bounds, so beale is there as well.

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/optimizers/problem.hpp"

namespace reprise {

/// A problem with the start of the source and its best known solution.
struct StandardProblem {
  Problem problem;        ///< with exact first derivatives and the exact Hessian of the Lagrangian
  Eigen::VectorXd start;  ///< as printed in the source
  /// The lowest feasible point that is known, to rounding; one of them where there are several. Other local minima may
  /// exist, and a solver that ends in one has not solved the problem.
  Eigen::VectorXd optimum;
  double f_optimum = 0.0;  ///< f(x*)
  std::string source;      ///< where the problem is taken from
  std::string remark;      ///< what sources disagree about, or what is irregular about the optimum; may be empty
};

/// All problems, in the order of their numbers, beale first.
std::vector<StandardProblem> standard_problems();

/// The problem of that name ("hs100", "beale"). Throws std::invalid_argument when there is none.
StandardProblem standard_problem(std::string_view name);

}  // namespace reprise
