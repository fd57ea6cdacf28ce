#pragma once

// Integrals over regions bounded by arcs and segments.
//
//     integral of f over the region = integral over x of the integral of f along the lines x = const within the region
//
// The boundary is cut at its vertices and where it runs along y; between two neighbouring such x every line meets the
// same edges. There x = m + h sin(pi t / 2) with t in [-1, 1], which takes away the square roots in which arcs end, and
// both integrals are done by Gauss-Legendre rules of ten nodes (Boost.Math).

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "reprise/geometry/region.hpp"

namespace reprise {

/// A point of a quadrature rule over a region.
struct QuadratureNode {
  Eigen::Vector2d position;  ///< a point of the plane
  double weight;             ///< an area; positive
};

/// Nodes on one line x = const, between two neighbouring boundary points on it, in the order of y.
using QuadratureLine = std::vector<QuadratureNode>;

/// Nodes inside a region such that sum weight * f(position) is the integral of f. `panels` is the number of pieces into
/// which each range of x, and each line, is divided; at least 1. For a smooth f the error falls very fast with it (of
/// the area of a workspace, which is typically right to 1e-7 with 2 panels and to 1e-9 with 8), for an f with kinks as
/// 1 / panels^2. Throws std::invalid_argument when panels < 1.
std::vector<QuadratureLine> region_quadrature(const Region& region, int panels = 1);

}  // namespace reprise
