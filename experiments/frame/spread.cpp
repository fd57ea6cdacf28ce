#include "frame/spread.hpp"

#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <stdexcept>

namespace reprise::experiments {

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) throw std::logic_error("nothing has no median");
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  return {boost::math::statistics::median(sorted), sorted.front(), sorted.back()};
}

}  // namespace reprise::experiments
