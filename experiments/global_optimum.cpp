// The best design there is, for each of the nine syntheses of Tables 5.3 to 5.5 and each sign of r: what was found,
// what is proved that no design exceeds, and the certificate of it, which an independent program checks. Then how many
// different designs come near the best, and what base joints that are not in line would give.

#include "reprise/bounds/global_optimum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "chapter/problems.hpp"
#include "frame/experiment.hpp"
#include "frame/source_tree.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/bounds/good_designs.hpp"
#include "reprise/io/compression.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/study/bound_claim.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

/// Sizes |r| that are searched. At both ends and beyond kappa^-1 is below 0.86, as the root box's lemma says.
constexpr Interval sizes{0.5, 2.6};

struct Settings {
  double gap = 1e-7;
  long threads = 2;
  double near_best = 1e-4;
  double resolution = 0.01;
  double anywhere_gap = 1e-5;
  std::vector<std::string> anywhere_workspaces{"P2"};
  long anywhere_boxes = 250'000;
  long anywhere_starts = 4'000;
};

const Column table_column{"table", "-", "table of the chapter that the problem belongs to"};
const Column workspace_column{"workspace", "-", "prescribed workspace (reconstructed, not published)"};
const Column side_column{"side", "-", "sign of r; with -1 the platform is turned round"};
const std::string note = "Prescribed workspaces are reconstructed from the printed results, not published.";

std::vector<Column> joined(std::vector<Column> columns, const std::vector<Column>& more) {
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

std::vector<Column> design_as_columns(const std::vector<std::string>& names) {
  std::vector<Column> columns;
  for (const std::string& name : names) columns.push_back({name, "length", "the design found"});
  return columns;
}

const std::vector<Column> proof_columns{
    {"f", "-", "proved: smallest inverse condition number of the design found, over the whole workspace and range"},
    {"bound", "-", "proved: no design of that side that reaches the workspace has a larger one"},
    {"gap", "-", "the bound less f"},
    {"boxes", "-", "boxes of designs examined"},
    {"seconds", "s", "processor time of the proof divided by the number of threads; not the same in each run"},
    {"checked", "-", "1: the independent checker accepts the certificate"}};

const std::vector<Column> count_columns{{"split", "-", "boxes split"},
                                        {"limits", "-", "boxes and slabs left out by one limit at one pose"},
                                        {"conditioning", "-", "boxes left out by the condition number at one pose"},
                                        {"combinations", "-", "boxes left out by multipliers of a linear program"},
                                        {"infeasible", "-", "boxes left out by multipliers of limits alone"},
                                        {"certificate_bytes", "byte", "size of the certificate, compressed"},
                                        {"status", "-", "how the search ended"}};

const std::vector<std::string> anywhere_names{"c_1x", "c_1y", "c_2x", "c_2y", "c_3x", "c_3y", "r"};

struct Tables {
  Table optima{"The best design there is: what was found, and what is proved that no design exceeds",
               joined(joined(joined({table_column, workspace_column, side_column}, proof_columns),
                             design_as_columns({design_columns.begin(), design_columns.end()})),
                      count_columns),
               {note}};
  Table anywhere{
      "Base joints anywhere, one orientation: what was found, and what is proved that no design exceeds",
      joined(joined(joined({workspace_column}, proof_columns), design_as_columns(anywhere_names)), count_columns),
      {note}};
  Table growth{"What a smaller gap costs",
               {table_column,
                workspace_column,
                side_column,
                {"variables", "-", "of the search: 5 with base joints in line, 7 with base joints anywhere"},
                {"gap", "-", "the bound less the f found in the end"},
                {"boxes", "-", "examined until the bound was as near, a batch at a time"}}};
  Table near{"Designs near the best: boxes that hold all of them",
             {table_column,
              workspace_column,
              side_column,
              {"value", "-", "all designs with a larger smallest inverse condition number are in the boxes"},
              {"group", "-", "boxes that touch are of one group"},
              {"boxes", "-", "of the group"},
              {"variable", "-", "of the design d"},
              {"lower", "length", "end of the hull of the group's boxes"},
              {"upper", "length", "its other end"},
              {"width", "length", "of the hull"}}};
  Table near_boxes{"Designs near the best: the boxes, in two of their variables",
                   {table_column,
                    workspace_column,
                    {"group", "-", "boxes that touch are of one group"},
                    {"x_lower", "length", "of q_3 = x_E - r"},
                    {"x_upper", "length", "of q_3 = x_E - r"},
                    {"y_lower", "length", "of y_C"},
                    {"y_upper", "length", "of y_C"}}};
  Table turned{"The best designs for P3 with each sign of r, with the working point at the centre",
               {table_column,
                side_column,
                {"part", "-", "base, leg 1 to leg 3, platform, or prescribed: the outline to be reached"},
                {"x", "length", "x coordinate"},
                {"y", "length", "y coordinate"}}};
};

/// One search and what it has gone through.
struct Searched {
  GlobalOptimum optimum;
  double seconds;
  std::vector<std::pair<long, double>> bounds;  ///< after so many boxes
};

Searched search(const SynthesisTask& task, GlobalOptions options, Progress& progress, const std::string& name) {
  progress.begin(name);
  std::vector<std::pair<long, double>> bounds;
  options.observe = [&](const GlobalProgress& now) {
    bounds.emplace_back(now.boxes, now.upper);
    progress.note(fmt::format("{} boxes, {:.7f} to {:.7f}", now.boxes, now.lower, now.upper));
  };
  const std::clock_t begin = std::clock();
  GlobalOptimum optimum = prove_global_optimum(task, options);
  const double seconds =
      static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / static_cast<double>(options.threads);
  if (!optimum.design) throw std::runtime_error("No design was found for " + name + ".");
  return {std::move(optimum), seconds, std::move(bounds)};
}

void add_growth(Table& table, const Field& of_table, const Field& workspace, int side, int variables,
                const Searched& searched) {
  for (const double gap : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const auto reached = std::find_if(searched.bounds.begin(), searched.bounds.end(),
                                      [&](const auto& one) { return one.second - searched.optimum.lower <= gap; });
    if (reached != searched.bounds.end()) {
      table.add_row({of_table, workspace, side, variables, gap, reached->first});
    }
  }
}

std::string certificate_name(const ChapterSynthesis& synthesis, const std::string& workspace, int side) {
  return fmt::format("{}_{}{}", synthesis.kind, workspace, side > 0 ? "" : "_turned");
}

/// A certificate that is stored and waits for the checker.
struct Stored {
  std::filesystem::path claim;  ///< empty where there is none, because the search came to no bound
  std::size_t bytes = 0;
};

Stored store(Session& session, const ChapterSynthesis& synthesis, const std::string& workspace, const std::string& name,
             int side, const GlobalOptimum& found) {
  if (found.certificate.nodes.empty()) return {};
  const std::filesystem::path folder = "certificates";
  const std::string compressed = compress(to_text(found.certificate));
  const std::filesystem::path tree = session.store(folder / (name + ".cert.gz"), compressed);
  const std::filesystem::path problem = examples_folder() / (workspace + synthesis.file + ".toml");
  const StoredClaim stored{std::filesystem::proximate(problem, tree.parent_path()),
                           tree.filename(),
                           {side, found.upper, found.certificate.root}};
  return {session.store(folder / (name + ".toml"), to_toml(stored)), compressed.size()};
}

/// What the checker says of each, in the same order.
std::vector<CheckResult> check_all(const std::vector<Stored>& stored, long threads) {
  std::vector<CheckResult> results(stored.size());
  in_threads(stored.size(), threads, [&](std::size_t k) {
    if (!stored[k].claim.empty()) results[k] = check_claim(stored[k].claim).result;
  });
  return results;
}

/// Adds the row that begins with the names of the problem.
void add_proof(Table& table, std::vector<Field> row, const Searched& searched, const Stored& stored,
               const CheckResult& check) {
  const GlobalOptimum& found = searched.optimum;
  const BoxCounts& counts = found.counts;
  row.insert(row.end(), {found.lower, found.upper, found.upper - found.lower, counts.examined, searched.seconds,
                         check.proved ? 1 : 0});
  row.insert(row.end(), found.design->begin(), found.design->end());
  row.insert(row.end(), {counts.split, counts.limits, counts.conditioning, counts.combinations, counts.infeasible,
                         stored.bytes, std::string(to_string(found.status))});
  table.add_row(row);
}

void say(const std::string& name, const GlobalOptimum& found, const CheckResult& check) {
  fmt::print("{}: {:.9f} <= f* <= {:.9f}, {} boxes, certificate {}\n", name, found.lower, found.upper,
             found.counts.examined, check.proved ? "checked" : "not checked. " + check.failure);
}

/// One problem with one sign of r.
struct Case {
  const ChapterSynthesis* synthesis;
  std::string workspace;
  int side;
  SynthesisTask task;
};

std::vector<Case> list_cases(bool quick) {
  std::vector<Case> cases;
  for (const ChapterSynthesis& synthesis : chapter_syntheses) {
    for (const std::string& workspace : workspace_names) {
      // The quickest of one orientation, and the one whose best platform is turned round.
      const bool one_orientation = synthesis.kind == std::string_view("SO");
      const bool range_of_p3 = synthesis.kind == std::string_view("D") && workspace == "P3";
      if (quick && !(one_orientation && workspace != "P3") && !range_of_p3) continue;
      const SynthesisTask task = read_chapter_problem(synthesis, workspace).task;
      for (const int side : {1, -1}) cases.push_back({&synthesis, workspace, side, task});
    }
  }
  return cases;
}

std::vector<Searched> add_optima(Session& session, Tables& tables, const Settings& settings,
                                 const std::vector<Case>& cases, Progress& progress) {
  std::vector<Searched> all;
  std::vector<Stored> stored;
  for (const Case& one : cases) {
    const std::string name = certificate_name(*one.synthesis, one.workspace, one.side);
    all.push_back(search(one.task, {.gap = settings.gap, .side = one.side, .threads = settings.threads, .sizes = sizes},
                         progress, name));
    stored.push_back(store(session, *one.synthesis, one.workspace, name, one.side, all.back().optimum));
    add_growth(tables.growth, one.synthesis->table, one.workspace, one.side, 5, all.back());
  }
  progress.begin("checks");
  const std::vector<CheckResult> checks = check_all(stored, settings.threads);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    add_proof(tables.optima, {cases[k].synthesis->table, cases[k].workspace, cases[k].side}, all[k], stored[k],
              checks[k]);
    say(fmt::format("Table {} {} r {} 0", cases[k].synthesis->table, cases[k].workspace, cases[k].side > 0 ? ">" : "<"),
        all[k].optimum, checks[k]);
  }
  return all;
}

/// With kappa at the orientation 0 alone the sign of r makes no difference: both signs are one search.
void add_anywhere(Session& session, Tables& tables, const Settings& settings, Progress& progress) {
  const std::vector<std::string>& proved = settings.anywhere_workspaces;
  const ChapterSynthesis& synthesis = chapter_synthesis("SO");
  std::vector<Searched> all;
  std::vector<Stored> stored;
  for (const std::string& workspace : workspace_names) {
    const SynthesisTask task = read_chapter_problem(synthesis, workspace).task;
    const std::string name = certificate_name(synthesis, workspace, 1) + "_anywhere";
    const bool to_be_proved = std::find(proved.begin(), proved.end(), workspace) != proved.end();
    all.push_back(search(task,
                         {.gap = settings.anywhere_gap,
                          .base_joints = BaseJoints::anywhere,
                          .max_boxes = to_be_proved ? settings.anywhere_boxes : 1,
                          .starts = settings.anywhere_starts,
                          .threads = settings.threads,
                          .sizes = sizes},
                         progress, name));
    stored.push_back(store(session, synthesis, workspace, name, 1, all.back().optimum));
    add_growth(tables.growth, synthesis.table, workspace, 1, 7, all.back());
  }
  progress.begin("checks, base joints anywhere");
  const std::vector<CheckResult> checks = check_all(stored, settings.threads);
  for (std::size_t k = 0; k < all.size(); ++k) {
    add_proof(tables.anywhere, {workspace_names[k]}, all[k], stored[k], checks[k]);
    say("Base joints anywhere, " + workspace_names[k], all[k].optimum, checks[k]);
  }
}

/// Where designs near the best of both signs of r are; with the same best value on both sides, those with r > 0.
void add_near(Tables& tables, const Settings& settings, const std::vector<Case>& cases,
              const std::vector<Searched>& all, Progress& progress) {
  for (std::size_t k = 0; k < cases.size(); k += 2) {
    const bool turned = all[k + 1].optimum.lower > all[k].optimum.upper;
    const Case& best = cases[turned ? k + 1 : k];
    const GlobalOptimum& optimum = all[turned ? k + 1 : k].optimum;
    const double value = optimum.lower - settings.near_best;
    const std::string& table = best.synthesis->table;
    progress.begin(fmt::format("near the best, {} {}", best.synthesis->kind, best.workspace));
    const GoodDesigns good = enclose_good_designs(best.task, value,
                                                  {.side = best.side,
                                                   .resolution = settings.resolution,
                                                   .threads = settings.threads,
                                                   .sizes = sizes,
                                                   .proof = &optimum.certificate});
    std::map<std::size_t, long> boxes;
    for (const GoodBox& box : good.boxes) {
      ++boxes[box.group];
      tables.near_boxes.add_row({table, best.workspace, box.group + 1, box.variables[2].lower, box.variables[2].upper,
                                 box.variables[3].lower, box.variables[3].upper});
    }
    for (std::size_t group = 0; group < good.hulls.size(); ++group) {
      for (std::size_t i = 0; i < design_columns.size(); ++i) {
        const Interval& hull = good.hulls[group][i];
        tables.near.add_row({table, best.workspace, best.side, value, group + 1, boxes[group],
                             std::string(design_columns[i]), hull.lower, hull.upper, hull.upper - hull.lower});
      }
    }
    fmt::print("Table {} {}: designs above {:.7f} in {} boxes of {} groups\n", table, best.workspace, value,
               good.boxes.size(), good.hulls.size());
  }
}

/// The mechanisms of the best designs for P3 in Tables 5.4 and 5.5.
void add_turned(Table& table, const std::vector<Case>& cases, const std::vector<Searched>& all) {
  constexpr int outline_points = 180;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Case& one = cases[k];
    if (one.workspace != "P3" || one.synthesis->kind == std::string_view("SO")) continue;
    const PrescribedWorkspace& prescribed = one.task.prescribed;
    const auto add = [&](const std::string& part, const Eigen::Vector2d& point) {
      table.add_row({one.synthesis->table, one.side, part, point.x(), point.y()});
    };
    for (int i = 0; i <= outline_points; ++i) {
      add("prescribed", prescribed.point(2.0 * pi * i / outline_points));
    }
    const Manipulator manipulator = one.task.designs.manipulator(*all[k].optimum.design);
    for (std::size_t leg = 0; leg < manipulator.size(); ++leg) {
      const std::string part = fmt::format("leg {}", leg + 1);
      add(part, manipulator.leg(leg).base_joint);
      add(part, prescribed.centre() + manipulator.leg(leg).platform_joint);
    }
    for (const std::size_t leg : {std::size_t{0}, std::size_t{2}}) {
      add("platform", prescribed.centre() + manipulator.leg(leg).platform_joint);
    }
  }
}

std::vector<std::vector<double>> points_of(const Table& table) {
  std::vector<std::vector<double>> points;
  for (std::size_t row = 0; row < table.rows(); ++row)
    points.push_back({table.number(row, "x"), table.number(row, "y")});
  return points;
}

Figure draw_turned(const Table& table) {
  Figure figure(840, 680);
  figure.add("set multiplot layout 2,2 margins 0.08, 0.99, 0.14, 0.95 spacing 0.08, 0.13");
  figure.add(
      "set size ratio -1\nset xrange [-1.6:3.7]\nset yrange [0:3]\nset xtics 1\nset ytics 1\n"
      "set xlabel 'x [length]' offset 0,0.4\nset ylabel 'y [length]' offset 1,0");
  figure.add("set key at screen 0.5, screen 0.035 center center horizontal Left reverse samplen 1.5 maxrows 1");
  char letter = 'a';
  for (const std::string& number : table.distinct("table")) {
    for (const std::string& side : table.distinct("side")) {
      const Table one = table.where("table", number).where("side", side);
      const auto of_table = [&](const ChapterSynthesis& synthesis) { return number == synthesis.table; };
      const auto* synthesis = std::find_if(chapter_syntheses.begin(), chapter_syntheses.end(), of_table);
      if (synthesis == chapter_syntheses.end()) throw std::runtime_error("no synthesis belongs to Table " + number);
      figure.add(fmt::format("set title '({}) {} {}, r {} 0' offset 0,-0.6", letter, synthesis->kind, "P3",
                             side == "1" ? ">" : "<"));
      const bool named = letter == 'a';
      const auto title = [&](const std::string& name) { return named ? "title '" + name + "'" : "notitle"; };
      std::string plot = "plot " + figure.add_data(points_of(one.where("part", "prescribed"))) +
                         fmt::format(" using 1:2 with lines lw 2 lc rgb '{}' {}", colour::blue, title("workspace"));
      for (const auto& [part, shade] : {std::pair("leg 1", colour::green), std::pair("leg 2", colour::orange),
                                        std::pair("leg 3", colour::purple), std::pair("platform", colour::black)}) {
        plot += fmt::format(", {} using 1:2 with linespoints lw {} pt 7 ps 0.7 lc rgb '{}' {}",
                            figure.add_data(points_of(one.where("part", part))),
                            part == std::string_view("platform") ? 4 : 2, shade, title(part));
      }
      figure.add(plot);
      if (named) figure.add("unset key");
      ++letter;
    }
  }
  figure.add("unset multiplot");
  return figure;
}

/// The boxes of every problem in the plane of q_3 and y_C, each with its own ranges.
Figure draw_near(const Table& boxes) {
  Figure figure(840, 860);
  figure.add("set multiplot layout 3,3 margins 0.095, 0.98, 0.07, 0.96 spacing 0.105, 0.115");
  figure.add("unset key\nset offsets graph 0.1, graph 0.1, graph 0.1, graph 0.1\nset style fill solid 0.5 border");
  for (const ChapterSynthesis& synthesis : chapter_syntheses) {
    const Table of_table = boxes.where("table", synthesis.table);
    for (const std::string& workspace : of_table.distinct("workspace")) {
      const Table one = of_table.where("workspace", workspace);
      const std::vector<double> lower = one.numbers("x_lower");
      const std::vector<double> upper = one.numbers("x_upper");
      const double width =
          *std::max_element(upper.begin(), upper.end()) - *std::min_element(lower.begin(), lower.end());
      // Boxes that differ in other variables alone are one box of the picture.
      std::set<std::vector<double>> seen;
      for (std::size_t row = 0; row < one.rows(); ++row) {
        const auto number = [&](const char* column) { return one.number(row, column); };
        seen.insert({std::midpoint(number("x_lower"), number("x_upper")),
                     std::midpoint(number("y_lower"), number("y_upper")), number("x_lower"), number("x_upper"),
                     number("y_lower"), number("y_upper")});
      }
      figure.add(
          fmt::format("set title '{} {}' offset 0,-0.6\nset xlabel 'x_E − r [length]' offset 0,0.4\n"
                      "set ylabel 'y_C [length]' offset 2,0\nset xtics {}",
                      synthesis.kind, workspace, round_step(width, 3.0)));
      figure.add(fmt::format("plot {} using 1:2:3:4:5:6 with boxxyerror lc rgb '{}'",
                             figure.add_data({seen.begin(), seen.end()}), colour::blue));
    }
  }
  figure.add("unset multiplot");
  return figure;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  Settings settings;
  CommandLine& options = experiment.options();
  options.number("--gap", settings.gap, NumberRange::between(1e-8, 1.0), "between bound and found design");
  options.integer("--threads", settings.threads, 1, 256, "threads; the results do not depend on them");
  options.number("--near", settings.near_best, NumberRange::between(1e-6, 0.01),
                 "designs that are worse than the best by less than this are enclosed");
  options.number("--resolution", settings.resolution, NumberRange::between(1e-4, 1.0), "largest side of their boxes");
  options.number("--anywhere-gap", settings.anywhere_gap, NumberRange::between(1e-8, 1.0),
                 "the gap for base joints anywhere");
  options.choices("--anywhere-workspace", settings.anywhere_workspaces, workspace_names,
                  "workspaces for which a bound is proved with base joints anywhere");
  options.integer("--anywhere-boxes", settings.anywhere_boxes, 1, 1'000'000'000,
                  "limit on boxes for each of them; 20000000, for all three workspaces, take hours");

  options.integer("--anywhere-starts", settings.anywhere_starts, 0, 1'000'000,
                  "starts of local searches for base joints anywhere");

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        if (session.quick()) {
          settings.anywhere_starts = 500;
          settings.anywhere_boxes = 3'000;
        }
        Tables tables;
        const std::vector<Case> cases = list_cases(session.quick());
        Progress progress(cases.size() + cases.size() / 2 + workspace_names.size() + 2);
        const std::vector<Searched> all = add_optima(session, tables, settings, cases, progress);
        add_near(tables, settings, cases, all, progress);
        add_turned(tables.turned, cases, all);
        add_anywhere(session, tables, settings, progress);
        session.write(tables.optima);
        session.write(tables.anywhere, "anywhere");
        session.write(tables.growth, "growth");
        session.write(tables.near, "near");
        session.write(tables.near_boxes, "near_boxes");
        session.write(tables.turned, "turned");
        session.constant("smallest_size", sizes.lower);
        session.constant("largest_size", sizes.upper);
        session.constant("boxes_in_batch", static_cast<double>(boxes_in_batch));
      },
      [](Session& session) {
        session.draw(draw_near(session.table("near_boxes")), "near");
        session.draw(draw_turned(session.table("turned")), "turned");
      });
}
