#include "reprise/optimizers/lfopc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace reprise {
namespace {

void require(bool allowed, const char* name, double value, const char* range) {
  if (!allowed) {
    throw std::invalid_argument(std::string("LFOPC option ") + name + " is " + std::to_string(value) +
                                ", but it must be " + range);
  }
}

void validate(const LfopcOptions& options) {
  const auto positive = [](double value, const char* name) { require(value > 0.0, name, value, "positive"); };
  positive(options.penalty_first, "penalty_first");
  positive(options.penalty_second, "penalty_second");
  positive(options.relative_step_cap, "relative_step_cap");
  positive(options.gradient_tolerance, "gradient_tolerance");
  positive(options.feasibility_gradient_tolerance, "feasibility_gradient_tolerance");
  positive(options.relative_step_tolerance, "relative_step_tolerance");
  require(options.time_step_growth >= 0.0, "time_step_growth", options.time_step_growth, "at least 0");
  require(options.opposed_steps >= 1, "opposed_steps", options.opposed_steps, "at least 1");
  require(options.stall_steps >= 1, "stall_steps", options.stall_steps, "at least 1");
  require(options.max_steps >= 1, "max_steps", options.max_steps, "at least 1");
}

/// The penalty function of a program, in the unit of the move limit (t = s / rho), so that the constants of the method
/// mean the same for any unit of length. Bounds and move limit join the inequalities.
class Penalty {
 public:
  explicit Penalty(const SphericalProgram& program) : n_(program.lower.size()) {
    const double rho = program.move_limit;
    objective_ = scaled(program.objective, rho);
    equality_ = scaled(program.equality, rho);
    SphericalQuadratics all = scaled(program.inequality, rho);
    append_bounds(program, all);

    // An inequality that cannot be violated within three move limits plays no part; the penalties keep the particle
    // well inside of that.
    constexpr double reach = 3.0;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index j = 0; j < all.size(); ++j) {
      const double highest =
          all.value[j] + all.gradient.row(j).norm() * reach + 0.5 * std::max(all.curvature[j], 0.0) * reach * reach;
      if (!(highest < 0.0)) kept.push_back(j);
    }
    inequality_ = rows_of(all, kept);
    inequality_values_.resize(inequality_.size());
    equality_values_.resize(equality_.size());
  }

  Eigen::Index n() const { return n_; }
  bool with_objective() const { return with_objective_; }
  void set_penalty(double penalty) { penalty_ = penalty; }

  /// Phase 2: of the inequalities only the active ones stay, and count on both sides as the equalities do; the
  /// objective is dropped. Active are those violated at t. When they are many (a curve of constraints, sampled) they
  /// cannot all hold with equality; then those stay that carry the force: one after the other the one whose force has
  /// the largest part orthogonal to the gradients of those that stay already.
  void keep_active_only(const Eigen::VectorXd& t) {
    evaluate_constraints(t);
    constexpr double smallest_angle = 0.1;  // of a gradient to the span of the others, radians
    Eigen::MatrixXd gradients = inequality_.gradient + inequality_.curvature * t.transpose();
    const Eigen::VectorXd lengths = gradients.rowwise().norm();
    const auto remove_direction = [&gradients](const Eigen::VectorXd& unit) {
      gradients -= (gradients * unit) * unit.transpose();
    };
    Eigen::Index rank = 0;
    for (Eigen::Index k = 0; k < equality_.size() && rank < n(); ++k, ++rank) {
      const Eigen::VectorXd normal = equality_.gradient.row(k).transpose() + equality_.curvature[k] * t;
      if (normal.norm() > 0.0) remove_direction(normal.normalized());
    }
    std::vector<Eigen::Index> active;
    std::vector<bool> taken(static_cast<std::size_t>(inequality_.size()), false);
    for (; rank < n(); ++rank) {
      Eigen::Index strongest = -1;
      double largest_force = 0.0;
      for (Eigen::Index j = 0; j < inequality_.size(); ++j) {
        if (taken[static_cast<std::size_t>(j)] || !(inequality_values_[j] > 0.0)) continue;
        const double length = gradients.row(j).norm();
        const double force = inequality_values_[j] * length;
        if (length > smallest_angle * lengths[j] && force > largest_force) {
          largest_force = force;
          strongest = j;
        }
      }
      if (strongest < 0) break;
      taken[static_cast<std::size_t>(strongest)] = true;
      active.push_back(strongest);
      remove_direction(gradients.row(strongest).transpose().normalized());
    }
    inequality_ = rows_of(inequality_, active);
    inequality_values_.resize(inequality_.size());
    with_objective_ = false;
  }

  /// P(t), and its gradient.
  double evaluate(const Eigen::VectorXd& t, Eigen::VectorXd& gradient) {
    evaluate_constraints(t);
    if (with_objective_) inequality_values_ = inequality_values_.cwiseMax(0.0);
    double value = penalty_ * (inequality_values_.squaredNorm() + equality_values_.squaredNorm());
    // The gradient of a spherical quadratic is a + c t: the second parts are gathered in one factor of t.
    double radial =
        2.0 * penalty_ * (inequality_.curvature.dot(inequality_values_) + equality_.curvature.dot(equality_values_));
    gradient.noalias() = 2.0 * penalty_ * (inequality_.gradient.transpose() * inequality_values_);
    gradient.noalias() += 2.0 * penalty_ * (equality_.gradient.transpose() * equality_values_);
    if (with_objective_) {
      value +=
          objective_.value[0] + objective_.gradient.row(0).dot(t) + 0.5 * objective_.curvature[0] * t.squaredNorm();
      gradient += objective_.gradient.row(0).transpose();
      radial += objective_.curvature[0];
    }
    gradient += radial * t;
    return value;
  }

 private:
  static SphericalQuadratics scaled(const SphericalQuadratics& functions, double rho) {
    return {functions.value, functions.gradient * rho, functions.curvature * rho * rho};
  }

  static SphericalQuadratics rows_of(const SphericalQuadratics& functions, const std::vector<Eigen::Index>& rows) {
    return {functions.value(rows), functions.gradient(rows, Eigen::all), functions.curvature(rows)};
  }

  /// Adds the finite bounds, lower - s <= 0 and s - upper <= 0, and the move limit, rho (|t|^2 - 1) <= 0.
  static void append_bounds(const SphericalProgram& program, SphericalQuadratics& inequalities) {
    const double rho = program.move_limit;
    const Eigen::Index n = program.lower.size();
    Eigen::Index row = inequalities.size();
    const auto extend = [&](Eigen::Index rows) {
      inequalities.value.conservativeResize(rows);
      inequalities.gradient.conservativeResize(rows, n);
      inequalities.curvature.conservativeResize(rows);
    };
    extend(row + 2 * n + 1);
    const auto append = [&](double value, const Eigen::VectorXd& gradient, double curvature) {
      inequalities.value[row] = value;
      inequalities.gradient.row(row) = gradient.transpose();
      inequalities.curvature[row] = curvature;
      ++row;
    };
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::VectorXd along = rho * Eigen::VectorXd::Unit(n, i);
      if (std::isfinite(program.lower[i])) append(program.lower[i], -along, 0.0);
      if (std::isfinite(program.upper[i])) append(-program.upper[i], along, 0.0);
    }
    append(-rho, Eigen::VectorXd::Zero(n), 2.0 * rho);
    extend(row);
  }

  void evaluate_constraints(const Eigen::VectorXd& t) {
    const double half_square = 0.5 * t.squaredNorm();
    inequality_values_ = inequality_.value + half_square * inequality_.curvature;
    inequality_values_.noalias() += inequality_.gradient * t;
    equality_values_ = equality_.value + half_square * equality_.curvature;
    equality_values_.noalias() += equality_.gradient * t;
  }

  Eigen::Index n_;
  SphericalQuadratics objective_, inequality_, equality_;
  bool with_objective_ = true;
  double penalty_ = 1.0;
  Eigen::VectorXd inequality_values_, equality_values_;
};

/// LFOP1(b) with the safeguard: moves t to a minimum of the penalty function; returns the steps taken.
long follow_trajectory(Penalty& penalty, const LfopcOptions& options, double gradient_tolerance, Eigen::VectorXd& t) {
  const Eigen::Index n = penalty.n();
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd gradient(n);
  Eigen::VectorXd next(n);
  Eigen::VectorXd next_gradient(n);
  Eigen::VectorXd next_velocity(n);

  double lowest = penalty.evaluate(t, gradient);
  Eigen::VectorXd lowest_t = t;
  Eigen::VectorXd lowest_gradient = gradient;
  double step_cap = options.relative_step_cap * std::sqrt(static_cast<double>(n));
  const double force = gradient.norm();
  if (!(force > gradient_tolerance)) return 0;
  double time_step = std::sqrt(step_cap / (5.0 * force));
  // A sum of squares that can vanish does so, to first order, at the distance 2 P / |grad P| down its gradient: a
  // longer first step would only have to come back.
  if (!penalty.with_objective()) time_step = std::min(time_step, std::sqrt(2.0 * lowest) / force);
  double growth = 1.0;
  int opposed = 0;
  int without_new_lowest = 0;

  long steps = 0;
  while (steps < options.max_steps) {
    ++steps;
    // Leap-frog: the velocity is that of the half step.
    velocity -= gradient * time_step;
    const double length = velocity.norm() * time_step;
    if (length > step_cap) velocity *= step_cap / length;
    next = t + velocity * time_step;
    const double value = penalty.evaluate(next, next_gradient);

    if (value < lowest) {
      lowest = value;
      lowest_t = next;
      lowest_gradient = next_gradient;
      without_new_lowest = 0;
      if (next_gradient.norm() <= gradient_tolerance) break;
    } else if (++without_new_lowest >= options.stall_steps) {
      step_cap *= 0.5;
      if (step_cap < options.relative_step_tolerance) break;
      time_step *= 0.5;
      growth = 1.0;
      opposed = 0;
      without_new_lowest = 0;
      t = lowest_t;
      gradient = lowest_gradient;
      velocity.setZero();
      continue;
    }

    if (next_gradient.dot(gradient) > 0.0) {
      opposed = 0;
      growth += options.time_step_growth;
      time_step *= growth;
    } else {
      growth = 1.0;
      if (++opposed >= options.opposed_steps) {
        opposed = 0;
        time_step *= 0.5;
      }
    }
    next_velocity = velocity - next_gradient * time_step;
    if (next_velocity.squaredNorm() > velocity.squaredNorm()) {
      t.swap(next);
      gradient.swap(next_gradient);
    } else {
      // Uphill: back to the middle, with a quarter of the two speeds.
      t = 0.5 * (t + next);
      velocity = 0.25 * (velocity + next_velocity);
      penalty.evaluate(t, gradient);
    }
  }
  t = lowest_t;
  return steps;
}

}  // namespace

LfopcResult lfopc(const SphericalProgram& program, const LfopcOptions& options) {
  validate(options);
  Penalty penalty(program);
  Eigen::VectorXd t = Eigen::VectorXd::Zero(penalty.n());
  long steps = 0;
  penalty.set_penalty(options.penalty_first);
  steps += follow_trajectory(penalty, options, options.gradient_tolerance, t);
  penalty.set_penalty(options.penalty_second);
  steps += follow_trajectory(penalty, options, options.gradient_tolerance, t);
  penalty.keep_active_only(t);
  steps += follow_trajectory(penalty, options, options.feasibility_gradient_tolerance, t);
  return {t * program.move_limit, steps};
}

}  // namespace reprise
