#include "reprise/geometry/region.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/geometry/polygon.hpp"

namespace reprise {
namespace {

/// Edges are a little longer for rays than they are, so that no ray slips through between two of them.
constexpr double overlap = 1e-12;

/// Whether an arc passes a polar angle.
bool nearly_passes(const BoundaryEdge& arc, double angle) {
  const double turn = arc.sweep >= 0.0 ? 1.0 : -1.0;
  double along = std::fmod(turn * (angle - arc.start_angle), full_turn);
  if (along < 0.0) along += full_turn;
  return along <= std::abs(arc.sweep) + overlap || along >= full_turn - overlap;
}

/// x - sin x, to its own rounding.
double less_sine(double x) {
  constexpr double small = 0.5;
  if (std::abs(x) > small) return x - std::sin(x);
  // The series, until its terms no longer count: the eighth is below 1e-20 of the first.
  double term = x * x * x / 6.0;
  double sum = 0.0;
  for (double n = 4.0; n <= 18.0; n += 2.0) {
    sum += term;
    term *= -x * x / (n * (n + 1.0));
  }
  return sum;
}

/// Contribution of an edge to the winding number about a point, as an angle: the angle under which it is seen.
double seen_angle(const BoundaryEdge& edge, const Eigen::Vector2d& point) {
  const Eigen::Vector2d from = edge.start - point;
  const Eigen::Vector2d to = edge.end - point;
  const bool in_circle = edge.is_arc() && (point - edge.centre).squaredNorm() < edge.radius * edge.radius;
  if (!in_circle) return std::atan2(cross(from, to), from.dot(to));
  if (edge.start == edge.end) return edge.sweep >= 0.0 ? full_turn : -full_turn;
  // From within the circle an arc turns one way only, by up to a full turn. Adding 0 makes the angle of a point on the
  // chord pi, not -pi.
  const double turn = edge.sweep >= 0.0 ? 1.0 : -1.0;
  const double angle = std::atan2(turn * cross(from, to) + 0.0, from.dot(to));
  return turn * (angle < 0.0 ? angle + full_turn : angle);
}

/// Smallest distance at which a ray meets the edge; infinity when it does not.
double hit(const BoundaryEdge& edge, const Eigen::Vector2d& from, const Eigen::Vector2d& direction) {
  if (!edge.is_arc()) {
    const Eigen::Vector2d along = edge.end - edge.start;
    const double determinant = cross(direction, along);
    if (determinant == 0.0) return infinity;
    const double r = cross(edge.start - from, along) / determinant;
    const double t = cross(edge.start - from, direction) / determinant;
    return r >= 0.0 && t >= -overlap && t <= 1.0 + overlap ? r : infinity;
  }
  const Eigen::Vector2d to_centre = edge.centre - from;
  const double middle = to_centre.dot(direction);
  const double off = cross(direction, to_centre);
  const double half_square = (edge.radius - off) * (edge.radius + off);
  if (half_square < 0.0) return infinity;
  const double half = std::sqrt(half_square);
  for (const double r : {middle - half, middle + half}) {
    const Eigen::Vector2d at = from + r * direction - edge.centre;
    if (r >= 0.0 && nearly_passes(edge, std::atan2(at.y(), at.x()))) return r;
  }
  return infinity;
}

template <class Function>
void for_each_edge(const Region& region, Function&& function) {
  for (const RegionComponent& component : region.components()) {
    for (const BoundaryEdge& edge : component.outer.edges) function(edge);
    for (const BoundaryLoop& hole : component.holes) {
      for (const BoundaryEdge& edge : hole.edges) function(edge);
    }
  }
}

}  // namespace

double BoundaryEdge::length() const { return is_arc() ? radius * std::abs(sweep) : (end - start).norm(); }

Eigen::Vector2d BoundaryEdge::at(double fraction) const {
  if (!is_arc()) return start + fraction * (end - start);
  const double angle = start_angle + fraction * sweep;
  return centre + radius * unit(angle);
}

double BoundaryEdge::distance(const Eigen::Vector2d& point) const {
  if (!is_arc()) return distance_to_segment(point, start, end);
  const Eigen::Vector2d from_centre = point - centre;
  if (nearly_passes(*this, std::atan2(from_centre.y(), from_centre.x()))) return std::abs(from_centre.norm() - radius);
  return std::min((point - start).norm(), (point - end).norm());
}

double BoundaryLoop::signed_area() const {
  double twice = 0.0;
  for (const BoundaryEdge& edge : edges) {
    // Relative to the first vertex, so that a far origin costs no digits.
    const Eigen::Vector2d& origin = edges.front().start;
    twice += cross(edge.start - origin, edge.end - origin);
    // Between the chord and the arc.
    if (edge.is_arc()) twice += edge.radius * edge.radius * less_sine(edge.sweep);
  }
  return 0.5 * twice + lost_area;
}

bool BoundaryLoop::encloses(const Eigen::Vector2d& point) const {
  double angle = 0.0;
  for (const BoundaryEdge& edge : edges) angle += seen_angle(edge, point);
  return std::abs(angle) > pi;
}

std::vector<Eigen::Vector2d> BoundaryLoop::sample(double spacing) const {
  require(std::isfinite(spacing) && spacing > 0.0, "spacing", spacing, "positive and finite");
  std::vector<Eigen::Vector2d> points;
  for (const BoundaryEdge& edge : edges) {
    const double parts = std::max(std::ceil(edge.length() / spacing), 1.0);
    for (double k = 0.0; k < parts; ++k) points.push_back(k == 0.0 ? edge.start : edge.at(k / parts));
  }
  return points;
}

double Region::area() const {
  double sum = 0.0;
  for (const RegionComponent& component : components_) {
    sum += component.outer.signed_area();
    for (const BoundaryLoop& hole : component.holes) sum += hole.signed_area();
  }
  return sum;
}

double Region::perimeter() const {
  double sum = 0.0;
  for_each_edge(*this, [&](const BoundaryEdge& edge) { sum += edge.length(); });
  return sum;
}

bool Region::contains(const Eigen::Vector2d& point) const {
  double angle = 0.0;
  for_each_edge(*this, [&](const BoundaryEdge& edge) { angle += seen_angle(edge, point); });
  return angle > pi;
}

double Region::distance_to_boundary(const Eigen::Vector2d& point) const {
  double nearest = infinity;
  for_each_edge(*this, [&](const BoundaryEdge& edge) { nearest = std::min(nearest, edge.distance(point)); });
  return nearest;
}

std::optional<double> Region::first_exit(const Eigen::Vector2d& centre, double beta) const {
  const Eigen::Vector2d direction = unit(beta);
  double nearest = infinity;
  for_each_edge(*this, [&](const BoundaryEdge& edge) { nearest = std::min(nearest, hit(edge, centre, direction)); });
  return nearest < infinity ? std::optional(nearest) : std::nullopt;
}

}  // namespace reprise
