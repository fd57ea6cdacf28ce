#pragma once

#include <string>

namespace reprise::experiments {

/// A gnuplot command that puts tics at powers of ten on the logarithmic axis "x" or "y", from `lower` > 0 to `upper`,
/// every `step`-th one; with labels such as 10⁻⁶ or with empty ones. It does without gnuplot's markup, which would
/// change what names with underscores look like.
std::string power_tics(const std::string& axis, double lower, double upper, bool labelled, int step = 1);

}  // namespace reprise::experiments
