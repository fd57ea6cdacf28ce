// Table 5.2: what it costs to map dextrous workspaces by Algorithm 5.1, by each way to solve its problems. The
// chapter's own numbers, and the ranges of orientations it took, are on a page that is lost.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

#include "chapter/dextrous_figure.hpp"
#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "frame/spread.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/multi_level.hpp"
#include "reprise/workspace/trace.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

constexpr const char* closed_form = "closed_form";
constexpr const char* bracketing = "bracketing";

struct Settings {
  std::vector<std::string> manipulators{"M1", "M2", "M3"};
  std::vector<double> half_widths_deg{5.0, 10.0, 15.0};
  std::vector<std::string> optimizers{"slsqp", "dynamic_q", "ipopt"};
  double chord = 0.02;
  double inner_move_limit = 0.1;
  long repetitions = 5;

  void declare(CommandLine& options) {
    options.choices("--manipulator", manipulators, manipulators, "manipulators");
    options.numbers("--half-widths", half_widths_deg, NumberRange::between(0.0, 179.0),
                    "half widths of the ranges of orientations about 0, degrees");
    options.choices("--optimizer", optimizers, optimizers, "optimizers that the problems are given to");
    options.number("--chord", chord, NumberRange::positive(0.5), "chord length d");
    options.number("--inner-move-limit", inner_move_limit, NumberRange::positive(),
                   "rho of Dynamic-Q for (5.26) and (5.29)");
    options.integer(
        "--repetitions", repetitions, 1, 1000,
        "how often each computation is timed, at the most; those of more than a second are timed less often");
  }
};

/// How the two constraints of (5.30) and (5.31) are evaluated, and by what those problems are solved.
struct Method {
  std::string inner;  ///< of (5.26)
  std::string outer;  ///< of (5.30) to (5.33)
};

std::unique_ptr<Solver> make_solver(const std::string& name) {
  if (name == "dynamic_q") return std::make_unique<DynamicQ>();
  if (name == "ipopt") return std::make_unique<IpoptSolver>();
  return std::make_unique<NloptSolver>();
}

/// For (5.26) and (5.29), whose variables are in radians and in lengths of the platform: other intervals of
/// orientations, and places without any, lie less than one away. Dynamic-Q gets a move limit that does not carry it
/// there.
std::unique_ptr<Solver> make_careful_solver(const std::string& name, double move_limit) {
  DynamicQOptions careful;
  careful.move_limit = move_limit;
  if (name == "dynamic_q") return std::make_unique<DynamicQ>(careful);
  return make_solver(name);
}

/// The processor's time that the computation takes, again and again: so often, or until they make a second together.
std::vector<double> time_repeatedly(long repetitions, const std::function<void()>& compute) {
  std::vector<double> seconds;
  double sum = 0.0;
  while (seconds.size() < static_cast<std::size_t>(repetitions) && sum < 1.0) {
    const std::clock_t begin = std::clock();
    compute();
    seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    sum += seconds.back();
  }
  return seconds;
}

/// In closed form and by bracketing first; then each optimizer on the outer, on the inner and on both levels.
std::vector<Method> list_methods(const Settings& settings, bool with_slow) {
  std::vector<Method> methods{{closed_form, bracketing}};
  for (const std::string& optimizer : settings.optimizers) {
    // A run of Ipopt costs some 10 ms however small the problem, and there are thousands.
    const bool slow = optimizer == "ipopt";
    if (slow && !with_slow) continue;
    methods.push_back({closed_form, optimizer});
    methods.push_back({optimizer, bracketing});
    if (!slow) methods.push_back({optimizer, optimizer});
  }
  return methods;
}

Table make_table() {
  return {
      "Table 5.2: computation of dextrous workspaces by Algorithm 5.1",
      {{"manipulator", "-", "manipulator design"},
       {"half_width_deg", "degree", "orientations from minus to plus this are attained"},
       {"inner", "-", "how (5.26) is solved: closed_form or an optimizer"},
       {"outer", "-", "how (5.30) to (5.33) are solved: bracketing or an optimizer"},
       {"n_b", "-", "number of boundary points, bifurcation points included"},
       {"type_i", "-", "bifurcation points of type I"},
       {"type_ii", "-", "bifurcation points of type II"},
       {"evaluations", "-", "evaluations of the constraints of (5.30), (5.31)"},
       {"inner_solutions", "-", "solutions of (5.26) for them"},
       {"inner_evaluations", "-", "evaluations of all leg limits at one pose, for the solutions of (5.26)"},
       {"area", "length^2", "area by chords"},
       {"exact_area", "length^2", "exact area of the same component"},
       {"area_error", "length^2", "the former less the latter"},
       {"farthest", "length", "largest distance of a boundary point from the exact boundary"},
       {"x_d", "length", "x coordinate of the point of greatest dexterity u^d found"},
       {"y_d", "length", "y coordinate of it"},
       {"width_d_deg", "degree", "w_max - w_min there"},
       {"status", "-", "how the walk along the boundary ended"},
       {"message", "-", "why it did not close; empty when it did"}},
      {"Ranges of orientations are ours; the thesis's are lost with its table.",
       "(5.29) is solved by the optimizer named, by slsqp where none is.",
       "ipopt is run for the first manipulator and the last range only, and not on both levels: it takes too long."}};
}

Table make_times_table() {
  return {"Table 5.2: times of the computations",
          {{"manipulator", "-", "manipulator design"},
           {"half_width_deg", "degree", "orientations from minus to plus this are attained"},
           {"inner", "-", "how (5.26) is solved: closed_form or an optimizer"},
           {"outer", "-", "how (5.30) to (5.33) are solved: bracketing or an optimizer"},
           {"repetitions", "-", "how often the computation was timed"},
           {"least", "s", "time of the processor, steps 1 to 5 of Algorithm 5.1: the shortest"},
           {"median", "s", "the median"},
           {"most", "s", "the longest"}},
          {"Times differ from run to run."}};
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  settings.declare(experiment.options());

  return experiment.run(argc, argv, [&](Session& session) {
    struct Task {
      std::string manipulator;
      double half_width;
      Method method;
    };
    std::vector<Task> tasks;
    if (session.quick()) {
      settings.half_widths_deg.resize(1);
      settings.repetitions = 1;
    }
    for (const std::string& name : settings.manipulators) {
      for (const double half_width : settings.half_widths_deg) {
        const bool with_slow = name == settings.manipulators.front() && half_width == settings.half_widths_deg.back();
        for (Method& method : list_methods(settings, with_slow && !session.quick())) {
          tasks.push_back({name, half_width, std::move(method)});
        }
      }
    }
    Table table = make_table();
    Table times = make_times_table();
    Progress progress(tasks.size());
    fmt::print("{:<4} {:>5} {:<12} {:<11} {:>5} {:>11} {:>17} {:>10} {:>9}  {}\n", "", "range", "inner", "outer", "n_b",
               "evaluations", "inner evaluations", "area error", "seconds", "status");
    for (const auto& [name, half_width, method] : tasks) {
      progress.begin(fmt::format("{}, +-{} degrees, {} and {}", name, half_width, method.inner, method.outer));
      const CollinearManipulator one = read_chapter_manipulator(name);
      const Manipulator manipulator = make_manipulator(one.design, one.lengths, name);
      const Interval range{-half_width * degree, half_width * degree};

      const std::unique_ptr<Solver> inner_optimizer = make_careful_solver(method.inner, settings.inner_move_limit);
      const std::unique_ptr<Solver> outer_optimizer = make_solver(method.outer);
      const std::unique_ptr<Solver> greatest =
          make_careful_solver(method.outer == bracketing ? method.inner : method.outer, settings.inner_move_limit);
      const ClosedFormOrientationSolver in_closed_form;
      const OptimizerOrientationSolver by_optimizer(*inner_optimizer);
      const BracketingPointSolver by_bracketing;
      const OptimizerPointSolver by_outer_optimizer(*outer_optimizer);
      const OrientationSolver& inner =
          method.inner == closed_form ? static_cast<const OrientationSolver&>(in_closed_form) : by_optimizer;
      const PointSolver& outer =
          method.outer == bracketing ? static_cast<const PointSolver&>(by_bracketing) : by_outer_optimizer;

      DextrousMap map;
      const std::vector<double> seconds = time_repeatedly(settings.repetitions, [&] {
        map = map_dextrous_workspace(manipulator, range, assembly_start(one), inner, *greatest,
                                     {.chord = settings.chord}, outer);
      });
      const Spread spread = spread_of(seconds);
      times.add_row(
          {name, half_width, method.inner, method.outer, seconds.size(), spread.lowest, spread.median, spread.highest});

      const Region exact = dextrous_workspace(manipulator, range);
      const double exact_area = area_around(exact, map.greatest.position);
      double farthest = 0.0;
      for (const DextrousBoundaryPoint& point : map.points) {
        farthest = std::max(farthest, exact.distance_to_boundary(point.position));
      }
      const bool closed = map.boundary.closed();
      const double area = signed_area(map.boundary.positions());
      const auto where_closed = [closed](double value) { return closed ? Field(value) : Field(); };
      table.add_row({name, half_width, method.inner, method.outer, map.points.size(),
                     count_kind(map.points, DextrousBoundaryPoint::Kind::type_i),
                     count_kind(map.points, DextrousBoundaryPoint::Kind::type_ii), map.boundary.evaluations,
                     map.inner_solutions, map.inner_evaluations, where_closed(area), exact_area,
                     where_closed(area - exact_area), farthest, map.greatest.position.x(), map.greatest.position.y(),
                     map.greatest.ends
                         ? Field((map.greatest.ends->interval.upper - map.greatest.ends->interval.lower) / degree)
                         : Field(),
                     to_string(map.boundary.status), map.boundary.message});
      fmt::print("{:<4} {:>5} {:<12} {:<11} {:>5} {:>11} {:>17} {:>10} {:>9.3f}  {}\n", name, half_width, method.inner,
                 method.outer, map.points.size(), map.boundary.evaluations, map.inner_evaluations,
                 closed ? fmt::format("{:.1e}", area - exact_area) : "-", spread.median,
                 to_string(map.boundary.status));
    }
    session.write(table);
    session.write(times, "times");
    session.constant("outward_turn_deg", outward_turn / degree);
    session.constant("dexterity_evaluations", dexterity_evaluations);
  });
}
