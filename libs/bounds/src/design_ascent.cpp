#include "design_ascent.hpp"

#include <algorithm>
#include <cmath>

namespace reprise::rigorous {
namespace {

/// Of kappa^2 for a square of a length; far above the multipliers of the limits at optima, in units of the longest leg.
constexpr double penalty = 30.0;
constexpr std::size_t peaks_of_ascent = 12;
/// Limits with less slack than this at points of the outline are looked at more closely; squares of lengths.
constexpr double slack_looked_at = 0.01;

struct Linearised {
  LocalDesign design;
  std::vector<DesignPeak> conditioning;
  std::vector<DesignPeak> limits;
};

Linearised linearise(const DesignPeaks& peaks, const Variables<double>& z, double radius) {
  Variables<double> reach;
  reach.fill(2.0 * radius);
  Linearised result{
      {z, 0.0, 0.0}, peaks.of_conditioning(z, peaks_of_ascent), peaks.of_limits(z, reach, slack_looked_at)};
  result.design.squared_condition = peaks.at_points(z).squared_condition;
  for (const DesignPeak& peak : result.conditioning) {
    result.design.squared_condition = std::max(result.design.squared_condition, peak.function.value);
  }
  for (const DesignPeak& peak : result.limits) {
    result.design.violation = std::max(result.design.violation, -peak.function.value);
  }
  return result;
}

SmallVector scaled_gradient(const WithGradient<double>& function, int variables, double scale) {
  SmallVector gradient(variables);
  for (int i = 0; i < variables; ++i) gradient[i] = scale * function.gradient[static_cast<std::size_t>(i)];
  return gradient;
}

/// Every peak of kappa^2 alone, and together with every violation.
std::vector<AffineRow> rows_of(const Linearised& at, int variables, double radius) {
  std::vector<AffineRow> rows;
  for (const DesignPeak& peak : at.conditioning) {
    const AffineRow row{peak.function.value, scaled_gradient(peak.function, variables, radius), false};
    rows.push_back(row);
    for (const DesignPeak& limit : at.limits) {
      rows.push_back({row.value - penalty * limit.function.value,
                      row.gradient - penalty * scaled_gradient(limit.function, variables, radius), false});
    }
  }
  return rows;
}

}  // namespace

double LocalDesign::merit() const { return squared_condition + penalty * violation; }

LocalDesign ascend(const DesignFamily& family, const DesignPeaks& peaks, const Variables<double>& start) {
  constexpr int most_steps = 60;
  constexpr double smallest_radius = 1e-9;
  double radius = 0.1;
  const int variables = family.variables();
  Linearised here = linearise(peaks, start, radius);
  for (int step = 0; step < most_steps && radius > smallest_radius && !here.conditioning.empty(); ++step) {
    const ProgramResult program = smallest_maximum(rows_of(here, variables, radius), variables);
    if (program.status != ProgramStatus::solved) break;
    Variables<double> there = here.design.z;
    for (int i = 0; i < variables; ++i) there[static_cast<std::size_t>(i)] += radius * program.x[i];
    const double promised = here.design.merit() - program.value;
    if (promised < 1e-12) {
      radius *= 0.1;
      continue;
    }
    Linearised next = linearise(peaks, there, radius);
    const double gained = here.design.merit() - next.design.merit();
    if (gained < 0.5 * promised) radius *= 0.3;
    if (gained > 0.9 * promised) radius *= 1.5;
    if (gained > 0.05 * promised) here = std::move(next);
  }
  return here.design;
}

}  // namespace reprise::rigorous
