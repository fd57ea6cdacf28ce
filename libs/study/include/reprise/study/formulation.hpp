#pragma once

// A synthesis as an optimization problem, and the solvers that fit it: what the program reprise and the chapter's
// tables share.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reprise/optimizers/solver.hpp"
#include "reprise/study/solvers.hpp"
#include "reprise/synthesis/area_formulation.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// The formulations of a synthesis: area_formulation.hpp and pointwise_formulation.hpp.
enum class Formulation {
  area,       ///< the thesis's: one constraint, by finite differences; neither f nor g is smooth
  pointwise,  ///< limits and kappa^-1 at many points of the outline, with exact derivatives
};

/// "area", "pointwise".
std::string to_string(Formulation formulation);

/// The formulation of that name. Throws std::logic_error for another name.
Formulation formulation_called(const std::string& name);

/// The largest violation that counts as none in the pointwise formulation, whose functions are smooth: of lengths, in
/// the unit of the task, and of kappa^-1.
inline constexpr double pointwise_tolerance = 1e-7;

/// The standard values are the thesis's, sections 5.6.2 and following.
struct FormulationSettings {
  double chord = 0.02;  ///< d of the chord method, a length
  /// Gamma, the interval of finite differences of `area`, a length.
  double difference_step = 1e-6;
  Derivatives differences = Derivatives::forward;  ///< their kind
  double area_tolerance = 1e-5;  ///< g at most this counts as feasible: the largest g* that is printed
  long points = 1500;            ///< outline points of `pointwise`
  long max_evaluations = 5000;   ///< limit on function evaluations of a run
};

/// What a solver is given.
struct SynthesisProblem {
  Problem problem;        ///< in the variables d, or [d, t]
  Eigen::VectorXd start;  ///< in the same
  Options options;        ///< derivatives, tolerance and limits that fit the formulation
};

/// The run options of a formulation.
Options run_options(Formulation formulation, const FormulationSettings& settings);

/// The task in a formulation, from the design d0. Throws as AreaFormulation and pointwise_problem do.
SynthesisProblem formulate(Formulation formulation, const SynthesisTask& task, const Eigen::VectorXd& d0,
                           const FormulationSettings& settings);

/// How many iterations of Dynamic-Q a round of the exchange has at most.
inline constexpr long pointwise_iterations = 100;

/// Solvers by name (solvers.hpp) for a formulation. The pointwise formulation's many inequalities are exchanged
/// (constraint_exchange.hpp), for every solver alike; Dynamic-Q sometimes circles around a flat optimum there, so a
/// round of the exchange ends after pointwise_iterations of it, and the next one goes on.
std::vector<NamedSolver> solvers_for(Formulation formulation, const std::vector<std::string>& names,
                                     SolverSettings settings);

}  // namespace reprise
