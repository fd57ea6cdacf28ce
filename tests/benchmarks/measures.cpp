#include "measures.hpp"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "workspace/samples.hpp"

namespace reprise::benchmarks {
namespace {

/// The seconds that the fastest of many runs takes. They go on for long enough that the machine is left alone for a
/// moment.
template <class Run>
double fastest_run(Run&& run) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds long_enough(500);
  Clock::duration best = Clock::duration::max();
  for (const Clock::time_point first = Clock::now(); Clock::now() - first < long_enough;) {
    const Clock::time_point begin = Clock::now();
    run();
    best = std::min(best, Clock::now() - begin);
  }
  return std::chrono::duration<double>(best).count();
}

double measure_kinematics() {
  const Manipulator manipulator = test::m1();
  constexpr int poses = 100;
  const double seconds = fastest_run([&] {
    for (int k = 0; k < poses; ++k) {
      Pose pose{{1.0, 1.5}, 0.001 * k};
      benchmark::DoNotOptimize(pose);
      for (const Leg& leg : manipulator.legs()) benchmark::DoNotOptimize(leg_length(leg, pose));
    }
  });
  return seconds / poses;
}

double measure_point() {
  const ConstantOrientationLimits limits(test::m1(), 0.0);
  const Tracing trace(limits);
  const double seconds = fastest_run([&] { benchmark::DoNotOptimize(trace()); });
  return seconds / static_cast<double>(trace().points.size());
}

}  // namespace

std::string to_string(Kind kind) { return kind == Kind::dextrous ? "dextrous" : "constant_orientation"; }

Interval dextrous_range() { return {-5.0 * std::numbers::pi / 180.0, 5.0 * std::numbers::pi / 180.0}; }

std::unique_ptr<Limits> make_limits(const Manipulator& manipulator, Kind kind) {
  if (kind == Kind::dextrous) return std::make_unique<DextrousLimits>(manipulator, dextrous_range());
  return std::make_unique<ConstantOrientationLimits>(manipulator, 0.0);
}

Tracing::Tracing(const Limits& limits, const Limits& searched) : limits_(limits) {
  const InteriorPoint interior = find_interior_point(searched);
  if (interior.status != InteriorStatus::found) throw std::runtime_error("no point inside the workspace was found");
  start_ = interior.position;
}

TracedBoundary Tracing::operator()(const PointSolver& solver) const {
  TracedBoundary boundary = trace_boundary(limits_, start_, {.chord = chord}, solver);
  if (!boundary.closed()) throw std::runtime_error("the boundary was not traced: " + boundary.message);
  return boundary;
}

benchmark::Counter time_in(double seconds) {
  return {seconds, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

void add(const std::string& name, const std::function<double(benchmark::State&)>& measure) {
  static const double kinematics = measure_kinematics();
  static const double point = measure_point();
  const auto run = [measure](benchmark::State& state) {
    const double number = measure(state);
    state.counters["time"] = time_in(number);
    state.counters["kinematics"] = time_in(number * kinematics);
    state.counters["points"] = time_in(number * point);
  };
  const auto smallest = [](const std::vector<double>& values) {
    return *std::min_element(values.begin(), values.end());
  };
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMicrosecond)->ComputeStatistics(fastest, smallest);
}

}  // namespace reprise::benchmarks
