#include "reprise/geometry/hausdorff_distance.hpp"

#include <array>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/geometry/polygon.hpp"

namespace reprise {
namespace {

namespace geometry = boost::geometry;

/// What is certain of the largest distance of a piece's points from the other set, and where the piece is best cut.
struct Bracket {
  double lower;
  double upper;
  double cut = 0.5;  ///< a fraction of the piece
};

/// The maximum over all pieces. `bracket` brackets the maximum over one piece, `cut` cuts one at a fraction into two.
template <class Piece, class GetBracket, class Cut>
double largest_distance(const std::vector<Piece>& pieces, double resolution, GetBracket&& bracket, Cut&& cut) {
  struct Open {
    double upper;
    double cut;
    Piece piece;
    bool operator<(const Open& other) const { return upper < other.upper; }
  };
  constexpr double relative = 1e-3;
  std::priority_queue<Open> open;
  double largest = 0.0;
  const auto is_settled = [&](double upper) { return upper <= largest + std::max(resolution, relative * largest); };
  const auto add = [&](const Piece& piece) {
    const Bracket here = bracket(piece);
    largest = std::max(largest, here.lower);
    if (!is_settled(here.upper)) open.push({here.upper, here.cut, piece});
  };
  for (const Piece& piece : pieces) add(piece);
  while (!open.empty() && !is_settled(open.top().upper)) {
    const Open top = open.top();
    open.pop();
    for (const Piece& part : cut(top.piece, top.cut)) add(part);
  }
  return largest;
}

/// A straight piece of a polygon.
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

std::vector<Segment> segments_of(std::span<const std::vector<Eigen::Vector2d>> polygons) {
  std::vector<Segment> segments;
  for (const std::vector<Eigen::Vector2d>& polygon : polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      require(polygon[k].allFinite(), "a vertex", polygon[k], "finite");
      segments.push_back({polygon[k], polygon[(k + 1) % polygon.size()]});
    }
  }
  return segments;
}

std::vector<BoundaryEdge> edges_of(const Region& region) {
  std::vector<BoundaryEdge> edges;
  const auto add = [&edges](const BoundaryLoop& loop) {
    edges.insert(edges.end(), loop.edges.begin(), loop.edges.end());
  };
  for (const RegionComponent& component : region.components()) {
    add(component.outer);
    for (const BoundaryLoop& hole : component.holes) add(hole);
  }
  return edges;
}

/// Whether a segment stays within the wedge of an arc, where the nearest point of the arc lies on the ray from its
/// centre.
bool within_wedge(const BoundaryEdge& arc, const Segment& segment) {
  constexpr double rounding = 1e-12;
  const double turn = arc.sweep >= 0.0 ? 1.0 : -1.0;
  const double sweep = std::abs(arc.sweep);
  if (sweep >= full_turn - rounding) return true;
  const Eigen::Vector2d from = segment.from - arc.centre;
  const Eigen::Vector2d to = segment.to - arc.centre;
  double begin = std::fmod(turn * (std::atan2(from.y(), from.x()) - arc.start_angle), full_turn);
  if (begin < -rounding) begin += full_turn;
  if (begin > full_turn - rounding) begin -= full_turn;
  const double end = begin + turn * std::atan2(cross(from, to), from.dot(to));
  return begin <= sweep + rounding && end >= -rounding && end <= sweep + rounding;
}

/// An upper bound of the distances of a segment's points from an edge, given those of its ends.
double farthest(const Segment& segment, const BoundaryEdge& edge, double at_from, double at_to) {
  // The distance from a straight edge is convex.
  if (!edge.is_arc()) return std::max(at_from, at_to);
  if (within_wedge(edge, segment)) {
    const double nearest = distance_to_segment(edge.centre, segment.from, segment.to);
    return std::max({at_from, at_to, std::abs(nearest - edge.radius)});
  }
  return 0.5 * (at_from + at_to + (segment.to - segment.from).norm());
}

double largest_distance_to_edges(const std::vector<Segment>& segments, const std::vector<BoundaryEdge>& edges,
                                 double resolution) {
  const auto bracket = [&edges](const Segment& segment) {
    const Eigen::Vector2d middle = 0.5 * (segment.from + segment.to);
    Bracket result{infinity, infinity};
    double at_from = infinity;
    double at_to = infinity;
    for (const BoundaryEdge& edge : edges) {
      const double from = edge.distance(segment.from);
      const double to = edge.distance(segment.to);
      result.lower = std::min(result.lower, edge.distance(middle));
      if (std::max(from, to) < result.upper) {
        result.upper = std::min(result.upper, farthest(segment, edge, from, to));
      }
      at_from = std::min(at_from, from);
      at_to = std::min(at_to, to);
    }
    result.lower = std::max({result.lower, at_from, at_to});
    result.upper = std::min(result.upper, 0.5 * (at_from + at_to + (segment.to - segment.from).norm()));
    return result;
  };
  const auto cut = [](const Segment& segment, double fraction) {
    const Eigen::Vector2d place = segment.from + fraction * (segment.to - segment.from);
    return std::array{Segment{segment.from, place}, Segment{place, segment.to}};
  };
  return largest_distance(segments, resolution, bracket, cut);
}

/// Finds the nearest of many segments.
class SegmentIndex {
 public:
  explicit SegmentIndex(const std::vector<Segment>& segments) : segments_(segments), tree_(entries(segments)) {}

  /// The nearest segment to a point; there must be one.
  const Segment& nearest(const Eigen::Vector2d& point) const {
    Entry found;
    tree_.query(geometry::index::nearest(Point(point.x(), point.y()), 1), &found);
    return segments_[found.second];
  }

 private:
  using Point = geometry::model::point<double, 2, geometry::cs::cartesian>;
  using Entry = std::pair<geometry::model::segment<Point>, std::size_t>;

  static std::vector<Entry> entries(const std::vector<Segment>& segments) {
    std::vector<Entry> result;
    result.reserve(segments.size());
    for (const auto& [from, to] : segments) {
      result.push_back({{Point(from.x(), from.y()), Point(to.x(), to.y())}, result.size()});
    }
    return result;
  }

  const std::vector<Segment>& segments_;
  geometry::index::rtree<Entry, geometry::index::quadratic<16>> tree_;
};

/// The part of an edge between two fractions of its length.
struct EdgePart {
  const BoundaryEdge* edge;
  double begin;
  double end;
};

/// Where along a part of an edge, as a fraction of the part, a point beside it lies, given the part's middle.
double place_along(const EdgePart& part, const Eigen::Vector2d& middle, const Eigen::Vector2d& point) {
  const BoundaryEdge& edge = *part.edge;
  double from_middle = 0.0;  // as a fraction of the edge
  if (edge.is_arc()) {
    const Eigen::Vector2d a = middle - edge.centre;
    const Eigen::Vector2d b = point - edge.centre;
    from_middle = std::atan2(cross(a, b), a.dot(b)) / edge.sweep;
  } else {
    const Eigen::Vector2d along = edge.end - edge.start;
    from_middle = (point - middle).dot(along) / along.squaredNorm();
  }
  return 0.5 + from_middle / (part.end - part.begin);
}

/// An upper bound of the distances of the points of a part from a segment.
double farthest(const EdgePart& part, const Eigen::Vector2d& middle, const Segment& segment) {
  const BoundaryEdge& edge = *part.edge;
  const double half_angle = 0.5 * (part.end - part.begin) * std::abs(edge.sweep);
  if (half_angle > 0.25 * pi) return infinity;
  const Eigen::Vector2d begin = edge.at(part.begin);
  const Eigen::Vector2d end = edge.at(part.end);
  const auto distance = [&segment](const Eigen::Vector2d& point) {
    return distance_to_segment(point, segment.from, segment.to);
  };
  // The distance from a segment is convex: on a straight part it is largest at an end, and an arc lies within the
  // triangle of its ends and the point where its tangents there meet.
  const double at_ends = std::max(distance(begin), distance(end));
  if (!edge.is_arc()) return at_ends;
  const Eigen::Vector2d outward = (middle - edge.centre) / edge.radius;
  const Eigen::Vector2d tip = edge.centre + edge.radius / std::cos(half_angle) * outward;
  const Eigen::Vector2d along = segment.to - segment.from;
  const double length = along.norm();
  const auto beside = [&](const Eigen::Vector2d& point) {
    const double place = (point - segment.from).dot(along);
    return length > 0.0 && place >= 0.0 && place <= length * length;
  };
  if (!beside(begin) || !beside(end) || !beside(tip)) return std::max(at_ends, distance(tip));
  // The nearest point is inside the segment for the whole arc: the distance is that from a straight line. It is
  // largest at the ends, or where the arc is parallel to the line.
  const Eigen::Vector2d across = quarter_turned(along) / length;
  double result = at_ends;
  for (const double side : {1.0, -1.0}) {
    if (side * across.dot(outward) < std::cos(half_angle)) continue;
    result = std::max(result, std::abs(across.dot(edge.centre - segment.from) + side * edge.radius));
  }
  return result;
}

double largest_distance_to_segments(const std::vector<BoundaryEdge>& edges, const std::vector<Segment>& segments,
                                    double resolution) {
  const SegmentIndex index(segments);
  const auto bracket = [&index](const EdgePart& part) {
    const double half = 0.5 * (part.end - part.begin);
    const Eigen::Vector2d middle = part.edge->at(part.begin + half);
    const Segment& nearest = index.nearest(middle);
    const double at_middle = distance_to_segment(middle, nearest.from, nearest.to);
    Bracket result{at_middle, std::min(at_middle + half * part.edge->length(), farthest(part, middle, nearest))};
    // A part that goes beyond the segment is cut where it does.
    for (const Eigen::Vector2d& end : {nearest.from, nearest.to}) {
      const double place = place_along(part, middle, end);
      constexpr double rounding = 1e-6;
      if (place > rounding && place < 1.0 - rounding) result.cut = place;
    }
    return result;
  };
  const auto cut = [](const EdgePart& part, double fraction) {
    const double place = part.begin + fraction * (part.end - part.begin);
    return std::array{EdgePart{part.edge, part.begin, place}, EdgePart{part.edge, place, part.end}};
  };
  std::vector<EdgePart> parts;
  parts.reserve(edges.size());
  for (const BoundaryEdge& edge : edges) parts.push_back({&edge, 0.0, 1.0});
  return largest_distance(parts, resolution, bracket, cut);
}

}  // namespace

HausdorffDistance hausdorff_distance(std::span<const std::vector<Eigen::Vector2d>> polygons, const Region& region,
                                     double resolution) {
  require(std::isfinite(resolution) && resolution > 0.0, "resolution", resolution, "positive and finite");
  const std::vector<Segment> segments = segments_of(polygons);
  const std::vector<BoundaryEdge> edges = edges_of(region);
  if (segments.empty() || edges.empty()) return {segments.empty() ? 0.0 : infinity, edges.empty() ? 0.0 : infinity};
  return {largest_distance_to_edges(segments, edges, resolution),
          largest_distance_to_segments(edges, segments, resolution)};
}

}  // namespace reprise
