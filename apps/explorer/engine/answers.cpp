#include "answers.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "problem_json.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/kinematics/singular_positions.hpp"
#include "reprise/study/mapped_workspace.hpp"
#include "reprise/study/pose_documents.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/orientation_workspace.hpp"
#include "search.hpp"
#include "singular_curve.hpp"

namespace reprise::explorer {

namespace {

/// Points of an outline that is drawn.
constexpr int outline_points = 180;

Eigen::Vector2d point_of(const Json& pair) { return {pair.at(0).get<double>(), pair.at(1).get<double>()}; }

Json workspace_json(const FileInput& input, double orientation_deg) {
  const Manipulator& manipulator = input.manipulator.manipulator;
  const double orientation = orientation_deg * degree;
  Json document{{"manipulator", manipulator.name()}, {"orientation_deg", orientation_deg}};
  document.update(to_json(exact_workspace(ConstantOrientationLimits(manipulator, orientation),
                                          constant_orientation_workspace(manipulator, orientation))));
  return document;
}

Json dextrous_json(const FileInput& input, const Eigen::Vector2d& range_deg) {
  const Manipulator& manipulator = input.manipulator.manipulator;
  const Interval range{range_deg.x() * degree, range_deg.y() * degree};
  Json document{{"manipulator", manipulator.name()}, {"range_deg", to_json(range_deg)}};
  document.update(to_json(exact_workspace(DextrousLimits(manipulator, range), dextrous_workspace(manipulator, range))));
  return document;
}

Json orientation_json(const FileInput& input, const Eigen::Vector2d& position) {
  Json intervals = Json::array();
  for (const Interval& interval : orientation_workspace(input.manipulator.manipulator, position)) {
    intervals.push_back({interval.lower / degree, interval.upper / degree});
  }
  return {{"manipulator", input.manipulator.manipulator.name()},
          {"position", to_json(position)},
          {"intervals_deg", intervals}};
}

Json assemble_json(const FileInput& input, const std::vector<double>& lengths) {
  if (input.manipulator.manipulator.size() != 3 || lengths.size() != 3) {
    throw std::invalid_argument("Assembly modes are known for manipulators with three legs.");
  }
  return modes_json(input.manipulator, lengths,
                    assembly_modes(input.manipulator.manipulator, {lengths[0], lengths[1], lengths[2]}));
}

Json singular_json(const FileInput& input, const Json& question) {
  const Manipulator& manipulator = input.manipulator.manipulator;
  Json curves = Json::array();
  if (manipulator.size() <= 3) {
    const auto polynomial = singularity_polynomial(manipulator, question.at("orientation_deg").get<double>() * degree);
    const Eigen::AlignedBox2d box(point_of(question.at("box").at(0)), point_of(question.at("box").at(1)));
    for (const auto& curve : singular_curve(polynomial, box)) curves.push_back(to_json(curve));
  }
  return {{"manipulator", manipulator.name()}, {"curves", curves}};
}

/// What `act` gives, as text, or the sentence of what it throws.
template <class Act>
std::string or_error(const Act& act) {
  try {
    return act().dump();
  } catch (const std::exception& error) {
    return Json{{"error", error.what()}}.dump();
  }
}

}  // namespace

Json answer(const FileInput& input, const Json& question) {
  const auto command = question.at("command").get<std::string>();
  if (command == "pose") {
    return pose_json(input.manipulator, point_of(question.at("position")),
                     question.at("orientation_deg").get<double>());
  }
  if (command == "assemble") return assemble_json(input, question.at("lengths").get<std::vector<double>>());
  if (command == "workspace") return workspace_json(input, question.at("orientation_deg").get<double>());
  if (command == "dextrous") return dextrous_json(input, point_of(question.at("range_deg")));
  if (command == "orientation") return orientation_json(input, point_of(question.at("position")));
  if (command == "problem") return problem_json(input);
  if (command == "design") return input.problem ? design_json(*input.problem) : Json::object();
  if (command == "assessment") return input.problem ? assessment_json(*input.problem) : Json::object();
  if (command == "outline") {
    return {{"points", input.problem ? to_json(input.problem->task.prescribed.points(outline_points)) : Json::array()}};
  }
  if (command == "singular") return singular_json(input, question);
  throw std::invalid_argument(fmt::format("There is no command '{}'.", command));
}

std::string respond(const std::string& request) {
  return or_error([&] {
    const Json asked = Json::parse(request);
    const auto file = asked.at("file").get<std::string>();
    const FileInput input = read_input(file);
    const std::string& unit = input.manipulator.unit;
    Json answers = Json::array();
    for (const Json& question : asked.at("questions")) {
      Json document{{"schema", schema}, {"command", question.at("command")}, {"file", file}};
      document.update(answer(input, question));
      document["unit"] = unit.empty() ? Json() : Json(unit);
      answers.push_back(document);
    }
    return Json{{"answers", answers}};
  });
}

std::string respond_to_search(const std::string& request, const std::function<void(const std::string&)>& report) {
  return or_error([&] {
    const Json asked = Json::parse(request);
    return search(read_problem(asked.at("file").get<std::string>()), asked.at("formulation").get<std::string>(),
                  [&](const Json& iterate) { report(iterate.dump()); });
  });
}

}  // namespace reprise::explorer
