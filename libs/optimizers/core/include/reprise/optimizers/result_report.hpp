#pragma once

// A result as text, for people.

#include <string>

#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/result.hpp"

namespace reprise {

/// One line without its end: status, f, largest violation, KKT residual where it was looked at, iterates and N_f + N_g.
///     converged: f = 17.014, violation 0, KKT residual 2.1e-09; 9 iterates, 9 + 9 evaluations (functions + gradients)
std::string brief_report(const Result& result);

/// Lines that each end with '\n', in columns: the problem's size; status, the solver's code and its sentence; f,
/// largest violation and KKT residual; iterates; every count that is not zero; the bounds that x is at, to within
/// active_bound_tolerance (tolerances.hpp) of the variable's unit (kkt_residual.hpp); and x. Numbers have six digits,
/// those of x as many as read back to the same value. Variables are counted from 1.
/// Throws std::invalid_argument when the result's x has not as many entries as the problem has variables.
std::string full_report(const Result& result, const Problem& problem);

/// The history as CSV, for a file: a line of names, then a line for each iterate with its index, f, the largest
/// violation, function and gradient evaluations up to there, and x_1, x_2, ... in the problem's own units, with as many
/// digits as read back to the same value. Each line ends with '\n'. The names alone, without any of x, where the
/// history is empty (Options::record_history).
std::string history_csv(const Result& result);

}  // namespace reprise
