// Every optimizer on every standard problem, from the same starts, judged alike from outside. Whether a run solves its
// problem is partly chance: a start moved by rounding can turn the answer. So each problem is also solved from starts
// that are moved by very little and by a little.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "comparison/judge.hpp"
#include "frame/experiment.hpp"
#include "frame/spread.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/standard_problems.hpp"
#include "reprise/study/solvers.hpp"

namespace reprise::experiments {
namespace {

constexpr const char* title = "Optimizers on the standard problems";

struct Settings {
  std::vector<std::string> solvers = solver_names();
  std::vector<std::string> problems{"all"};
  std::vector<double> targets{1e-3, 1e-5, 1e-7};
  double main_target = 1e-5;
  double violation = 1e-6;
  long max_evaluations = 20'000;
  std::vector<double> move_limits{0.05, 0.1, 0.2, 0.5, 1.0, 2.0};
  std::vector<double> moves{1e-12, 1e-2};
  long starts_per_move = 8;
  long evolution_starts_per_move = 1;  ///< for isres, whose searches take many evaluations
  long threads = 2;
  SolverSettings solver_settings;

  void declare(CommandLine& options) {
    std::vector<std::string> names{"all"};
    for (const StandardProblem& one : standard_problems()) names.push_back(one.problem.name);
    options.choices("--solver", solvers, solvers, "optimizers");
    options.choices("--problem", problems, names, "problems");
    options.numbers("--target", targets, NumberRange::positive(), "relative errors of the objective to be met");
    options.number("--main-target", main_target, NumberRange::positive(),
                   "the relative error behind the profiles, the tables of problems and of move limits");
    options.number("--violation", violation, NumberRange::positive(), "largest violation allowed");
    options.integer("--max-evaluations", max_evaluations, 1, 10'000'000, "limit on N_f of a run");
    options.numbers("--move-limits", move_limits, NumberRange::positive(), "rho in the study of the move limit");
    options.numbers("--moves", moves, NumberRange::positive(), "how far starts are moved, in units of max(1, |x_i|)");
    options.integer("--starts-per-move", starts_per_move, 1, 1000, "number of starts moved by each of these");
    options.integer("--evolution-starts-per-move", evolution_starts_per_move, 1, 1000, "the same for isres");
    options.integer("--threads", threads, 1, 256, "threads; the results do not depend on them");
    solver_settings.declare(options);
  }

  long moved_starts(const std::string& solver) const {
    return static_cast<long>(moves.size()) * (solver == "isres" ? evolution_starts_per_move : starts_per_move);
  }

  bool wants(const std::string& problem) const {
    const auto named = [&](const std::string& name) {
      return std::find(problems.begin(), problems.end(), name) != problems.end();
    };
    return named("all") || named(problem);
  }

  Options run_options() const {
    Options options;
    options.feasibility_tolerance = violation;
    options.max_function_evaluations = max_evaluations;
    return options;
  }
};

/// A run from a moved start. Starts of all sizes take turns: number k is moved by moves[k % moves.size()].
struct MovedRun {
  bool solved = false;
  double cost = infinity;  ///< until the main target was met
  bool skipped = false;    ///< not made, and taken for unsolved
};

/// A run that the solver does not take is none.
struct Run {
  const StandardProblem* standard = nullptr;
  std::string solver;
  std::optional<Result> result;
  std::vector<Judgement> judgements;  ///< one for each target
  Judgement main;
  std::vector<MovedRun> moved;
  double seconds = 0.0;
};

bool has_bounds(const Problem& problem) { return problem.lower.size() != 0 || problem.upper.size() != 0; }

/// What constrains a problem apart from its bounds.
std::string kind_of(const Problem& problem) {
  if (problem.inequality && problem.equality) return "both";
  if (problem.inequality) return "inequalities";
  return problem.equality ? "equalities" : "bounds";
}

bool is_limit(Status status) { return status == Status::iteration_limit || status == Status::evaluation_limit; }

/// From a moved start a run goes on only until it meets the main target. Where the runs from the printed start and from
/// one start of each size have all been ended unsolved by a limit, the others are taken for unsolved.
std::vector<MovedRun> run_moved(const StandardProblem& standard, const NamedSolver& named, const Settings& settings,
                                bool printed_start_at_limit) {
  const Target target{settings.main_target, settings.violation};
  Options options = settings.run_options();
  options.record_history = false;
  std::vector<MovedRun> moved(static_cast<std::size_t>(settings.moved_starts(named.name)));
  bool hopeless = printed_start_at_limit;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    if (hopeless && k >= settings.moves.size()) {
      moved[k].skipped = true;
      continue;
    }
    const Eigen::VectorXd start = moved_start(standard.start, settings.moves[k % settings.moves.size()], k);
    std::optional<Counts> counts;
    const auto look = [&](const Iterate& iterate) {
      if (!meets(iterate.f, iterate.violation, standard.f_optimum, target)) return true;
      counts = iterate.counts;
      return false;
    };
    const Result result = named.solver->minimize(standard.problem, start, options, look);
    if (!counts && meets(result.f, result.violation, standard.f_optimum, target)) counts = result.counts;
    moved[k].solved = counts.has_value();
    if (counts) moved[k].cost = cost_in_gradients(*counts, standard.problem.n);
    hopeless = hopeless && !moved[k].solved && is_limit(result.status);
  }
  return moved;
}

Run run_one(const StandardProblem& standard, const NamedSolver& named, const Settings& settings) {
  Run run;
  run.standard = &standard;
  run.solver = named.name;
  if (standard.problem.equalities > 0 && !named.solver->handles_equalities()) {
    run.moved.resize(static_cast<std::size_t>(settings.moved_starts(named.name)));
    return run;
  }
  const auto begin = std::chrono::steady_clock::now();
  run.result = named.solver->minimize(standard.problem, standard.start, settings.run_options());
  for (const double f_error : settings.targets) {
    run.judgements.push_back(judge(*run.result, standard.f_optimum, {f_error, settings.violation}));
  }
  run.main = judge(*run.result, standard.f_optimum, {settings.main_target, settings.violation});
  run.result->history.clear();
  run.moved = run_moved(standard, named, settings, !run.main.solved && is_limit(run.result->status));
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

/// One row for each solver and size of the moves: how many problems it solves from how many starts.
Table make_starts_table(const std::vector<Run>& runs, const std::vector<NamedSolver>& solvers,
                        const Settings& settings) {
  Table table(std::string(title) + ", by solver, from moved starts",
              {{"solver", "-", "name of the solver"},
               {"move", "-", "largest move of a coordinate over max(1, |x_i|) of the printed start; all: every size"},
               {"starts", "-", "number of starts of every problem"},
               {"printed", "-", "problems solved from the printed start"},
               {"median", "-", "problems solved: median over the moved starts"},
               {"lowest", "-", "lowest over the moved starts"},
               {"highest", "-", "highest over the moved starts"},
               {"skipped", "%",
                "runs not made, and taken for unsolved: the printed start and one of each size had been "
                "ended unsolved by a limit"}},
              {fmt::format("At the relative error {}.", settings.main_target)});
  for (const NamedSolver& named : solvers) {
    const auto add = [&](const std::string& label, std::size_t first, std::size_t stride) {
      const auto starts = static_cast<std::size_t>(settings.moved_starts(named.name));
      std::vector<double> solved;
      long printed = 0, skipped = 0, all = 0;
      for (const Run& run : runs) printed += run.solver == named.name && run.main.solved;
      for (std::size_t k = first; k < starts; k += stride) {
        long count = 0;
        for (const Run& run : runs) {
          if (run.solver != named.name) continue;
          count += run.moved[k].solved;
          skipped += run.moved[k].skipped;
          ++all;
        }
        solved.push_back(static_cast<double>(count));
      }
      const Spread spread = spread_of(solved);
      table.add_row({named.name, label, solved.size(), printed, spread.median, spread.lowest, spread.highest,
                     100.0 * static_cast<double>(skipped) / static_cast<double>(all)});
    };
    add("all", 0, 1);
    for (std::size_t m = 0; m < settings.moves.size(); ++m) {
      add(Field(settings.moves[m]).text(), m, settings.moves.size());
    }
  }
  return table;
}

Table make_runs_table(const std::vector<Run>& runs, const Settings& settings) {
  Table table(title,
              {{"problem", "-", "name of the problem"},
               {"solver", "-", "name of the solver"},
               {"target", "-", "largest relative error of the objective, (f - f*) / max(1, |f*|)"},
               {"solved", "-", "1 when a point of the run met the target, else 0"},
               {"N_g", "-", "gradient evaluations until then, or of the whole run"},
               {"N_f", "-", "function evaluations until then, or of the whole run, finite differences counted in"},
               {"f", "-", "objective of that point, or of the result"},
               {"f_error", "-", "its relative error; negative when it is lower than the known optimum"},
               {"violation", "-", "its largest violation of constraints and bounds"},
               {"status", "-", "what the solver says of its end; takes_no_equalities: it cannot take the problem"}},
              {fmt::format("The target also demands a violation of at most {}.", settings.violation)});
  for (const Run& run : runs) {
    for (std::size_t k = 0; k < settings.targets.size(); ++k) {
      const std::string& name = run.standard->problem.name;
      if (!run.result) {
        table.add_row({name, run.solver, settings.targets[k], 0, 0, 0, {}, {}, {}, "takes_no_equalities"});
        continue;
      }
      const Judgement& judgement = run.judgements[k];
      table.add_row({name, run.solver, settings.targets[k], static_cast<int>(judgement.solved),
                     judgement.counts.gradient_evaluations(), judgement.counts.function_evaluations(), judgement.f,
                     judgement.f_error, judgement.violation, to_string(run.result->status)});
    }
  }
  return table;
}

double cost_of(const Run& run, const Judgement& judgement) {
  return judgement.solved ? cost_in_gradients(judgement.counts, run.standard->problem.n) : infinity;
}

double cost_of(const Run& run) { return cost_of(run, run.main); }

Field median(const std::vector<double>& values) { return values.empty() ? Field() : Field(spread_of(values).median); }

/// One row for each solver and target: how many problems it solves, how often it is wrong about it, and at what cost.
Table make_solvers_table(const std::vector<Run>& runs, const std::vector<NamedSolver>& solvers,
                         const Settings& settings) {
  Table table(std::string(title) + ", by solver",
              {{"solver", "-", "name of the solver"},
               {"description", "-", "what it is"},
               {"target", "-", "largest relative error of the objective"},
               {"problems", "-", "number of problems"},
               {"taken", "-", "problems that the solver can take"},
               {"solved", "-", "problems solved"},
               {"percent", "%", "solved over all problems"},
               {"percent_of_taken", "%", "solved over those taken"},
               {"claimed", "-", "runs of which the solver says that they converged"},
               {"false_successes", "-", "runs among them of which no point meets the target"},
               {"unclaimed", "-", "problems solved of which the solver does not say that it converged"},
               {"cheapest", "-", "problems solved at a lower cost than by any other solver; Hessians are not counted"},
               {"median_ratio", "-", "median of the cost over the least cost of any solver, of the problems solved"}});
  for (std::size_t k = 0; k < settings.targets.size(); ++k) {
    // The least cost of each problem, and how many solvers have it.
    std::map<std::string, std::pair<double, int>> least;
    for (const Run& run : runs) {
      if (!run.result || !run.judgements[k].solved) continue;
      auto& [cost, solvers_at_it] = least.try_emplace(run.standard->problem.name, infinity, 0).first->second;
      const double mine = cost_of(run, run.judgements[k]);
      solvers_at_it = mine < cost ? 1 : solvers_at_it + (mine == cost ? 1 : 0);
      cost = std::min(cost, mine);
    }
    for (const NamedSolver& named : solvers) {
      int all = 0, taken = 0, solved = 0, claimed = 0, false_successes = 0, unclaimed = 0, cheapest = 0;
      std::vector<double> ratios;
      for (const Run& run : runs) {
        if (run.solver != named.name) continue;
        ++all;
        if (!run.result) continue;
        const Judgement& judgement = run.judgements[k];
        ++taken;
        claimed += judgement.claimed;
        false_successes += judgement.false_success();
        if (!judgement.solved) continue;
        ++solved;
        unclaimed += !judgement.claimed;
        const auto& [least_cost, solvers_at_it] = least[run.standard->problem.name];
        const double cost = cost_of(run, judgement);
        cheapest += cost == least_cost && solvers_at_it == 1;
        ratios.push_back(cost / least_cost);
      }
      table.add_row({named.name, named.description, settings.targets[k], all, taken, solved, 100.0 * solved / all,
                     taken > 0 ? Field(100.0 * solved / taken) : Field(), claimed, false_successes, unclaimed, cheapest,
                     median(ratios)});
    }
  }
  return table;
}

/// Problems solved by each solver, kind by kind; the first row counts the problems.
Table make_kinds_table(const std::vector<Run>& runs, const std::vector<NamedSolver>& solvers) {
  const std::vector<std::string> kinds{"bounds", "inequalities", "equalities", "both"};
  Table table(std::string(title) + ", by kind of constraint",
              {{"solver", "-", "name of the solver; `problems`: their number"},
               {"bounds", "-", "problems with bounds or nothing"},
               {"inequalities", "-", "problems with inequalities, and bounds or not"},
               {"equalities", "-", "problems with equalities, and bounds or not"},
               {"both", "-", "problems with inequalities and equalities, and bounds or not"},
               {"small", "-", "problems with at most 4 variables"},
               {"large", "-", "problems with 5 variables and more"}});
  const auto add = [&](const std::string& label, const std::string& solver, bool solved_only) {
    std::vector<Field> row{label};
    const auto count = [&](auto belongs) {
      row.emplace_back(std::count_if(runs.begin(), runs.end(), [&](const Run& run) {
        return run.solver == solver && belongs(run.standard->problem) && (!solved_only || run.main.solved);
      }));
    };
    for (const std::string& kind : kinds) count([&](const Problem& problem) { return kind_of(problem) == kind; });
    constexpr Eigen::Index largest_small = 4;
    count([](const Problem& problem) { return problem.n <= largest_small; });
    count([](const Problem& problem) { return problem.n > largest_small; });
    table.add_row(row);
  };
  add("problems", solvers.front().name, false);
  for (const NamedSolver& named : solvers) add(named.name, named.name, true);
  return table;
}

/// One row for each problem: what it is, who solves it, and at what cost.
Table make_problems_table(const std::vector<Run>& runs, const std::vector<StandardProblem>& problems,
                          const std::vector<NamedSolver>& solvers) {
  std::vector<Column> columns{{"problem", "-", "name of the problem"},
                              {"n", "-", "number of variables"},
                              {"inequalities", "-", "number of inequalities"},
                              {"equalities", "-", "number of equalities"},
                              {"bounds", "-", "1 when there are bounds, else 0"},
                              {"f_optimum", "-", "known optimum f*"},
                              {"solved_by", "-", "number of solvers that solve it"},
                              {"cheapest", "-", "the solver that does so at the least cost"}};
  for (const NamedSolver& named : solvers) {
    columns.push_back(
        {"cost_" + named.name, "-",
         "cost of " + named.name + " in gradient evaluations; empty where it does not solve the problem"});
  }
  columns.push_back({"remark", "-", "what is to be known about the problem"});
  Table table(std::string(title) + ", by problem", columns);
  for (const StandardProblem& standard : problems) {
    const Problem& problem = standard.problem;
    std::vector<Field> costs;
    int solved_by = 0;
    double least = infinity;
    std::string cheapest;
    for (const Run& run : runs) {
      if (run.standard != &standard) continue;
      const double cost = cost_of(run);
      costs.push_back(std::isfinite(cost) ? Field(cost) : Field());
      solved_by += run.main.solved;
      if (cost < least) {
        least = cost;
        cheapest = run.solver;
      }
    }
    std::vector<Field> row{problem.name,
                           problem.n,
                           problem.inequalities,
                           problem.equalities,
                           static_cast<int>(has_bounds(problem)),
                           standard.f_optimum,
                           solved_by,
                           cheapest};
    row.insert(row.end(), costs.begin(), costs.end());
    row.emplace_back(standard.remark);
    table.add_row(row);
  }
  return table;
}

/// Why a solver does not solve what it does not solve: Ipopt goes on from where it ended.
Table make_unsolved_table(const std::vector<Run>& runs, const Settings& settings) {
  Table table(std::string(title) + ", unsolved by dynamic_q_safeguarded",
              {{"problem", "-", "name of the problem"},
               {"f", "-", "objective of the result"},
               {"f_optimum", "-", "known optimum f*"},
               {"violation", "-", "largest violation of the result"},
               {"N_g", "-", "gradient evaluations"},
               {"status", "-", "what the solver says of its end"},
               {"f_restart", "-", "objective that Ipopt reaches from there; empty where it is not feasible"},
               {"reason", "-", "what follows from it: where the solver has ended"},
               {"remark", "-", "what is to be known about the problem"}});
  for (const Run& run : runs) {
    if (run.solver != "dynamic_q_safeguarded" || !run.result || run.main.solved) continue;
    const StandardProblem& standard = *run.standard;
    const Result restart = IpoptSolver().minimize(standard.problem, run.result->x, settings.run_options());
    const bool feasible = restart.violation <= settings.violation;
    // Lower by this is better.
    constexpr double clearly = 1e-3;
    std::string reason = "on the way";
    if (run.main.violation > settings.violation) {
      reason = "no feasible point";
    } else if (feasible && relative_error(restart.f, standard.f_optimum) > settings.main_target &&
               relative_error(restart.f, run.main.f) > -clearly) {
      reason = "stationary point";
    }
    table.add_row({standard.problem.name, run.main.f, standard.f_optimum, run.main.violation,
                   run.main.counts.gradient_evaluations(), to_string(run.result->status),
                   feasible ? Field(restart.f) : Field(), reason, standard.remark});
  }
  return table;
}

std::vector<std::pair<std::string, std::vector<RunCost>>> profile_panels(const std::vector<Run>& runs) {
  std::vector<RunCost> all, without_equalities;
  for (const Run& run : runs) {
    for (std::size_t k = 0; k < run.moved.size(); ++k) {
      const RunCost cost{run.standard->problem.name, run.solver, run.moved[k].cost, static_cast<int>(k)};
      all.push_back(cost);
      if (run.standard->problem.equalities == 0) without_equalities.push_back(cost);
    }
  }
  std::vector<std::pair<std::string, std::vector<RunCost>>> panels{{"(a) all problems", all}};
  if (!without_equalities.empty()) panels.emplace_back("(b) without equalities", without_equalities);
  return panels;
}

/// How rho is measured in the study of the move limit.
struct Variant {
  std::string name;
  std::string description;
  bool relative;  ///< rho is in units of max(1, |x0|)
  bool scaled;    ///< every variable is in units of max(1, |x0_i|)
  bool safeguarded;
};

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all{{"fixed", "rho in the unit of x", false, false, false},
                                        {"relative", "rho in units of max(1, |x^0|)", true, false, false},
                                        {"scaled", "every variable in units of max(1, |x_i^0|)", false, true, false},
                                        {"safeguarded", "the same with guarded steps", false, true, true}};
  return all;
}

Table study_move_limit(const std::vector<StandardProblem>& problems, const Settings& settings, Progress& progress) {
  Table table(std::string(title) + ", move limit of Dynamic-Q",
              {{"variant", "-", "how rho is measured; approximations are minimised exactly throughout"},
               {"description", "-", "what that means"},
               {"move_limit", "-", "rho"},
               {"solved", "-", "problems solved"},
               {"percent", "%", "solved over all problems"},
               {"N_g", "-", "gradient evaluations of all runs together, until a problem was solved or the run ended"}});
  for (const Variant& variant : variants()) {
    for (const double move_limit : settings.move_limits) {
      progress.begin(fmt::format("move limit {} {}", variant.name, move_limit));
      std::vector<Judgement> judgements(problems.size());
      in_threads(problems.size(), settings.threads, [&](std::size_t k) {
        const StandardProblem& standard = problems[k];
        DynamicQOptions options;
        options.subproblem = SubproblemSolver::dual;
        options.max_iterations = settings.solver_settings.max_iterations;
        options.move_limit = move_limit * (variant.relative ? std::max(1.0, standard.start.norm()) : 1.0);
        options.scale_variables = variant.scaled;
        options.safeguard.active = variant.safeguarded;
        const Result result = DynamicQ(options).minimize(standard.problem, standard.start, settings.run_options());
        judgements[k] = judge(result, standard.f_optimum, {settings.main_target, settings.violation});
      });
      long solved = 0, gradients = 0;
      for (const Judgement& judgement : judgements) {
        solved += judgement.solved;
        gradients += judgement.counts.gradient_evaluations();
      }
      table.add_row({variant.name, variant.description, move_limit, solved,
                     100.0 * static_cast<double>(solved) / static_cast<double>(problems.size()), gradients});
    }
  }
  return table;
}

Figure draw_move_limit(const Table& table) {
  Figure figure(760, 360);
  const char* colours[] = {colour::grey, colour::sky, colour::blue, colour::vermilion};
  figure.add("set logscale x");
  figure.add("set xlabel 'move limit ρ'");
  figure.add("set ylabel 'problems solved [%]'");
  figure.add("set yrange [60:100]");
  const std::vector<double> limits = table.numbers("move_limit");
  const auto [least, most] = std::minmax_element(limits.begin(), limits.end());
  figure.add(fmt::format("set xrange [{}:{}]", 0.8 * *least, 1.25 * *most));
  figure.add("set key inside bottom right vertical Left reverse samplen 2.5 spacing 1.25 noenhanced");
  std::string command = "plot ";
  std::size_t number = 0;
  for (const std::string& variant : table.distinct("variant")) {
    const Table rows = table.where("variant", variant);
    std::vector<std::vector<double>> points;
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      points.push_back({rows.number(row, "move_limit"), rows.number(row, "percent")});
    }
    command += fmt::format("{} using 1:2 with linespoints lc rgb '{}' lw 2.2 pt 7 ps 0.6 title {}, ",
                           figure.add_data(points), colours[number++ % 4], gnuplot_string(variant));
  }
  command.resize(command.size() - 2);
  figure.add(command);
  return figure;
}

std::string summarise(const Table& solvers) {
  std::string text = fmt::format("{:<22} {:>8} {:>8} {:>6} {:>8} {:>16}\n", "solver", "target", "solved", "of",
                                 "claimed", "false successes");
  for (std::size_t row = 0; row < solvers.rows(); ++row) {
    text += fmt::format("{:<22} {:>8} {:>8} {:>6} {:>8} {:>16}\n", solvers.text(row, "solver"),
                        solvers.text(row, "target"), solvers.text(row, "solved"), solvers.text(row, "taken"),
                        solvers.text(row, "claimed"), solvers.text(row, "false_successes"));
  }
  return text;
}

}  // namespace
}  // namespace reprise::experiments

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;
  using reprise::StandardProblem;

  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  settings.declare(experiment.options());

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        std::vector<StandardProblem> problems;
        for (StandardProblem& one : reprise::standard_problems()) {
          if (settings.wants(one.problem.name)) problems.push_back(std::move(one));
        }
        if (session.quick()) {
          std::vector<StandardProblem> few;
          for (std::size_t k = 0; k < problems.size(); k += 8) few.push_back(std::move(problems[k]));
          problems = std::move(few);
          settings.max_evaluations = std::min(settings.max_evaluations, 2000L);
          settings.move_limits.resize(std::min<std::size_t>(settings.move_limits.size(), 2));
          settings.starts_per_move = 1;
        }
        settings.solver_settings.max_points = settings.max_evaluations;
        const std::vector<NamedSolver> solvers = select_solvers(settings.solvers, settings.solver_settings);

        Progress progress(problems.size() * solvers.size() + variants().size() * settings.move_limits.size());
        std::vector<Run> runs(problems.size() * solvers.size());
        std::mutex mutex;
        in_threads(runs.size(), settings.threads, [&](std::size_t k) {
          const StandardProblem& standard = problems[k / solvers.size()];
          const NamedSolver& named = solvers[k % solvers.size()];
          {
            const std::lock_guard lock(mutex);
            progress.begin(standard.problem.name + " " + named.name);
          }
          runs[k] = run_one(standard, named, settings);
        });
        std::map<std::string, double> seconds;
        for (const Run& run : runs) seconds[run.solver] += run.seconds;
        const Table by_solver = make_solvers_table(runs, solvers, settings);
        session.write(make_runs_table(runs, settings));
        session.write(by_solver, "solvers");
        session.write(make_starts_table(runs, solvers, settings), "starts");
        session.write(make_kinds_table(runs, solvers), "kinds");
        session.write(make_problems_table(runs, problems, solvers), "problems");
        session.write(make_unsolved_table(runs, settings), "unsolved");
        session.write(
            compute_profiles(title, profile_panels(runs),
                             {fmt::format("At the relative error {}, from the moved starts.", settings.main_target)}),
            "profiles");
        session.write(study_move_limit(problems, settings, progress), "move_limit");
        session.constant("merit_memory", SafeguardOptions().memory);
        for (const auto& [solver, time] : seconds) session.record(solver, time);
        fmt::print("{}", summarise(by_solver));
      },
      [](Session& session) {
        const Table profiles = session.table("profiles");
        session.draw(draw_profiles(profiles, "data", 2e4), "data_profiles");
        session.draw(draw_profiles(profiles, "performance", 1e3), "performance_profiles");
        session.draw(draw_move_limit(session.table("move_limit")), "move_limit");
      });
}
