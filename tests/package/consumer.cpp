#include <cmath>
#include <reprise/base.hpp>
#include <reprise/bounds.hpp>
#include <reprise/geometry.hpp>
#include <reprise/kinematics.hpp>
#include <reprise/optimizers.hpp>
#include <reprise/optimizers/dynamic_q.hpp>
#include <reprise/optimizers/ipopt.hpp>
#include <reprise/optimizers/nlopt.hpp>
#include <reprise/synthesis.hpp>
#include <reprise/workspace.hpp>

int main() {
  const reprise::Leg leg{.base_joint = {0.0, 0.0}, .platform_joint = {1.0, 0.0}, .length = {0.0, 10.0}};
  reprise::Problem problem;
  problem.name = "position on the x-axis where the leg has length 5";
  problem.n = 1;
  problem.objective = [&](const Eigen::VectorXd& x) {
    return std::pow(reprise::leg_length(leg, {.position = {x[0], 0.0}}) - 5.0, 2);
  };
  const auto finds_it = [&](const reprise::Solver& solver) {
    return std::abs(solver.minimize(problem, Eigen::VectorXd::Constant(1, 3.0)).x[0] - 4.0) < 1e-3;
  };
  return finds_it(reprise::DynamicQ()) && finds_it(reprise::NloptSolver()) && finds_it(reprise::IpoptSolver()) ? 0 : 1;
}
