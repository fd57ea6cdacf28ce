// What boundary points and workspaces cost, by every way to compute them: evaluations, which are the same in every run,
// and times, in seconds and in two units that hardly depend on the machine.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "frame/spread.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/kinematics/conditioning_field.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "reprise/workspace/multi_level.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise::experiments {
namespace {

constexpr const char* title = "Times of boundary points and workspaces";
constexpr const char* constant_orientation = "constant_orientation";
constexpr const char* dextrous = "dextrous";

struct Settings {
  double chord = 0.02;
  long repetitions = 5;
  double least_seconds = 0.01;
  bool with_ipopt = false;

  void declare(CommandLine& options) {
    options.number("--chord", chord, NumberRange::positive(0.5), "chord length d");
    options.integer("--repetitions", repetitions, 1, 1000, "how often each benchmark is timed");
    options.number("--least-seconds", least_seconds, NumberRange::between(0.0, 100.0),
                   "time of one repetition, at the least: what is short is done many times");
    options.flag("--with-ipopt", with_ipopt,
                 "measure Ipopt too, which takes some 10 ms for one of these small problems");
  }
};

/// What a benchmark counts, for each boundary point where there are such.
struct Measured {
  double items = 1.0;  ///< of which one iteration makes so many: poses, boundary points, workspaces
  std::optional<double> points = {};
  std::optional<double> evaluations = {};
  std::optional<double> gradients = {};
  std::optional<double> inner = {};
  std::optional<double> found = {};
  std::optional<double> off = {};
};

struct Benchmark {
  std::string subject;  ///< kinematics, conditioning, boundary_point, workspace or legs
  std::string kind;
  std::string manipulator;
  std::string method;
  std::function<Measured(benchmark::State&)> measure;
  Measured measured = {};
  std::vector<double> seconds = {};  ///< of one item, for each repetition
};

Manipulator read_manipulator_called(const std::string& name) {
  const CollinearManipulator one = read_chapter_manipulator(name);
  return make_manipulator(one.design, one.lengths, name);
}

/// A manipulator with its joints around two circles. The legs differ, so that no two curves of the limits are the same.
Manipulator make_ring(int count) {
  constexpr double base = 2.0, platform = 0.5, shortest = 0.2, longest = 2.0, spread = 0.05;
  std::vector<Leg> legs;
  for (int i = 0; i < count; ++i) {
    const double turn = full_turn * i / count;
    legs.push_back({base * unit(turn),
                    platform * unit(turn + spread * std::cos(3.0 * i)),
                    {shortest, longest + spread * std::sin(7.0 * i)},
                    {},
                    {}});
  }
  return {std::to_string(count), legs};
}

/// The range of the thesis's D synthesis.
Interval dextrous_range() {
  const OrientationRange range = read_orientations(chapter_synthesis("D")).front();
  return {range.lower, range.upper};
}

std::unique_ptr<Limits> make_limits(const Manipulator& manipulator, const std::string& kind) {
  if (kind == dextrous) return std::make_unique<DextrousLimits>(manipulator, dextrous_range());
  return std::make_unique<ConstantOrientationLimits>(manipulator, 0.0);
}

/// Traces one boundary, from a point inside that is the same in every call.
class Tracing {
 public:
  Tracing(const Limits& limits, double chord) : Tracing(limits, limits, chord) {}

  /// The point inside is searched for with other limits of the same workspace.
  Tracing(const Limits& limits, const Limits& searched, double chord) : limits_(limits), chord_(chord) {
    const InteriorPoint interior = find_interior_point(searched);
    if (interior.status != InteriorStatus::found) throw std::runtime_error("no point inside the workspace was found");
    start_ = interior.position;
  }

  TracedBoundary operator()(const PointSolver& solver = BracketingPointSolver()) const {
    TracedBoundary boundary = trace_boundary(limits_, start_, {.chord = chord_}, solver);
    if (!boundary.closed()) throw std::runtime_error("the boundary was not traced: " + boundary.message);
    return boundary;
  }

 private:
  const Limits& limits_;
  double chord_;
  Eigen::Vector2d start_;
};

Measured measure_kinematics(benchmark::State& state, const Manipulator& manipulator) {
  constexpr int poses = 100;
  for (auto _ : state) {
    for (int k = 0; k < poses; ++k) {
      Pose pose{{1.0, 1.5}, 0.001 * k};
      benchmark::DoNotOptimize(pose);
      for (const Leg& leg : manipulator.legs()) benchmark::DoNotOptimize(leg_length(leg, pose));
    }
  }
  return {.items = poses};
}

/// kappa^-1 at a grid of positions, all together or each alone.
Measured measure_conditioning(benchmark::State& state, const Manipulator& manipulator, bool together) {
  constexpr Eigen::Index positions = 4096;
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(positions, 0.5, 1.5);
  const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(positions, 1.2, 1.8);
  Eigen::ArrayXd values(positions);
  for (auto _ : state) {
    if (together) {
      kappa_inverse_at(manipulator, 0.0, x, y, {}, values);
    } else {
      for (Eigen::Index i = 0; i < positions; ++i) values[i] = kappa_inverse(manipulator, {{x[i], y[i]}, 0.0});
    }
    benchmark::DoNotOptimize(values.data());
  }
  return {.items = static_cast<double>(positions)};
}

Measured measure_exact(benchmark::State& state, const Manipulator& manipulator, const std::string& kind) {
  const Interval range = dextrous_range();
  for (auto _ : state) {
    benchmark::DoNotOptimize(kind == dextrous ? dextrous_workspace(manipulator, range)
                                              : constant_orientation_workspace(manipulator, 0.0));
  }
  return {};
}

Measured measured_of(const TracedBoundary& boundary) {
  const auto points = static_cast<double>(boundary.points.size());
  return {.points = points,
          .evaluations = static_cast<double>(boundary.evaluations) / points,
          .gradients = static_cast<double>(boundary.gradients) / points};
}

/// Evaluations and gradients include those for bifurcation points.
Measured measure_traced(benchmark::State& state, const Manipulator& manipulator, const std::string& kind,
                        double chord) {
  const auto limits = make_limits(manipulator, kind);
  const Tracing trace(*limits, chord);
  for (auto _ : state) benchmark::DoNotOptimize(trace());
  return measured_of(trace());
}

/// Boundary points by bracketing, with every evaluation of the constraints a solution of (5.26) by the solver given.
Measured measure_multi_level(benchmark::State& state, const Manipulator& manipulator, const OrientationSolver& solver,
                             double chord) {
  const MultiLevelDextrousLimits limits(manipulator, dextrous_range(), solver);
  const Tracing trace(limits, DextrousLimits(manipulator, dextrous_range()), chord);
  for (auto _ : state) benchmark::DoNotOptimize(trace());
  const std::size_t before = limits.inner_evaluations();
  const TracedBoundary boundary = trace();
  Measured measured = measured_of(boundary);
  measured.inner = static_cast<double>(limits.inner_evaluations() - before) / *measured.points;
  return measured;
}

/// A chord problem with its solution by bracketing.
struct SolvedChord {
  ChordProblem problem;
  double tolerance;
  Eigen::Vector2d position;
};

/// Solves by bracketing and keeps the chord problems.
class Recorder final : public PointSolver {
 public:
  explicit Recorder(std::vector<SolvedChord>& chords) : chords_(chords) {}

  SolvedPoint solve_ray(LimitEvaluator& limits, const RayProblem& problem, double tolerance) const override {
    return bracketing_.solve_ray(limits, problem, tolerance);
  }
  SolvedPoint solve_chord(LimitEvaluator& limits, const ChordProblem& problem, double tolerance) const override {
    SolvedPoint solved = bracketing_.solve_chord(limits, problem, tolerance);
    chords_.push_back({problem, tolerance, solved.position});
    return solved;
  }
  SolvedPoint solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& problem,
                                double tolerance) const override {
    return bracketing_.solve_bifurcation(limits, problem, tolerance);
  }
  double attainable(double tolerance, double length) const override {
    return bracketing_.attainable(tolerance, length);
  }

 private:
  BracketingPointSolver bracketing_;
  std::vector<SolvedChord>& chords_;
};

/// The chord problems (5.18), (5.19) that arise while a boundary is traced, all of them solved in one iteration.
Measured measure_points(benchmark::State& state, const Manipulator& manipulator, const std::string& kind,
                        const PointSolver& solver, double chord) {
  const auto limits = make_limits(manipulator, kind);
  std::vector<SolvedChord> chords;
  Tracing(*limits, chord)(Recorder(chords));
  const auto solve_all = [&](LimitEvaluator& evaluator, const auto& see) {
    for (const SolvedChord& one : chords) see(one, solver.solve_chord(evaluator, one.problem, one.tolerance));
  };
  LimitEvaluator timed(*limits);
  for (auto _ : state) {
    solve_all(timed, [](const SolvedChord&, const SolvedPoint& solved) { benchmark::DoNotOptimize(solved); });
  }
  LimitEvaluator counted(*limits);
  double found = 0.0;
  double off = 0.0;
  solve_all(counted, [&](const SolvedChord& one, const SolvedPoint& solved) {
    if (solved.outcome != SolvedPoint::Outcome::found) return;
    ++found;
    off = std::max(off, (solved.position - one.position).norm());
  });
  const auto points = static_cast<double>(chords.size());
  return {.items = points,
          .points = points,
          .evaluations = static_cast<double>(counted.evaluations()) / points,
          .gradients = static_cast<double>(counted.gradients()) / points,
          .found = found / points,
          .off = off};
}

/// A move limit that does not carry Dynamic-Q to another interval of orientations.
std::shared_ptr<const Solver> careful_dynamic_q() {
  DynamicQOptions careful;
  careful.move_limit = 0.1;
  return std::make_shared<DynamicQ>(careful);
}

std::vector<std::shared_ptr<const Solver>> point_optimizers(bool with_ipopt) {
  std::vector<std::shared_ptr<const Solver>> list{std::make_shared<DynamicQ>()};
  for (const NloptAlgorithm algorithm :
       {NloptAlgorithm::slsqp, NloptAlgorithm::ccsaq, NloptAlgorithm::mma, NloptAlgorithm::cobyla}) {
    NloptOptions options;
    options.algorithm = algorithm;
    list.push_back(std::make_shared<NloptSolver>(options));
  }
  if (with_ipopt) list.push_back(std::make_shared<IpoptSolver>());
  return list;
}

std::vector<Benchmark> list_benchmarks(const Settings& settings) {
  const double chord = settings.chord;
  const Manipulator m1 = read_manipulator_called("M1");
  std::vector<Benchmark> list{
      {"kinematics", "", "M1", "closed_form", [m1](auto& state) { return measure_kinematics(state, m1); }}};
  for (const bool together : {true, false}) {
    list.push_back({"conditioning", "", "M1", together ? "together" : "alone",
                    [=](auto& state) { return measure_conditioning(state, m1, together); }});
  }
  for (const char* kind : {constant_orientation, dextrous}) {
    list.push_back({"boundary_point", kind, "M1", "bracketing",
                    [=](auto& state) { return measure_points(state, m1, kind, BracketingPointSolver(), chord); }});
    for (const auto& optimizer : point_optimizers(settings.with_ipopt)) {
      list.push_back({"boundary_point", kind, "M1", optimizer->name(), [=](auto& state) {
                        return measure_points(state, m1, kind, OptimizerPointSolver(*optimizer), chord);
                      }});
    }
  }
  for (const char* kind : {constant_orientation, dextrous}) {
    for (const char* name : {"M1", "M2", "M3"}) {
      const Manipulator manipulator = read_manipulator_called(name);
      list.push_back(
          {"workspace", kind, name, "exact", [=](auto& state) { return measure_exact(state, manipulator, kind); }});
      list.push_back({"workspace", kind, name, "traced",
                      [=](auto& state) { return measure_traced(state, manipulator, kind, chord); }});
    }
  }
  for (const char* kind : {constant_orientation, dextrous}) {
    for (const int legs : {2, 4, 8, 16, 32, 64}) {
      const Manipulator manipulator = make_ring(legs);
      list.push_back({"legs", kind, manipulator.name(), "exact",
                      [=](auto& state) { return measure_exact(state, manipulator, kind); }});
    }
  }
  list.push_back({"workspace", dextrous, "M1", "multi_level_closed_form",
                  [=](auto& state) { return measure_multi_level(state, m1, ClosedFormOrientationSolver(), chord); }});
  const std::shared_ptr<const Solver> slsqp = std::make_shared<NloptSolver>();
  for (const auto& optimizer : {careful_dynamic_q(), slsqp}) {
    list.push_back({"workspace", dextrous, "M1", "multi_level_" + optimizer->name(), [=](auto& state) {
                      return measure_multi_level(state, m1, OptimizerOrientationSolver(*optimizer), chord);
                    }});
  }
  return list;
}

/// Takes the time of every repetition.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  Collector(std::vector<Benchmark>& list, Progress& progress) : list_(list), progress_(progress) {}

  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      Benchmark& one = list_[std::stoul(run.run_name.function_name)];
      one.seconds.push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations) / one.measured.items);
    }
    progress_.begin(fmt::format("{} of {}", std::min(++done_, list_.size()), list_.size()));
  }

 private:
  std::vector<Benchmark>& list_;
  Progress& progress_;
  std::size_t done_ = 0;
};

/// Runs them all with Google Benchmark, which finds how often what is short must be done to be timed.
void run(std::vector<Benchmark>& list, const Settings& settings) {
  std::vector<std::string> words{title, "--benchmark_filter=.",
                                 fmt::format("--benchmark_repetitions={}", settings.repetitions),
                                 fmt::format("--benchmark_min_time={}", settings.least_seconds)};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  auto count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  for (std::size_t i = 0; i < list.size(); ++i) {
    benchmark::RegisterBenchmark(std::to_string(i).c_str(),
                                 [&list, i](benchmark::State& state) { list[i].measured = list[i].measure(state); });
  }
  Progress progress(list.size());
  Collector collector(list, progress);
  benchmark::RunSpecifiedBenchmarks(&collector);
}

Table make_counts_table(const std::vector<Benchmark>& list) {
  Table table(std::string(title) + ": what is counted",
              {{"subject", "-", "kinematics, conditioning, boundary_point, workspace or legs"},
               {"kind", "-", "constant_orientation (at phi = 0) or dextrous (over the range of D synthesis)"},
               {"manipulator", "-", "manipulator design, or the number of its legs"},
               {"method", "-", "how it is computed"},
               {"n_b", "-", "boundary points, those in the corners included"},
               {"evaluations", "-", "of all limits, for each boundary point"},
               {"gradients", "-", "of one limit, for each boundary point"},
               {"inner", "-", "evaluations of all leg limits at one pose that solve (5.26), for each boundary point"},
               {"found", "-", "part of the boundary points that was found"},
               {"off", "length", "largest distance of these from where bracketing finds them"}});
  const auto field = [](const std::optional<double>& value) { return value ? Field(*value) : Field(); };
  for (const Benchmark& one : list) {
    const Measured& measured = one.measured;
    table.add_row({one.subject, one.kind, one.manipulator, one.method, field(measured.points),
                   field(measured.evaluations), field(measured.gradients), field(measured.inner), field(measured.found),
                   field(measured.off)});
  }
  return table;
}

Table make_times_table(const std::vector<Benchmark>& list) {
  Table table(std::string(title) + ": times",
              {{"subject", "-", "kinematics, conditioning, boundary_point, workspace or legs"},
               {"kind", "-", "constant_orientation (at phi = 0) or dextrous (over the range of D synthesis)"},
               {"manipulator", "-", "manipulator design, or the number of its legs"},
               {"method", "-", "how it is computed"},
               {"repetitions", "-", "how often it was timed"},
               {"least", "s", "time of the processor for one of them: the shortest"},
               {"median", "s", "the median"},
               {"most", "s", "the longest"},
               {"kinematics", "-", "the shortest in units of one inverse kinematics"},
               {"points", "-", "the shortest in units of one point of M1's boundary at phi = 0, traced by bracketing"}},
              {"Times differ from run to run."});
  const auto least = [](const Benchmark& one) { return spread_of(one.seconds).lowest; };
  const auto traced = std::find_if(list.begin(), list.end(), [](const Benchmark& one) {
    return one.kind == constant_orientation && one.manipulator == "M1" && one.method == "traced";
  });
  const double kinematics = least(list.front());
  const double point = least(*traced) / *traced->measured.points;
  for (const Benchmark& one : list) {
    const Spread spread = spread_of(one.seconds);
    table.add_row({one.subject, one.kind, one.manipulator, one.method, one.seconds.size(), spread.lowest, spread.median,
                   spread.highest, spread.lowest / kinematics, spread.lowest / point});
  }
  return table;
}

}  // namespace
}  // namespace reprise::experiments

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;

  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  settings.declare(experiment.options());

  return experiment.run(argc, argv, [&](Session& session) {
    if (session.quick()) {
      settings.repetitions = 1;
      settings.least_seconds = 0.0;
    }
    std::vector<Benchmark> list = list_benchmarks(settings);
    run(list, settings);
    const Table times = make_times_table(list);
    session.write(make_counts_table(list));
    session.write(times, "times");
    fmt::print("{:<15}{:<22}{:<4}{:<25}{:>12}{:>12}{:>12}{:>12}{:>10}\n", "", "", "", "", "least, us", "median", "most",
               "kinematics", "points");
    for (std::size_t row = 0; row < times.rows(); ++row) {
      constexpr double micro = 1e6;
      fmt::print("{:<15}{:<22}{:<4}{:<25}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.1f}{:>10.2f}\n", times.text(row, "subject"),
                 times.text(row, "kind"), times.text(row, "manipulator"), times.text(row, "method"),
                 micro * times.number(row, "least"), micro * times.number(row, "median"),
                 micro * times.number(row, "most"), times.number(row, "kinematics"), times.number(row, "points"));
    }
  });
}
