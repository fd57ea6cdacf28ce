#include "reprise/synthesis/area_measure.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "reprise/base/constants.hpp"

namespace reprise {
namespace {

/// Integral over a sector of the positive part of a function that runs linearly from `from` to `to`.
double positive_part(double from, double to, double width) {
  if (from >= 0.0 && to >= 0.0) return 0.5 * (from + to) * width;
  if (from <= 0.0 && to <= 0.0) return 0.0;
  const double top = std::max(from, to);
  return 0.5 * top * width * top / (std::max(from, to) - std::min(from, to));
}

}  // namespace

AreaMeasure measure_area(const PrescribedWorkspace& prescribed, const PolarBoundary* computed,
                         std::span<const double> directions) {
  if (directions.size() < 2) {
    throw std::invalid_argument("the number of directions is " + std::to_string(directions.size()) +
                                ", but it must be at least 2");
  }
  AreaMeasure measure;
  measure.clearance = std::numeric_limits<double>::infinity();
  // (r_p^2 - r_c^2) / 2 in a direction.
  const auto excess_at = [&](double beta) {
    const double r_p = prescribed.radius(beta);
    const double r_c = computed == nullptr ? 0.0 : computed->radius(beta);
    measure.clearance = std::min(measure.clearance, r_c - r_p);
    return 0.5 * (r_p * r_p - r_c * r_c);
  };
  double from = excess_at(directions.back());
  double last = directions.back() - 2.0 * pi;
  for (const double beta : directions) {
    const double to = excess_at(beta);
    measure.prescribed_outside += positive_part(from, to, beta - last);
    measure.computed_outside += positive_part(-from, -to, beta - last);
    from = to;
    last = beta;
  }
  return measure;
}

}  // namespace reprise
