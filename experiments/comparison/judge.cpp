#include "comparison/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "frame/shown_name.hpp"
#include "frame/spread.hpp"
#include "reprise/base/constants.hpp"

namespace reprise::experiments {

double relative_error(double f, double f_optimum) { return (f - f_optimum) / std::max(1.0, std::abs(f_optimum)); }

bool meets(double f, double violation, double f_optimum, const Target& target) {
  return relative_error(f, f_optimum) <= target.f_error && violation <= target.violation;
}

Judgement judge(const Result& result, double f_optimum, const Target& target) {
  Judgement judgement;
  judgement.claimed = result.status == Status::converged;
  const auto pronounce = [&](bool solved, double f, double violation, const Counts& counts) {
    judgement.solved = solved;
    judgement.counts = counts;
    judgement.f = f;
    judgement.f_error = relative_error(f, f_optimum);
    judgement.violation = violation;
  };
  for (const Iterate& iterate : result.history) {
    if (!meets(iterate.f, iterate.violation, f_optimum, target)) continue;
    pronounce(true, iterate.f, iterate.violation, iterate.counts);
    return judgement;
  }
  pronounce(meets(result.f, result.violation, f_optimum, target), result.f, result.violation, result.counts);
  return judgement;
}

double cost_in_gradients(const Counts& counts, Eigen::Index n) {
  const auto size = static_cast<double>(n);
  return (static_cast<double>(counts.function_evaluations()) +
          size * static_cast<double>(counts.gradient_evaluations())) /
         (size + 1.0);
}

Eigen::VectorXd moved_start(const Eigen::VectorXd& start, double size, std::uint64_t seed) {
  std::uint64_t state = seed;
  const auto next = [&state] {
    state += 0x9e3779b97f4a7c15U;
    std::uint64_t bits = state;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebU;
    bits ^= bits >> 31;
    return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
  };
  Eigen::VectorXd moved = start;
  for (double& x : moved) x += size * std::max(1.0, std::abs(x)) * next();
  return moved;
}

Table compute_profiles(const std::string& title,
                       const std::vector<std::pair<std::string, std::vector<RunCost>>>& panels,
                       const std::vector<std::string>& notes) {
  Table table(title + ", profiles",
              {{"panel", "-", "set of problems"},
               {"profile", "-", "data: against the cost; performance: against the cost over that of the best solver"},
               {"solver", "-", "name of the solver"},
               {"x", "-", "cost in gradient evaluations, or ratio of costs"},
               {"fraction", "-", "fraction of the panel's problems that are solved up to here: median over the starts"},
               {"lowest", "-", "the lowest over the starts"},
               {"highest", "-", "the highest over the starts"}},
              notes);
  for (const auto& [panel, runs] : panels) {
    std::map<std::pair<std::string, int>, double> least;
    std::set<std::string> problems;
    std::vector<std::string> solvers;
    for (const RunCost& run : runs) {
      problems.insert(run.problem);
      const auto [entry, is_new] = least.try_emplace({run.problem, run.start}, infinity);
      entry->second = std::min(entry->second, run.cost);
      if (std::find(solvers.begin(), solvers.end(), run.solver) == solvers.end()) solvers.push_back(run.solver);
    }
    for (const char* profile : {"data", "performance"}) {
      const bool relative = profile[0] == 'p';
      for (const std::string& solver : solvers) {
        std::map<int, std::vector<double>> steps_from;
        std::set<double> all_steps{1.0};
        for (const RunCost& run : runs) {
          if (run.solver != solver) continue;
          std::vector<double>& steps = steps_from[run.start];
          if (!std::isfinite(run.cost)) continue;
          // A start that meets the target costs less than one gradient; the axis begins at 1.
          steps.push_back(std::max(1.0, relative ? run.cost / least[{run.problem, run.start}] : run.cost));
          all_steps.insert(steps.back());
        }
        for (auto& [start, steps] : steps_from) std::sort(steps.begin(), steps.end());
        Spread last{-1.0, -1.0, -1.0};
        for (const double x : all_steps) {
          std::vector<double> fractions;
          for (const auto& [start, steps] : steps_from) {
            const auto solved = std::upper_bound(steps.begin(), steps.end(), x) - steps.begin();
            fractions.push_back(static_cast<double>(solved) / static_cast<double>(problems.size()));
          }
          const Spread now = spread_of(fractions);
          if (now.median == last.median && now.lowest == last.lowest && now.highest == last.highest) continue;
          table.add_row({panel, profile, solver, x, now.median, now.lowest, now.highest});
          last = now;
        }
      }
    }
  }
  return table;
}

namespace {

struct Style {
  const char* solver;
  const char* colour;
  int dash;
  double width;
};

Style style_of(const std::string& solver) {
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
  return found == std::end(styles) ? Style{"", colour::grey, 1, 2.2} : *found;
}

}  // namespace

std::string line_style(const std::string& solver) {
  const Style style = style_of(solver);
  return fmt::format("lc rgb '{}' dt {} lw {}", style.colour, style.dash, style.width);
}

Figure draw_profiles(const Table& profiles, const std::string& profile, double largest_x) {
  const Table chosen = profiles.where("profile", profile);
  const std::vector<std::string> panels = chosen.distinct("panel");
  constexpr double panel_width = 300.0, left = 84.0, gap = 44.0, key_width = 252.0;  // points
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
    std::string bands = "plot ";
    std::string lines;
    for (const std::string& solver : rows.distinct("solver")) {
      const Table line = rows.where("solver", solver);
      std::vector<std::vector<double>> points, corners;
      for (std::size_t row = 0; row < line.rows(); ++row) {
        const double x = line.number(row, "x");
        points.push_back({x, line.number(row, "fraction")});
        if (row > 0) corners.push_back({x, corners.back()[1], corners.back()[2]});
        corners.push_back({x, line.number(row, "lowest"), line.number(row, "highest")});
      }
      points.push_back({largest_x, points.back()[1]});
      corners.push_back({largest_x, corners.back()[1], corners.back()[2]});
      bands += fmt::format("{} using 1:2:3 with filledcurves fs transparent solid 0.15 noborder fc rgb '{}' notitle, ",
                           figure.add_data(corners), style_of(solver).colour);
      lines += fmt::format("{} using 1:2 with steps {} title {}, ", figure.add_data(points), line_style(solver),
                           gnuplot_string(shown_name(solver)));
    }
    std::string command = bands + lines;
    command.resize(command.size() - 2);
    figure.add(command);
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace reprise::experiments
