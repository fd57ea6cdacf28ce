#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reprise/base/constants.hpp"
#include "reprise/workspace/point_solver.hpp"

namespace reprise {
namespace {

/// A place on a ray or circle and the largest h there.
struct Sample {
  double place;
  double value;
};

/// Where the largest h, as a function of the place, is zero between an infeasible and a feasible sample.
template <class Function>
Sample find_root(Function&& function, Sample outside, Sample inside, double tolerance) {
  Sample best = std::abs(outside.value) < std::abs(inside.value) ? outside : inside;
  if (std::abs(best.value) <= tolerance) return best;
  const auto target = [&](double place) {
    const double value = function(place);
    if (std::abs(value) < std::abs(best.value)) best = {place, value};
    return std::abs(value) <= tolerance ? 0.0 : value;
  };
  const auto narrow_enough = [](double a, double b) {
    return std::abs(b - a) <= 2.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
  };
  std::uintmax_t iterations = 200;
  const Sample& low = outside.place < inside.place ? outside : inside;
  const Sample& high = outside.place < inside.place ? inside : outside;
  boost::math::tools::toms748_solve(target, low.place, high.place, low.value, high.value, narrow_enough, iterations);
  return best;
}

SolvedPoint accept(const Sample& sample, const Eigen::Vector2d& position, double tolerance) {
  // Rounding of the place alone may keep a limit from being met to the last digits.
  if (std::abs(sample.value) <= 100.0 * tolerance) return {SolvedPoint::Outcome::found, position, {}};
  return {SolvedPoint::Outcome::failed, position, "the limits jump at the boundary"};
}

}  // namespace

SolvedPoint BracketingPointSolver::solve_ray(LimitEvaluator& limits, const RayProblem& problem,
                                             double tolerance) const {
  const double lipschitz = limits.limits().lipschitz_constant();
  const double shortest_step = std::isfinite(lipschitz) ? 1e-3 * problem.chord : 0.25 * problem.chord;
  const auto at = [&](double r) -> Eigen::Vector2d { return problem.start + r * problem.direction; };
  const auto value = [&](double r) { return limits.largest(at(r)); };
  limits.begin_search();
  Sample here{0.0, value(0.0)};
  if (here.value > 0.0) return accept(here, at(0.0), tolerance);
  while (here.place <= problem.reach) {
    Sample next;
    next.place = here.place + std::max(-here.value / lipschitz, shortest_step);
    next.value = value(next.place);
    if (!std::isfinite(next.value)) return {.message = "a limit is not finite on the ray"};
    if (next.value > 0.0) {
      const Sample root = find_root(value, next, here, tolerance);
      return accept(root, at(root.place), tolerance);
    }
    here = next;
  }
  return {.message = "the ray does not leave the workspace within its reach"};
}

SolvedPoint BracketingPointSolver::solve_chord(LimitEvaluator& limits, const ChordProblem& problem,
                                               double tolerance) const {
  const double lipschitz = limits.limits().lipschitz_constant();
  const double shortest_step = std::isfinite(lipschitz) ? 0.01 : 0.1;
  const auto at = [&](double angle) -> Eigen::Vector2d {
    return problem.point + problem.chord * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  const auto value = [&](double angle) { return limits.largest(at(angle)); };
  limits.begin_search();

  const Sample predicted{problem.predicted, value(problem.predicted)};
  if (std::abs(predicted.value) <= tolerance) {
    constexpr double beside = 1e-3;
    if (value(predicted.place - beside) > 0.0 && value(predicted.place + beside) < 0.0) {
      return accept(predicted, at(predicted.place), tolerance);
    }
  } else if (std::abs(predicted.value) < 0.5 * problem.chord) {
    // The largest h falls by d per radian where the chord follows the boundary: go twice as far as that says.
    Sample other;
    other.place = predicted.place + 2.0 * predicted.value / problem.chord;
    other.value = value(other.place);
    if (std::isfinite(other.value) && (predicted.value > 0.0) != (other.value > 0.0)) {
      const bool predicted_outside = predicted.value > 0.0;
      const Sample root =
          find_root(value, predicted_outside ? predicted : other, predicted_outside ? other : predicted, tolerance);
      return accept(root, at(root.place), tolerance);
    }
  }

  const auto step = [&](double size) { return std::max(size / (lipschitz * problem.chord), shortest_step); };
  Sample here{problem.outward, value(problem.outward)};
  while (here.value <= 0.0) {
    here.place -= step(-here.value);
    if (here.place < problem.outward - 0.75 * pi) return {.message = "no direction leads out of the workspace"};
    here.value = value(here.place);
  }
  const double end = here.place + 2.0 * pi;
  while (here.place < end) {
    if (!std::isfinite(here.value)) return {.message = "a limit is not finite around a boundary point"};
    Sample next;
    next.place = here.place + step(here.value);
    next.value = value(next.place);
    if (next.value <= tolerance) {
      const Sample root = find_root(value, here, next, tolerance);
      return accept(root, at(root.place), tolerance);
    }
    here = next;
  }
  return {SolvedPoint::Outcome::no_feasible_direction, Eigen::Vector2d::Zero(), {}};
}

SolvedPoint BracketingPointSolver::solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& problem,
                                                     double tolerance) const {
  constexpr int max_steps = 60;
  Eigen::Vector2d u = problem.start;
  for (int k = 0; k <= max_steps; ++k) {
    limits.largest(u);
    const Eigen::Vector2d residual(limits.values()[problem.first], limits.values()[problem.second]);
    if (residual.cwiseAbs().maxCoeff() <= tolerance) return {SolvedPoint::Outcome::found, u, {}};
    const Eigen::Vector2d p = limits.gradient(u, problem.first);
    const Eigen::Vector2d q = limits.gradient(u, problem.second);
    const double determinant = p.x() * q.y() - p.y() * q.x();
    Eigen::Vector2d step(q.y() * residual[0] - p.y() * residual[1], p.x() * residual[1] - q.x() * residual[0]);
    step /= -determinant;
    if (!step.allFinite()) return {.message = "the two limits have parallel gradients"};
    const double length = step.norm();
    if (length > problem.chord) step *= problem.chord / length;
    u += step;
  }
  return {.message = "Newton's method did not converge"};
}

}  // namespace reprise
