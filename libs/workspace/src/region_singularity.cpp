#include "reprise/workspace/region_singularity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

/// Where a function changes its sign between two numbers, to the last bit.
template <class Function>
double bisect(Function&& function, double from, double to) {
  const bool positive = function(from) > 0.0;
  while (true) {
    const double middle = 0.5 * (from + to);
    if (middle == from || middle == to) return middle;
    ((function(middle) > 0.0) == positive ? from : to) = middle;
  }
}

/// The search in one component.
class Search {
 public:
  Search(const RegionComponent& component, const SingularityPolynomial& polynomial)
      : component_(component), polynomial_(polynomial) {}

  /// Appends zeros, and the position where |D| is least.
  void run(std::vector<Eigen::Vector2d>& positions) {
    search(component_.outer);
    for (const BoundaryLoop& hole : component_.holes) search(hole);
    if (polynomial_.quadratic.determinant() != 0.0) {
      const Eigen::Vector2d w = -0.5 * polynomial_.quadratic.inverse() * polynomial_.linear;
      const Eigen::Vector2d centre = polynomial_.centre + polynomial_.unit * w;
      if (w.allFinite() && Region({component_}).contains(centre)) consider(centre);
    }
    // Where no edge crosses the curve but D has both signs, the curve runs between a loop and what is inside of it.
    if (zeros_.empty() && least_ > 0.0 && lowest_ < 0.0 && highest_ > 0.0) search_between();
    positions.insert(positions.end(), zeros_.begin(), zeros_.end());
    positions.push_back(nearest_);
  }

 private:
  void consider(const Eigen::Vector2d& position) {
    const double value = polynomial_.at(position);
    if (std::abs(value) < least_) {
      least_ = std::abs(value);
      nearest_ = position;
    }
    if (value < lowest_) {
      lowest_ = value;
      lowest_at_ = position;
    }
    if (value > highest_) {
      highest_ = value;
      highest_at_ = position;
    }
  }

  void search(const BoundaryLoop& loop) {
    for (const BoundaryEdge& edge : loop.edges) search(edge);
  }

  /// Between its extremes along an edge D changes its sign at most once.
  void search(const BoundaryEdge& edge) {
    const auto value = [&](double place) { return polynomial_.at(edge.at(place)); };
    const auto slope = [&](double place) {
      Eigen::Vector2d along = edge.end - edge.start;
      if (edge.is_arc()) along = edge.sweep * quarter_turned(unit(edge.start_angle + place * edge.sweep));
      return polynomial_.gradient(edge.at(place)).dot(along);
    };
    // At most four extremes lie on a full circle. Two that share a step differ by less than rounding would show.
    constexpr double steps_of_circle = 128.0;
    const double turns = edge.is_arc() ? std::abs(edge.sweep) / (2.0 * pi) : 0.0;
    const double steps = std::max(8.0, std::ceil(steps_of_circle * turns));
    places_.clear();
    for (double step = 0.0; step <= steps; ++step) {
      const double place = step / steps;
      if (step > 0.0 && slope(places_.back()) * slope(place) < 0.0) {
        places_.push_back(bisect(slope, places_.back(), place));
      }
      places_.push_back(place);
    }
    for (std::size_t k = 0; k < places_.size(); ++k) {
      consider(edge.at(places_[k]));
      if (k > 0 && value(places_[k - 1]) * value(places_[k]) < 0.0) {
        zeros_.push_back(edge.at(bisect(value, places_[k - 1], places_[k])));
      }
    }
  }

  /// Along the way from the lowest value to the highest, as far as it runs inside.
  void search_between() {
    const Region region({component_});
    const auto at = [&](double part) { return Eigen::Vector2d(lowest_at_ + part * (highest_at_ - lowest_at_)); };
    const auto value = [&](double part) { return polynomial_.at(at(part)); };
    constexpr int parts = 4096;
    for (int k = 1; k < parts - 1; ++k) {
      const double from = static_cast<double>(k) / parts;
      const double to = static_cast<double>(k + 1) / parts;
      if (value(from) * value(to) > 0.0 || !region.contains(at(from)) || !region.contains(at(to))) continue;
      zeros_.push_back(at(bisect(value, from, to)));
      return;
    }
  }

  const RegionComponent& component_;
  const SingularityPolynomial& polynomial_;
  double least_ = std::numeric_limits<double>::infinity();
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
  Eigen::Vector2d nearest_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d lowest_at_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d highest_at_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> zeros_;
  std::vector<double> places_;
};

}  // namespace

std::vector<Eigen::Vector2d> nearest_to_singular(const Region& region, const SingularityPolynomial& polynomial) {
  std::vector<Eigen::Vector2d> positions;
  for (const RegionComponent& component : region.components()) Search(component, polynomial).run(positions);
  return positions;
}

}  // namespace reprise
