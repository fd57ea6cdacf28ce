// What must not become slower, piece by piece, for scripts/count, which runs this program in valgrind and counts the
// instructions of each call of reprise_counted. Prints a line for each piece, in the order of the calls: its name, and
// how many units of work it did.

#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/conditioning_field.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/lfopc.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "reprise/workspace/trace.hpp"
#include "synthesis/samples.hpp"

/// What is counted; found by its name, so neither inlined nor renamed.
extern "C" __attribute__((noinline)) void reprise_counted(const std::function<long()>& work, long& units) {
  units = work();
}

namespace reprise {
namespace {

/// Does the work once for what it only does the first time, then counts it.
void count(const std::string& name, const std::function<long()>& work) {
  work();
  long units = 0;
  reprise_counted(work, units);
  std::printf("%s,%ld\n", name.c_str(), units);
}

/// A program of random functions, as Dynamic-Q makes them.
SphericalProgram random_program(Eigen::Index n, Eigen::Index m, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(random); };
  const auto functions = [&](Eigen::Index count) {
    return SphericalQuadratics{Eigen::VectorXd::NullaryExpr(count, draw), Eigen::MatrixXd::NullaryExpr(count, n, draw),
                               Eigen::VectorXd::NullaryExpr(count, draw)};
  };
  SphericalProgram program{functions(1),
                           functions(m),
                           functions(0),
                           1.0,
                           Eigen::VectorXd::Constant(n, -infinity),
                           Eigen::VectorXd::Constant(n, infinity)};
  program.inequality.value.array() -= 1.0;
  return program;
}

void count_lfopc(Eigen::Index n, Eigen::Index m) {
  std::mt19937 random(7);
  std::vector<SphericalProgram> programs;
  for (int k = 0; k < 20; ++k) programs.push_back(random_program(n, m, random));
  count("LFOPC step; n = " + std::to_string(n) + "; m = " + std::to_string(m), [&] {
    long steps = 0;
    for (const SphericalProgram& program : programs) steps += lfopc(program).particle_steps;
    return steps;
  });
}

/// One unit is one workspace.
void count_workspaces(const Manipulator& manipulator, const Interval& range) {
  count("exact constant-orientation workspace of M1", [&] {
    const Region region = constant_orientation_workspace(manipulator, 0.0);
    return region.empty() ? 0L : 1L;
  });
  count("exact dextrous workspace of M1", [&] {
    const Region region = dextrous_workspace(manipulator, range);
    return region.empty() ? 0L : 1L;
  });
  const DextrousLimits limits(manipulator, range);
  const Eigen::Vector2d start = find_interior_point(limits).position;
  count("boundary point of the dextrous workspace of M1",
        [&] { return static_cast<long>(trace_boundary(limits, start, {.chord = 0.02}).points.size()); });
}

void count_conditioning(const Manipulator& manipulator) {
  count("kappa^-1 at a pose", [&] {
    constexpr long poses = 1000;
    double sum = 0.0;
    for (long k = 0; k < poses; ++k) {
      sum += kappa_inverse(manipulator, {{1.0, 1.5 - 1e-4 * static_cast<double>(k)}, 0.0});
    }
    return sum > 0.0 ? poses : 0;
  });
  count("kappa^-1 at one of many positions", [&] {
    constexpr Eigen::Index positions = 1000;
    const Eigen::ArrayXd x = Eigen::ArrayXd::Ones(positions);
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(positions, 1.4, 1.5);
    Eigen::ArrayXd values(positions);
    kappa_inverse_at(manipulator, 0.0, x, y, {}, values);
    return values.minCoeff() > 0.0 ? static_cast<long>(positions) : 0L;
  });
}

/// The SO synthesis of P2, by Dynamic-Q with its safeguard and an exchange of constraints, as in `reprise synthesize`.
void count_synthesis(const SynthesisTask& task, const Eigen::VectorXd& design) {
  DynamicQOptions options;
  options.subproblem = SubproblemSolver::dual;
  options.scale_objective = true;
  options.scale_variables = true;
  options.safeguard.active = true;
  options.move_limit = 0.1;
  const ConstraintExchange solver(std::make_shared<DynamicQ>(options));
  const PointwiseOptions points{1000, SingularitySide::either};
  const Problem problem = pointwise_problem(task, points);
  const Eigen::VectorXd start = pointwise_start(task, design, points);
  count("pointwise SO synthesis of P2",
        [&] { return solver.minimize(problem, start).status == Status::converged ? 1L : 0L; });
}

}  // namespace
}  // namespace reprise

int main() {
  using namespace reprise;
  count_lfopc(2, 1);
  count_lfopc(2, 6);
  count_lfopc(3, 12);
  count_lfopc(5, 4);
  count_lfopc(5, 40);
  count_lfopc(10, 20);
  const SynthesisTask task = samples::thesis_task();
  const Manipulator manipulator = task.designs.manipulator(samples::thesis_start());
  count_workspaces(manipulator, {-5.0 * degree, 5.0 * degree});
  count_conditioning(manipulator);
  count_synthesis(task, samples::thesis_start());
}
