#pragma once

// The whole library: problems, results and what all solvers share. Each solver has a header and a library of its own:
//
//     reprise/optimizers/dynamic_q.hpp   Dynamic-Q                                   reprise::dynamic_q
//     reprise/optimizers/nlopt.hpp       SLSQP, MMA, CCSAQ, COBYLA, ISRES of NLopt   reprise::nlopt
//     reprise/optimizers/ipopt.hpp       Ipopt, an interior-point method             reprise::ipopt

#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/counted_functions.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/finite_differences.hpp"
#include "reprise/optimizers/free_variables.hpp"
#include "reprise/optimizers/iterate_record.hpp"
#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/nonnegative_least_squares.hpp"
#include "reprise/optimizers/parked_exception.hpp"
#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/result.hpp"
#include "reprise/optimizers/result_report.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/optimizers/tolerances.hpp"
