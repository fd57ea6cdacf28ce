#include "reprise/workspace/exact_workspace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "careful_region.hpp"
#include "edge_normals.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/workspace/limit_evaluator.hpp"

namespace reprise {
namespace {

bool is_line(const LimitCurve& curve) { return curve.radius == 0.0; }
bool is_point(const LimitCurve& curve) { return is_line(curve) && curve.direction.isZero(0.0); }

/// A curve and the leg whose limit is active on it; none where that is not known, or where two legs share the curve.
struct OwnedCurve {
  LimitCurve curve;
  std::optional<std::size_t> leg;
  double source = 0.0;  ///< size of the numbers that its centre was computed from, whose rounding it has
};

/// Two curves that are the same within a distance.
bool coincide(const LimitCurve& a, const LimitCurve& b, double distance) {
  if (is_line(a) != is_line(b)) return false;
  const Eigen::Vector2d between = b.centre - a.centre;
  if (is_line(a)) {
    constexpr double rounding = 1e-14;
    return std::abs(cross(a.direction, b.direction)) <= rounding && std::abs(cross(a.direction, between)) <= distance;
  }
  return between.norm() <= distance && std::abs(a.radius - b.radius) <= distance;
}

/// The points that two curves share, at most two, and the sine of the angle at which they meet there.
struct Crossings {
  std::array<Eigen::Vector2d, 2> positions{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::size_t count = 0;
  double sine = 0.0;
  double missed = 0.0;  ///< the distance between curves that are taken to touch, but do not

  void add(const Eigen::Vector2d& position) { positions[count++] = position; }
  void add_pair(const Eigen::Vector2d& middle, const Eigen::Vector2d& half) {
    add(middle + half);
    add(middle - half);
  }
};

/// A line meets a circle; those that miss each other by less than `gap` touch.
Crossings cross_line_and_circle(const LimitCurve& line, const LimitCurve& circle, double gap) {
  Crossings result;
  const Eigen::Vector2d to_centre = circle.centre - line.centre;
  const double off = std::abs(cross(line.direction, to_centre));
  if (off > circle.radius + gap) return result;
  result.missed = std::max(off - circle.radius, 0.0);
  const double half = std::sqrt(std::max((circle.radius - off) * (circle.radius + off), 0.0));
  result.add_pair(line.centre + line.direction.dot(to_centre) * line.direction, half * line.direction);
  result.sine = half / circle.radius;
  return result;
}

/// Any two curves; those that miss each other by less than `gap` touch.
Crossings cross_curves(const LimitCurve& a, const LimitCurve& b, double gap) {
  if (is_line(a) && !is_line(b)) return cross_line_and_circle(a, b, gap);
  if (is_line(b) && !is_line(a)) return cross_line_and_circle(b, a, gap);
  Crossings result;
  const Eigen::Vector2d between = b.centre - a.centre;
  if (is_line(a)) {
    const double determinant = cross(a.direction, b.direction);
    if (determinant == 0.0) return result;
    result.add(a.centre + cross(between, b.direction) / determinant * a.direction);
    result.sine = std::abs(determinant);
    return result;
  }
  const double distance = between.norm();
  const double sum = a.radius + b.radius;
  const double difference = a.radius - b.radius;
  if (distance == 0.0 || distance > sum + gap || distance < std::abs(difference) - gap) return result;
  result.missed = std::max({distance - sum, std::abs(difference) - distance, 0.0});
  const Eigen::Vector2d direction = between / distance;
  // Heron's formula, which loses nothing near tangency: 4 distance * across is 16 times the triangle's area.
  const double product = (sum + distance) * (sum - distance) * (distance + difference) * (distance - difference);
  double across = std::sqrt(std::max(product, 0.0)) / (2.0 * distance);
  double along = 0.5 * (distance + difference * sum / distance);
  // Where the centres nearly coincide, their distance has lost digits; the points stay on the circles all the same.
  constexpr double nearly_one_centre = 1e-3;
  if (distance < nearly_one_centre * sum) {
    const double onto = a.radius / std::hypot(along, across);
    along *= onto;
    across *= onto;
  }
  result.add_pair(a.centre + along * direction, across * quarter_turned(direction));
  result.sine = across * distance / (a.radius * b.radius);
  return result;
}

/// Whether a curve comes into a box or within a margin of it.
bool meets(const LimitCurve& curve, const Eigen::AlignedBox2d& box, double margin) {
  const Eigen::Vector2d from_centre = box.center() - curve.centre;
  const Eigen::Vector2d half = 0.5 * box.sizes();
  if (is_line(curve)) {
    const Eigen::Vector2d normal = quarter_turned(curve.direction);
    return std::abs(normal.dot(from_centre)) <= normal.cwiseAbs().dot(half) + margin;
  }
  const double farthest = (from_centre.cwiseAbs() + half).norm();
  return box.exteriorDistance(curve.centre) <= curve.radius + margin && farthest >= curve.radius - margin;
}

/// Tells from single legs that a point is not on the boundary of a workspace. Of the crossings of many curves nearly
/// all are not, and to evaluate all limits at each of them takes several times as long.
class Screen {
 public:
  Screen() = default;
  Screen(const Manipulator& manipulator, const std::vector<double>& orientations) {
    legs_.reserve(orientations.size() * manipulator.size());
    const std::vector<Limit> limits = list_limits(manipulator);
    first_limits_.reserve(manipulator.size() + 1);
    for (std::size_t j = 0; j < limits.size(); ++j) {
      if (limits[j].leg == first_limits_.size()) first_limits_.push_back(static_cast<Eigen::Index>(j));
    }
    first_limits_.push_back(static_cast<Eigen::Index>(limits.size()));
    for (const double orientation : orientations) {
      for (std::size_t i = 0; i < manipulator.size(); ++i) {
        const Leg& leg = manipulator.leg(i);
        legs_.push_back({-leg_vector(leg, {Eigen::Vector2d::Zero(), orientation}), leg.length, {}});
      }
      for (const Limit& limit : limits) {
        if (limit.kind == LimitKind::minimum_length || limit.kind == LimitKind::maximum_length) continue;
        legs_[legs_.size() - manipulator.size() + limit.leg].edges.push_back(
            edge_normals(manipulator.leg(limit.leg), limit.kind, orientation));
      }
    }
  }

  /// The limits of a leg, as the first and the one after the last of all limits of the manipulator.
  std::pair<Eigen::Index, Eigen::Index> limits_of(std::size_t leg) const {
    return {first_limits_[leg], first_limits_[leg + 1]};
  }

  /// Whether a position violates a limit by more than a distance, for certain: what every point of the workspace meets
  /// at single orientations, leg by leg. The leg that told last comes first.
  bool excludes(const Eigen::Vector2d& u, double distance) {
    for (std::size_t k = 0; k < legs_.size(); ++k) {
      if (!legs_[k].excludes(u, distance)) continue;
      std::swap(legs_[k], legs_[k / 2]);
      return true;
    }
    return false;
  }

 private:
  struct FixedLeg {
    Eigen::Vector2d centre;
    Interval length;
    std::vector<EdgeNormals> edges;

    bool excludes(const Eigen::Vector2d& u, double distance) const {
      const Eigen::Vector2d a = u - centre;
      const double here = a.norm();
      if (here > length.upper + distance || here < length.lower - distance) return true;
      return std::any_of(edges.begin(), edges.end(), [&](const EdgeNormals& normals) {
        return std::min(normals.lower.dot(a), normals.upper.dot(a)) > distance;
      });
    }
  };

  std::vector<FixedLeg> legs_;
  std::vector<Eigen::Index> first_limits_;
};

/// Puts a region together; see the header. Lengths that rounding can make up are told from real ones by one tolerance.
class Assembly {
 public:
  Assembly(const Limits& limits, std::span<const OwnedCurve> curves, Screen screen = {})
      : evaluator_(limits), box_(limits.box()), candidates_(curves), screen_(std::move(screen)) {}

  /// Nothing where two digits of a difference decide, and distances cannot tell what bounds the region.
  std::optional<Region> run_where_clear() {
    if (box_.isEmpty()) return Region();
    select_curves();
    constexpr double much_larger = 64.0;
    if (source_ > much_larger * extent_ || has_tiny_circle_) return std::nullopt;
    set_tolerance(1e-13);
    cut();
    if (!is_clear_ || !closed()) return std::nullopt;
    return join();
  }

  /// The region by slabs, of the manipulator and the orientations that limits and curves come from.
  Region run_carefully(const Manipulator& manipulator, const Interval& orientations, const Eigen::Vector2d& origin) {
    const auto is_relevant = [this](std::size_t k) {
      const LimitCurve& curve = candidates_[k].curve;
      return !is_point(curve) && meets(curve, box_, margin_about(candidates_[k], extent_));
    };
    const auto is_far = [this, distance = nearly_same * size_ + rounding * source_](const Eigen::Vector2d& u) {
      return screen_.excludes(u, distance) || evaluator_.largest(u) > distance;
    };
    std::vector<BoundaryLoop> loops =
        careful_loops(manipulator, orientations, {origin, extent_, source_, is_relevant, is_far});
    for (BoundaryLoop& loop : loops) {
      for (BoundaryEdge& edge : loop.edges) {
        evaluator_.largest(edge.at(0.5));
        evaluator_.values().maxCoeff(&edge.limit);
      }
    }
    return nest(std::move(loops));
  }

  Region run() {
    if (box_.isEmpty()) return {};
    select_curves();
    // Rounding makes errors of about 1e-15. Where curves lie so close that those decide which of them is the boundary,
    // pieces may be missing or be there twice, and loops do not close: then the curves are told apart less sharply.
    for (const double part : {1e-13, 1e-12, 1e-11, 1e-10, 1e-9}) {
      set_tolerance(part);
      cut();
      if (closed()) break;
    }
    return join();
  }

 private:
  struct Vertex {
    Eigen::Vector2d position;
    double sine;  ///< of the angle between the curves whose crossing the position is
    std::array<std::size_t, 2> curves;
  };

  using Incidence = std::pair<std::size_t, std::size_t>;  ///< a curve, and a vertex on it
  using Place = std::pair<double, std::size_t>;           ///< where on a curve, and the vertex that is there

  /// An edge with the curve that it is on and the vertices it joins.
  struct Piece {
    BoundaryEdge edge;
    Eigen::Vector2d middle;
    std::size_t curve;
    std::size_t from;
    std::size_t to;
    bool used = false;
  };

  /// How far a curve may be from the box, which has the size, and bound the workspace all the same: well above
  /// rounding.
  static double margin_about(const OwnedCurve& owned, double size) {
    return 1e-9 * (reach_of(owned.curve) + size) + rounding * owned.source;
  }
  static double reach_of(const LimitCurve& curve) { return curve.centre.cwiseAbs().maxCoeff() + curve.radius; }

  void set_tolerance(double part) {
    tolerance_ = part * size_;
    same_point_ = std::sqrt(tolerance_ * extent_);
  }

  /// Curves far from the box cannot bound the workspace, and must not set the scale of rounding.
  void select_curves() {
    extent_ = box_.diagonal().norm();
    size_ = std::max({box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff(), extent_});
    relevant_.clear();
    relevant_.reserve(candidates_.size());
    source_ = 0.0;
    for (const OwnedCurve& candidate : candidates_) {
      const LimitCurve& curve = candidate.curve;
      const double reach = reach_of(curve);
      if (is_point(curve) || !meets(curve, box_, margin_about(candidate, size_))) continue;
      relevant_.push_back(candidate);
      size_ = std::max(size_, reach);
      source_ = std::max(source_, candidate.source);
    }
    source_ = std::max(source_, size_);
    // A circle that is hardly more than a point, within the workspace.
    has_tiny_circle_ = std::any_of(relevant_.begin(), relevant_.end(), [this](const OwnedCurve& candidate) {
      const LimitCurve& curve = candidate.curve;
      const double tiny = nearly_same * size_;
      return !is_line(curve) && curve.radius < tiny && evaluator_.largest(curve.centre) <= 2.0 * tiny;
    });
    constexpr double largest = 1e70;  // four lengths are multiplied
    require(size_ <= largest, "the size of the workspace's curves, as seen from the origin,", size_, "at most 1e70");
  }

  void cut() {
    is_clear_ = true;
    curves_.clear();
    curves_.reserve(relevant_.size());
    for (const OwnedCurve& candidate : relevant_) {
      const LimitCurve& curve = candidate.curve;
      const auto known = std::find_if(curves_.begin(), curves_.end(), [&](const OwnedCurve& one) {
        if (!coincide(one.curve, curve, nearly_same * size_)) return false;
        if (!coincide(one.curve, curve, same_length * size_)) is_clear_ = false;
        return coincide(one.curve, curve, 0.5 * tolerance_);
      });
      if (known == curves_.end())
        curves_.push_back(candidate);
      else if (known->leg != candidate.leg)
        known->leg.reset();
    }
    vertices_.clear();
    vertices_.reserve(2 * curves_.size());
    near_.clear();
    incidences_.clear();
    incidences_.reserve(4 * curves_.size());
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      for (std::size_t j = i + 1; j < curves_.size(); ++j) {
        const Crossings crossings = cross_curves(curves_[i].curve, curves_[j].curve, tolerance_);
        for (std::size_t k = 0; k < crossings.count; ++k) {
          if (!on_boundary(crossings.positions[k], curves_[i].leg, curves_[j].leg)) continue;
          // A neck as narrow as this is open all the same.
          if (crossings.missed > same_length * size_) is_clear_ = false;
          const std::size_t vertex = add_vertex({crossings.positions[k], crossings.sine, {i, j}});
          incidences_.push_back({i, vertex});
          incidences_.push_back({j, vertex});
        }
      }
    }
    std::sort(incidences_.begin(), incidences_.end());
    incidences_.erase(std::unique(incidences_.begin(), incidences_.end()), incidences_.end());
    pieces_.clear();
    pieces_.reserve(2 * curves_.size());
    auto next = incidences_.cbegin();
    for (std::size_t curve = 0; curve < curves_.size(); ++curve) {
      places_.clear();
      for (; next != incidences_.cend() && next->first == curve; ++next) {
        places_.emplace_back(place_on(curves_[curve].curve, vertices_[next->second].position), next->second);
      }
      cut(curve);
    }
  }

  /// Whether a crossing of curves of two legs may be where one of them becomes part of the boundary: where the
  /// workspace ends, by a limit of one of the two.
  bool on_boundary(const Eigen::Vector2d& u, std::optional<std::size_t> one, std::optional<std::size_t> other) {
    const double distance = 2.0 * same_point_;
    if (screen_.excludes(u, distance) || !(std::abs(evaluator_.largest(u)) <= same_point_)) return false;
    return !one || !other || !is_slack(*one, distance) || !is_slack(*other, distance);
  }

  /// Whether all limits of a leg are slack by more than a distance, where they were evaluated last.
  bool is_slack(std::size_t leg, double distance) const {
    const auto [begin, end] = screen_.limits_of(leg);
    return evaluator_.values().segment(begin, end - begin).maxCoeff() < -distance;
  }

  /// Crossings closer than same_point are one vertex, at the best conditioned of them: of several, the first.
  std::size_t add_vertex(const Vertex& crossing) {
    std::size_t found = vertices_.size();
    const auto end = near_.upper_bound(crossing.position.x() + same_point_);
    for (auto one = near_.lower_bound(crossing.position.x() - same_point_); one != end; ++one) {
      const std::size_t v = one->second;
      if (v < found && (vertices_[v].position - crossing.position).norm() <= same_point_) found = v;
    }
    if (found != vertices_.size() && vertices_[found].curves != crossing.curves &&
        (vertices_[found].position - crossing.position).norm() > same_length * size_) {
      is_clear_ = false;
    }
    if (found == vertices_.size()) {
      vertices_.push_back(crossing);
    } else if (crossing.sine > vertices_[found].sine) {
      vertices_[found] = crossing;
    } else {
      return found;
    }
    near_.emplace(crossing.position.x(), found);
    return found;
  }

  /// A polar angle on a circle, a distance from `centre` on a line.
  static double place_on(const LimitCurve& curve, const Eigen::Vector2d& position) {
    const Eigen::Vector2d a = position - curve.centre;
    return is_line(curve) ? curve.direction.dot(a) : std::atan2(a.y(), a.x());
  }

  /// Cuts a curve at the places of its vertices.
  void cut(std::size_t index) {
    const LimitCurve& curve = curves_[index].curve;
    std::sort(places_.begin(), places_.end());
    if (!is_line(curve)) {
      if (places_.empty()) {
        vertices_.push_back({curve.centre + Eigen::Vector2d(curve.radius, 0.0), 1.0, {index, index}});
        places_.emplace_back(0.0, vertices_.size() - 1);
      }
      places_.emplace_back(places_.front().first + full_turn, places_.front().second);
    }
    // The workspace is bounded: what is beyond the last vertex on a line is not its boundary.
    for (std::size_t k = 0; k + 1 < places_.size(); ++k) add_piece(index, places_[k], places_[k + 1]);
  }

  void add_piece(std::size_t index, Place from, Place to) {
    const LimitCurve& curve = curves_[index].curve;
    const double place = 0.5 * (from.first + to.first);
    Eigen::Vector2d middle = curve.centre;
    middle += is_line(curve) ? Eigen::Vector2d(place * curve.direction) : Eigen::Vector2d(curve.radius * unit(place));
    if (screen_.excludes(middle, 2.0 * same_point_) || std::abs(evaluator_.largest(middle)) > tolerance_) return;
    const auto is_active = [this](double value) { return value >= -tolerance_; };
    const Eigen::VectorXd& h = evaluator_.values();
    const Eigen::Index active = std::find_if(h.begin(), h.end(), is_active) - h.begin();
    const Eigen::Vector2d outward = evaluator_.gradient(middle, active);
    // Two limits that face each other leave no area between them.
    for (Eigen::Index j = active + 1; j < h.size(); ++j) {
      if (is_active(h[j]) && evaluator_.gradient(middle, j).dot(outward) < 0.0) return;
    }
    // The middle alone may be a point where the curve only touches a limit.
    for (const double fraction : {0.3, 0.7}) {
      const double elsewhere = from.first + fraction * (to.first - from.first);
      Eigen::Vector2d other = curve.centre;
      other += is_line(curve) ? Eigen::Vector2d(elsewhere * curve.direction)
                              : Eigen::Vector2d(curve.radius * unit(elsewhere));
      if (std::abs(evaluator_.largest(other)) > same_point_) return;
    }
    // The region is on the left: opposite to the outward direction.
    const Eigen::Vector2d from_centre = middle - curve.centre;
    const Eigen::Vector2d forward = is_line(curve) ? curve.direction : quarter_turned(from_centre);
    if (cross(forward, outward) > 0.0) std::swap(from, to);
    // Of two curves that cannot be told apart, one is enough. Full circles about one centre share no vertex.
    const bool known = std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& one) {
      const bool same_ends = one.from == from.second && one.to == to.second;
      const bool full_circles =
          one.from == one.to && from.second == to.second && (one.edge.sweep > 0.0) == (to.first > from.first);
      return (same_ends || full_circles) && (one.middle - middle).norm() <= 4.0 * tolerance_;
    });
    if (known) return;
    BoundaryEdge edge;
    edge.start = vertices_[from.second].position;
    edge.end = vertices_[to.second].position;
    edge.limit = active;
    if (!is_line(curve)) {
      edge.centre = curve.centre;
      edge.radius = curve.radius;
      edge.start_angle = from.first;
      edge.sweep = to.first - from.first;
    }
    pieces_.push_back({edge, middle, index, from.second, to.second});
  }

  /// Whether as many pieces end at every vertex as start there. Then they can be joined to loops, in whatever way.
  bool closed() const {
    std::vector<int> balance(vertices_.size(), 0);
    for (const Piece& piece : pieces_) {
      ++balance[piece.from];
      --balance[piece.to];
    }
    return std::all_of(balance.begin(), balance.end(), [](int difference) { return difference == 0; });
  }

  Region join() {
    std::vector<BoundaryLoop> loops;
    std::vector<std::size_t> walk;
    for (std::size_t first = 0; first < pieces_.size(); ++first) {
      if (pieces_[first].used) continue;
      walk.clear();
      std::optional<std::size_t> here = first;
      do {
        pieces_[*here].used = true;
        walk.push_back(*here);
        here = successor(*here, first);
      } while (here && *here != first);
      if (here) loops.push_back(loop_of(walk));
    }
    return nest(std::move(loops));
  }

  /// The direction in which an edge leaves its start or arrives at its end.
  static Eigen::Vector2d heading(const BoundaryEdge& edge, bool at_end) {
    if (!edge.is_arc()) return (edge.end - edge.start).normalized();
    const double angle = edge.start_angle + (at_end ? edge.sweep : 0.0);
    const Eigen::Vector2d counter_clockwise = quarter_turned(unit(angle));
    return edge.sweep >= 0.0 ? counter_clockwise : Eigen::Vector2d(-counter_clockwise);
  }

  /// Curvature to the left.
  static double bend(const BoundaryEdge& edge) {
    if (!edge.is_arc()) return 0.0;
    return edge.sweep >= 0.0 ? 1.0 / edge.radius : -1.0 / edge.radius;
  }

  /// The piece that goes on where this one ends. Where parts of the region only touch, several do: the one that turns
  /// most to the left bounds the same part.
  std::optional<std::size_t> successor(std::size_t piece, std::size_t first) const {
    constexpr double same_direction = 1e-6;
    const BoundaryEdge& edge = pieces_[piece].edge;
    const Eigen::Vector2d arriving = heading(edge, true);
    std::optional<std::size_t> best;
    double best_turn = 0.0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& next = pieces_[k];
      if ((next.used && k != first) || next.from != pieces_[piece].to) continue;
      const Eigen::Vector2d leaving = heading(next.edge, false);
      double turn = std::atan2(cross(arriving, leaving), arriving.dot(leaving));
      // Straight back is a turn by half a turn to the left, about a tip of the region, when the two edges bend apart
      // to the right, and to the right, about a tip of the outside, when to the left.
      if (std::abs(turn) > pi - same_direction) {
        turn = bend(edge) + bend(next.edge) < 0.0 ? pi : -pi;
      }
      const bool same = best && std::abs(turn - best_turn) <= same_direction;
      if (!best || (same ? bend(next.edge) > bend(pieces_[*best].edge) : turn > best_turn)) {
        best = k;
        best_turn = turn;
      }
    }
    return best;
  }

  /// Neighbours on one curve, which a touching curve has cut, are put together again.
  BoundaryLoop loop_of(const std::vector<std::size_t>& walk) const {
    const auto goes_on = [this](std::size_t before, std::size_t after) {
      const Piece& a = pieces_[before];
      const Piece& b = pieces_[after];
      return a.curve == b.curve && heading(a.edge, true).dot(heading(b.edge, false)) > 0.0;
    };
    // Begin with an edge that does not go on from the last.
    std::size_t begin = 0;
    while (begin < walk.size() && goes_on(walk[(begin + walk.size() - 1) % walk.size()], walk[begin])) ++begin;
    BoundaryLoop loop;
    for (std::size_t k = 0; k < walk.size(); ++k) {
      const std::size_t here = walk[(begin + k) % walk.size()];
      const BoundaryEdge& edge = pieces_[here].edge;
      if (k > 0 && goes_on(walk[(begin + k - 1) % walk.size()], here)) {
        loop.edges.back().end = edge.end;
        loop.edges.back().sweep += edge.sweep;
      } else {
        loop.edges.push_back(edge);
      }
    }
    return loop;
  }

  static Region nest(std::vector<BoundaryLoop> loops) {
    std::vector<RegionComponent> components;
    std::vector<BoundaryLoop> holes;
    for (BoundaryLoop& loop : loops) {
      if (loop.signed_area() > 0.0) {
        components.push_back({std::move(loop), {}});
      } else {
        holes.push_back(std::move(loop));
      }
    }
    std::sort(components.begin(), components.end(), [](const RegionComponent& a, const RegionComponent& b) {
      return a.outer.signed_area() > b.outer.signed_area();
    });
    for (BoundaryLoop& hole : holes) {
      // The smallest component around it: around most of its length, since it may touch the boundary.
      const auto around = std::find_if(components.rbegin(), components.rend(), [&](const RegionComponent& component) {
        double inside = 0.0;
        for (const BoundaryEdge& edge : hole.edges) {
          inside += component.outer.encloses(edge.at(0.5)) ? edge.length() : -edge.length();
        }
        return inside > 0.0;
      });
      if (around != components.rend()) around->holes.push_back(std::move(hole));
    }
    return Region(std::move(components));
  }

  static constexpr double rounding = 1e-14;     ///< of source_: well above what positions are off by
  static constexpr double same_length = 1e-14;  ///< of size_: what rounding makes of one length
  static constexpr double nearly_same = 1e-7;   ///< of size_: curves that are closer need more digits

  LimitEvaluator evaluator_;
  Eigen::AlignedBox2d box_;
  std::span<const OwnedCurve> candidates_;
  Screen screen_;
  double extent_ = 0.0;      ///< of the box
  double size_ = 0.0;        ///< of the curves
  double source_ = 0.0;      ///< of all numbers that the curves are computed from, theirs included
  double tolerance_ = 0.0;   ///< distances below it may come from rounding
  double same_point_ = 0.0;  ///< how far tangent curves run within the tolerance of each other
  bool has_tiny_circle_ = false;
  bool is_clear_ = true;  ///< nothing was merged that is not the same within rounding
  std::vector<OwnedCurve> relevant_;
  std::vector<OwnedCurve> curves_;  ///< without duplicates
  std::vector<Vertex> vertices_;
  std::multimap<double, std::size_t> near_;  ///< vertices by their x, also by one that they have left
  std::vector<Incidence> incidences_;
  std::vector<Place> places_;
  std::vector<Piece> pieces_;
};

std::vector<OwnedCurve> owned_curves(const Manipulator& manipulator, double orientation) {
  std::vector<OwnedCurve> curves;
  curves.reserve(2 * manipulator.size());
  for (std::size_t i = 0; i < manipulator.size(); ++i) {
    const Leg& leg = manipulator.leg(i);
    const Eigen::Vector2d q = -leg_vector(leg, {Eigen::Vector2d::Zero(), orientation});
    curves.push_back({{.centre = q, .radius = leg.length.upper}, i});
    if (leg.length.lower > 0.0) curves.push_back({{.centre = q, .radius = leg.length.lower}, i});
    const auto add_edges = [&](const std::optional<Interval>& angle, double turned) {
      if (!angle) return;
      curves.push_back({{.centre = q, .direction = unit(angle->lower + turned)}, i});
      curves.push_back({{.centre = q, .direction = unit(angle->upper + turned)}, i});
    };
    add_edges(leg.base_angle, 0.0);
    add_edges(leg.platform_angle, orientation);
  }
  return curves;
}

std::vector<OwnedCurve> owned_curves(const Manipulator& manipulator, const Interval& orientations) {
  // At the ends of the range the limits are those of a fixed orientation.
  std::vector<OwnedCurve> curves = owned_curves(manipulator, orientations.lower);
  const std::vector<OwnedCurve> at_end = owned_curves(manipulator, orientations.upper);
  curves.insert(curves.end(), at_end.begin(), at_end.end());
  // In between a limit is at its extreme along a circle about the base joint, or along a line.
  for (std::size_t i = 0; i < manipulator.size(); ++i) {
    const Leg& leg = manipulator.leg(i);
    const double arm = leg.platform_joint.norm();
    // A circle that is none is there as a point: whether a radius is zero is a matter of rounding, and the careful
    // method, which computes it with more digits, has the same curves in the same order.
    const auto add_circle = [&](double radius) {
      curves.push_back({{.centre = leg.base_joint, .radius = std::max(radius, 0.0)}, i});
    };
    add_circle(leg.length.upper - arm);
    add_circle(arm + leg.length.lower);
    add_circle(std::abs(arm - leg.length.lower));
    if (leg.base_angle || leg.platform_angle) add_circle(arm);  // the apex of a wedge
    if (leg.base_angle) {
      for (const double angle : {leg.base_angle->lower, leg.base_angle->upper}) {
        const Eigen::Vector2d along = unit(angle);
        const Eigen::Vector2d across = quarter_turned(along);
        curves.push_back({{.centre = leg.base_joint + arm * across, .direction = along}, i});
        curves.push_back({{.centre = leg.base_joint - arm * across, .direction = along}, i});
      }
    }
    if (leg.platform_angle) {
      for (const double angle : {leg.platform_angle->lower, leg.platform_angle->upper}) {
        add_circle(std::abs(cross(unit(angle), leg.platform_joint)));
      }
    }
  }
  return curves;
}

std::vector<LimitCurve> without_owners(const std::vector<OwnedCurve>& owned) {
  std::vector<LimitCurve> curves;
  curves.reserve(owned.size());
  for (const OwnedCurve& one : owned) {
    if (!is_point(one.curve)) curves.push_back(one.curve);
  }
  return curves;
}

}  // namespace

std::vector<LimitCurve> limit_curves(const Manipulator& manipulator, double orientation) {
  return without_owners(owned_curves(manipulator, orientation));
}

std::vector<LimitCurve> limit_curves(const Manipulator& manipulator, const Interval& orientations) {
  return without_owners(owned_curves(manipulator, orientations));
}

Region make_region(const Limits& limits, std::span<const LimitCurve> curves) {
  std::vector<OwnedCurve> without;
  without.reserve(curves.size());
  for (const LimitCurve& curve : curves) without.push_back({curve, std::nullopt});
  return Assembly(limits, without).run();
}

namespace {

/// An origin near a box that is far from the origin; the origin itself for any other. Coordinates near the box lose no
/// digit when it is taken from them, since it is a multiple of a power of two.
Eigen::Vector2d local_origin(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return Eigen::Vector2d::Zero();
  const double extent = box.diagonal().norm();
  if (!(extent > 0.0)) return Eigen::Vector2d::Zero();
  const double step = std::ldexp(1.0, std::ilogb(extent) + 4);
  return step * (box.center() / step).array().round().matrix();
}

Manipulator moved_by(const Manipulator& manipulator, const Eigen::Vector2d& shift) {
  std::vector<Leg> legs = manipulator.legs();
  for (Leg& leg : legs) leg.base_joint += shift;
  return {manipulator.name(), legs};
}

void move_by(BoundaryLoop& loop, const Eigen::Vector2d& shift) {
  const double area = loop.signed_area();
  for (BoundaryEdge& edge : loop.edges) {
    edge.start += shift;
    edge.end += shift;
    if (edge.is_arc()) edge.centre += shift;
  }
  loop.lost_area += area - loop.signed_area();
}

Region moved_by(const Region& region, const Eigen::Vector2d& shift) {
  std::vector<RegionComponent> components = region.components();
  for (RegionComponent& component : components) {
    move_by(component.outer, shift);
    for (BoundaryLoop& hole : component.holes) move_by(hole, shift);
  }
  return Region(std::move(components));
}

/// The workspace found about an origin of its own: what rounding can make up is then a part of its own size.
Region workspace(const Manipulator& manipulator, const Interval& orientations) {
  const bool is_slice = orientations.lower == orientations.upper;
  const auto limits_of = [&](const Manipulator& one) -> std::unique_ptr<const Limits> {
    if (is_slice) return std::make_unique<ConstantOrientationLimits>(one, orientations.lower);
    return std::make_unique<DextrousLimits>(one, orientations);
  };
  std::unique_ptr<const Limits> limits = limits_of(manipulator);
  const Eigen::Vector2d origin = local_origin(limits->box());
  std::optional<Manipulator> moved;
  if (!origin.isZero(0.0)) {
    moved = moved_by(manipulator, -origin);
    limits = limits_of(*moved);
  }
  const Manipulator& local = moved ? *moved : manipulator;
  std::vector<OwnedCurve> curves =
      is_slice ? owned_curves(local, orientations.lower) : owned_curves(local, orientations);
  for (OwnedCurve& curve : curves) {
    const Leg& leg = local.leg(*curve.leg);
    curve.source = leg.base_joint.lpNorm<1>() + leg.platform_joint.lpNorm<1>();
  }
  const std::vector<double> ends =
      is_slice ? std::vector{orientations.lower} : std::vector{orientations.lower, orientations.upper};
  Assembly assembly(*limits, curves, Screen(local, ends));
  std::optional<Region> clear = assembly.run_where_clear();
  if (!clear) clear = assembly.run_carefully(manipulator, orientations, origin);
  return moved ? moved_by(*clear, origin) : std::move(*clear);
}

}  // namespace

Region constant_orientation_workspace(const Manipulator& manipulator, double orientation) {
  return workspace(manipulator, {orientation, orientation});
}

Region dextrous_workspace(const Manipulator& manipulator, const Interval& orientations) {
  return workspace(manipulator, orientations);
}

}  // namespace reprise
