// The chapter's assumptions about where the smallest inverse condition number lies, tested for every design of Tables
// 5.3 to 5.5, published and found here, over the whole prescribed workspace and range of orientations:
//     a   on the outline of the prescribed workspace    sections 5.6.1 and 5.8.1
//     b   at an end of the range of orientations        section 5.8.1
// by dense samples, and rigorously by interval branch and bound.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chapter/problems.hpp"
#include "chapter/stored_synthesis.hpp"
#include "frame/experiment.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/bounds/enclosure.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/progress.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

struct Settings {
  double tolerance = 1e-6;
  long max_evaluations = 1'000'000;
  long points = 720;
  long rings = 24;
  long orientations = 21;
};

double radians(double degrees) { return degrees * pi / 180.0; }
double degrees(double radians) { return radians * 180.0 / pi; }

/// The claim that the smallest kappa^-1 at these orientations lies on the outline (a), or at one of their ends (b).
struct Claim {
  char assumption;
  Interval range_deg;
};

/// What the chapter assumes in a synthesis: of Table 5.3 at its orientation, of Table 5.4 at each of its slices and, as
/// it expects, over the range between them, of Table 5.5 over its range.
std::vector<Claim> list_claims(const ChapterSynthesis& synthesis) {
  std::vector<Claim> claims;
  Interval range_deg{0.0, 0.0};
  for (const OrientationRange& range : read_orientations(synthesis)) {
    claims.push_back({'a', {degrees(range.lower), degrees(range.upper)}});
    range_deg = {std::min(range_deg.lower, degrees(range.lower)), std::max(range_deg.upper, degrees(range.upper))};
  }
  if (claims.size() > 1) claims.push_back({'a', range_deg});
  if (range_deg.lower < range_deg.upper) claims.push_back({'b', range_deg});
  return claims;
}

/// kappa^-1 at many poses: at each orientation the smallest value on the outline and on each ring within it.
class Sample {
 public:
  Sample(const Manipulator& manipulator, const PrescribedWorkspace& prescribed, std::vector<double> orientations_deg,
         const Settings& settings)
      : orientations_deg_(std::move(orientations_deg)), rings_(static_cast<std::size_t>(settings.rings) + 1) {
    smallest_.assign(orientations_deg_.size() * rings_, infinity);
    for (const double beta : prescribed.angles(static_cast<int>(settings.points))) {
      const Eigen::Vector2d spoke = prescribed.point(beta) - prescribed.centre();
      for (std::size_t ring = 0; ring < rings_; ++ring) {
        const Eigen::Vector2d u = prescribed.centre() + share(ring) * spoke;
        for (std::size_t k = 0; k < orientations_deg_.size(); ++k) {
          double& smallest = smallest_[k * rings_ + ring];
          const Pose pose{u, radians(orientations_deg_[k])};
          smallest = std::min(smallest, kappa_inverse(manipulator, pose, printed_conditioning));
        }
      }
    }
  }

  const std::vector<double>& orientations_deg() const { return orientations_deg_; }
  std::size_t rings() const { return rings_; }
  /// Distance of a ring from the centre, 1 on the outline.
  double share(std::size_t ring) const { return static_cast<double>(ring) / static_cast<double>(rings_ - 1); }

  /// The smallest values of a range of orientations, on one ring or anywhere.
  double on_ring(std::size_t ring, const Interval& range_deg) const {
    double smallest = infinity;
    for (std::size_t k = 0; k < orientations_deg_.size(); ++k) {
      if (orientations_deg_[k] < range_deg.lower || orientations_deg_[k] > range_deg.upper) continue;
      smallest = std::min(smallest, smallest_[k * rings_ + ring]);
    }
    return smallest;
  }
  double anywhere(const Interval& range_deg) const {
    double smallest = infinity;
    for (std::size_t ring = 0; ring < rings_; ++ring) smallest = std::min(smallest, on_ring(ring, range_deg));
    return smallest;
  }
  /// The smallest value where a claim says it is.
  double where_claimed(const Claim& claim) const {
    const auto& [lower, upper] = claim.range_deg;
    if (claim.assumption == 'a') return on_ring(rings_ - 1, claim.range_deg);
    return std::min(anywhere({lower, lower}), anywhere({upper, upper}));
  }

 private:
  std::vector<double> orientations_deg_;
  std::size_t rings_;
  std::vector<double> smallest_;
};

/// All orientations of the claims; evenly spaced ones between them when a claim is about a range.
std::vector<double> sampled_orientations(const std::vector<Claim>& claims, long count) {
  std::vector<double> orientations;
  for (const Claim& claim : claims) {
    const auto& [lower, upper] = claim.range_deg;
    orientations.insert(orientations.end(), {lower, upper});
    for (long k = 1; k + 1 < count && upper > lower; ++k) {
      orientations.push_back(lower + (upper - lower) * static_cast<double>(k) / static_cast<double>(count - 1));
    }
  }
  std::sort(orientations.begin(), orientations.end());
  orientations.erase(std::unique(orientations.begin(), orientations.end()), orientations.end());
  return orientations;
}

PartCheck check(const Claim& claim, const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                const Settings& settings) {
  const Interval range{radians(claim.range_deg.lower), radians(claim.range_deg.upper)};
  const auto test = claim.assumption == 'a' ? check_minimum_on_outline : check_minimum_at_range_ends;
  return test(manipulator, prescribed, range, printed_conditioning, {settings.tolerance, settings.max_evaluations});
}

Table make_table() {
  return {
      "The chapter's assumptions about the smallest inverse condition number",
      {{"table", "-", "table of the chapter that the design belongs to"},
       {"workspace", "-", "prescribed workspace (reconstructed, not published)"},
       {"source", "-",
        "published, published_corrected (P1 of Table 5.3 with y_C = 0.2617), or the optimizer that found the design"},
       {"formulation", "-", "formulation that the optimizer solved; empty for published designs"},
       {"assumption", "-", "a: the smallest value is on the outline; b: it is at an end of the range of orientations"},
       {"phi_min_deg", "degree", "lowest orientation"},
       {"phi_max_deg", "degree", "highest orientation"},
       {"sampled_claimed", "-", "smallest sampled value where the assumption says it is"},
       {"sampled_all", "-", "smallest sampled value in the whole prescribed workspace and range"},
       {"sampled_difference", "-", "by how much the former exceeds the latter"},
       {"verdict", "-", "proved, refuted (by the witness) or undecided, by interval branch and bound"},
       {"x", "length", "witness, the pose of the smallest value found: x coordinate"},
       {"y", "length", "witness, y coordinate"},
       {"phi_deg", "degree", "witness, orientation"},
       {"kappa_inv", "-", "inverse condition number at the witness"},
       {"lower", "-", "the smallest value in the whole prescribed workspace and range is not below this"},
       {"upper", "-", "and not above this"},
       {"claimed_lower", "-", "the smallest value where the assumption says it is is not below this"},
       {"claimed_upper", "-", "and not above this"},
       {"evaluations", "-", "evaluations in interval arithmetic"}},
      {"Prescribed workspaces are reconstructed from the printed results, not published."}};
}

Table make_profiles() {
  return {"How the smallest inverse condition number varies within the prescribed workspace and range, sampled",
          {{"table", "-", "table of the chapter that the design belongs to"},
           {"workspace", "-", "prescribed workspace (reconstructed, not published)"},
           {"source", "-", "as in the main table"},
           {"formulation", "-", "as in the main table"},
           {"along", "-", "share: distance from the centre, 1 on the outline; phi_deg: orientation"},
           {"at", "-", "the share, or the orientation in degrees"},
           {"kappa_inv", "-", "smallest value on that ring at all orientations, or anywhere at that orientation"}}};
}

void add_profiles(Table& profiles, const ChapterSynthesis& studied, const StudiedDesign& one, const Sample& sample) {
  const auto add = [&](const char* along, double at, double smallest) {
    profiles.add_row({studied.table, one.workspace, one.source, one.formulation, along, at, smallest});
  };
  const std::vector<double>& orientations = sample.orientations_deg();
  const Interval all{orientations.front(), orientations.back()};
  for (std::size_t ring = 0; ring < sample.rings(); ++ring) {
    add("share", sample.share(ring), sample.on_ring(ring, all));
  }
  for (const double phi : orientations) add("phi_deg", phi, sample.anywhere({phi, phi}));
}

/// Counts the verdicts of each table, assumption and range, and of all tables together.
Table summarise(const Table& table) {
  Table summary("How the chapter's assumptions fare",
                {{"table", "-", "table of the chapter that the designs belong to, or all"},
                 {"assumption", "-", "as in the main table"},
                 {"phi_min_deg", "degree", "lowest orientation; empty for all tables together"},
                 {"phi_max_deg", "degree", "highest orientation; empty for all tables together"},
                 {"claims", "-", "number of claims checked: of designs, or of all tables' rows"},
                 {"proved", "-", "how many of them are proved"},
                 {"refuted", "-", "how many are refuted"},
                 {"undecided", "-", "how many are neither"},
                 {"sampled_difference", "-", "largest difference that the samples show against the assumption"},
                 {"evaluations", "-", "largest number of evaluations in interval arithmetic of one claim"}});
  const auto add = [&](const std::string& name, const Table& rows, const Field& lowest, const Field& highest) {
    if (rows.rows() == 0) return;
    const auto largest = [&](const char* column) {
      const std::vector<double> values = rows.numbers(column);
      return *std::max_element(values.begin(), values.end());
    };
    const auto count = [&](Verdict verdict) { return rows.where("verdict", to_string(verdict)).rows(); };
    summary.add_row({name, rows.text(0, "assumption"), lowest, highest, rows.rows(), count(Verdict::proved),
                     count(Verdict::refuted), count(Verdict::undecided), largest("sampled_difference"),
                     largest("evaluations")});
  };
  for (const std::string& name : table.distinct("table")) {
    const Table of_table = table.where("table", name);
    for (const std::string& assumption : of_table.distinct("assumption")) {
      const Table rows = of_table.where("assumption", assumption);
      for (const std::string& lowest : rows.distinct("phi_min_deg")) {
        for (const std::string& highest : rows.distinct("phi_max_deg")) {
          add(name, rows.where("phi_min_deg", lowest).where("phi_max_deg", highest), lowest, highest);
        }
      }
    }
  }
  for (const std::string& assumption : table.distinct("assumption")) {
    add("all", table.where("assumption", assumption), {}, {});
  }
  return summary;
}

/// Of the published designs, the smallest kappa^-1 (a) along the distance from the centre, (b) along the orientation.
Figure draw(const Table& profiles) {
  Figure figure(900, 390);
  figure.add("set multiplot layout 1,2 margins 0.08, 0.98, 0.28, 0.915 spacing 0.1, 0");
  figure.add("set key at graph 0.5, graph -0.29 center top horizontal Left reverse samplen 1.6 maxrows 1");
  figure.add("set ylabel 'smallest κ⁻¹ [-]' offset 0.4,0");
  const auto panel = [&](const Table& rows) {
    constexpr const char* colours[] = {colour::vermilion, colour::green, colour::purple};
    std::string curves;
    std::size_t next = 0;
    for (const std::string& workspace : rows.distinct("workspace")) {
      Table curve = rows.where("workspace", workspace);
      curve = curve.where("source", curve.distinct("source").back());  // the corrected design, if there is one
      std::vector<std::vector<double>> points;
      for (std::size_t row = 0; row < curve.rows(); ++row) {
        points.push_back({curve.number(row, "at"), curve.number(row, "kappa_inv")});
      }
      curves += fmt::format("{}{} using 1:2 with lines lw 2 lc rgb '{}' title {}", curves.empty() ? "" : ", ",
                            figure.add_data(points), colours[next++ % std::size(colours)], gnuplot_string(workspace));
    }
    figure.add("plot " + curves);
  };
  const Table printed = profiles.where("formulation", "");
  figure.add(
      "set title '(a) designs of Table 5.3, φ = 0°' offset 0,-0.4\nset xlabel 'distance from the centre, 1 on the "
      "outline [-]'\nset xrange [0:1]\nset format y '%.2f'");
  panel(printed.where("table", "5.3").where("along", "share"));
  figure.add(
      "set title '(b) designs of Table 5.5, whole workspace' offset 0,-0.4\nset xlabel 'platform orientation φ [°]'\n"
      "set xrange [-5:5]\nset xtics 1\nset format y '%.3f'");
  panel(printed.where("table", "5.5").where("along", "phi_deg"));
  figure.add("unset multiplot");
  return figure;
}

/// Checks every claim about one design. Returns the seconds that the rigorous checks took.
double check_design(const ChapterSynthesis& studied, const StudiedDesign& one, const PrescribedWorkspace& prescribed,
                    const Manipulator& manipulator, const Settings& settings, Table& table, Table& profiles) {
  const std::vector<Claim> claims = list_claims(studied);
  const Sample sample(manipulator, prescribed, sampled_orientations(claims, settings.orientations), settings);
  add_profiles(profiles, studied, one, sample);
  double seconds = 0.0;
  for (const Claim& claim : claims) {
    const auto start = std::chrono::steady_clock::now();
    const PartCheck checked = check(claim, manipulator, prescribed, settings);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    const double claimed = sample.where_claimed(claim);
    const double all = sample.anywhere(claim.range_deg);
    std::vector<Field> row{studied.table,
                           one.workspace,
                           one.source,
                           one.formulation,
                           std::string(1, claim.assumption),
                           claim.range_deg.lower,
                           claim.range_deg.upper,
                           claimed,
                           all,
                           claimed - all,
                           to_string(checked.verdict)};
    if (const auto& witness = checked.all.witness) {
      row.insert(row.end(), {witness->position.x(), witness->position.y(), degrees(witness->orientation),
                             kappa_inverse(manipulator, *witness, printed_conditioning)});
    } else {
      row.insert(row.end(), 4, Field());
    }
    row.insert(row.end(),
               {checked.all.lower, checked.all.upper, checked.part.lower, checked.part.upper, checked.all.evaluations});
    table.add_row(row);
  }
  return seconds;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  experiment.reads_results();
  Settings settings;
  CommandLine& options = experiment.options();
  options.number("--tolerance", settings.tolerance, NumberRange::positive(), "width of the bounds of kappa^-1");
  options.integer("--max-evaluations", settings.max_evaluations, 1, 1'000'000'000,
                  "limit on evaluations in interval arithmetic, of one bound");
  options.integer("--points", settings.points, 8, 100'000, "outline points of the samples");

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        if (session.quick()) {
          settings.points = 90;
          settings.rings = 6;
          settings.orientations = 5;
        }
        const auto lengths = read_chapter_manipulator("M1").lengths;
        std::vector<std::vector<StudiedDesign>> designs;
        std::size_t count = 0;
        for (const ChapterSynthesis& studied : chapter_syntheses) {
          designs.push_back(read_studied_designs(session, studied));
          count += designs.back().size();
        }

        Table table = make_table();
        Table profiles = make_profiles();
        double seconds = 0.0;
        Progress progress(count);
        for (std::size_t i = 0; i < designs.size(); ++i) {
          const ChapterSynthesis& studied = chapter_syntheses[i];
          for (const StudiedDesign& one : designs[i]) {
            progress.begin(
                fmt::format("Table {}, {}, {} {}", studied.table, one.workspace, one.source, one.formulation));
            seconds += check_design(studied, one, read_chapter_problem(studied, one.workspace).task.prescribed,
                                    make_manipulator(one.design, lengths), settings, table, profiles);
          }
        }
        const Table summary = summarise(table);
        session.write(table);
        session.write(summary, "summary");
        session.write(profiles, "profiles");
        session.record("interval_seconds", seconds);
        for (std::size_t row = 0; row < summary.rows(); ++row) {
          const std::string& lowest = summary.text(row, "phi_min_deg");
          const std::string range =
              lowest.empty() ? "" : fmt::format(", {} to {} degrees", lowest, summary.text(row, "phi_max_deg"));
          fmt::print("{:<40} {:>3} claims, {} proved, {} refuted, {} undecided\n",
                     fmt::format("table {}, assumption {}{}", summary.text(row, "table"),
                                 summary.text(row, "assumption"), range),
                     summary.text(row, "claims"), summary.text(row, "proved"), summary.text(row, "refuted"),
                     summary.text(row, "undecided"));
        }
      },
      [](Session& session) { session.draw(draw(session.table("profiles"))); });
}
