// reprise workspace, reprise dextrous, reprise orientation: what a manipulator reaches.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "command.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/study/mapped_workspace.hpp"
#include "reprise/study/solvers.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/orientation_workspace.hpp"

namespace reprise::app {

namespace {

const NumberRange orientation_range = NumberRange::between(-1e6, 1e6);

/// What both kinds of workspace share: exact, or by the chord method with a chosen solver.
class MappingCommand : public Command {
 protected:
  MappingCommand(std::string name, std::string summary, const std::string& description, const std::string& examples)
      : Command(std::move(name), std::move(summary), description, examples) {
    std::vector<std::string> solvers = solver_names();
    solvers.insert(solvers.begin(), solver_);
    options().flag("--exact", exact_, "the exact region, bounded by arcs and segments (this is the default)");
    options().number("--chord", chord_, NumberRange::positive(largest_length),
                     fmt::format("trace the boundary by the chord method with this chord length instead, at most {} "
                                 "chords",
                                 most_chords));
    options().choice("--solver", solver_, solvers,
                     "what solves for the boundary points of the chord method: bracketing, or an optimizer");
    draws();
    writes_files({"boundary.csv", "bifurcation_points.csv"});
  }

  /// The rest of the output, `document` and `title` being the beginning of it.
  Output map(const ManipulatorInput& input, const Limits& limits, const Region& region, const Json& document,
             const std::string& title) {
    if (exact_ && chord_) throw UsageError("both --exact and --chord are given, but only one of them is allowed.");
    if (solver_ != "bracketing" && !chord_)
      throw UsageError("--solver is given without --chord, but only the chord method has a solver.");
    const MappedWorkspace mapped =
        chord_ ? trace_workspace(limits, region, *chord_, solver_) : exact_workspace(limits, region);
    Output output;
    output.unit = input.unit;
    output.document["manipulator"] = input.manipulator.name();
    output.document.update(document);
    output.document.update(to_json(mapped));
    output.exit_code = mapped.complete() ? 0 : 1;
    output.text = title + '\n' + to_text(mapped, input.unit);
    const std::string name = mapped.complete() ? title : title + ", not complete";
    output.tables = to_tables(name, mapped, input.column_unit());
    output.picture = [=] {
      Outline bifurcation_points;
      for (const MappedComponent& component : mapped.components) {
        for (const MappedVertex& vertex : component.bifurcation_points) bifurcation_points.push_back(vertex.position);
      }
      return draw_workspace(name, input, drawn(mapped), bifurcation_points);
    };
    return output;
  }

 private:
  bool exact_ = false;
  std::optional<double> chord_;
  std::string solver_ = "bracketing";
};

class WorkspaceCommand final : public MappingCommand {
 public:
  WorkspaceCommand()
      : MappingCommand("workspace", "The workspace at a constant orientation",
                       "All positions of the working point that the limits allow at one orientation of the platform:\n"
                       "components, holes, area, boundary and bifurcation points (where two limits meet).",
                       "reprise workspace examples/M1.toml --orientation 0\n"
                       "reprise workspace examples/M1.toml --chord 0.02 --solver dynamic_q --json\n"
                       "reprise workspace examples/triangle.toml --orientation 10 --plot workspace.svg --out results") {
    options().number("--orientation", orientation_deg_, orientation_range, "orientation of the platform, degrees");
  }

 private:
  Output compute() override {
    const ManipulatorInput input = read_manipulator(file());
    const Manipulator& manipulator = input.manipulator;
    const double orientation = orientation_deg_ * degree;
    return map(input, ConstantOrientationLimits(manipulator, orientation),
               constant_orientation_workspace(manipulator, orientation), {{"orientation_deg", orientation_deg_}},
               fmt::format("{}, orientation {}°", manipulator.name(), short_number(orientation_deg_)));
  }

  double orientation_deg_ = 0.0;
};

class DextrousCommand final : public MappingCommand {
 public:
  DextrousCommand()
      : MappingCommand("dextrous", "The dextrous workspace of a range of orientations",
                       "All positions of the working point at which every orientation of a range can be attained.",
                       "reprise dextrous examples/M2.toml --range -5 5\n"
                       "reprise dextrous examples/triangle.toml --range -8 8 --plot dextrous.pdf --json") {
    options().tuple("--range", range_deg_, "LOWER UPPER", orientation_range,
                    "lowest and highest orientation, degrees, less than a full turn apart");
  }

 private:
  Output compute() override {
    if (!(range_deg_[0] <= range_deg_[1] && range_deg_[1] - range_deg_[0] < 360.0)) {
      throw UsageError(
          fmt::format("--range is '{} {}', but its second number must not be below the first, and less than "
                      "360 above it.",
                      range_deg_[0], range_deg_[1]));
    }
    const ManipulatorInput input = read_manipulator(file());
    const Manipulator& manipulator = input.manipulator;
    const Interval range{range_deg_[0] * degree, range_deg_[1] * degree};
    return map(input, DextrousLimits(manipulator, range), dextrous_workspace(manipulator, range),
               {{"range_deg", range_deg_}},
               fmt::format("{}, all orientations from {}° to {}°", manipulator.name(), short_number(range_deg_[0]),
                           short_number(range_deg_[1])));
  }

  std::vector<double> range_deg_;
};

class OrientationCommand final : public Command {
 public:
  OrientationCommand()
      : Command("orientation", "All orientations that can be attained at a position",
                "The orientation workspace at a position of the working point: every interval of orientations that the "
                "limits\n"
                "allow, in closed form.",
                "reprise orientation examples/M2.toml --at 1 1.5\n"
                "reprise orientation examples/triangle.toml --at 20 150 --json --plot orientations.svg") {
    options().tuple("--at", position_, "X Y", NumberRange::between(-largest_length, largest_length),
                    "position of the working point");
    draws();
    writes_files({"orientations.csv"});
  }

 private:
  Output compute() override {
    const ManipulatorInput input = read_manipulator(file());
    const std::vector<Interval> intervals = orientation_workspace(input.manipulator, {position_[0], position_[1]});
    const std::string title = fmt::format("{}, orientations at x = {}, y = {}", input.manipulator.name(),
                                          with_unit(position_[0], input.unit), with_unit(position_[1], input.unit));
    Output output;
    output.text = title + "\n";
    Table table(title, {{"lower_deg", "degree", "lowest orientation of an interval"},
                        {"upper_deg", "degree", "highest orientation of an interval"}});
    Json list = Json::array();
    for (const Interval& interval : intervals) {
      const double lower = interval.lower / degree;
      const double upper = interval.upper / degree;
      list.push_back({lower, upper});
      table.add_row({lower, upper});
      output.text += fmt::format("  from {} to {} degrees\n", short_number(lower), short_number(upper));
    }
    if (intervals.empty()) output.text += "  none: the position cannot be reached at any orientation\n";
    output.unit = input.unit;
    output.document["manipulator"] = input.manipulator.name();
    output.document["position"] = position_;
    output.document["intervals_deg"] = list;
    output.tables = {{"orientations", table}};
    output.picture = [=] { return draw_orientations(title, intervals); };
    return output;
  }

  std::vector<double> position_;
};

}  // namespace

std::vector<std::unique_ptr<Command>> workspace_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<WorkspaceCommand>());
  commands.push_back(std::make_unique<DextrousCommand>());
  commands.push_back(std::make_unique<OrientationCommand>());
  return commands;
}

}  // namespace reprise::app
