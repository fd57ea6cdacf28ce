#pragma once

// Pictures of a manipulator in the plane, as the thesis has them: its workspace, the prescribed workspaces and labelled
// contours of the inverse condition number, side by side in panels.

#include <string>
#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/options.hpp"
#include "reprise/io/table.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/kinematics/orientation_range.hpp"

namespace reprise {

/// What one picture of a map shows.
struct MapPanel {
  std::string title;                            ///< above the picture
  Manipulator manipulator;                      ///< whose workspace it is
  OrientationRange orientations;                ///< phi, radians: a single one, or a range (see compute_map)
  std::vector<PrescribedWorkspace> prescribed;  ///< at least one; the workspace is traced from the first one's centre
  Conditioning conditioning{.normalisation = Normalisation::printed};  ///< of kappa^-1
};

/// How finely maps are computed.
struct MapOptions {
  double chord = 0.02;          ///< chord length d of the traced boundary
  int grid = 121;               ///< kappa^-1 is computed at grid x grid points of each panel
  int orientations = 21;        ///< and at so many orientations of a range, its ends among them
  std::string unit = "length";  ///< of x and y, for the axes

  /// Adds --chord.
  void declare(CommandLine& options);
};

/// Computes what the panels show, kappa^-1 in the thesis's normalisation (5.13) unless another is given, as a table
/// with the columns panel, series, x, y and value: the closed outlines of the workspace and of each prescribed
/// workspace by its name, and a grid of kappa^-1, which covers the outlines with a margin, in scan lines of equal x. At
/// a single orientation the first and the last are the series "workspace" and "kappa_inverse"; over a range they are
/// "dextrous workspace" and "smallest kappa_inverse", at each point the smallest over the range. Panels with the same
/// prescribed workspaces cover the same part of the plane. Throws std::runtime_error when a workspace cannot be traced
/// from the centre.
Table compute_map(const std::string& title, const std::vector<MapPanel>& panels, const MapOptions& options);

/// Draws such a table.
Figure draw_map(const Table& table);

}  // namespace reprise
