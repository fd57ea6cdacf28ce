#include "chapter/dextrous_figure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reprise/geometry/polygon.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/multi_level.hpp"

namespace reprise::experiments {
namespace {

const char* name_of(DextrousBoundaryPoint::Kind kind) {
  switch (kind) {
    case DextrousBoundaryPoint::Kind::regular:
      return "regular";
    case DextrousBoundaryPoint::Kind::type_i:
      return "type_i";
    case DextrousBoundaryPoint::Kind::type_ii:
      return "type_ii";
  }
  return "unknown";
}

/// Blues from light to dark for nested ranges from wide workspaces to small ones.
std::string shade(std::size_t index, std::size_t count) {
  const double t = count < 2 ? 1.0 : static_cast<double>(index) / static_cast<double>(count - 1);
  const auto mix = [t](double light, double dark) { return static_cast<int>(std::lround(light + t * (dark - light))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(222, 66), mix(236, 138), mix(246, 190));
}

}  // namespace

Pose assembly_start(const CollinearManipulator& manipulator) {
  return {{manipulator.design.x_d, manipulator.design.y_c + manipulator.lengths[0].lower}, 0.0};
}

double area_around(const Region& region, const Eigen::Vector2d& point) {
  for (const RegionComponent& component : region.components()) {
    if (component.outer.encloses(point)) return Region({component}).area();
  }
  return 0.0;
}

long count_kind(const std::vector<DextrousBoundaryPoint>& points, DextrousBoundaryPoint::Kind kind) {
  return std::count_if(points.begin(), points.end(), [kind](const auto& point) { return point.kind == kind; });
}

DextrousTables map_dextrous_workspaces(const std::string& title, const CollinearManipulator& collinear,
                                       const std::vector<double>& half_widths_deg, double chord) {
  const Manipulator manipulator = make_manipulator(collinear.design, collinear.lengths, collinear.name);
  Table points(title, {{"half_width_deg", "degree", "orientations from minus to plus this are attained"},
                       {"x", "length", "x coordinate of the boundary point"},
                       {"y", "length", "y coordinate of the boundary point"},
                       {"kind", "-", "regular, or a bifurcation point of type_i or type_ii"},
                       {"limit_before", "-", "limit that is active before the point along the boundary"},
                       {"limit_after", "-", "limit that is active after it"},
                       {"phi_before_deg", "degree", "orientation at which the limit before is active"},
                       {"phi_after_deg", "degree", "orientation at which the limit after is active"}});
  Table summary(title + ", summary",
                {{"half_width_deg", "degree", "orientations from minus to plus this are attained"},
                 {"n_b", "-", "number of boundary points, bifurcation points included"},
                 {"type_i", "-", "bifurcation points of type I"},
                 {"type_ii", "-", "bifurcation points of type II"},
                 {"area", "length^2", "area by chords of the component that holds the point of greatest dexterity"},
                 {"exact_area", "length^2", "exact area of that component"},
                 {"area_error", "length^2", "the former less the latter"}});
  const ClosedFormOrientationSolver orientation_solver;
  const NloptSolver solver;
  for (const double half_width : half_widths_deg) {
    const Interval range{-half_width * degree, half_width * degree};
    const DextrousMap map = map_dextrous_workspace(manipulator, range, assembly_start(collinear), orientation_solver,
                                                   solver, {.chord = chord});
    if (!map.boundary.closed()) {
      throw std::runtime_error(fmt::format("the dextrous workspace of {} for +-{} degrees was not mapped: {}.",
                                           manipulator.name(), half_width, map.boundary.message));
    }
    for (const DextrousBoundaryPoint& point : map.points) {
      points.add_row({half_width, point.position.x(), point.position.y(), name_of(point.kind),
                      to_string(point.active[0]), to_string(point.active[1]), point.orientations[0] / degree,
                      point.orientations[1] / degree});
    }
    const double area = signed_area(map.boundary.positions());
    const double exact = area_around(dextrous_workspace(manipulator, range), map.greatest.position);
    summary.add_row({half_width, map.points.size(), count_kind(map.points, DextrousBoundaryPoint::Kind::type_i),
                     count_kind(map.points, DextrousBoundaryPoint::Kind::type_ii), area, exact, area - exact});
  }
  return {std::move(points), std::move(summary)};
}

Figure draw_dextrous_workspaces(const Table& points) {
  Eigen::AlignedBox2d box;
  for (std::size_t row = 0; row < points.rows(); ++row) {
    box.extend(Eigen::Vector2d(points.number(row, "x"), points.number(row, "y")));
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.05 * box.sizes().maxCoeff());
  const Eigen::Vector2d low = box.min() - margin;
  const Eigen::Vector2d high = box.max() + margin;
  constexpr double plot_width = 600.0;  // points, as all that follow
  constexpr double left = 70.0, right = 20.0, top = 20.0, bottom = 126.0;
  const double plot_height = plot_width * (high - low).y() / (high - low).x();
  const double width = left + plot_width + right;
  const double height = top + plot_height + bottom;
  Figure figure(static_cast<int>(width), static_cast<int>(height));
  figure.add(fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n"
      "set border 15\nset tics front\nset size ratio -1\nset xlabel 'x [length]'\nset ylabel 'y [length]'\n"
      "set xrange [{}:{}]\nset yrange [{}:{}]\nset xtics 0.2\nset ytics 0.2\nset format '%.1f'\n"
      "set key at screen 0.5, screen {} center top horizontal Left reverse samplen 2.0 width 1 maxrows 2",
      left / width, 1.0 - right / width, bottom / height, 1.0 - top / height, low.x(), high.x(), low.y(), high.y(),
      (bottom - 66.0) / height));
  std::vector<std::string> plots;
  const std::vector<std::string> half_widths = points.distinct("half_width_deg");
  for (std::size_t k = 0; k < half_widths.size(); ++k) {
    const Table boundary = points.where("half_width_deg", half_widths[k]);
    plots.push_back(fmt::format(
        "{} using 1:2 with filledcurves closed fillcolor rgb '{}' fillstyle solid 1.0 border lc rgb '{}' lw 1.6 "
        "title {}",
        figure.add_data(outline_rows(boundary)), shade(k, half_widths.size()), "#1f4e79",
        gnuplot_string(half_widths[k] == "0" ? "ϕ = 0°" : fmt::format("±{}°", half_widths[k]))));
  }
  struct Mark {
    const char* kind;
    const char* style;
    const char* title;
  };
  for (const Mark& mark : {Mark{"type_i", "pt 7 ps 0.9 lc rgb '#d55e00'", "type I"},
                           {"type_ii", "pt 5 ps 0.9 lc rgb '#000000'", "type II"}}) {
    const Table marked = points.where("kind", mark.kind);
    std::vector<std::vector<double>> rows;
    for (std::size_t row = 0; row < marked.rows(); ++row) {
      rows.push_back({marked.number(row, "x"), marked.number(row, "y")});
    }
    if (!rows.empty()) {
      plots.push_back(
          fmt::format("{} using 1:2 with points {} title '{}'", figure.add_data(rows), mark.style, mark.title));
    }
  }
  figure.add(fmt::format("plot {}", fmt::join(plots, ", ")));
  return figure;
}

int run_dextrous_figure(int argc, const char* const* argv, const ManifestEntry& program, const std::string& manipulator,
                        std::vector<double> half_widths_deg) {
  Experiment experiment(program);
  double chord = 0.02;
  experiment.options().number("--chord", chord, NumberRange::positive(0.5), "chord length d");
  experiment.options().numbers("--half-widths", half_widths_deg, NumberRange::between(0.0, 179.0),
                               "half widths of the ranges of orientations about 0, degrees, from narrow to wide");
  return experiment.run(
      argc, argv,
      [&](Session& session) {
        const DextrousTables tables =
            map_dextrous_workspaces(program.title, read_chapter_manipulator(manipulator), half_widths_deg, chord);
        session.write(tables.points);
        session.write(tables.summary, "summary");
        for (std::size_t row = 0; row < tables.summary.rows(); ++row) {
          fmt::print("+-{} degrees: {} boundary points, area {:.6f}, exact {:.6f}\n",
                     tables.summary.text(row, "half_width_deg"), tables.summary.text(row, "n_b"),
                     tables.summary.number(row, "area"), tables.summary.number(row, "exact_area"));
        }
      },
      [](Session& session) { session.draw(draw_dextrous_workspaces(session.table())); });
}

}  // namespace reprise::experiments
