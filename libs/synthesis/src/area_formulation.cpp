#include "reprise/synthesis/area_formulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/workspace/dextrous_limits.hpp"

namespace reprise {
namespace {

/// Two sets of directions as one, increasing within one turn from -pi on.
std::vector<double> merged(const std::vector<double>& computed, const std::vector<double>& outline) {
  std::vector<double> directions = computed;
  for (const double beta : outline) directions.push_back(beta > pi ? beta - 2.0 * pi : beta);
  std::sort(directions.begin(), directions.end());
  // Directions at both -pi and pi are one and the same.
  if (directions.back() - directions.front() >= 2.0 * pi) directions.pop_back();
  return directions;
}

}  // namespace

AreaFormulation::AreaFormulation(SynthesisTask task, const AreaOptions& options)
    : task_(std::move(task)), options_(options), outline_(task_.prescribed.angles(options.outline_points)) {
  validate(task_);
  require(options_.chord_length > 0.0 && std::isfinite(options_.chord_length), "the chord length",
          options_.chord_length, "positive and finite");
}

AreaEvaluation AreaFormulation::evaluate(const Eigen::VectorXd& design) const {
  const Manipulator manipulator = task_.designs.manipulator(design);
  AreaEvaluation result;
  result.kappa_inverse = infinity;
  double outside = 0.0;
  double clearance = infinity;
  const auto trace = [this](const Limits& limits) {
    return trace_boundary(limits, task_.prescribed.centre(), {.chord = options_.chord_length});
  };
  for (const OrientationRange& range : task_.orientations) {
    const TracedBoundary traced = range.is_slice() ? trace(ConstantOrientationLimits(manipulator, range.lower))
                                                   : trace(DextrousLimits(manipulator, range));
    result.limit_evaluations += static_cast<long>(traced.evaluations);
    result.boundary_points += static_cast<long>(traced.points.size());
    std::vector<double> candidates = outline_;  // where kappa^-1 is looked at
    if (traced.closed()) {
      const PolarBoundary computed(traced.positions(), task_.prescribed.centre());
      result.areas.push_back(measure_area(task_.prescribed, &computed, merged(computed.angles(), outline_)));
      candidates = computed.angles();
    } else if (traced.status == TraceStatus::start_outside) {
      result.areas.push_back(measure_area(task_.prescribed, nullptr, outline_));
    } else {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      result.trace_status = traced.status;
      result.kappa_inverse = nan;
      result.constraint = nan;
      return result;
    }
    for (const double beta : candidates) {
      const Eigen::Vector2d position = task_.prescribed.point(beta);
      for (const double phi : range.ends()) {
        const double value = kappa_inverse(manipulator, {position, phi}, task_.conditioning);
        result.kappa_inverse = std::min(result.kappa_inverse, value);
      }
    }
    outside += result.areas.back().prescribed_outside;
    clearance = std::min(clearance, result.areas.back().clearance);
  }
  result.constraint = outside > 0.0 ? outside : -clearance * clearance;
  return result;
}

Problem AreaFormulation::problem() const {
  struct Memo {
    Eigen::VectorXd design;
    AreaEvaluation evaluation;
  };
  const auto evaluate = [formulation = *this,
                         memo = std::make_shared<Memo>()](const Eigen::VectorXd& d) -> const AreaEvaluation& {
    if (memo->design.size() != d.size() || memo->design != d) {
      memo->evaluation = formulation.evaluate(d);
      memo->design = d;
    }
    return memo->evaluation;
  };
  Problem problem;
  problem.name = task_.prescribed.name() + ", area";
  // The boundary is a polygon whose vertices come and go with the design, and kappa^-1 is the smallest of many.
  problem.smooth = false;
  problem.n = task_.designs.size();
  problem.lower = task_.designs.lower();
  problem.upper = task_.designs.upper();
  problem.objective = [evaluate](const Eigen::VectorXd& d) { return -evaluate(d).kappa_inverse; };
  problem.inequalities = 1;
  problem.inequality = [evaluate](const Eigen::VectorXd& d, Eigen::VectorXd& g) { g[0] = evaluate(d).constraint; };
  return problem;
}

}  // namespace reprise
