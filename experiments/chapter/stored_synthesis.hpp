#pragma once

// What the figures of a synthesis need of its stored table: which run they picture, and that run's design.

#include <cstddef>
#include <string>
#include <vector>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "reprise/io/table.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise::experiments {

/// The design [x_C, y_C, x_D, x_E, r] in the columns of these names.
CollinearDesign read_design(const Table& table, std::size_t row);

/// Which of a table's runs is meant; by default the thesis's own.
struct SynthesisRun {
  std::string optimizer = "dynamic_q";
  std::string formulation = "area";

  /// Adds --optimizer and --formulation.
  void declare(CommandLine& options);

  /// The rows of one prescribed workspace in this run, of a table with the columns workspace, optimizer and
  /// formulation. Throws std::runtime_error when there is none.
  Table select(const Table& table, const std::string& workspace) const;

  /// The design of the last of these rows.
  CollinearDesign design(const Table& table, const std::string& workspace) const;
};

/// A design of a synthesis table, and where it comes from.
struct StudiedDesign {
  std::string workspace;
  std::string source;       ///< published, published_corrected (misprints read as in misprints.csv), or the optimizer
  std::string formulation;  ///< empty for published designs
  CollinearDesign design;
};

/// The printed numbers that cannot be right, and how they are read: data/published/misprints.csv.
Table read_misprints();

/// The designs of a table: as printed, with the misprints corrected where there are any, and those its program found.
std::vector<StudiedDesign> read_studied_designs(Session& session, const ChapterSynthesis& synthesis);

}  // namespace reprise::experiments
