#pragma once

// Regions of the plane bounded by circular arcs and straight segments, with holes and several components.

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

namespace reprise {

/// A piece of a circle or of a straight line. The region lies on its left when it is run from start to end. A full
/// circle ends where it starts.
struct BoundaryEdge {
  Eigen::Vector2d start;  ///< first point
  Eigen::Vector2d end;    ///< last point
  /// Of an arc; a segment has radius 0.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;       ///< a length; 0 for a segment
  double start_angle = 0.0;  ///< polar angle of `start` about the centre
  double sweep = 0.0;        ///< signed angle from start to end, positive counter-clockwise, at most a full turn
  Eigen::Index limit = 0;  ///< a number that names the curve the edge lies on: of a workspace, the limit that is active

  bool is_arc() const { return radius > 0.0; }  ///< a piece of a circle, not of a straight line
  double length() const;                        ///< of the arc or of the segment
  /// The point at a fraction in [0, 1] of the length.
  Eigen::Vector2d at(double fraction) const;
  /// Distance from a point to the nearest point of the edge.
  double distance(const Eigen::Vector2d& point) const;
};

/// A closed curve of edges, each of which starts where the one before ends.
struct BoundaryLoop {
  std::vector<BoundaryEdge> edges;  ///< in the order of the walk
  /// What signed_area() of the edges lacks because their coordinates, far from the origin, are rounded.
  double lost_area = 0.0;

  /// Area enclosed, positive for a counter-clockwise loop (an outer boundary), negative for a clockwise one (a hole).
  double signed_area() const;
  /// Whether the loop runs around a point. On the loop it may be either.
  bool encloses(const Eigen::Vector2d& point) const;
  /// Points on the loop in order, the last to be joined to the first: all vertices, and between them points that divide
  /// each edge into equal parts no longer than the spacing. Throws std::invalid_argument when the spacing is not
  /// positive and finite.
  std::vector<Eigen::Vector2d> sample(double spacing) const;
};

/// A connected part of a region.
struct RegionComponent {
  BoundaryLoop outer;               ///< counter-clockwise
  std::vector<BoundaryLoop> holes;  ///< clockwise
};

/// A closed set of the plane with a boundary of arcs and segments; without components it is empty.
class Region {
 public:
  Region() = default;
  /// The components must not overlap.
  explicit Region(std::vector<RegionComponent> components) : components_(std::move(components)) {}

  const std::vector<RegionComponent>& components() const {
    return components_;
  }                                                   ///< in the order in which they were given
  bool empty() const { return components_.empty(); }  ///< true without components

  double area() const;  ///< of all components, holes taken out; a length squared
  /// Length of the whole boundary, holes included.
  double perimeter() const;
  /// Whether a point is inside. On the boundary it may be either.
  bool contains(const Eigen::Vector2d& point) const;
  /// Distance from a point, inside or outside, to the nearest boundary point; infinity for an empty region.
  double distance_to_boundary(const Eigen::Vector2d& point) const;
  /// Distance from a centre at which a ray in the direction beta (radians) first meets the boundary, or nothing
  /// when it does not. From inside a region that is star-shaped about the centre, this is its polar radius r(beta).
  std::optional<double> first_exit(const Eigen::Vector2d& centre, double beta) const;

 private:
  std::vector<RegionComponent> components_;
};

}  // namespace reprise
