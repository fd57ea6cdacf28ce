// How the results stand: against the numbers that the thesis prints, and against those stored in data/reference.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "chapter/printed_number.hpp"
#include "chapter/stored_synthesis.hpp"
#include "frame/experiment.hpp"
#include "frame/source_tree.hpp"
#include "reference/verification.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

/// An entry of a design that comes this near to the printed one, a length, is called close.
constexpr double close_design = 0.05;

constexpr std::array<const char*, 5> design_columns = {"x_C", "y_C", "x_D", "x_E", "r"};

Table make_published_verdicts() {
  return {
      "Every published number, ours and the difference",
      {{"item", "-", "where the thesis prints it"},
       {"case", "-", "manipulator, or prescribed workspace (reconstructed, not published)"},
       {"quantity", "-", "what it is"},
       {"published", "-", "as printed"},
       {"ours", "-", "as found by the thesis's method: Dynamic-Q, area formulation"},
       {"difference", "-", "ours less published"},
       {"verdict", "-",
        "input (of the programs), fitted (the outlines were fitted to it, and it agrees to the digits printed), "
        "agrees (to the digits printed), in the spread (of restarts within 1e-6 of the start), better, worse, fewer, "
        "more, met (a constraint, by both), not met, close (within 0.05), misprint (of the thesis) or differs"},
       {"reason", "-", "what the verdict rests on"}}};
}

/// Adds rows to a table of verdicts.
class Verdicts {
 public:
  explicit Verdicts(Table& table) : table_(table) {}

  void add(const std::string& item, const std::string& name, const std::string& quantity, const std::string& published,
           double ours, const std::string& verdict, const std::string& reason) {
    table_.add_row({item, name, quantity, published, ours, ours - printed_number(published).value, verdict, reason});
  }

 private:
  Table& table_;
};

/// Whether a value rounds to a printed one.
bool is_printed(double value, const std::string& printed) {
  const PrintedNumber number = printed_number(printed);
  return std::abs(value - number.value) <= number.half_unit;
}

void judge_manipulators(Session& session, Verdicts& verdicts) {
  const Table found = session.read("table_5_1_manipulators");
  for (std::size_t row = 0; row < found.rows(); ++row) {
    for (const char* column : design_columns) {
      const std::string published = found.text(row, fmt::format("published_{}", column));
      const double ours = found.number(row, column);
      const bool same = is_printed(ours, published);
      verdicts.add("Table 5.1", found.text(row, "manipulator"), column, published, ours, same ? "input" : "differs",
                   "an input");
    }
  }
}

/// One of Tables 5.3 to 5.5: the rows of Dynamic-Q with the area formulation, and the spread of its restarts.
void judge_synthesis(Session& session, const std::string& item, const std::string& table, Verdicts& verdicts) {
  const Table found = session.read(table).where("optimizer", "dynamic_q").where("formulation", "area");
  const Table spreads = session.read(table, "restarts_summary");
  const Table misprints = read_misprints().where("item", item);
  const auto is_misprint = [&](const std::string& name, const std::string& quantity) {
    return misprints.where("case", name).where("quantity", quantity).rows() > 0;
  };
  for (std::size_t row = 0; row < found.rows(); ++row) {
    const std::string name = found.text(row, "workspace");
    const Table spread = spreads.where("workspace", name);
    const auto published = [&](const std::string& column) { return found.text(row, "published_" + column); };
    const auto agrees = [&](const std::string& column, double ours) { return is_printed(ours, published(column)); };
    const auto spread_holds = [&](double value, double ours, const char* least, const char* most) {
      return value >= std::min(ours, spread.number(0, least)) && value <= std::max(ours, spread.number(0, most));
    };

    const double n_g = found.number(row, "N_g");
    const double published_n_g = found.number(row, "published_N_g");
    verdicts.add(item, name, "N^g", published("N_g"), n_g,
                 n_g == published_n_g                                        ? "agrees"
                 : spread_holds(published_n_g, n_g, "N_g_least", "N_g_most") ? "in the spread"
                 : n_g < published_n_g                                       ? "fewer"
                                                                             : "more",
                 "gradient evaluations; the last digits decide when a run ends");

    const double f_start = found.number(row, "f_d0");
    verdicts.add(item, name, "f(d^0)", published("f_d0"), f_start, agrees("f_d0", f_start) ? "fitted" : "differs",
                 "the outlines are fitted to it");

    const double f = found.number(row, "kappa_inv_dense");
    const double published_f = found.number(row, "published_f_star");
    verdicts.add(item, name, "f*", published("f_star"), f,
                 agrees("f_star", f)                                                 ? "agrees"
                 : spread_holds(published_f, f, "kappa_inv_least", "kappa_inv_most") ? "in the spread"
                 : f > published_f                                                   ? "better"
                                                                                     : "worse",
                 "judged on a dense sample of the outline");

    const double g = found.number(row, "g_star");
    constexpr double allowed = 1e-5;  // the largest g* that is printed
    verdicts.add(item, name, "g*", published("g_star"), g, g <= allowed ? "met" : "not met",
                 "at most 1e-5, the largest that is printed, counts as met");

    for (const char* column : design_columns) {
      const double ours = found.number(row, column);
      const bool close = std::abs(ours - found.number(row, fmt::format("published_{}", column))) <= close_design;
      verdicts.add(item, name, column, published(column), ours,
                   is_misprint(name, column) ? "misprint"
                   : agrees(column, ours)    ? "agrees"
                   : close                   ? "close"
                                             : "differs",
                   "the objective is flat about its optimum");
    }
  }
}

/// For each item and quantity, how often each verdict was given.
Table summarise_published(const Table& verdicts) {
  Table summary("Published numbers, summed up", {{"item", "-", "where the thesis prints them"},
                                                 {"quantity", "-", "what they are; the design's entries together"},
                                                 {"numbers", "-", "how many"},
                                                 {"input", "-", "input"},
                                                 {"fitted", "-", "fitted"},
                                                 {"met", "-", "met"},
                                                 {"agree", "-", "agrees"},
                                                 {"close", "-", "in the spread or close"},
                                                 {"better", "-", "better or fewer"},
                                                 {"differ", "-", "worse, more, not met, misprint or differs"},
                                                 {"largest", "-", "largest absolute difference"}});
  for (const std::string& item : verdicts.distinct("item")) {
    const Table of_item = verdicts.where("item", item);
    std::vector<std::string> quantities;
    const auto group = [](const std::string& quantity) {
      return std::find(design_columns.begin(), design_columns.end(), quantity) == design_columns.end() ? quantity : "d";
    };
    for (const std::string& quantity : of_item.distinct("quantity")) {
      if (quantities.empty() || quantities.back() != group(quantity)) quantities.push_back(group(quantity));
    }
    for (const std::string& quantity : quantities) {
      int numbers = 0, input = 0, fitted = 0, met = 0, agree = 0, close = 0, better = 0, differ = 0;
      double largest = 0.0;
      for (std::size_t row = 0; row < of_item.rows(); ++row) {
        if (group(of_item.text(row, "quantity")) != quantity) continue;
        const std::string& verdict = of_item.text(row, "verdict");
        ++numbers;
        if (verdict == "input")
          ++input;
        else if (verdict == "fitted")
          ++fitted;
        else if (verdict == "met")
          ++met;
        else if (verdict == "agrees")
          ++agree;
        else if (verdict == "in the spread" || verdict == "close")
          ++close;
        else if (verdict == "better" || verdict == "fewer")
          ++better;
        else
          ++differ;
        largest = std::max(largest, std::abs(of_item.number(row, "difference")));
      }
      summary.add_row({item, quantity, numbers, input, fitted, met, agree, close, better, differ, largest});
    }
  }
  return summary;
}

Table judge_published(Session& session) {
  Table table = make_published_verdicts();
  Verdicts verdicts(table);
  judge_manipulators(session, verdicts);
  judge_synthesis(session, "Table 5.3", "table_5_3_so_synthesis", verdicts);
  judge_synthesis(session, "Table 5.4", "table_5_4_mo_synthesis", verdicts);
  judge_synthesis(session, "Table 5.5", "table_5_5_d_synthesis", verdicts);
  return table;
}

/// Where a value lies among those from the neighbouring starts, give or take half a unit of its last digit.
const char* place_among(double value, double allowance, double least, double most) {
  return value + allowance < least ? "below" : value - allowance > most ? "above" : "within";
}

/// The values of f in Tables 5.3 to 5.5: printed, from d^0, from the starts about d^0, and the reference optimum.
Table gather_outcomes(Session& session) {
  Table outcomes(
      "Was the chapter reproduced? The printed values of f beside ours",
      {{"item", "-", "where the thesis prints it"},
       {"synthesis", "-", "SO, MO or D"},
       {"workspace", "-", "prescribed workspace (reconstructed, not published)"},
       {"quantity", "-", "f(d^0) with the starting design, f* with the final one"},
       {"published", "-", "as printed"},
       {"ours", "-", "by Dynamic-Q with the area formulation from d^0, on a dense sample of the outline for f*"},
       {"least", "-", "least f* from the starts about d^0"},
       {"median", "-", "their median"},
       {"most", "-", "the greatest"},
       {"runs", "-", "how many starts about d^0"},
       {"published_place", "-", "printed value, with its rounding, among the outcomes of those starts"},
       {"ours_place", "-", "run from d^0 among the outcomes of those starts: within, below or above"},
       {"reference", "-", "reference optimum"}});
  const Table reference = session.read("reference_optimum").where("source", "reference");
  const std::array<std::array<const char*, 4>, 3> tables = {{{"Table 5.3", "5.3", "SO", "table_5_3_so_synthesis"},
                                                             {"Table 5.4", "5.4", "MO", "table_5_4_mo_synthesis"},
                                                             {"Table 5.5", "5.5", "D", "table_5_5_d_synthesis"}}};
  for (const auto& [item, number, synthesis, program_name] : tables) {
    const Table found = session.read(program_name).where("optimizer", "dynamic_q").where("formulation", "area");
    const Table spreads = session.read(program_name, "restarts_summary");
    for (std::size_t row = 0; row < found.rows(); ++row) {
      const std::string& name = found.text(row, "workspace");
      const Table spread = spreads.where("workspace", name);
      const std::string& printed_start = found.text(row, "published_f_d0");
      outcomes.add_row(
          {item, synthesis, name, "f(d^0)", printed_start, found.number(row, "f_d0"), {}, {}, {}, {}, {}, {}, {}});
      const std::string& printed = found.text(row, "published_f_star");
      const double ours = found.number(row, "kappa_inv_dense");
      const double least = spread.number(0, "kappa_inv_least");
      const double most = spread.number(0, "kappa_inv_most");
      outcomes.add_row({item, synthesis, name, "f*", printed, ours, least, spread.number(0, "kappa_inv_median"), most,
                        spread.text(0, "runs"),
                        place_among(printed_number(printed).value, printed_number(printed).half_unit, least, most),
                        place_among(ours, 0.0, least, most),
                        reference.where("table", number).where("workspace", name).number(0, "f")});
    }
  }
  return outcomes;
}

/// Every value of f less the printed one, in thousandths.
Figure draw_outcomes(const Table& outcomes) {
  Figure figure(840, 430);
  std::vector<std::vector<double>> roundings, ours, spreads, medians, references;
  std::string tics;
  double x = 0.0;
  for (const char* quantity : {"f(d^0)", "f*"}) {
    const Table values = outcomes.where("quantity", quantity);
    for (std::size_t row = 0; row < values.rows(); ++row) {
      tics += fmt::format("{}\"{}\\n{}\" {}", tics.empty() ? "" : ", ", values.text(row, "synthesis"),
                          values.text(row, "workspace"), ++x);
      const double printed = values.number(row, "published");
      const auto thousandths = [&](const char* column) { return 1000.0 * (values.number(row, column) - printed); };
      const double rounding = 1000.0 * printed_number(values.text(row, "published")).half_unit;
      for (const double y : {-rounding, rounding}) roundings.push_back({x, y});
      roundings.emplace_back();
      ours.push_back({x, thousandths("ours")});
      if (values.text(row, "reference").empty()) continue;
      spreads.push_back({x + 0.22, thousandths("median"), thousandths("least"), thousandths("most")});
      references.push_back({x, thousandths("reference")});
    }
    x += 0.5;
  }
  figure.add(fmt::format("set xrange [0.4:{}]\nset xtics ({}) scale 0\nset grid noxtics ytics", x, tics));
  figure.add("set ylabel 'ours less printed, thousandths [-]' offset 0.8,0\nset ytics 5\nset border 3");
  figure.add(
      "set label 1 'f(d⁰), with the starting design' at 5, graph 0.96 center\n"
      "set label 2 'f*, with the final design' at 14.5, graph 0.96 center\nset offsets 0, 0, 2, 0");
  figure.add(
      "set bmargin 7\nset key at graph 0.5, graph -0.19 center top horizontal Left reverse samplen 1.6 width 1 maxrows "
      "2");
  figure.add(fmt::format(
      "plot {} using 1:2 with lines lw 12 lc rgb '#d3d3d3' title 'printed, with its rounding', {} using 1:2:3:4 with "
      "yerrorbars pt 2 ps 0.7 lw 1.6 lc rgb '{}' title 'starts about d⁰: range and median', {} using 1:2 with points "
      "pt "
      "7 ps 0.8 lc rgb '{}' title 'from d⁰', {} using 1:2:(0.3) with xerrorbars pt 0 lw 2 lc rgb '{}' title 'reference "
      "optimum'",
      figure.add_data(roundings), figure.add_data(spreads), colour::blue, figure.add_data(ours), colour::vermilion,
      figure.add_data(references), colour::black));
  return figure;
}

Table judge_stored(Session& session, const std::vector<Check>& checks, const std::filesystem::path& folder) {
  Table verdicts = make_reference_verdicts();
  for (const Check& check : checks) {
    const Table rows =
        hold_against(check, session.read(check.program, check.part), read_table(folder / (check.reference + ".csv")));
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      std::vector<Field> fields;
      for (const Column& column : rows.columns()) fields.emplace_back(rows.text(row, column.name));
      verdicts.add_row(fields);
    }
  }
  return verdicts;
}

/// Says how things stand; returns how many results are not what is stored.
std::size_t tell(const Table& summary, const Table& stored) {
  constexpr std::array<const char*, 8> counts = {"numbers", "input", "fitted", "met",
                                                 "agree",   "close", "better", "differ"};
  fmt::print("Against the thesis:\n{:<10} {:<9}", "", "");
  for (const char* count : counts) fmt::print(" {:>7}", count);
  fmt::print(" {:>19}\n", "largest difference");
  for (std::size_t row = 0; row < summary.rows(); ++row) {
    fmt::print("{:<10} {:<9}", summary.text(row, "item"), summary.text(row, "quantity"));
    for (const char* count : counts) fmt::print(" {:>7}", summary.text(row, count));
    fmt::print(" {:>19.2g}\n", summary.number(row, "largest"));
  }
  std::size_t wrong = 0;
  for (std::size_t row = 0; row < stored.rows(); ++row) {
    const std::string& verdict = stored.text(row, "verdict");
    if (is_right(verdict)) continue;
    if (++wrong <= 20) {
      fmt::print("{}, {}, {}: {} ({}; stored {}, allowed difference {})\n", stored.text(row, "reference"),
                 stored.text(row, "row"), stored.text(row, "column"), verdict, stored.text(row, "value"),
                 stored.text(row, "stored"), stored.text(row, "allowed"));
    }
  }
  fmt::print("Against data/reference: {} of {} values are within their tolerance.\n", stored.rows() - wrong,
             stored.rows());
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  experiment.reads_results();
  std::filesystem::path reference = data_folder() / "reference";
  bool judge = false;
  bool update = false;
  experiment.options().path("--reference", reference, "folder of the stored results and of tolerances.csv");
  experiment.options().flag("--judge", judge, "only say how the results stand, and fail when one is not as stored");
  experiment.options().flag("--update", update, "store the results as the reference");

  const auto compute = [&](Session& session) {
    const std::vector<Check> checks = read_checks(reference / "tolerances.csv");
    if (update) {
      for (const Check& check : checks) {
        write_table(reference / (check.reference + ".csv"), reduce(check, session.read(check.program, check.part)));
      }
    }
    const Table published = judge_published(session);
    const Table summary = summarise_published(published);
    const Table stored = judge_stored(session, checks, reference);
    if (!judge) {
      session.write(published);
      session.write(summary, "summary");
      session.write(gather_outcomes(session), "outcomes");
      session.write(stored, "reference");
      session.constant("close_design", close_design);
    }
    const std::size_t wrong = tell(summary, stored);
    if (judge && wrong > 0) {
      throw std::runtime_error(
          fmt::format("{} of {} results are not as stored in {}.", wrong, stored.rows(), reference.string()));
    }
  };
  const auto draw = [&](Session& session) {
    if (!judge) session.draw(draw_outcomes(session.table("outcomes")), "outcomes");
  };
  return experiment.run(argc, argv, compute, draw);
}
