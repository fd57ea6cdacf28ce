#pragma once

#include <vector>

namespace reprise::experiments {

/// Median and range of some numbers; of an even count the median is the mean of the two in the middle. Throws
/// std::logic_error when there are none.
struct Spread {
  double median, lowest, highest;
};
Spread spread_of(const std::vector<double>& values);

}  // namespace reprise::experiments
