#include "reprise/kinematics/joint_angles.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"

namespace reprise {

double wrap_angle(double angle) { return std::remainder(angle, 2.0 * pi); }

double base_angle(const Leg& leg, const Pose& pose) {
  const Eigen::Vector2d a = leg_vector(leg, pose);
  if (a.isZero(0.0)) return std::numeric_limits<double>::quiet_NaN();
  return std::atan2(a.y(), a.x());
}

double platform_angle(const Leg& leg, const Pose& pose) { return wrap_angle(base_angle(leg, pose) - pose.orientation); }

double angle_margin(const Interval& interval, double angle) {
  const double width = interval.upper - interval.lower;
  if (!(width > 0.0 && width <= 2.0 * pi)) {
    throw std::invalid_argument("angle interval is [" + shown(interval.lower) + ", " + shown(interval.upper) +
                                "] rad, but its bounds must be finite and its width between 0 and 2 pi");
  }
  const double middle = interval.lower + 0.5 * width;
  return 0.5 * width - std::abs(wrap_angle(angle - middle));
}

bool contains_angle(const Interval& interval, double angle) { return angle_margin(interval, angle) >= 0.0; }

}  // namespace reprise
