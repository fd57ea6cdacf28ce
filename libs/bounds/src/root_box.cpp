#include "root_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reprise/base/require.hpp"

namespace reprise::rigorous {
namespace {

/// At least x, with three significant bits: root boxes have short numbers.
double rounded_up_to_three_bits(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  const double unit = std::ldexp(1.0, exponent - 3);
  return unit * std::ceil(x / unit);
}

/// Designs with a kappa^-1 above this are within the sizes that are searched when none are given.
constexpr double default_sizes_bound = 0.25;

/// (3 + w)(1 + 1 / w) / 36, which kappa^2 is not below.
Enclosure least_squared_condition_of(const Enclosure& w) { return (3.0 + w) * (1.0 + 1.0 / w) / 36.0; }

}  // namespace

void check_search(int side, long max_boxes, long threads, const std::optional<Interval>& sizes) {
  require(side == 1 || side == -1, "the side", side, "1 or -1");
  require(max_boxes >= 1, "the limit on boxes", max_boxes, "at least 1");
  require(threads >= 1, "the number of threads", threads, "at least 1");
  if (!sizes) return;
  require(sizes->lower > 0.0, "the smallest size of the platform", sizes->lower, "positive");
  require(sizes->upper >= sizes->lower, "the largest size of the platform", sizes->upper, "at least the smallest");
}

Interval default_sizes(const DesignFamily& family) {
  Interval sizes{0.0, std::numeric_limits<double>::infinity()};
  const auto excluded = [&](double r) {
    const Enclosure w = family.turn_weight(Enclosure(r)).x;
    return w.lower() > 0.0 && (sqrt(least_squared_condition_of(w)) * default_sizes_bound).lower() > 1.0;
  };
  // The bound falls up to w = sqrt 3 and grows from there.
  constexpr double smallest = 1e-6;
  constexpr double largest = 1e6;
  constexpr double factor = 1.01;
  double r = smallest;
  while (r < largest && excluded(r)) {
    sizes.lower = r;
    r *= factor;
  }
  r = largest;
  while (r > smallest && excluded(r)) {
    sizes.upper = r;
    r /= factor;
  }
  // Both ends of the platform reach O' at every orientation.
  for (const Orientation& one : family.orientations()) {
    for (const Orientation& other : family.orientations()) {
      const double turn = std::abs(std::sin(0.5 * (one.angle - other.angle)));
      for (std::size_t leg = 0; leg < 3 && turn > 0.0; ++leg) {
        sizes.upper = std::min(sizes.upper, 1.001 * family.length(leg).upper / turn);
      }
    }
  }
  return sizes;
}

double bound_outside(const DesignFamily& family, const Interval& sizes) {
  double bound = 0.0;
  for (const double r : {sizes.lower, sizes.upper}) {
    const Enclosure w = family.turn_weight(Enclosure(r)).x;
    if (w.lower() > 0.0) bound = std::max(bound, (1.0 / sqrt(least_squared_condition_of(w))).upper());
  }
  return bound;
}

DesignBox root_box(const SynthesisTask& task, const DesignFamily& family, const Interval& sizes, int side) {
  require(std::isfinite(sizes.upper), "the range of the platform's size", sizes.upper,
          "bounded: at the orientation 0 alone the homogeneous normalisation says nothing of it");
  DesignBox root{};
  double moved = std::numeric_limits<double>::infinity();
  for (const Orientation& orientation : family.orientations()) {
    moved = std::min(moved, sizes.upper * 2.0 * std::abs(std::sin(0.5 * orientation.angle)));
  }
  const Eigen::Vector2d& centre = task.prescribed.centre();
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const double reach = rounded_up_to_three_bits(1.0000001 * moved + family.length(leg).upper);
    root[index(family.x_of(leg))] = {centre.x() - reach, centre.x() + reach};
    // One height is within the reach of every leg.
    lowest = family.in_line() ? std::min(lowest, reach) : reach;
    root[index(family.y_of(leg))] = {centre.y() - lowest, centre.y() + lowest};
  }
  root[index(family.r_of())] = side > 0 ? sizes : Interval{-sizes.upper, -sizes.lower};
  return root;
}

}  // namespace reprise::rigorous
