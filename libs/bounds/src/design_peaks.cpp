#include "design_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace reprise::rigorous {
namespace {

/// Indices of values that are not below their neighbours, the last and the first being neighbours too.
template <class Visit>
void for_local_maxima(const std::vector<double>& values, const Visit& visit) {
  const std::size_t size = values.size();
  for (std::size_t k = 0; k < size; ++k) {
    if (values[k] >= values[(k + 1) % size] && values[k] > values[(k + size - 1) % size]) visit(k);
  }
}

double reach_of(const WithGradient<double>& function, const Variables<double>& reach, int variables) {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(variables); ++i)
    sum += std::abs(function.gradient[i]) * reach[i];
  return sum;
}

}  // namespace

DesignPeaks::DesignPeaks(const DesignFamily& family, const OutlineCurve& curve, int count)
    : family_(family), curve_(curve), parameters_(curve.spread(count)) {
  for (const double sigma : parameters_) positions_.push_back(curve.position(sigma));
  step_ = static_cast<double>(curve.pieces()) / static_cast<double>(parameters_.size());
}

/// The parameter of the largest value near one that is not below its neighbours, by parabolas through three points. It
/// is rounded to the 24 bits of a short number, which certificates have room for.
template <class Function>
double DesignPeaks::climb(double sigma, const Function& function) const {
  double step = 0.5 * step_;
  double best = function(sigma);
  for (int round = 0; round < 5; ++round) {
    const double before = function(sigma - step);
    const double after = function(sigma + step);
    const double bend = before - 2.0 * best + after;
    double move = bend < 0.0 ? 0.5 * step * (before - after) / bend : (after > before ? step : -step);
    move = std::clamp(move, -step, step);
    double there = function(sigma + move);
    for (const auto& [value, way] : {std::pair{before, -step}, std::pair{after, step}}) {
      if (value > there) {
        there = value;
        move = way;
      }
    }
    if (there > best) {
      best = there;
      sigma += move;
    }
    step *= 0.2;
  }
  const double count = static_cast<double>(curve_.pieces());
  const double whole = std::floor(sigma);
  const double rounded = whole + static_cast<double>(static_cast<float>(sigma - whole));
  return rounded - count * std::floor(rounded / count);
}

OutlinePose DesignPeaks::pose(std::size_t orientation, double sigma) const {
  const auto [piece, t] = curve_.split(sigma);
  return {orientation, piece, static_cast<double>(static_cast<float>(t))};
}

std::vector<DesignPeak> DesignPeaks::of_conditioning(const Variables<double>& z, std::size_t most) const {
  std::vector<DesignPeak> peaks;
  std::vector<double> values(positions_.size());
  for (const std::size_t index : family_.conditioned()) {
    const Orientation& orientation = family_.orientations()[index];
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      values[k] = squared_condition_at(family_, orientation, positions_[k], z);
    }
    for_local_maxima(values, [&](std::size_t k) {
      const double sigma = climb(parameters_[k], [&](double at) {
        return squared_condition_at(family_, orientation, curve_.position(at), z);
      });
      const Eigen::Vector2d u = curve_.position(sigma);
      const auto function = squared_condition<double>(family_, orientation, Vector2<double>{u.x(), u.y()}, z);
      if (!function || !std::isfinite(function->value)) return;
      peaks.push_back({{false, 1.0, pose(index, sigma), 0, LegSide::too_long}, u, *function});
    });
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const DesignPeak& a, const DesignPeak& b) { return a.function.value > b.function.value; });
  if (peaks.size() > most) peaks.resize(most);
  return peaks;
}

std::vector<DesignPeak> DesignPeaks::of_limits(const Variables<double>& z, const Variables<double>& reach,
                                               double most) const {
  std::vector<DesignPeak> peaks;
  std::vector<double> values(positions_.size());
  const std::vector<Orientation>& orientations = family_.orientations();
  for (std::size_t index = 0; index < orientations.size(); ++index) {
    for (std::size_t leg = 0; leg < 3; ++leg) {
      for (const LegSide side : {LegSide::too_short, LegSide::too_long}) {
        const auto slack = [&](const Eigen::Vector2d& u) {
          return limit_slack<double>(family_, leg, side, orientations[index], {u.x(), u.y()}, z);
        };
        const double sign = side == LegSide::too_long ? 1.0 : -1.0;
        const double limit = sign > 0.0 ? family_.length(leg).upper : family_.length(leg).lower;
        const auto violation = [&](const Eigen::Vector2d& u) {
          const Vector2<double> v = leg_vector<double>(family_, leg, orientations[index], {u.x(), u.y()}, z);
          return sign * (v.x * v.x + v.y * v.y - limit * limit);
        };
        for (std::size_t k = 0; k < positions_.size(); ++k) values[k] = violation(positions_[k]);
        for_local_maxima(values, [&](std::size_t k) {
          if (-values[k] - reach_of(slack(positions_[k]), reach, family_.variables()) > most) return;
          const double sigma = climb(parameters_[k], [&](double at) { return violation(curve_.position(at)); });
          const Eigen::Vector2d u = curve_.position(sigma);
          peaks.push_back({{true, 1.0, pose(index, sigma), leg, side}, u, slack(u)});
        });
      }
    }
  }
  return peaks;
}

DesignPeaks::Worth DesignPeaks::at_points(const Variables<double>& z) const {
  Worth worth{0.0, 0.0};
  const std::vector<Orientation>& orientations = family_.orientations();
  for (const std::size_t index : family_.conditioned()) {
    for (const Eigen::Vector2d& u : positions_) {
      worth.squared_condition =
          std::max(worth.squared_condition, squared_condition_at(family_, orientations[index], u, z));
    }
  }
  for (const Orientation& orientation : orientations) {
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const double least = squared(family_.length(leg).lower);
      const double most = squared(family_.length(leg).upper);
      for (const Eigen::Vector2d& u : positions_) {
        const Vector2<double> v = leg_vector<double>(family_, leg, orientation, {u.x(), u.y()}, z);
        const double length = v.x * v.x + v.y * v.y;
        worth.violation = std::max({worth.violation, length - most, least - length});
      }
    }
  }
  return worth;
}

}  // namespace reprise::rigorous
