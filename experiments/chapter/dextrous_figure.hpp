#pragma once

// Pictures of dextrous workspaces, as the thesis's Figures 5.4 to 5.6: one manipulator, nested ranges of orientations,
// bifurcation points marked by their type.

#include <string>
#include <vector>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "reprise/geometry/region.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/table.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/workspace/dextrous_boundary.hpp"

namespace reprise::experiments {

/// Where step 1 of Algorithm 5.1 begins for a manipulator of the thesis's family: above base joint D, so that of the
/// two mirror images of the workspace the upper one is found, with the platform not turned.
Pose assembly_start(const CollinearManipulator& manipulator);

/// The exact area of the component of a region that holds a point; zero when none does.
double area_around(const Region& region, const Eigen::Vector2d& point);

/// How many boundary points are of a kind.
long count_kind(const std::vector<DextrousBoundaryPoint>& points, DextrousBoundaryPoint::Kind kind);

/// Maps the dextrous workspaces for orientations of -half_width to half_width degrees by Algorithm 5.1, with (5.26) in
/// closed form and boundary points by bracketing. The first table has the columns half_width_deg, x, y, kind, and the
/// limits and orientations that are active before and after each boundary point; the second, `summary`, one row for
/// each half width: n_b, bifurcation points of both types, area by chords and exact. Throws std::runtime_error when a
/// workspace cannot be mapped.
struct DextrousTables {
  Table points;
  Table summary;
};
DextrousTables map_dextrous_workspaces(const std::string& title, const CollinearManipulator& collinear,
                                       const std::vector<double>& half_widths_deg, double chord);

/// Draws the first table.
Figure draw_dextrous_workspaces(const Table& points);

/// The whole program of Figure 5.4, 5.5 or 5.6.
int run_dextrous_figure(int argc, const char* const* argv, const ManifestEntry& program, const std::string& manipulator,
                        std::vector<double> half_widths_deg);

}  // namespace reprise::experiments
