#include "reprise/optimizers/nlopt.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "reprise/base/require.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/parked_exception.hpp"
#include "reprise/optimizers/tolerances.hpp"

namespace reprise {
namespace {

/// MMA and CCSAQ shorten their steps to nothing when a gradient is wrong, and would go on to the last iteration.
constexpr int most_repetitions = 100;

nlopt_algorithm code_of(NloptAlgorithm algorithm) {
  switch (algorithm) {
    case NloptAlgorithm::slsqp:
      return NLOPT_LD_SLSQP;
    case NloptAlgorithm::ccsaq:
      return NLOPT_LD_CCSAQ;
    case NloptAlgorithm::mma:
      return NLOPT_LD_MMA;
    case NloptAlgorithm::cobyla:
      return NLOPT_LN_COBYLA;
    case NloptAlgorithm::isres:
      return NLOPT_GN_ISRES;
    case NloptAlgorithm::crs2:
      return NLOPT_GN_CRS2_LM;
    case NloptAlgorithm::esch:
      return NLOPT_GN_ESCH;
  }
  throw std::invalid_argument("the NLopt algorithm is none of slsqp, ccsaq, mma, cobyla, isres, crs2, esch");
}

/// Those that search a box with random numbers.
bool is_random(NloptAlgorithm algorithm) {
  return algorithm == NloptAlgorithm::isres || algorithm == NloptAlgorithm::crs2 || algorithm == NloptAlgorithm::esch;
}

bool takes_constraints(NloptAlgorithm algorithm) {
  return algorithm != NloptAlgorithm::crs2 && algorithm != NloptAlgorithm::esch;
}

/// Those of conservative convex approximations, which solve a dual problem in every iteration.
bool solves_duals(NloptAlgorithm algorithm) {
  return algorithm == NloptAlgorithm::ccsaq || algorithm == NloptAlgorithm::mma;
}

using Handle = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

/// What the callbacks share during one run.
struct Run {
  Evaluator& evaluator;
  nlopt_opt handle;
  NloptAlgorithm algorithm;
  Eigen::VectorXd x;
  ParkedException parked = {};
  int repetitions = 0;           ///< how often in a row the objective was asked for at x
  bool any_value = false;        ///< a point with finite values has been seen
  Eigen::VectorXd last_iterate;  ///< the last finite point at which NLopt asked for the gradient
  double largest_value = -std::numeric_limits<double>::infinity();  ///< of the objective, where all is finite
  double lowest_feasible = std::numeric_limits<double>::infinity();
  std::optional<Status> ended = std::nullopt;
  const char* reason = "";

  void end(Status status, const char* why) {
    ended = status;
    reason = why;
    nlopt_force_stop(handle);
  }

  /// True when f, g and h are all finite at x.
  bool finite_values() {
    const bool finite = std::isfinite(evaluator.objective(x)) && evaluator.inequality(x).allFinite() &&
                        evaluator.equality(x).allFinite();
    any_value = any_value || finite;
    return finite;
  }

  /// What NLopt is given where there is no value. COBYLA interpolates, and infinity in its linear models keeps it busy
  /// for ever without a further call: it gets a value a little worse than all others.
  double bad_value() const {
    if (algorithm != NloptAlgorithm::cobyla || !any_value) return HUGE_VAL;
    return largest_value + std::max(1.0, std::abs(largest_value));
  }

  /// True for the lowest value at a feasible point so far.
  bool is_lowest(double value) {
    const bool feasible = evaluator.violation(x) <= evaluator.options().feasibility_tolerance;
    const bool lowest = feasible && value < lowest_feasible;
    if (lowest) lowest_feasible = value;
    return lowest;
  }
};

double objective(unsigned n, const double* x, double* gradient, void* data) {
  Run& run = *static_cast<Run*>(data);
  double value = run.bad_value();
  const bool going_on = run.parked.attempt([&] {
    const Eigen::Map<const Eigen::VectorXd> point(x, n);
    run.repetitions = run.x == point ? run.repetitions + 1 : 0;
    run.x = point;
    if (gradient != nullptr) std::fill_n(gradient, n, 0.0);
    if (run.repetitions > most_repetitions) {
      run.end(Status::numerical_failure, "the same point is tried again and again; are the gradients right?");
    }
    if (!run.finite_values()) {
      if (!run.any_value) run.end(Status::numerical_failure, "a function is not finite at the start");
      return;
    }
    const double found = run.evaluator.objective(run.x);
    const bool lowest = run.is_lowest(found);
    if (run.x.norm() > unbounded_size) {
      // MMA and CCSAQ try points far out where their approximations are flat: that alone means nothing.
      if (lowest) run.end(Status::unbounded, "the point ran off without a limit");
      return;
    }
    value = found;
    run.largest_value = std::max(run.largest_value, value);
    if (gradient == nullptr) return;
    run.last_iterate = run.x;
    const Eigen::VectorXd& exact = run.evaluator.objective_gradient(run.x);
    if (!exact.allFinite()) run.end(Status::numerical_failure, "the gradient of the objective is not finite");
    std::copy(exact.begin(), exact.end(), gradient);
  });
  if (!going_on) nlopt_force_stop(run.handle);
  return value;
}

using Values = const Eigen::VectorXd& (Evaluator::*)(const Eigen::VectorXd&);
using Jacobian = const SparseMatrix& (Evaluator::*)(const Eigen::VectorXd&);

template <Values values, Jacobian jacobian>
void constraints(unsigned m, double* result, unsigned n, const double* x, double* gradient, void* data) {
  Run& run = *static_cast<Run*>(data);
  // Where a function is not finite f is infinite already; here any finite violation will do.
  std::fill_n(result, m, 1.0);
  if (gradient != nullptr) std::fill_n(gradient, static_cast<std::size_t>(m) * n, 0.0);
  const bool going_on = run.parked.attempt([&] {
    run.x = Eigen::Map<const Eigen::VectorXd>(x, n);
    if (!run.finite_values()) return;
    const Eigen::VectorXd& value = (run.evaluator.*values)(run.x);
    std::copy(value.begin(), value.end(), result);
    if (gradient == nullptr) return;
    const SparseMatrix& rows = (run.evaluator.*jacobian)(run.x);
    for (Eigen::Index row = 0; row < rows.outerSize(); ++row) {
      for (SparseMatrix::InnerIterator entry(rows, row); entry; ++entry) {
        if (!std::isfinite(entry.value()))
          run.end(Status::numerical_failure, "the gradient of a constraint is not finite");
        gradient[row * static_cast<Eigen::Index>(n) + entry.col()] += entry.value();
      }
    }
  });
  if (!going_on) nlopt_force_stop(run.handle);
}

/// Where SLSQP ended: its test is met by its last iterate, but NLopt returns the lowest point among the feasible ones,
/// which may be an early one far away. The last iterate is taken where it is feasible and either passed the test or is
/// the better one.
Eigen::VectorXd end_of_slsqp(Evaluator& evaluator, const Eigen::VectorXd& returned, const Eigen::VectorXd& last_iterate,
                             bool converged) {
  const double tolerance = evaluator.options().feasibility_tolerance;
  if (returned == last_iterate || !(evaluator.violation(last_iterate) <= tolerance)) return returned;
  if (converged) return last_iterate;
  const double f = evaluator.objective(last_iterate);
  const bool keep = evaluator.objective(returned) <= f && evaluator.violation(returned) <= tolerance;
  return keep ? returned : last_iterate;
}

/// The sentence of NLopt's manual for a code, or NLopt's own for this run where there is one.
std::string sentence(nlopt_opt handle, nlopt_result code) {
  if (const char* own = nlopt_get_errmsg(handle)) return own;
  switch (code) {
    case NLOPT_SUCCESS:
      return "success";
    case NLOPT_STOPVAL_REACHED:
      return "the objective fell below the limit for unbounded problems";
    case NLOPT_FTOL_REACHED:
      return "the change of the objective is below ftol_rel";
    case NLOPT_XTOL_REACHED:
      return "the step is below xtol_rel or xtol_abs";
    case NLOPT_MAXEVAL_REACHED:
      return "the limit on iterations was reached";
    case NLOPT_ROUNDOFF_LIMITED:
      return "rounding errors limit further progress";
    case NLOPT_OUT_OF_MEMORY:
      return "out of memory";
    case NLOPT_INVALID_ARGS:
      return "NLopt refuses the problem";
    default:
      return "generic failure";
  }
}

Status status_of(nlopt_result code) {
  switch (code) {
    case NLOPT_SUCCESS:
    case NLOPT_FTOL_REACHED:
    case NLOPT_XTOL_REACHED:
      return Status::converged;
    case NLOPT_STOPVAL_REACHED:
      return Status::unbounded;
    case NLOPT_MAXEVAL_REACHED:
      return Status::iteration_limit;
    default:
      return Status::numerical_failure;
  }
}

}  // namespace

NloptSolver::NloptSolver(NloptOptions options) : options_(options) {
  code_of(options_.algorithm);
  const auto not_negative = [](const char* name, double value) {
    require(value >= 0.0 && std::isfinite(value), name, value, "finite and at least 0");
  };
  if (options_.xtol_rel) not_negative("NLopt option xtol_rel", *options_.xtol_rel);
  not_negative("NLopt option xtol_abs", options_.xtol_abs);
  not_negative("NLopt option ftol_rel", options_.ftol_rel);
  require(options_.max_iterations >= 1 && options_.max_iterations <= std::numeric_limits<int>::max(),
          "NLopt option max_iterations", options_.max_iterations, "from 1 to 2147483647");
  require(options_.search_radius > 0.0 && std::isfinite(options_.search_radius), "NLopt option search_radius",
          options_.search_radius, "positive and finite");
}

std::string NloptSolver::name() const {
  switch (options_.algorithm) {
    case NloptAlgorithm::slsqp:
      return "slsqp";
    case NloptAlgorithm::ccsaq:
      return "ccsaq";
    case NloptAlgorithm::mma:
      return "mma";
    case NloptAlgorithm::cobyla:
      return "cobyla";
    case NloptAlgorithm::isres:
      return "isres";
    case NloptAlgorithm::crs2:
      return "crs2";
    case NloptAlgorithm::esch:
      return "esch";
  }
  return "nlopt";
}

bool NloptSolver::handles_equalities() const {
  return takes_constraints(options_.algorithm) && !solves_duals(options_.algorithm);
}

bool NloptSolver::derivative_free() const {
  return options_.algorithm == NloptAlgorithm::cobyla || is_random(options_.algorithm);
}

Outcome NloptSolver::solve(Evaluator& evaluator, const Eigen::VectorXd& given_start) const {
  if (evaluator.inequalities() > 0 && !takes_constraints(options_.algorithm)) {
    throw std::invalid_argument(name() + " takes bounds only, but the problem has " +
                                std::to_string(evaluator.inequalities()) + " inequality constraints");
  }
  // Neither COBYLA's interpolation nor a ranking depends on the unit of f.
  const Eigen::VectorXd x0 =
      evaluator.measure(given_start, {.variables = true, .slope = derivative_free() ? 0.0 : 1.0});
  const Handle handle(nlopt_create(code_of(options_.algorithm), static_cast<unsigned>(evaluator.n())), &nlopt_destroy);
  if (!handle) return {x0, Status::numerical_failure, NLOPT_OUT_OF_MEMORY, "out of memory"};
  nlopt_opt opt = handle.get();
  Run run{.evaluator = evaluator, .handle = opt, .algorithm = options_.algorithm, .x = x0, .last_iterate = x0};
  // MMA and CCSAQ accept a point outside as soon as it is within the tolerance, and then stay there.
  const bool dual = solves_duals(options_.algorithm);
  const double tolerance = dual ? 0.0 : evaluator.options().feasibility_tolerance;
  Eigen::VectorXd lower = evaluator.lower();
  Eigen::VectorXd upper = evaluator.upper();
  if (is_random(options_.algorithm)) {
    for (Eigen::Index i = 0; i < evaluator.n(); ++i) {
      const double radius = options_.search_radius;
      if (!std::isfinite(lower[i])) lower[i] = x0[i] - radius;
      if (!std::isfinite(upper[i])) upper[i] = x0[i] + radius;
    }
    nlopt_set_population(opt, options_.population);
    nlopt_srand(options_.seed);
  }
  nlopt_set_lower_bounds(opt, lower.data());
  nlopt_set_upper_bounds(opt, upper.data());
  // NLopt's own choice is |x_i|, or a part of the distance to the nearest bound, which may be next to nothing.
  constexpr double quarter = 0.25;
  const Eigen::VectorXd steps = (quarter * (upper - lower)).cwiseMin(1.0);
  nlopt_set_initial_step(opt, steps.data());
  nlopt_set_min_objective(opt, objective, &run);
  if (evaluator.inequalities() > 0) {
    const Eigen::VectorXd tolerances = Eigen::VectorXd::Constant(evaluator.inequalities(), tolerance);
    nlopt_add_inequality_mconstraint(opt, static_cast<unsigned>(evaluator.inequalities()),
                                     constraints<&Evaluator::inequality, &Evaluator::inequality_jacobian>, &run,
                                     tolerances.data());
  }
  if (evaluator.equalities() > 0) {
    const Eigen::VectorXd tolerances = Eigen::VectorXd::Constant(evaluator.equalities(), tolerance);
    nlopt_add_equality_mconstraint(opt, static_cast<unsigned>(evaluator.equalities()),
                                   constraints<&Evaluator::equality, &Evaluator::equality_jacobian>, &run,
                                   tolerances.data());
  }
  nlopt_set_stopval(opt, -unbounded_size / evaluator.objective_unit());
  const bool cobyla = options_.algorithm == NloptAlgorithm::cobyla;
  nlopt_set_xtol_rel(opt, options_.xtol_rel.value_or(cobyla ? 1e-6 : 1e-8));
  nlopt_set_xtol_abs1(opt, options_.xtol_abs);
  nlopt_set_ftol_rel(opt, options_.ftol_rel);
  nlopt_set_maxeval(opt, static_cast<int>(options_.max_iterations));
  if (dual) {
    // MMA and CCSAQ are as feasible as their dual problem is solved. NLopt's default, a relative change of 1e-14 of the
    // dual value or 100'000 evaluations, leaves violations of 1e-5 on Hock-Schittkowski problem 43, and can take hours.
    nlopt_set_param(opt, "dual_maxeval", 1000);
    nlopt_set_param(opt, "dual_ftol_rel", 0.0);
    nlopt_set_param(opt, "dual_xtol_rel", 1e-14);
  }

  Eigen::VectorXd x = x0;
  double f = 0.0;
  nlopt_result code = nlopt_optimize(opt, x.data(), &f);
  if (dual) {
    // A short step may end MMA and CCSAQ outside of the constraints: from there they come closer.
    constexpr int most_runs = 5;
    for (int runs = 1; runs < most_runs && !run.ended && status_of(code) == Status::converged; ++runs) {
      if (evaluator.violation(x) <= evaluator.options().feasibility_tolerance) break;
      const Eigen::VectorXd before = x;
      code = nlopt_optimize(opt, x.data(), &f);
      if (x == before) break;
    }
  }
  run.parked.rethrow();
  if (run.ended) return {x, *run.ended, code, run.reason};
  Status status = status_of(code);
  if (options_.algorithm == NloptAlgorithm::slsqp) {
    x = end_of_slsqp(evaluator, x, run.last_iterate, status == Status::converged);
  }
  // Incompatible constraints show up as a failure of SLSQP's subproblem.
  if ((code == NLOPT_FAILURE || code == NLOPT_ROUNDOFF_LIMITED) &&
      evaluator.violation(x) > evaluator.options().feasibility_tolerance) {
    status = Status::infeasible;
  }
  return {x, status, code, sentence(opt, code)};
}

}  // namespace reprise
