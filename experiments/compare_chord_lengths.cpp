// What the chord length costs and buys: error of the area and Hausdorff distance of traced workspaces against exact
// ones, with and without bifurcation points, and the synthesis of Table 5.3 with other chords. Beyond the thesis.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "chapter/problems.hpp"
#include "chapter/synthesis_study.hpp"
#include "frame/experiment.hpp"
#include "frame/power_tics.hpp"
#include "reprise/geometry/hausdorff_distance.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/synthesis/area_formulation.hpp"
#include "reprise/workspace/complete_trace.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

struct Settings {
  std::vector<std::string> manipulators{"M1", "M2", "M3"};
  std::vector<double> chords{0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005};
  double range_deg = 5.0;
  long starts = 8;
  std::vector<std::string> workspaces{"P1", "P2", "P3"};
  std::vector<double> synthesis_chords{0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002};

  void declare(CommandLine& options) {
    options.choices("--manipulator", manipulators, manipulators, "manipulators whose workspaces are traced");
    options.numbers("--chords", chords, NumberRange::positive(), "chord lengths d of the workspaces, length");
    options.number("--range", range_deg, NumberRange::between(0.0, 90.0),
                   "the dextrous workspaces are those over plus and minus this, degrees");
    options.integer("--starts", starts, 1, 1000, "walks for each boundary, from different first points");
    options.choices("--workspace", workspaces, workspaces, "prescribed workspaces of the synthesis");
    options.numbers("--synthesis-chords", synthesis_chords, NumberRange::positive(),
                    "chord lengths d of the synthesis, length");
  }
};

/// Leaves out what is shorter than `least`, but not everything.
void drop_short(std::vector<double>& chords, double least) {
  least = std::min(least, *std::max_element(chords.begin(), chords.end()));
  std::erase_if(chords, [least](double d) { return d < least; });
}

/// A workspace to be traced, and the exact one.
struct TestWorkspace {
  std::string manipulator;
  std::string kind;
  std::unique_ptr<Limits> limits;
  Region region;
  double exact_area = 0.0;
  std::vector<TracedBoundary> boundaries;  ///< one walk along each, for its start
};

std::vector<TestWorkspace> make_workspaces(const Settings& settings) {
  std::vector<TestWorkspace> workspaces;
  for (const std::string& name : settings.manipulators) {
    const CollinearManipulator read = read_chapter_manipulator(name);
    const Manipulator manipulator = make_manipulator(read.design, read.lengths, name);
    const Interval orientations{-settings.range_deg * degree, settings.range_deg * degree};
    workspaces.push_back({name,
                          "constant_orientation",
                          std::make_unique<ConstantOrientationLimits>(manipulator, 0.0),
                          constant_orientation_workspace(manipulator, 0.0),
                          0.0,
                          {}});
    workspaces.push_back({name,
                          "dextrous",
                          std::make_unique<DextrousLimits>(manipulator, orientations),
                          dextrous_workspace(manipulator, orientations),
                          0.0,
                          {}});
  }
  for (TestWorkspace& workspace : workspaces) {
    if (workspace.region.empty()) {
      throw std::runtime_error(fmt::format("the {} workspace of {} is empty.", workspace.kind, workspace.manipulator));
    }
    workspace.exact_area = workspace.region.area();
    TraceOptions options;
    options.chord = 0.02 * workspace.region.perimeter();
    TracedWorkspace traced = trace_all_boundaries(*workspace.limits, workspace.region, options);
    if (!traced.complete()) {
      throw std::runtime_error(fmt::format("the {} workspace of {} was not traced: {}.", workspace.kind,
                                           workspace.manipulator, traced.failures.front().reason));
    }
    for (TracedComponent& component : traced.components) {
      workspace.boundaries.push_back(std::move(component.outer));
      for (TracedBoundary& hole : component.holes) workspace.boundaries.push_back(std::move(hole));
    }
  }
  return workspaces;
}

/// All boundaries of a workspace traced once.
struct Walk {
  double points = 0.0;
  double evaluations = 0.0;
  double area = 0.0;
  double hausdorff = 0.0;
  bool closed = true;
};

/// The rays begin where those of the complete tracing do, turned by an angle, so that chords fall otherwise on corners.
Walk walk(const TestWorkspace& workspace, TraceOptions options, double angle) {
  Walk result;
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  for (const TracedBoundary& boundary : workspace.boundaries) {
    const Eigen::Vector2d ray = boundary.points.front().position - boundary.start;
    options.first_direction = Eigen::Rotation2Dd(angle) * ray;
    const TracedBoundary traced = trace_boundary(*workspace.limits, boundary.start, options);
    polygons.push_back(traced.positions());
    result.closed = result.closed && traced.closed();
    result.points += static_cast<double>(traced.points.size());
    result.evaluations += static_cast<double>(traced.evaluations);
    result.area += signed_area(polygons.back());
  }
  constexpr double resolution = 1e-12;
  result.hausdorff = hausdorff_distance(polygons, workspace.region, resolution).value();
  return result;
}

Table trace_workspaces(const std::vector<TestWorkspace>& workspaces, const Settings& settings) {
  Table table("Traced and exact workspaces by chord length",
              {{"manipulator", "-", "design of Table 5.1"},
               {"kind", "-",
                fmt::format("constant_orientation: phi = 0; dextrous: all phi from {0} to {1} degrees",
                            -settings.range_deg, settings.range_deg)},
               {"d", "length", "chord length"},
               {"bifurcation_points", "-", "1 when bifurcation points were put in, else 0"},
               {"n_b", "-", "number of boundary points of all components, mean over the starts"},
               {"area", "length^2", "traced area, mean over the starts"},
               {"exact_area", "length^2", "area of the exact region"},
               {"area_error", "length^2", "traced less exact area, root mean square over the starts"},
               {"hausdorff", "length", "Hausdorff distance of traced and exact boundary, root mean square"},
               {"evaluations", "-", "evaluations of all limits at one point, mean over the starts"},
               {"starts", "-", "number of walks along each boundary"},
               {"area_error_least", "length^2", "absolute error of the start with the least"},
               {"area_error_largest", "length^2", "absolute error of the start with the largest"},
               {"hausdorff_largest", "length", "Hausdorff distance of the start with the largest"}},
              {"Each boundary is traced from several first points, since without bifurcation points the error depends "
               "on where chords fall at corners."});
  Progress progress(workspaces.size() * settings.chords.size());
  for (const TestWorkspace& workspace : workspaces) {
    for (const double d : settings.chords) {
      progress.begin(fmt::format("{}, {}, d = {}", workspace.manipulator, workspace.kind, d));
      for (const bool bifurcation_points : {true, false}) {
        Walk sum;
        double square_error = 0.0;
        double square_distance = 0.0;
        double least = std::numeric_limits<double>::infinity();
        double largest = 0.0;
        double farthest = 0.0;
        for (long k = 0; k < settings.starts; ++k) {
          // Within 45 degrees to either side.
          const double angle =
              90.0 * degree * ((static_cast<double>(k) + 0.5) / static_cast<double>(settings.starts) - 0.5);
          TraceOptions options;
          options.chord = d;
          options.bifurcation_points = bifurcation_points;
          const Walk one = walk(workspace, options, angle);
          if (!one.closed) {
            throw std::runtime_error(fmt::format("the {} workspace of {} is too small for the chord length {}.",
                                                 workspace.kind, workspace.manipulator, d));
          }
          const double error = std::abs(one.area - workspace.exact_area);
          sum.points += one.points;
          sum.evaluations += one.evaluations;
          sum.area += one.area;
          square_error += error * error;
          square_distance += one.hausdorff * one.hausdorff;
          least = std::min(least, error);
          largest = std::max(largest, error);
          farthest = std::max(farthest, one.hausdorff);
        }
        const auto n = static_cast<double>(settings.starts);
        table.add_row({workspace.manipulator, workspace.kind, d, bifurcation_points ? 1 : 0, sum.points / n,
                       sum.area / n, workspace.exact_area, std::sqrt(square_error / n), std::sqrt(square_distance / n),
                       sum.evaluations / n, settings.starts, least, largest, farthest});
      }
    }
  }
  return table;
}

/// Least-squares fit of log y = log coefficient + order log x.
struct Power {
  double order;
  double coefficient;
};

Power fit_power(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixX2d matrix(n, 2);
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    matrix.row(i) << 1.0, std::log(x[static_cast<std::size_t>(i)]);
    right[i] = std::log(y[static_cast<std::size_t>(i)]);
  }
  const Eigen::Vector2d fitted = matrix.colPivHouseholderQr().solve(right);
  return {fitted[1], std::exp(fitted[0])};
}

Table fit_orders(const Table& errors) {
  Table table("Orders of the errors in the chord length",
              {{"manipulator", "-", "design of Table 5.1"},
               {"kind", "-", "constant_orientation or dextrous"},
               {"bifurcation_points", "-", "1 when bifurcation points were put in, else 0"},
               {"order_area", "-", "slope of log area_error over log d, least squares over all chord lengths"},
               {"order_hausdorff", "-", "slope of log hausdorff over log d"},
               {"area_error_per_d2", "-", "area_error / d^2, geometric mean over the chord lengths"},
               {"area_ratio", "-", "area_error_per_d2 divided by that with bifurcation points"},
               {"spread", "-", "largest by least area_error of the starts, geometric mean over the chord lengths"}});
  for (const std::string& manipulator : errors.distinct("manipulator")) {
    for (const std::string& kind : errors.distinct("kind")) {
      double with = 0.0;
      for (const std::string bifurcation_points : {"1", "0"}) {
        const Table rows = errors.where("manipulator", manipulator)
                               .where("kind", kind)
                               .where("bifurcation_points", bifurcation_points);
        if (rows.rows() < 2) continue;
        const std::vector<double> d = rows.numbers("d");
        const std::vector<double> area = rows.numbers("area_error");
        const std::vector<double> least = rows.numbers("area_error_least");
        const std::vector<double> largest = rows.numbers("area_error_largest");
        double per_square = 0.0;
        double spread = 0.0;
        for (std::size_t i = 0; i < d.size(); ++i) {
          per_square += std::log(area[i] / (d[i] * d[i])) / static_cast<double>(d.size());
          spread += std::log(largest[i] / least[i]) / static_cast<double>(d.size());
        }
        per_square = std::exp(per_square);
        if (bifurcation_points == "1") with = per_square;
        table.add_row({manipulator, kind, bifurcation_points, fit_power(d, area).order,
                       fit_power(d, rows.numbers("hausdorff")).order, per_square, per_square / with, std::exp(spread)});
      }
    }
  }
  return table;
}

/// The synthesis of Table 5.3, Dynamic-Q with the area formulation, for several chord lengths.
Table synthesise(const Settings& settings) {
  Table table(
      "SO synthesis by chord length: Dynamic-Q, area formulation, settings of section 5.6.2",
      {{"workspace", "-", "prescribed workspace (reconstructed, not published)"},
       {"d", "length", "chord length"},
       {"N_g", "-", "points at which gradients were evaluated, N^g"},
       {"N_f", "-", "points at which functions were evaluated, finite differences counted in"},
       {"n_b", "-", "number of boundary points in one evaluation of f and g, at the final design"},
       {"limit_evaluations", "-", "evaluations of all limits in one evaluation of f and g, at the final design"},
       {"cost", "-", "N_f limit_evaluations: about the evaluations of all limits in the run"},
       {"f_star", "-", "smallest inverse condition number of the final design, as the formulation sees it"},
       {"g_star", "length^2", "constraint (5.35) of the final design, as the formulation sees it"},
       {"kappa_inv_dense", "-", "smallest inverse condition number over a dense sample of the outline"},
       {"violation_dense", "length", "largest violation of a leg's limit over a dense sample of the outline"},
       {"status", "-", "how the optimizer ended"}},
      {"Prescribed workspaces are reconstructed from the printed results, not published."});
  const SynthesisInputs inputs = read_synthesis_inputs("SO synthesis by chord length", chapter_synthesis("SO"));
  ChapterSettings synthesis = chapter_settings(chapter_synthesis("SO"));
  synthesis.workspaces = settings.workspaces;
  synthesis.formulations = {"area"};
  synthesis.optimizers = {"dynamic_q"};
  for (const double d : settings.synthesis_chords) {
    synthesis.chord = d;
    const Table found = run_synthesis_study(inputs, synthesis).first;
    for (std::size_t row = 0; row < found.rows(); ++row) {
      const auto prescribed =
          std::find_if(inputs.workspaces.begin(), inputs.workspaces.end(),
                       [&](const PrescribedWorkspace& one) { return one.name() == found.text(row, "workspace"); });
      const AreaFormulation formulation(
          {*prescribed, slices({0.0}), DesignSpace::collinear(inputs.lengths), printed_conditioning},
          {.chord_length = d});
      Eigen::VectorXd design(5);
      design << found.number(row, "x_C"), found.number(row, "y_C"), found.number(row, "x_D"), found.number(row, "x_E"),
          found.number(row, "r");
      const AreaEvaluation last = formulation.evaluate(design);
      table.add_row({found.text(row, "workspace"), d, found.text(row, "N_g"), found.text(row, "N_f"),
                     last.boundary_points, last.limit_evaluations,
                     found.number(row, "N_f") * static_cast<double>(last.limit_evaluations), found.text(row, "f_star"),
                     found.text(row, "g_star"), found.text(row, "kappa_inv_dense"), found.text(row, "violation_dense"),
                     found.text(row, "status")});
    }
  }
  return table;
}

using Palette = std::array<const char*, 3>;
constexpr Palette manipulator_colours = {colour::blue, colour::vermilion, colour::green};
/// P1, P2 and P3 have the colours that they have in the maps.
constexpr Palette workspace_colours = {colour::vermilion, colour::green, colour::purple};

const char* colour_of(const Palette& palette, const std::string& name) {
  return palette.at(static_cast<std::size_t>(name.back() - '1') % palette.size());
}

std::vector<std::vector<double>> points_of(const Table& table, const std::string& x, const std::string& y) {
  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) rows.push_back({table.number(row, x), table.number(row, y)});
  return rows;
}

/// One quantity against the chord length, both kinds of workspace side by side, with lines of slopes 1 and 2.
Figure draw_errors(const Table& table, const std::string& quantity, const std::string& label) {
  const std::vector<std::string> manipulators = table.distinct("manipulator");
  const std::vector<double> chords = table.numbers("d");
  const std::vector<double> values = table.numbers(quantity);
  const auto [shortest, longest] = std::minmax_element(chords.begin(), chords.end());
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double bottom = *least / 5.0;
  const double top = *most * 8.0;

  Figure figure(840, 456);
  figure.add("set multiplot layout 1,2 margins 0.095, 0.985, 0.16, 0.925 spacing 0.025, 0");
  figure.add("set logscale xy\nset border 15\nset xlabel 'chord length d [length]'\nset mxtics default");
  figure.add("set key bottom right inside vertical samplen 2.5 spacing 1.15");
  figure.add(fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset format x '%g'", *shortest / 1.5, *longest * 1.5,
                         bottom, top));
  bool first = true;
  for (const std::string& kind : table.distinct("kind")) {
    figure.add(fmt::format("set title {} offset 0,-0.4\nset ylabel {}\n{}",
                           gnuplot_string(kind == "dextrous" ? "(b) dextrous" : "(a) constant orientation"),
                           gnuplot_string(first ? label : ""), power_tics("y", bottom, top, first)));
    // The guides meet above the largest value at the longest chord.
    std::string plot = "plot ";
    for (const int slope : {1, 2}) {
      plot += fmt::format("{} * (x / {}) ** {} with lines lc rgb '{}' dt {} lw 1.2 {}, ", 2.5 * *most, *longest, slope,
                          colour::grey, slope == 1 ? 3 : 2,
                          first ? std::string("notitle") : fmt::format("title 'slope {}'", slope));
    }
    for (const std::string bifurcation_points : {"1", "0"}) {
      const bool with = bifurcation_points == "1";
      const std::string style = fmt::format("lw 1.5 pt {} ps 0.7 dt {}", with ? 7 : 6, with ? "1" : "'-'");
      for (const std::string& manipulator : manipulators) {
        const Table rows =
            table.where("kind", kind).where("manipulator", manipulator).where("bifurcation_points", bifurcation_points);
        plot +=
            fmt::format("{} using 1:2 with linespoints lc rgb '{}' {} {}, ",
                        figure.add_data(points_of(rows, "d", quantity)), colour_of(manipulator_colours, manipulator),
                        style, first && with ? "title " + gnuplot_string(manipulator) : std::string("notitle"));
      }
      if (!first) {
        plot += fmt::format("keyentry with linespoints lc rgb '{}' {} title '{} bifurcation points', ", colour::black,
                            style, with ? "with" : "without");
      }
    }
    plot.resize(plot.size() - 2);
    figure.add(plot);
    first = false;
  }
  figure.add("unset multiplot");
  return figure;
}

/// What the chord length does to the synthesis.
Figure draw_synthesis(const Table& table) {
  const std::vector<std::string> workspaces = table.distinct("workspace");
  const std::vector<double> chords = table.numbers("d");
  const auto [shortest, longest] = std::minmax_element(chords.begin(), chords.end());
  Figure figure(960, 356);
  figure.add("set multiplot layout 1,3 margins 0.085, 0.985, 0.21, 0.9 spacing 0.1, 0");
  figure.add(fmt::format("set border 15\nset logscale x\nset xrange [{}:{}]\nset format x '%g'", *shortest / 1.5,
                         *longest * 1.5));
  figure.add("set xlabel 'chord length d [length]'");
  const auto range_of = [&table](const std::string& column) {
    const std::vector<double> values = table.numbers(column);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return std::pair(*least, *most);
  };
  const auto draw = [&](const std::string& title, const std::string& column, const std::string& label) {
    figure.add(fmt::format("set title {} offset 0,-0.4\nset ylabel {} offset 0.5,0", gnuplot_string(title),
                           gnuplot_string(label)));
    std::string plot = "plot ";
    for (const std::string& workspace : workspaces) {
      plot += fmt::format("{} using 1:2 with linespoints lc rgb '{}' lw 1.5 pt 7 ps 0.7 {}, ",
                          figure.add_data(points_of(table.where("workspace", workspace), "d", column)),
                          colour_of(workspace_colours, workspace), "title " + gnuplot_string(workspace));
    }
    plot.resize(plot.size() - 2);
    figure.add(plot);
  };
  const auto [worst, best] = range_of("kappa_inv_dense");
  figure.add(fmt::format("unset key\nset format y '%.3f'\nset yrange [{}:{}]", worst - 0.003, best + 0.003));
  draw("(a) conditioning", "kappa_inv_dense", "smallest κ⁻¹ of the design [-]");
  figure.add(fmt::format("set format y '%g'\nset ytics 0.001\nset yrange [0:{}]",
                         1.1 * range_of("violation_dense").second + 1e-6));
  draw("(b) violation", "violation_dense", "largest violation of a limit [length]");
  const auto [cheapest, dearest] = range_of("cost");
  figure.add(fmt::format("set key top right inside vertical samplen 2\nset logscale y\nset yrange [{}:{}]\n{}",
                         cheapest / 2.0, dearest * 2.0, power_tics("y", cheapest / 2.0, dearest * 2.0, true)));
  draw("(c) cost", "cost", "evaluations of all limits [-]");
  figure.add("unset multiplot");
  return figure;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  settings.declare(experiment.options());

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        if (session.quick()) {
          settings.starts = std::min(settings.starts, 2L);
          drop_short(settings.chords, 0.005);
          drop_short(settings.synthesis_chords, 0.02);
        }
        using Clock = std::chrono::steady_clock;
        const auto seconds_since = [](Clock::time_point begin) {
          return std::chrono::duration<double>(Clock::now() - begin).count();
        };
        const auto begin = Clock::now();
        const Table errors = trace_workspaces(make_workspaces(settings), settings);
        session.record("seconds_tracing", seconds_since(begin));
        session.write(errors);
        session.write(fit_orders(errors), "orders");

        const auto begin_synthesis = Clock::now();
        session.write(synthesise(settings), "synthesis");
        session.record("seconds_synthesis", seconds_since(begin_synthesis));
      },
      [](Session& session) {
        const Table errors = session.table();
        session.draw(draw_errors(errors, "area_error", "error of the area [length²]"));
        session.draw(draw_errors(errors, "hausdorff", "Hausdorff distance [length]"), "hausdorff");
        session.draw(draw_synthesis(session.table("synthesis")), "synthesis");
      });
}
