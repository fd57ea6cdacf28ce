#pragma once

// A workspace with all that is reported of it, whether it was found exactly or by the chord method.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reprise/geometry/region.hpp"
#include "reprise/study/documents.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

/// A bifurcation point.
struct MappedVertex {
  Eigen::Vector2d position;         ///< a point of the plane
  std::vector<std::string> limits;  ///< that are active there
};

/// A connected part of a workspace.
struct MappedComponent {
  double area = 0.0;           ///< holes taken out
  Outline boundary;            ///< counter-clockwise, from point to point; of an exact region, points on its arcs
  std::vector<Outline> holes;  ///< clockwise
  std::vector<MappedVertex> bifurcation_points;  ///< on all of its boundaries
  std::vector<BoundaryEdge> edges;               ///< of an exact region: outer boundary, then holes
  std::vector<std::string> edge_limits;          ///< what is active along each of them
};

/// A workspace, whichever method found it.
struct MappedWorkspace {
  std::string method;                       ///< "exact" or "chord"
  std::string solver;                       ///< of the chord method
  double chord = 0.0;                       ///< of the chord method
  double area = 0.0;                        ///< a length squared
  std::vector<MappedComponent> components;  ///< by area, the largest first
  std::size_t evaluations = 0;              ///< of all limits at a point, by the chord method
  std::vector<std::string> not_traced;      ///< why boundaries are missing, one sentence for each
  std::string advice;                       ///< where some are, what to change, in one sentence

  bool complete() const { return not_traced.empty(); }  ///< areas mean something only where no boundary is missing
};

/// A workspace whose exact region is known.
MappedWorkspace exact_workspace(const Limits& limits, const Region& region);

/// The chord method traces boundaries of at most so many chords, all of a workspace together.
constexpr double most_chords = 100'000.0;

/// The chord method from the boundaries of the region, with an optimizer by its name, or "bracketing". Throws
/// std::runtime_error, before anything is traced, when these are longer than most_chords chords.
MappedWorkspace trace_workspace(const Limits& limits, const Region& region, double chord, const std::string& solver);

/// The document that apps/reprise/json.md describes.
Json to_json(const MappedWorkspace& workspace);
/// Lengths in the unit, where there is one.
std::string to_text(const MappedWorkspace& workspace, const std::string& unit);
/// boundary and bifurcation_points.
std::vector<std::pair<std::string, Table>> to_tables(const std::string& title, const MappedWorkspace& workspace,
                                                     const std::string& unit);
/// Its components, as pictures take them.
std::vector<DrawnComponent> drawn(const MappedWorkspace& workspace);

}  // namespace reprise
