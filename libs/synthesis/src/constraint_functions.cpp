#include "reprise/synthesis/constraint_functions.hpp"

#include <Eigen/Geometry>
#include <memory>
#include <utility>

#include "reprise/base/constants.hpp"

namespace reprise {

int sign_on_side(SingularitySide side, const Manipulator& manipulator, const Pose& pose) {
  if (side == SingularitySide::either) return 1;
  return (side == SingularitySide::positive ? 1 : -1) * singularity_side(manipulator, pose);
}

ConstraintFunctions::ConstraintFunctions(SynthesisTask task, SingularitySide side)
    : task_(std::move(task)), side_(side), k_(task_.designs.size()) {
  validate(task_);
  const std::vector<Limit> limits = list_limits(task_.designs.origin());
  for (std::size_t i = 0; i < task_.orientations.size(); ++i) {
    const OrientationRange& range = task_.orientations[i];
    for (const double phi : range.ends()) {
      families_.push_back({i, std::nullopt, {phi, phi}});
      places_.emplace_back();
    }
    const double middle = 0.5 * (range.lower + range.upper);
    const std::vector<OrientationRange> halves{{range.lower, middle}, {middle, range.upper}};
    for (const Interval& part : range.is_slice() ? std::vector{range} : halves) {
      for (std::size_t j = 0; j < limits.size(); ++j) {
        families_.push_back({i, limits[j], part});
        places_.push_back({parts_.size(), static_cast<Eigen::Index>(j)});
      }
      parts_.push_back(part);
    }
  }
  design_directions_ = Eigen::MatrixXd::Zero(coordinate_count(task_.designs.legs()), k_);
  design_directions_.bottomRows(task_.designs.joint_map().rows()) = task_.designs.joint_map();
  all_directions_ = Eigen::MatrixXd::Zero(design_directions_.rows(), k_ + 2);
  all_directions_.leftCols(k_) = design_directions_;
  all_directions_.topRightCorner<2, 2>().setIdentity();
  for (Eigen::Index j = 0; j < k_; ++j) all_columns_.push_back(j);
  for (std::size_t leg = 0; leg < task_.designs.legs(); ++leg) {
    const auto row = static_cast<Eigen::Index>(leg);
    Eigen::Matrix4Xd joints = task_.designs.joint_map().middleRows<4>(4 * row);
    joints.topRows<2>() *= -1.0;  // w = u - c
    std::vector<Eigen::Index> columns;
    for (Eigen::Index j = 0; j < k_; ++j) {
      const bool moves = !joints.col(j).isZero(0.0) || !task_.designs.length_map().block(2 * row, j, 2, 1).isZero(0.0);
      if (moves) columns.push_back(j);
    }
    legs_.push_back({std::move(joints), std::move(columns)});
  }
}

Pose ConstraintFunctions::pose_of(const ConstraintRow& row) const {
  return {row.position, row.orientation.value_or(families_[row.family].orientations.lower)};
}

const std::vector<Eigen::Index>& ConstraintFunctions::columns(std::size_t family) const {
  const auto& limit = families_[family].limit;
  return limit ? legs_[limit->leg].columns : all_columns_;
}

double ConstraintFunctions::length_change(const Limit& limit, Eigen::Index j) const {
  const auto row = 2 * static_cast<Eigen::Index>(limit.leg);
  if (limit.kind == LimitKind::minimum_length) return task_.designs.length_map()(row, j);
  if (limit.kind == LimitKind::maximum_length) return -task_.designs.length_map()(row + 1, j);
  return 0.0;
}

ConstraintFunctions::AtDesign::AtDesign(const ConstraintFunctions& functions, const Eigen::VectorXd& design)
    : functions_(functions),
      manipulator_(functions.task_.designs.manipulator(design)),
      part_of_h_(functions.parts_.size()),
      position_of_h_(Eigen::Vector2d::Zero()),
      gradient_(functions.k_),
      hessian_(functions.k_, functions.k_),
      sum_(Eigen::MatrixXd::Zero(functions.k_, functions.k_)),
      leg_sums_(functions.legs_.size(), Eigen::Matrix4d::Zero()) {
  for (const Interval& part : functions.parts_) parts_.emplace_back(manipulator_, part);
  h_.resize(parts_.front().count());
}

double ConstraintFunctions::AtDesign::sign(const Pose& pose) const {
  return sign_on_side(functions_.side_, manipulator_, pose);
}

double ConstraintFunctions::AtDesign::conditioning(const Pose& pose) const {
  return -sign(pose) * kappa_inverse(manipulator_, pose, functions_.task_.conditioning);
}

Eigen::Vector2d ConstraintFunctions::AtDesign::pivot(std::size_t leg, double orientation) const {
  const Leg& one = manipulator_.leg(leg);
  return one.base_joint - Eigen::Rotation2Dd(orientation) * one.platform_joint;
}

Eigen::Matrix<double, 2, 4> ConstraintFunctions::AtDesign::pivot_change(double orientation) {
  Eigen::Matrix<double, 2, 4> change;
  change.leftCols<2>() = -Eigen::Matrix2d::Identity();  // w = u - c
  change.rightCols<2>() = -Eigen::Rotation2Dd(orientation).toRotationMatrix();
  return change;
}

double ConstraintFunctions::AtDesign::value(const ConstraintRow& row) {
  if (functions_.is_conditioning(row.family)) return conditioning(functions_.pose_of(row));
  if (!functions_.is_distance(row)) return value(row.family, row.position);
  const std::size_t leg = functions_.families_[row.family].limit->leg;
  return manipulator_.leg(leg).length.lower - functions_.distance_->value(pivot(leg, *row.orientation));
}

double ConstraintFunctions::AtDesign::value(std::size_t family, const Eigen::Vector2d& u) {
  if (functions_.is_conditioning(family)) return conditioning({u, functions_.families_[family].orientations.lower});
  const LimitPlace& place = functions_.places_[family];
  if (place.part != part_of_h_ || u != position_of_h_) {
    parts_[place.part].evaluate(u, h_);
    part_of_h_ = place.part;
    position_of_h_ = u;
  }
  return h_[place.index];
}

DextrousLimitDerivatives ConstraintFunctions::AtDesign::limit_derivatives(std::size_t family,
                                                                          const Eigen::Vector2d& u) const {
  const LimitPlace& place = functions_.places_[family];
  const DextrousLimits& limits = parts_[place.part];
  const Limit& limit = limits.limit(place.index);
  const Leg& leg = manipulator_.leg(limit.leg);
  return dextrous_limit_derivatives(leg, limit.kind, u - leg.base_joint, limits.orientations(),
                                    limits.critical_orientation(u, place.index));
}

void ConstraintFunctions::AtDesign::design_gradient(const ConstraintRow& row, double* gradient) {
  if (functions_.is_conditioning(row.family)) {
    const Pose pose = functions_.pose_of(row);
    kappa_inverse(manipulator_, pose, functions_.task_.conditioning, functions_.design_directions_, gradient_);
    const double factor = -sign(pose);
    for (const double slope : gradient_) *gradient++ = factor * slope;
    return;
  }
  const Limit& limit = *functions_.families_[row.family].limit;
  const LegVariation& variation = functions_.legs_[limit.leg];
  Eigen::Vector4d along_leg;
  if (functions_.is_distance(row)) {
    const DistanceDerivatives distance = functions_.distance_->derivatives(pivot(limit.leg, *row.orientation));
    along_leg = -pivot_change(*row.orientation).transpose() * distance.gradient;
  } else {
    along_leg = limit_derivatives(row.family, row.position).gradient;
  }
  for (const Eigen::Index j : variation.columns) {
    *gradient++ = along_leg.dot(variation.joints.col(j)) + functions_.length_change(limit, j);
  }
}

ConstraintDerivatives ConstraintFunctions::AtDesign::derivatives(std::size_t family, const Eigen::Vector2d& u) {
  const Eigen::Index k = functions_.k_;
  ConstraintDerivatives result{0.0, Eigen::VectorXd::Zero(k + 2), Eigen::MatrixXd::Zero(k + 2, k + 2)};
  if (functions_.is_conditioning(family)) {
    const Pose pose{u, functions_.families_[family].orientations.lower};
    const double factor = -sign(pose);
    result.value = factor * kappa_inverse(manipulator_, pose, functions_.task_.conditioning, functions_.all_directions_,
                                          result.gradient, result.hessian);
    result.gradient *= factor;
    result.hessian *= factor;
    return result;
  }
  const Limit& limit = *functions_.families_[family].limit;
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(4, k + 2);  // d[w, p]/d[d, u]
  change.leftCols(k) = functions_.legs_[limit.leg].joints;
  change.topRightCorner<2, 2>().setIdentity();
  const DextrousLimitDerivatives h = limit_derivatives(family, u);
  result.value = value(family, u);
  result.gradient = change.transpose() * h.gradient;
  for (Eigen::Index j = 0; j < k; ++j) result.gradient[j] += functions_.length_change(limit, j);
  result.hessian = change.transpose() * h.hessian * change;
  return result;
}

void ConstraintFunctions::AtDesign::add_hessian(const ConstraintRow& row, double factor) {
  if (factor == 0.0) return;
  if (functions_.is_conditioning(row.family)) {
    const Pose pose = functions_.pose_of(row);
    kappa_inverse(manipulator_, pose, functions_.task_.conditioning, functions_.design_directions_, gradient_,
                  hessian_);
    sum_ -= factor * sign(pose) * hessian_;
    return;
  }
  const std::size_t leg = functions_.families_[row.family].limit->leg;
  if (functions_.is_distance(row)) {
    const DistanceDerivatives distance = functions_.distance_->derivatives(pivot(leg, *row.orientation));
    const Eigen::Matrix<double, 2, 4> change = pivot_change(*row.orientation);
    leg_sums_[leg] -= factor * change.transpose() * distance.hessian * change;
  } else {
    leg_sums_[leg] += factor * limit_derivatives(row.family, row.position).hessian;
  }
}

Eigen::MatrixXd ConstraintFunctions::AtDesign::take_hessian() {
  for (std::size_t leg = 0; leg < leg_sums_.size(); ++leg) {
    const Eigen::Matrix4Xd& joints = functions_.legs_[leg].joints;
    sum_ += joints.transpose() * leg_sums_[leg] * joints;
    leg_sums_[leg].setZero();
  }
  return std::exchange(sum_, Eigen::MatrixXd::Zero(functions_.k_, functions_.k_));
}

Problem make_problem(std::shared_ptr<const ConstraintFunctions> functions, std::vector<ConstraintRow> given) {
  const auto rows = std::make_shared<const std::vector<ConstraintRow>>(std::move(given));
  const SynthesisTask& task = functions->task();
  const Eigen::Index k = functions->design_size();
  Problem problem;
  problem.name = task.prescribed.name() + ", pointwise";
  problem.n = k + 1;
  const auto with_t = [k](const Eigen::VectorXd& bound, double without, double of_t) {
    Eigen::VectorXd extended = Eigen::VectorXd::Constant(k + 1, without);
    if (bound.size() != 0) extended.head(k) = bound;
    extended[k] = of_t;
    return extended;
  };
  // kappa^-1, with the sign of a side or without, lies there: a problem in bounded joints is bounded.
  problem.lower = with_t(task.designs.lower(), -infinity, -1.0);
  problem.upper = with_t(task.designs.upper(), infinity, 1.0);
  problem.objective = [k](const Eigen::VectorXd& x) { return -x[k]; };
  problem.objective_gradient = [k](const Eigen::VectorXd&, Eigen::VectorXd& gradient) {
    gradient.setZero();
    gradient[k] = -1.0;
  };
  problem.inequalities = static_cast<Eigen::Index>(rows->size());
  problem.inequality = [functions, rows, k](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    ConstraintFunctions::AtDesign at(*functions, x.head(k));
    Eigen::Index i = 0;
    for (const ConstraintRow& row : *rows) {
      g[i++] = at.value(row) + (functions->is_conditioning(row.family) ? x[k] : 0.0);
    }
  };
  // Fills `count` rows of the Jacobian, of which row_at(i) is the i-th.
  const auto fill = [functions, k](const Eigen::VectorXd& x, Eigen::Index count, const auto& row_at,
                                   SparseMatrix& jacobian) {
    if (jacobian.nonZeros() == 0) {
      for (Eigen::Index i = 0; i < count; ++i) {
        const std::size_t family = row_at(i).family;
        jacobian.startVec(i);
        for (const Eigen::Index j : functions->columns(family)) jacobian.insertBack(i, j) = 0.0;
        if (functions->is_conditioning(family)) jacobian.insertBack(i, k) = 1.0;
      }
      jacobian.finalize();
    }
    ConstraintFunctions::AtDesign at(*functions, x.head(k));
    double* entry = jacobian.valuePtr();  // row by row, in the order of the pattern
    for (Eigen::Index i = 0; i < count; ++i) {
      const ConstraintRow& row = row_at(i);
      at.design_gradient(row, entry);
      entry += functions->columns(row.family).size();
      if (functions->is_conditioning(row.family)) *entry++ = 1.0;
    }
  };
  const auto row_of = [rows](Eigen::Index i) -> const ConstraintRow& { return (*rows)[static_cast<std::size_t>(i)]; };
  problem.inequality_jacobian = [fill, row_of, count = problem.inequalities](const Eigen::VectorXd& x,
                                                                             SparseMatrix& jacobian) {
    fill(x, count, row_of, jacobian);
  };
  problem.inequality_jacobian_rows = [fill, row_of](const Eigen::VectorXd& x, const std::vector<Eigen::Index>& some,
                                                    SparseMatrix& jacobian) {
    const auto some_row = [&](Eigen::Index i) -> const ConstraintRow& {
      return row_of(some[static_cast<std::size_t>(i)]);
    };
    fill(x, static_cast<Eigen::Index>(some.size()), some_row, jacobian);
  };
  // t enters linearly.
  problem.lagrangian_hessian = [functions, rows, k](const Eigen::VectorXd& x, double,
                                                    const Eigen::VectorXd& multipliers, const Eigen::VectorXd&,
                                                    SparseMatrix& hessian) {
    ConstraintFunctions::AtDesign at(*functions, x.head(k));
    const double* multiplier = multipliers.data();
    for (const ConstraintRow& row : *rows) at.add_hessian(row, *multiplier++);
    const Eigen::MatrixXd sum = at.take_hessian();
    if (hessian.nonZeros() == 0) {
      for (Eigen::Index i = 0; i < k; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) hessian.insert(i, j) = 0.0;
      }
      hessian.makeCompressed();
    }
    double* entry = hessian.valuePtr();
    for (Eigen::Index i = 0; i < k; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) *entry++ = sum(i, j);
    }
  };
  return problem;
}

}  // namespace reprise
