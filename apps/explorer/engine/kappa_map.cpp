#include "kappa_map.hpp"

#include <algorithm>

namespace reprise::explorer {

double least_kappa_inverse(const ManipulatorInput& input, const Eigen::Vector2d& position, const Interval& range) {
  const double lower = kappa_inverse(input.manipulator, {position, range.lower}, input.conditioning);
  if (range.lower == range.upper) return lower;
  return std::min(lower, kappa_inverse(input.manipulator, {position, range.upper}, input.conditioning));
}

void map_kappa_inverse(const ManipulatorInput& input, const Eigen::AlignedBox2d& box, int columns, int rows,
                       const Interval& range, std::vector<float>& values) {
  values.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const Eigen::Vector2d step = box.sizes().cwiseQuotient(Eigen::Vector2d(columns - 1, rows - 1));
  std::size_t next = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d position = box.min() + step.cwiseProduct(Eigen::Vector2d(column, row));
      values[next++] = static_cast<float>(least_kappa_inverse(input, position, range));
    }
  }
}

}  // namespace reprise::explorer
