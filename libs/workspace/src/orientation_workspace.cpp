#include "reprise/workspace/orientation_workspace.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "edge_normals.hpp"
#include "reprise/base/require.hpp"
#include "reprise/workspace/limits.hpp"
#include "sinusoid.hpp"

namespace reprise {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// Adds the orientations in [-pi, pi) at which a sinusoid has a level, if it crosses it.
void add_crossings(const Sinusoid& sinusoid, double level, std::vector<double>& orientations) {
  const double size = sinusoid.amplitude.norm();
  const double cosine = (level - sinusoid.constant) / size;
  if (!(std::abs(cosine) < 1.0)) return;
  const double middle = std::atan2(sinusoid.amplitude.y(), sinusoid.amplitude.x());
  for (const double side : {-1.0, 1.0}) {
    const double phi = middle + side * std::acos(cosine);
    orientations.push_back(phi - full_turn * std::floor((phi + std::numbers::pi) / full_turn));
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
  const auto attained = [&](double phi) {
    return std::all_of(limits.begin(), limits.end(), [&](const Limit& limit) {
      const Leg& leg = manipulator.leg(limit.leg);
      return limit_value(leg, limit.kind, leg_vector(leg, {u, phi}), phi) <= 0.0;
    });
  };
  if (ends.empty()) {
    if (attained(0.0)) return {{-std::numbers::pi, std::numbers::pi}};
    return {};
  }
  // Between two neighbouring ends all orientations are attained or none is.
  std::sort(ends.begin(), ends.end());
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double from = ends[k];
    const double to = k + 1 < ends.size() ? ends[k + 1] : ends.front() + full_turn;
    if (!(to > from) || !attained(0.5 * (from + to))) continue;
    if (!intervals.empty() && intervals.back().upper == from) {
      intervals.back().upper = to;
    } else {
      intervals.push_back({from, to});
    }
  }
  // The last interval may go on in the first.
  if (!intervals.empty() && intervals.back().upper == intervals.front().lower + full_turn) {
    if (intervals.size() == 1) return {{-std::numbers::pi, std::numbers::pi}};
    intervals.back().upper = intervals.front().upper + full_turn;
    intervals.erase(intervals.begin());
  }
  return intervals;
}

}  // namespace reprise
