#pragma once

// The whole library: problems, results and what all solvers share; each solver has a header of its own.

#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/nonnegative_least_squares.hpp"
#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/result.hpp"
#include "reprise/optimizers/solver.hpp"
