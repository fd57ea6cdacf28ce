#include "reprise/synthesis/synthesis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace reprise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void validate(const SynthesisTask& task) {
  if (task.orientations.empty()) {
    throw std::invalid_argument("the synthesis has 0 orientations, but at least 1 is needed");
  }
  for (const double phi : task.orientations) {
    if (!std::isfinite(phi)) throw std::invalid_argument("an orientation of the synthesis is not finite");
  }
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

struct OutlinePoint {
  double orientation;
  Eigen::Vector2d position;
};

/// The outline's points, once for each slice.
std::vector<OutlinePoint> sample(const SynthesisTask& task, int count) {
  std::vector<OutlinePoint> points;
  const std::vector<double> angles = task.prescribed.angles(count);
  points.reserve(angles.size() * task.orientations.size());
  for (const double phi : task.orientations) {
    for (const double beta : angles) points.push_back({phi, task.prescribed.point(beta)});
  }
  return points;
}

/// Limits and derivatives at the outline's points for the pointwise problem.
class PointwiseFunctions {
 public:
  PointwiseFunctions(SynthesisTask task, const PointwiseOptions& options)
      : task_(std::move(task)),
        points_(sample(task_, options.points)),
        limits_(list_limits(task_.designs.manipulator(Eigen::VectorXd::Zero(task_.designs.size())))),
        k_(task_.designs.size()),
        directions_(Eigen::MatrixXd::Zero(coordinate_count(task_.designs.legs()), k_)) {
    directions_.bottomRows(task_.designs.joint_map().rows()) = task_.designs.joint_map();
    for (std::size_t leg = 0; leg < task_.designs.legs(); ++leg) {
      const auto row = static_cast<Eigen::Index>(leg);
      std::vector<Eigen::Index> columns;
      for (Eigen::Index j = 0; j < k_; ++j) {
        const bool moves = !task_.designs.joint_map().block(4 * row, j, 4, 1).isZero(0.0) ||
                           !task_.designs.length_map().block(2 * row, j, 2, 1).isZero(0.0);
        if (moves) columns.push_back(j);
      }
      columns_.push_back(std::move(columns));
    }
  }

  Eigen::Index variables() const { return k_ + 1; }
  Eigen::Index constraints() const { return static_cast<Eigen::Index>(points_.size() * (1 + limits_.size())); }

  void values(const Eigen::VectorXd& x, Eigen::VectorXd& g) const {
    const Manipulator manipulator = task_.designs.manipulator(x.head(k_));
    Eigen::Index row = 0;
    for (const OutlinePoint& point : points_) {
      const Pose pose{point.position, point.orientation};
      g[row++] = x[k_] - kappa_inverse(manipulator, pose, task_.conditioning);
      for (const Limit& limit : limits_) {
        const Leg& leg = manipulator.leg(limit.leg);
        g[row++] = limit_value(leg, limit.kind, leg_vector(leg, pose), point.orientation);
      }
    }
  }

  void jacobian(const Eigen::VectorXd& x, SparseMatrix& jacobian) const {
    if (jacobian.nonZeros() == 0) reserve_pattern(jacobian);
    const Manipulator manipulator = task_.designs.manipulator(x.head(k_));
    Eigen::VectorXd gradient(k_);
    double* entry = jacobian.valuePtr();  // row by row, in the order of the pattern
    for (const OutlinePoint& point : points_) {
      const Pose pose{point.position, point.orientation};
      kappa_inverse(manipulator, pose, task_.conditioning, directions_, gradient);
      for (Eigen::Index j = 0; j < k_; ++j) *entry++ = -gradient[j];
      *entry++ = 1.0;
      const Turn turn(point.orientation);
      for (const Limit& limit : limits_) {
        const Leg& leg = manipulator.leg(limit.leg);
        const LimitDerivatives h = limit_derivatives(leg, limit.kind, leg_vector(leg, pose), point.orientation);
        for (const Eigen::Index j : columns_[limit.leg]) {
          *entry++ = h.gradient.dot(leg_vector_change(limit.leg, j, turn)) + length_change(limit, j);
        }
      }
    }
  }

  /// sum_i multipliers_i times the Hessian of constraint i, lower triangle; t enters linearly.
  void hessian(const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers, SparseMatrix& hessian) const {
    const Manipulator manipulator = task_.designs.manipulator(x.head(k_));
    Eigen::VectorXd gradient(k_);
    Eigen::MatrixXd one(k_, k_);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(k_, k_);
    Eigen::Matrix2Xd change(2, k_);
    Eigen::Index row = 0;
    for (const OutlinePoint& point : points_) {
      const Pose pose{point.position, point.orientation};
      if (const double multiplier = multipliers[row++]; multiplier != 0.0) {
        kappa_inverse(manipulator, pose, task_.conditioning, directions_, gradient, one);
        sum -= multiplier * one;
      }
      const Turn turn(point.orientation);
      for (const Limit& limit : limits_) {
        const double multiplier = multipliers[row++];
        if (multiplier == 0.0) continue;
        const Leg& leg = manipulator.leg(limit.leg);
        const LimitDerivatives h = limit_derivatives(leg, limit.kind, leg_vector(leg, pose), point.orientation);
        for (Eigen::Index j = 0; j < k_; ++j) change.col(j) = leg_vector_change(limit.leg, j, turn);
        sum.noalias() += multiplier * change.transpose() * h.hessian * change;
      }
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
    for (const OutlinePoint& point : points_) {
      smallest =
          std::min(smallest, kappa_inverse(manipulator, {point.position, point.orientation}, task_.conditioning));
    }
    return smallest;
  }

 private:
  /// R(phi), once for each point.
  struct Turn {
    explicit Turn(double phi) : c(std::cos(phi)), s(std::sin(phi)) {}
    double c, s;
  };

  /// da/dd_j: with da/dc = -I and da/dp = R(phi).
  Eigen::Vector2d leg_vector_change(std::size_t leg, Eigen::Index j, const Turn& turn) const {
    const auto row = 4 * static_cast<Eigen::Index>(leg);
    const Eigen::MatrixXd& map = task_.designs.joint_map();
    const double p_x = map(row + 2, j);
    const double p_y = map(row + 3, j);
    return {turn.c * p_x - turn.s * p_y - map(row, j), turn.s * p_x + turn.c * p_y - map(row + 1, j)};
  }

  /// dh/dd_j at a fixed leg vector, where the design moves the length limit itself.
  double length_change(const Limit& limit, Eigen::Index j) const {
    const auto row = 2 * static_cast<Eigen::Index>(limit.leg);
    if (limit.kind == LimitKind::minimum_length) return task_.designs.length_map()(row, j);
    if (limit.kind == LimitKind::maximum_length) return -task_.designs.length_map()(row + 1, j);
    return 0.0;
  }

  void reserve_pattern(SparseMatrix& jacobian) const {
    std::vector<Eigen::Triplet<double>> entries;
    int row = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (int j = 0; j <= static_cast<int>(k_); ++j) entries.emplace_back(row, j, 0.0);
      ++row;
      for (const Limit& limit : limits_) {
        for (const Eigen::Index j : columns_[limit.leg]) entries.emplace_back(row, static_cast<int>(j), 0.0);
        ++row;
      }
    }
    jacobian.setFromTriplets(entries.begin(), entries.end());
  }

  SynthesisTask task_;
  std::vector<OutlinePoint> points_;
  std::vector<Limit> limits_;
  Eigen::Index k_;
  Eigen::MatrixXd directions_;                      ///< of kappa_inverse: the design's directions in all coordinates
  std::vector<std::vector<Eigen::Index>> columns_;  ///< of each leg: the design variables that move it or its limits
};

}  // namespace

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
  for (const double phi : task_.orientations) {
    const ConstantOrientationLimits limits(manipulator, phi);
    const TracedBoundary traced = trace_boundary(limits, task_.prescribed.centre(), {.chord = options_.chord_length});
    result.limit_evaluations += static_cast<long>(traced.evaluations);
    result.boundary_points += static_cast<long>(traced.points.size());
    std::vector<double> candidates = outline_;  // where kappa^-1 is looked at
    if (traced.closed()) {
      const PolarBoundary computed(traced.positions(), task_.prescribed.centre());
      result.slices.push_back(measure_area(task_.prescribed, &computed, merged(computed.angles(), outline_)));
      candidates = computed.angles();
    } else if (traced.status == TraceStatus::start_outside) {
      result.slices.push_back(measure_area(task_.prescribed, nullptr, outline_));
    } else {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      result.trace_status = traced.status;
      result.kappa_inverse = nan;
      result.constraint = nan;
      return result;
    }
    for (const double beta : candidates) {
      const double value = kappa_inverse(manipulator, {task_.prescribed.point(beta), phi}, task_.conditioning);
      result.kappa_inverse = std::min(result.kappa_inverse, value);
    }
    outside += result.slices.back().prescribed_outside;
    clearance = std::min(clearance, result.slices.back().clearance);
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

Assessment assess(const SynthesisTask& task, const Eigen::VectorXd& design, int points) {
  validate(task);
  const Manipulator manipulator = task.designs.manipulator(design);
  const std::vector<Limit> limits = list_limits(manipulator);
  Assessment result;
  result.kappa_inverse = infinity;
  double largest = -infinity;
  for (const OutlinePoint& point : sample(task, points)) {
    const Pose pose{point.position, point.orientation};
    const double value = kappa_inverse(manipulator, pose, task.conditioning);
    if (value < result.kappa_inverse) {
      result.kappa_inverse = value;
      result.kappa_inverse_at = point.position;
      result.kappa_inverse_orientation = point.orientation;
    }
    for (const Limit& limit : limits) {
      const Leg& leg = manipulator.leg(limit.leg);
      const double h = limit_value(leg, limit.kind, leg_vector(leg, pose), point.orientation);
      if (h > largest) {
        largest = h;
        result.violation_at = point.position;
        result.violation_orientation = point.orientation;
        result.violation_limit = limit;
      }
    }
  }
  result.violation = std::max(0.0, largest);
  return result;
}

}  // namespace reprise
