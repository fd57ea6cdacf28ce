#pragma once

// The numbers that decide, in one table with their reasons: those that all solvers share, and those by which an end is
// judged. What a caller may want to choose is an option instead (solver.hpp and the solvers' own headers).

namespace reprise {

// ---- Ends of a run ----

/// A claim of success is not believed at a point with a larger residual (kkt_residual.hpp): the run goes on from there
/// as from a new start, until it leads no further, and then ends as Status::not_stationary. A solver whose own
/// tolerance is looser than this keeps it only with Options::check_stationarity false. On the standard problems and on
/// random quadratic programs right ends have residuals well below it, and wrong ones are well above.
inline constexpr double largest_kkt_residual = 1e-3;

/// How often a run goes on from an end that is no optimum. Where a restart helps, one or two are enough on all standard
/// problems; more only repeat what failed.
inline constexpr int most_restarts = 5;

/// An f below its negative, or an |x| above it, is called unbounded. It is far outside of what a problem in sensible
/// units has, and its square is still finite.
inline constexpr double unbounded_size = 1e20;

/// A derivative is wrong when it differs from central differences by more than this, relative to max(1, largest entry).
/// Central differences with the step eps^(1/3) err by about eps^(2/3) = 4e-11 for functions of size and curvature 1,
/// which leaves room for curvatures of some thousands.
inline constexpr double derivative_tolerance = 1e-6;

/// The order of a Taylor remainder is 2 for a right gradient and 1 for a wrong one; terms of higher order shift what is
/// observed by about a tenth.
inline constexpr double least_remainder_order = 1.8;

/// A variable within this of a bound, in its unit, is reported to be at it. Interior-point methods end that near to
/// active bounds, and not at them.
inline constexpr double active_bound_tolerance = 1e-6;

// ---- Units ----

/// A gradient at the start below this, in the units of the variables, leaves the unit of f alone: there rounding would
/// become the unit.
inline constexpr double least_slope = 1e-9;

// ---- The conditions of optimality (kkt_residual.hpp), in units of the gradient's length and of the variables ----

/// A residual below this part of the gradient is not made smaller: it says "optimal" a thousand times over.
inline constexpr double small_kkt_residual = 1e-6;

/// Constraints are let in by their distance, first those that are within 1e-6, then a hundred times as far, up to a
/// whole unit: of thousands of neighbours on a curve the active ones say it all, and the others only make it slow.
inline constexpr double nearest_constraints = 1e-6;
inline constexpr double constraints_step_outwards = 100.0;  ///< from one distance to the next
inline constexpr double farthest_constraints = 1.0;         ///< the last distance

/// The step along which the curvature of the Lagrangian is taken: its differences keep half of the digits.
inline constexpr double curvature_step = 1e-4;

}  // namespace reprise
