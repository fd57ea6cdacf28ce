#pragma once

// The program's pictures.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reprise/geometry/region.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise {

/// A closed polygon: the last point is joined to the first.
using Outline = std::vector<Eigen::Vector2d>;

/// A manipulator in some poses: base joints, legs and platform, each pose in a colour of its own.
Figure draw_poses(const Manipulator& manipulator, const std::vector<Pose>& poses, const std::string& unit = "length");

/// A part of a workspace, as drawn.
struct DrawnComponent {
  Outline boundary;            ///< the outer boundary
  std::vector<Outline> holes;  ///< the boundaries of its holes
};

/// A workspace with its bifurcation points and the base joints of the manipulator.
Figure draw_workspace(const std::string& title, const ManipulatorInput& input,
                      const std::vector<DrawnComponent>& components, const Outline& bifurcation_points);

/// The orientations that can be attained, as sectors of a circle.
Figure draw_orientations(const std::string& title, const std::vector<Interval>& intervals);

/// A value at a point.
struct MapPoint {
  Eigen::Vector2d position;  ///< a point of the plane
  double value;              ///< NaN outside of the workspace
};

/// Values over a workspace, in scan lines of equal x (NaN outside of it), with its outline and two marked points.
Figure draw_conditioning(const std::string& title, const ManipulatorInput& input,
                         const std::vector<std::vector<MapPoint>>& scan_lines,
                         const std::vector<DrawnComponent>& components, const MapPoint& least,
                         const MapPoint& greatest);

/// The best feasible value an optimizer had after so many evaluations, where it improved.
struct ProgressCurve {
  std::string optimizer;  ///< its name
  Outline points;         ///< evaluations, value
};

/// The curves over the number of evaluations, one colour for each optimizer.
Figure draw_progress(const std::vector<ProgressCurve>& curves);

}  // namespace reprise
