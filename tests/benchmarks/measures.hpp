#pragma once

// What the benchmarks have in common: their samples, and the two units in which every time is also given,
//     kinematics   one inverse kinematics: all three leg lengths of M1 at one pose, with nothing allocated
//     points       one boundary point: the time in which bracketing traces M1's constant-orientation workspace at phi =
//                  0 with the thesis's chord length, over the number of points on its boundary
// Both are measured once, as the fastest of many short runs, so that what else the machine does counts little.

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>

#include "reprise/workspace/trace.hpp"

namespace reprise::benchmarks {

/// The statistic of the fastest repetition.
inline constexpr const char* fastest = "fastest";

/// The thesis's chord length.
inline constexpr double chord = 0.02;

enum class Kind { constant_orientation, dextrous };
inline constexpr Kind kinds[] = {Kind::constant_orientation, Kind::dextrous};

std::string to_string(Kind kind);

/// The range of the thesis's dextrous synthesis, -5 to 5 degrees, in radians.
Interval dextrous_range();

/// The limits of a manipulator's workspace, at phi = 0 or over the dextrous range.
std::unique_ptr<Limits> make_limits(const Manipulator& manipulator, Kind kind);

/// Traces one boundary with the thesis's chord length, from a point inside that is the same in every call with the same
/// limits. Throws std::runtime_error when the boundary does not close.
class Tracing {
 public:
  explicit Tracing(const Limits& limits) : Tracing(limits, limits) {}
  /// The point inside is searched for with other limits of the same workspace.
  Tracing(const Limits& limits, const Limits& searched);
  TracedBoundary operator()(const PointSolver& solver = BracketingPointSolver()) const;

 private:
  const Limits& limits_;
  Eigen::Vector2d start_;
};

/// The time of one iteration in a unit of so many seconds, as a counter.
benchmark::Counter time_in(double seconds);

/// Registers a benchmark. `measure` runs it and returns how many of what it measures, such as workspaces, one iteration
/// makes. For each of them the counters `time`, in seconds, `kinematics` and `points`, in the units above, are added.
void add(const std::string& name, const std::function<double(benchmark::State&)>& measure);

/// Register the benchmarks of boundary_points.cpp and workspaces.cpp.
void add_boundary_points();
void add_workspaces();

}  // namespace reprise::benchmarks
