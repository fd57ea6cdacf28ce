#pragma once

// The distance from a point to a prescribed workspace, which is negative inside.

#include <Eigen/Core>
#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"

namespace reprise {

/// A distance with its derivatives along the point. They exist where one point of the outline is the nearest; where
/// several are, those of one of them.
struct DistanceDerivatives {
  double value;              ///< the distance, negative inside
  Eigen::Vector2d gradient;  ///< the direction that leads away from the workspace, of length 1
  Eigen::Matrix2d hessian;   ///< second derivatives along q, per length
};

/// The signed distance of points from a prescribed workspace.
class RegionDistance {
 public:
  /// Keeps a copy of what it needs of the outline.
  explicit RegionDistance(const PrescribedWorkspace& prescribed);

  /// Distance from q to the outline, positive outside of the region and negative inside. The nearest point is looked
  /// for between samples of the outline, around each that is nearer than its neighbours, and then to rounding.
  double value(const Eigen::Vector2d& q) const;
  DistanceDerivatives derivatives(const Eigen::Vector2d& q) const;  ///< the distance with its derivatives along q

 private:
  struct Nearest {
    double direction;  ///< beta
    double distance;
    bool corner;
  };
  Nearest nearest(const Eigen::Vector2d& q) const;
  bool inside(const Eigen::Vector2d& q) const;

  PrescribedWorkspace prescribed_;
  std::vector<double> directions_;
  std::vector<Eigen::Vector2d> positions_;
  std::vector<bool> corner_;
  double largest_step_ = 0.0;  ///< between neighbouring positions
};

}  // namespace reprise
