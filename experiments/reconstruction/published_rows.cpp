#include "reconstruction/published_rows.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "chapter/problems.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

std::vector<PublishedRow> read_published_rows() {
  std::vector<PublishedRow> rows;
  for (const ChapterSynthesis& synthesis : chapter_syntheses) {
    const Table table = read_published(synthesis);
    const CollinearManipulator start = read_start(synthesis);
    std::vector<double> orientations;
    std::optional<Interval> dextrous_range;
    for (const OrientationRange& range : read_orientations(synthesis)) {
      orientations.push_back(range.lower);
      if (range.is_slice()) continue;
      orientations.push_back(range.upper);
      dextrous_range = range;
    }
    for (std::size_t i = 0; i < table.rows(); ++i) {
      PublishedRow row{synthesis.table,
                       synthesis.kind,
                       table.text(i, "workspace"),
                       "as printed",
                       to_vector(start.design),
                       printed_number(table.text(i, "f_d0")),
                       printed_number(table.text(i, "f_star")),
                       printed_number(table.text(i, "g_star")),
                       Eigen::VectorXd(5),
                       Eigen::VectorXd(5),
                       {},
                       start.lengths,
                       orientations,
                       dextrous_range};
      for (std::size_t j = 0; j < design_columns.size(); ++j) {
        const PrintedNumber entry = printed_number(table.text(i, design_columns[j]));
        row.printed[j] = entry.text;
        row.design[static_cast<Eigen::Index>(j)] = entry.value;
        row.rounding[static_cast<Eigen::Index>(j)] = entry.half_unit;
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

PublishedRow with_y_c(const PublishedRow& row, double y_c) {
  PublishedRow changed = row;
  changed.design[1] = y_c;
  changed.reading = fmt::format("y_C = {}", y_c);
  return changed;
}

ReportedSynthesis reported_synthesis(const PublishedRow& row, bool rounded, double protrusion) {
  return {DesignSpace::collinear(row.lengths),
          printed_conditioning,
          row.orientations,
          row.dextrous_range,
          row.start,
          {row.f_d0.value - row.f_d0.half_unit, row.f_d0.value + row.f_d0.half_unit},
          row.design,
          {row.f_star.value - row.f_star.half_unit, row.f_star.value + row.f_star.half_unit},
          rounded ? row.rounding : Eigen::VectorXd(),
          protrusion};
}

}  // namespace reprise::experiments
