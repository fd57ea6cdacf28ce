#include "reference/gap_figure.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "chapter/problems.hpp"
#include "frame/power_tics.hpp"
#include "frame/shown_name.hpp"

namespace reprise::experiments {

Figure draw_gaps(const Table& table) {
  struct Series {
    const char* source;
    const char* formulation;
    const char* colour;
    int point;  ///< filled; hollow is one less
  };
  constexpr Series all[] = {{"published", "", colour::black, 7},
                            {"published_corrected", "", colour::black, 9},
                            {"dynamic_q", "area", colour::vermilion, 9},
                            {"slsqp", "area", colour::blue, 5},
                            {"ipopt", "area", colour::purple, 11},
                            {"dynamic_q", "pointwise", colour::orange, 9},
                            {"slsqp", "pointwise", colour::sky, 5},
                            {"ipopt", "pointwise", colour::green, 11},
                            {"reference", "semi_infinite", colour::grey, 13}};
  const auto title = [](const Series& series) -> std::string {
    const std::string_view source = series.source;
    if (source == "published_corrected") return "corrected";
    if (source == "published" || source == "reference") return shown_name(series.source);
    return fmt::format("{}, {}", shown_name(series.source), series.formulation);
  };
  Figure figure(900, 420);
  std::string tics;
  int position = 0;
  for (const ChapterSynthesis& studied : chapter_syntheses) {
    for (const std::string& workspace : workspace_names) {
      tics += fmt::format("{}\"{}\\n{}\" {}", tics.empty() ? "" : ", ", studied.kind, workspace, ++position);
    }
  }
  figure.add("set multiplot layout 1,2 margins 0.075, 0.99, 0.3, 0.92 spacing 0.085, 0");
  figure.add("set xrange [0.5:9.5]\nset xtics (" + tics + ") scale 0\nset grid noxtics ytics");
  figure.add("set arrow 1 from 3.5, graph 0 to 3.5, graph 1 nohead lc rgb '#c0c0c0'");
  figure.add("set arrow 2 from 6.5, graph 0 to 6.5, graph 1 nohead lc rgb '#c0c0c0'");
  // The first entries of the key are in the left panel, the others in the right.
  constexpr std::size_t in_left_key = 5;
  const auto panel = [&](bool gaps) {
    std::string curves;
    double offset = -0.36;
    std::size_t entry = 0;
    for (const Series& series : all) {
      std::vector<std::vector<double>> filled;
      std::vector<std::vector<double>> hollow;
      for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.text(row, "source") != series.source || table.text(row, "formulation") != series.formulation)
          continue;
        double x = offset;
        for (int i = 0; i < 3; ++i) {
          if (table.text(row, "table") == chapter_syntheses[static_cast<std::size_t>(i)].table) x += 3.0 * i;
        }
        x += table.text(row, "workspace")[1] - '0';
        const double y = gaps ? -table.number(row, "gap") : table.number(row, "kkt_residual");
        if (gaps && (y < lowest_shown || y > highest_shown)) continue;
        (table.number(row, "violation") > hollow_above ? hollow : filled).push_back({x, gaps ? 1000.0 * y : y});
      }
      const auto add = [&](const std::vector<std::vector<double>>& points, int point) {
        if (points.empty()) return;
        curves += fmt::format("{}{} using 1:2 with points pt {} ps 0.8 lw 1.4 lc rgb '{}' notitle",
                              curves.empty() ? "" : ", ", figure.add_data(points), point, series.colour);
      };
      add(filled, series.point);
      add(hollow, series.point - 1);
      if (gaps == (entry++ < in_left_key)) {
        curves += fmt::format(", NaN with points pt {} ps 0.9 lc rgb '{}' title {}", series.point, series.colour,
                              gnuplot_string(title(series)));
      }
      offset += 0.09;
    }
    figure.add("plot " + curves);
  };
  figure.add("set key at graph 0.5, graph -0.17 center top horizontal Left reverse samplen 1 maxrows 3");
  figure.add(
      fmt::format("set title '(a) f less f of the reference' offset 0,-0.4\nset ylabel 'difference, thousandths "
                  "[-]' offset 0.8,0\nset yrange [{}:{}]",
                  1000.0 * lowest_shown, 1000.0 * highest_shown));
  panel(true);
  figure.add(
      "set title '(b) residual of the optimality conditions' offset 0,-0.4\nset ylabel 'residual [-]' offset 0.8,0\n"
      "set logscale y\nset yrange [1e-17:10]");
  figure.add(power_tics("y", 1e-16, 10.0, true, 4));
  panel(false);
  figure.add("unset multiplot");
  return figure;
}

}  // namespace reprise::experiments
