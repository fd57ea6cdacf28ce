#include "support/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace reprise::experiments {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

double relative_error(double f, double f_optimum) { return (f - f_optimum) / std::max(1.0, std::abs(f_optimum)); }

Verdict judge(const Result& result, double f_optimum, const Target& target) {
  const auto meets = [&](double f, double violation) {
    return relative_error(f, f_optimum) <= target.f_error && violation <= target.violation;
  };
  Verdict verdict;
  verdict.claimed = result.status == Status::converged;
  const auto pronounce = [&](bool solved, double f, double violation, const Counts& counts) {
    verdict.solved = solved;
    verdict.counts = counts;
    verdict.f = f;
    verdict.f_error = relative_error(f, f_optimum);
    verdict.violation = violation;
  };
  for (const Iterate& iterate : result.history) {
    if (!meets(iterate.f, iterate.violation)) continue;
    pronounce(true, iterate.f, iterate.violation, iterate.counts);
    return verdict;
  }
  pronounce(meets(result.f, result.violation), result.f, result.violation, result.counts);
  return verdict;
}

double cost_in_gradients(const Counts& counts, Eigen::Index n) {
  const auto size = static_cast<double>(n);
  return (static_cast<double>(counts.function_evaluations()) +
          size * static_cast<double>(counts.gradient_evaluations())) /
         (size + 1.0);
}

Table compute_profiles(const std::string& title,
                       const std::vector<std::pair<std::string, std::vector<RunCost>>>& panels,
                       const std::vector<std::string>& notes) {
  Table table(title + ", profiles",
              {{"panel", "-", "set of problems"},
               {"profile", "-", "data: against the cost; performance: against the cost over that of the best solver"},
               {"solver", "-", "name of the solver"},
               {"x", "-", "cost in gradient evaluations, or ratio of costs"},
               {"fraction", "-", "fraction of the problems of the panel that are solved up to here"}},
              notes);
  for (const auto& [panel, runs] : panels) {
    std::map<std::string, double> least;
    std::vector<std::string> solvers;
    for (const RunCost& run : runs) {
      const auto [entry, is_new] = least.try_emplace(run.problem, infinity);
      entry->second = std::min(entry->second, run.cost);
      if (std::find(solvers.begin(), solvers.end(), run.solver) == solvers.end()) solvers.push_back(run.solver);
    }
    for (const char* profile : {"data", "performance"}) {
      const bool relative = profile[0] == 'p';
      for (const std::string& solver : solvers) {
        std::vector<double> steps;
        for (const RunCost& run : runs) {
          if (run.solver != solver || !std::isfinite(run.cost)) continue;
          // A start that meets the target costs less than one gradient; the axis begins at 1.
          steps.push_back(std::max(1.0, relative ? run.cost / least[run.problem] : run.cost));
        }
        std::sort(steps.begin(), steps.end());
        const auto add = [&](double x) {
          const auto solved = std::upper_bound(steps.begin(), steps.end(), x) - steps.begin();
          table.add_row({panel, profile, solver, x, static_cast<double>(solved) / static_cast<double>(least.size())});
        };
        add(1.0);
        double last = 1.0;
        for (const double x : steps) {
          if (x > last) add(x);
          last = x;
        }
      }
    }
  }
  return table;
}

std::string line_style(const std::string& solver) {
  struct Style {
    const char* solver;
    const char* colour;
    int dash;
    double width;
  };
  constexpr Style styles[] = {
      {"dynamic_q", colour::vermilion, 3, 2.2},
      {"dynamic_q_dual", colour::vermilion, 2, 2.2},
      {"dynamic_q_safeguarded", colour::vermilion, 1, 3.0},
      {"slsqp", colour::blue, 1, 2.2},
      {"ccsaq", colour::sky, 1, 2.2},
      {"mma", colour::sky, 2, 2.2},
      {"ipopt_lbfgs", colour::black, 2, 2.2},
      {"ipopt", colour::black, 1, 2.2},
      {"cobyla", colour::green, 1, 2.2},
      {"isres", colour::orange, 1, 2.2},
  };
  const auto* found =
      std::find_if(std::begin(styles), std::end(styles), [&](const Style& style) { return solver == style.solver; });
  const Style style = found == std::end(styles) ? Style{"", colour::grey, 1, 2.2} : *found;
  return fmt::format("lc rgb '{}' dt {} lw {}", style.colour, style.dash, style.width);
}

Figure draw_profiles(const Table& profiles, const std::string& profile, double largest_x) {
  const Table chosen = profiles.where("profile", profile);
  const std::vector<std::string> panels = chosen.distinct("panel");
  constexpr double panel_width = 330.0, left = 84.0, gap = 44.0, key_width = 232.0;  // points
  const auto columns = static_cast<double>(panels.size());
  const double width = left + columns * panel_width + (columns - 1.0) * gap + key_width;
  Figure figure(static_cast<int>(width), 380);
  figure.add("set logscale x");
  figure.add(fmt::format("set xrange [1:{}]", largest_x));
  figure.add("set yrange [0:1]");
  figure.add("set ytics 0.2");
  figure.add("set format x '%g'");
  figure.add(profile == "data" ? "set xlabel 'cost in gradient evaluations'"
                               : "set xlabel 'cost over the least cost of any solver'");
  figure.add(fmt::format("set multiplot layout 1,{} margins {}, {}, 0.19, 0.9 spacing {}, 0", panels.size(),
                         left / width, 1.0 - key_width / width, gap / width));
  for (const std::string& panel : panels) {
    const Table rows = chosen.where("panel", panel);
    figure.add(fmt::format("set title {} offset 0,-0.4", gnuplot_string(panel)));
    figure.add(panel == panels.front() ? "set ylabel 'fraction of problems solved' offset 0.5,0"
                                       : "unset ylabel\nset format y ''");
    // One key for all panels, right of the last one.
    figure.add(panel == panels.back()
                   ? fmt::format("set key at screen {}, screen 0.9 left top Left reverse samplen 2.5 spacing 1.3 "
                                 "noenhanced",
                                 1.0 - (key_width - 12.0) / width)
                   : "unset key");
    std::string command = "plot ";
    for (const std::string& solver : rows.distinct("solver")) {
      const Table line = rows.where("solver", solver);
      std::vector<std::vector<double>> points;
      for (std::size_t row = 0; row < line.rows(); ++row) {
        points.push_back({line.number(row, "x"), line.number(row, "fraction")});
      }
      points.push_back({largest_x, points.back()[1]});
      command += fmt::format("{} using 1:2 with steps {} title {}, ", figure.add_data(points), line_style(solver),
                             gnuplot_string(solver));
    }
    command.resize(command.size() - 2);
    figure.add(command);
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace reprise::experiments
