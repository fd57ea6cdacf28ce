// What one boundary point costs: the chord problems (5.18), (5.19) that arise while M1's boundary is traced, all of
// them solved by every point solver.

#include <algorithm>
#include <memory>
#include <vector>

#include "measures.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "workspace/samples.hpp"

namespace reprise::benchmarks {
namespace {

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

/// The points found in one iteration. Adds the numbers of evaluations and gradients for each, the part of the points
/// that were `found`, and of those the largest distance from where bracketing finds them, `off`.
double measure(benchmark::State& state, Kind kind, const PointSolver& solver) {
  const auto limits = make_limits(test::m1(), kind);
  std::vector<SolvedChord> chords;
  Tracing{*limits}(Recorder(chords));
  LimitEvaluator evaluator(*limits);
  double found = 0.0;
  double off = 0.0;
  for (auto _ : state) {
    for (const SolvedChord& chord : chords) {
      const SolvedPoint solved = solver.solve_chord(evaluator, chord.problem, chord.tolerance);
      if (solved.outcome != SolvedPoint::Outcome::found) continue;
      ++found;
      off = std::max(off, (solved.position - chord.position).norm());
    }
  }
  const auto points = static_cast<double>(chords.size());
  const double all = points * static_cast<double>(state.iterations());
  state.counters["evaluations"] = static_cast<double>(evaluator.evaluations()) / all;
  state.counters["gradients"] = static_cast<double>(evaluator.gradients()) / all;
  state.counters["found"] = found / all;
  state.counters["off"] = off;
  return points;
}

std::vector<std::shared_ptr<const Solver>> optimizers() {
  std::vector<std::shared_ptr<const Solver>> list{std::make_shared<DynamicQ>()};
  for (const NloptAlgorithm algorithm :
       {NloptAlgorithm::slsqp, NloptAlgorithm::ccsaq, NloptAlgorithm::mma, NloptAlgorithm::cobyla}) {
    NloptOptions options;
    options.algorithm = algorithm;
    list.push_back(std::make_shared<NloptSolver>(options));
  }
  list.push_back(std::make_shared<IpoptSolver>());
  return list;
}

}  // namespace

void add_boundary_points() {
  for (const Kind kind : kinds) {
    const std::string group = "boundary_points/" + to_string(kind) + "/";
    add(group + "bracketing",
        [kind](benchmark::State& state) { return measure(state, kind, BracketingPointSolver()); });
    for (const auto& optimizer : optimizers()) {
      add(group + optimizer->name(), [kind, optimizer](benchmark::State& state) {
        return measure(state, kind, OptimizerPointSolver(*optimizer));
      });
    }
  }
}

}  // namespace reprise::benchmarks
