#pragma once

// The bifurcation points of an exact workspace.

#include <Eigen/Core>
#include <vector>

#include "reprise/geometry/region.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

/// Where two edges meet, that is, the boundary goes over from one circle or line to another.
struct RegionVertex {
  Eigen::Vector2d position;          ///< a point of the plane
  std::vector<Eigen::Index> limits;  ///< all limits that are active there, in increasing order
};

/// The vertices of a region h <= 0, loop by loop, each once, even where loops touch. A limit is active at a vertex when
/// |h_j| is at most 1e-9 of the size of limits.box() plus 1e-13 of its coordinates. A full circle has no vertex.
std::vector<RegionVertex> vertices(const Region& region, const Limits& limits);

}  // namespace reprise
