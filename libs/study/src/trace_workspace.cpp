// The chord method's part of mapped_workspace.hpp.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "reprise/geometry/polygon.hpp"
#include "reprise/study/mapped_workspace.hpp"
#include "reprise/study/solvers.hpp"
#include "reprise/workspace/complete_trace.hpp"

namespace reprise {

namespace {

MappedComponent map_trace(const TracedComponent& traced, const Limits& limits) {
  MappedComponent component;
  const auto add = [&](const TracedBoundary& boundary) {
    for (const BoundaryPoint& point : boundary.points) {
      if (!point.is_bifurcation()) continue;
      component.bifurcation_points.push_back(
          {point.position, {limits.label(point.active[0]), limits.label(point.active[1])}});
    }
    Outline positions = boundary.positions();
    component.area += signed_area(positions);
    return positions;
  };
  component.boundary = add(traced.outer);
  for (const TracedBoundary& hole : traced.holes) component.holes.push_back(add(hole));
  return component;
}

/// With two digits, and not below the value.
std::string chord_above(double value) { return fmt::format("{:.2g}", 1.06 * value); }

/// What to change where boundaries were not traced: to chords of which each of them has some tens, if that is not too
/// many altogether.
std::string advise(const Region& region, const TracedWorkspace& traced, double chord) {
  std::vector<double> lengths;
  for (const RegionComponent& component : region.components()) {
    lengths.push_back(Region({{component.outer, {}}}).perimeter());
    for (const BoundaryLoop& hole : component.holes) lengths.push_back(Region({{hole, {}}}).perimeter());
  }
  double shorter = 0.25 * chord;
  for (const FailedBoundary& failure : traced.failures) shorter = std::min(shorter, 0.03 * lengths.at(*failure.loop));
  if (region.perimeter() > most_chords * shorter) return "Take the exact region.";
  return fmt::format("Take a shorter chord, {:.1g} for example, or the exact region.", shorter);
}

}  // namespace

MappedWorkspace trace_workspace(const Limits& limits, const Region& region, double chord, const std::string& solver) {
  const double length = region.perimeter();
  if (!(length <= most_chords * chord)) {
    throw std::runtime_error(
        fmt::format("the chord is {}, but the boundary is {} long, and no more than {} chords are traced; take a chord "
                    "of {} or more, or the exact region",
                    chord, short_number(length), most_chords, chord_above(length / most_chords)));
  }
  std::vector<NamedSolver> named;
  std::unique_ptr<PointSolver> point_solver = std::make_unique<BracketingPointSolver>();
  if (solver != "bracketing") {
    named = select_solvers({solver}, {});
    point_solver = std::make_unique<OptimizerPointSolver>(*named.front().solver);
  }
  const TracedWorkspace traced = trace_all_boundaries(
      limits, region, {.chord = chord, .max_points = 10 * static_cast<std::size_t>(most_chords)}, *point_solver);
  MappedWorkspace workspace;
  workspace.method = "chord";
  workspace.solver = solver;
  workspace.chord = chord;
  workspace.area = traced.area();
  workspace.evaluations = traced.evaluations;
  for (const TracedComponent& component : traced.components) {
    workspace.components.push_back(map_trace(component, limits));
  }
  for (const FailedBoundary& failure : traced.failures) workspace.not_traced.push_back(failure.reason);
  if (!traced.complete()) workspace.advice = advise(region, traced, chord);
  return workspace;
}

}  // namespace reprise
