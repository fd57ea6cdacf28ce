// reprise pose, reprise assemble: one pose of a manipulator, and the poses of given leg lengths.

#include <fmt/format.h>

#include "command.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/io/toml_reader.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/study/pose_documents.hpp"

namespace reprise::app {

namespace {

std::string matrix_text(const Eigen::MatrixXd& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    text += "   ";
    for (Eigen::Index j = 0; j < values.cols(); ++j) text += fmt::format(" {:>12}", short_number(values(i, j)));
    text += '\n';
  }
  return text;
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
    const Pose pose{{position_[0], position_[1]}, orientation_deg_ * degree};
    Output output;
    output.unit = input.unit;
    output.document = pose_json(input, pose.position, orientation_deg_);
    const Json& document = output.document;
    std::string& text = output.text;
    text = fmt::format(
        "{} at x = {}, y = {}, orientation {} deg\n\nleg  length        minimum       maximum       base angle    "
        "platform angle [{}deg]\n",
        manipulator.name(), with_unit(pose.position.x(), input.unit), with_unit(pose.position.y(), input.unit),
        short_number(orientation_deg_), input.unit.empty() ? "" : input.unit + ", ");
    for (std::size_t i = 0; i < manipulator.size(); ++i) {
      const Leg& leg = manipulator.leg(i);
      text +=
          fmt::format("{:>3}  {:<12}  {:<12}  {:<12}  {:<12}  {}\n", i + 1, short_number(leg_length(leg, pose)),
                      short_number(leg.length.lower), short_number(leg.length.upper),
                      short_number(base_angle(leg, pose) / degree), short_number(platform_angle(leg, pose) / degree));
    }
    text += "\nlimits\n";
    for (const Json& limit : document["limits"]) {
      text += fmt::format("  {:<28} {:<9} margin {}\n", limit["limit"].get<std::string>(),
                          limit["holds"].get<bool>() ? "holds" : "VIOLATED",
                          with_unit(limit["margin"].get<double>(), input.unit));
    }
    text += fmt::format("  all limits: {}\n", document["within_limits"].get<bool>()
                                                  ? "hold, the pose can be attained"
                                                  : "some are violated, the pose cannot be attained");
    const bool singular = document["singular"].get<bool>();
    const auto number = [&](const char* key) { return short_number(document[key].get<double>()); };
    text +=
        "\nJacobian of the leg lengths, dl/d[x, y, phi] (phi in radians)\n" + matrix_text(jacobian(manipulator, pose));
    text += fmt::format(
        "\nkappa      {}\nkappa^-1   {}   (Frobenius norm, {} normalisation, characteristic length {})\n"
        "kappa^-1   {}   (2-norm)\n{}\n",
        singular ? "infinite" : number("kappa"), number("kappa_inv"), document["normalisation"].get<std::string>(),
        with_unit(document["characteristic_length"].get<double>(), input.unit), number("kappa_inv_2norm"),
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
    output.document = modes_json(input, lengths_, modes);
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
    for (const Json& mode : output.document["modes"]) {
      const auto number = [&](const char* key) { return short_number(mode[key].get<double>()); };
      output.text += fmt::format("{:<12}  {:<12}  {:<17}  {:<12}  {:<12}  {}\n", number("x"), number("y"),
                                 number("orientation_deg"), mode["multiplicity"].get<int>(), number("kappa_inv"),
                                 mode["within_limits"].get<bool>() ? "hold" : "violated");
    }
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
