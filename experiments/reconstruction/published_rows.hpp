#pragma once

// The rows of Tables 5.3 to 5.5 as evidence: what is printed, to which rounding, and at which settings it was computed.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "chapter/printed_number.hpp"
#include "reconstruction/compatible_outlines.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise::experiments {

/// One row of a table.
struct PublishedRow {
  std::string table;      ///< 5.3, 5.4 or 5.5
  std::string synthesis;  ///< SO, MO or D
  std::string workspace;  ///< P1, P2 or P3
  std::string reading;    ///< "as printed", or what is read in place of the printed design
  Eigen::VectorXd start;  ///< d^0, exact
  PrintedNumber f_d0;
  PrintedNumber f_star;
  PrintedNumber g_star;
  Eigen::VectorXd design;              ///< d*
  Eigen::VectorXd rounding;            ///< half a unit of the last digit of its entries
  std::array<std::string, 5> printed;  ///< its entries as printed
  std::array<Interval, 3> lengths;     ///< of the legs
  std::vector<double> orientations;    ///< at which kappa^-1 is taken: 0; -5, 0, 5; the edges -5, 5 degrees; radians
  std::optional<Interval> dextrous_range;  ///< D synthesis: [-5, 5] degrees
};

/// All nine rows as printed, table by table, from data/published and examples.
std::vector<PublishedRow> read_published_rows();

/// The same row with another y_C, to the same rounding.
PublishedRow with_y_c(const PublishedRow& row, double y_c);

/// What the row says of the outline. Without allowances its design is taken as exact. With them the design is within
/// its rounding, and W_p may stick out of W_c by the given length.
ReportedSynthesis reported_synthesis(const PublishedRow& row, bool rounded, double protrusion);

}  // namespace reprise::experiments
