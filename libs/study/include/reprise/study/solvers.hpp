#pragma once

// The optimizers by name, as the comparisons run them.

#include <memory>
#include <string>
#include <vector>

#include "reprise/io/options.hpp"
#include "reprise/optimizers/solver.hpp"

namespace reprise {

/// What a comparison may set; all else is each solver's own default.
struct SolverSettings {
  double move_limit = 1.0;           ///< rho of dynamic_q and dynamic_q_dual
  double relative_move_limit = 0.1;  ///< rho of dynamic_q_safeguarded, in units of max(1, |x_i|) of the start
  double step_tolerance = 1e-8;      ///< eps_x of every variant of Dynamic-Q
  double value_tolerance = 1e-10;    ///< eps_f of every variant of Dynamic-Q
  long max_iterations = 300;         ///< of every variant of Dynamic-Q
  double initial_barrier = 0.1;      ///< of Ipopt
  long seed = 1;                     ///< of isres
  long max_points = 20'000;          ///< of NLopt's algorithms
  double search_radius = 10.0;  ///< of isres, where a variable has no bound, in units of max(1, |x_i|) of the start

  /// Adds an option for each but initial_barrier and max_points.
  void declare(CommandLine& options);
};

/// A solver under the name that tables and options use.
struct NamedSolver {
  std::string name;                      ///< as on the command line
  std::string description;               ///< one line
  std::shared_ptr<const Solver> solver;  ///< with its options set
};

/// The variants of Dynamic-Q: dynamic_q, dynamic_q_dual, dynamic_q_safeguarded. They need no other project's library.
std::vector<NamedSolver> dynamic_q_variants(const SolverSettings& settings = {});

/// All of them, in the order of the tables: dynamic_q, dynamic_q_dual, dynamic_q_safeguarded, slsqp, ccsaq, mma,
/// ipopt_lbfgs, ipopt, cobyla, isres.
std::vector<NamedSolver> named_solvers(const SolverSettings& settings = {});

/// Their names.
std::vector<std::string> solver_names();

/// Those that reprise offers for a synthesis: all but ipopt. Its exact Hessian takes second derivatives of the
/// conditioning for every row of the working set in every iteration, which costs tens of times what ipopt_lbfgs needs
/// for the same design.
std::vector<std::string> synthesis_solver_names();

/// Those whose names are in the list, in its order. Throws std::logic_error for an unknown name.
std::vector<NamedSolver> select_solvers(const std::vector<std::string>& names, const SolverSettings& settings);

}  // namespace reprise
