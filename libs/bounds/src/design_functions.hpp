#pragma once

// What is proved of a box of designs is proved of two kinds of functions of the design z = [q_1, q_2, q_3, y, r]
// (global_optimum.hpp), at a pose (u, phi) of the prescribed workspace: the slack of a leg's limit and the square of
// the condition number. Both are written once, for numbers and for enclosures of numbers.
//
// The vector of leg i is, with s = (-1, -1, 1) and p_i = (s_i r, 0),
//     v_i = u - (q_i, y) + s_i r (cos phi - 1, sin phi)                              in the world frame,
//     (X_i, Y_i) = R(-phi) (u - (q_i, y)) + s_i r (1 - cos phi, sin phi)            in the platform's.
// With k_i = X_i / Y_i, T_i = 1 + k_i^2 and w, the square of the factor of the Jacobian's third column,
//     kappa^2 = (3 + A w) (c + b / w) / 36,    A = 1 / T_1 + 1 / T_2 + 1 / T_3,
//     c = T_3 + ((4 + (k_1 + k_3)^2) T_2 + (4 + (k_2 + k_3)^2) T_1) / (k_1 - k_2)^2,
//     b = T_3 + ((k_1 - k_3)^2 T_2 + (k_2 - k_3)^2 T_1) / (k_1 - k_2)^2.
// For det J = (k_1 - k_2) 2 m / prod sqrt(T_i) up to its sign, with m^2 = w, and each column of J^-1 is the solution of
// three linear equations. Of the printed normalisation (conditioning.hpp) w = r^4, or (L r)^2 where L is given; of the
// homogeneous one w = 1, or (r / L)^2.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reprise/bounds/global_optimum.hpp"
#include "reprise/synthesis/synthesis_task.hpp"
#include "rigorous_arithmetic.hpp"
#include "small_linear_program.hpp"

namespace reprise::rigorous {

/// A design, or a box of them.
template <class Number>
using Variables = std::array<Number, most_variables>;

/// A function's value and its derivatives along the variables.
template <class Number>
struct WithGradient {
  Number value{};
  Variables<Number> gradient{};
};

template <class Number>
struct Rotation {
  Number cosine;
  Number sine;
  Number versine;  ///< 1 - cosine
};

/// An orientation with its rotation, enclosed and in floating point.
struct Orientation {
  explicit Orientation(double angle);

  template <class Number>
  const Rotation<Number>& rotation() const {
    if constexpr (std::is_same_v<Number, double>) {
      return rounded;
    } else {
      return enclosed;
    }
  }

  double angle;  ///< radians
  Rotation<Enclosure> enclosed;
  Rotation<double> rounded;
};

template <class Number>
struct Vector2 {
  Number x;
  Number y;
};

/// The designs of a task, their variables, and the orientations at which they are looked at.
class DesignFamily {
 public:
  /// Throws std::invalid_argument as prove_global_optimum does.
  DesignFamily(const SynthesisTask& task, BaseJoints base);

  int variables() const { return variables_; }
  int x_of(std::size_t leg) const { return static_cast<int>(leg); }
  int y_of(std::size_t leg) const { return in_line_ ? 3 : 3 + static_cast<int>(leg); }
  int r_of() const { return variables_ - 1; }
  bool in_line() const { return in_line_; }

  const Interval& length(std::size_t leg) const { return lengths_[leg]; }
  /// Of the limits: the slices, or lower end, middle and upper end of every range.
  const std::vector<Orientation>& orientations() const { return orientations_; }
  /// Those, by index, at which the conditioning counts: slices and ends.
  const std::vector<std::size_t>& conditioned() const { return conditioned_; }

  /// s_i.
  static double end_of(std::size_t leg) { return leg == 2 ? 1.0 : -1.0; }

  /// w and dw/dr.
  template <class Number>
  Vector2<Number> turn_weight(const Number& r) const {
    if (!characteristic_length_) {
      if (normalisation_ == Normalisation::homogeneous) return {Number(1.0), Number(0.0)};
      const Number square_of_r = r * r;
      return {square_of_r * square_of_r, 4.0 * (square_of_r * r)};
    }
    const Number length(*characteristic_length_);
    const Number factor = normalisation_ == Normalisation::homogeneous ? Number(1.0) / length : length;
    const Number scale = factor * factor;
    return {scale * (r * r), 2.0 * (scale * r)};
  }

  /// The design vector [x_C, y_C, x_D, x_E, r], or [c_1x, c_1y, c_2x, c_2y, c_3x, c_3y, r] of base joints anywhere.
  Eigen::VectorXd to_design(const Variables<double>& z) const;
  Variables<double> to_variables(const Eigen::VectorXd& design) const;

 private:
  bool in_line_;
  int variables_;
  std::array<Interval, 3> lengths_;
  Normalisation normalisation_;
  std::optional<double> characteristic_length_;
  std::vector<Orientation> orientations_;
  std::vector<std::size_t> conditioned_;
};

inline Enclosure squared(const Enclosure& x) { return boost::numeric::square(x); }
inline double squared(double x) { return x * x; }

/// v_i.
template <class Number>
Vector2<Number> leg_vector(const DesignFamily& family, std::size_t leg, const Orientation& orientation,
                           const Vector2<Number>& u, const Variables<Number>& z) {
  const Rotation<Number>& turn = orientation.rotation<Number>();
  const auto at = [&](int variable) -> const Number& { return z[static_cast<std::size_t>(variable)]; };
  Vector2<Number> v{u.x - at(family.x_of(leg)), u.y - at(family.y_of(leg))};
  if (orientation.angle == 0.0) return v;
  const Number end = DesignFamily::end_of(leg) * at(family.r_of());
  return {v.x - end * turn.versine, v.y + end * turn.sine};
}

/// The slack of a limit, in squares of lengths: l_max^2 - |v_i|^2 of the greatest length, |v_i|^2 - l_min^2 of the
/// least one; negative where the limit is violated.
template <class Number>
WithGradient<Number> limit_slack(const DesignFamily& family, std::size_t leg, LegSide side,
                                 const Orientation& orientation, const Vector2<Number>& u, const Variables<Number>& z) {
  const Vector2<Number> v = leg_vector(family, leg, orientation, u, z);
  const Rotation<Number>& turn = orientation.rotation<Number>();
  const bool too_long = side == LegSide::too_long;
  const double sign = too_long ? -1.0 : 1.0;
  const Number limit(too_long ? family.length(leg).upper : family.length(leg).lower);
  WithGradient<Number> slack;
  slack.gradient.fill(Number(0.0));
  slack.value = sign * (squared(v.x) + squared(v.y) - squared(limit));
  slack.gradient[static_cast<std::size_t>(family.x_of(leg))] = (-2.0 * sign) * v.x;
  slack.gradient[static_cast<std::size_t>(family.y_of(leg))] = (-2.0 * sign) * v.y;
  if (orientation.angle != 0.0) {
    slack.gradient[static_cast<std::size_t>(family.r_of())] =
        (2.0 * sign * DesignFamily::end_of(leg)) * (v.y * turn.sine - v.x * turn.versine);
  }
  return slack;
}

/// k_i with the derivatives that differ from zero.
template <class Number>
struct Cotangent {
  bool known = true;  ///< false where Y_i may be zero
  Number value;
  Number along_x;
  Number along_y;
  Number along_r;
};

inline bool may_vanish(const Enclosure& x) { return x.lower() <= 0.0 && x.upper() >= 0.0; }
inline bool may_vanish(double x) { return x == 0.0; }

template <class Number>
Cotangent<Number> cotangent(const DesignFamily& family, std::size_t leg, const Orientation& orientation,
                            const Vector2<Number>& u, const Variables<Number>& z) {
  const auto at = [&](int variable) -> const Number& { return z[static_cast<std::size_t>(variable)]; };
  const Number across = u.x - at(family.x_of(leg));
  const Number upwards = u.y - at(family.y_of(leg));
  if (orientation.angle == 0.0) {
    if (may_vanish(upwards)) return {false, {}, {}, {}, {}};
    const Number inverse = Number(1.0) / upwards;
    const Number k = across * inverse;
    return {true, k, -inverse, k * inverse, Number(0.0)};
  }
  const Rotation<Number>& turn = orientation.rotation<Number>();
  const double end = DesignFamily::end_of(leg);
  const Number& r = at(family.r_of());
  const Number x = turn.cosine * across + turn.sine * upwards + (end * turn.versine) * r;
  const Number y = turn.cosine * upwards - turn.sine * across + (end * turn.sine) * r;
  if (may_vanish(y)) return {false, {}, {}, {}, {}};
  const Number inverse = Number(1.0) / y;
  const Number k = x * inverse;
  // dk = (dX - k dY) / Y
  return {true, k, -(turn.cosine + k * turn.sine) * inverse, (k * turn.cosine - turn.sine) * inverse,
          end * (turn.versine - k * turn.sine) * inverse};
}

/// A number with derivatives along all variables. (Derivatives along k_i and w, with the chain rule after, would be
/// enclosed more sharply; but then other implementations might not be able to check what is proved.)
template <class Number, std::size_t N>
struct Differential {
  Number value{};
  std::array<Number, N> along{};
};

template <class Number, std::size_t N>
Differential<Number, N> operator+(const Differential<Number, N>& a, const Differential<Number, N>& b) {
  Differential<Number, N> sum{a.value + b.value, {}};
  for (std::size_t i = 0; i < N; ++i) sum.along[i] = a.along[i] + b.along[i];
  return sum;
}
template <class Number, std::size_t N>
Differential<Number, N> operator-(const Differential<Number, N>& a, const Differential<Number, N>& b) {
  Differential<Number, N> difference{a.value - b.value, {}};
  for (std::size_t i = 0; i < N; ++i) difference.along[i] = a.along[i] - b.along[i];
  return difference;
}
template <class Number, std::size_t N>
Differential<Number, N> operator*(const Differential<Number, N>& a, const Differential<Number, N>& b) {
  Differential<Number, N> product{a.value * b.value, {}};
  for (std::size_t i = 0; i < N; ++i) product.along[i] = a.along[i] * b.value + a.value * b.along[i];
  return product;
}
template <class Number, std::size_t N>
Differential<Number, N> operator+(double a, const Differential<Number, N>& b) {
  return {a + b.value, b.along};
}
template <class Number, std::size_t N>
Differential<Number, N> squared(const Differential<Number, N>& a) {
  Differential<Number, N> square_of_a{squared(a.value), {}};
  const Number twice = 2.0 * a.value;
  for (std::size_t i = 0; i < N; ++i) square_of_a.along[i] = twice * a.along[i];
  return square_of_a;
}
template <class Number, std::size_t N>
Differential<Number, N> inverse(const Differential<Number, N>& a) {
  Differential<Number, N> result{Number(1.0) / a.value, {}};
  const Number slope = -squared(result.value);
  for (std::size_t i = 0; i < N; ++i) result.along[i] = slope * a.along[i];
  return result;
}

/// kappa^2 by k_1, k_2, k_3 and w.
template <class Type>
Type squared_condition(const Type& k1, const Type& k2, const Type& k3, const Type& w) {
  const Type t1 = 1.0 + squared(k1);
  const Type t2 = 1.0 + squared(k2);
  const Type t3 = 1.0 + squared(k3);
  const Type over = inverse(squared(k1 - k2));
  const Type sum = inverse(t1) + inverse(t2) + inverse(t3);
  const Type c = t3 + ((4.0 + squared(k1 + k3)) * t2 + (4.0 + squared(k2 + k3)) * t1) * over;
  const Type b = t3 + (squared(k1 - k3) * t2 + squared(k2 - k3) * t1) * over;
  return (3.0 + sum * w) * (c + b * inverse(w));
}

/// kappa^2 and its gradient, of a family with N variables; nothing where a Y_i, k_1 - k_2 or w may be zero.
template <std::size_t N, class Number>
std::optional<WithGradient<Number>> squared_condition_of(const DesignFamily& family, const Orientation& orientation,
                                                         const Vector2<Number>& u, const Variables<Number>& z) {
  std::array<Differential<Number, N>, 4> inputs;
  for (auto& input : inputs) input.along.fill(Number(0.0));
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Cotangent<Number> k = cotangent(family, leg, orientation, u, z);
    if (!k.known) return std::nullopt;
    inputs[leg].value = k.value;
    inputs[leg].along[static_cast<std::size_t>(family.x_of(leg))] = k.along_x;
    inputs[leg].along[static_cast<std::size_t>(family.y_of(leg))] = k.along_y;
    inputs[leg].along[N - 1] = k.along_r;
  }
  const Vector2<Number> weight = family.turn_weight(z[N - 1]);
  if (may_vanish(Number(inputs[0].value - inputs[1].value)) || may_vanish(weight.x)) return std::nullopt;
  inputs[3].value = weight.x;
  inputs[3].along[N - 1] = weight.y;
  const Differential<Number, N> all = squared_condition(inputs[0], inputs[1], inputs[2], inputs[3]);
  WithGradient<Number> result;
  result.gradient.fill(Number(0.0));
  result.value = all.value / 36.0;
  for (std::size_t i = 0; i < N; ++i) result.gradient[i] = all.along[i] / 36.0;
  return result;
}

template <class Number>
std::optional<WithGradient<Number>> squared_condition(const DesignFamily& family, const Orientation& orientation,
                                                      const Vector2<Number>& u, const Variables<Number>& z) {
  return family.in_line() ? squared_condition_of<5>(family, orientation, u, z)
                          : squared_condition_of<7>(family, orientation, u, z);
}

/// kappa^2 in floating point; infinite where it is singular.
double squared_condition_at(const DesignFamily& family, const Orientation& orientation, const Eigen::Vector2d& u,
                            const Variables<double>& z);

/// A number that kappa^2 is not below anywhere in a box: by bounds of k_i and T_i, and the least value over all w of
/// the box in closed form. 0 where a Y_i may be zero.
double least_squared_condition(const DesignFamily& family, const Orientation& orientation, const Vector2<Enclosure>& u,
                               const Variables<Enclosure>& box);

}  // namespace reprise::rigorous
