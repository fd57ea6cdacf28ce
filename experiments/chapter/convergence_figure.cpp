#include "chapter/convergence_figure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace reprise::experiments {

Table collect_histories(const std::string& title, const Table& histories, const SynthesisRun& run) {
  Table table(title, {{"panel", "-", "title of the panel"},
                      {"iteration", "-", "number of the iteration, 0 for the start"},
                      {"f", "-", "objective, smallest inverse condition number"},
                      {"g", "length^2", "constraint, not positive where the workspace is reached"}});
  char letter = 'a';
  for (const std::string& workspace : histories.distinct("workspace")) {
    const Table history = run.select(histories, workspace);
    const std::string panel = fmt::format("({}) {}", letter++, workspace);
    for (std::size_t row = 0; row < history.rows(); ++row) {
      table.add_row({panel, history.text(row, "iteration"), history.text(row, "f"), history.text(row, "g")});
    }
  }
  return table;
}

Figure draw_histories(const Table& table) {
  const std::vector<std::string> panels = table.distinct("panel");
  constexpr double panel_width = 270.0, left = 96.0, right = 20.0;  // points
  const double width = left + static_cast<double>(panels.size()) * panel_width;
  Figure figure(static_cast<int>(width), 480);
  figure.add(fmt::format("set multiplot layout 2,{} margins {}, {}, 0.14, 0.93 spacing {}, 0.05", panels.size(),
                         left / width, 1.0 - right / width, right / width));
  figure.add("unset key");
  // The panels of a column share their iterations, those of a row their scale, so that they can be compared.
  const auto draw = [&](const std::string& quantity, const std::string& label, bool top, const char* line_colour) {
    const std::vector<double> all = table.numbers(quantity);
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    const double margin = 0.06 * (*most > *least ? *most - *least : 1.0);
    figure.add(fmt::format("set yrange [{}:{}]\nset format x '{}'\nset xlabel '{}'", *least - margin, *most + margin,
                           top ? "" : "%g", top ? "" : "iteration"));
    for (const std::string& title : panels) {
      const Table panel = table.where("panel", title);
      std::vector<std::vector<double>> rows;
      for (std::size_t row = 0; row < panel.rows(); ++row) {
        rows.push_back({panel.number(row, "iteration"), panel.number(row, quantity)});
      }
      const std::string data = figure.add_data(rows);
      const bool first = title == panels.front();
      figure.add(fmt::format("set title {} offset 0,-0.4\nset ylabel {} offset -0.4,0\nset format y '{}'",
                             gnuplot_string(top ? title : ""), gnuplot_string(first ? label : ""), first ? "%g" : ""));
      const double iterations = 1.03 * rows.back().front() + 0.5;
      figure.add(fmt::format("set xrange [0:{}]\nset xtics {}", iterations, round_step(iterations, 6.0)));
      figure.add(fmt::format("plot {}{} using 1:2 with linespoints lc rgb '{}' lw 2 pt 7 ps 0.4",
                             top ? "" : fmt::format("0 with lines lc rgb '{}' dt 2 lw 1, ", colour::grey), data,
                             line_colour));
    }
  };
  draw("f", "objective f, smallest κ⁻¹ [-]", true, colour::blue);
  draw("g", "constraint g [length²]", false, colour::vermilion);
  figure.add("unset multiplot");
  return figure;
}

}  // namespace reprise::experiments
