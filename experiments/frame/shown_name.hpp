#pragma once

#include <string>

namespace reprise::experiments {

/// What people call a solver or another thing by its name in the tables: "Dynamic-Q, dual" for dynamic_q_dual. The
/// report reads the same file, data/names.csv. A name that is not there is shown with blanks for its underscores.
std::string shown_name(const std::string& name);

}  // namespace reprise::experiments
