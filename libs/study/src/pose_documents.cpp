#include "reprise/study/pose_documents.hpp"

#include <algorithm>
#include <limits>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

namespace {

Json matrix(const Eigen::MatrixXd& values) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < values.cols(); ++j) row.push_back(values(i, j));
    rows.push_back(row);
  }
  return rows;
}

/// The largest violation of a limit at a pose, in closed form; not positive where all hold.
double largest_limit(const Manipulator& manipulator, const Pose& pose) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Limit& limit : list_limits(manipulator)) {
    const Leg& leg = manipulator.leg(limit.leg);
    largest = std::max(largest, limit_value(leg, limit.kind, leg_vector(leg, pose), pose.orientation));
  }
  return largest;
}

/// How far beyond a limit a pose may be, because of rounding, for the limit to hold.
double rounding(const Manipulator& manipulator) {
  double size = 0.0;
  for (const Leg& leg : manipulator.legs()) {
    size = std::max({size, leg.length.upper, leg.base_joint.norm(), leg.platform_joint.norm()});
  }
  return 1e-12 * size;
}

const char* name_of(Normalisation normalisation) {
  return normalisation == Normalisation::printed ? "printed" : "homogeneous";
}

}  // namespace

Json pose_json(const ManipulatorInput& input, const Eigen::Vector2d& position, double orientation_deg) {
  const Manipulator& manipulator = input.manipulator;
  const Conditioning& conditioning = input.conditioning;
  const Pose pose{position, orientation_deg * degree};
  Json legs = Json::array();
  Json base_angles = Json::array();
  Json platform_angles = Json::array();
  for (const Leg& leg : manipulator.legs()) {
    legs.push_back(leg_length(leg, pose));
    base_angles.push_back(base_angle(leg, pose) / degree);
    platform_angles.push_back(platform_angle(leg, pose) / degree);
  }
  Json limits = Json::array();
  bool within = true;
  for (const Limit& limit : list_limits(manipulator)) {
    const Leg& leg = manipulator.leg(limit.leg);
    const double margin = -limit_value(leg, limit.kind, leg_vector(leg, pose), pose.orientation);
    const bool holds = margin >= -rounding(manipulator);
    within = within && holds;
    limits.push_back({{"limit", to_string(limit)}, {"margin", margin}, {"holds", holds}});
  }
  const double inverse = kappa_inverse(manipulator, pose, conditioning);
  const double inverse_2norm = kappa_inverse_2norm(manipulator, pose, conditioning);
  const bool singular = inverse_2norm < singular_ratio;
  return {{"manipulator", manipulator.name()},
          {"position", to_json(position)},
          {"orientation_deg", orientation_deg},
          {"legs", legs},
          {"base_angles_deg", base_angles},
          {"platform_angles_deg", platform_angles},
          {"limits", limits},
          {"within_limits", within},
          {"jacobian", matrix(jacobian(manipulator, pose))},
          {"normalised_jacobian", matrix(normalised_jacobian(manipulator, pose, conditioning))},
          {"normalisation", name_of(conditioning.normalisation)},
          {"characteristic_length", characteristic_length(manipulator, conditioning)},
          {"kappa", singular ? Json() : Json(1.0 / inverse)},
          {"kappa_inv", inverse},
          {"kappa_inv_2norm", inverse_2norm},
          {"singular", singular}};
}

Json modes_json(const ManipulatorInput& input, const std::vector<double>& lengths, const AssemblyModes& modes) {
  Json list = Json::array();
  for (std::size_t i = 0; i < modes.poses.size(); ++i) {
    const Pose& pose = modes.poses[i];
    list.push_back({{"x", pose.position.x()},
                    {"y", pose.position.y()},
                    {"orientation_deg", pose.orientation / degree},
                    {"multiplicity", modes.multiplicities[i]},
                    {"kappa_inv", kappa_inverse(input.manipulator, pose, input.conditioning)},
                    {"within_limits", largest_limit(input.manipulator, pose) <= rounding(input.manipulator)}});
  }
  return {{"manipulator", input.manipulator.name()},
          {"legs", lengths},
          {"infinitely_many", modes.infinitely_many},
          {"modes", list}};
}

}  // namespace reprise
