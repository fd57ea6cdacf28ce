#pragma once

// How much of a prescribed workspace W_p a computed workspace W_c misses (thesis chapter 5, sections 5.6.1 and, not
// available, 4.5.1 and 4.7; reconstructed).
//
// With both outlines in polar form about O', r_p(beta) and r_c(beta),
//     delta W_p = 1/2 integral of max(0, r_p^2 - r_c^2) dbeta      the part of W_p outside of W_c
//     delta W_c = 1/2 integral of max(0, r_c^2 - r_p^2) dbeta      the part of W_c outside of W_p
//     rho       = min (r_c - r_p)                                  the smallest clearance
// taken over sectors between neighbouring directions: the integrand varies linearly within a sector, and a change of
// its sign splits the sector.

#include <span>

#include "reprise/geometry/polygon.hpp"
#include "reprise/geometry/prescribed_workspace.hpp"

namespace reprise {

/// How far a computed workspace is from a prescribed one.
struct AreaMeasure {
  double prescribed_outside = 0.0;  ///< delta W_p
  double computed_outside = 0.0;    ///< delta W_c
  double clearance = 0.0;           ///< rho, negative where W_p sticks out
};

/// Measures over the sectors between the given directions (at least 2, increasing within one turn; the last and the
/// first are neighbours too). Without a computed boundary (null) r_c = 0 in every direction: O' is then outside of W_c.
/// Throws std::invalid_argument when there are fewer than 2 directions.
AreaMeasure measure_area(const PrescribedWorkspace& prescribed, const PolarBoundary* computed,
                         std::span<const double> directions);

}  // namespace reprise
