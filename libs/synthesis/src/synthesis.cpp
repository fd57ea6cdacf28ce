#include "reprise/synthesis/synthesis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "reprise/workspace/dextrous_derivatives.hpp"
#include "reprise/workspace/dextrous_limits.hpp"

namespace reprise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void validate(const SynthesisTask& task) {
  if (task.orientations.empty()) {
    throw std::invalid_argument("the synthesis has 0 ranges of orientations, but at least 1 is needed");
  }
  for (const Interval& range : task.orientations) DextrousLimits(task.designs.origin(), range);
}

bool is_slice(const Interval& range) { return range.lower == range.upper; }

/// The orientations at which the conditioning counts: both ends of a range, or its single orientation.
std::vector<double> ends(const Interval& range) {
  if (is_slice(range)) return {range.lower};
  return {range.lower, range.upper};
}

std::vector<Eigen::Vector2d> outline_positions(const PrescribedWorkspace& prescribed, int count) {
  std::vector<Eigen::Vector2d> positions;
  for (const double beta : prescribed.angles(count)) positions.push_back(prescribed.point(beta));
  return positions;
}

/// Two sets of directions as one, increasing within one turn from -pi on.
std::vector<double> merged(const std::vector<double>& computed, const std::vector<double>& outline) {
  constexpr double pi = std::numbers::pi;
  std::vector<double> directions = computed;
  for (const double beta : outline) directions.push_back(beta > pi ? beta - 2.0 * pi : beta);
  std::sort(directions.begin(), directions.end());
  // Directions at both -pi and pi are one and the same.
  if (directions.back() - directions.front() >= 2.0 * pi) directions.pop_back();
  return directions;
}

/// Limits and derivatives at the outline's points for the pointwise problem.
class PointwiseFunctions {
 public:
  PointwiseFunctions(SynthesisTask task, const PointwiseOptions& options)
      : task_(std::move(task)),
        side_(options.side),
        positions_(outline_positions(task_.prescribed, options.points)),
        limit_count_(static_cast<Eigen::Index>(list_limits(task_.designs.origin()).size())),
        k_(task_.designs.size()),
        directions_(Eigen::MatrixXd::Zero(coordinate_count(task_.designs.legs()), k_)) {
    directions_.bottomRows(task_.designs.joint_map().rows()) = task_.designs.joint_map();
    for (const Interval& range : task_.orientations) {
      const double middle = 0.5 * (range.lower + range.upper);
      const std::vector<Interval> halves{{range.lower, middle}, {middle, range.upper}};
      ranges_.push_back({ends(range), is_slice(range) ? std::vector{range} : halves});
    }
    for (std::size_t leg = 0; leg < task_.designs.legs(); ++leg) {
      const auto row = static_cast<Eigen::Index>(leg);
      Eigen::Matrix4Xd joints = task_.designs.joint_map().middleRows<4>(4 * row);
      joints.topRows<2>() *= -1.0;  // w = u - c
      std::vector<Eigen::Index> columns;
      for (Eigen::Index j = 0; j < k_; ++j) {
        const bool moves =
            !joints.col(j).isZero(0.0) || !task_.designs.length_map().block(2 * row, j, 2, 1).isZero(0.0);
        if (moves) columns.push_back(j);
      }
      legs_.push_back({std::move(joints), std::move(columns)});
    }
  }

  Eigen::Index variables() const { return k_ + 1; }

  Eigen::Index constraints() const {
    Eigen::Index at_point = 0;
    for (const Range& range : ranges_) {
      at_point += static_cast<Eigen::Index>(range.ends.size());
      at_point += static_cast<Eigen::Index>(range.parts.size()) * limit_count_;
    }
    return static_cast<Eigen::Index>(positions_.size()) * at_point;
  }

  void values(const Eigen::VectorXd& x, Eigen::VectorXd& g) const {
    const Manipulator manipulator = task_.designs.manipulator(x.head(k_));
    Eigen::Index row = 0;
    visit(
        manipulator,
        [&](const Pose& pose) {
          g[row++] = x[k_] - sign(manipulator, pose) * kappa_inverse(manipulator, pose, task_.conditioning);
        },
        [&](const DextrousLimits& limits, const Eigen::Vector2d& position) {
          limits.evaluate(position, g.segment(row, limit_count_));
          row += limit_count_;
        });
  }

  void jacobian(const Eigen::VectorXd& x, SparseMatrix& jacobian) const {
    if (jacobian.nonZeros() == 0) reserve_pattern(jacobian);
    const Manipulator manipulator = task_.designs.manipulator(x.head(k_));
    Eigen::VectorXd gradient(k_);
    double* entry = jacobian.valuePtr();  // row by row, in the order of the pattern
    visit(
        manipulator,
        [&](const Pose& pose) {
          kappa_inverse(manipulator, pose, task_.conditioning, directions_, gradient);
          const double factor = -sign(manipulator, pose);
          for (Eigen::Index j = 0; j < k_; ++j) *entry++ = factor * gradient[j];
          *entry++ = 1.0;
        },
        [&](const DextrousLimits& limits, const Eigen::Vector2d& position) {
          for (Eigen::Index i = 0; i < limit_count_; ++i) {
            const Limit& limit = limits.limit(i);
            const LegVariation& variation = legs_[limit.leg];
            const DextrousLimitDerivatives h = derivatives(manipulator, limits, position, i);
            for (const Eigen::Index j : variation.columns) {
              *entry++ = h.gradient.dot(variation.joints.col(j)) + length_change(limit, j);
            }
          }
        });
  }

  /// sum_i multipliers_i times the Hessian of constraint i, lower triangle; t enters linearly.
  void hessian(const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers, SparseMatrix& hessian) const {
    const Manipulator manipulator = task_.designs.manipulator(x.head(k_));
    Eigen::VectorXd gradient(k_);
    Eigen::MatrixXd one(k_, k_);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(k_, k_);
    std::vector<Eigen::Matrix4d> leg_sums(legs_.size(), Eigen::Matrix4d::Zero());
    Eigen::Index row = 0;
    visit(
        manipulator,
        [&](const Pose& pose) {
          const double multiplier = multipliers[row++];
          if (multiplier == 0.0) return;
          kappa_inverse(manipulator, pose, task_.conditioning, directions_, gradient, one);
          sum -= multiplier * sign(manipulator, pose) * one;
        },
        [&](const DextrousLimits& limits, const Eigen::Vector2d& position) {
          for (Eigen::Index i = 0; i < limit_count_; ++i) {
            const double multiplier = multipliers[row++];
            if (multiplier == 0.0) continue;
            leg_sums[limits.limit(i).leg] += multiplier * derivatives(manipulator, limits, position, i).hessian;
          }
        });
    for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
      sum += legs_[leg].joints.transpose() * leg_sums[leg] * legs_[leg].joints;
    }
    if (hessian.nonZeros() == 0) {
      for (Eigen::Index i = 0; i < k_; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) hessian.insert(i, j) = 0.0;
      }
      hessian.makeCompressed();
    }
    double* entry = hessian.valuePtr();
    for (Eigen::Index i = 0; i < k_; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) *entry++ = sum(i, j);
    }
  }

  double smallest_kappa_inverse(const Eigen::VectorXd& design) const {
    const Manipulator manipulator = task_.designs.manipulator(design);
    double smallest = infinity;
    visit(
        manipulator,
        [&](const Pose& pose) {
          smallest = std::min(smallest, sign(manipulator, pose) * kappa_inverse(manipulator, pose, task_.conditioning));
        },
        [](const DextrousLimits&, const Eigen::Vector2d&) {});
    return smallest;
  }

 private:
  struct Range {
    std::vector<double> ends;
    std::vector<Interval> parts;  ///< a limit is one constraint for each
  };

  /// How a leg changes with the design.
  struct LegVariation {
    Eigen::Matrix4Xd joints;            ///< d[w, p]/dd, see dextrous_derivatives.hpp
    std::vector<Eigen::Index> columns;  ///< the design variables that move it or its limits
  };

  /// The factor of kappa^-1 at a pose, see PointwiseOptions::side.
  double sign(const Manipulator& manipulator, const Pose& pose) const {
    return side_ == 0 ? 1.0 : side_ * singularity_side(manipulator, pose);
  }

  /// Calls for the constraints in their order: at_end(pose), at_part(limits over a part of the range, position).
  template <class AtEnd, class AtPart>
  void visit(const Manipulator& manipulator, AtEnd&& at_end, AtPart&& at_part) const {
    std::vector<DextrousLimits> parts;
    for (const Range& range : ranges_) {
      parts.clear();
      for (const Interval& part : range.parts) parts.emplace_back(manipulator, part);
      for (const Eigen::Vector2d& position : positions_) {
        for (const double phi : range.ends) at_end(Pose{position, phi});
        for (const DextrousLimits& limits : parts) at_part(limits, position);
      }
    }
  }

  static DextrousLimitDerivatives derivatives(const Manipulator& manipulator, const DextrousLimits& limits,
                                              const Eigen::Vector2d& position, Eigen::Index i) {
    const Leg& leg = manipulator.leg(limits.limit(i).leg);
    return dextrous_limit_derivatives(leg, limits.limit(i).kind, position - leg.base_joint, limits.orientations(),
                                      limits.critical_orientation(position, i));
  }

  /// dh/dd_j at fixed joints, where the design moves the length limit itself.
  double length_change(const Limit& limit, Eigen::Index j) const {
    const auto row = 2 * static_cast<Eigen::Index>(limit.leg);
    if (limit.kind == LimitKind::minimum_length) return task_.designs.length_map()(row, j);
    if (limit.kind == LimitKind::maximum_length) return -task_.designs.length_map()(row + 1, j);
    return 0.0;
  }

  void reserve_pattern(SparseMatrix& jacobian) const {
    std::vector<Eigen::Triplet<double>> entries;
    int row = 0;
    visit(
        task_.designs.origin(),
        [&](const Pose&) {
          for (int j = 0; j <= static_cast<int>(k_); ++j) entries.emplace_back(row, j, 0.0);
          ++row;
        },
        [&](const DextrousLimits& limits, const Eigen::Vector2d&) {
          for (Eigen::Index i = 0; i < limit_count_; ++i) {
            for (const Eigen::Index j : legs_[limits.limit(i).leg].columns) {
              entries.emplace_back(row, static_cast<int>(j), 0.0);
            }
            ++row;
          }
        });
    jacobian.setFromTriplets(entries.begin(), entries.end());
  }

  SynthesisTask task_;
  int side_;
  std::vector<Eigen::Vector2d> positions_;  ///< points of the outline
  std::vector<Range> ranges_;
  Eigen::Index limit_count_;  ///< at one point and part of a range
  Eigen::Index k_;
  Eigen::MatrixXd directions_;  ///< of kappa_inverse: the design's directions in all coordinates
  std::vector<LegVariation> legs_;
};

}  // namespace

std::vector<Interval> slices(const std::vector<double>& orientations) {
  std::vector<Interval> ranges(orientations.size());
  std::transform(orientations.begin(), orientations.end(), ranges.begin(), [](double phi) {
    return Interval{phi, phi};
  });
  return ranges;
}

std::vector<double> spread_orientations(const Interval& range, int count) {
  if (count < 2) {
    throw std::invalid_argument("the number of orientations is " + std::to_string(count) +
                                ", but it must be at least 2");
  }
  if (is_slice(range)) return {range.lower};
  std::vector<double> orientations;
  for (int k = 0; k + 1 < count; ++k) {
    orientations.push_back(range.lower + k * (range.upper - range.lower) / (count - 1));
  }
  orientations.push_back(range.upper);
  return orientations;
}

AreaFormulation::AreaFormulation(SynthesisTask task, const AreaOptions& options)
    : task_(std::move(task)), options_(options), outline_(task_.prescribed.angles(options.outline_points)) {
  validate(task_);
  if (!(options_.chord_length > 0.0 && std::isfinite(options_.chord_length))) {
    throw std::invalid_argument("the chord length is " + std::to_string(options_.chord_length) +
                                ", but it must be positive and finite");
  }
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
  for (const Interval& range : task_.orientations) {
    const TracedBoundary traced = is_slice(range) ? trace(ConstantOrientationLimits(manipulator, range.lower))
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
      for (const double phi : ends(range)) {
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
    for (const Interval& range : task.orientations) {
      for (const double phi : ends(range)) sum += singularity_side(manipulator, {position, phi});
    }
  }
  return sum < 0 ? -1 : 1;
}

Problem pointwise_problem(const SynthesisTask& task, const PointwiseOptions& options) {
  validate(task);
  const auto functions = std::make_shared<const PointwiseFunctions>(task, options);
  const Eigen::Index n = functions->variables();
  Problem problem;
  problem.name = task.prescribed.name() + ", pointwise";
  problem.n = n;
  const auto with_t = [n](const Eigen::VectorXd& bound, double of_t) {
    Eigen::VectorXd extended = Eigen::VectorXd::Constant(n, of_t);
    if (bound.size() != 0) extended.head(n - 1) = bound;
    return extended;
  };
  if (task.designs.lower().size() != 0) problem.lower = with_t(task.designs.lower(), -infinity);
  if (task.designs.upper().size() != 0) problem.upper = with_t(task.designs.upper(), infinity);
  problem.objective = [n](const Eigen::VectorXd& x) { return -x[n - 1]; };
  problem.objective_gradient = [n](const Eigen::VectorXd&, Eigen::VectorXd& gradient) {
    gradient.setZero();
    gradient[n - 1] = -1.0;
  };
  problem.inequalities = functions->constraints();
  problem.inequality = [functions](const Eigen::VectorXd& x, Eigen::VectorXd& g) { functions->values(x, g); };
  problem.inequality_jacobian = [functions](const Eigen::VectorXd& x, SparseMatrix& jacobian) {
    functions->jacobian(x, jacobian);
  };
  problem.lagrangian_hessian = [functions](const Eigen::VectorXd& x, double, const Eigen::VectorXd& multipliers,
                                           const Eigen::VectorXd&,
                                           SparseMatrix& hessian) { functions->hessian(x, multipliers, hessian); };
  return problem;
}

Eigen::VectorXd pointwise_start(const SynthesisTask& task, const Eigen::VectorXd& design,
                                const PointwiseOptions& options) {
  validate(task);
  const PointwiseFunctions functions(task, options);
  Eigen::VectorXd start(functions.variables());
  start << design, functions.smallest_kappa_inverse(design);
  return start;
}

Assessment assess(const SynthesisTask& task, const Eigen::VectorXd& design, int points, int orientations) {
  validate(task);
  const Manipulator manipulator = task.designs.manipulator(design);
  const std::vector<Eigen::Vector2d> positions = outline_positions(task.prescribed, points);
  Assessment result;
  result.kappa_inverse = infinity;
  result.kappa_inverse_throughout = infinity;
  double largest = -infinity;
  for (const Interval& range : task.orientations) {
    const DextrousLimits limits(manipulator, range);
    Eigen::VectorXd h(limits.count());
    const std::vector<double> throughout = spread_orientations(range, orientations);
    for (const Eigen::Vector2d& position : positions) {
      for (const double phi : throughout) {
        const double value = kappa_inverse(manipulator, {position, phi}, task.conditioning);
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

}  // namespace reprise
