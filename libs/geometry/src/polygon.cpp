#include "reprise/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

double angle_of(const Eigen::Vector2d& a) { return std::atan2(a.y(), a.x()); }

}  // namespace

double signed_area(std::span<const Eigen::Vector2d> vertices) {
  if (vertices.size() < 3) return 0.0;
  // Relative to the first vertex, so that a far origin costs no digits.
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    twice += cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
  }
  return 0.5 * twice;
}

double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point - from - t * along).norm();
}

bool contains(std::span<const Eigen::Vector2d> vertices, const Eigen::Vector2d& point) {
  int winding = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector2d from = vertices[i] - point;
    const Eigen::Vector2d to = vertices[(i + 1) % vertices.size()] - point;
    if ((from.y() <= 0.0) == (to.y() <= 0.0)) continue;
    const bool upward = to.y() > 0.0;
    if (upward == (cross(from, to) > 0.0)) winding += upward ? 1 : -1;
  }
  return winding != 0;
}

PolarBoundary::PolarBoundary(std::span<const Eigen::Vector2d> vertices, const Eigen::Vector2d& centre) {
  const std::size_t n = vertices.size();
  if (n < 3) throw std::invalid_argument("a polygon has " + std::to_string(n) + " vertices, but needs at least 3");
  std::vector<Eigen::Vector2d> relative(n);
  for (std::size_t i = 0; i < n; ++i) {
    relative[i] = vertices[i] - centre;
    if (!relative[i].allFinite()) {
      throw std::invalid_argument("vertex " + std::to_string(i + 1) +
                                  " relative to the centre is not finite, but it must be");
    }
  }
  centre_inside_ = contains(vertices, centre);

  std::vector<double> angles(n);
  std::transform(relative.begin(), relative.end(), angles.begin(), angle_of);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return angles[a] < angles[b]; });
  std::vector<std::size_t> rank(n);
  angles_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    rank[order[k]] = k;
    angles_[k] = angles[order[k]];
  }

  // Calls visit(sector, edge) for every sector an edge is seen across: once to count, once to fill.
  const auto for_each_sector = [&](auto&& visit) {
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t from = i;
      std::size_t to = (i + 1) % n;
      if (cross(relative[from], relative[to]) < 0.0) std::swap(from, to);
      if (angles[from] == angles[to]) continue;
      for (std::size_t k = rank[from]; k != rank[to]; k = (k + 1) % n) visit(k, Edge{relative[from], relative[to]});
    }
  };
  sector_begin_.assign(n + 1, 0);
  for_each_sector([&](std::size_t sector, const Edge&) { ++sector_begin_[sector + 1]; });
  std::partial_sum(sector_begin_.begin(), sector_begin_.end(), sector_begin_.begin());
  sector_edges_.resize(sector_begin_.back());
  std::vector<std::size_t> next(sector_begin_.begin(), sector_begin_.end() - 1);
  for_each_sector([&](std::size_t sector, const Edge& edge) { sector_edges_[next[sector]++] = edge; });
}

double PolarBoundary::radius_in_sector(std::size_t sector, const Eigen::Vector2d& direction) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = sector_begin_[sector]; k < sector_begin_[sector + 1]; ++k) {
    const Edge& edge = sector_edges_[k];
    const double before = cross(edge.from, direction);
    const double after = cross(direction, edge.to);
    const double sum = before + after;
    // Clamped, since rounding may put the direction slightly beside the edge.
    const double t = sum > 0.0 ? std::clamp(before / sum, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, direction.dot(edge.from + t * (edge.to - edge.from)));
  }
  return nearest;
}

double PolarBoundary::radius(double beta) const {
  if (!centre_inside_) return 0.0;
  const std::size_t n = angles_.size();
  const double angle = std::remainder(beta, 2.0 * pi);
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  const auto after = std::upper_bound(angles_.begin(), angles_.end(), angle);
  std::size_t sector = (static_cast<std::size_t>(after - angles_.begin()) + n - 1) % n;
  double nearest = radius_in_sector(sector, direction);
  // At a vertex the edges on its other side count as well.
  for (std::size_t k = 0; k < n && angles_[sector] == angle; ++k) {
    sector = (sector + n - 1) % n;
    nearest = std::min(nearest, radius_in_sector(sector, direction));
  }
  return std::max(nearest, 0.0);
}

}  // namespace reprise
