#include "design_functions.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "reprise/base/require.hpp"

namespace reprise::rigorous {
namespace {

/// Throws unless the manipulators of the task are those of the thesis's family.
void require_family(const SynthesisTask& task) {
  const DesignSpace& designs = task.designs;
  const std::string name = "the family of designs";
  const auto refuse = [&](const std::string& value) {
    reject(name, value, "the thesis's: x_C, y_C, x_D, x_E and r, without bounds, with length limits only");
  };
  if (designs.legs() != 3) refuse("one with " + std::to_string(designs.legs()) + " legs");
  std::array<Interval, 3> lengths;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Leg& one = designs.origin().leg(leg);
    if (one.base_angle || one.platform_angle) refuse("one with limits of joint angles");
    lengths[leg] = one.length;
  }
  const DesignSpace family = DesignSpace::collinear(lengths);
  if (designs.size() != family.size() || designs.joint_map() != family.joint_map() ||
      designs.length_map() != family.length_map()) {
    refuse("another one");
  }
  const Manipulator of_zero = designs.manipulator(Eigen::VectorXd::Zero(designs.size()));
  for (std::size_t leg = 0; leg < 3; ++leg) {
    if (!of_zero.leg(leg).base_joint.isZero(0.0) || !of_zero.leg(leg).platform_joint.isZero(0.0)) {
      refuse("another one");
    }
  }
  for (const Eigen::VectorXd& bound : {designs.lower(), designs.upper()}) {
    if (bound.size() != 0 && bound.cwiseAbs().minCoeff() < std::numeric_limits<double>::infinity()) {
      refuse("one with bounds");
    }
  }
}

/// Of c (3 + A w) + b (A + 3 / w), all factors positive, the least value over all w of an interval: it falls up to
/// w^2 = 3 b / (A c) and grows from there, where it is 3 c + A b + 2 sqrt(3 A b c).
double least_over_weight(double a, double b, double c, const Enclosure& w) {
  const Enclosure constant = 3.0 * Enclosure(c) + Enclosure(a) * b;
  const Enclosure rising = Enclosure(a) * c;
  const Enclosure falling = 3.0 * Enclosure(b);
  const auto at = [&](double weight) { return (constant + rising * weight + falling / Enclosure(weight)).lower(); };
  if (w.lower() > 0.0 && (rising * squared(Enclosure(w.lower())) - falling).lower() >= 0.0) return at(w.lower());
  if (w.upper() > 0.0 && (rising * squared(Enclosure(w.upper())) - falling).upper() <= 0.0) return at(w.upper());
  return (constant + 2.0 * sqrt(rising * falling)).lower();
}

}  // namespace

Orientation::Orientation(double angle_of)
    : angle(angle_of),
      enclosed{cos(Enclosure(angle_of)), sin(Enclosure(angle_of)), 1.0 - cos(Enclosure(angle_of))},
      rounded{std::cos(angle_of), std::sin(angle_of), 1.0 - std::cos(angle_of)} {}

DesignFamily::DesignFamily(const SynthesisTask& task, BaseJoints base)
    : in_line_(base == BaseJoints::in_line),
      variables_(in_line_ ? 5 : 7),
      normalisation_(task.conditioning.normalisation),
      characteristic_length_(task.conditioning.characteristic_length) {
  require_family(task);
  for (std::size_t leg = 0; leg < 3; ++leg) lengths_[leg] = task.designs.origin().leg(leg).length;
  for (const OrientationRange& range : task.orientations) {
    conditioned_.push_back(orientations_.size());
    orientations_.emplace_back(range.lower);
    if (range.is_slice()) continue;
    orientations_.emplace_back(0.5 * range.lower + 0.5 * range.upper);
    conditioned_.push_back(orientations_.size());
    orientations_.emplace_back(range.upper);
  }
}

Eigen::VectorXd DesignFamily::to_design(const Variables<double>& z) const {
  const double r = z[static_cast<std::size_t>(r_of())];
  Eigen::VectorXd design(variables_);
  if (in_line_) {
    design << z[0] - r, z[3], z[1] - r, z[2] + r, r;
  } else {
    design << z[0] - r, z[3], z[1] - r, z[4], z[2] + r, z[5], r;
  }
  return design;
}

Variables<double> DesignFamily::to_variables(const Eigen::VectorXd& design) const {
  Variables<double> z{};
  const double r = design[variables_ - 1];
  if (in_line_) {
    z = {design[0] + r, design[2] + r, design[3] - r, design[1], r};
  } else {
    z = {design[0] + r, design[2] + r, design[4] - r, design[1], design[3], design[5], r};
  }
  return z;
}

double squared_condition_at(const DesignFamily& family, const Orientation& orientation, const Eigen::Vector2d& u,
                            const Variables<double>& z) {
  std::array<double, 3> k;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Cotangent<double> one = cotangent<double>(family, leg, orientation, {u.x(), u.y()}, z);
    if (!one.known) return std::numeric_limits<double>::infinity();
    k[leg] = one.value;
  }
  const double w = family.turn_weight(z[static_cast<std::size_t>(family.r_of())]).x;
  const double t1 = 1.0 + k[0] * k[0], t2 = 1.0 + k[1] * k[1], t3 = 1.0 + k[2] * k[2];
  const double over = 1.0 / squared(k[0] - k[1]);
  const double c = t3 + ((4.0 + squared(k[0] + k[2])) * t2 + (4.0 + squared(k[1] + k[2])) * t1) * over;
  const double b = t3 + (squared(k[0] - k[2]) * t2 + squared(k[1] - k[2]) * t1) * over;
  const double value = (3.0 + (1.0 / t1 + 1.0 / t2 + 1.0 / t3) * w) * (c + b / w) / 36.0;
  return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

double least_squared_condition(const DesignFamily& family, const Orientation& orientation, const Vector2<Enclosure>& u,
                               const Variables<Enclosure>& box) {
  std::array<Enclosure, 3> k;
  std::array<Enclosure, 3> t;
  Enclosure sum(0.0);
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Cotangent<Enclosure> one = cotangent(family, leg, orientation, u, box);
    if (!one.known) return 0.0;
    k[leg] = one.value;
    t[leg] = 1.0 + squared(k[leg]);
    sum += 1.0 / Enclosure(t[leg].upper());
  }
  const double most_apart = squared(k[0] - k[1]).upper();
  if (!(most_apart > 0.0)) return 0.0;
  const Enclosure apart(most_apart);
  const auto low = [](const Enclosure& x) { return Enclosure(x.lower()); };
  const Enclosure c =
      low(t[2]) +
      ((4.0 + low(squared(k[0] + k[2]))) * low(t[1]) + (4.0 + low(squared(k[1] + k[2]))) * low(t[0])) / apart;
  const Enclosure b =
      low(t[2]) + (low(squared(k[0] - k[2])) * low(t[1]) + low(squared(k[1] - k[2])) * low(t[0])) / apart;
  const Enclosure w = family.turn_weight(box[static_cast<std::size_t>(family.r_of())]).x;
  const double least = least_over_weight(sum.lower(), b.lower(), c.lower(), w);
  return least > 0.0 ? (Enclosure(least) / 36.0).lower() : 0.0;
}

}  // namespace reprise::rigorous
