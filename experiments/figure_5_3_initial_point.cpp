// Figure 5.3: how the initial point on the boundary of a dextrous workspace is found: along a ray from the point of
// greatest dexterity, as far as the whole range of orientations is attained.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "chapter/dextrous_figure.hpp"
#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/workspace/multi_level.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

struct Settings {
  double half_width_deg = 10.0;
  double ray_deg = -20.0;
  double chord = 0.02;
};

/// What is found on the way to b^1, and the orientations attained along the ray and beyond it.
std::pair<Table, Table> compute(const CollinearManipulator& one, const Settings& settings) {
  const Manipulator manipulator = make_manipulator(one.design, one.lengths, one.name);
  const Interval range{-settings.half_width_deg * degree, settings.half_width_deg * degree};
  const ClosedFormOrientationSolver orientation_solver;
  const double ray = settings.ray_deg * degree;
  const Eigen::Vector2d direction(std::cos(ray), std::sin(ray));
  const DextrousMap map =
      map_dextrous_workspace(manipulator, range, assembly_start(one), orientation_solver, NloptSolver(),
                             {.chord = settings.chord, .first_direction = direction});
  if (!map.boundary.closed()) {
    throw std::runtime_error(fmt::format("the dextrous workspace was not mapped: {}.", map.boundary.message));
  }
  Table places("Figure 5.3: finding an initial point on the dextrous workspace boundary",
               {{"name", "-", "u_a: assembled point; u_d: point of greatest dexterity; b_1: initial point; boundary"},
                {"x", "length", "x coordinate"},
                {"y", "length", "y coordinate"}},
               {fmt::format("{}, orientations from {} to {} degrees.", one.name, -settings.half_width_deg,
                            settings.half_width_deg)});
  const auto add = [&](const char* name, const Eigen::Vector2d& u) { places.add_row({name, u.x(), u.y()}); };
  const Eigen::Vector2d initial = map.points.front().position;
  add("u_a", map.assembled.pose.position);
  add("u_d", map.greatest.position);
  add("b_1", initial);
  for (const DextrousBoundaryPoint& point : map.points) add("boundary", point.position);

  Table along("Figure 5.3: orientation workspaces along the ray",
              {{"r", "length", "distance from the point of greatest dexterity"},
               {"w_min_deg", "degree", "smallest orientation attained"},
               {"w_max_deg", "degree", "greatest orientation attained"},
               {"phi_min_deg", "degree", "smallest orientation wanted"},
               {"phi_max_deg", "degree", "greatest orientation wanted"},
               {"r_star", "length", "distance of the initial point b_1"}});
  const double r_star = (initial - map.greatest.position).norm();
  constexpr int steps = 200;
  for (int k = 0; k <= steps; ++k) {
    const double r = 1.5 * r_star * k / steps;
    std::size_t evaluations = 0;
    const auto ends = orientation_solver.solve(manipulator, map.greatest.position + r * direction, range, evaluations);
    if (!ends) break;
    along.add_row({r, ends->interval.lower / degree, ends->interval.upper / degree, -settings.half_width_deg,
                   settings.half_width_deg, r_star});
  }
  return {std::move(places), std::move(along)};
}

Figure draw(const Table& places, const Table& along) {
  constexpr double panel = 400.0;  // points, as all that follow
  constexpr double left = 66.0, right = 22.0, top = 34.0, bottom = 74.0;
  constexpr double width = 2.0 * (left + panel + right);
  constexpr double height = top + panel + bottom;
  Figure figure(static_cast<int>(width), static_cast<int>(height));
  figure.add(
      fmt::format("set termoption enhanced\nset multiplot layout 1,2 margins {}, {}, {}, {} spacing {}, 0\n"
                  "set border 15\nset tics front",
                  left / width, 1.0 - right / width, bottom / height, 1.0 - top / height, (left + right) / width));
  const auto place = [&](const char* name) {
    const Table row = places.where("name", name);
    return Eigen::Vector2d(row.number(0, "x"), row.number(0, "y"));
  };
  const Eigen::Vector2d u_a = place("u_a"), u_d = place("u_d"), b_1 = place("b_1");

  const Table boundary = places.where("name", "boundary");
  Eigen::AlignedBox2d box(u_a);
  box.extend(u_d);
  std::vector<std::vector<double>> outline;
  for (std::size_t i = 0; i <= boundary.rows(); ++i) {
    const std::size_t row = i % boundary.rows();
    outline.push_back({boundary.number(row, "x"), boundary.number(row, "y")});
    box.extend(Eigen::Vector2d(outline.back()[0], outline.back()[1]));
  }
  const double half = 0.58 * box.sizes().maxCoeff();
  const Eigen::Vector2d beyond = b_1 + 0.35 * (b_1 - u_d);
  const auto label = [&](const char* text, const Eigen::Vector2d& at, double dx, double dy) {
    figure.add(
        fmt::format("set label '{}' at {},{} center front font ',14'", text, at.x() + dx * half, at.y() + dy * half));
  };
  figure.add(
      fmt::format("set title '(a) the ray' offset 0,-0.4\nset size ratio -1\nset xlabel 'x [length]'\n"
                  "set ylabel 'y [length]'\nset xrange [{}:{}]\nset yrange [{}:{}]\nset tics 0.1\n"
                  "set format '%.1f'\nunset key",
                  box.center().x() - half, box.center().x() + half, box.center().y() - half, box.center().y() + half));
  figure.add(fmt::format("set arrow from {},{} to {},{} filled front lw 1.8 lc rgb '{}'", u_d.x(), u_d.y(), beyond.x(),
                         beyond.y(), colour::black));
  label("{/:Bold u}^a", u_a, 0.0, 0.1);
  label("{/:Bold u}^d", u_d, -0.1, -0.07);
  label("{/:Bold b}^1", b_1, 0.03, 0.12);
  label("{/:Bold s}^1", beyond, 0.04, -0.1);
  label("{/:Italic W}^{ D}", {box.center().x() - 0.25 * half, box.center().y() - 0.3 * half}, 0.0, 0.0);
  const std::string points = figure.add_data({{u_a.x(), u_a.y()}, {u_d.x(), u_d.y()}, {b_1.x(), b_1.y()}});
  figure.add(fmt::format(
      "plot {} using 1:2 with filledcurves closed fillcolor rgb '#dcebf5' fillstyle solid 1.0 border lc rgb '{}' lw 2, "
      "{} using 1:2 with points pt 7 ps 0.9 lc rgb '{}'",
      figure.add_data(outline), colour::blue, points, colour::vermilion));

  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row < along.rows(); ++row) {
    rows.push_back({along.number(row, "r"), along.number(row, "w_min_deg"), along.number(row, "w_max_deg")});
  }
  const double phi_min = along.number(0, "phi_min_deg"), phi_max = along.number(0, "phi_max_deg");
  const double r_star = along.number(0, "r_star");
  const std::string data = figure.add_data(rows);
  figure.add(fmt::format(
      "unset arrow\nunset label\nset title '(b) orientations attained along the ray' offset 0,-0.4\nset size noratio\n"
      "set xlabel 'r [length]'\nset ylabel 'orientation [°]'\nset xrange [0:{}]\nset autoscale y\nset xtics 0.1\n"
      "set ytics 10\nset format y '%.0f'\n"
      "set arrow from {},graph 0 to {},graph 1 nohead dt 2 lw 1.4 lc rgb '{}' front\n"
      "set label '{{/:Italic r}}^*' at {},graph 0.04 offset 0.8,0 front font ',14'\n"
      "set key inside top right vertical Left reverse samplen 2 width -1 spacing 1.3 maxrows 4",
      rows.back()[0], r_star, r_star, colour::black, r_star));
  figure.add(fmt::format(
      "plot {0} using 1:2:3 with filledcurves fillcolor rgb '#dcebf5' fillstyle solid 1.0 title 'attained', "
      "{0} using 1:3 with lines lc rgb '{1}' lw 2 title 'w^{{max}}', "
      "{0} using 1:2 with lines lc rgb '{2}' lw 2 title 'w^{{min}}', "
      "{3} with lines lc rgb '{5}' dt 2 lw 1.6 title 'ϕ^{{max}}, ϕ^{{min}}', "
      "{4} with lines lc rgb '{5}' dt 2 lw 1.6 notitle",
      data, colour::blue, colour::green, phi_max, phi_min, colour::vermilion));
  figure.add("unset multiplot");
  return figure;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  experiment.options().number("--chord", settings.chord, NumberRange::positive(0.5), "chord length d");
  experiment.options().number("--half-width", settings.half_width_deg, NumberRange::between(0.0, 179.0),
                              "half width of the range of orientations about 0, degrees");
  experiment.options().number("--ray", settings.ray_deg, NumberRange::between(-180.0, 180.0),
                              "direction of the ray, degrees");
  return experiment.run(
      argc, argv,
      [&](Session& session) {
        const auto [places, along] = compute(read_chapter_manipulator("M1"), settings);
        session.write(places);
        session.write(along, "along");
      },
      [](Session& session) { session.draw(draw(session.table(), session.table("along"))); });
}
