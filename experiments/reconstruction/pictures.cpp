#include "reconstruction/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise::experiments {

namespace {

constexpr int outline_directions = 720;

/// Rows x, y of a series, with a blank line between its pieces.
std::vector<std::vector<double>> pieces(const Table& series) {
  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row < series.rows(); ++row) {
    if (row > 0 && series.text(row, "piece") != series.text(row - 1, "piece")) rows.emplace_back();
    rows.push_back({series.number(row, "x"), series.number(row, "y")});
  }
  return rows;
}

/// Panels side by side with equal axes and one key below them all; `plots` gives the elements of a panel's plot
/// command.
template <typename Plots>
Figure draw_panels(const Table& table, double panel_size, double bottom, const std::string& settings,
                   const Plots& plots) {
  constexpr double left = 58.0, right = 12.0, top = 32.0, below_labels = 60.0;
  // All panels have the same ranges, so that their sizes compare.
  const auto range = [&](const char* column) {
    const std::vector<double> values = table.numbers(column);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double half = 0.53 * (*most - *least);
    const double middle = 0.5 * (*least + *most);
    return Interval{middle - half, middle + half};
  };
  const Interval x = range("x");
  const Interval y = range("y");
  const std::vector<std::string> panels = table.distinct("panel");
  const double width = static_cast<double>(panels.size()) * panel_size;
  const double height = (panel_size - left - right) * (y.upper - y.lower) / (x.upper - x.lower) + top + bottom;
  Figure figure(static_cast<int>(width), static_cast<int>(height));
  figure.add(fmt::format("set multiplot layout 1,{} margins {}, {}, {}, {} spacing {}, 0", panels.size(), left / width,
                         1.0 - right / width, bottom / height, 1.0 - top / height, (left + right) / width));
  figure.add(fmt::format("set border 15\nset size ratio -1\nset xrange [{}:{}]\nset yrange [{}:{}]\n{}", x.lower,
                         x.upper, y.lower, y.upper, settings));
  figure.add(
      fmt::format("set key at screen 0.5, screen {} center top vertical Left reverse samplen 1.8 width 1 maxrows 2",
                  (bottom - below_labels) / height));
  for (const std::string& title : panels) {
    figure.add(fmt::format("set title {} offset 0,-0.4", gnuplot_string(title)));
    std::string command;
    for (const std::string& plot : plots(figure, table.where("panel", title))) {
      command += (command.empty() ? "plot " : ", ") + plot;
    }
    figure.add(command + "\nunset key");
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace

Table picture_outlines(const Evidence& evidence, const std::vector<PicturedOutlines>& outlines) {
  Table table("The reconstructed outlines about O', before the division by the factors of the tables",
              {{"panel", "-", "prescribed workspace"},
               {"series", "-",
                "region: largest that all tables allow; inner, outer: envelope of the compatible outlines found; data: "
                "in examples/P1.toml to P3.toml; f_d0, f_star, limit: where the region attains a table's f(d^0), "
                "f* and contact; others: fits of other families"},
               {"piece", "-", "number of a connected piece of the series"},
               {"x", "length", "x coordinate less that of O', in the size before division"},
               {"y", "length", "y coordinate less that of O', in the size before division"}});
  for (const PicturedOutlines& one : outlines) {
    const auto add = [&](const std::string& series, int piece, double beta, double radius) {
      const Eigen::Vector2d u = radius * unit(beta);
      table.add_row({one.workspace, series, piece, u.x(), u.y()});
    };
    const auto add_outline = [&](const std::string& series, const auto& radius) {
      for (int i = 0; i <= outline_directions; ++i) {
        const double beta = 2.0 * pi * (i % outline_directions) / outline_directions;
        add(series, 0, beta, radius(beta));
      }
    };
    const CommonOutline common = evidence.common(one.workspace, one.reading, one.divisors);
    const std::size_t rays = common.radii.size();
    const auto& any = evidence.outlines(evidence.find("5.3", one.workspace, one.reading));
    for (std::size_t i = 0; i <= rays; ++i) add("region", 0, any.direction(i % rays), common.radii[i % rays]);

    std::vector<PrescribedWorkspace> compatible;
    for (const Shape& shape : one.compatible) compatible.emplace_back(one.workspace, shape);
    if (!compatible.empty()) {
      const auto extreme = [&](bool largest) {
        return [&, largest](double beta) {
          double found = compatible.front().radius(beta);
          for (const PrescribedWorkspace& workspace : compatible) {
            const double radius = workspace.radius(beta);
            found = largest ? std::max(found, radius) : std::min(found, radius);
          }
          return found;
        };
      };
      add_outline("inner", extreme(false));
      add_outline("outer", extreme(true));
    }
    const PrescribedWorkspace data(one.workspace, one.in_data);
    add_outline("data", [&](double beta) { return data.radius(beta); });
    for (const auto& [name, shape] : one.others) {
      const PrescribedWorkspace other(name, shape);
      add_outline(name, [&](double beta) { return other.radius(beta); });
    }

    // Where the largest region attains what some point of the outline must attain.
    const auto add_attained = [&](const std::string& series, const auto& attains) {
      int piece = 0;
      for (const auto& [name, divisor] : one.divisors) {
        const std::size_t row = evidence.find(name, one.workspace, one.reading);
        const CompatibleOutlines& allowed = evidence.outlines(row);
        bool drawing = false;
        for (std::size_t i = 0; i < rays; ++i) {
          const bool here =
              attains(evidence.rows()[row], allowed, allowed.attained_on_ray(i, common.radii[i] / divisor));
          if (here) add(series, piece, allowed.direction(i), common.radii[i]);
          if (drawing && !here) ++piece;
          drawing = here;
        }
        ++piece;
      }
    };
    using Attained = CompatibleOutlines::Attained;
    add_attained("f_d0", [](const PublishedRow& row, const CompatibleOutlines&, const Attained& attained) {
      return attained.start_value <= row.f_d0.value + row.f_d0.half_unit;
    });
    add_attained("f_star", [](const PublishedRow& row, const CompatibleOutlines&, const Attained& attained) {
      return attained.final_value <= row.f_star.value + row.f_star.half_unit;
    });
    add_attained("limit", [](const PublishedRow&, const CompatibleOutlines&, const Attained& attained) {
      return attained.gap <= 0.0;
    });
  }
  return table;
}

Figure draw_outlines(const Table& table) {
  const std::string settings =
      "unset grid\nset tics 1\nset format '%.0f'\nset xlabel 'x − x of O′ [length]' offset 0,0.4\n"
      "set ylabel 'y − y of O′ [length]' offset 0.6,0";
  return draw_panels(table, 310.0, 108.0, settings, [](Figure& figure, const Table& panel) {
    const auto data = [&](const std::string& series) { return figure.add_data(pieces(panel.where("series", series))); };
    const auto area = [&](const char* series, const char* fill, const std::string& title) {
      return fmt::format("{} using 1:2 with filledcurves closed fc rgb '{}' {}", data(series), fill, title);
    };
    const auto mark = [&](const char* series, const char* colour, const char* title) {
      return fmt::format("{} using 1:2 with points pt 7 ps 0.35 lc rgb '{}' title '{}'", data(series), colour, title);
    };
    constexpr const char* region = "#e9e9e9";
    std::vector<std::string> plots{area("region", region, "title 'allowed by all tables'")};
    if (panel.where("series", "inner").rows() > 0) {
      plots.push_back(area("outer", "#a8cbe4", "title 'compatible outlines'"));
      plots.push_back(area("inner", region, "notitle"));
    }
    plots.push_back(mark("limit", colour::black, "reach of a leg"));
    plots.push_back(mark("f_star", colour::green, "f* attained"));
    plots.push_back(mark("f_d0", colour::orange, "f(d⁰) attained"));
    const std::vector<std::string> own{"region", "inner", "outer", "limit", "f_star", "f_d0", "data"};
    bool first = true;
    for (const std::string& series : panel.distinct("series")) {
      if (std::find(own.begin(), own.end(), series) != own.end()) continue;
      plots.push_back(fmt::format("{} using 1:2 with lines lw 1.2 dt 2 lc rgb '#404040' {}", data(series),
                                  first ? "title 'other families'" : "notitle"));
      first = false;
    }
    plots.push_back(
        fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' title 'outline used'", data("data"), colour::vermilion));
    return plots;
  });
}

Figure draw_start_value(const Table& table) {
  const std::string settings =
      "set tics 0.2\nset format '%.1f'\nset xlabel 'x [length]' offset 0,0.4\n"
      "set ylabel 'y [length]' offset 0.6,0";
  return draw_panels(table, 420.0, 108.0, settings, [](Figure& figure, const Table& panel) {
    const auto data = [&](const std::string& series) { return figure.add_data(pieces(panel.where("series", series))); };
    return std::vector<std::string>{
        fmt::format("{} using 1:2 with filledcurves closed fc rgb '#dcdcdc' title 'where the outline may lie'",
                    data("region")),
        fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' title 'workspace of the design'", data("workspace"),
                    colour::black),
        fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' title 'curve of f(d⁰), to be reached'", data("level"),
                    colour::blue)};
  });
}

}  // namespace reprise::experiments
