#include "reprise/study/workspace_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "reprise/kinematics/conditioning_field.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/trace.hpp"

namespace reprise {

namespace {

/// What the table and the key call a panel's workspace and grid, for a single orientation and for a range.
struct SeriesNames {
  const char* workspace;
  const char* workspace_title;
  const char* grid;
  const char* grid_title;
};
constexpr SeriesNames single_names{"workspace", "workspace", "kappa_inverse", "κ⁻¹"};
constexpr SeriesNames range_names{"dextrous workspace", "dextrous", "smallest kappa_inverse", "least κ⁻¹"};

const SeriesNames& names_of(const OrientationRange& orientations) {
  return orientations.is_slice() ? single_names : range_names;
}

std::vector<Eigen::Vector2d> trace(const MapPanel& panel, double chord) {
  TraceOptions options;
  options.chord = chord;
  const TracedBoundary boundary =
      trace_boundary(DextrousLimits(panel.manipulator, panel.orientations), panel.prescribed.front().centre(), options);
  if (!boundary.closed()) {
    throw std::runtime_error(fmt::format("the workspace of '{}' was not traced: {}", panel.title, boundary.message));
  }
  return boundary.positions();
}

/// The smallest kappa^-1 over the orientations at every position.
Eigen::ArrayXd smallest_kappa_inverse(const MapPanel& panel, const Eigen::ArrayXd& x, const Eigen::ArrayXd& y,
                                      int orientations) {
  Eigen::ArrayXd smallest = Eigen::ArrayXd::Ones(x.size());
  Eigen::ArrayXd here(x.size());
  for (const double phi : panel.orientations.spread(orientations)) {
    kappa_inverse_at(panel.manipulator, phi, x, y, panel.conditioning, here);
    smallest = smallest.min(here);
  }
  return smallest;
}

/// P1, P2, ... have colours of their own, the same in every figure.
const char* series_colour(const std::string& series) {
  constexpr std::array<const char*, 3> colours = {colour::vermilion, colour::green, colour::purple};
  if (series == single_names.workspace || series == range_names.workspace) return colour::black;
  const char last = series.empty() ? '1' : series.back();
  return last >= '1' && last <= '9' ? colours[static_cast<std::size_t>(last - '1') % colours.size()] : colours.front();
}

/// Decimals that show multiples of such a step.
int decimals(double step) { return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))); }

/// Rows of x, y and value, broken into scan lines.
std::vector<std::vector<double>> grid_rows(const Table& series) {
  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row < series.rows(); ++row) {
    if (row > 0 && series.text(row, "x") != series.text(row - 1, "x")) rows.emplace_back();
    rows.push_back({series.number(row, "x"), series.number(row, "y"), series.number(row, "value")});
  }
  return rows;
}

/// The points in which the lines y = const and x = const of a square grid cross a level, with the level third.
std::vector<Eigen::Vector3d> crossings(const std::vector<Eigen::Vector3d>& grid, double level) {
  const auto size = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(grid.size()))));
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    if ((p.z() < level) != (q.z() < level)) points.push_back(p + (level - p.z()) / (q.z() - p.z()) * (q - p));
  };
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      if (j + 1 < size) add(grid[i * size + j], grid[i * size + j + 1]);
      if (i + 1 < size) add(grid[i * size + j], grid[(i + 1) * size + j]);
    }
  }
  return points;
}

/// Where the labels of the contours go: up to two for each level, where they are farthest from the outlines, from the
/// frame and from each other. `needed` is half the height of a label with its margin, in the unit of the grid.
std::vector<std::vector<double>> place_labels(const std::vector<Eigen::Vector3d>& grid,
                                              const std::vector<double>& levels,
                                              const std::vector<Eigen::Vector2d>& obstacles, double needed) {
  const double size = grid.back().x() - grid.front().x();
  std::vector<std::vector<double>> labels;
  const auto room = [&](const Eigen::Vector2d& point) {
    // A label is about twice as wide as it is high.
    const Eigen::Array2d shape(0.5, 1.0);
    double distance = (shape * (point - grid.front().head<2>()).array()).minCoeff();
    distance = std::min(distance, (shape * (grid.back().head<2>() - point).array()).minCoeff());
    for (const Eigen::Vector2d& obstacle : obstacles) {
      distance = std::min(distance, (shape * (point - obstacle).array()).matrix().norm());
    }
    for (const std::vector<double>& other : labels) {
      const Eigen::Vector2d between = point - Eigen::Vector2d(other[0], other[1]);
      distance = std::min(distance, 0.5 * (shape * between.array()).matrix().norm());
    }
    return distance;
  };
  for (const double level : levels) {
    const std::vector<Eigen::Vector3d> candidates = crossings(grid, level);
    Eigen::Vector2d first(std::numeric_limits<double>::infinity(), 0.0);
    for (int count = 0; count < 2; ++count) {
      double best_room = needed;
      Eigen::Vector2d best;
      for (const Eigen::Vector3d& candidate : candidates) {
        const Eigen::Vector2d point = candidate.head<2>();
        if ((point - first).norm() < 0.35 * size) continue;
        const double here = room(point);
        if (here > best_room) {
          best_room = here;
          best = point;
        }
      }
      if (best_room == needed) break;
      labels.push_back({best.x(), best.y(), level});
      first = best;
    }
  }
  return labels;
}

}  // namespace

void MapOptions::declare(CommandLine& options) {
  options.number("--chord", chord, NumberRange::positive(0.5), "chord length d of the boundaries");
}

Table compute_map(const std::string& title, const std::vector<MapPanel>& panels, const MapOptions& options) {
  Table table(title, {{"panel", "-", "title of the panel"},
                      {"series", "-", "workspace, name of a prescribed workspace, or inverse condition number"},
                      {"x", options.unit, "x coordinate"},
                      {"y", options.unit, "y coordinate"},
                      {"value", "-", "inverse condition number in the thesis's normalisation; empty for outlines"}});
  struct NamedOutline {
    std::string series;
    std::vector<Eigen::Vector2d> points;
  };
  std::vector<std::vector<NamedOutline>> outlines;
  // Panels with the same prescribed workspaces share their frame, so that they can be compared.
  std::map<std::string, Eigen::AlignedBox2d> frames;
  const auto frame_of = [&frames](const MapPanel& panel) -> Eigen::AlignedBox2d& {
    std::string names;
    for (const PrescribedWorkspace& prescribed : panel.prescribed) names += prescribed.name() + "\n";
    return frames[names];
  };
  for (const MapPanel& panel : panels) {
    outlines.push_back({{names_of(panel.orientations).workspace, trace(panel, options.chord)}});
    for (const PrescribedWorkspace& prescribed : panel.prescribed) {
      outlines.back().push_back({prescribed.name(), prescribed.points(360)});
    }
    for (const NamedOutline& one : outlines.back()) {
      for (const Eigen::Vector2d& point : one.points) frame_of(panel).extend(point);
    }
  }
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const MapPanel& panel = panels[k];
    for (const NamedOutline& one : outlines[k]) {
      for (const Eigen::Vector2d& point : one.points) {
        table.add_row({panel.title, one.series, point.x(), point.y(), {}});
      }
    }
    const Eigen::AlignedBox2d& box = frame_of(panel);
    // The panels are square.
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.54 * box.sizes().maxCoeff());
    const Eigen::Vector2d from = box.center() - half;
    const Eigen::Index points = static_cast<Eigen::Index>(options.grid) * options.grid;
    Eigen::ArrayXd x(points);
    Eigen::ArrayXd y(points);
    for (int i = 0; i < options.grid; ++i) {
      for (int j = 0; j < options.grid; ++j) {
        const Eigen::Vector2d u = from + 2.0 / (options.grid - 1) * half.cwiseProduct(Eigen::Vector2d(i, j));
        x[static_cast<Eigen::Index>(i) * options.grid + j] = u.x();
        y[static_cast<Eigen::Index>(i) * options.grid + j] = u.y();
      }
    }
    const Eigen::ArrayXd values = smallest_kappa_inverse(panel, x, y, options.orientations);
    for (Eigen::Index i = 0; i < points; ++i) {
      table.add_row({panel.title, names_of(panel.orientations).grid, x[i], y[i], values[i]});
    }
  }
  return table;
}

Figure draw_map(const Table& table) {
  const std::vector<std::string> panels = table.distinct("panel");
  // In points, as all that follow. Three panels are no broader than two, so that their type is no smaller on a page.
  const double panel_size = panels.size() > 2 ? 290.0 : 420.0;
  constexpr double left = 62.0, right = 14.0, top = 34.0;
  // Two columns of the legend are as broad as the smaller panels.
  std::size_t most_series = 0;
  for (const std::string& title : panels) {
    most_series = std::max(most_series, table.where("panel", title).distinct("series").size());
  }
  const int legend_lines = panels.size() > 2 && most_series <= 4 ? 2 : 3;
  const double bottom = legend_lines == 2 ? 100.0 : 116.0;
  const double width = static_cast<double>(panels.size()) * panel_size;
  const double height = panel_size - left - right + top + bottom;
  Figure figure(static_cast<int>(width), static_cast<int>(height));
  figure.add(fmt::format("set multiplot layout 1,{} margins {}, {}, {}, {} spacing {}, 0", panels.size(), left / width,
                         1.0 - right / width, bottom / height, 1.0 - top / height, (left + right) / width));
  const auto label = [&table](const std::string& name) {
    const auto column = std::find_if(table.columns().begin(), table.columns().end(),
                                     [&](const Column& one) { return one.name == name; });
    return gnuplot_string(fmt::format("{} [{}]", name, column->unit));
  };
  figure.add(fmt::format("set xlabel {} noenhanced offset 0,0.4\nset ylabel {} noenhanced offset 0.6,0", label("x"),
                         label("y")));
  figure.add(
      fmt::format("set border 15\nset tics front\nunset grid\nset size ratio -1\nset key at graph 0.5, graph {} center "
                  "top vertical Left reverse samplen 1.6 maxrows {}",
                  -56.0 / (panel_size - left - right), legend_lines));
  for (const std::string& title : panels) {
    const Table panel = table.where("panel", title);
    const bool single = panel.where("series", single_names.grid).rows() > 0;
    const SeriesNames& names = single ? single_names : range_names;
    const std::vector<std::vector<double>> rows = grid_rows(panel.where("series", names.grid));
    std::vector<Eigen::Vector3d> grid;
    for (const std::vector<double>& row : rows) {
      if (!row.empty()) grid.emplace_back(row[0], row[1], row[2]);
    }
    const auto [least, most] = std::minmax_element(
        grid.begin(), grid.end(), [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return p.z() < q.z(); });
    const double step = round_step(most->z() - least->z(), panels.size() > 2 ? 6.0 : 9.0);
    std::vector<double> levels;
    for (double multiple = std::ceil(least->z() / step); multiple * step < most->z(); ++multiple) {
      levels.push_back(multiple * step);
    }

    // The contour lines, as data of their own: drawn in the plane they can share their axes with the outlines.
    const std::string grid_data = figure.add_data(rows);
    const std::string contours = grid_data + "_contours";
    figure.add(
        fmt::format("set format '%.9g'\nset xrange [*:*]\nset yrange [*:*]\nset contour base\nunset surface\n"
                    "set cntrparam levels discrete {}\nset table {}\nsplot {} using 1:2:3\nunset table\n"
                    "unset contour",
                    fmt::join(levels, ","), contours, grid_data));

    const double tics = round_step(grid.back().x() - grid.front().x(), panels.size() > 2 ? 4.0 : 6.0);
    figure.add(
        fmt::format("set title {} offset 0,-0.4\nset xrange [{}:{}]\nset yrange [{}:{}]\nset tics {}\n"
                    "set format '%.{}f'",
                    gnuplot_string(title), grid.front().x(), grid.back().x(), grid.front().y(), grid.back().y(), tics,
                    decimals(tics)));

    const double needed = 9.0 / (panel_size - left - right) * (grid.back().x() - grid.front().x());
    std::string outlines;
    std::vector<Eigen::Vector2d> obstacles;
    for (const std::string& series : panel.distinct("series")) {
      if (series == names.grid) continue;
      const std::vector<std::vector<double>> points = outline_rows(panel.where("series", series));
      for (const std::vector<double>& point : points) obstacles.emplace_back(point[0], point[1]);
      outlines += fmt::format(", {} using 1:2 with lines lw 2.2 lc rgb '{}' title {}", figure.add_data(points),
                              series_colour(series),
                              gnuplot_string(series == names.workspace ? names.workspace_title : series));
    }
    const std::string labels = figure.add_data(place_labels(grid, levels, obstacles, needed));
    figure.add(
        fmt::format("plot {} using 1:2 with lines lc rgb '{}' lw 1 title '{}', {} using 1:2:(sprintf('%.{}f', $3)) "
                    "with labels boxed font ',12.5' textcolor rgb '{}' notitle{}",
                    contours, colour::sky, names.grid_title, labels, decimals(step), colour::blue, outlines));
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace reprise
