#include "checks.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace reprise {

void check_size(const char* name, Eigen::Index size, Eigen::Index expected) {
  if (size == expected) return;
  std::ostringstream message;
  message << name << " is " << size << ", but it must be " << expected;
  throw std::invalid_argument(message.str());
}

void check_finite(const char* name, const Pose& pose) {
  if (pose.position.allFinite() && std::isfinite(pose.orientation)) return;
  std::ostringstream message;
  message << name << " is (" << pose.position.x() << ", " << pose.position.y() << ", " << pose.orientation
          << " rad), but all its coordinates must be finite";
  throw std::invalid_argument(message.str());
}

}  // namespace reprise
