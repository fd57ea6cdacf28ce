#include "reprise/workspace/orientation_workspace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edge_normals.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/workspace/limits.hpp"
#include "sinusoid.hpp"

namespace reprise {
namespace {

constexpr double narrowest = 1e-6;  ///< radians; rounding of a limit that is touched makes up less

/// Adds the orientations in [-pi, pi) at which a sinusoid has a level, if it crosses it.
void add_crossings(const Sinusoid& sinusoid, double level, std::vector<double>& orientations) {
  const double size = sinusoid.amplitude.norm();
  const double cosine = (level - sinusoid.constant) / size;
  if (!(std::abs(cosine) < 1.0)) return;
  const double middle = std::atan2(sinusoid.amplitude.y(), sinusoid.amplitude.x());
  for (const double side : {-1.0, 1.0}) {
    const double phi = middle + side * std::acos(cosine);
    orientations.push_back(phi - full_turn * std::floor((phi + pi) / full_turn));
  }
}

}  // namespace

std::vector<Interval> orientation_workspace(const Manipulator& manipulator, const Eigen::Vector2d& u) {
  require(u.allFinite(), "the position", u, "finite");
  const std::vector<Limit> limits = list_limits(manipulator);
  std::vector<double> ends;
  for (const Limit& limit : limits) {
    const Leg& leg = manipulator.leg(limit.leg);
    const Eigen::Vector2d w = u - leg.base_joint;
    if (limit.kind == LimitKind::minimum_length || limit.kind == LimitKind::maximum_length) {
      const double length = limit.kind == LimitKind::minimum_length ? leg.length.lower : leg.length.upper;
      add_crossings(square_length(leg, w), length * length, ends);
    } else {
      const EdgeNormals normals = edge_normals(leg, limit.kind, 0.0);
      add_crossings(edge_distance(leg, limit.kind, normals.lower, w), 0.0, ends);
      add_crossings(edge_distance(leg, limit.kind, normals.upper, w), 0.0, ends);
    }
  }
  double size = 0.0;
  for (const Leg& leg : manipulator.legs()) {
    size = std::max({size, (u - leg.base_joint).norm() + leg.platform_joint.norm(), leg.length.upper});
  }
  const double rounding = 1e-14 * size;
  const auto largest_limit = [&](double phi) {
    double largest = -std::numeric_limits<double>::infinity();
    for (const Limit& limit : limits) {
      const Leg& leg = manipulator.leg(limit.leg);
      largest = std::max(largest, limit_value(leg, limit.kind, leg_vector(leg, {u, phi}), phi));
    }
    return largest;
  };
  if (ends.empty()) {
    if (largest_limit(0.0) <= rounding) return {{-pi, pi}};
    return {};
  }
  // Between two neighbouring ends all orientations are attained or none is.
  std::sort(ends.begin(), ends.end());
  struct Attained {
    Interval interval;
    double least;  ///< of the largest limit, in the middles between ends
  };
  std::vector<Attained> found;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double from = ends[k];
    const double to = k + 1 < ends.size() ? ends[k + 1] : ends.front() + full_turn;
    if (!(to > from)) continue;
    const double middle = largest_limit(0.5 * (from + to));
    if (middle > rounding) continue;
    if (!found.empty() && found.back().interval.upper == from) {
      found.back().interval.upper = to;
      found.back().least = std::min(found.back().least, middle);
    } else {
      found.push_back({{from, to}, middle});
    }
  }
  // The last interval may go on in the first.
  if (!found.empty() && found.back().interval.upper == found.front().interval.lower + full_turn) {
    if (found.size() == 1) return {{-pi, pi}};
    found.back().interval.upper = found.front().interval.upper + full_turn;
    found.back().least = std::min(found.back().least, found.front().least);
    found.erase(found.begin());
  }
  std::vector<Interval> intervals;
  for (const auto& [interval, least] : found) {
    const bool is_single = interval.upper - interval.lower < narrowest && least > -rounding;
    if (!is_single) intervals.push_back(interval);
  }
  return intervals;
}

}  // namespace reprise
