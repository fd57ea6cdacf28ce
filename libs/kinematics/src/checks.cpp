#include "checks.hpp"

#include <cmath>

#include "reprise/base/require.hpp"

namespace reprise {

void check_size(const char* name, Eigen::Index size, Eigen::Index expected) {
  if (size != expected) reject(name, std::to_string(size), std::to_string(expected));
}

void check_finite(const char* name, const Pose& pose) {
  const Eigen::Vector3d coordinates(pose.position.x(), pose.position.y(), pose.orientation);
  require(coordinates.allFinite(), name, coordinates, "finite");
}

}  // namespace reprise
