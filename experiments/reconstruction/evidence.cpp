#include "reconstruction/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "reconstruction/outline_fit.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/kinematics/conditioning.hpp"

namespace reprise::experiments {

namespace {

/// For the search of digits, many rows are tried at half the resolution.
constexpr int coarser = 2;

/// Sizes are tried in steps of this, relatively.
constexpr double size_step = 1e-3;

/// Far beyond what a printed g* allows: with it, hardly any limit of a leg matters. A length.
constexpr double far_out = 0.1;

const char* yes_or_no(bool yes) { return yes ? "yes" : "no"; }

bool compatible(const CompatibleOutlines& outlines) {
  return outlines.satisfied_by(outlines.attained(outlines.largest()));
}

/// The first and the last of the ratios in [0.6, 1.7] at which an outline divided by 1 in the first synthesis, and by
/// the ratio in the others, is compatible with all.
std::optional<Interval> compatible_ratios(const CompatibleOutlines& first,
                                          const std::vector<const CompatibleOutlines*>& others) {
  std::optional<Interval> found;
  for (double ratio = 0.6; ratio <= 1.7; ratio *= 1.0 + size_step) {
    std::vector<SizedOutlines> sized{{&first, 1.0}};
    for (const CompatibleOutlines* other : others) sized.push_back({other, ratio});
    if (!common_outline(sized).compatible) continue;
    if (!found) found = Interval{ratio, ratio};
    found->upper = ratio;
  }
  return found;
}

/// A decimal number with one of its digits replaced, in all ways.
std::vector<std::string> one_digit_changes(const std::string& text) {
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] < '0' || text[i] > '9') continue;
    for (char digit = '0'; digit <= '9'; ++digit) {
      if (digit == text[i]) continue;
      changed.push_back(text);
      changed.back()[i] = digit;
    }
  }
  return changed;
}

}  // namespace

Evidence::Evidence(std::vector<PublishedRow> rows, const EvidenceSettings& settings)
    : rows_(std::move(rows)), settings_(settings) {
  for (const PublishedRow& row : rows_) outlines_.push_back(make(row, true, settings_.protrusion));
}

CompatibleOutlines Evidence::make(const PublishedRow& row, bool allowances, double protrusion) const {
  return {reported_synthesis(row, allowances, protrusion), outline_centre(), settings_.rays};
}

std::size_t Evidence::find(const std::string& table, const std::string& workspace, const std::string& reading) const {
  std::optional<std::size_t> printed;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].table != table || rows_[i].workspace != workspace) continue;
    if (rows_[i].reading == reading) return i;
    if (!printed) printed = i;
  }
  if (!printed) throw std::runtime_error("Table " + table + " has no row " + workspace + ".");
  return *printed;
}

CommonOutline Evidence::common(const std::string& workspace, const std::string& reading,
                               const std::map<std::string, double>& divisors) const {
  std::vector<SizedOutlines> sized;
  sized.reserve(divisors.size());
  for (const auto& [table, divisor] : divisors) {
    sized.push_back({&outlines_[find(table, workspace, reading)], divisor});
  }
  return common_outline(sized);
}

Table Evidence::compare_start_values() const {
  Table table("f(d^0) of Tables 5.4 and 5.5, which start from the same design",
              {{"workspace", "-", "prescribed workspace"},
               {"f_d0_MO", "-", "printed in Table 5.4: the smallest over the slices -5, 0 and 5 degrees"},
               {"f_d0_D", "-", "printed in Table 5.5: the smallest over the edges -5 and 5 degrees"},
               {"least_excess", "-", "least possible excess of the first over the second, given their rounding"},
               {"same_outline", "-", "whether both may belong to one outline: no when the excess is positive"}});
  for (const PublishedRow& row : rows_) {
    if (row.table != "5.4" || row.reading != "as printed") continue;
    const PublishedRow& other = rows_[find("5.5", row.workspace, row.reading)];
    const double excess = row.f_d0.value - other.f_d0.value - row.f_d0.half_unit - other.f_d0.half_unit;
    table.add_row({row.workspace, row.f_d0.text, other.f_d0.text, excess, yes_or_no(excess <= 0.0)});
  }
  return table;
}

Table Evidence::describe_regions() const {
  Table table("The largest star-shaped region about O' that each printed row allows, and the lowest f(d^0) it can have",
              {{"table", "-", "table of the chapter"},
               {"workspace", "-", "prescribed workspace"},
               {"reading", "-", "as printed, or what is read in place of the printed design"},
               {"f_star", "-", "f* as printed"},
               {"f_d0", "-", "f(d^0) as printed"},
               {"lowest_f_d0", "-",
                "lowest f(d^0) of a region within W_c(d*) with kappa^-1(d*) not below the printed f*; the printed "
                "design taken as exact"},
               {"lowest_f_d0_allowed", "-", "the same with the allowances for rounding and protrusion"},
               {"lowest_f_d0_protruding", "-",
                fmt::format("the same as lowest_f_d0_allowed if W_p might stick out of W_c(d*) by {}", far_out)},
               {"compatible", "-", "whether some star-shaped outline has f*, f(d^0) and the contact, with allowances"},
               {"smallest_radius", "length", "of the largest region that satisfies all that is printed"},
               {"largest_radius", "length", "of the same region"},
               {"rays_with_gaps", "-", "rays on which the conditions hold again beyond that region, within W_c(d*)"}},
              {fmt::format("By sampling: {} directions, {} steps along each up to the boundary of W_c(d*), which is "
                           "exact; linear between the steps.",
                           settings_.rays.directions, settings_.rays.steps),
               fmt::format("Allowances: d* within half a unit of its last digit; W_p sticks out of W_c(d*) by at most "
                           "{} length.",
                           settings_.protrusion)});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const PublishedRow& row = rows_[i];
    const CompatibleOutlines exact = make(row, false, 0.0);
    const CompatibleOutlines& allowed = outlines_[i];
    const auto lowest = [](const CompatibleOutlines& outlines) {
      return outlines.attained(outlines.largest_for_final_design()).start_value;
    };
    const auto [least, most] = std::minmax_element(allowed.largest().begin(), allowed.largest().end());
    table.add_row({row.table, row.workspace, row.reading, row.f_star.text, row.f_d0.text, lowest(exact),
                   lowest(allowed), lowest(make(row, true, far_out)), yes_or_no(compatible(allowed)), *least, *most,
                   allowed.rays_with_gaps()});
  }
  return table;
}

Table Evidence::compare_sizes(const std::map<std::string, std::map<std::string, double>>& divisors_in_data) const {
  Table table("By how much smaller a prescribed workspace may be in one table than in another",
              {{"workspace", "-", "prescribed workspace"},
               {"reading", "-", "as printed, or what is read in place of a printed design"},
               {"first", "-", "table"},
               {"second", "-", "table"},
               {"ratio_lower", "-", "smallest size in the first over size in the second; empty when there is none"},
               {"ratio_upper", "-", "largest such ratio"},
               {"same_size", "-", "whether a ratio of 1 lies between them, as the text has it"},
               {"ratio_in_data", "-", "ratio in examples/P1.toml to P3.toml"},
               {"data_compatible", "-", "whether that ratio lies between them"}},
              {fmt::format("Ratios are tried from 0.6 to 1.7 in steps of {} %, with the allowances for rounding and "
                           "protrusion.",
                           100.0 * size_step)});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      const PublishedRow& first = rows_[i];
      const PublishedRow& second = rows_[j];
      if (first.workspace != second.workspace || first.table >= second.table) continue;
      const auto ratios = compatible_ratios(outlines_[i], {&outlines_[j]});
      const auto& divisors = divisors_in_data.at(first.workspace);
      const double in_data = divisors.at(second.table) / divisors.at(first.table);
      const auto within = [&](double ratio) {
        return yes_or_no(ratios && ratios->lower <= ratio && ratio <= ratios->upper);
      };
      table.add_row({first.workspace, first.reading, first.table, second.table, ratios ? Field(ratios->lower) : Field(),
                     ratios ? Field(ratios->upper) : Field(), within(1.0), in_data, within(in_data)});
    }
  }
  return table;
}

Table Evidence::change_digits(const std::string& table_name, const std::string& workspace) const {
  const PublishedRow& printed = rows_[find(table_name, workspace, "as printed")];
  const RaySampling rays{settings_.rays.directions / coarser, settings_.rays.steps / coarser};
  Table table(fmt::format("Changes of one printed digit that make Table {}, {} compatible", table_name, workspace),
              {{"quantity", "-", "which printed number is changed"},
               {"printed", "-", "as printed"},
               {"lower", "-", "changed to; or the lower end of an interval of any digits"},
               {"upper", "-", "changed to; or the upper end of that interval"},
               {"any_digits", "-", "whether any digits may change (yes), or one only (no)"},
               {"ratio_lower", "-",
                "smallest size in this table over size in Tables 5.4 and 5.5, taken as equal in these, for which one "
                "outline is "
                "compatible with all; empty when there is none"},
               {"ratio_upper", "-", "largest such ratio"}},
              {fmt::format("By sampling: {} directions, {} steps along each; designs are taken as exact.",
                           rays.directions, rays.steps)});
  const auto exact = [&](const PublishedRow& row) {
    return CompatibleOutlines(reported_synthesis(row, false, 0.0), outline_centre(), rays);
  };
  std::vector<CompatibleOutlines> others;
  for (const PublishedRow& row : rows_) {
    if (row.workspace == workspace && row.table != table_name) others.push_back(exact(row));
  }
  std::vector<const CompatibleOutlines*> pointers;
  pointers.reserve(others.size());
  for (const CompatibleOutlines& other : others) pointers.push_back(&other);

  const auto add = [&](const std::string& quantity, const std::string& text, double lower, double upper, bool any,
                       const std::optional<Interval>& ratios) {
    table.add_row({quantity, text, lower, upper, yes_or_no(any), ratios ? Field(ratios->lower) : Field(),
                   ratios ? Field(ratios->upper) : Field()});
  };
  const auto try_changes = [&](const std::string& quantity, const std::string& text, const auto& change) {
    for (const std::string& other : one_digit_changes(text)) {
      PublishedRow row = printed;
      const PrintedNumber number = printed_number(other);
      change(row, number);
      if (row.f_star.value > 1.0 || row.f_d0.value > 1.0) continue;
      const CompatibleOutlines outlines = exact(row);
      if (!compatible(outlines)) continue;
      add(quantity, text, number.value, number.value, false, compatible_ratios(outlines, pointers));
    }
  };
  try_changes("f_d0", printed.f_d0.text, [](PublishedRow& row, const PrintedNumber& n) { row.f_d0 = n; });
  try_changes("f_star", printed.f_star.text, [](PublishedRow& row, const PrintedNumber& n) { row.f_star = n; });
  const std::vector<std::string> names = DesignSpace::collinear(printed.lengths).names();
  for (std::size_t j = 0; j < names.size(); ++j) {
    try_changes(names[j], printed.printed[j],
                [j](PublishedRow& row, const PrintedNumber& n) { row.design[static_cast<Eigen::Index>(j)] = n.value; });
  }
  // Any y_C about the printed one, in steps of 0.0005.
  std::optional<Interval> any;
  for (int step = -200; step <= 200; ++step) {
    const double y_c = printed.design[1] + 5e-4 * step;
    const CompatibleOutlines outlines = exact(with_y_c(printed, y_c));
    if (!compatible(outlines)) continue;
    if (!any) any = Interval{y_c, y_c};
    any->upper = y_c;
  }
  if (any) add("y_C", printed.printed[1], any->lower, any->upper, true, {});
  return table;
}

Table picture_start_value(const Evidence& evidence, const std::vector<std::size_t>& rows) {
  Table table("What an outline must touch, and what it may not leave",
              {{"panel", "-", "title of the panel"},
               {"series", "-", "workspace, region, or level: the curve of the printed f(d^0), rounded up"},
               {"piece", "-", "number of a connected piece of the series"},
               {"x", "length", "x coordinate"},
               {"y", "length", "y coordinate"}});
  for (const std::size_t index : rows) {
    const PublishedRow& row = evidence.rows()[index];
    const CompatibleOutlines& outlines = evidence.outlines(index);
    const std::string panel = fmt::format("Table {}, {}, {}", row.table, row.workspace, row.reading);
    const auto add = [&](const char* series, int piece, double beta, double radius) {
      const Eigen::Vector2d u = outline_centre() + radius * unit(beta);
      table.add_row({panel, series, piece, u.x(), u.y()});
    };
    const auto add_closed = [&](const char* series, const std::vector<double>& radii) {
      for (std::size_t i = 0; i <= radii.size(); ++i) {
        const std::size_t ray = i % radii.size();
        add(series, 0, outlines.direction(ray), radii[ray]);
      }
    };
    add_closed("workspace", outlines.workspace());
    add_closed("region", outlines.largest_for_final_design());

    // The first point of every ray at which the level is reached, a little beyond the workspace.
    const Manipulator start = make_manipulator(to_collinear_design(row.start), row.lengths);
    const double level = row.f_d0.value + row.f_d0.half_unit;
    const double reach = 1.1 * *std::max_element(outlines.workspace().begin(), outlines.workspace().end());
    constexpr int steps = 400;
    int piece = 0;
    bool drawing = false;
    for (std::size_t i = 0; i <= outlines.directions(); ++i) {
      const double beta = outlines.direction(i % outlines.directions());
      const auto value = [&](double radius) {
        double least = 1.0;
        for (const double phi : row.orientations) {
          least = std::min(
              least, kappa_inverse(start, {outline_centre() + radius * unit(beta), phi}, {Normalisation::printed, {}}));
        }
        return least;
      };
      std::optional<double> crossing;
      double before = value(0.0);
      for (int step = 1; step <= steps && !crossing; ++step) {
        const double here = value(reach * step / steps);
        if (here < level) crossing = reach * (step - 1 + (before - level) / (before - here)) / steps;
        before = here;
      }
      if (drawing && !crossing) ++piece;
      drawing = crossing.has_value();
      if (crossing) add("level", piece, beta, *crossing);
    }
  }
  return table;
}

}  // namespace reprise::experiments
