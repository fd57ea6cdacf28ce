#pragma once

// LFOPC: constrained minimisation by following the trajectory of a particle of unit mass in a force field.
//
// The penalty function
//     P(x) = f(x) + mu sum_j max(0, g_j(x))^2 + mu sum_k h_k(x)^2
// is the particle's potential: x'' = -grad P(x), integrated by the leap-frog scheme. While the particle gains kinetic
// energy it runs on; when it loses some, it has passed a valley and most of its speed is taken (LFOP1(b)). Three
// phases:
//   0: mu = penalty_first,  from the start;
//   1: mu = penalty_second, from where phase 0 ended; the violated inequalities are then the active ones;
//   2: least squares of the active inequalities and the equalities, without f, from where phase 1 ended: the nearest
//      point at which they hold with equality. When they are more than the variables they cannot all do so, and those
//      that carry the force are taken (ours).
// J. A. Snyman, Appl. Math. Modelling 6 (1982) 449-462 and 7 (1983) 216-218 (LFOP1, LFOP1(b)); The LFOPC leap-frog
// algorithm for constrained optimization, Comput. Math. Appl. 40 (2000) 1085-1096.
//
// Here it minimises spherical programs; the move limit is the inequality (|s|^2 - move_limit^2) / move_limit <= 0, a
// length as bounds are.

#include <Eigen/Core>

#include "reprise/optimizers/spherical_program.hpp"

namespace reprise {

/// The constants of the method.
struct LfopcOptions {
  double penalty_first = 1e2;   ///< mu of phase 0
  double penalty_second = 1e4;  ///< mu of phase 1
  /// delta, the longest step of the particle, over sqrt(n) move_limit: public descriptions give a tenth.
  double relative_step_cap = 0.1;
  /// Growth of the time step: after k aligned steps in a row (successive accelerations within 90 degrees) it is
  /// multiplied by 1 + k times this.
  double time_step_growth = 1e-3;
  /// The time step is halved after this many successive opposed accelerations.
  int opposed_steps = 3;
  /// Phases 0 and 1 end when |grad P| (per move limit) is below this.
  double gradient_tolerance = 1e-5;
  /// Phase 2 ends when |grad P| is below this. P is a sum of squares then: at the tolerance above, violations of some
  /// 1e-6 would remain.
  double feasibility_gradient_tolerance = 1e-9;
  /// Safeguard of ours: the leap-frog rules alone can circle for ever around the edge of a one-sided penalty. After
  /// this many steps without a new lowest P the particle is put back to rest at the lowest point, with half the step
  /// cap and half the time step.
  int stall_steps = 20;
  /// A phase ends when the step cap has been halved to below this times move_limit.
  double relative_step_tolerance = 1e-8;
  /// A phase ends after this many steps.
  int max_steps = 20'000;
};

/// The step s found, and how many steps of the particle it took.
struct LfopcResult {
  Eigen::VectorXd step;     ///< s, within the bounds
  long particle_steps = 0;  ///< over all phases
};

/// Minimises the program from s = 0. Always returns a finite step when the program's numbers are finite. Throws
/// std::invalid_argument when an option is not positive (opposed_steps, stall_steps and max_steps: at least 1).
LfopcResult lfopc(const SphericalProgram& program, const LfopcOptions& options = {});

}  // namespace reprise
