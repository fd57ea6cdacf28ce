#include "reprise/kinematics/orientation_range.hpp"

#include <algorithm>

#include "reprise/base/require.hpp"

namespace reprise {

std::vector<double> OrientationRange::ends() const {
  if (is_slice()) return {lower};
  return {lower, upper};
}

std::vector<double> OrientationRange::spread(int count) const {
  require(count >= 2, "the number of orientations", count, "at least 2");
  if (is_slice()) return {lower};
  std::vector<double> orientations;
  for (int k = 0; k + 1 < count; ++k) orientations.push_back(lower + k * (upper - lower) / (count - 1));
  orientations.push_back(upper);
  return orientations;
}

std::vector<OrientationRange> slices(const std::vector<double>& orientations) {
  std::vector<OrientationRange> ranges(orientations.size());
  std::transform(orientations.begin(), orientations.end(), ranges.begin(), [](double phi) {
    return OrientationRange{phi, phi};
  });
  return ranges;
}

}  // namespace reprise
