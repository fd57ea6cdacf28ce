// Workspaces: exact regions, and boundaries by the chord method.

#include <optional>
#include <string>

#include "bindings.hpp"
#include "reprise/geometry/region.hpp"
#include "reprise/study/problem_file.hpp"
#include "reprise/workspace/complete_trace.hpp"
#include "reprise/workspace/exact_workspace.hpp"

namespace reprise::python {

namespace {

/// start, end, centre (x and y each), radius, start angle, sweep, limit.
constexpr py::ssize_t edge_columns = 10;

Array edges_of(const BoundaryLoop& loop) {
  Array array({static_cast<py::ssize_t>(loop.edges.size()), edge_columns});
  auto rows = array.mutable_unchecked<2>();
  for (std::size_t k = 0; k < loop.edges.size(); ++k) {
    const BoundaryEdge& e = loop.edges[k];
    const std::array<double, edge_columns> values{
        e.start.x(),  e.start.y(), e.end.x(),     e.end.y(), e.centre.x(),
        e.centre.y(), e.radius,    e.start_angle, e.sweep,   static_cast<double>(e.limit)};
    for (std::size_t j = 0; j < values.size(); ++j) {
      rows(static_cast<py::ssize_t>(k), static_cast<py::ssize_t>(j)) = values[j];
    }
  }
  return array;
}

py::tuple loop_state(const BoundaryLoop& loop) { return py::make_tuple(edges_of(loop), loop.lost_area); }

BoundaryLoop loop_of(const py::tuple& state) {
  const auto array = state[0].cast<Array>();
  const auto rows = array.unchecked<2>();
  BoundaryLoop loop;
  loop.lost_area = state[1].cast<double>();
  for (py::ssize_t k = 0; k < rows.shape(0); ++k) {
    loop.edges.push_back({{rows(k, 0), rows(k, 1)},
                          {rows(k, 2), rows(k, 3)},
                          {rows(k, 4), rows(k, 5)},
                          rows(k, 6),
                          rows(k, 7),
                          rows(k, 8),
                          static_cast<Eigen::Index>(rows(k, 9))});
  }
  return loop;
}

/// One part with its holes, each loop as an array of points.
py::list rings(const RegionComponent& component, double spacing) {
  py::list result;
  result.append(to_array(component.outer.sample(spacing)));
  for (const BoundaryLoop& hole : component.holes) result.append(to_array(hole.sample(spacing)));
  return result;
}

py::list boundary(const Region& region, double spacing) {
  py::list result;
  for (const RegionComponent& component : region.components()) result.append(rings(component, spacing));
  return result;
}

py::dict geojson(const Region& region, double spacing) {
  py::list polygons;
  for (const RegionComponent& component : region.components()) {
    py::list polygon;
    for (const py::handle ring : rings(component, spacing)) {
      py::list points = ring.attr("tolist")();
      if (!points.empty()) points.append(points[0]);
      polygon.append(points);
    }
    polygons.append(polygon);
  }
  py::dict result;
  result["type"] = "MultiPolygon";
  result["coordinates"] = polygons;
  return result;
}

py::object contains(const Region& region, const Array& x, const Array& y) {
  return py::vectorize([&region](double px, double py) { return region.contains({px, py}); })(x, y);
}

std::size_t hole_count(const Region& region) {
  std::size_t count = 0;
  for (const RegionComponent& component : region.components()) count += component.holes.size();
  return count;
}

py::dict trace(const ManipulatorInput& input, double lower, std::optional<double> upper, double chord) {
  using namespace py::literals;
  TraceOptions options;
  options.chord = chord;
  const TracedWorkspace traced = [&] {
    const py::gil_scoped_release released;
    const Manipulator& manipulator = input.manipulator;
    if (!upper) {
      return trace_all_boundaries(ConstantOrientationLimits(manipulator, lower),
                                  constant_orientation_workspace(manipulator, lower), options);
    }
    const Interval range{lower, *upper};
    return trace_all_boundaries(DextrousLimits(manipulator, range), dextrous_workspace(manipulator, range), options);
  }();
  const auto bifurcations = [](const TracedBoundary& walk, std::vector<Eigen::Vector2d>& points) {
    for (const BoundaryPoint& point : walk.points) {
      if (point.is_bifurcation()) points.push_back(point.position);
    }
  };
  py::list components;
  std::vector<Eigen::Vector2d> points;
  for (const TracedComponent& component : traced.components) {
    py::list loops;
    loops.append(to_array(component.outer.positions()));
    bifurcations(component.outer, points);
    for (const TracedBoundary& hole : component.holes) {
      loops.append(to_array(hole.positions()));
      bifurcations(hole, points);
    }
    components.append(loops);
  }
  py::list failures;
  for (const FailedBoundary& failure : traced.failures) failures.append(failure.reason);
  return py::dict("boundary"_a = components, "area"_a = traced.area(), "bifurcation_points"_a = to_array(points),
                  "complete"_a = traced.complete(), "failures"_a = failures, "evaluations"_a = traced.evaluations);
}

}  // namespace

void bind_regions(py::module_& module) {
  using namespace py::literals;
  py::class_<Region>(module, "Region", R"(A closed set of the plane, bounded by circular arcs and segments.

>>> import reprise
>>> m = reprise.Manipulator([[0, 0]], [[0, 0]], [[1, 2]])
>>> ring = reprise.constant_orientation_workspace(m)
>>> round(ring.area, 6), len(ring), ring.holes
(9.424778, 1, 1)
>>> ring.contains([0.0, 1.5], 0.0).tolist()
[False, True]
)")
      .def_property_readonly("area", &Region::area, "Of all components, holes taken out; a length squared.")
      .def_property_readonly("perimeter", &Region::perimeter, "Length of the whole boundary, holes included.")
      .def_property_readonly("holes", &hole_count, "Number of holes of all components.")
      .def_property_readonly(
          "edges",
          [](const Region& region) {
            py::list result;
            for (const RegionComponent& component : region.components()) {
              py::list loops;
              loops.append(edges_of(component.outer));
              for (const BoundaryLoop& hole : component.holes) loops.append(edges_of(hole));
              result.append(loops);
            }
            return result;
          },
          "For each component the edges of its outer boundary, then of its holes: arrays (n, 10) of start x, y, end x, "
          "y, centre x, y, radius (0 for a segment), start angle, sweep (radians) and the number of the active limit.")
      .def(
          "__len__", [](const Region& region) { return region.components().size(); }, "Number of components.")
      .def("boundary", &boundary, "spacing"_a,
           "For each component a list of arrays (n, 2): its outer boundary, counter-clockwise, then its holes, "
           "clockwise. Neighbouring points are no farther apart than `spacing`, a length, along the boundary.")
      .def("contains", &contains, "x"_a, "y"_a,
           "Whether points are inside: an array of booleans, x and y broadcast against each other. On the boundary it "
           "may be either.")
      .def("geojson", &geojson, "spacing"_a, "A MultiPolygon as GeoJSON has it; `spacing` as boundary() takes it.")
      .def("__copy__", [](const Region& region) { return region; })
      .def("__deepcopy__", [](const Region& region, const py::dict&) { return region; })
      .def(py::pickle(
          [](const Region& region) {
            py::list components;
            for (const RegionComponent& component : region.components()) {
              py::list loops;
              loops.append(loop_state(component.outer));
              for (const BoundaryLoop& hole : component.holes) loops.append(loop_state(hole));
              components.append(loops);
            }
            return py::make_tuple(components);
          },
          [](const py::tuple& state) {
            std::vector<RegionComponent> components;
            for (const py::handle one : state[0].cast<py::list>()) {
              RegionComponent component;
              bool outer = true;
              for (const py::handle loop : one.cast<py::list>()) {
                if (outer) {
                  component.outer = loop_of(loop.cast<py::tuple>());
                } else {
                  component.holes.push_back(loop_of(loop.cast<py::tuple>()));
                }
                outer = false;
              }
              components.push_back(component);
            }
            return Region(components);
          }));
  module.def(
      "constant_orientation_workspace",
      [](const ManipulatorInput& input, double orientation) {
        const py::gil_scoped_release released;
        return constant_orientation_workspace(input.manipulator, orientation);
      },
      "manipulator"_a, "orientation"_a = 0.0,
      "All positions that can be attained at one orientation (radians), as an exact Region.\n\n"
      ">>> import reprise\n"
      ">>> m = reprise.Manipulator([[0, 0]], [[0, 0]], [[0, 2]])\n"
      ">>> round(reprise.constant_orientation_workspace(m).area, 6)\n"
      "12.566371\n");
  module.def(
      "dextrous_workspace",
      [](const ManipulatorInput& input, double lower, double upper) {
        const py::gil_scoped_release released;
        return dextrous_workspace(input.manipulator, Interval{lower, upper});
      },
      "manipulator"_a, "lower"_a, "upper"_a,
      "All positions that can be attained at every orientation from lower to upper (radians), as an exact Region.\n\n"
      ">>> import reprise\n"
      ">>> m = reprise.Manipulator([[0, 0]], [[1, 0]], [[0, 2]])\n"
      ">>> reprise.dextrous_workspace(m, 0, 1).area < reprise.constant_orientation_workspace(m).area\n"
      "True\n");
  module.def("trace", &trace, "manipulator"_a, "orientation"_a = 0.0, "upper"_a = py::none(), "chord"_a = 0.02,
             R"(The boundary of a workspace by the chord method of the thesis.

orientation: radians; with `upper`, all orientations from one to the other: the dextrous workspace. chord: a length.
Returns a dictionary: `boundary`, for each component a list of arrays (n, 2), the outer one before the holes; `area`;
`bifurcation_points`, array (k, 2); `complete`, and `failures`, a sentence for each boundary that is missing.

>>> import reprise
>>> m = reprise.Manipulator([[0, 0]], [[0, 0]], [[1, 2]])
>>> reprise.trace(m, chord=0.05)["complete"]
True
)");
}

}  // namespace reprise::python
