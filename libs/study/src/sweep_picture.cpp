#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reprise/base/constants.hpp"
#include "reprise/study/sweep.hpp"

namespace reprise {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A field as a number; not a number where it is empty.
double value_of(const Table& rows, std::size_t row, const std::string& column) {
  return rows.text(row, column).empty() ? nothing : rows.number(row, column);
}

std::string label(const std::string& name) { return gnuplot_string(name) + " noenhanced"; }

/// The numbers that vary, of the grid or of the sample.
std::vector<double> distinct_values(const Table& rows, const std::string& column) {
  std::vector<double> values;
  for (const std::string& text : rows.distinct(column)) values.push_back(std::stod(text));
  return values;
}

void set_axis(Figure& figure, char letter, const std::string& name, bool logarithmic) {
  figure.add(fmt::format("set {}label {}\n{} logscale {}", letter, label(name), logarithmic ? "set" : "unset", letter));
}

/// A line over one number.
Figure draw_line(const SweepPlan& plan, const Table& rows) {
  Figure figure(560, 380);
  set_axis(figure, 'x', plan.axes[0], plan.logarithmic[0]);
  set_axis(figure, 'y', plan.result, false);
  figure.add(fmt::format("set title {} noenhanced\nset key off\nset datafile missing NaN", gnuplot_string(plan.title)));
  std::vector<std::vector<double>> points;
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    const double value = value_of(rows, row, plan.result);
    // A line does not go through where there is nothing.
    points.push_back(std::isnan(value) ? std::vector<double>{}
                                       : std::vector<double>{rows.number(row, plan.axes[0]), value});
  }
  figure.add(fmt::format("plot {} using 1:2 with linespoints pt 7 ps 0.4 lw 1.6 lc rgb '{}'", figure.add_data(points),
                         colour::blue));
  return figure;
}

/// Each number that varies against the result.
Figure draw_sample(const SweepPlan& plan, const Table& rows) {
  const std::size_t across = std::min<std::size_t>(plan.axes.size(), 3);
  const std::size_t down = (plan.axes.size() + across - 1) / across;
  Figure figure(static_cast<int>(320 * across + 40), static_cast<int>(280 * down + 40));
  figure.add(fmt::format("set multiplot layout {},{} title {} noenhanced\nset key off", down, across,
                         gnuplot_string(plan.title)));
  set_axis(figure, 'y', plan.result, false);
  for (std::size_t k = 0; k < plan.axes.size(); ++k) {
    std::vector<std::vector<double>> points;
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      const double value = value_of(rows, row, plan.result);
      if (!std::isnan(value)) points.push_back({rows.number(row, plan.axes[k]), value});
    }
    set_axis(figure, 'x', plan.axes[k], plan.logarithmic[k]);
    if (points.empty()) points.push_back({nothing, nothing});
    figure.add(
        fmt::format("plot {} using 1:2 with points pt 7 ps 0.35 lc rgb '{}'", figure.add_data(points), colour::blue));
  }
  figure.add("unset multiplot");
  return figure;
}

/// The result over the last two numbers, with contours, for the first values of the others.
Figure draw_maps(const SweepPlan& plan, const Table& rows) {
  const std::size_t last = plan.axes.size() - 1;
  const std::size_t wide = distinct_values(rows, plan.axes[last - 1]).size();
  const std::size_t high = distinct_values(rows, plan.axes[last]).size();
  const std::size_t panels = std::min<std::size_t>(rows.rows() / (wide * high), 9);
  const std::size_t across = panels == 1 ? 1 : panels <= 4 ? 2 : 3;
  const std::size_t down = (panels + across - 1) / across;
  double least = infinity;
  double most = -infinity;
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    const double value = value_of(rows, row, plan.result);
    if (std::isnan(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  const int panel = panels == 1 ? 520 : 340;
  Figure figure(static_cast<int>(across) * panel + 40, static_cast<int>(down) * (panel - 60) + 50);
  figure.add(fmt::format("set multiplot layout {},{}", down, across));
  set_axis(figure, 'x', plan.axes[last - 1], plan.logarithmic[last - 1]);
  set_axis(figure, 'y', plan.axes[last], plan.logarithmic[last]);
  figure.add(
      fmt::format("set cblabel {}\nset key off\nset palette defined (0 '#440154', 1 '#414487', 2 '#2a788e', 3 "
                  "'#22a884', 4 '#7ad151', "
                  "5 '#fde725')\nset view map\nset pm3d corners2color mean\n"
                  "set datafile missing NaN",
                  label(plan.result)));
  const bool varies = most > least;
  if (varies) figure.add(fmt::format("set cbrange [{}:{}]", least, most));
  for (std::size_t k = 0; k < panels; ++k) {
    std::vector<std::vector<double>> grid;
    const std::size_t first = k * wide * high;
    for (std::size_t row = first; row < first + wide * high; ++row) {
      if (row > first && (row - first) % high == 0) grid.emplace_back();
      grid.push_back(
          {rows.number(row, plan.axes[last - 1]), rows.number(row, plan.axes[last]), value_of(rows, row, plan.result)});
    }
    std::string title = last == 1 ? plan.title : "";
    for (std::size_t axis = 0; axis + 2 < plan.axes.size(); ++axis) {
      title += fmt::format("{}{} = {}", axis == 0 ? "" : ", ", plan.axes[axis],
                           short_number(rows.number(first, plan.axes[axis])));
    }
    const std::string data = figure.add_data(grid);
    figure.add(fmt::format("set title {} noenhanced", gnuplot_string(title)));
    std::string lines;
    if (varies) {
      const double step = round_step(most - least, 8.0);
      figure.add(fmt::format("set contour base\nset cntrparam levels incremental {},{},{}",
                             std::ceil(least / step) * step, step, most));
      lines = fmt::format(", {} using 1:2:3 with lines nosurface lw 1 lc rgb '{}'", data, colour::black);
    }
    figure.add(fmt::format("splot {} using 1:2:3 with pm3d{}", data, lines));
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace

Figure draw_sweep(const SweepPlan& plan, const Table& rows) {
  if (plan.sample) return draw_sample(plan, rows);
  return plan.axes.size() == 1 ? draw_line(plan, rows) : draw_maps(plan, rows);
}

}  // namespace reprise
