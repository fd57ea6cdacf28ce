#pragma once

// The pictures of the reconstruction.

#include <string>
#include <vector>

#include "reconstruction/evidence.hpp"
#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/io/figure.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

/// What is pictured of one prescribed workspace, about O' and before the division by the factors of the tables.
struct PicturedOutlines {
  std::string workspace;
  std::string reading;                     ///< of Table 5.3
  std::map<std::string, double> divisors;  ///< by table, for the largest region
  std::vector<Shape> compatible;           ///< outlines within the allowances; their envelope is drawn
  Shape in_data;
  std::vector<std::pair<std::string, Shape>> others;  ///< with their names
};

/// A table with the columns panel, series, piece, x and y. Series: "region", the largest that all tables allow; "inner"
/// and "outer", the envelope of the compatible outlines; "data"; the names of the others; and "f_d0", "f_star" and
/// "limit", the parts of the region's boundary at which some table's printed value or contact is attained.
Table picture_outlines(const Evidence& evidence, const std::vector<PicturedOutlines>& outlines);

Figure draw_outlines(const Table& table);

/// Draws the table of picture_start_value.
Figure draw_start_value(const Table& table);

}  // namespace reprise::experiments
