// How good are the designs of Tables 5.3 to 5.5? The best design for each of the nine synthesis problems, searched for
// from many starts and certified, and every design of the tables judged by the same certificates.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/random/sobol.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "chapter/problems.hpp"
#include "chapter/stored_synthesis.hpp"
#include "frame/experiment.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/bounds/enclosure.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/synthesis/optimality_certificate.hpp"
#include "reprise/synthesis/semi_infinite.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

struct Settings {
  long starts = 24;
  long general_starts = 2;
  long sample_points = 80;
  long points = 100;
  long refinement = 60;
  double smallest_r = 0.1;
  double largest_r = 2.0;
};

/// Optima closer than this in t and in every variable are one.
constexpr double same_value = 1e-7;
constexpr double same_design = 1e-3;

/// Runs that end this far below the best are poor local optima; they are listed as they are.
constexpr double worth_refining = 0.03;

/// The length limits of legs 1, 2, 3.
using Lengths = std::array<Interval, 3>;

/// One problem of the chapter.
struct Study {
  std::string table;
  std::string workspace;
  SynthesisTask task;
};

/// The chapter's designs with r in a range, of either sign. Every design that reaches O' at phi = 0 has its base joints
/// within the longest leg of the platform's joints there; so of those with r in its range none is left out.
DesignSpace boxed_designs(const Lengths& lengths, const Eigen::Vector2d& centre, const Interval& r) {
  const DesignSpace free = DesignSpace::collinear(lengths);
  const double height = std::min({lengths[0].upper, lengths[1].upper, lengths[2].upper});
  Eigen::VectorXd lower(5);
  Eigen::VectorXd upper(5);
  lower << centre.x() - r.upper - lengths[0].upper, centre.y() - height, centre.x() - r.upper - lengths[1].upper,
      centre.x() + r.lower - lengths[2].upper, r.lower;
  upper << centre.x() - r.lower + lengths[0].upper, centre.y() + height, centre.x() - r.lower + lengths[1].upper,
      centre.x() + r.upper + lengths[2].upper, r.upper;
  return {free.manipulator(Eigen::VectorXd::Zero(5)), free.names(), free.joint_map(), free.length_map(), lower, upper};
}

Study make_study(const ChapterSynthesis& synthesis, const ChapterSynthesis& size, const std::string& workspace,
                 const Lengths& lengths) {
  return {synthesis.table,
          workspace,
          {read_chapter_problem(size, workspace).task.prescribed, read_orientations(synthesis),
           DesignSpace::collinear(lengths), printed_conditioning}};
}

/// Points of Sobol's sequence in the unit cube, its first one (the origin) left out.
std::vector<Eigen::VectorXd> sobol_points(long count, Eigen::Index dimension) {
  boost::random::sobol sequence(static_cast<std::size_t>(dimension));
  sequence.discard(static_cast<boost::uintmax_t>(dimension));
  std::vector<Eigen::VectorXd> points(static_cast<std::size_t>(count), Eigen::VectorXd(dimension));
  for (Eigen::VectorXd& point : points) {
    for (double& entry : point) entry = std::ldexp(static_cast<double>(sequence()), -64);
  }
  return points;
}

/// Starts: r in its range, each base joint at the platform joint it belongs to at O', within the longest leg.
std::vector<Eigen::VectorXd> make_starts(const SynthesisTask& boxed, const Lengths& lengths, long count) {
  const Eigen::Vector2d centre = boxed.prescribed.centre();
  const Eigen::VectorXd& lower = boxed.designs.lower();
  const Eigen::VectorXd& upper = boxed.designs.upper();
  std::vector<Eigen::VectorXd> starts;
  for (const Eigen::VectorXd& point : sobol_points(count, 5)) {
    const Eigen::VectorXd spread = 2.0 * point.array() - 1.0;
    const double r = lower[4] + point[4] * (upper[4] - lower[4]);
    Eigen::VectorXd start(5);
    start << centre.x() - r + spread[0] * lengths[0].upper, lower[1] + point[1] * (upper[1] - lower[1]),
        centre.x() - r + spread[2] * lengths[1].upper, centre.x() + r + spread[3] * lengths[2].upper, r;
    starts.push_back(start);
  }
  return starts;
}

/// Ipopt, accurate to the exchange's tolerance, and so that it keeps to its start: optima lie close to each other.
IpoptSolver make_ipopt() {
  IpoptOptions options;
  options.tolerance = 1e-11;
  options.acceptable_tolerance = 1e-9;
  options.initial_barrier = 1e-8;
  options.initial_push = 1e-8;
  options.max_iterations = 200;
  return IpoptSolver(options);
}

/// A local optimum and how many starts came to it.
struct LocalOptimum {
  Eigen::VectorXd sampled;  ///< design of the first run, on the sample
  Eigen::VectorXd design;   ///< refined, where it is worth it
  double t;                 ///< smallest kappa^-1
  bool refined;
  long starts;
};

struct Search {
  std::vector<LocalOptimum> optima;  ///< from the best on
  long starts = 0;
  long failed = 0;  ///< runs that did not converge to a design that is feasible on the sample
};

/// Legs 1 and 2 are alike: a design with C and D exchanged is the same manipulator.
Eigen::VectorXd in_order(Eigen::VectorXd design) {
  if (design.size() == 5 && design[0] > design[2]) std::swap(design[0], design[2]);
  return design;
}

/// From the best on; poor ones last.
void sort_optima(Search& search) {
  std::stable_sort(search.optima.begin(), search.optima.end(), [](const LocalOptimum& a, const LocalOptimum& b) {
    return a.refined != b.refined ? a.refined : a.t > b.t;
  });
}

/// SLSQP from all starts on a sample of the outline, then exchange and Newton's method from the good ends.
Search search_globally(const SynthesisTask& task, const std::vector<Eigen::VectorXd>& starts,
                       const Settings& settings) {
  const PointwiseOptions sample{static_cast<int>(settings.sample_points)};
  const Problem problem = pointwise_problem(task, sample);
  const ConstraintExchange slsqp(std::make_shared<NloptSolver>());
  Options options;
  options.feasibility_tolerance = 1e-7;
  options.max_function_evaluations = 3000;
  options.record_history = false;
  std::vector<Result> results(starts.size());
  in_threads(starts.size(), std::max(1U, std::thread::hardware_concurrency()), [&](std::size_t i) {
    results[i] = slsqp.minimize(problem, pointwise_start(task, starts[i], sample), options);
  });

  Search search;
  search.starts = static_cast<long>(starts.size());
  std::vector<LocalOptimum> sampled;
  double best = 0.0;
  const auto join = [](std::vector<LocalOptimum>& optima, LocalOptimum one, double value_tolerance,
                       double design_tolerance) {
    for (LocalOptimum& known : optima) {
      if (std::abs(known.t - one.t) < value_tolerance &&
          (known.design - one.design).cwiseAbs().maxCoeff() < design_tolerance) {
        known.starts += one.starts;
        return;
      }
    }
    optima.push_back(std::move(one));
  };
  for (const Result& result : results) {
    if (result.status != Status::converged) {
      ++search.failed;
      continue;
    }
    const Eigen::VectorXd design = in_order(result.x.head(task.designs.size()));
    join(sampled, {design, design, -result.f, false, 1}, 1e-5, 1e-2);
    best = std::max(best, -result.f);
  }
  const IpoptSolver ipopt = make_ipopt();
  for (LocalOptimum one : sampled) {
    if (one.t > best - worth_refining) {
      const SemiInfiniteResult exchanged = solve_by_exchange(task, one.sampled, ipopt, {.max_rounds = 10});
      one.design = in_order(refine_optimum(task, exchanged.design).design);
      one.refined = true;
    }
    one.t = assess_outline(task, one.design).kappa_inverse;
    join(search.optima, one, one.refined ? same_value : 1e-5, one.refined ? same_design : 1e-2);
  }
  sort_optima(search);
  return search;
}

/// Both signs of r, each from as many starts.
Search search_both_sides(const SynthesisTask& task, const Lengths& lengths, const Settings& settings) {
  Search both;
  for (const Interval& r :
       {Interval{settings.smallest_r, settings.largest_r}, Interval{-settings.largest_r, -settings.smallest_r}}) {
    SynthesisTask boxed = task;
    boxed.designs = boxed_designs(lengths, task.prescribed.centre(), r);
    const Search side = search_globally(boxed, make_starts(boxed, lengths, settings.starts), settings);
    both.starts += side.starts;
    both.failed += side.failed;
    both.optima.insert(both.optima.end(), side.optima.begin(), side.optima.end());
  }
  sort_optima(both);
  return both;
}

/// The best of the refined optima that is certified to be one; of those that are alike to rounding, one with the
/// platform as the chapter has it, r > 0, and of these the lower base.
const LocalOptimum& best_of(const SynthesisTask& task, const Search& search) {
  const LocalOptimum* best = nullptr;
  for (const LocalOptimum& one : search.optima) {
    if (!one.refined || assess_outline(task, one.design).violation > 1e-9) continue;
    const auto turned = [](const LocalOptimum& of) { return of.design.size() == 5 && of.design[4] < 0.0; };
    const auto preferred = [&](const LocalOptimum& to) {
      return turned(one) != turned(to) ? turned(to) : one.design[1] < to.design[1];
    };
    if (!best || one.t > best->t + 1e-10 || (one.t > best->t - 1e-10 && preferred(*best))) best = &one;
  }
  if (!best) throw std::runtime_error("No start came to a feasible design.");
  return *best;
}

/// Both ways to the optimum, from the same start.
struct Agreement {
  SemiInfiniteResult exchange;
  SemiInfiniteResult discretised;
};

struct Judged {
  OptimalityCertificate certificate;
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double overreach = 0.0;   ///< no limit is violated by more than this, proved
  double throughout = 0.0;  ///< the same at every orientation from the lowest to the highest
  long evaluations = 0;
};

/// All certificates of a design, over the whole prescribed region and range.
Judged judge(const SynthesisTask& task, const Eigen::VectorXd& design) {
  Judged judged{certify_optimality(task, design)};
  const Manipulator manipulator = task.designs.manipulator(design);
  const auto overreach = [&](const Interval& range) {
    const Containment containment =
        prove_containment(manipulator, task.prescribed, range, 0.0, {.tolerance = 1e-9, .max_evaluations = 100'000});
    judged.evaluations += containment.evaluations;
    return std::max(0.0, -containment.limits[containment.tightest].margin.lower);
  };
  for (const OrientationRange& range : task.orientations) {
    const MinimumEnclosure minimum =
        enclose_minimum(manipulator, task.prescribed, range, task.conditioning, {.tolerance = 1e-6});
    judged.lower = std::min(judged.lower, minimum.lower);
    judged.upper = std::min(judged.upper, minimum.upper);
    judged.evaluations += minimum.evaluations;
    judged.overreach = std::max(judged.overreach, overreach(range));
  }
  const bool several = task.orientations.size() > 1;
  judged.throughout =
      several ? overreach({task.orientations.front().lower, task.orientations.back().upper}) : judged.overreach;
  return judged;
}

const std::vector<Column> design_columns{{"x_C", "length", "x coordinate of base joint C"},
                                         {"y_C", "length", "y coordinate of the base joints"},
                                         {"x_D", "length", "x coordinate of base joint D"},
                                         {"x_E", "length", "x coordinate of base joint E"},
                                         {"r", "length", "half the length of the platform"}};

std::vector<Column> with_design(std::vector<Column> columns, const std::vector<Column>& more = {}) {
  columns.insert(columns.end(), design_columns.begin(), design_columns.end());
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

const Column table_column{"table", "-", "table of the chapter that the problem belongs to"};
const Column workspace_column{"workspace", "-", "prescribed workspace (reconstructed, not published)"};

struct Tables {
  Table designs{"The reference optimum, and how far every design of Tables 5.3 to 5.5 is from it",
                with_design({table_column,
                             workspace_column,
                             {"source", "-",
                              "published, published_corrected (P1 of Table 5.3 with y_C = 0.2617), the "
                              "optimizer, or reference"},
                             {"formulation", "-", "what the optimizer solved; empty for published designs"},
                             {"f", "-", "smallest inverse condition number along the outline, at slices or range ends"},
                             {"gap", "-", "f of the reference less f; negative designs violate limits"},
                             {"kkt_residual", "-", "distance from the conditions of Karush, Kuhn and Tucker"},
                             {"violation", "length", "largest violation of a leg's limit along the outline"}},
                            {{"active", "-", "constraints that are active, along the whole outline"},
                             {"tangent_dimension", "-", "dimension of the tangent space of the active constraints"},
                             {"smallest_curvature", "-", "of the Lagrangian there; inf where the dimension is 0"},
                             {"lower", "-", "proved: f over the whole region and range is not below this"},
                             {"upper", "-", "proved: and not above this"},
                             {"violation_proved", "length", "proved: no limit is violated by more than this"},
                             {"violation_throughout", "length",
                              "proved: the same at every orientation from the lowest slice to the highest"},
                             {"evaluations", "-", "evaluations in interval arithmetic"}}),
                {"Prescribed workspaces are reconstructed from the printed results, not published."}};
  Table starts{"Local optima from many starts",
               with_design({table_column,
                            workspace_column,
                            {"rank", "-", "1 for the best"},
                            {"starts", "-", "number of starts that came to it"},
                            {"refined", "-", "yes: by exchange and Newton's method; no: a poor one, on a sample"},
                            {"f", "-", "smallest inverse condition number along the outline"},
                            {"violation", "length", "largest violation of a leg's limit along the outline"},
                            {"kkt_residual", "-", "distance from the conditions of Karush, Kuhn and Tucker"},
                            {"smallest_curvature", "-", "of the Lagrangian in the tangent space"}})};
  Table agreement{"The reference optimum by two methods",
                  {table_column,
                   workspace_column,
                   {"starts", "-", "number of starts"},
                   {"failed", "-", "starts from which SLSQP came to no feasible optimum"},
                   {"reached", "-", "starts that came to the best optimum, or one as good"},
                   {"optima", "-", "different local optima within 0.03 of the best"},
                   {"poor_optima", "-", "different local optima below that"},
                   {"t_exchange", "-", "optimum by exchange, as Ipopt has it"},
                   {"t_discretised", "-", "optimum of the large sparse problem"},
                   {"difference_t", "-", "absolute difference of the two"},
                   {"difference_d", "length",
                    "largest difference of the designs' variables, that of the exchange refined by Newton's method"},
                   {"rounds", "-", "of the exchange"},
                   {"exchange_constraints", "-", "of its last round"},
                   {"exchange_violation", "-", "largest violation at its end, lengths and inverse condition numbers"},
                   {"discretised_constraints", "-", "of the large problem"},
                   {"exchange_hessians", "-", "evaluations of the Lagrangian's Hessian, all rounds"},
                   {"discretised_hessians", "-", "the same of the large problem"}}};
  Table sensitivities{"What the reference optimum depends on",
                      {table_column,
                       workspace_column,
                       {"limit", "-", "limit of a leg, or size: the prescribed workspace scaled about its centre"},
                       {"slope", "1/length", "growth of f when the limit is loosened; of size, per relative change"}}};
  Table claim{"Section 5.8.2: f_D <= f_MO for the same prescribed workspace",
              {workspace_column,
               {"size", "-", "the table whose size it has; both where that is the same"},
               {"f_MO", "-", "reference optimum for the slices -5, 0, 5 degrees"},
               {"f_D", "-", "reference optimum for all orientations from -5 to 5 degrees"},
               {"difference", "-", "f_MO less f_D"}}};
  Table general{"How much better more general manipulators are",
                {table_column,
                 workspace_column,
                 {"family", "-",
                  "collinear: the chapter's; base: base joints "
                  "not in line; general: platform joints free as well"},
                 {"variables", "-", "number of design variables"},
                 {"starts", "-", "number of starts"},
                 {"f", "-", "smallest inverse condition number of the best design found, along the outline"},
                 {"gain", "-", "what that is above the reference optimum"},
                 {"kkt_residual", "-", "distance from the conditions of Karush, Kuhn and Tucker"},
                 {"violation", "length", "largest violation of a leg's limit along the outline"}}};
};

void add_design(Tables& tables, const Study& study, const std::string& source, const std::string& formulation,
                const Eigen::VectorXd& design, const Judged& judged, double reference) {
  const OptimalityCertificate& certificate = judged.certificate;
  std::vector<Field> row{study.table,
                         study.workspace,
                         source,
                         formulation,
                         certificate.kappa_inverse,
                         reference - certificate.kappa_inverse,
                         certificate.kkt_residual,
                         certificate.violation};
  row.insert(row.end(), design.begin(), design.end());
  row.insert(row.end(), {certificate.active.size(), certificate.tangent_dimension, certificate.smallest_curvature,
                         judged.lower, judged.upper, judged.overreach, judged.throughout, judged.evaluations});
  tables.designs.add_row(row);
}

void add_starts(Tables& tables, const Study& study, const Search& search) {
  int rank = 0;
  for (const LocalOptimum& one : search.optima) {
    const OptimalityCertificate certificate = certify_optimality(study.task, one.design);
    std::vector<Field> row{study.table,
                           study.workspace,
                           ++rank,
                           one.starts,
                           one.refined ? "yes" : "no",
                           one.t,
                           certificate.violation,
                           certificate.kkt_residual,
                           certificate.smallest_curvature};
    row.insert(row.end(), one.design.begin(), one.design.end());
    tables.starts.add_row(row);
  }
}

void add_agreement(Tables& tables, const Study& study, const Search& search, const LocalOptimum& best,
                   const Agreement& both) {
  long reached = 0;
  long optima = 0;
  for (const LocalOptimum& one : search.optima) {
    if (one.refined) ++optima;
    if (one.refined && one.t > best.t - same_value) reached += one.starts;
  }
  const auto& [exchange, discretised] = both;
  tables.agreement.add_row({study.table, study.workspace, search.starts, search.failed, reached, optima,
                            static_cast<long>(search.optima.size()) - optima, exchange.t, discretised.t,
                            std::abs(exchange.t - discretised.t),
                            (best.design - discretised.design).cwiseAbs().maxCoeff(), exchange.rounds.size(),
                            exchange.constraints.size(), exchange.violation, discretised.constraints.size(),
                            exchange.counts.lagrangian_hessian, discretised.counts.lagrangian_hessian});
}

void add_sensitivities(Tables& tables, const Study& study, const Eigen::VectorXd& design,
                       const OptimalityCertificate& certificate) {
  const std::vector<Limit> limits = list_limits(study.task.designs.manipulator(design));
  for (std::size_t j = 0; j < limits.size(); ++j) {
    tables.sensitivities.add_row(
        {study.table, study.workspace, to_string(limits[j]), certificate.limit_sensitivities[j]});
  }
  tables.sensitivities.add_row({study.table, study.workspace, "size", certificate.size_sensitivity});
}

/// A family of manipulators around a design of the chapter's, whose variables are the base joints' coordinates and,
/// where they are free, the platform joints'. The reference is d = 0.
SynthesisTask general_task(const Study& study, const Eigen::VectorXd& reference, bool platform_free) {
  const Manipulator origin = study.task.designs.manipulator(reference);
  std::vector<std::string> names;
  std::vector<Eigen::Index> rows;
  for (std::size_t leg = 0; leg < origin.size(); ++leg) {
    const auto first = 4 * static_cast<Eigen::Index>(leg);
    const std::string number = std::to_string(leg + 1);
    names.insert(names.end(), {"c_" + number + "x", "c_" + number + "y"});
    rows.insert(rows.end(), {first, first + 1});
    if (!platform_free) continue;
    names.insert(names.end(), {"p_" + number + "x", "p_" + number + "y"});
    rows.insert(rows.end(), {first + 2, first + 3});
  }
  if (!platform_free) names.emplace_back("r");
  const auto k = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(12, k);
  for (std::size_t j = 0; j < rows.size(); ++j) joints(rows[j], static_cast<Eigen::Index>(j)) = 1.0;
  if (!platform_free) joints.col(k - 1) = study.task.designs.joint_map().col(4);
  SynthesisTask task = study.task;
  task.designs = DesignSpace(origin, names, joints, Eigen::MatrixXd::Zero(6, k));
  return task;
}

/// The best of a family, from the reference (d = 0) and starts around it.
void add_general(Tables& tables, const Study& study, const std::string& family, const SynthesisTask& task,
                 const std::vector<Eigen::VectorXd>& starts, double reference, const Settings& settings) {
  const Search search = search_globally(task, starts, settings);
  const LocalOptimum& best = best_of(task, search);
  const OptimalityCertificate certificate = certify_optimality(task, best.design);
  tables.general.add_row({study.table, study.workspace, family, task.designs.size(), search.starts, best.t,
                          best.t - reference, certificate.kkt_residual, certificate.violation});
}

/// Of every problem and source (a) what f is above or below the reference, (b) the residual of the optimality
/// conditions.
Figure draw(const Table& table) {
  struct Series {
    const char* title;
    const char* source;
    const char* formulation;
    const char* colour;
    int point;  ///< filled; hollow is one less
  };
  constexpr Series all[] = {{"published", "published", "", colour::black, 7},
                            {"corrected", "published_corrected", "", colour::black, 9},
                            {"Dynamic-Q, area", "dynamic_q", "area", colour::vermilion, 9},
                            {"SLSQP, area", "slsqp", "area", colour::blue, 5},
                            {"Ipopt, area", "ipopt", "area", colour::purple, 11},
                            {"Dynamic-Q, pointwise", "dynamic_q", "pointwise", colour::orange, 9},
                            {"SLSQP, pointwise", "slsqp", "pointwise", colour::sky, 5},
                            {"Ipopt, pointwise", "ipopt", "pointwise", colour::green, 11},
                            {"reference", "reference", "semi_infinite", colour::grey, 13}};
  constexpr double hollow_above = 1e-5;
  constexpr double lowest = -16.0;
  constexpr double highest = 2.0;
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
        const double y = gaps ? -1000.0 * table.number(row, "gap") : table.number(row, "kkt_residual");
        if (gaps && (y < lowest || y > highest)) continue;
        (table.number(row, "violation") > hollow_above ? hollow : filled).push_back({x, y});
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
                              gnuplot_string(series.title));
      }
      offset += 0.09;
    }
    figure.add("plot " + curves);
  };
  figure.add("set key at graph 0.5, graph -0.17 center top horizontal Left reverse samplen 1 maxrows 3");
  figure.add(
      fmt::format("set title '(a) f less f of the reference' offset 0,-0.4\nset ylabel 'difference, thousandths "
                  "[-]' offset 0.8,0\nset yrange [{}:{}]",
                  lowest, highest));
  panel(true);
  figure.add(
      "set title '(b) residual of the optimality conditions' offset 0,-0.4\nset ylabel 'residual [-]' offset 0.8,0\n"
      "set logscale y\nset yrange [1e-17:10]\nset format y '%.0e'\nset ytics 100");
  panel(false);
  figure.add("unset multiplot");
  return figure;
}

/// The problem's own tasks done, the reference optimum is returned.
Eigen::VectorXd find_reference(const Study& study, const Lengths& lengths, const Settings& settings, Tables* tables) {
  const Search search = search_both_sides(study.task, lengths, settings);
  const LocalOptimum& best = best_of(study.task, search);
  if (!tables) return best.design;
  const IpoptSolver ipopt = make_ipopt();
  // From the optimum, rounded: other optima are so near that a farther start may lead to one of them.
  const Eigen::VectorXd start = (1000.0 * best.design).array().round() / 1000.0;
  const Agreement both{solve_by_exchange(study.task, start, ipopt),
                       solve_discretised(study.task, start, ipopt,
                                         {.points = static_cast<int>(settings.points),
                                          .refinement = static_cast<int>(settings.refinement)})};
  add_starts(*tables, study, search);
  add_agreement(*tables, study, search, best, both);
  return best.design;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  experiment.reads_results();
  Settings settings;
  CommandLine& options = experiment.options();
  options.integer("--starts", settings.starts, 1, 100'000, "starts of the global search for each sign of r");
  options.integer("--general-starts", settings.general_starts, 1, 100'000, "starts for general manipulators");
  options.integer("--sample-points", settings.sample_points, 8, 100'000, "outline points of the global search");
  options.number("--smallest-r", settings.smallest_r, NumberRange::positive(), "least |r| in the global search");
  options.number("--largest-r", settings.largest_r, NumberRange::positive(), "largest |r| in the global search");
  options.integer("--points", settings.points, 8, 100'000, "outline points of the large sparse problem");
  options.integer("--refinement", settings.refinement, 0, 100'000, "points added around each active one");

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        if (session.quick()) {
          settings.starts = 3;
          settings.general_starts = 1;
          settings.sample_points = 40;
          settings.points = 30;
          settings.refinement = 40;
        }
        const Lengths lengths = read_chapter_manipulator("M1").lengths;
        std::vector<std::vector<StudiedDesign>> stored;
        for (const ChapterSynthesis& studied : chapter_syntheses)
          stored.push_back(read_studied_designs(session, studied));
        Tables tables;
        Progress progress(9);
        std::map<std::pair<std::string, std::string>, double> optima;
        double search_seconds = 0.0;
        double judge_seconds = 0.0;
        double general_seconds = 0.0;
        const auto timed = [](double& seconds, const auto& work) {
          const auto begin = std::chrono::steady_clock::now();
          work();
          seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        };
        for (std::size_t i = 0; i < stored.size(); ++i) {
          const ChapterSynthesis& studied = chapter_syntheses[i];
          for (const std::string& workspace : workspace_names) {
            progress.begin(fmt::format("Table {}, {}", studied.table, workspace));
            const Study study = make_study(studied, studied, workspace, lengths);
            Eigen::VectorXd reference;
            timed(search_seconds, [&] { reference = find_reference(study, lengths, settings, &tables); });
            Judged judged;
            timed(judge_seconds, [&] { judged = judge(study.task, reference); });
            const double best = judged.certificate.kappa_inverse;
            optima[{studied.table, workspace}] = best;
            timed(judge_seconds, [&] {
              for (const StudiedDesign& one : stored[i]) {
                if (one.workspace != workspace) continue;
                const Eigen::VectorXd design = to_vector(one.design);
                add_design(tables, study, one.source, one.formulation, design, judge(study.task, design), best);
              }
            });
            add_design(tables, study, "reference", "semi_infinite", reference, judged, best);
            add_sensitivities(tables, study, reference, judged.certificate);

            // The optima of Table 5.4 are those of Table 5.5, or of the same kind.
            if (studied.kind == std::string_view("MO")) continue;
            timed(general_seconds, [&] {
              tables.general.add_row({study.table, study.workspace, "collinear", 5, 2 * settings.starts, best, 0.0,
                                      judged.certificate.kkt_residual, judged.certificate.violation});
              for (const bool platform_free : {false, true}) {
                const SynthesisTask task = general_task(study, reference, platform_free);
                std::vector<Eigen::VectorXd> starts{Eigen::VectorXd::Zero(task.designs.size())};
                for (const Eigen::VectorXd& point : sobol_points(settings.general_starts - 1, task.designs.size())) {
                  starts.emplace_back(0.4 * (point.array() - 0.5));
                }
                add_general(tables, study, platform_free ? "general" : "base", task, starts, best, settings);
              }
            });
          }
        }
        // P1 and P2 are the same in Tables 5.4 and 5.5; P3 is not.
        const auto optimum = [&](const char* kind, const char* size) {
          const Study study = make_study(chapter_synthesis(kind), chapter_synthesis(size), "P3", lengths);
          return assess_outline(study.task, find_reference(study, lengths, settings, nullptr)).kappa_inverse;
        };
        const auto add_claim = [&](const char* workspace, const char* size, double mo, double d) {
          tables.claim.add_row({workspace, size, mo, d, mo - d});
        };
        for (const char* workspace : {"P1", "P2"}) {
          add_claim(workspace, "both", optima[{"5.4", workspace}], optima[{"5.5", workspace}]);
        }
        timed(search_seconds, [&] {
          add_claim("P3", "5.4", optima[{"5.4", "P3"}], optimum("D", "MO"));
          add_claim("P3", "5.5", optimum("MO", "D"), optima[{"5.5", "P3"}]);
        });
        session.write(tables.designs);
        session.write(tables.starts, "starts");
        session.write(tables.agreement, "agreement");
        session.write(tables.sensitivities, "sensitivities");
        session.write(tables.claim, "claim");
        session.write(tables.general, "general");
        session.constant("outline_samples", ExchangeOptions().samples);
        session.constant("violation_tolerance", ExchangeOptions().violation_tolerance);
        session.constant("worth_refining", worth_refining);
        session.record("search_seconds", search_seconds);
        session.record("judge_seconds", judge_seconds);
        session.record("general_seconds", general_seconds);
        for (std::size_t row = 0; row < tables.agreement.rows(); ++row) {
          fmt::print("{} {}: t {:.10f}, {} of {} starts, two methods differ by {:.1e} in t, {:.1e} in d\n",
                     tables.agreement.text(row, "table"), tables.agreement.text(row, "workspace"),
                     tables.agreement.number(row, "t_exchange"), tables.agreement.text(row, "reached"),
                     tables.agreement.text(row, "starts"), tables.agreement.number(row, "difference_t"),
                     tables.agreement.number(row, "difference_d"));
        }
      },
      [](Session& session) { session.draw(draw(session.table())); });
}
