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
  explicit Penalty(const SphericalProgram& program) : program_(program) {
    const double rho = program.move_limit;
    objective_ = scaled(program.objective, rho);
    equality_ = scaled(program.equality, rho);

    // An inequality that cannot be violated within three move limits plays no part; the penalties keep the particle
    // well inside of that.
    const SphericalQuadratics all = scaled(program.inequality, rho);
    constexpr double reach = 3.0;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index j = 0; j < all.size(); ++j) {
      const double highest =
          all.value[j] + all.gradient.row(j).norm() * reach + 0.5 * std::max(all.curvature[j], 0.0) * reach * reach;
      if (!(highest < 0.0)) kept.push_back(j);
    }
    inequality_.value = all.value(kept);
    inequality_.gradient = all.gradient(kept, Eigen::all);
    inequality_.curvature = all.curvature(kept);

    lower_ = program.lower / rho;
    upper_ = program.upper / rho;
    const Eigen::Index n = lower_.size();
    active_.setConstant(inequality_.size(), true);
    active_lower_.setConstant(n, true);
    active_upper_.setConstant(n, true);
    inequality_values_.resize(inequality_.size());
    inequality_forces_.resize(inequality_.size());
    equality_values_.resize(equality_.size());
  }

  Eigen::Index n() const { return lower_.size(); }

  void set_penalty(double penalty) { penalty_ = penalty; }

  /// Phase 2: the constraints violated at t count on both sides, as equalities do; the others and the objective are
  /// dropped.
  void keep_active_only(const Eigen::VectorXd& t) {
    evaluate_constraints(t);
    active_ = inequality_values_.array() > 0.0;
    active_lower_ = (lower_ - t).array() > 0.0;
    active_upper_ = (t - upper_).array() > 0.0;
    move_limit_active_ = t.squaredNorm() > 1.0;
    with_objective_ = false;
  }

  /// P(t), and its gradient.
  double evaluate(const Eigen::VectorXd& t, Eigen::VectorXd& gradient) {
    evaluate_constraints(t);
    double value = 0.0;
    gradient.setZero();
    double radial = 0.0;  // factor of t in the gradient: what the spheres add
    if (with_objective_) {
      value = objective_.value[0] + objective_.gradient.row(0).dot(t) + 0.5 * objective_.curvature[0] * t.squaredNorm();
      gradient = objective_.gradient.row(0).transpose();
      radial = objective_.curvature[0];
    }
    for (Eigen::Index j = 0; j < inequality_.size(); ++j) {
      inequality_forces_[j] = counted(inequality_values_[j], active_[j]);
    }
    value += penalty_ * inequality_forces_.squaredNorm();
    gradient.noalias() += 2.0 * penalty_ * (inequality_.gradient.transpose() * inequality_forces_);
    radial += 2.0 * penalty_ * inequality_.curvature.dot(inequality_forces_);

    value += penalty_ * equality_values_.squaredNorm();
    gradient.noalias() += 2.0 * penalty_ * (equality_.gradient.transpose() * equality_values_);
    radial += 2.0 * penalty_ * equality_.curvature.dot(equality_values_);

    const double rho = program_.move_limit;
    const double beyond = counted(rho * (t.squaredNorm() - 1.0), move_limit_active_);
    value += penalty_ * beyond * beyond;
    radial += 4.0 * penalty_ * beyond * rho;
    for (Eigen::Index i = 0; i < n(); ++i) {
      // An absent bound is infinitely far away, and counts as 0.
      const double below = counted(rho * (lower_[i] - t[i]), active_lower_[i]);
      const double above = counted(rho * (t[i] - upper_[i]), active_upper_[i]);
      value += penalty_ * (below * below + above * above);
      gradient[i] += 2.0 * penalty_ * rho * (above - below);
    }
    gradient += radial * t;
    return value;
  }

 private:
  /// What of an inequality's value the penalty sees: its violation, or in phase 2 all of it where the inequality is
  /// active.
  double counted(double value, bool active) const {
    if (with_objective_) return std::max(value, 0.0);
    return active ? value : 0.0;
  }

  static SphericalQuadratics scaled(const SphericalQuadratics& functions, double rho) {
    return {functions.value, functions.gradient * rho, functions.curvature * rho * rho};
  }

  void evaluate_constraints(const Eigen::VectorXd& t) {
    const double half_square = 0.5 * t.squaredNorm();
    inequality_values_ = inequality_.value + half_square * inequality_.curvature;
    inequality_values_.noalias() += inequality_.gradient * t;
    equality_values_ = equality_.value + half_square * equality_.curvature;
    equality_values_.noalias() += equality_.gradient * t;
  }

  const SphericalProgram& program_;
  SphericalQuadratics objective_, inequality_, equality_;
  Eigen::VectorXd lower_, upper_;
  Eigen::Array<bool, Eigen::Dynamic, 1> active_, active_lower_, active_upper_;
  bool move_limit_active_ = true;
  bool with_objective_ = true;
  double penalty_ = 1.0;
  Eigen::VectorXd inequality_values_, inequality_forces_, equality_values_;
};

/// LFOP1(b) with the safeguard: moves t to a minimum of the penalty function; returns the steps taken.
long follow_trajectory(Penalty& penalty, const LfopcOptions& options, Eigen::VectorXd& t) {
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
  const auto natural_time_step = [&] { return std::sqrt(step_cap / (5.0 * gradient.norm())); };
  if (!(gradient.norm() > options.gradient_tolerance)) return 0;
  double time_step = natural_time_step();
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
      if (next_gradient.norm() <= options.gradient_tolerance) break;
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
  steps += follow_trajectory(penalty, options, t);
  penalty.set_penalty(options.penalty_second);
  steps += follow_trajectory(penalty, options, t);
  penalty.keep_active_only(t);
  steps += follow_trajectory(penalty, options, t);
  return {t * program.move_limit, steps};
}

}  // namespace reprise
