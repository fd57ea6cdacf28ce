#include "reprise/bounds/design_proof.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "pose_function.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/synthesis/constraint_functions.hpp"

namespace reprise {
namespace {

/// How far inside of the outline a position is along the ray from the centre; negative outside.
double depth(const PrescribedWorkspace& prescribed, const Eigen::Vector2d& position) {
  const Eigen::Vector2d from_centre = position - prescribed.centre();
  return prescribed.radius(std::atan2(from_centre.y(), from_centre.x())) - from_centre.norm();
}

/// Adds what is known of a limit.
void add(DesignProof& proof, double& smallest, const LimitEnclosure& limit) {
  if (proof.reaches == Verdict::proved || limit.verdict == Verdict::refuted) proof.reaches = limit.verdict;
  proof.violation_bound = std::max(proof.violation_bound, -limit.margin.lower);
  proof.evaluations += limit.margin.evaluations;
  if (limit.margin.witness && limit.margin.upper < smallest) {
    smallest = limit.margin.upper;
    proof.limit = limit.limit;
    proof.limit_at = limit.margin.witness;
  }
  proof.limits.push_back(limit);
}

/// The margin of a minimum length whose hole lies inside: -l_min, at the hole's centre. Everywhere along the way of the
/// centre over the range it is the same, so a search would go through all of it.
LimitEnclosure margin_in_hole(const Manipulator& manipulator, const Limit& limit, double orientation,
                              double allowance) {
  const Leg& leg = manipulator.leg(limit.leg);
  const Pose pose{hole_centre(leg, orientation), orientation};
  const rigorous::Poses point{rigorous::Enclosure(pose.position.x()), rigorous::Enclosure(pose.position.y()),
                              rigorous::Enclosure(pose.orientation)};
  const double there = rigorous::Margin(leg, limit.kind).value(point).upper();
  const MinimumEnclosure margin{-leg.length.lower, std::max(there, -leg.length.lower), pose, 1, true};
  return {limit, at_least(margin, -allowance), margin};
}

/// Where bounds came to no end, the smallest value of a few samples may be below what they found.
void look_at_samples(const SynthesisTask& task, const Manipulator& manipulator, const OrientationRange& range,
                     MinimumEnclosure& smallest) {
  constexpr int directions = 24, orientations = 3;
  const auto look = [&](const Pose& pose) {
    const double value = kappa_inverse(manipulator, pose, task.conditioning);
    if (value < smallest.upper) {
      smallest.upper = value;
      smallest.witness = pose;
    }
  };
  for (const double phi : range.spread(orientations)) {
    look({task.prescribed.centre(), phi});
    for (int i = 0; i < directions; ++i) look({task.prescribed.point(2.0 * pi * i / directions), phi});
  }
}

/// A singular pose between two poses of a coarse grid at which det J differs in sign, found by bisection. From the
/// centre the way leads along a ray, so it stays within the workspace. For two and three legs.
std::optional<Pose> find_singular_pose(const SynthesisTask& task, const Manipulator& manipulator,
                                       const OrientationRange& range) {
  constexpr int directions = 24, radii = 4, orientations = 5;
  if (manipulator.size() > 3) return std::nullopt;
  const Pose first{task.prescribed.centre(), range.lower};
  const int side = singularity_side(manipulator, first);
  if (side == 0) return first;
  for (const double phi : range.spread(orientations)) {
    for (int i = 0; i < directions; ++i) {
      const Eigen::Vector2d outward = task.prescribed.point(2.0 * pi * i / directions) - task.prescribed.centre();
      for (int k = 0; k <= radii; ++k) {
        const Eigen::Vector2d way = outward * (static_cast<double>(k) / radii);
        const auto at = [&](double share) {
          return Pose{first.position + share * way, range.lower + share * (phi - range.lower)};
        };
        if (singularity_side(manipulator, at(1.0)) == side) continue;
        double before = 0.0, after = 1.0;
        for (double middle = 0.5; before < middle && middle < after; middle = std::midpoint(before, after)) {
          (singularity_side(manipulator, at(middle)) == side ? before : after) = middle;
        }
        return at(after);
      }
    }
  }
  return std::nullopt;
}

/// The smallest kappa^-1 over one range. Singular poses are surfaces among all poses; a search for bounds would go
/// through all of them.
MinimumEnclosure enclose_conditioning(const SynthesisTask& task, const Manipulator& manipulator,
                                      const OrientationRange& range, const EnclosureOptions& options) {
  if (const std::optional<Pose> singular = find_singular_pose(task, manipulator, range)) {
    return {0.0, 0.0, singular, 0, true};
  }
  MinimumEnclosure smallest = enclose_minimum(manipulator, task.prescribed, range, task.conditioning, options);
  if (!smallest.reached) look_at_samples(task, manipulator, range, smallest);
  return smallest;
}

}  // namespace

Eigen::Vector2d hole_centre(const Leg& leg, double orientation) {
  return leg.base_joint - Eigen::Rotation2Dd(orientation) * leg.platform_joint;
}

std::optional<double> find_hole(const PrescribedWorkspace& prescribed, const Leg& leg, const OrientationRange& range,
                                int samples) {
  if (leg.length.lower <= 0.0) return std::nullopt;
  std::optional<double> found;
  double deepest = 0.0;
  for (const double orientation : range.spread(samples)) {
    const double here = depth(prescribed, hole_centre(leg, orientation));
    if (here > deepest) {
      deepest = here;
      found = orientation;
    }
  }
  return found;
}

DesignProof prove_design(const SynthesisTask& task, const Eigen::VectorXd& design, const ProofOptions& options) {
  validate(task);
  const Manipulator manipulator = task.designs.manipulator(design);
  DesignProof proof{Verdict::proved, 0.0, 0.0, {}, {}, {}, {infinity, infinity, {}, 0, true}, {}, 0};
  double smallest = infinity;
  const EnclosureOptions margins{options.margin_tolerance, options.max_evaluations};
  const auto legs = static_cast<long>(manipulator.size());
  const long triples = std::max(1L, legs * (legs - 1) * (legs - 2) / 6);
  const EnclosureOptions conditioning{options.conditioning_tolerance, std::max(1L, options.max_evaluations / triples)};
  for (const OrientationRange& range : task.orientations) {
    for (const Limit& limit : list_limits(manipulator)) {
      const bool may_leave_hole = limit.kind == LimitKind::minimum_length;
      const std::optional<double> hole =
          may_leave_hole ? find_hole(task.prescribed, manipulator.leg(limit.leg), range) : std::nullopt;
      add(proof, smallest,
          hole ? margin_in_hole(manipulator, limit, *hole, options.allowance)
               : prove_limit(manipulator, limit, task.prescribed, range, options.allowance, margins));
    }
    const MinimumEnclosure here = enclose_conditioning(task, manipulator, range, conditioning);
    MinimumEnclosure& all = proof.kappa_inverse;
    all.lower = std::min(all.lower, here.lower);
    all.evaluations += here.evaluations;
    all.reached = all.reached && here.reached;
    if (here.upper < all.upper) {
      all.upper = here.upper;
      all.witness = here.witness;
    }
    proof.kappa_inverses.push_back(here);
  }
  proof.evaluations += proof.kappa_inverse.evaluations;
  proof.violation = std::max(0.0, -smallest);
  return proof;
}

}  // namespace reprise
