#pragma once

// The thesis's synthesis tables: every prescribed workspace, both formulations, several optimizers, all started from
// the same design and judged alike from outside.

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "reprise/io/options.hpp"
#include "reprise/io/table.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/study/formulation.hpp"
#include "reprise/synthesis/area_formulation.hpp"

namespace reprise::experiments {

/// What a synthesis table depends on. The defaults are those of SO synthesis, section 5.6.2, where the chapter gives
/// them.
struct ChapterSettings {
  std::vector<std::string> workspaces{"P1", "P2", "P3"};
  std::vector<std::string> formulations{"area", "pointwise"};
  std::vector<std::string> optimizers{"dynamic_q", "slsqp", "ipopt"};
  double move_limit = 0.1;                    ///< rho of Dynamic-Q
  double step_tolerance = 1e-4;               ///< eps_x of Dynamic-Q with `area`
  double value_tolerance = 1e-6;              ///< eps_f of Dynamic-Q with `area`
  std::string differences = "forward";        ///< or "central", for `area`, for every optimizer
  double difference_step = 1e-6;              ///< Gamma, for `area`, for every optimizer
  double chord = 0.02;                        ///< d
  std::vector<double> orientations_deg{0.0};  ///< phi: the slices, or both ends of a range
  bool dextrous = false;                      ///< whether all orientations between two ends are meant
  double area_tolerance = 1e-5;               ///< g at most this counts as feasible: the largest g* that is printed
  long points = 1500;                         ///< outline points of `pointwise`
  double pointwise_step_tolerance = 1e-5;     ///< eps_x of Dynamic-Q with `pointwise`
  double pointwise_value_tolerance = 1e-7;    ///< eps_f of Dynamic-Q with `pointwise`
  long max_evaluations = 5000;                ///< limit on N_f of a run
  long seed = 1;                              ///< of the starts of the restarts

  void declare(CommandLine& options);

  FormulationSettings formulation_settings() const;
};

/// The fixed inputs of a table.
struct SynthesisInputs {
  std::string title;
  std::vector<PrescribedWorkspace> workspaces;
  CollinearDesign start;  ///< d^0
  std::array<Interval, 3> lengths;
  Table published;  ///< as printed: workspace, N_g, f_d0, f_star, g_star, x_C, y_C, x_D, x_E, r
};

/// The chapter's settings of one kind of synthesis: sections 5.6.2, 5.7.2 and 5.8.2. The orientations are those of its
/// problem files.
ChapterSettings chapter_settings(const ChapterSynthesis& synthesis);

/// The inputs of one kind of synthesis, with the prescribed workspaces in the size that belongs to it.
SynthesisInputs read_synthesis_inputs(const std::string& title, const ChapterSynthesis& synthesis);

/// The area formulation for one of the prescribed workspaces. Throws std::runtime_error when the inputs do not hold it,
/// std::invalid_argument when the settings' orientations do not fit.
AreaFormulation area_formulation(const SynthesisInputs& inputs, const ChapterSettings& settings,
                                 const std::string& workspace);

/// The solver of this name for a formulation, with the settings' options.
std::shared_ptr<const Solver> make_solver(const std::string& name, Formulation formulation,
                                          const ChapterSettings& settings);

/// Runs everything, with progress on a terminal. Returns the table (one row for each workspace, formulation and
/// optimizer) and the history of all runs. Throws std::runtime_error when a workspace of the settings is not among the
/// inputs.
std::pair<Table, Table> run_synthesis_study(const SynthesisInputs& inputs, const ChapterSettings& settings);

/// Runs Dynamic-Q with the area formulation from `runs` (at least 1) starts within 1e-6 of d^0: neither f nor g
/// is smooth, and where a run ends depends on the last digits. Returns one row for each run, and for each workspace.
std::pair<Table, Table> run_restarts(const SynthesisInputs& inputs, const ChapterSettings& settings, long runs);

/// Runs everything (fewer outline points and restarts where the session is to be quick), writes the session's table and
/// its parts "history", "restarts" and "restarts_summary", and prints one line for each run.
void write_synthesis_study(Session& session, const SynthesisInputs& inputs, ChapterSettings settings);

}  // namespace reprise::experiments
