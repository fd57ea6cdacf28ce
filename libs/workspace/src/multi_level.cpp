#include "reprise/workspace/multi_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "arm.hpp"
#include "reprise/base/require.hpp"

namespace reprise {
namespace {

/// w_max and w_min of the interval, in this order, as the constraints are.
constexpr std::array<std::size_t, 2> order_of_ends = {1, 0};

double middle_of(const Interval& interval) { return 0.5 * (interval.lower + interval.upper); }

/// dw/du of an end of an interval of orientations at which a limit is active.
Eigen::Vector2d end_gradient(const Manipulator& manipulator, const Eigen::Vector2d& u, double orientation,
                             const std::optional<Limit>& active) {
  if (!active) return Eigen::Vector2d::Zero();
  const Leg& leg = manipulator.leg(active->leg);
  const Pose pose{u, orientation};
  const double slope = orientation_slope(leg, active->kind, pose);
  if (slope == 0.0) return Eigen::Vector2d::Zero();
  return -limit_derivatives(leg, active->kind, leg_vector(leg, pose), orientation).gradient / slope;
}

}  // namespace

MultiLevelDextrousLimits::MultiLevelDextrousLimits(const Manipulator& manipulator, const Interval& orientations,
                                                   const OrientationSolver& solver)
    : OrientationRangeLimits(orientations),
      manipulator_(manipulator),
      solver_(solver),
      limits_(list_limits(manipulator)),
      arm_(longest_arm(manipulator)),
      fixed_{ConstantOrientationLimits(manipulator, orientations.upper),
             ConstantOrientationLimits(manipulator, orientations.lower)} {
  // Both ends of the range must be attained.
  box_ = fixed_[0].box().intersection(fixed_[1].box());
}

const Limit& MultiLevelDextrousLimits::limit(Eigen::Index j) const {
  return limits_[static_cast<std::size_t>(j) % limits_.size()];
}

double MultiLevelDextrousLimits::critical_orientation(const Eigen::Vector2d&, Eigen::Index j) const {
  return end_of(j) == 0 ? orientations().upper : orientations().lower;
}

MultiLevelDextrousLimits::Extremes MultiLevelDextrousLimits::solve(const Eigen::Vector2d& u) const {
  ++inner_solutions_;
  const auto found = solver_.solve(manipulator_, u, orientations(), inner_evaluations_);
  const double average = middle_of(orientations());
  Extremes extremes{u, {Extreme{average, Eigen::Vector2d::Zero()}, Extreme{average, Eigen::Vector2d::Zero()}}};
  if (!found) return extremes;
  for (std::size_t end = 0; end < 2; ++end) {
    const std::size_t side = order_of_ends[end];
    const double orientation = side == 1 ? found->interval.upper : found->interval.lower;
    extremes.ends[end] = {orientation, end_gradient(manipulator_, u, orientation, found->active[side])};
  }
  return extremes;
}

const MultiLevelDextrousLimits::Extremes& MultiLevelDextrousLimits::extremes_at(const Eigen::Vector2d& u) const {
  const auto known = std::find_if(known_.begin(), known_.end(), [&](const Extremes& one) { return one.position == u; });
  if (known != known_.end()) return *known;
  constexpr std::size_t most = 8;
  if (known_.size() < most) {
    known_.push_back(solve(u));
    return known_.back();
  }
  oldest_ = (oldest_ + 1) % most;
  return known_[oldest_] = solve(u);
}

void MultiLevelDextrousLimits::evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const {
  const Extremes& extremes = extremes_at(u);
  const std::array<double, 2> constraints = {orientations().upper - extremes.ends[0].orientation,
                                             extremes.ends[1].orientation - orientations().lower};
  for (Eigen::Index j = 0; j < count(); ++j) {
    const std::size_t end = end_of(j);
    const double w = extremes.ends[end].orientation;
    const Leg& leg = manipulator_.leg(limit(j).leg);
    h[j] = arm_ * constraints[end] + limit_value(leg, limit(j).kind, leg_vector(leg, {u, w}), w);
  }
}

Eigen::Vector2d MultiLevelDextrousLimits::gradient(const Eigen::Vector2d& u, Eigen::Index j) const {
  const std::size_t end = end_of(j);
  const Extreme& extreme = extremes_at(u).ends[end];
  const Leg& leg = manipulator_.leg(limit(j).leg);
  const Pose pose{u, extreme.orientation};
  const double slope = orientation_slope(leg, limit(j).kind, pose) + (end == 0 ? -arm_ : arm_);
  return limit_derivatives(leg, limit(j).kind, leg_vector(leg, pose), pose.orientation).gradient +
         slope * extreme.gradient;
}

std::optional<LimitPair> MultiLevelDextrousLimits::at_bifurcation(Eigen::Index p, Eigen::Index q) const {
  if (end_of(p) != end_of(q)) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(limits_.size());
  return LimitPair{&fixed_[end_of(p)], p % n, q % n};
}

std::string MultiLevelDextrousLimits::label(Eigen::Index j) const {
  return to_string(limit(j)) + (end_of(j) == 0 ? ", at the largest orientation" : ", at the smallest orientation");
}

double MultiLevelDextrousLimits::lipschitz_constant() const { return std::numeric_limits<double>::infinity(); }

// With L the longest arm, L w is as far from its true value as the limit that is active at w, or farther where that
// limit has a small slope.
double MultiLevelDextrousLimits::accuracy() const { return solver_.accuracy(manipulator_); }

GreatestDexterity find_greatest_dexterity(const Manipulator& manipulator, const Eigen::Vector2d& start,
                                          const Interval& expected, const OrientationSolver& orientation_solver,
                                          const Solver& solver) {
  require(start.allFinite(), "the start", start, "finite");
  GreatestDexterity greatest;
  const double arm = longest_arm(manipulator);
  const double average = middle_of(expected);
  const ConstantOrientationLimits at_average(manipulator, average);
  const auto at = [&](const Eigen::VectorXd& x) -> Eigen::Vector2d { return start + arm * x; };
  // Objective and gradient share the solution of (5.26) at a point.
  struct Solved {
    Eigen::Vector2d position;
    std::optional<OrientationEnds> ends;
  };
  std::optional<Solved> last;
  const auto solved_at = [&](const Eigen::Vector2d& u) -> const std::optional<OrientationEnds>& {
    if (!last || last->position != u) {
      last = Solved{u, orientation_solver.solve(manipulator, u, expected, greatest.inner_evaluations)};
    }
    return last->ends;
  };
  const auto violated = [&](const Eigen::Vector2d& u) {
    Eigen::VectorXd h(at_average.count());
    at_average.evaluate(u, h);
    Eigen::Index worst = 0;
    h.maxCoeff(&worst);
    return std::pair(h[worst], worst);
  };

  Problem problem;
  problem.name = "greatest dexterity (5.29)";
  problem.n = 2;
  problem.objective = [&](const Eigen::VectorXd& x) {
    const Eigen::Vector2d u = at(x);
    if (const auto& ends = solved_at(u)) return -std::pow(ends->interval.upper - ends->interval.lower, 2);
    return std::pow(violated(u).first / arm, 2);
  };
  problem.objective_gradient = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    const Eigen::Vector2d u = at(x);
    if (const auto& ends = solved_at(u)) {
      const Interval& w = ends->interval;
      gradient = -2.0 * arm * (w.upper - w.lower) *
                 (end_gradient(manipulator, u, w.upper, ends->active[1]) -
                  end_gradient(manipulator, u, w.lower, ends->active[0]));
    } else {
      const auto [violation, worst] = violated(u);
      gradient = 2.0 * violation / arm * at_average.gradient(u, worst);
    }
  };
  Options options;
  options.max_function_evaluations = dexterity_evaluations;
  greatest.result = solver.minimize(problem, Eigen::VectorXd::Zero(2), options);
  greatest.position = at(greatest.result.x);
  greatest.ends = solved_at(greatest.position);
  return greatest;
}

DextrousMap map_dextrous_workspace(const Manipulator& manipulator, const Interval& orientations, const Pose& start,
                                   const OrientationSolver& orientation_solver, const Solver& solver,
                                   const TraceOptions& options, const PointSolver& point_solver) {
  const MultiLevelDextrousLimits limits(manipulator, orientations, orientation_solver);
  DextrousMap map;
  map.assembled = fit_pose(manipulator, mean_lengths(manipulator), start);
  map.greatest =
      find_greatest_dexterity(manipulator, map.assembled.pose.position, orientations, orientation_solver, solver);
  map.boundary = trace_boundary(limits, map.greatest.position, options, point_solver);
  map.points = describe_boundary(map.boundary, limits);
  map.inner_solutions = limits.inner_solutions();
  map.inner_evaluations = limits.inner_evaluations();
  return map;
}

}  // namespace reprise
