#pragma once

// Pictures of convergence histories, as the thesis has them: objective and constraint against iterations, one column of
// panels for each prescribed workspace.

#include <string>

#include "chapter/stored_synthesis.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

/// From the stored histories of a synthesis (columns workspace, optimizer, formulation, iteration, f, g), those of one
/// run, as a table with the columns panel, iteration, f and g. Throws std::runtime_error when there is none.
Table collect_histories(const std::string& title, const Table& histories, const SynthesisRun& run);

/// Draws such a table.
Figure draw_histories(const Table& table);

}  // namespace reprise::experiments
