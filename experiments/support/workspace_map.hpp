#pragma once

// Pictures of a manipulator in the plane, as the thesis has them: its workspace, the prescribed workspaces and labelled
// contours of the inverse condition number, side by side in panels.

#include <string>
#include <vector>

#include "reprise/kinematics/manipulator.hpp"
#include "reprise/synthesis/prescribed_workspace.hpp"
#include "support/figure.hpp"
#include "support/options.hpp"
#include "support/table.hpp"

namespace reprise::experiments {

struct MapPanel {
  std::string title;
  Manipulator manipulator;
  double orientation;                           ///< phi, radians
  std::vector<PrescribedWorkspace> prescribed;  ///< at least one; the workspace is traced from the first one's centre
};

struct MapOptions {
  double chord = 0.02;  ///< chord length d of the traced boundary
  int grid = 121;       ///< kappa^-1 is computed at grid x grid points of each panel

  /// Adds --chord.
  void declare(Options& options);
};

/// Computes what the panels show, kappa^-1 in the thesis's normalisation (5.13), as a table with the columns panel,
/// series, x, y and value: the closed outlines "workspace" and of each prescribed workspace by its name, and the grid
/// "kappa_inverse", which covers the outlines with a margin, in scan lines of equal x. Throws std::runtime_error when a
/// workspace cannot be traced from the centre.
Table compute_map(const std::string& title, const std::vector<MapPanel>& panels, const MapOptions& options);

/// Draws such a table.
Figure draw_map(const Table& table);

}  // namespace reprise::experiments
