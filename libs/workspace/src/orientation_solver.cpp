#include "reprise/workspace/orientation_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "arm.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/workspace/orientation_workspace.hpp"

namespace reprise {
namespace {

void check(const Eigen::Vector2d& u, const Interval& expected) {
  require(u.allFinite(), "the position", u, "finite");
  require(std::isfinite(expected.lower) && std::isfinite(expected.upper) && expected.lower <= expected.upper,
          "the expected interval, by its ends,", Eigen::Vector2d(expected.lower, expected.upper),
          "finite and in order");
}

/// The limits of a manipulator at a position, as functions of the orientation.
class LimitsOfOrientation {
 public:
  LimitsOfOrientation(const Manipulator& manipulator, const Eigen::Vector2d& u)
      : manipulator_(manipulator), u_(u), limits_(list_limits(manipulator)) {}

  Eigen::Index count() const { return static_cast<Eigen::Index>(limits_.size()); }
  double value(double w, Eigen::Index j) const {
    const Limit& limit = limits_[static_cast<std::size_t>(j)];
    const Leg& leg = manipulator_.leg(limit.leg);
    return limit_value(leg, limit.kind, leg_vector(leg, {u_, w}), w);
  }
  double slope(double w, Eigen::Index j) const {
    const Limit& limit = limits_[static_cast<std::size_t>(j)];
    return orientation_slope(manipulator_.leg(limit.leg), limit.kind, {u_, w});
  }

  struct Largest {
    double value;
    Limit limit;
  };
  Largest largest(double w) const {
    Largest result{-std::numeric_limits<double>::infinity(), {}};
    for (Eigen::Index j = 0; j < count(); ++j) {
      const double h = value(w, j);
      if (h > result.value) result = {h, limits_[static_cast<std::size_t>(j)]};
    }
    return result;
  }

 private:
  const Manipulator& manipulator_;
  Eigen::Vector2d u_;
  std::vector<Limit> limits_;
};

}  // namespace

std::optional<OrientationEnds> ClosedFormOrientationSolver::solve(const Manipulator& manipulator,
                                                                  const Eigen::Vector2d& u, const Interval& expected,
                                                                  std::size_t& evaluations) const {
  check(u, expected);
  const double average = 0.5 * (expected.lower + expected.upper);
  std::optional<Interval> nearest;
  double distance = std::numeric_limits<double>::infinity();
  for (const Interval& interval : orientation_workspace(manipulator, u)) {
    // The last of its repetitions that begins before w_ave, and the next.
    const double turns = 2.0 * pi * std::floor((average - interval.lower) / (2.0 * pi));
    for (const double shift : {turns, turns + 2.0 * pi}) {
      const Interval shifted{interval.lower + shift, interval.upper + shift};
      const double away = std::max({shifted.lower - average, average - shifted.upper, 0.0});
      if (away >= distance) continue;
      distance = away;
      nearest = shifted;
    }
  }
  if (!nearest) return std::nullopt;
  const LimitsOfOrientation limits(manipulator, u);
  OrientationEnds ends{{std::max(nearest->lower, average - pi), std::min(nearest->upper, average + pi)}, {}};
  evaluations += 2;
  if (ends.interval.lower == nearest->lower) ends.active[0] = limits.largest(nearest->lower).limit;
  if (ends.interval.upper == nearest->upper) ends.active[1] = limits.largest(nearest->upper).limit;
  if (nearest->upper - nearest->lower >= 2.0 * pi) {
    ends = {{average - pi, average + pi}, {}};
  }
  return ends;
}

OptimizerOrientationSolver::OptimizerOrientationSolver(const Solver& solver, Options options)
    : solver_(solver), options_(std::move(options)) {}

double OptimizerOrientationSolver::accuracy(const Manipulator& manipulator) const {
  return 10.0 * options_.feasibility_tolerance * longest_arm(manipulator);
}

std::optional<OrientationEnds> OptimizerOrientationSolver::solve(const Manipulator& manipulator,
                                                                 const Eigen::Vector2d& u, const Interval& expected,
                                                                 std::size_t& evaluations) const {
  check(u, expected);
  const LimitsOfOrientation limits(manipulator, u);
  const double arm = longest_arm(manipulator);
  const double tolerance = accuracy(manipulator);
  const double average = 0.5 * (expected.lower + expected.upper);

  // Minimises sign (x + offset)^2 over x in [lower, pi] with w = origin + side x, from x = start.
  const auto minimise = [&](double sign, double offset, double origin, double side, double lower, double start) {
    Problem problem;
    problem.name = "orientation (5.26)";
    problem.n = 1;
    problem.lower = Eigen::VectorXd::Constant(1, lower);
    problem.upper = Eigen::VectorXd::Constant(1, pi);
    problem.objective = [=](const Eigen::VectorXd& x) { return sign * (x[0] + offset) * (x[0] + offset); };
    problem.objective_gradient = [=](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
      gradient[0] = 2.0 * sign * (x[0] + offset);
    };
    problem.inequalities = limits.count();
    problem.inequality = [&, origin, side](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
      for (Eigen::Index j = 0; j < g.size(); ++j) g[j] = limits.value(origin + side * x[0], j) / arm;
    };
    problem.inequality_jacobian =
        dense_jacobian([&, origin, side](const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) {
          for (Eigen::Index j = 0; j < jacobian.rows(); ++j) {
            jacobian(j, 0) = side * limits.slope(origin + side * x[0], j) / arm;
          }
        });
    const Result result = solver_.minimize(problem, Eigen::VectorXd::Constant(1, start), options_);
    evaluations += static_cast<std::size_t>(result.counts.function_evaluations());
    return result.x[0];
  };
  struct End {
    double orientation;
    std::optional<Limit> active;
  };
  const auto accept = [&](double w, bool half_a_turn) -> std::optional<End> {
    ++evaluations;
    const LimitsOfOrientation::Largest largest = limits.largest(w);
    if (std::abs(largest.value) <= tolerance) return End{w, largest.limit};
    if (half_a_turn && largest.value < 0.0) return End{w, std::nullopt};
    return std::nullopt;
  };
  // An end close to w_ave, where the square has no slope, may be missed; it is the same for a w_ave farther away.
  const auto end = [&](double origin, double side, double start) {
    std::optional<End> found;
    for (const double offset : {0.0, 1.0}) {
      const double x = minimise(-1.0, offset, origin, side, 0.0, start);
      found = accept(origin + side * x, x >= pi - options_.feasibility_tolerance);
      if (found) break;
    }
    return found;
  };
  const auto joined = [](const std::optional<End>& lower, const std::optional<End>& upper) {
    std::optional<OrientationEnds> ends;
    if (lower && upper && lower->orientation <= upper->orientation) {
      ends = OrientationEnds{{lower->orientation, upper->orientation}, {lower->active, upper->active}};
    }
    return ends;
  };

  // (w - w_ave)^2 is stationary at w_ave, so that no search may begin there.
  constexpr double least_start = 0.01;
  const double start = std::clamp(0.5 * (expected.upper - expected.lower), least_start, pi);
  ++evaluations;
  if (limits.largest(average).value <= 0.0) return joined(end(average, -1.0, start), end(average, 1.0, start));
  // The nearest orientation that can be attained is found only roughly where it is close to w_ave, for the same reason.
  // It is then sought, as the far end is, from a w_ave beyond it.
  const double nearest = average + minimise(1.0, 0.0, average, 1.0, -pi, 0.0);
  const double away = nearest < average ? -1.0 : 1.0;
  constexpr double beyond = 0.5;
  const std::optional<End> near = end(nearest + away * beyond, -away, beyond);
  if (!near) return std::nullopt;
  const std::optional<End> far = end(near->orientation, away, start);
  return away > 0.0 ? joined(near, far) : joined(far, near);
}

}  // namespace reprise
