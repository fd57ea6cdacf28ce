#include "reprise/optimizers/lfopc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "reprise/base/require.hpp"

namespace reprise {
namespace {

void validate(const LfopcOptions& options) {
  const auto positive = [](double value, const char* name) { require(value > 0.0, name, value, "positive"); };
  positive(options.penalty_first, "LFOPC option penalty_first");
  positive(options.penalty_second, "LFOPC option penalty_second");
  positive(options.relative_step_cap, "LFOPC option relative_step_cap");
  positive(options.gradient_tolerance, "LFOPC option gradient_tolerance");
  positive(options.feasibility_gradient_tolerance, "LFOPC option feasibility_gradient_tolerance");
  positive(options.relative_step_tolerance, "LFOPC option relative_step_tolerance");
  require(options.time_step_growth >= 0.0, "LFOPC option time_step_growth", options.time_step_growth, "at least 0");
  require(options.opposed_steps >= 1, "LFOPC option opposed_steps", options.opposed_steps, "at least 1");
  require(options.stall_steps >= 1, "LFOPC option stall_steps", options.stall_steps, "at least 1");
  require(options.max_steps >= 1, "LFOPC option max_steps", options.max_steps, "at least 1");
}

/// The scalar product, its sum formed in the order of Eigen's vectors of a size that is not known to the compiler: even
/// and odd entries on their own, from eight entries on every second pair of them on its own too.
template <int size>
double dot(const Eigen::Matrix<double, size, 1>& a, const Eigen::Matrix<double, size, 1>& b) {
  if constexpr (size == Eigen::Dynamic) {
    return a.dot(b);
  } else if constexpr (size == 1) {
    return a[0] * b[0];
  } else {
    const auto pair = [&](Eigen::Index i) { return Eigen::Array2d(a[i] * b[i], a[i + 1] * b[i + 1]); };
    constexpr Eigen::Index pairs = size / 2;
    Eigen::Array2d sum = pair(0);
    if constexpr (pairs > 1) {
      Eigen::Array2d second = pair(2);
      for (Eigen::Index k = 2; k + 1 < pairs; k += 2) {
        sum += pair(2 * k);
        second += pair(2 * k + 2);
      }
      sum += second;
      if constexpr (pairs % 2 == 1) sum += pair(2 * (pairs - 1));
    }
    const double result = sum[0] + sum[1];
    return size % 2 == 1 ? result + a[size - 1] * b[size - 1] : result;
  }
}

template <int size>
double length_of(const Eigen::Matrix<double, size, 1>& vector) {
  return std::sqrt(dot(vector, vector));
}

/// A sum of penalties: P over the penalty parameter, and what its gradient is made of, sum_j value_j (a_j + c_j t).
template <int size>
struct PenaltySum {
  double square = 0.0;  ///< sum of value_j^2
  double radial = 0.0;  ///< sum of c_j value_j
  Eigen::Matrix<double, size, 1> gradient;
};

/// Spherical quadratics as the particle meets them at each of its steps: four rows lie side by side, their values,
/// their curvatures, and their gradients coordinate by coordinate, so that one pass gives values, P and grad P.
template <int size>
class PackedRows {
 public:
  using Vector = Eigen::Matrix<double, size, 1>;

  PackedRows(Eigen::Index n, Eigen::Index capacity) : n_(n) {
    packed_.reserve(static_cast<std::size_t>((capacity + width - 1) / width * stride()));
    if constexpr (size == Eigen::Dynamic) sums_.resize(2, n);
  }

  Eigen::Index rows() const { return rows_; }

  /// Adds a row whose gradient is zero, to be set.
  void append(double value, double curvature) {
    if (rows_ % width == 0) packed_.resize(packed_.size() + static_cast<std::size_t>(stride()), 0.0);
    double* const row = of_row(rows_++);
    row[0] = value;
    row[width] = curvature;
  }
  double& last_gradient(Eigen::Index i) { return of_row(rows_ - 1)[(2 + i) * width]; }

  double curvature(Eigen::Index j) const { return of_row(j)[width]; }
  double gradient(Eigen::Index j, Eigen::Index i) const { return of_row(j)[(2 + i) * width]; }

  /// Copies a row of others.
  void append(const PackedRows& other, Eigen::Index j) {
    append(other.of_row(j)[0], other.curvature(j));
    for (Eigen::Index i = 0; i < n(); ++i) last_gradient(i) = other.gradient(j, i);
  }

  /// The value of row j at t.
  double value(Eigen::Index j, const Vector& t, double half_square) const {
    const double* const row = of_row(j);
    double product = row[2 * width] * t[0];
    for (Eigen::Index i = 1; i < n(); ++i) product += row[(2 + i) * width] * t[i];
    return row[0] + half_square * row[width] + product;
  }

  /// The sum over all rows at t, where half_square is |t|^2 / 2; one_sided: over those with positive values.
  template <bool one_sided>
  void sum(const Vector& t, double half_square, PenaltySum<size>& result) {
    using Four = Eigen::Array<double, width, 1>;
    Four squares = Four::Zero();
    Four radials = Four::Zero();
    sums_.setZero();
    const Eigen::Index blocks = rows_ / width;
    for (Eigen::Index block = 0; block < blocks; ++block) {
      const double* const first = packed_.data() + block * stride();
      const auto column = [first](Eigen::Index k) { return Eigen::Map<const Four>(first + k * width); };
      Four product = column(2) * t[0];
      for (Eigen::Index i = 1; i < n(); ++i) product += column(2 + i) * t[i];
      Four values = column(0) + half_square * column(1) + product;
      if constexpr (one_sided) {
        values = values.max(0.0);
        if (values.sum() == 0.0) continue;
      }
      squares += values * values;
      radials += column(1) * values;
      for (Eigen::Index i = 0; i < n(); ++i) {
        const Four forces = column(2 + i) * values;
        sums_.col(i) += forces.template head<2>();
        sums_.col(i) += forces.template tail<2>();
      }
    }
    // The last rows, which fill no block.
    Eigen::Array2d square = squares.template head<2>() + squares.template tail<2>();
    Eigen::Array2d radial = radials.template head<2>() + radials.template tail<2>();
    const auto last_value = [&](Eigen::Index j) {
      const double at_t = value(j, t, half_square);
      return one_sided ? std::max(at_t, 0.0) : at_t;
    };
    Eigen::Index j = blocks * width;
    if (j + 1 < rows_) {
      const Eigen::Array2d values(last_value(j), last_value(j + 1));
      square += values * values;
      radial += Eigen::Array2d(curvature(j), curvature(j + 1)) * values;
      for (Eigen::Index i = 0; i < n(); ++i)
        sums_.col(i) += Eigen::Array2d(gradient(j, i), gradient(j + 1, i)) * values;
      j += 2;
    }
    result.square = square.sum();
    result.radial = radial.sum();
    for (Eigen::Index i = 0; i < n(); ++i) result.gradient[i] = sums_(0, i) + sums_(1, i);
    if (j < rows_) {
      const double last = last_value(j);
      result.square += last * last;
      result.radial += curvature(j) * last;
      for (Eigen::Index i = 0; i < n(); ++i) result.gradient[i] += gradient(j, i) * last;
    }
  }

 private:
  static constexpr Eigen::Index width = 4;

  Eigen::Index n() const { return size == Eigen::Dynamic ? n_ : size; }
  Eigen::Index stride() const { return (2 + n()) * width; }
  double* of_row(Eigen::Index j) { return packed_.data() + j / width * stride() + j % width; }
  const double* of_row(Eigen::Index j) const { return packed_.data() + j / width * stride() + j % width; }

  Eigen::Index n_;
  Eigen::Index rows_ = 0;
  std::vector<double> packed_;
  Eigen::Array<double, 2, size> sums_;  ///< of the forces of even and of odd rows
};

/// The penalty function of a program, in the unit of the move limit (t = s / rho), so that the constants of the method
/// mean the same for any unit of length. Bounds and move limit join the inequalities.
template <int size>
class Penalty {
 public:
  using Vector = Eigen::Matrix<double, size, 1>;

  explicit Penalty(const SphericalProgram& program)
      : n_(program.lower.size()),
        inequality_(n_, program.inequality.size() + 2 * n_ + 1),
        equality_(n_, program.equality.size()) {
    const double rho = program.move_limit;
    objective_value_ = program.objective.value[0];
    objective_curvature_ = program.objective.curvature[0] * rho * rho;
    objective_gradient_ = program.objective.gradient.row(0).transpose() * rho;
    for (Eigen::Index k = 0; k < program.equality.size(); ++k) append_scaled(program.equality, k, rho, equality_);

    // An inequality that cannot be violated within three move limits plays no part; the penalties keep the particle
    // well inside of that.
    constexpr double reach = 3.0;
    const SphericalQuadratics& all = program.inequality;
    for (Eigen::Index j = 0; j < all.size(); ++j) {
      const double highest = all.value[j] + (all.gradient.row(j) * rho).norm() * reach +
                             0.5 * std::max(all.curvature[j] * rho * rho, 0.0) * reach * reach;
      if (!(highest < 0.0)) append_scaled(all, j, rho, inequality_);
    }
    // The finite bounds, lower - s <= 0 and s - upper <= 0, and the move limit, rho (|t|^2 - 1) <= 0.
    const auto append_bound = [&](double value, Eigen::Index i, double slope) {
      if (!std::isfinite(value) || value + rho * reach < 0.0) return;
      inequality_.append(value, 0.0);
      inequality_.last_gradient(i) = slope;
    };
    for (Eigen::Index i = 0; i < n_; ++i) {
      append_bound(program.lower[i], i, -rho);
      append_bound(-program.upper[i], i, rho);
    }
    inequality_.append(-rho, 2.0 * rho);
    sum_.gradient.resize(n_);
  }

  Eigen::Index n() const { return n_; }
  bool with_objective() const { return with_objective_; }
  void set_penalty(double penalty) { penalty_ = penalty; }

  /// Phase 2: of the inequalities only the active ones stay, and count on both sides as the equalities do; the
  /// objective is dropped. Active are those violated at t. When they are many (a curve of constraints, sampled) they
  /// cannot all hold with equality; then those stay that carry the force: one after the other the one whose force has
  /// the largest part orthogonal to the gradients of those that stay already.
  void keep_active_only(const Vector& t) {
    constexpr double smallest_angle = 0.1;  // of a gradient to the span of the others, radians
    const double half_square = 0.5 * dot(t, t);
    std::vector<Eigen::Index> violated;
    std::vector<double> violations;
    for (Eigen::Index j = 0; j < inequality_.rows(); ++j) {
      const double value = inequality_.value(j, t, half_square);
      if (!(value > 0.0)) continue;
      violated.push_back(j);
      violations.push_back(value);
    }
    const auto count = static_cast<Eigen::Index>(violated.size());
    Eigen::MatrixXd gradients(count, n_);
    for (Eigen::Index row = 0; row < count; ++row) {
      gradients.row(row) = gradient_of(inequality_, violated[static_cast<std::size_t>(row)], t).transpose();
    }
    const Eigen::VectorXd lengths = gradients.rowwise().norm();
    const auto remove_direction = [&gradients](const Eigen::VectorXd& unit) {
      gradients -= (gradients * unit) * unit.transpose();
    };
    Eigen::Index rank = 0;
    for (Eigen::Index k = 0; k < equality_.rows() && rank < n(); ++k, ++rank) {
      const Eigen::VectorXd normal = gradient_of(equality_, k, t);
      if (normal.norm() > 0.0) remove_direction(normal.normalized());
    }
    PackedRows<size> active(n_, n_);
    std::vector<bool> taken(violated.size(), false);
    for (; rank < n(); ++rank) {
      Eigen::Index strongest = -1;
      double largest_force = 0.0;
      for (Eigen::Index row = 0; row < count; ++row) {
        if (taken[static_cast<std::size_t>(row)]) continue;
        const double length = gradients.row(row).norm();
        const double force = violations[static_cast<std::size_t>(row)] * length;
        if (length > smallest_angle * lengths[row] && force > largest_force) {
          largest_force = force;
          strongest = row;
        }
      }
      if (strongest < 0) break;
      taken[static_cast<std::size_t>(strongest)] = true;
      active.append(inequality_, violated[static_cast<std::size_t>(strongest)]);
      remove_direction(gradients.row(strongest).transpose().normalized());
    }
    inequality_ = std::move(active);
    with_objective_ = false;
  }

  /// P(t), and its gradient.
  double evaluate(const Vector& t, Vector& gradient) {
    const double half_square = 0.5 * dot(t, t);
    if (with_objective_) {
      inequality_.template sum<true>(t, half_square, sum_);
    } else {
      inequality_.template sum<false>(t, half_square, sum_);
    }
    double square = sum_.square;
    // The gradient of a spherical quadratic is a + c t: the second parts are gathered in one factor of t.
    double radial = sum_.radial;
    gradient = 2.0 * penalty_ * sum_.gradient;
    if (equality_.rows() > 0) {
      equality_.template sum<false>(t, half_square, sum_);
      square += sum_.square;
      radial += sum_.radial;
      gradient += 2.0 * penalty_ * sum_.gradient;
    }
    double value = penalty_ * square;
    radial *= 2.0 * penalty_;
    if (with_objective_) {
      double slope = objective_gradient_[0] * t[0];
      for (Eigen::Index i = 1; i < n(); ++i) slope += objective_gradient_[i] * t[i];
      value += objective_value_ + slope + objective_curvature_ * half_square;
      gradient += objective_gradient_;
      radial += objective_curvature_;
    }
    gradient += radial * t;
    return value;
  }

 private:
  static void append_scaled(const SphericalQuadratics& functions, Eigen::Index j, double rho, PackedRows<size>& rows) {
    rows.append(functions.value[j], functions.curvature[j] * rho * rho);
    for (Eigen::Index i = 0; i < functions.gradient.cols(); ++i) rows.last_gradient(i) = functions.gradient(j, i) * rho;
  }

  Eigen::VectorXd gradient_of(const PackedRows<size>& rows, Eigen::Index j, const Vector& t) const {
    return Eigen::VectorXd::NullaryExpr(n_,
                                        [&](Eigen::Index i) { return rows.gradient(j, i) + rows.curvature(j) * t[i]; });
  }

  Eigen::Index n_;
  PackedRows<size> inequality_, equality_;
  double objective_value_, objective_curvature_;
  Vector objective_gradient_;
  bool with_objective_ = true;
  double penalty_ = 1.0;
  PenaltySum<size> sum_;
};

/// LFOP1(b) with the safeguard: moves t to a minimum of the penalty function; returns the steps taken.
template <int size>
long follow_trajectory(Penalty<size>& penalty, const LfopcOptions& options, double gradient_tolerance,
                       Eigen::Matrix<double, size, 1>& t) {
  using Vector = Eigen::Matrix<double, size, 1>;
  const Eigen::Index n = penalty.n();
  Vector velocity = Vector::Zero(n);
  Vector gradient(n);
  Vector next(n);
  Vector next_gradient(n);
  Vector next_velocity(n);

  double lowest = penalty.evaluate(t, gradient);
  Vector lowest_t = t;
  Vector lowest_gradient = gradient;
  double step_cap = options.relative_step_cap * std::sqrt(static_cast<double>(n));
  const double force = length_of(gradient);
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
    const double length = length_of(velocity) * time_step;
    if (length > step_cap) velocity *= step_cap / length;
    next = t + velocity * time_step;
    const double value = penalty.evaluate(next, next_gradient);

    if (value < lowest) {
      lowest = value;
      lowest_t = next;
      lowest_gradient = next_gradient;
      without_new_lowest = 0;
      if (length_of(next_gradient) <= gradient_tolerance) break;
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

    if (dot(next_gradient, gradient) > 0.0) {
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
    if (dot(next_velocity, next_velocity) > dot(velocity, velocity)) {
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

/// All three phases.
template <int size>
LfopcResult minimize(const SphericalProgram& program, const LfopcOptions& options) {
  using Vector = Eigen::Matrix<double, size, 1>;
  Penalty<size> penalty(program);
  Vector t = Vector::Zero(penalty.n());
  long steps = 0;
  penalty.set_penalty(options.penalty_first);
  steps += follow_trajectory(penalty, options, options.gradient_tolerance, t);
  penalty.set_penalty(options.penalty_second);
  steps += follow_trajectory(penalty, options, options.gradient_tolerance, t);
  penalty.keep_active_only(t);
  steps += follow_trajectory(penalty, options, options.feasibility_gradient_tolerance, t);
  return {t * program.move_limit, steps};
}

}  // namespace

LfopcResult lfopc(const SphericalProgram& program, const LfopcOptions& options) {
  validate(options);
  switch (program.lower.size()) {
    case 1:
      return minimize<1>(program, options);
    case 2:
      return minimize<2>(program, options);
    case 3:
      return minimize<3>(program, options);
    case 4:
      return minimize<4>(program, options);
    case 5:
      return minimize<5>(program, options);
    case 6:
      return minimize<6>(program, options);
    case 7:
      return minimize<7>(program, options);
    case 8:
      return minimize<8>(program, options);
    case 9:
      return minimize<9>(program, options);
    case 10:
      return minimize<10>(program, options);
    default:
      return minimize<Eigen::Dynamic>(program, options);
  }
}

}  // namespace reprise
