#include "reprise/study/mapped_workspace.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reprise/workspace/region_vertices.hpp"

namespace reprise {

namespace {

/// Points on a boundary, to a length of the whole.
constexpr double points_per_size = 400.0;

std::string point_text(const Eigen::Vector2d& point) {
  return fmt::format("{:<12} {:<12}", short_number(point.x()), short_number(point.y()));
}

}  // namespace

MappedWorkspace exact_workspace(const Limits& limits, const Region& region) {
  MappedWorkspace workspace;
  workspace.method = "exact";
  workspace.area = region.area();
  Eigen::AlignedBox2d box;
  for (const RegionComponent& component : region.components()) {
    for (const BoundaryEdge& edge : component.outer.edges) {
      for (const double fraction : {0.0, 0.25, 0.5, 0.75}) box.extend(edge.at(fraction));
    }
  }
  for (const RegionComponent& component : region.components()) {
    const double spacing = box.sizes().maxCoeff() / points_per_size;
    const Region alone({component});
    MappedComponent mapped;
    mapped.area = alone.area();
    mapped.boundary = component.outer.sample(spacing);
    std::vector<const BoundaryLoop*> loops{&component.outer};
    for (const BoundaryLoop& hole : component.holes) {
      mapped.holes.push_back(hole.sample(spacing));
      loops.push_back(&hole);
    }
    for (const BoundaryLoop* loop : loops) {
      for (const BoundaryEdge& edge : loop->edges) {
        mapped.edges.push_back(edge);
        mapped.edge_limits.push_back(limits.label(edge.limit));
      }
    }
    for (const RegionVertex& vertex : vertices(alone, limits)) {
      std::set<std::string> active;
      for (const Eigen::Index limit : vertex.limits) active.insert(limits.label(limit));
      mapped.bifurcation_points.push_back({vertex.position, {active.begin(), active.end()}});
    }
    workspace.components.push_back(std::move(mapped));
  }
  std::stable_sort(workspace.components.begin(), workspace.components.end(),
                   [](const MappedComponent& p, const MappedComponent& q) { return p.area > q.area; });
  return workspace;
}

Json to_json(const MappedWorkspace& workspace) {
  Json document{{"method", workspace.method}};
  if (workspace.method == "chord") {
    document["solver"] = workspace.solver;
    document["chord"] = workspace.chord;
    document["evaluations"] = workspace.evaluations;
  }
  const auto known = [&](double area) { return workspace.complete() ? Json(area) : Json(); };
  document["complete"] = workspace.complete();
  document["not_traced"] = workspace.not_traced;
  document["advice"] = workspace.complete() ? Json() : Json(workspace.advice);
  document["area"] = known(workspace.area);
  Json components = Json::array();
  for (const MappedComponent& component : workspace.components) {
    Json holes = Json::array();
    for (const Outline& hole : component.holes) holes.push_back(to_json(hole));
    Json points = Json::array();
    Json limits = Json::array();
    for (const MappedVertex& vertex : component.bifurcation_points) {
      points.push_back(to_json(vertex.position));
      limits.push_back(vertex.limits);
    }
    Json entry{{"area", known(component.area)},
               {"boundary", to_json(component.boundary)},
               {"holes", holes},
               {"bifurcation_points", points},
               {"bifurcation_limits", limits}};
    if (workspace.method == "exact") {
      Json edges = Json::array();
      for (std::size_t k = 0; k < component.edges.size(); ++k) {
        const BoundaryEdge& edge = component.edges[k];
        Json one{{"from", to_json(edge.start)}, {"to", to_json(edge.end)}, {"limit", component.edge_limits[k]}};
        if (edge.is_arc()) {
          one["centre"] = to_json(edge.centre);
          one["radius"] = edge.radius;
          one["sweep_deg"] = edge.sweep / degree;
        }
        edges.push_back(one);
      }
      entry["edges"] = edges;
    }
    components.push_back(entry);
  }
  document["components"] = components;
  return document;
}

std::string to_text(const MappedWorkspace& workspace, const std::string& unit) {
  std::size_t holes = 0;
  for (const MappedComponent& component : workspace.components) holes += component.holes.size();
  std::string text = workspace.method == "exact"
                         ? "exact region\n"
                         : fmt::format("chord method, chord {}, solver {}, {} evaluations of the limits\n",
                                       with_unit(workspace.chord, unit), workspace.solver, workspace.evaluations);
  if (workspace.components.empty() && workspace.complete()) return text + "the workspace is empty\n";
  if (workspace.complete()) {
    text += fmt::format("area {}, components {}, holes {}\n", with_unit(workspace.area, unit, 2),
                        workspace.components.size(), holes);
  } else {
    text += fmt::format("NOT COMPLETE: {} of {} boundaries were not traced, so that the area is not known\n",
                        workspace.not_traced.size(), workspace.not_traced.size() + workspace.components.size() + holes);
  }
  for (std::size_t k = 0; k < workspace.components.size(); ++k) {
    const MappedComponent& component = workspace.components[k];
    text += fmt::format("\ncomponent {}: {}holes {}, bifurcation points {}\n", k + 1,
                        workspace.complete() ? fmt::format("area {}, ", with_unit(component.area, unit, 2)) : "",
                        component.holes.size(), component.bifurcation_points.size());
    for (const MappedVertex& vertex : component.bifurcation_points) {
      text += fmt::format("  {} {}\n", point_text(vertex.position), fmt::join(vertex.limits, " | "));
    }
  }
  for (const std::string& reason : workspace.not_traced) text += fmt::format("\nnot traced: {}\n", reason);
  if (!workspace.complete()) text += "\n" + workspace.advice + "\n";
  return text;
}

std::vector<std::pair<std::string, Table>> to_tables(const std::string& title, const MappedWorkspace& workspace,
                                                     const std::string& unit) {
  Table boundary(title + ", boundary", {{"component", "-", "number of the component"},
                                        {"loop", "-", "0 for the outer boundary, from 1 on for holes"},
                                        {"x", unit, "x coordinate of the working point"},
                                        {"y", unit, "y coordinate of the working point"}});
  Table points(title + ", bifurcation points", {{"component", "-", "number of the component"},
                                                {"x", unit, "x coordinate of the working point"},
                                                {"y", unit, "y coordinate of the working point"},
                                                {"limits", "-", "the limits that are active there"}});
  for (std::size_t k = 0; k < workspace.components.size(); ++k) {
    const MappedComponent& component = workspace.components[k];
    std::vector<Outline> loops = component.holes;
    loops.insert(loops.begin(), component.boundary);
    for (std::size_t loop = 0; loop < loops.size(); ++loop) {
      for (const Eigen::Vector2d& point : loops[loop]) boundary.add_row({k + 1, loop, point.x(), point.y()});
    }
    for (const MappedVertex& vertex : component.bifurcation_points) {
      points.add_row(
          {k + 1, vertex.position.x(), vertex.position.y(), fmt::format("{}", fmt::join(vertex.limits, " | "))});
    }
  }
  return {{"boundary", boundary}, {"bifurcation_points", points}};
}

std::vector<DrawnComponent> drawn(const MappedWorkspace& workspace) {
  std::vector<DrawnComponent> components;
  for (const MappedComponent& component : workspace.components) {
    components.push_back({component.boundary, component.holes});
  }
  return components;
}

}  // namespace reprise
