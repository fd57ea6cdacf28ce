#pragma once

// What the figures of a synthesis need of its stored table: which run they picture, and that run's design.

#include <cstddef>
#include <string>

#include "reprise/kinematics/manipulator.hpp"
#include "support/experiment.hpp"
#include "support/table.hpp"

namespace reprise::experiments {

/// The design [x_C, y_C, x_D, x_E, r] in the columns of these names.
CollinearDesign read_design(const Table& table, std::size_t row);

/// Which of a table's runs is meant; by default the thesis's own.
struct SynthesisRun {
  std::string optimizer = "dynamic_q";
  std::string formulation = "area";

  /// Adds --optimizer and --formulation.
  void declare(Options& options);

  /// The rows of one prescribed workspace in this run, of a table with the columns workspace, optimizer and
  /// formulation. Throws std::runtime_error when there is none.
  Table select(const Table& table, const std::string& workspace) const;

  /// The design of the last of these rows.
  CollinearDesign design(const Table& table, const std::string& workspace) const;
};

}  // namespace reprise::experiments
