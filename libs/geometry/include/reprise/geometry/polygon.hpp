#pragma once

// Area, distances and polar form of closed polygons, given by their vertices in order; the last is joined to the first.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace reprise {

/// Half the sum of b^i x b^(i+1): positive when the vertices run counter-clockwise, negative when clockwise (the
/// boundary of a hole, as traced). Zero for fewer than three vertices.
double signed_area(std::span<const Eigen::Vector2d> vertices);

/// Distance from a point to the nearest point of the segment between two points.
double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// Whether a point is inside, in the sense of a winding number that is not zero. On the boundary it may be either.
bool contains(std::span<const Eigen::Vector2d> vertices, const Eigen::Vector2d& point);

/// A polygon in polar coordinates (beta, r) about a centre O', thesis Section 5.6.1.
class PolarBoundary {
 public:
  /// The order of the vertices may be either way around. Throws std::invalid_argument when there are fewer than three
  /// vertices, or a coordinate is not finite.
  PolarBoundary(std::span<const Eigen::Vector2d> vertices, const Eigen::Vector2d& centre);

  /// r(beta): the distance from the centre at which the direction beta (radians, any) first meets an edge; it need not
  /// be the only one. Zero for every beta when the centre is outside. Continuous, except for polygons that are not
  /// star-shaped about the centre.
  double radius(double beta) const;

  bool centre_inside() const { return centre_inside_; }  ///< whether the polygon runs around the centre

  /// The angles of all vertices, in [-pi, pi], in increasing order. Between two of them r(beta) is on one edge, unless
  /// the polygon is not star-shaped about the centre.
  const std::vector<double>& angles() const { return angles_; }

 private:
  struct Edge {
    Eigen::Vector2d from;  ///< relative to the centre; the edge is seen counter-clockwise from `from` to `to`
    Eigen::Vector2d to;
  };

  double radius_in_sector(std::size_t sector, const Eigen::Vector2d& direction) const;

  bool centre_inside_;
  std::vector<double> angles_;
  /// Sector k lies between angles_[k] and angles_[k + 1] (the last goes on to angles_[0]); the edges seen across it are
  /// sector_edges_[sector_begin_[k]] to before sector_edges_[sector_begin_[k + 1]].
  std::vector<Edge> sector_edges_;
  std::vector<std::size_t> sector_begin_;
};

}  // namespace reprise
