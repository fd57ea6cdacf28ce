#pragma once

// Algorithms of NLopt (S. G. Johnson, The NLopt nonlinear-optimization package): local ones for smooth problems, COBYLA
// for problems without derivatives, and evolutionary ones.

#include <optional>

#include "reprise/optimizers/solver.hpp"

namespace reprise {

/// The methods of NLopt that are here.
enum class NloptAlgorithm {
  slsqp,   ///< sequential quadratic programming with BFGS updates; D. Kraft, DFVLR-FB 88-28, 1988
  ccsaq,   ///< conservative convex separable approximations, quadratic; K. Svanberg, SIAM J. Optim. 12 (2002) 555-573
  mma,     ///< the method of moving asymptotes, globally convergent version of the same paper
  cobyla,  ///< linear approximations by interpolation, no derivatives; M. J. D. Powell, 1994
  isres,   ///< evolution strategy with stochastic ranking; T. P. Runarsson, X. Yao, IEEE Trans. SMC C 35 (2005) 233-243
  crs2,    ///< controlled random search with local mutation; P. Kaelo, M. M. Ali, J. Optim. Theory Appl. 130 (2006)
           ///< 253-264
  esch,    ///< evolutionary algorithm; C. H. da Silva Santos, M. S. Goncalves, H. E. Hernandez-Figueroa, 2010
};

/// Options of this solver, in addition to those of all solvers.
struct NloptOptions {
  NloptAlgorithm algorithm = NloptAlgorithm::slsqp;  ///< which of the library's methods

  /// Stop when the step, in the 1-norm, is below this times |x|. Zero switches the test off. Without a value 1e-8,
  /// about the square root of the rounding error: a smooth objective does not tell closer points apart; for COBYLA
  /// 1e-6, since on Hock-Schittkowski problem 71 its simplex does not shrink below 1e-7 in 20'000 points. For ISRES the
  /// step is that between two best points of the population.
  std::optional<double> xtol_rel;

  /// Stop when every coordinate of the step is below this: ends a run towards x = 0, where no relative test can. Zero
  /// switches the test off.
  double xtol_abs = 1e-10;

  /// Stop when the change of f is below this times |f|. Off (zero) because one short step ends the run: SLSQP then
  /// stops far from the optimum of Hock-Schittkowski problem 100, at 690.6 in place of 680.6.
  double ftol_rel = 0.0;

  /// Limit on the points that NLopt tries (it counts no other iterations); those of finite differences are not among
  /// them. COBYLA needs thousands where the others need tens, ISRES tens of thousands.
  long max_iterations = 20'000;

  /// ISRES, CRS2, ESCH: seed of the random numbers, set anew for every run, so that a run can be repeated.
  unsigned long seed = 1;

  /// ISRES, CRS2, ESCH: number of points of a generation; zero for NLopt's own choice: 20 (n + 1), 10 (n + 1) and 40.
  unsigned population = 0;

  /// These three search a box. Where the problem has no bound, it ends this many units of the variable away from the
  /// start.
  double search_radius = 10.0;
};

/// Solver over NLopt. Equality constraints are taken by SLSQP, COBYLA and ISRES only. CRS2 and ESCH take bounds and no
/// constraint at all: minimize throws std::invalid_argument for one. With neither a test of their own nor a use for
/// derivatives, they end at max_iterations or at one of the Options' limits.
///
/// NLopt sees variables and objective in the units of Evaluator::measure, in which x tolerances and lengths are meant:
/// variable i in units of min(max(1, |x_i|) of the start, distance of its bounds), f in units of its largest slope at
/// the start (not the methods without derivatives, to which the unit of f does not matter). COBYLA's first step is one
/// such unit, or a quarter of the distance of the bounds where that is less, however near a start is to zero or to a
/// bound.
///
/// A point where a function is not finite is given to NLopt as one that is infinitely bad (to COBYLA, as one a little
/// worse than all others), so that it is stepped back from; at the start, and for a gradient at an acceptable point, it
/// ends the run as numerical_failure. The problem is called unbounded when a feasible f is below -1e20, or when f is
/// the lowest so far at a feasible x with |x| above 1e20 units. Result::solver_code is NLopt's own
/// (nlopt_result). A run that NLopt ends with a failure or as "roundoff limited" keeps its best point and is reported
/// as infeasible if that point is, else as numerical_failure.
///
/// What to expect: a constraint counts as satisfied within Options::feasibility_tolerance; MMA and CCSAQ take no
/// tolerance, but are only as feasible as NLopt solves their dual problem, and end with violations of a few 1e-6 on
/// Hock-Schittkowski problem 100. All tests look at the last step only: CCSAQ can stop falsely after a start that is
/// far from feasible (problem 10), SLSQP where gradients of constraints are linearly dependent. NLopt gives back
/// SLSQP's lowest feasible point, which may be an early one; here the result is its last iterate, where that is
/// feasible.
class NloptSolver : public Solver {
 public:
  /// Throws std::invalid_argument, naming option and value, when one is out of range.
  explicit NloptSolver(NloptOptions options = {});

  /// slsqp, ccsaq, mma, cobyla, isres, crs2 or esch.
  std::string name() const override;
  bool handles_equalities() const override;
  bool derivative_free() const override;

 private:
  Outcome solve(Evaluator& evaluator, const Eigen::VectorXd& x0) const override;

  NloptOptions options_;
};

}  // namespace reprise
