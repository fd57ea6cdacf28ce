#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/workspace/point_solver.hpp"

namespace reprise {
namespace {

/// A curve of positions with its derivative.
struct Place {
  Eigen::Vector2d position;
  Eigen::Vector2d derivative;
};

/// min or max of x^2 (sign = +1 or -1) over one variable in [0, upper], subject to h_j / d <= 0 along a curve.
Problem make_problem(LimitEvaluator& limits, const char* name, double sign, double upper, double chord,
                     const std::function<Place(double)>& curve) {
  Problem problem;
  problem.name = name;
  problem.n = 1;
  problem.lower = Eigen::VectorXd::Zero(1);
  problem.upper = Eigen::VectorXd::Constant(1, upper);
  problem.objective = [sign](const Eigen::VectorXd& x) { return sign * x[0] * x[0]; };
  problem.objective_gradient = [sign](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    gradient[0] = 2.0 * sign * x[0];
  };
  problem.inequalities = limits.limits().count();
  problem.inequality = [&limits, chord, curve](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    limits.largest(curve(x[0]).position);
    g = limits.values() / chord;
  };
  problem.inequality_jacobian =
      dense_jacobian([&limits, chord, curve](const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) {
        const Place place = curve(x[0]);
        for (Eigen::Index j = 0; j < jacobian.rows(); ++j) {
          jacobian(j, 0) = limits.gradient(place.position, j).dot(place.derivative) / chord;
        }
      });
  return problem;
}

}  // namespace

OptimizerPointSolver::OptimizerPointSolver(const Solver& solver, Options options)
    : solver_(solver), options_(std::move(options)) {}

Options OptimizerPointSolver::default_options() {
  Options options;
  options.feasibility_tolerance = 1e-8;
  options.max_function_evaluations = 1000;
  options.record_history = false;
  options.check_stationarity = false;
  return options;
}

double OptimizerPointSolver::attainable(double tolerance, double chord) const {
  return std::max(tolerance, 10.0 * options_.feasibility_tolerance * chord);
}

SolvedPoint OptimizerPointSolver::solve_ray(LimitEvaluator& limits, const RayProblem& ray, double tolerance) const {
  const auto curve = [&ray](double x) {
    return Place{ray.start + x * ray.chord * ray.direction, ray.chord * ray.direction};
  };
  const double reach = ray.reach / ray.chord;
  const Problem problem = make_problem(limits, "ray (5.17)", -1.0, reach, ray.chord, curve);
  std::string message;
  for (const double start : {1.0, 0.1 * reach, 0.25 * reach, 0.5 * reach}) {
    const Result result = solver_.minimize(problem, Eigen::VectorXd::Constant(1, start), options_);
    const Eigen::Vector2d position = curve(result.x[0]).position;
    if (std::abs(limits.largest(position)) <= attainable(tolerance, ray.chord)) {
      return {SolvedPoint::Outcome::found, position, {}};
    }
    if (message.empty()) message = solver_.name() + ": " + result.message;
  }
  return {.message = message};
}

SolvedPoint OptimizerPointSolver::solve_chord(LimitEvaluator& limits, const ChordProblem& chord,
                                              double tolerance) const {
  const auto at = [&chord](double angle) -> Eigen::Vector2d {
    return chord.point + chord.chord * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  double psi = chord.outward;
  for (int turns = 0; turns < 3 && limits.largest(at(psi)) <= 0.0; ++turns) psi -= 0.25 * pi;
  const auto curve = [&](double w) {
    const Eigen::Vector2d across(-std::sin(psi + w), std::cos(psi + w));
    return Place{at(psi + w), chord.chord * across};
  };
  const Problem problem = make_problem(limits, "chord (5.19)", 1.0, 2.0 * pi, chord.chord, curve);
  const double expected = chord.predicted - psi;
  const std::array<double, 5> starts = {0.0, expected, 0.5 * pi, pi, 1.5 * pi};
  double nearest = std::numeric_limits<double>::infinity();
  std::string message;
  for (const double start : starts) {
    const Result result = solver_.minimize(problem, Eigen::VectorXd::Constant(1, start), options_);
    const double w = result.x[0];
    if (std::abs(limits.largest(at(psi + w))) <= attainable(tolerance, chord.chord)) {
      nearest = std::min(nearest, w);
      if (nearest <= expected + 0.25 * pi) break;
    } else if (message.empty()) {
      message = solver_.name() + ": " + result.message;
    }
  }
  if (!std::isfinite(nearest)) return {.message = message};
  return {SolvedPoint::Outcome::found, at(psi + nearest), {}};
}

SolvedPoint OptimizerPointSolver::solve_bifurcation(LimitEvaluator& limits, const BifurcationProblem& bifurcation,
                                                    double tolerance) const {
  constexpr int max_rounds = 4;
  const std::array<Eigen::Index, 2> pair = {bifurcation.first, bifurcation.second};
  const auto residual_at = [&](const Eigen::Vector2d& u) {
    limits.largest(u);
    return std::max(std::abs(limits.values()[pair[0]]), std::abs(limits.values()[pair[1]]));
  };
  Eigen::Vector2d origin = bifurcation.start;
  double unit = bifurcation.chord;
  double residual = std::numeric_limits<double>::infinity();
  const auto at = [&](const Eigen::VectorXd& x) -> Eigen::Vector2d { return origin + unit * x; };
  Problem problem;
  problem.name = "bifurcation point (5.20)";
  problem.n = 2;
  problem.objective = [&](const Eigen::VectorXd& x) {
    limits.largest(at(x));
    double sum = 0.0;
    for (const Eigen::Index j : pair) sum += limits.values()[j] * limits.values()[j];
    return sum / (unit * unit);
  };
  problem.objective_gradient = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    const Eigen::Vector2d u = at(x);
    limits.largest(u);
    gradient.setZero();
    for (const Eigen::Index j : pair) gradient += 2.0 / unit * limits.values()[j] * limits.gradient(u, j);
  };
  std::string message;
  // A sum of squares is flat at its minimum: a solver that stops by its value is far from it yet. In units of what is
  // left it goes on.
  for (int round = 0; round < max_rounds && residual > tolerance; ++round) {
    const Result result = solver_.minimize(problem, Eigen::VectorXd::Zero(2), options_);
    const Eigen::Vector2d u = at(result.x);
    const double left = residual_at(u);
    if (!(left < residual)) break;
    message = result.message;
    origin = u;
    residual = unit = left;
  }
  if (residual <= attainable(tolerance, bifurcation.chord)) return {SolvedPoint::Outcome::found, origin, {}};
  return {.message = solver_.name() + ": " + message};
}

}  // namespace reprise
