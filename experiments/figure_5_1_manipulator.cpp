// Figure 5.1: the 3-RPR manipulator, drawn to scale with its symbols. The chapter's own picture is lost in the copy at
// hand; this one follows the text of section 5.2.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "frame/source_tree.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/workspace/limits.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;
using Points = std::vector<Eigen::Vector2d>;

/// The pose of the picture: one at which every symbol has room.
const Pose pictured_pose{{0.9, 1.5}, 20.0 * pi / 180.0};

constexpr const char* outline_colour = "#26323c";
constexpr const char* cylinder_colour = "#a9cde6";
constexpr const char* rod_colour = "#eef2f5";
constexpr const char* platform_colour = "#f3c9a5";
constexpr const char* support_colour = "#d5dade";

/// The dimensions as printed for P2 in Table 5.3. M1 to M3 have y_C = 0 and would not show that symbol.
CollinearDesign pictured_design() {
  const Table row = read_table(data_folder() / "published" / "table_5_3.csv").where("workspace", "P2");
  return {row.number(0, "x_C"), row.number(0, "y_C"), row.number(0, "x_D"), row.number(0, "x_E"), row.number(0, "r")};
}

/// Joints, working point and members of the manipulator at the pose.
Table describe(const CollinearDesign& design, const std::array<Interval, 3>& lengths, const Pose& pose) {
  const Manipulator manipulator = make_manipulator(design, lengths);
  const ConstantOrientationLimits limits(manipulator, pose.orientation);
  Eigen::VectorXd h(limits.count());
  limits.evaluate(pose.position, h);
  if (h.maxCoeff() > 0.0) throw std::runtime_error("the manipulator cannot attain the pose of the picture.");

  Table table("Figure 5.1: the 3-dof parallel manipulator",
              {{"element", "-", "point, or member that joins two points"},
               {"name", "-", "symbol of the thesis"},
               {"x", "length", "x coordinate, of a member at its start"},
               {"y", "length", "y coordinate, of a member at its start"},
               {"x_end", "length", "x coordinate at a member's end"},
               {"y_end", "length", "y coordinate at a member's end"},
               {"value", "-", "length of a member; of the working point the platform's orientation phi_P in degrees"}},
              {"Design as printed in Table 5.3 for P2: y_C is not zero, so that all five parameters show."});
  const auto add_point = [&](const char* name, const Eigen::Vector2d& at, const Field& value = {}) {
    table.add_row({"point", name, at.x(), at.y(), {}, {}, value});
  };
  const auto add_member = [&](const char* element, const std::string& name, const Eigen::Vector2d& from,
                              const Eigen::Vector2d& to) {
    table.add_row({element, name, from.x(), from.y(), to.x(), to.y(), (to - from).norm()});
  };
  const auto base_joint = [&](std::size_t leg) { return manipulator.leg(leg).base_joint; };
  const auto platform_joint = [&](std::size_t leg) {
    return Eigen::Vector2d(base_joint(leg) + leg_vector(manipulator.leg(leg), pose));
  };
  add_point("C", base_joint(0));
  add_point("D", base_joint(1));
  add_point("E", base_joint(2));
  add_point("A", platform_joint(0));
  add_point("B", platform_joint(2));
  add_point("P", pose.position, pose.orientation * 180.0 / pi);
  for (std::size_t leg = 0; leg < 3; ++leg) {
    add_member("leg", fmt::format("l_{}", leg + 1), base_joint(leg), platform_joint(leg));
  }
  add_member("platform", "2r", platform_joint(0), platform_joint(2));
  return table;
}

/// Closed shapes and lines in the plane, drawn in the order in which they come.
class Drawing {
 public:
  /// Shows the box, with one unit of length that many points long.
  Drawing(const Eigen::AlignedBox2d& box, double scale)
      : figure_(static_cast<int>(scale * box.sizes().x()), static_cast<int>(scale * box.sizes().y())) {
    figure_.add(
        fmt::format("set termoption enhanced\nunset border\nunset tics\nunset grid\nunset key\nset size ratio -1\n"
                    "set margins 0, 0, 0, 0\nset xrange [{}:{}]\nset yrange [{}:{}]",
                    box.min().x(), box.max().x(), box.min().y(), box.max().y()));
  }

  void fill(Points corners, const char* colour) {
    corners.push_back(corners.front());
    add(corners,
        fmt::format("with filledcurves closed fillcolor rgb '{}' fillstyle solid 1.0 border lc rgb '{}' lw 1.3", colour,
                    outline_colour));
  }
  void line(const Points& points, const char* colour, double width, int dashes = 1) {
    add(points, fmt::format("with lines lc rgb '{}' lw {} dashtype {}", colour, width, dashes));
  }
  /// `ends` as gnuplot names them: head, or heads for both.
  void arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const char* colour, double width,
             const char* ends) {
    figure_.add(fmt::format("set arrow from {},{} to {},{} {} filled size first 0.07,14 lc rgb '{}' lw {} front",
                            from.x(), from.y(), to.x(), to.y(), ends, colour, width));
  }
  void circle(const Eigen::Vector2d& centre, double radius, const char* colour) {
    const std::string data = figure_.add_data({{centre.x(), centre.y(), radius}});
    plots_.push_back(
        fmt::format("{} using 1:2:3 with circles fillcolor rgb '{}' fillstyle solid 1.0 border lc rgb '{}' "
                    "lw 1.6",
                    data, colour, outline_colour));
  }
  /// A text in gnuplot's enhanced mode.
  void label(const Eigen::Vector2d& at, const std::string& text, const char* alignment = "center") {
    figure_.add(fmt::format("set label {} at {},{} {} front font ',15' textcolor rgb '{}'", gnuplot_string(text),
                            at.x(), at.y(), alignment, outline_colour));
  }

  Figure finish() {
    figure_.add(fmt::format("plot {}", fmt::join(plots_, ", \\\n")));
    return figure_;
  }

 private:
  void add(const Points& points, const std::string& style) {
    std::vector<std::vector<double>> rows;
    for (const Eigen::Vector2d& point : points) rows.push_back({point.x(), point.y()});
    plots_.push_back(fmt::format("{} using 1:2 {}", figure_.add_data(rows), style));
  }

  Figure figure_;
  std::vector<std::string> plots_;
};

/// A symbol in italics with an upright index.
std::string symbol(const std::string& letter, const std::string& index = "") {
  return fmt::format("{{/:Italic {}}}{}", letter, index.empty() ? "" : fmt::format("_{{{}}}", index));
}

/// The rectangle about the line from `from` to `to`.
Points bar(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width) {
  const Eigen::Vector2d side = 0.5 * width * quarter_turned((to - from).normalized());
  return {from + side, to + side, to - side, from - side};
}

/// The same with round ends.
Points round_bar(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width) {
  constexpr int parts = 24;
  const Eigen::Vector2d along = (to - from).normalized();
  Points points;
  for (const auto& [end, first] : {std::pair{to, -0.5}, std::pair{from, 0.5}}) {
    for (int k = 0; k <= parts; ++k) {
      const Eigen::Vector2d turn = unit(pi * (first + static_cast<double>(k) / parts));
      points.emplace_back(end + 0.5 * width * (turn.x() * along + turn.y() * quarter_turned(along)));
    }
  }
  return points;
}

/// A linear actuator: a cylinder at the base, a rod that leaves it.
void draw_leg(Drawing& drawing, const Eigen::Vector2d& base, const Eigen::Vector2d& platform) {
  const auto at = [&](double distance) { return Eigen::Vector2d(base + distance * (platform - base).normalized()); };
  constexpr double cylinder_begin = 0.14, cylinder_end = 0.86, gland = 0.05;
  drawing.fill(bar(base, at(cylinder_begin), 0.07), rod_colour);
  drawing.fill(bar(at(cylinder_end), platform, 0.045), rod_colour);
  drawing.fill(bar(at(cylinder_begin), at(cylinder_end), 0.13), cylinder_colour);
  drawing.fill(bar(at(cylinder_end - gland), at(cylinder_end), 0.13), support_colour);
}

/// A pin support on hatched ground.
void draw_support(Drawing& drawing, const Eigen::Vector2d& joint) {
  constexpr double height = 0.17, half_width = 0.19, hatch = 0.065;
  const Eigen::Vector2d foot = joint - Eigen::Vector2d(0.0, height);
  for (double x = -half_width; x < half_width - 1e-9; x += hatch) {
    const Eigen::Vector2d top = foot + Eigen::Vector2d(x + hatch, 0.0);
    drawing.line({top, top - Eigen::Vector2d::Constant(hatch)}, outline_colour, 1.0);
  }
  drawing.fill({joint, foot + Eigen::Vector2d(-0.12, 0.0), foot + Eigen::Vector2d(0.12, 0.0)}, support_colour);
  drawing.line({foot - Eigen::Vector2d(half_width, 0.0), foot + Eigen::Vector2d(half_width, 0.0)}, outline_colour, 1.8);
}

Figure draw(const Table& table) {
  const auto row = [&](const char* name) { return table.where("name", name); };
  const auto start = [&](const char* name) {
    return Eigen::Vector2d(row(name).number(0, "x"), row(name).number(0, "y"));
  };
  const auto end = [&](const char* name) {
    return Eigen::Vector2d(row(name).number(0, "x_end"), row(name).number(0, "y_end"));
  };
  const Eigen::Vector2d c = start("C"), d = start("D"), e = start("E"), p = start("P");
  const Eigen::Vector2d a = start("2r"), b = end("2r");
  const double phi = row("P").number(0, "value") * pi / 180.0;
  const Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  constexpr const char* thin = colour::grey;

  Drawing drawing({Eigen::Vector2d(-1.55, -0.58), Eigen::Vector2d(2.3, 2.22)}, 200.0);

  // Coordinates of the base joints, from the world frame.
  drawing.line({c - Eigen::Vector2d(0.3, 0.0), e + Eigen::Vector2d(0.3, 0.0)}, thin, 1.0, 4);
  constexpr double first_row = -0.24, second_row = -0.46;
  drawing.line({origin, {0.0, second_row - 0.05}}, thin, 0.8);
  const auto dimension = [&](const Eigen::Vector2d& joint, double y, const char* index) {
    drawing.line({{joint.x(), 0.03}, {joint.x(), y - 0.05}}, thin, 0.8);
    drawing.circle({0.0, y}, 0.015, outline_colour);
    drawing.arrow({0.0, y}, {joint.x(), y}, outline_colour, 1.0, "head");
    drawing.label({0.5 * joint.x(), y + 0.075}, symbol("x", index));
  };
  dimension(c, first_row, "C");
  dimension(d, first_row, "D");
  dimension(e, second_row, "E");
  drawing.arrow({0.3, 0.0}, {0.3, c.y()}, outline_colour, 1.0, "heads");
  drawing.label({0.36, 0.5 * c.y()}, symbol("y", "C") + " = " + symbol("y", "D") + " = " + symbol("y", "E"), "left");
  drawing.arrow(origin, {0.62, 0.0}, colour::vermilion, 2.0, "head");
  drawing.arrow(origin, {0.0, 0.62}, colour::vermilion, 2.0, "head");
  drawing.label({0.69, 0.0}, symbol("x"));
  drawing.label({0.0, 0.7}, symbol("y"));

  // The mechanism.
  for (const Eigen::Vector2d& joint : {c, d, e}) draw_support(drawing, joint);
  for (const char* leg : {"l_1", "l_2", "l_3"}) draw_leg(drawing, start(leg), end(leg));
  drawing.fill(round_bar(a, b, 0.15), platform_colour);
  for (const Eigen::Vector2d& joint : {a, b, c, d, e}) drawing.circle(joint, 0.05, "#ffffff");
  drawing.circle(p, 0.022, outline_colour);
  drawing.circle(origin, 0.022, outline_colour);

  // Orientation and length of the platform.
  drawing.line({p, p + Eigen::Vector2d(0.86, 0.0)}, outline_colour, 1.0, 2);
  Points arc;
  constexpr int parts = 40;
  for (int k = 0; k <= parts; ++k) arc.emplace_back(p + 0.6 * unit(phi * k / parts));
  drawing.line(arc, outline_colour, 1.0);
  drawing.arrow(arc[parts - 14], arc[parts], outline_colour, 1.0, "head");
  drawing.label(p + 0.71 * unit(0.45 * phi), symbol("ϕ", "P"));
  const Eigen::Vector2d above = quarter_turned((b - a).normalized());
  for (const Eigen::Vector2d& joint : {a, b}) drawing.line({joint + 0.1 * above, joint + 0.33 * above}, thin, 0.8);
  drawing.arrow(a + 0.28 * above, b + 0.28 * above, outline_colour, 1.0, "heads");
  drawing.label(p + 0.37 * above, fmt::format("2{}", symbol("r")));

  drawing.label(p + Eigen::Vector2d(0.08, -0.19),
                symbol("P") + " (" + symbol("x", "P") + ", " + symbol("y", "P") + ")");
  drawing.label(a + Eigen::Vector2d(-0.17, 0.05), symbol("A"));
  drawing.label(b + Eigen::Vector2d(0.17, 0.02), symbol("B"));
  drawing.label(c + Eigen::Vector2d(-0.13, 0.1), symbol("C"));
  drawing.label(d + Eigen::Vector2d(0.13, 0.1), symbol("D"));
  drawing.label(e + Eigen::Vector2d(0.14, 0.1), symbol("E"));
  const auto beside = [&](const char* leg, double distance) {
    return Eigen::Vector2d(0.5 * (start(leg) + end(leg)) +
                           distance * quarter_turned(end(leg) - start(leg)).normalized());
  };
  drawing.label(beside("l_1", 0.16), symbol("l", "1"));
  drawing.label(beside("l_2", -0.16), symbol("l", "2"));
  drawing.label(beside("l_3", -0.16), symbol("l", "3"));
  return drawing.finish();
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);

  return experiment.run(
      argc, argv,
      [](Session& session) {
        const Table table = describe(pictured_design(), read_chapter_manipulator("M1").lengths, pictured_pose);
        session.write(table);
      },
      [](Session& session) { session.draw(draw(session.table())); });
}
