#include "frame/spread.hpp"

#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <stdexcept>

namespace reprise::experiments {

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) throw std::logic_error("nothing has no median");
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  std::vector<double> reordered = values;  // by the median
  return {boost::math::statistics::median(reordered), *lowest, *highest};
}

}  // namespace reprise::experiments
