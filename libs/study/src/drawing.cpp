#include "reprise/study/drawing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {

namespace {

namespace colour = colour;

using Rows = std::vector<std::vector<double>>;

Rows closed(const Outline& outline) {
  Rows rows;
  for (std::size_t i = 0; i <= outline.size(); ++i) {
    const Eigen::Vector2d& point = outline[i % outline.size()];
    rows.push_back({point.x(), point.y()});
  }
  return rows;
}

Rows open(const Outline& points) {
  Rows rows;
  for (const Eigen::Vector2d& point : points) rows.push_back({point.x(), point.y()});
  return rows;
}

/// A picture of a part of the plane, a box with a margin, in which a length is the same along x and y: a title above,
/// the legend below, `beside` points to the right for a scale.
Figure plane_figure(const std::string& title, const std::string& unit, Eigen::AlignedBox2d box, double beside = 0.0) {
  constexpr double longest = 500.0, left = 78.0, right = 22.0, top = 40.0, bottom = 96.0;  // points
  if (box.isEmpty()) box = Eigen::AlignedBox2d(Eigen::Vector2d(-1.0, -1.0), Eigen::Vector2d(1.0, 1.0));
  const double size = std::max(box.sizes().maxCoeff(), 1e-6 * (1.0 + box.center().norm()));
  // The shorter side is never so short that its axis has no room for its label.
  Eigen::Vector2d half = (0.5 * box.sizes()).cwiseMax(0.25 * size) + Eigen::Vector2d::Constant(0.05 * size);
  const double scale = longest / (2.0 * half.maxCoeff());
  // The legend needs some width.
  half.x() = std::max(half.x(), 210.0 / scale);
  const double plot_width = 2.0 * half.x() * scale;
  const double width = plot_width + left + right + beside;
  const double height = 2.0 * half.y() * scale + top + bottom;
  Figure figure(static_cast<int>(width), static_cast<int>(height));
  figure.add(
      fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at "
                  "screen {}",
                  left / width, (left + plot_width) / width, bottom / height, 1.0 - top / height));
  figure.add(
      fmt::format("set key at screen {}, screen {} center center horizontal Left reverse samplen 1.6 width -2 "
                  "maxrows 2 noenhanced",
                  (left + 0.5 * plot_width) / width, 26.0 / height));
  const Eigen::Vector2d from = box.center() - half;
  const Eigen::Vector2d to = box.center() + half;
  figure.add(fmt::format("set size ratio -1\nset xlabel {} noenhanced offset 0,0.3\nset ylabel {} noenhanced",
                         gnuplot_string(fmt::format("x [{}]", unit)), gnuplot_string(fmt::format("y [{}]", unit))));
  figure.add(fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]", from.x(), to.x(), from.y(), to.y()));
  figure.add(fmt::format("set xtics {0}\nset ytics {0}\nset format '%g'", round_step(2.0 * size, 16.0)));
  figure.add(fmt::format("set title {} noenhanced offset 0,-0.3", gnuplot_string(title)));
  return figure;
}

Eigen::AlignedBox2d box_of(const std::vector<DrawnComponent>& components) {
  Eigen::AlignedBox2d box;
  for (const DrawnComponent& component : components) {
    for (const Eigen::Vector2d& point : component.boundary) box.extend(point);
  }
  return box;
}

/// The commands that draw outlines as lines.
std::string outline_plots(Figure& figure, const std::vector<DrawnComponent>& components) {
  std::string plots;
  bool first = true;
  for (const DrawnComponent& component : components) {
    std::vector<Outline> loops = component.holes;
    loops.insert(loops.begin(), component.boundary);
    for (const Outline& loop : loops) {
      plots += fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' {}, ", figure.add_data(closed(loop)),
                           colour::black, first ? "title 'boundary'" : "notitle");
      first = false;
    }
  }
  return plots;
}

void plot(Figure& figure, std::string plots) {
  if (plots.empty()) plots = "NaN notitle, ";
  plots.resize(plots.size() - 2);
  figure.add("plot " + plots);
}

constexpr std::array<const char*, 6> pose_colours{colour::blue,   colour::vermilion, colour::green,
                                                  colour::purple, colour::orange,    colour::sky};

}  // namespace

Figure draw_poses(const Manipulator& manipulator, const std::vector<Pose>& poses, const std::string& unit) {
  Eigen::AlignedBox2d box;
  for (const Pose& pose : poses) {
    box.extend(pose.position);
    for (const Leg& leg : manipulator.legs()) box.extend(leg.base_joint + leg_vector(leg, pose));
  }
  for (const Leg& leg : manipulator.legs()) box.extend(leg.base_joint);
  Figure figure = plane_figure(manipulator.name(), unit, box);
  Outline bases;
  for (const Leg& leg : manipulator.legs()) {
    bases.push_back(leg.base_joint);
  }
  std::string plots;
  std::string joints;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose& pose = poses[k];
    const char* const paint = pose_colours[k % pose_colours.size()];
    Rows legs;
    Outline platform;
    for (const Leg& leg : manipulator.legs()) {
      const Eigen::Vector2d end = leg.base_joint + leg_vector(leg, pose);
      legs.push_back({leg.base_joint.x(), leg.base_joint.y()});
      legs.push_back({end.x(), end.y()});
      legs.emplace_back();
      platform.push_back(end);
    }
    // The corners in order around their middle, and the working point as one of them: the platform as a plate.
    Outline plate = platform;
    plate.push_back(pose.position);
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : plate) middle += corner / static_cast<double>(plate.size());
    std::sort(plate.begin(), plate.end(), [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
      return std::atan2(p.y() - middle.y(), p.x() - middle.x()) < std::atan2(q.y() - middle.y(), q.x() - middle.x());
    });
    const std::string plate_data = figure.add_data(closed(plate));
    plots +=
        fmt::format("{} using 1:2 with filledcurves closed fc rgb '{}' fs transparent solid 0.15 noborder notitle, ",
                    plate_data, paint);
    plots += fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' notitle, ", plate_data, paint);
    plots += fmt::format("{} using 1:2 with lines lw 2.5 lc rgb '{}' title {}, ", figure.add_data(legs), paint,
                         gnuplot_string(poses.size() == 1 ? "legs and platform" : fmt::format("mode {}", k + 1)));
    joints += fmt::format("{} using 1:2 with points pt 7 ps 0.6 lc rgb '{}' notitle, ", figure.add_data(open(platform)),
                          paint);
    joints += fmt::format("{} using 1:2 with points pt 2 ps 1 lw 2 lc rgb '{}' {}, ",
                          figure.add_data(open({pose.position})), paint, k == 0 ? "title 'working point'" : "notitle");
  }
  plots += joints;
  plots += fmt::format("{} using 1:2 with points pt 9 ps 1.4 lc rgb '{}' title 'base joints', ",
                       figure.add_data(open(bases)), colour::black);
  plot(figure, plots);
  return figure;
}

Figure draw_workspace(const std::string& title, const ManipulatorInput& input,
                      const std::vector<DrawnComponent>& components, const Outline& bifurcation_points) {
  // Base joints are shown unless they are so far away that the workspace would be small beside them.
  Eigen::AlignedBox2d box = box_of(components);
  Eigen::AlignedBox2d with_bases = box;
  Outline bases;
  for (const Leg& leg : input.manipulator.legs()) {
    bases.push_back(leg.base_joint);
    with_bases.extend(leg.base_joint);
  }
  const bool shows_bases = box.isEmpty() || with_bases.sizes().maxCoeff() < 4.0 * box.sizes().maxCoeff();
  Figure figure = plane_figure(title, input.column_unit(), shows_bases ? with_bases : box);
  std::string plots;
  for (const DrawnComponent& component : components) {
    plots += fmt::format("{} using 1:2 with filledcurves closed fc rgb '#d6e6f2' fs solid noborder notitle, ",
                         figure.add_data(closed(component.boundary)));
    for (const Outline& hole : component.holes) {
      plots += fmt::format("{} using 1:2 with filledcurves closed fc rgb '#ffffff' fs solid noborder notitle, ",
                           figure.add_data(closed(hole)));
    }
  }
  plots += outline_plots(figure, components);
  if (!bifurcation_points.empty()) {
    plots += fmt::format("{} using 1:2 with points pt 7 ps 0.8 lc rgb '{}' title 'bifurcation points', ",
                         figure.add_data(open(bifurcation_points)), colour::vermilion);
  }
  if (shows_bases) {
    plots += fmt::format("{} using 1:2 with points pt 9 ps 1.4 lc rgb '{}' title 'base joints', ",
                         figure.add_data(open(bases)), colour::black);
  }
  plot(figure, plots);
  return figure;
}

Figure draw_orientations(const std::string& title, const std::vector<Interval>& intervals) {
  Figure figure(460, 500);
  std::string plots;
  for (const Interval& interval : intervals) {
    Outline sector;
    const double sweep = interval.upper - interval.lower;
    const bool whole = sweep > 2.0 * pi - 1e-9;
    if (!whole) sector.emplace_back(0.0, 0.0);
    const int steps = 2 + static_cast<int>(sweep * 60.0);
    for (int k = 0; k <= steps; ++k) sector.emplace_back(unit(interval.lower + sweep * k / steps));
    const std::string data = figure.add_data(closed(sector));
    plots += fmt::format("{} using 1:2 with filledcurves closed fc rgb '#d6e6f2' fs solid noborder notitle, ", data);
    plots += fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' notitle, ", data, colour::blue);
  }
  Outline circle;
  for (int k = 0; k < 360; ++k) circle.push_back(unit(k * pi / 180.0));
  plots +=
      fmt::format("{} using 1:2 with lines lw 1 lc rgb '{}' notitle, ", figure.add_data(closed(circle)), colour::grey);
  figure.add(
      "set size ratio -1\nunset border\nunset tics\nunset grid\nset xrange [-1.25:1.25]\nset yrange [-1.25:1.25]");
  for (int degrees = -150; degrees <= 180; degrees += 30) {
    const Eigen::Vector2d at = 1.13 * unit(degrees * pi / 180.0);
    figure.add(fmt::format("set label '{}°' at {},{} center", degrees, at.x(), at.y()));
  }
  figure.add(fmt::format("set title {} noenhanced", gnuplot_string(title)));
  plot(figure, plots);
  return figure;
}

Figure draw_conditioning(const std::string& title, const ManipulatorInput& input,
                         const std::vector<std::vector<MapPoint>>& scan_lines,
                         const std::vector<DrawnComponent>& components, const MapPoint& least,
                         const MapPoint& greatest) {
  Figure figure = plane_figure(title, input.column_unit(), box_of(components), 110.0);
  Rows rows;
  double low = 1.0;
  double high = 0.0;
  for (const std::vector<MapPoint>& line : scan_lines) {
    for (const MapPoint& point : line) {
      rows.push_back({point.position.x(), point.position.y(), point.value});
      if (std::isnan(point.value)) continue;
      low = std::min(low, point.value);
      high = std::max(high, point.value);
    }
    rows.emplace_back();
  }
  if (!(high > low)) {
    low = std::max(0.0, low - 0.01);
    high = low + 0.02;
  }
  figure.add("set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 '#fde725')");
  figure.add("set cblabel 'inverse condition number κ⁻¹ [-]' offset 1,0\nset colorbox\nunset grid");
  figure.add(fmt::format("set cbrange [{}:{}]", low, high));
  std::string plots =
      fmt::format("{} using 1:2:3 with image notitle, ", figure.add_data(rows)) + outline_plots(figure, components);
  const auto mark = [&](const MapPoint& point, const char* what, int type) {
    plots += fmt::format("{} using 1:2 with points pt {} ps 1.4 lw 2 lc rgb '{}' title '{} {:.4g}', ",
                         figure.add_data(open({point.position})), type, colour::vermilion, what, point.value);
  };
  mark(least, "least", 2);
  mark(greatest, "greatest", 6);
  plot(figure, plots);
  return figure;
}

Figure draw_progress(const std::vector<ProgressCurve>& curves) {
  Figure figure(760, 460);
  double most = 0.0;
  double least = 1.0;
  double longest = 10.0;
  for (const ProgressCurve& curve : curves) {
    for (const Eigen::Vector2d& point : curve.points) {
      longest = std::max(longest, point.x());
      most = std::max(most, point.y());
      least = std::min(least, point.y());
    }
  }
  if (least > most) least = most = 0.0;
  // What is far below the best is not worth the room.
  const double shown = std::clamp(most - least, 0.01, 0.2);
  figure.add("set logscale x\nset xlabel 'function evaluations'\nset ylabel 'best least κ⁻¹ so far [-]'");
  figure.add(fmt::format("set xrange [1:{}]\nset yrange [{}:{}]", longest, most - shown, most + 0.05 * shown));
  figure.add("set key outside right center vertical Left reverse noenhanced samplen 2.5");
  std::string plots;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    Rows rows = open(curves[k].points);
    // A curve goes on to the right at its last value; one without a feasible point has nothing but its entry in the
    // key.
    rows.push_back(rows.empty() ? std::vector<double>{longest, most + shown}
                                : std::vector<double>{longest, rows.back()[1]});
    plots += fmt::format("{} using 1:2 with steps lt {} dt {} title {}, ", figure.add_data(rows), k % 8 + 1,
                         k < 8 ? 1 : 2, gnuplot_string(curves[k].optimizer));
  }
  plot(figure, plots);
  return figure;
}

}  // namespace reprise
