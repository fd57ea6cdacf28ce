#include "support/convergence_figure.hpp"

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
  const int columns = static_cast<int>(panels.size());
  Figure figure(columns * 280, 460);
  figure.add(fmt::format("set multiplot layout 2,{} margins {}, {}, 0.11, 0.93 spacing {}, 0.06", columns,
                         0.24 / columns, 1.0 - 0.04 / columns, 0.24 / columns));
  figure.add("unset key");
  const auto draw = [&](const std::string& quantity, const std::string& label, bool first_row,
                        const char* line_colour) {
    const std::vector<double> all = table.numbers(quantity);
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    // One scale for all panels of a row, so that they can be compared.
    const double margin = 0.06 * (*most - *least) + 1e-9;
    figure.add(fmt::format("set yrange [{}:{}]", *least - margin, *most + margin));
    for (const std::string& title : panels) {
      const Table panel = table.where("panel", title);
      std::vector<std::vector<double>> rows;
      for (std::size_t row = 0; row < panel.rows(); ++row) {
        rows.push_back({panel.number(row, "iteration"), panel.number(row, quantity)});
      }
      const std::string data = figure.add_data(rows);
      const bool first = title == panels.front();
      figure.add(fmt::format("set title {}\nset xlabel {}\nset ylabel {}", gnuplot_string(first_row ? title : ""),
                             gnuplot_string(first_row ? "" : "iteration"), gnuplot_string(first ? label : "")));
      figure.add(fmt::format("plot {}{} using 1:2 with linespoints lc rgb '{}' lw 2 pt 7 ps 0.4",
                             first_row ? "" : fmt::format("0 with lines lc rgb '{}' dt 2 lw 1, ", colour::grey), data,
                             line_colour));
    }
  };
  draw("f", "objective f (smallest κ⁻¹)", true, colour::blue);
  draw("g", "constraint g", false, colour::vermilion);
  figure.add("unset multiplot");
  return figure;
}

}  // namespace reprise::experiments
