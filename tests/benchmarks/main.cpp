// Runs the benchmarks, all of them by default; --help lists Google Benchmark's options. Each is repeated: the table
// shows the fastest repetition, the file of --benchmark_out has all of them.

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "measures.hpp"

namespace {

/// A counter as a column of the table.
struct Column {
  const char* counter;
  const char* heading;
  int width;
  int decimals;
  double unit;  ///< one of the counter's unit in the unit of the column
};
constexpr std::array<Column, 9> columns{{{"time", "time", 11, 3, 1e6},
                                         {"kinematics", "kinematics", 11, 1, 1.0},
                                         {"points", "points", 9, 2, 1.0},
                                         {"per_point", "per point", 10, 3, 1e6},
                                         {"evaluations", "evaluations", 12, 2, 1.0},
                                         {"gradients", "gradients", 10, 2, 1.0},
                                         {"inner", "inner", 8, 1, 1.0},
                                         {"found", "found", 7, 3, 1.0},
                                         {"off", "off", 7, 0, 1e12}}};

constexpr const char* legend = R"(The fastest of several repetitions, CPU time.
  time         of one boundary point or one workspace, microseconds
  kinematics   the same in units of one inverse kinematics
  points       the same in units of one boundary point of M1's constant-orientation workspace, traced by bracketing
  per point    of a traced workspace: time over the number of points on its boundary, microseconds
  evaluations  of all limits, for each boundary point
  gradients    of one limit, for each boundary point
  inner        evaluations of all leg limits at one pose that solve (5.26), for each boundary point
  found        part of the boundary points that was found
  off          largest distance of these from where bracketing finds them, 1e-12 of the unit of length

)";

/// One line for each benchmark.
class Reporter final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    width_ = static_cast<int>(context.name_field_width);
    std::printf("%s%*s", legend, width_, "");
    for (const Column& column : columns) std::printf("%*s", column.width, column.heading);
    std::printf("\n");
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    const auto shown = std::find_if(runs.begin(), runs.end(),
                                    [](const Run& run) { return run.aggregate_name == reprise::benchmarks::fastest; });
    if (shown == runs.end()) return;
    std::printf("%-*s", width_, shown->run_name.str().c_str());
    for (const Column& column : columns) {
      const auto counter = shown->counters.find(column.counter);
      if (counter == shown->counters.end()) {
        std::printf("%*s", column.width, "");
      } else {
        std::printf("%*.*f", column.width, column.decimals, column.unit * counter->second.value);
      }
    }
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  int width_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  char repetitions[] = "--benchmark_repetitions=5";
  char time[] = "--benchmark_min_time=0.01";
  std::vector<char*> arguments{argv[0], repetitions, time};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  auto count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  reprise::benchmarks::add_boundary_points();
  reprise::benchmarks::add_workspaces();
  Reporter reporter;
  return benchmark::RunSpecifiedBenchmarks(&reporter) > 0 ? 0 : 1;
}
