#include "reconstruction/compatible_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/kinematics/coordinates.hpp"
#include "reprise/workspace/exact_workspace.hpp"

namespace reprise::experiments {
namespace {

/// Radii closer than this fraction are the same: they are scaled to and fro.
constexpr double same_radius = 1e-9;

void validate(const ReportedSynthesis& reported, const Eigen::Vector2d& centre, const RaySampling& sampling) {
  const Eigen::Index size = reported.designs.size();
  require(!reported.orientations.empty(), "reported synthesis: the number of orientations", 0, "at least 1");
  for (const double phi : reported.orientations) {
    require(std::isfinite(phi), "reported synthesis: an orientation", phi, "finite");
  }
  const auto check_design = [&](const char* name, const Eigen::VectorXd& design) {
    if (design.size() != size || !design.allFinite()) {
      reject("reported synthesis: " + std::string(name), shown(design),
             "of " + std::to_string(size) + " finite entries");
    }
  };
  check_design("the starting design", reported.start);
  check_design("the final design", reported.final_design);
  if (reported.rounding.size() != 0) {
    check_design("the rounding", reported.rounding);
    require(reported.rounding.minCoeff() >= 0.0, "reported synthesis: the rounding", reported.rounding, "not negative");
  }
  const auto check_value = [&](const char* name, const Interval& value) {
    if (value.lower <= value.upper) return;
    reject("reported synthesis: " + std::string(name), "in [" + shown(value.lower) + ", " + shown(value.upper) + "]",
           "in an interval with its ends in order");
  };
  check_value("the starting value", reported.start_value);
  check_value("the final value", reported.final_value);
  require(reported.protrusion >= 0.0 && std::isfinite(reported.protrusion), "reported synthesis: the protrusion",
          reported.protrusion, "at least 0 and finite");
  require(centre.allFinite(), "reported synthesis: the centre", centre, "finite");
  require(sampling.directions >= 3, "reported synthesis: the number of directions", sampling.directions, "at least 3");
  require(sampling.steps >= 1, "reported synthesis: the number of steps", sampling.steps, "at least 1");
}

/// Bounds, leg by leg, of how far |a_i| and its limits may differ in all when the design differs by the rounding.
std::vector<double> length_changes(const DesignSpace& designs, const Eigen::VectorXd& rounding) {
  std::vector<double> changes(designs.legs(), 0.0);
  if (rounding.size() == 0) return changes;
  const Eigen::VectorXd joints = designs.joint_map().cwiseAbs() * rounding;
  const Eigen::VectorXd lengths = designs.length_map().cwiseAbs() * rounding;
  for (std::size_t leg = 0; leg < changes.size(); ++leg) {
    const auto row = static_cast<Eigen::Index>(leg);
    changes[leg] = joints.segment<2>(4 * row).norm() + joints.segment<2>(4 * row + 2).norm() +
                   lengths.segment<2>(2 * row).maxCoeff();
  }
  return changes;
}

/// The manipulator with each leg's range of lengths wider by the given amounts at both ends (narrower where negative).
Manipulator widened(const Manipulator& manipulator, const std::vector<double>& amounts) {
  std::vector<Leg> legs = manipulator.legs();
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Interval length = legs[i].length;
    legs[i].length = {std::max(0.0, length.lower - amounts[i]), length.upper + amounts[i]};
    if (legs[i].length.lower > legs[i].length.upper) {
      const double middle = 0.5 * (length.lower + length.upper);
      legs[i].length = {middle, middle};
    }
  }
  return {manipulator.name(), std::move(legs)};
}

/// Where rays from a centre first leave all of the workspaces of a synthesis.
class WorkspaceRadii {
 public:
  WorkspaceRadii(const ReportedSynthesis& reported, const Manipulator& manipulator, const Eigen::Vector2d& centre)
      : centre_(centre) {
    if (reported.dextrous_range) {
      regions_.push_back(dextrous_workspace(manipulator, *reported.dextrous_range));
    } else {
      for (const double phi : reported.orientations) {
        regions_.push_back(constant_orientation_workspace(manipulator, phi));
      }
    }
    inside_ =
        std::all_of(regions_.begin(), regions_.end(), [&](const Region& region) { return region.contains(centre_); });
  }

  double operator()(double beta) const {
    double radius = inside_ ? infinity : 0.0;
    for (const Region& region : regions_) radius = std::min(radius, region.first_exit(centre_, beta).value_or(0.0));
    return radius;
  }

 private:
  Eigen::Vector2d centre_;
  std::vector<Region> regions_;
  bool inside_;
};

/// kappa^-1 of a design at a point, the smallest over the orientations, with bounds for designs within the rounding.
class DesignValues {
 public:
  DesignValues(const ReportedSynthesis& reported, const Eigen::VectorXd& design, Eigen::VectorXd rounding)
      : manipulator_(reported.designs.manipulator(design)),
        conditioning_(reported.conditioning),
        orientations_(reported.orientations),
        rounding_(std::move(rounding)),
        directions_(Eigen::MatrixXd::Zero(coordinate_count(reported.designs.legs()), reported.designs.size())),
        gradient_(reported.designs.size()) {
    directions_.bottomRows(reported.designs.joint_map().rows()) = reported.designs.joint_map();
  }

  Interval at(const Eigen::Vector2d& u) {
    Interval bounds{infinity, infinity};
    for (const double phi : orientations_) {
      double change = 0.0;
      double value = 0.0;
      if (rounding_.size() == 0) {
        value = kappa_inverse(manipulator_, {u, phi}, conditioning_);
      } else {
        value = kappa_inverse(manipulator_, {u, phi}, conditioning_, directions_, gradient_);
        change = gradient_.cwiseAbs().dot(rounding_);
      }
      bounds = {std::min(bounds.lower, value - change), std::min(bounds.upper, value + change)};
    }
    return bounds;
  }

 private:
  Manipulator manipulator_;
  Conditioning conditioning_;
  std::vector<double> orientations_;
  Eigen::VectorXd rounding_;
  Eigen::MatrixXd directions_;
  Eigen::VectorXd gradient_;
};

/// The value of a function that is linear between its samples at equal steps.
double interpolate(const std::vector<double>& values, double step, double radius) {
  if (step == 0.0) return values.front();
  const double position = std::clamp(radius / step, 0.0, static_cast<double>(values.size() - 1));
  const std::size_t sample = std::min(static_cast<std::size_t>(position), values.size() - 2);
  return values[sample] + (position - static_cast<double>(sample)) * (values[sample + 1] - values[sample]);
}

/// The radius at which a function that never grows falls below a level; the last sample's when it does not.
double falls_below(const std::vector<double>& values, double step, double level) {
  if (values.front() < level) return 0.0;
  for (std::size_t j = 1; j < values.size(); ++j) {
    if (values[j] < level) {
      return step * (static_cast<double>(j - 1) + (values[j - 1] - level) / (values[j - 1] - values[j]));
    }
  }
  return step * static_cast<double>(values.size() - 1);
}

}  // namespace

CompatibleOutlines::CompatibleOutlines(const ReportedSynthesis& reported, const Eigen::Vector2d& centre,
                                       const RaySampling& sampling)
    : start_value_(reported.start_value), final_value_(reported.final_value) {
  validate(reported, centre, sampling);
  const Manipulator manipulator = reported.designs.manipulator(reported.final_design);
  std::vector<double> wider = length_changes(reported.designs, reported.rounding);
  std::vector<double> narrower = wider;
  for (double& amount : narrower) amount = -amount;
  for (double& amount : wider) amount += reported.protrusion;
  const WorkspaceRadii outer(reported, widened(manipulator, wider), centre);
  const WorkspaceRadii inner(reported, widened(manipulator, narrower), centre);
  DesignValues start(reported, reported.start, {});
  DesignValues final_design(reported, reported.final_design, reported.rounding);

  const auto directions = static_cast<std::size_t>(sampling.directions);
  const auto samples = static_cast<std::size_t>(sampling.steps) + 1;
  rays_.resize(directions);
  std::vector<double> most_final_values(samples);
  for (std::size_t i = 0; i < directions; ++i) {
    Ray& ray = rays_[i];
    const double beta = direction(i);
    const double reach = outer(beta);
    ray.step = reach / sampling.steps;
    ray.touching_radius = inner(beta);
    ray.start_values.resize(samples);
    ray.final_values.resize(samples);
    Interval least{infinity, infinity};
    double least_start = infinity;
    bool left = false;
    bool gap = false;
    for (std::size_t j = 0; j < samples; ++j) {
      const Eigen::Vector2d u = centre + ray.step * static_cast<double>(j) * unit(beta);
      const double start_here = start.at(u).lower;
      const Interval final_here = final_design.at(u);
      const bool satisfied = start_here >= start_value_.lower && final_here.upper >= final_value_.lower;
      left = left || !satisfied;
      gap = gap || (left && satisfied);
      least_start = std::min(least_start, start_here);
      least = {std::min(least.lower, final_here.lower), std::min(least.upper, final_here.upper)};
      ray.start_values[j] = least_start;
      ray.final_values[j] = least.lower;
      most_final_values[j] = least.upper;
    }
    if (gap) ++rays_with_gaps_;
    workspace_.push_back(reach);
    largest_for_final_design_.push_back(falls_below(most_final_values, ray.step, final_value_.lower));
    largest_.push_back(
        std::min(largest_for_final_design_.back(), falls_below(ray.start_values, ray.step, start_value_.lower)));
  }
}

double CompatibleOutlines::direction(std::size_t i) const {
  return 2.0 * pi * static_cast<double>(i) / static_cast<double>(rays_.size());
}

CompatibleOutlines::Attained CompatibleOutlines::attained_on_ray(std::size_t i, double radius) const {
  const Ray& ray = rays_.at(i);
  return {interpolate(ray.start_values, ray.step, radius), interpolate(ray.final_values, ray.step, radius),
          ray.touching_radius - radius};
}

CompatibleOutlines::Attained CompatibleOutlines::attained(std::span<const double> radii) const {
  require(radii.size() == rays_.size(), "reported synthesis: the number of radii", radii.size(),
          "the number of directions");
  Attained least{infinity, infinity, infinity};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const Attained here = attained_on_ray(i, radii[i]);
    least = {std::min(least.start_value, here.start_value), std::min(least.final_value, here.final_value),
             std::min(least.gap, here.gap)};
  }
  return least;
}

bool CompatibleOutlines::satisfied_by(const Attained& attained) const {
  const double size = *std::max_element(workspace_.begin(), workspace_.end());
  return size > 0.0 && attained.start_value <= start_value_.upper && attained.final_value <= final_value_.upper &&
         attained.gap <= same_radius * size;
}

CommonOutline common_outline(std::span<const SizedOutlines> sized) {
  require(!sized.empty(), "the number of syntheses that have an outline in common", sized.size(), "at least 1");
  const std::size_t directions = sized.front().outlines->directions();
  CommonOutline common{std::vector<double>(directions, infinity), {}, true};
  for (const SizedOutlines& one : sized) {
    require(one.outlines->directions() == directions, "the number of directions", one.outlines->directions(),
            "that of the first synthesis");
    require(one.divisor > 0.0 && std::isfinite(one.divisor), "a divisor", one.divisor, "positive and finite");
    for (std::size_t i = 0; i < directions; ++i) {
      common.radii[i] = std::min(common.radii[i], one.divisor * one.outlines->largest()[i]);
    }
  }
  std::vector<double> radii(directions);
  for (const SizedOutlines& one : sized) {
    for (std::size_t i = 0; i < directions; ++i) radii[i] = common.radii[i] / one.divisor;
    common.attained.push_back(one.outlines->attained(radii));
    common.compatible = common.compatible && one.outlines->satisfied_by(common.attained.back());
  }
  return common;
}

}  // namespace reprise::experiments
