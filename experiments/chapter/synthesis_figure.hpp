#pragma once

// The whole programs of the figures of sections 5.6 to 5.8: maps of the starting design and of the designs that a
// synthesis table found, and the convergence histories of its runs.

#include <string>
#include <vector>

#include "frame/experiment.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise::experiments {

/// One map: the starting design with all prescribed workspaces, or the design found for one.
struct DesignPanel {
  std::string workspace;      ///< name of the prescribed workspace; empty for the starting design
  Interval orientations_deg;  ///< degrees; a single orientation, or a range for the dextrous workspace
};

struct DesignFigure {
  ManifestEntry program;
  std::string kind;  ///< of the synthesis: "SO", "MO" or "D"; its table holds the designs
  std::vector<DesignPanel> panels;
};

/// Writes and draws the maps (workspace_map.hpp), and for the starting design the part "prescribed", which says where
/// the prescribed workspaces come from.
int run_design_figure(int argc, const char* const* argv, const DesignFigure& figure);

/// Writes and draws the histories (convergence_figure.hpp) that the table of a kind of synthesis has stored.
int run_convergence_figure(int argc, const char* const* argv, const ManifestEntry& program, const std::string& kind);

}  // namespace reprise::experiments
