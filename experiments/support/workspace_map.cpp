#include "support/workspace_map.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reprise/kinematics/conditioning.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise::experiments {

namespace {

constexpr const char* workspace_series = "workspace";
constexpr const char* kappa_series = "kappa_inverse";

std::vector<Eigen::Vector2d> trace(const MapPanel& panel, double chord) {
  TraceOptions options;
  options.chord = chord;
  const TracedBoundary boundary = trace_boundary(ConstantOrientationLimits(panel.manipulator, panel.orientation),
                                                 panel.prescribed.front().centre(), options);
  if (!boundary.closed()) {
    throw std::runtime_error(fmt::format("the workspace of '{}' was not traced: {}", panel.title, boundary.message));
  }
  return boundary.positions();
}

std::vector<Eigen::Vector2d> outline(const PrescribedWorkspace& prescribed) {
  std::vector<Eigen::Vector2d> points;
  for (const double beta : prescribed.angles(360)) points.push_back(prescribed.point(beta));
  return points;
}

/// Rows of x, y (and value); the grid is broken into scan lines, an outline is closed.
std::vector<std::vector<double>> outline_rows(const Table& series) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i <= series.rows(); ++i) {
    const std::size_t row = i % series.rows();
    rows.push_back({series.number(row, "x"), series.number(row, "y")});
  }
  return rows;
}

std::vector<std::vector<double>> grid_rows(const Table& series) {
  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row < series.rows(); ++row) {
    if (row > 0 && series.text(row, "x") != series.text(row - 1, "x")) rows.emplace_back();
    rows.push_back({series.number(row, "x"), series.number(row, "y"), series.number(row, "value")});
  }
  return rows;
}

}  // namespace

Table compute_map(const std::string& title, const std::vector<MapPanel>& panels, const MapOptions& options) {
  Table table(title, {{"panel", "-", "title of the panel"},
                      {"series", "-", "workspace, name of a prescribed workspace, or kappa_inverse"},
                      {"x", "length", "x coordinate"},
                      {"y", "length", "y coordinate"},
                      {"value", "-", "inverse condition number in the thesis's normalisation; empty for outlines"}});
  for (const MapPanel& panel : panels) {
    Eigen::AlignedBox2d box;
    const auto add_outline = [&](const std::string& series, const std::vector<Eigen::Vector2d>& points) {
      for (const Eigen::Vector2d& point : points) {
        table.add_row({panel.title, series, point.x(), point.y(), {}});
        box.extend(point);
      }
    };
    add_outline(workspace_series, trace(panel, options.chord));
    for (const PrescribedWorkspace& prescribed : panel.prescribed) add_outline(prescribed.name(), outline(prescribed));

    // The panels are square.
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.54 * box.sizes().maxCoeff());
    const Eigen::Vector2d from = box.center() - half;
    for (int i = 0; i < options.grid; ++i) {
      for (int j = 0; j < options.grid; ++j) {
        const Eigen::Vector2d u = from + 2.0 / (options.grid - 1) * half.cwiseProduct(Eigen::Vector2d(i, j));
        const double value =
            kappa_inverse(panel.manipulator, {u, panel.orientation}, {.normalisation = Normalisation::printed});
        table.add_row({panel.title, kappa_series, u.x(), u.y(), value});
      }
    }
  }
  return table;
}

Figure draw_map(const Table& table) {
  constexpr int panel_size = 400;
  const std::vector<std::string> panels = table.distinct("panel");
  const int columns = static_cast<int>(panels.size());
  Figure figure(columns * panel_size, panel_size + 50);
  figure.add(fmt::format("set multiplot layout 1,{} margins {}, {}, 0.2, 0.92 spacing {}, 0.1", columns, 0.13 / columns,
                         1.0 - 0.03 / columns, 0.16 / columns));
  for (const std::string& title : panels) {
    const Table panel = table.where("panel", title);
    const Table grid = panel.where("series", kappa_series);
    const std::string grid_data = figure.add_data(grid_rows(grid));
    const std::string contours = grid_data + "_contours";

    // The contour lines, as data of their own: drawn in the plane they can share their axes with the outlines.
    figure.add(
        fmt::format("set contour base\nunset surface\nset cntrparam cubicspline levels incremental 0.1, 0.1, 0.9"
                    "\nset table {}\nsplot {} using 1:2:3\nunset table\nunset contour",
                    contours, grid_data));

    const std::vector<double> x = grid.numbers("x");
    const std::vector<double> y = grid.numbers("y");
    figure.add(fmt::format("set size ratio -1\nset xrange [{}:{}]\nset yrange [{}:{}]", x.front(), x.back(), y.front(),
                           y.back()));
    figure.add(fmt::format("set title {}\nset xlabel 'x'\nset ylabel 'y'\nunset grid", gnuplot_string(title)));

    std::string plot = fmt::format("plot {} using 1:2 with lines lc rgb '{}' lw 1 title 'κ⁻¹'", contours, colour::sky);
    constexpr std::array<const char*, 3> colours = {colour::vermilion, colour::green, colour::purple};
    std::size_t next_colour = 0;
    for (const std::string& series : panel.distinct("series")) {
      if (series == kappa_series) continue;
      const bool is_workspace = series == workspace_series;
      const std::string data = figure.add_data(outline_rows(panel.where("series", series)));
      plot +=
          fmt::format(", {} using 1:2 with lines lw 2.2 lc rgb '{}' title {}", data,
                      is_workspace ? colour::black : colours[next_colour++ % colours.size()], gnuplot_string(series));
    }
    plot += fmt::format(", {} using 1:2:3 every 60::20 with labels boxed font ',9' textcolor rgb '{}' notitle",
                        contours, colour::blue);
    figure.add(plot);
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace reprise::experiments
