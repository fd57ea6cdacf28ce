#include "reprise/synthesis/synthesis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/synthesis/assessor.hpp"
#include "reprise/synthesis/constraint_functions.hpp"
#include "reprise/workspace/dextrous_limits.hpp"

namespace reprise {
namespace {

std::vector<Eigen::Vector2d> outline_positions(const PrescribedWorkspace& prescribed, int count) {
  std::vector<Eigen::Vector2d> positions;
  for (const double beta : prescribed.angles(count)) positions.push_back(prescribed.point(beta));
  return positions;
}

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

int prevailing_side(const SynthesisTask& task, const Eigen::VectorXd& design, int points) {
  validate(task);
  if (task.designs.legs() > 3) return 0;
  const Manipulator manipulator = task.designs.manipulator(design);
  int sum = 0;
  for (const Eigen::Vector2d& position : outline_positions(task.prescribed, points)) {
    for (const OrientationRange& range : task.orientations) {
      for (const double phi : range.ends()) sum += singularity_side(manipulator, {position, phi});
    }
  }
  return sum < 0 ? -1 : 1;
}

std::vector<ConstraintRow> pointwise_rows(const ConstraintFunctions& functions, int points) {
  const SynthesisTask& task = functions.task();
  std::vector<ConstraintRow> rows;
  const std::vector<Eigen::Vector2d> positions = outline_positions(task.prescribed, points);
  for (std::size_t range = 0; range < task.orientations.size(); ++range) {
    for (const Eigen::Vector2d& position : positions) {
      for (std::size_t family = 0; family < functions.families().size(); ++family) {
        if (functions.families()[family].range == range) rows.push_back({family, position});
      }
    }
  }
  return rows;
}

Problem pointwise_problem(const SynthesisTask& task, const PointwiseOptions& options) {
  const auto functions = std::make_shared<const ConstraintFunctions>(task, options.side);
  return make_problem(functions, pointwise_rows(*functions, options.points));
}

Eigen::VectorXd pointwise_start(const SynthesisTask& task, const Eigen::VectorXd& design,
                                const PointwiseOptions& options) {
  const ConstraintFunctions functions(task, options.side);
  ConstraintFunctions::AtDesign at(functions, design);
  double smallest = infinity;
  for (const Eigen::Vector2d& position : outline_positions(task.prescribed, options.points)) {
    for (std::size_t family = 0; family < functions.families().size(); ++family) {
      if (functions.is_conditioning(family)) smallest = std::min(smallest, -at.value(family, position));
    }
  }
  Eigen::VectorXd start(design.size() + 1);
  start << design, smallest;
  return start;
}

Assessor::Assessor(SynthesisTask task, int points, int orientations)
    : task_(std::move(task)), orientations_(orientations) {
  validate(task_);
  require(orientations >= 2, "the number of orientations", orientations, "at least 2");
  positions_ = outline_positions(task_.prescribed, points);
}

Assessment Assessor::operator()(const Eigen::VectorXd& design) const {
  const Manipulator manipulator = task_.designs.manipulator(design);
  Assessment result;
  result.kappa_inverse = infinity;
  result.kappa_inverse_throughout = infinity;
  double largest = -infinity;
  for (const OrientationRange& range : task_.orientations) {
    const DextrousLimits limits(manipulator, range);
    Eigen::VectorXd h(limits.count());
    const std::vector<double> throughout = range.spread(orientations_);
    for (const Eigen::Vector2d& position : positions_) {
      for (const double phi : throughout) {
        const double value = kappa_inverse(manipulator, {position, phi}, task_.conditioning);
        result.kappa_inverse_throughout = std::min(result.kappa_inverse_throughout, value);
        if ((phi == range.lower || phi == range.upper) && value < result.kappa_inverse) {
          result.kappa_inverse = value;
          result.kappa_inverse_at = position;
          result.kappa_inverse_orientation = phi;
        }
      }
      limits.evaluate(position, h);
      Eigen::Index j = 0;
      if (const double value = h.maxCoeff(&j); value > largest) {
        largest = value;
        result.violation_at = position;
        result.violation_orientation = limits.critical_orientation(position, j);
        result.violation_limit = limits.limit(j);
      }
    }
  }
  result.violation = std::max(0.0, largest);
  return result;
}

Assessment assess(const SynthesisTask& task, const Eigen::VectorXd& design, int points, int orientations) {
  return Assessor(task, points, orientations)(design);
}

}  // namespace reprise
