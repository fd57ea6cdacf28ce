#pragma once

// Prescribed workspaces: the region W_p that a manipulator must reach, given as an outline that is star-shaped about
// its centre O', in polar form (beta, r_p) (thesis chapter 5, section 5.6.1).

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace reprise {

/// |x / a|^exponent + |y / b|^exponent <= 1 with semi_axes (a, b); a, b > 0, exponent > 0.
struct Superellipse {
  Eigen::Vector2d semi_axes;  ///< along x and y, lengths
  double exponent;            ///< of the powers in its equation
};

/// A superellipse with exponent 2.
struct Ellipse {
  Eigen::Vector2d semi_axes;  ///< along x and y, lengths
};

/// Four quarter-ellipses that share semi-axes where they meet; each length > 0.
struct QuarterEllipses {
  double right;  ///< semi-axis towards +x, a length
  double up;     ///< semi-axis towards +y, a length
  double left;   ///< semi-axis towards -x, a length
  double down;   ///< semi-axis towards -y, a length
};

/// A circle about O'.
struct Circle {
  double radius;  ///< a length
};

/// Centred on O'; width along x, height along y.
struct Rectangle {
  double width;   ///< along x, a length
  double height;  ///< along y, a length
};

/// A simple polygon that is star-shaped about the origin, which lies inside; at least three vertices, in either sense
/// of rotation.
struct Polygon {
  std::vector<Eigen::Vector2d> vertices;  ///< relative to O', lengths
};

/// Radii > 0 at polar angles (radians) that increase within one turn; at least three. Between neighbours (the last and
/// the first are neighbours too) the radius varies linearly with the angle.
struct PolarTable {
  std::vector<double> angles;  ///< radians
  std::vector<double> radii;   ///< lengths
};

/// A shape about its own origin, O'.
using Shape = std::variant<Superellipse, Ellipse, QuarterEllipses, Circle, Rectangle, Polygon, PolarTable>;

/// Where a shape goes: scaled about its own origin, rotated, then moved to the centre.
struct Placement {
  Eigen::Vector2d centre{0.0, 0.0};  ///< O', world frame
  double scale = 1.0;                ///< > 0
  double rotation = 0.0;             ///< radians, counter-clockwise
};

/// A point of an outline with its derivatives along the world direction beta.
struct OutlinePoint {
  Eigen::Vector2d position;  ///< u
  Eigen::Vector2d slope;     ///< du/dbeta, per radian; along the outline, counter-clockwise
  Eigen::Vector2d bend;      ///< d2u/dbeta2
};

/// A shape in its place. A value; once built it is valid.
class PrescribedWorkspace {
 public:
  /// Throws std::invalid_argument, naming the workspace, the quantity, its value and what is allowed, when a number is
  /// not finite or not in its range, when a polygon crosses itself or does not see its whole outline from the origin,
  /// or when the angles of a table do not increase within one turn.
  PrescribedWorkspace(std::string name, Shape shape, Placement placement = {});

  const std::string& name() const { return name_; }                    ///< as messages and tables call it
  const Eigen::Vector2d& centre() const { return placement_.centre; }  ///< O', in the world frame
  const Shape& shape() const { return shape_; }                        ///< about O', before it is placed
  const Placement& placement() const { return placement_; }            ///< where the shape is put

  /// r_p(beta): distance from O' to the outline in the world direction beta (radians, any real number). Positive.
  double radius(double beta) const;

  /// The outline's point in the world direction beta.
  Eigen::Vector2d point(double beta) const;

  /// The same with its derivatives; where they jump, at corners and where quarter-ellipses meet, those of one side. On
  /// the axes of a superellipse the slope is not finite for exponents below 1, the bend not for those below 2.
  OutlinePoint outline(double beta) const;

  /// World angles, increasing in [0, 2 pi), of the outline's corners; empty for a smooth outline.
  const std::vector<double>& corners() const { return corners_; }

  /// World angles, increasing in [0, 2 pi), of `count` (at least 1) points of the outline, the first in direction 0,
  /// and of all corners: what a sample of the outline must hold. The points are spread evenly in
  ///     ds / L + sqrt(ds dtheta / (2 pi L))          (s along the outline, of length L in all; theta its direction)
  /// so that no two neighbours of a convex outline are farther apart than 2 L / count, and nowhere does it bulge more
  /// than pi L / count^2 from the chord between them. Equal steps of the angle would leave gaps where the outline runs
  /// nearly away from the centre, equal distances would cut off its sharp bends. Throws std::invalid_argument when
  /// count < 1.
  std::vector<double> angles(int count) const;

  /// The points in these directions. Throws as angles.
  std::vector<Eigen::Vector2d> points(int count) const;

 private:
  std::string name_;
  Shape shape_;
  Placement placement_;
  std::vector<double> corners_;
  /// Of a polygon, counter-clockwise, in the shape's own frame; starts at the vertex of the smallest polar angle in [0,
  /// 2 pi).
  std::vector<Eigen::Vector2d> vertices_;
  std::vector<double> vertex_angles_;
};

}  // namespace reprise
