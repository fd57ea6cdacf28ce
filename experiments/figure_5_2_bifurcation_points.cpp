// Figure 5.2: successive boundary points about a corner of M1's workspace at phi = 0, (a) without and (b) with the
// bifurcation point.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/trace.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

constexpr const char* exact_series = "exact";
constexpr const char* without_series = "without";
constexpr const char* with_series = "with";

/// The points that the figure names.
struct Mark {
  int place;          ///< along the boundary, counted from the bifurcation point
  const char* name;   ///< in the table
  const char* label;  ///< in the picture, in gnuplot's enhanced mode
};
constexpr std::array<Mark, 5> marks{{{-2, "b^(i-1)", "{/:Bold b}^{{/:Italic i}−1}"},
                                     {-1, "b^i", "{/:Bold b}^{/:Italic i}"},
                                     {0, "B^j", "{/:Bold B}^{/:Italic j}"},
                                     {1, "b^(i+1)", "{/:Bold b}^{{/:Italic i}+1}"},
                                     {2, "b^(i+2)", "{/:Bold b}^{{/:Italic i}+2}"}}};

TracedBoundary trace(const Limits& limits, const Eigen::Vector2d& start, TraceOptions options,
                     bool bifurcation_points) {
  options.bifurcation_points = bifurcation_points;
  TracedBoundary boundary = trace_boundary(limits, start, options);
  if (!boundary.closed()) throw std::runtime_error("the workspace was not traced: " + boundary.message + ".");
  return boundary;
}

/// The positions of the marks: about the boundary's rightmost bifurcation point.
std::array<Eigen::Vector2d, marks.size()> marked_positions(const TracedBoundary& boundary) {
  const std::vector<BoundaryPoint>& points = boundary.points;
  std::size_t corner = points.size();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool farther = corner == points.size() || points[k].position.x() > points[corner].position.x();
    if (points[k].is_bifurcation() && farther) corner = k;
  }
  std::array<Eigen::Vector2d, marks.size()> positions;
  for (std::size_t m = 0; m < marks.size(); ++m) {
    const std::size_t k = corner + points.size() + static_cast<std::size_t>(marks[m].place);
    const BoundaryPoint& point = points[k % points.size()];
    if (point.is_bifurcation() != (marks[m].place == 0)) {
      throw std::runtime_error("the corner has less than two boundary points beside it; choose another chord or ray.");
    }
    positions[m] = point.position;
  }
  return positions;
}

/// The exact boundary and both traced ones.
Table collect_points(const BoundaryLoop& exact, const TracedBoundary& without, const TracedBoundary& with,
                     double chord) {
  Table table("Figure 5.2: the importance of mapping bifurcation points",
              {{"series", "-", "exact boundary, or the one traced without or with bifurcation points"},
               {"name", "-", "name of the point in the figure"},
               {"x", "length", "x coordinate"},
               {"y", "length", "y coordinate"}});
  const auto marked = marked_positions(with);
  const auto add = [&](std::string_view series, const std::vector<Eigen::Vector2d>& points) {
    for (const Eigen::Vector2d& point : points) {
      Field name;
      for (std::size_t m = 0; m < marks.size() && series != exact_series; ++m) {
        if ((marked[m] - point).norm() <= 1e-9 * chord) name = marks[m].name;
      }
      table.add_row({series, name, point.x(), point.y()});
    }
  };
  add(exact_series, exact.sample(0.02 * chord));
  add(without_series, without.positions());
  add(with_series, with.positions());
  return table;
}

Table compare_areas(const BoundaryLoop& exact, const TracedBoundary& without, const TracedBoundary& with) {
  Table table("Figure 5.2: what the bifurcation points are worth",
              {{"bifurcation_points", "-", "1 with bifurcation points, 0 without"},
               {"n_b", "-", "number of points on the boundary"},
               {"area", "length^2", "area of the traced polygon"},
               {"exact_area", "length^2", "area within the exact boundary"},
               {"area_error", "length^2", "the former less the latter"}});
  for (const auto& [boundary, mark] : {std::pair{&without, 0}, {&with, 1}}) {
    const double area = signed_area(boundary->positions());
    table.add_row({mark, boundary->points.size(), area, exact.signed_area(), area - exact.signed_area()});
  }
  return table;
}

Figure draw(const Table& table) {
  constexpr double panel_size = 420.0;  // points, as all that follow
  constexpr double left = 62.0, right = 14.0, top = 34.0, bottom = 62.0;
  constexpr double width = 2.0 * panel_size;
  constexpr double height = panel_size - left - right + top + bottom;
  constexpr const char* cut_colour = "#f3b48c";
  constexpr const char* inside_colour = "#e6edf2";
  Figure figure(static_cast<int>(width), static_cast<int>(height));
  figure.add(fmt::format("set termoption enhanced\nset multiplot layout 1,2 margins {}, {}, {}, {} spacing {}, 0",
                         left / width, 1.0 - right / width, bottom / height, 1.0 - top / height,
                         (left + right) / width));
  figure.add(
      "set border 15\nset tics front\nunset grid\nset size ratio -1\nset xlabel 'x [length]' offset 0,0.4\n"
      "set ylabel 'y [length]' offset 0.6,0\nset format '%g'\nset tics autofreq\n"
      "set key inside bottom right vertical Left reverse samplen 1.6 spacing 1.2");

  // A square window about the named points.
  Eigen::AlignedBox2d box;
  const Table with = table.where("series", with_series);
  for (std::size_t row = 0; row < with.rows(); ++row) {
    if (!with.text(row, "name").empty()) box.extend(Eigen::Vector2d(with.number(row, "x"), with.number(row, "y")));
  }
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.66 * box.sizes().maxCoeff());
  const Eigen::Vector2d low = box.center() - half;
  const Eigen::Vector2d high = box.center() + half;
  figure.add(fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]", low.x(), high.x(), low.y(), high.y()));

  const std::string exact = figure.add_data(outline_rows(table.where("series", exact_series)));
  for (const auto& [series, title] :
       {std::pair{without_series, "(a) without bifurcation points"}, {with_series, "(b) with bifurcation points"}}) {
    const Table points = table.where("series", series);
    const std::string traced = figure.add_data(outline_rows(points));
    figure.add(fmt::format("set title '{}' offset 0,-0.4\nunset label", title));
    for (std::size_t row = 0; row < points.rows(); ++row) {
      const auto mark = std::find_if(marks.begin(), marks.end(),
                                     [&](const Mark& one) { return points.text(row, "name") == one.name; });
      if (mark == marks.end()) continue;
      const Eigen::Vector2d at(points.number(row, "x"), points.number(row, "y"));
      const auto neighbour = [&](std::size_t other) {
        return Eigen::Vector2d(points.number(other % points.rows(), "x"), points.number(other % points.rows(), "y"));
      };
      // Outside of the workspace, which is on the left of the walk.
      const Eigen::Vector2d along = neighbour(row + 1) - neighbour(row + points.rows() - 1);
      const Eigen::Vector2d place = at - 0.17 * half.x() * quarter_turned(along.normalized());
      figure.add(fmt::format("set label {} at {},{} center front font ',14'", gnuplot_string(mark->label), place.x(),
                             place.y()));
    }
    figure.add(fmt::format(
        "plot {0} using 1:2 with filledcurves closed fillcolor rgb '{2}' fillstyle solid 1.0 noborder title 'cut off', "
        "{1} using 1:2 with filledcurves closed fillcolor rgb '{3}' fillstyle solid 1.0 noborder notitle, "
        "{0} using 1:2 with lines lc rgb '{4}' lw 3 title 'exact boundary', "
        "{1} using 1:2 with linespoints lc rgb '{5}' lw 2 pt 7 ps 0.8 title 'traced boundary'",
        exact, traced, cut_colour, inside_colour, colour::grey, colour::blue));
    figure.add("unset key");  // one is enough
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  TraceOptions options;
  options.chord = 0.2;
  double ray_deg = 180.0;
  experiment.options().number("--chord", options.chord, NumberRange::positive(0.25), "chord length d");
  experiment.options().number("--ray", ray_deg, NumberRange::between(-180.0, 180.0),
                              "direction of the ray to the first boundary point, degrees");

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        const CollinearManipulator m1 = read_chapter_manipulator("M1");
        const Manipulator manipulator = make_manipulator(m1.design, m1.lengths, m1.name);
        const ConstantOrientationLimits limits(manipulator, 0.0);
        const Eigen::Vector2d start(1.0, 1.5);
        options.first_direction = unit(ray_deg * pi / 180.0);

        const Region workspace = constant_orientation_workspace(manipulator, 0.0);
        const auto component =
            std::find_if(workspace.components().begin(), workspace.components().end(),
                         [&](const RegionComponent& candidate) { return candidate.outer.encloses(start); });
        if (component == workspace.components().end())
          throw std::runtime_error("the walk starts outside the workspace.");

        const TracedBoundary without = trace(limits, start, options, false);
        const TracedBoundary with = trace(limits, start, options, true);
        const Table table = collect_points(component->outer, without, with, options.chord);
        session.write(table);
        session.write(compare_areas(component->outer, without, with), "areas");
      },
      [](Session& session) { session.draw(draw(session.table())); });
}
