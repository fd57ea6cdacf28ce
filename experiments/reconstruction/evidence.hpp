#pragma once

// What the printed rows say of the prescribed workspaces without any family of shapes: which rows, which sizes and
// which digits are compatible with some star-shaped outline at all (compatible_outlines.hpp).

#include <map>
#include <string>
#include <vector>

#include "reconstruction/compatible_outlines.hpp"
#include "reconstruction/published_rows.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

struct EvidenceSettings {
  RaySampling rays{360, 200};
  /// A printed g* allows W_p to stick out by a sliver; it may stick out by this, a length.
  double protrusion = 1e-3;
};

/// The rows with what is compatible with each. Allowances are those of reported_synthesis: the rounding of the design
/// and the protrusion.
class Evidence {
 public:
  /// The nine printed rows, and those with another reading of the design.
  Evidence(std::vector<PublishedRow> rows, const EvidenceSettings& settings);

  const std::vector<PublishedRow>& rows() const { return rows_; }
  const CompatibleOutlines& outlines(std::size_t row) const { return outlines_[row]; }

  /// The row of a table and workspace in this reading if there is one, else as printed.
  std::size_t find(const std::string& table, const std::string& workspace, const std::string& reading) const;

  /// The largest outline that all three tables allow with these divisors (by table).
  CommonOutline common(const std::string& workspace, const std::string& reading,
                       const std::map<std::string, double>& divisors) const;

  /// f(d^0) of Tables 5.4 and 5.5: the slices of the first include the edges of the second, so it cannot be larger
  /// there for the same outline.
  Table compare_start_values() const;

  /// Row by row, the lowest f(d^0) that an outline can have that lies within W_c(d*) and has the printed f*.
  Table describe_regions() const;

  /// Pair by pair of tables, by how much smaller the outline may be in the second.
  Table compare_sizes(const std::map<std::string, std::map<std::string, double>>& divisors_in_data) const;

  /// One-digit changes of a printed row that make it compatible, and the interval of y_C that does.
  Table change_digits(const std::string& table, const std::string& workspace) const;

 private:
  CompatibleOutlines make(const PublishedRow& row, bool allowances, double protrusion) const;

  std::vector<PublishedRow> rows_;
  EvidenceSettings settings_;
  std::vector<CompatibleOutlines> outlines_;
};

/// For each of these rows a panel with the final design's workspace, the largest region that satisfies what is printed
/// of that design, and the curve on which the starting design has the largest kappa^-1 that rounds to the printed
/// f(d^0): an outline must lie within the region and touch the curve. Columns panel, series, piece, x, y.
Table picture_start_value(const Evidence& evidence, const std::vector<std::size_t>& rows);

}  // namespace reprise::experiments
