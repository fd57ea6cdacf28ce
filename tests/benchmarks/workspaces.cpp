// What one workspace of the thesis's manipulators costs: as an exact region, all of its components, and traced by
// bracketing, the boundary of one component.

#include "measures.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "workspace/samples.hpp"

namespace reprise::benchmarks {
namespace {

double measure_exact(benchmark::State& state, Kind kind, const Manipulator& manipulator) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(kind == Kind::dextrous ? dextrous_workspace(manipulator, dextrous_range())
                                                    : constant_orientation_workspace(manipulator, 0.0));
  }
  return 1.0;
}

/// Adds for each boundary point the time and the numbers of evaluations and gradients, those for bifurcation points
/// included.
double measure_traced(benchmark::State& state, Kind kind, const Manipulator& manipulator) {
  const auto limits = make_limits(manipulator, kind);
  const Tracing trace(*limits);
  for (auto _ : state) benchmark::DoNotOptimize(trace());
  const TracedBoundary boundary = trace();
  const auto points = static_cast<double>(boundary.points.size());
  state.counters["per_point"] = time_in(points);
  state.counters["evaluations"] = static_cast<double>(boundary.evaluations) / points;
  state.counters["gradients"] = static_cast<double>(boundary.gradients) / points;
  return 1.0;
}

}  // namespace

void add_workspaces() {
  for (const Kind kind : kinds) {
    for (const Manipulator& manipulator : test::thesis_manipulators()) {
      const std::string group = "workspaces/" + to_string(kind) + "/" + manipulator.name() + "/";
      add(group + "exact",
          [kind, manipulator](benchmark::State& state) { return measure_exact(state, kind, manipulator); });
      add(group + "traced",
          [kind, manipulator](benchmark::State& state) { return measure_traced(state, kind, manipulator); });
    }
  }
}

}  // namespace reprise::benchmarks
