// What one workspace of the thesis's manipulators costs: as an exact region, all of its components, and traced by
// bracketing, the boundary of one component. The dextrous one of M1 also by the thesis's multi-level method.

#include <memory>

#include "measures.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/multi_level.hpp"
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

/// Boundary points by bracketing, with every evaluation of the constraints a solution of (5.26) by the solver given.
/// Adds for each boundary point also the number of evaluations of all leg limits that these take, `inner`.
double measure_multi_level(benchmark::State& state, const OrientationSolver& solver) {
  const MultiLevelDextrousLimits limits(test::m1(), dextrous_range(), solver);
  const Tracing trace(limits, DextrousLimits(test::m1(), dextrous_range()));
  for (auto _ : state) benchmark::DoNotOptimize(trace());
  const std::size_t before = limits.inner_evaluations();
  const TracedBoundary boundary = trace();
  const auto points = static_cast<double>(boundary.points.size());
  state.counters["per_point"] = time_in(points);
  state.counters["evaluations"] = static_cast<double>(boundary.evaluations) / points;
  state.counters["gradients"] = static_cast<double>(boundary.gradients) / points;
  state.counters["inner"] = static_cast<double>(limits.inner_evaluations() - before) / points;
  return 1.0;
}

void add_multi_level() {
  const std::string group = "workspaces/dextrous/M1/multi_level/";
  add(group + "closed_form",
      [](benchmark::State& state) { return measure_multi_level(state, ClosedFormOrientationSolver()); });
  // A move limit that does not carry Dynamic-Q to another interval of orientations.
  DynamicQOptions careful;
  careful.move_limit = 0.1;
  const std::initializer_list<std::shared_ptr<const Solver>> optimizers = {
      std::make_shared<DynamicQ>(careful), std::make_shared<NloptSolver>(), std::make_shared<IpoptSolver>()};
  for (const auto& optimizer : optimizers) {
    add(group + optimizer->name(), [optimizer](benchmark::State& state) {
      return measure_multi_level(state, OptimizerOrientationSolver(*optimizer));
    });
  }
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
  add_multi_level();
}

}  // namespace reprise::benchmarks
