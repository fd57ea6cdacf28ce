// reprise pose, reprise assemble: one pose of a manipulator, and the poses of given leg lengths.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "command.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/io/toml_reader.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/workspace/limits.hpp"
#include "singular_ratio.hpp"

namespace reprise::app {

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

std::string matrix_text(const Eigen::MatrixXd& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    text += "   ";
    for (Eigen::Index j = 0; j < values.cols(); ++j) text += fmt::format(" {:>12}", short_number(values(i, j)));
    text += '\n';
  }
  return text;
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

class PoseCommand final : public Command {
 public:
  PoseCommand()
      : Command("pose", "Leg lengths, limits, Jacobian and conditioning at a pose",
                "The inverse kinematics at a position of the working point and an orientation of the platform: leg "
                "lengths,\n"
                "which limits hold, the Jacobian of the leg lengths, its condition number kappa in the Frobenius norm "
                "and in\n"
                "the 2-norm, and whether the pose is singular.",
                "reprise pose examples/M1.toml --at 1 1.5\n"
                "reprise pose examples/triangle.toml --at 20 150 --orientation -10 --json\n"
                "reprise pose examples/triangle.toml --at 20 150 --plot pose.svg") {
    options().tuple("--at", position_, "X Y", NumberRange::between(-largest_length, largest_length),
                    "position of the working point");
    options().number("--orientation", orientation_deg_, NumberRange::between(-1e6, 1e6), "orientation, degrees");
    draws();
  }

 private:
  Output compute() override {
    const ManipulatorInput input = read_manipulator(file());
    const Manipulator& manipulator = input.manipulator;
    const Conditioning& conditioning = input.conditioning;
    const Pose pose{{position_[0], position_[1]}, orientation_deg_ * degree};
    Output output;
    Json& document = output.document;
    output.unit = input.unit;
    document["manipulator"] = manipulator.name();
    document["position"] = to_json(pose.position);
    document["orientation_deg"] = orientation_deg_;
    std::string& text = output.text;
    text = fmt::format(
        "{} at x = {}, y = {}, orientation {} deg\n\nleg  length        minimum       maximum       base angle    "
        "platform angle [{}deg]\n",
        manipulator.name(), with_unit(pose.position.x(), input.unit), with_unit(pose.position.y(), input.unit),
        short_number(orientation_deg_), input.unit.empty() ? "" : input.unit + ", ");
    Json legs = Json::array();
    Json base_angles = Json::array();
    Json platform_angles = Json::array();
    for (std::size_t i = 0; i < manipulator.size(); ++i) {
      const Leg& leg = manipulator.leg(i);
      const double length = leg_length(leg, pose);
      const double at_base = base_angle(leg, pose) / degree;
      const double at_platform = platform_angle(leg, pose) / degree;
      legs.push_back(length);
      base_angles.push_back(at_base);
      platform_angles.push_back(at_platform);
      text += fmt::format("{:>3}  {:<12}  {:<12}  {:<12}  {:<12}  {}\n", i + 1, short_number(length),
                          short_number(leg.length.lower), short_number(leg.length.upper), short_number(at_base),
                          short_number(at_platform));
    }
    document["legs"] = legs;
    document["base_angles_deg"] = base_angles;
    document["platform_angles_deg"] = platform_angles;
    Json limits = Json::array();
    bool within = true;
    text += "\nlimits\n";
    for (const Limit& limit : list_limits(manipulator)) {
      const Leg& leg = manipulator.leg(limit.leg);
      const double margin = -limit_value(leg, limit.kind, leg_vector(leg, pose), pose.orientation);
      const bool holds = margin >= -rounding(manipulator);
      within = within && holds;
      limits.push_back({{"limit", to_string(limit)}, {"margin", margin}, {"holds", holds}});
      text += fmt::format("  {:<28} {:<9} margin {}\n", to_string(limit), holds ? "holds" : "VIOLATED",
                          with_unit(margin, input.unit));
    }
    document["limits"] = limits;
    document["within_limits"] = within;
    text += fmt::format("  all limits: {}\n",
                        within ? "hold, the pose can be attained" : "some are violated, the pose cannot be attained");
    const Eigen::MatrixXd jacobian_matrix = jacobian(manipulator, pose);
    const double inverse = kappa_inverse(manipulator, pose, conditioning);
    const double inverse_2norm = kappa_inverse_2norm(manipulator, pose, conditioning);
    const double characteristic = characteristic_length(manipulator, conditioning);
    const bool singular = inverse_2norm < singular_ratio;
    document["jacobian"] = matrix(jacobian_matrix);
    document["normalised_jacobian"] = matrix(normalised_jacobian(manipulator, pose, conditioning));
    document["normalisation"] = name_of(conditioning.normalisation);
    document["characteristic_length"] = characteristic;
    document["kappa"] = singular ? Json() : Json(1.0 / inverse);
    document["kappa_inv"] = inverse;
    document["kappa_inv_2norm"] = inverse_2norm;
    document["singular"] = singular;
    text += "\nJacobian of the leg lengths, dl/d[x, y, phi] (phi in radians)\n" + matrix_text(jacobian_matrix);
    text += fmt::format(
        "\nkappa      {}\nkappa^-1   {}   (Frobenius norm, {} normalisation, characteristic length {})\n"
        "kappa^-1   {}   (2-norm)\n{}\n",
        singular ? "infinite" : short_number(1.0 / inverse), short_number(inverse), name_of(conditioning.normalisation),
        with_unit(characteristic, input.unit), short_number(inverse_2norm),
        singular ? "The pose is singular." : "The pose is not singular.");
    output.picture = [input, pose] { return draw_poses(input.manipulator, {pose}, input.column_unit()); };
    return output;
  }

  std::vector<double> position_;
  double orientation_deg_ = 0.0;
};

class AssembleCommand final : public Command {
 public:
  AssembleCommand()
      : Command("assemble", "All poses that given leg lengths allow (assembly modes)",
                "The forward kinematics of a manipulator with three legs: every pose at which the legs have the given "
                "lengths,\n"
                "at most six. Limits play no part in finding them; each mode says whether it is within them. The "
                "multiplicity\n"
                "of a mode is how many have come together there: 1, except at singular poses. 0 marks a pose that is "
                "alone only\n"
                "among real ones.",
                "reprise assemble examples/M1.toml --lengths 1.8 1.8 1.5\n"
                "reprise assemble examples/triangle.toml --lengths 180 170 160 --plot modes.svg --json") {
    options().tuple("--lengths", lengths_, "L1 L2 L3", NumberRange::between(0.0, largest_length),
                    "the lengths of the three legs");
    draws();
  }

 private:
  Output compute() override {
    const ManipulatorInput input = read_manipulator(file());
    const Manipulator& manipulator = input.manipulator;
    if (manipulator.size() != 3) {
      throw InputError(fmt::format("{}: the manipulator has {}, but assemble needs one with three legs.",
                                   file().string(), counted(manipulator.size(), "leg")));
    }
    const AssemblyModes modes = assembly_modes(manipulator, {lengths_[0], lengths_[1], lengths_[2]});
    Output output;
    output.unit = input.unit;
    output.document["manipulator"] = manipulator.name();
    output.document["legs"] = lengths_;
    output.document["infinitely_many"] = modes.infinitely_many;
    output.text = fmt::format("{}: {}\n", manipulator.name(),
                              modes.infinitely_many ? "the lengths leave a motion free: infinitely many modes"
                              : modes.poses.empty() ? "the lengths cannot be reached: no assembly mode"
                                                    : counted(modes.poses.size(), "assembly mode"));
    const auto column = [&input](const char* name) {
      return input.unit.empty() ? name : fmt::format("{} [{}]", name, input.unit);
    };
    if (!modes.poses.empty())
      output.text += fmt::format("\n{:<12}  {:<12}  orientation [deg]  multiplicity  kappa^-1      limits\n",
                                 column("x"), column("y"));
    Json list = Json::array();
    for (std::size_t i = 0; i < modes.poses.size(); ++i) {
      const Pose& pose = modes.poses[i];
      const bool within = largest_limit(manipulator, pose) <= rounding(manipulator);
      const double inverse = kappa_inverse(manipulator, pose, input.conditioning);
      list.push_back({{"x", pose.position.x()},
                      {"y", pose.position.y()},
                      {"orientation_deg", pose.orientation / degree},
                      {"multiplicity", modes.multiplicities[i]},
                      {"kappa_inv", inverse},
                      {"within_limits", within}});
      output.text += fmt::format("{:<12}  {:<12}  {:<17}  {:<12}  {:<12}  {}\n", short_number(pose.position.x()),
                                 short_number(pose.position.y()), short_number(pose.orientation / degree),
                                 modes.multiplicities[i], short_number(inverse), within ? "hold" : "violated");
    }
    output.document["modes"] = list;
    output.picture = [input, poses = modes.poses] { return draw_poses(input.manipulator, poses, input.column_unit()); };
    return output;
  }

  std::vector<double> lengths_;
};

}  // namespace

std::vector<std::unique_ptr<Command>> pose_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<PoseCommand>());
  commands.push_back(std::make_unique<AssembleCommand>());
  return commands;
}

}  // namespace reprise::app
