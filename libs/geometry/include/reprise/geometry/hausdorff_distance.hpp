#pragma once

// How far a traced boundary is from the exact one: the Hausdorff distance between a set P of closed polygons and the
// boundary B of a region,
//     max( max over p in P of min over b in B |p - b|,   max over b in B of min over p in P |p - b| ).
// The first part is what the polygons have beside the boundary, the second what of the boundary they leave out; either
// alone may be small where the other is not.
//
// Both maxima are bracketed, not sampled. A curve is cut into pieces; the distance of a piece's points from the other
// set has an upper bound (its distance from one edge or segment of that set has a closed form or is convex; and the
// distance from a set is 1-Lipschitz) and a lower one (the distance of its middle). The piece with the largest upper
// bound is halved until that bound is reached. The work grows as n log n with the number of the polygons' vertices.

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "reprise/geometry/region.hpp"

namespace reprise {

/// The two directed distances, lengths.
struct HausdorffDistance {
  double polygons_to_region;  ///< the farthest that a point of the polygons is from the region's boundary
  double region_to_polygons;  ///< the farthest that a point of the region's boundary is from the polygons

  double value() const {
    return std::max(polygons_to_region, region_to_polygons);
  }  ///< the Hausdorff distance, the larger of the two
};

/// Polygons are closed, given by their vertices in order; those without vertices are left out. Each part found is
/// attained, and below the true maximum by at most the larger of `resolution` (a length) and 1/1000 of it. Where one of
/// the sets is empty, the part that asks for distances from it is infinite, and the other zero; both are zero where
/// both are. Throws std::invalid_argument when the resolution is not positive and finite, or a vertex is not finite.
HausdorffDistance hausdorff_distance(std::span<const std::vector<Eigen::Vector2d>> polygons, const Region& region,
                                     double resolution);

}  // namespace reprise
