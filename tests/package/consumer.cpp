#include <cmath>
#include <reprise/kinematics/manipulator.hpp>

int main() {
  const reprise::Leg leg{.base_joint = {0.0, 0.0}, .platform_joint = {1.0, 0.0}, .length = {0.0, 10.0}};
  const double length = reprise::leg_length(leg, {.position = {2.0, 4.0}, .orientation = 0.0});
  return std::abs(length - 5.0) < 1e-12 ? 0 : 1;
}
