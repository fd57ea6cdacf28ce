#include "problem_json.hpp"

#include <cmath>
#include <variant>

#include "reprise/base/constants.hpp"

namespace reprise::explorer {

namespace {

Json pair_json(const Interval& interval) { return {interval.lower, interval.upper}; }

/// An angle in degrees, as a file has it: its way to radians and back costs a rounding, which twelve decimals do not
/// show.
double in_degrees(double radians) { return std::round(radians / degree * 1e12) / 1e12; }

Json degrees_json(const Interval& interval) { return {in_degrees(interval.lower), in_degrees(interval.upper)}; }

Json leg_json(const Leg& leg) {
  Json json{
      {"base", to_json(leg.base_joint)}, {"platform", to_json(leg.platform_joint)}, {"length", pair_json(leg.length)}};
  if (leg.base_angle) json["base_angle_deg"] = degrees_json(*leg.base_angle);
  if (leg.platform_angle) json["platform_angle_deg"] = degrees_json(*leg.platform_angle);
  return json;
}

/// The keys of each kind of shape.
struct ShapeKeys {
  Json operator()(const Superellipse& shape) const {
    return {{"semi_axes", to_json(shape.semi_axes)}, {"exponent", shape.exponent}};
  }
  Json operator()(const Ellipse& shape) const { return {{"semi_axes", to_json(shape.semi_axes)}}; }
  Json operator()(const QuarterEllipses& shape) const {
    return {{"right", shape.right}, {"up", shape.up}, {"left", shape.left}, {"down", shape.down}};
  }
  Json operator()(const Circle& shape) const { return {{"radius", shape.radius}}; }
  Json operator()(const Rectangle& shape) const { return {{"width", shape.width}, {"height", shape.height}}; }
  Json operator()(const Polygon& shape) const { return {{"vertices", to_json(shape.vertices)}}; }
  Json operator()(const PolarTable& shape) const {
    Json angles = Json::array();
    for (const double angle : shape.angles) angles.push_back(in_degrees(angle));
    return {{"angles_deg", angles}, {"radii", shape.radii}};
  }
};

Json workspace_json(const ProblemInput& problem) {
  const PrescribedWorkspace& prescribed = problem.task.prescribed;
  const Placement& placement = prescribed.placement();
  Json json{{"name", prescribed.name()}, {"kind", problem.origin.kind}};
  json.update(std::visit(ShapeKeys{}, prescribed.shape()));
  json["centre"] = to_json(placement.centre);
  json["scale"] = placement.scale;
  json["rotation_deg"] = in_degrees(placement.rotation);
  if (!problem.origin.source.empty()) json["source"] = problem.origin.source;
  if (!problem.origin.certainty.empty()) json["certainty"] = problem.origin.certainty;
  return json;
}

Json orientations_json(const std::vector<OrientationRange>& ranges) {
  if (!ranges.front().is_slice()) return {{"range_deg", degrees_json(ranges.front())}};
  Json slices = Json::array();
  for (const OrientationRange& slice : ranges) slices.push_back(in_degrees(slice.lower));
  return {{"slices_deg", slices}};
}

Json design_table_json(const DesignSpace& designs) {
  Json json{{"free", designs.names()}};
  Json bounds = Json::object();
  for (Eigen::Index i = 0; i < designs.size(); ++i) {
    const Interval one{designs.lower()[i], designs.upper()[i]};
    if (std::isfinite(one.lower) && std::isfinite(one.upper)) {
      bounds[designs.names()[static_cast<std::size_t>(i)]] = pair_json(one);
    }
  }
  if (!bounds.empty()) json["bounds"] = bounds;
  return json;
}

}  // namespace

Json manipulator_json(const ManipulatorInput& input) {
  const Manipulator& manipulator = input.manipulator;
  Json json{{"name", manipulator.name()}};
  if (!input.unit.empty()) json["unit"] = input.unit;
  json["normalisation"] = input.conditioning.normalisation == Normalisation::printed ? "printed" : "homogeneous";
  if (input.conditioning.characteristic_length)
    json["characteristic_length"] = *input.conditioning.characteristic_length;
  if (const auto design = collinear_design(manipulator); input.as_design && design) {
    const auto d = to_vector(*design);
    json["design"] = std::vector<double>(d.begin(), d.end());
    json["length"] = Json::array();
    for (const Leg& leg : manipulator.legs()) json["length"].push_back(pair_json(leg.length));
    return json;
  }
  json["leg"] = Json::array();
  for (const Leg& leg : manipulator.legs()) json["leg"].push_back(leg_json(leg));
  return json;
}

Json problem_json(const FileInput& input) {
  Json json{{"manipulator", manipulator_json(input.manipulator)}};
  if (!input.problem) return json;
  json["workspace"] = workspace_json(*input.problem);
  json["orientations"] = orientations_json(input.problem->task.orientations);
  json["design"] = design_table_json(input.problem->task.designs);
  return json;
}

}  // namespace reprise::explorer
