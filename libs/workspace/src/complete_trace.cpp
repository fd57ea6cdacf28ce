#include "reprise/workspace/complete_trace.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "reprise/base/require.hpp"
#include "reprise/geometry/hausdorff_distance.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/workspace/limit_evaluator.hpp"
#include "trace_options.hpp"

namespace reprise {
namespace {

/// Where a walk begins: the ray of trace_boundary.
struct Start {
  Eigen::Vector2d position;
  Eigen::Vector2d direction;
};

/// A start from which the ray meets a loop of the region first.
Start find_start(const BoundaryLoop& loop, const Region& region, double chord) {
  Start best{Eigen::Vector2d::Zero(), Eigen::Vector2d::UnitX()};
  double most_room = 0.0;
  for (const BoundaryEdge& edge : loop.edges) {
    // The middle may be a point where loops touch.
    for (const double fraction : {0.5, 0.3, 0.7}) {
      const Eigen::Vector2d foot = edge.at(fraction);
      Eigen::Vector2d forward = edge.end - edge.start;
      if (edge.is_arc()) {
        forward = edge.sweep >= 0.0 ? quarter_turned(foot - edge.centre)
                                    : Eigen::Vector2d(-quarter_turned(foot - edge.centre));
      }
      const Eigen::Vector2d inward = quarter_turned(forward).normalized();
      // Off the edge itself by more than rounding.
      const double off = 1e-9 * (foot.cwiseAbs().maxCoeff() + edge.length());
      const double across =
          off + region.first_exit(foot + off * inward, std::atan2(inward.y(), inward.x())).value_or(0.0);
      const double room = std::min(edge.length(), across);
      if (room <= most_room) continue;
      most_room = room;
      best = {foot + std::min(0.5 * across, 2.0 * chord) * inward, -inward};
    }
  }
  return best;
}

/// Collects closed boundaries and failures, and puts the boundaries together at the end.
class Collection {
 public:
  Collection(const Limits& limits, const TraceOptions& options, const PointSolver& solver)
      : limits_(limits), options_(options), solver_(solver) {
    validate(options);
    require_resolution(limits, options);
  }

  TracedBoundary trace(const Start& start, std::size_t max_points) {
    TraceOptions options = options_;
    options.first_direction = start.direction;
    options.max_points = std::min(options.max_points, max_points);
    TracedBoundary boundary = trace_boundary(limits_, start.position, options, solver_);
    result_.evaluations += boundary.evaluations;
    result_.gradients += boundary.gradients;
    return boundary;
  }

  /// Keeps a boundary that is what it should be, when `failure` is empty, or else the reason why not.
  void keep(TracedBoundary boundary, std::string failure, std::optional<std::size_t> loop = {}) {
    if (!failure.empty()) {
      result_.failures.push_back({std::move(boundary), std::move(failure), loop});
      return;
    }
    const double area = signed_area(boundary.positions());
    (area > 0.0 ? outer_ : holes_).push_back({area, std::move(boundary), loop});
  }

  /// Puts components together. `grid` counts what was evaluated beside the walks.
  TracedWorkspace finish(const LimitEvaluator* grid = nullptr) {
    const auto larger = [](const Loop& a, const Loop& b) { return std::abs(a.area) > std::abs(b.area); };
    std::stable_sort(outer_.begin(), outer_.end(), larger);
    std::stable_sort(holes_.begin(), holes_.end(), larger);
    std::vector<std::vector<Eigen::Vector2d>> polygons;
    for (Loop& loop : outer_) {
      polygons.push_back(loop.boundary.positions());
      result_.components.push_back({std::move(loop.boundary), {}});
    }
    for (Loop& hole : holes_) {
      const std::vector<Eigen::Vector2d> polygon = hole.boundary.positions();
      // The smallest outer boundary around it. Where both touch, chords may put some points of the hole outside.
      std::size_t around = polygons.size();
      while (around > 0 && !holds_most_of(polygons[around - 1], polygon)) --around;
      if (around > 0) {
        result_.components[around - 1].holes.push_back(std::move(hole.boundary));
      } else {
        keep(std::move(hole.boundary), "no outer boundary around this hole was traced", hole.index);
      }
    }
    if (grid != nullptr) {
      result_.grid_evaluations = grid->evaluations();
      result_.evaluations += grid->evaluations();
      result_.gradients += grid->gradients();
    }
    return std::move(result_);
  }

 private:
  struct Loop {
    double area;
    TracedBoundary boundary;
    std::optional<std::size_t> index;
  };

  static bool holds_most_of(std::span<const Eigen::Vector2d> around, std::span<const Eigen::Vector2d> polygon) {
    const std::size_t stride = 1 + polygon.size() / 32;
    int balance = 0;
    for (std::size_t k = 0; k < polygon.size(); k += stride) balance += contains(around, polygon[k]) ? 1 : -1;
    return balance > 0;
  }

  const Limits& limits_;
  const TraceOptions& options_;
  const PointSolver& solver_;
  std::vector<Loop> outer_;
  std::vector<Loop> holes_;
  TracedWorkspace result_;
};

/// What has been traced so far, to tell whether a boundary is known.
class KnownBoundaries {
 public:
  explicit KnownBoundaries(double near) : near_(near) {}

  void add(const TracedBoundary& boundary) {
    std::vector<Eigen::Vector2d> points = boundary.positions();
    if (points.empty()) points.push_back(boundary.start);
    (boundary.closed() ? polygons_ : broken_).push_back(std::move(points));
  }

  /// Whether a closed boundary passes near a point and has the outside on the same side, or a walk that did not close
  /// came near it.
  bool know(const Eigen::Vector2d& point, const Eigen::Vector2d& outward) const {
    for (const std::vector<Eigen::Vector2d>& polygon : polygons_) {
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Eigen::Vector2d& from = polygon[k];
        const Eigen::Vector2d& to = polygon[(k + 1) % polygon.size()];
        // The outside is on the right.
        const bool same_side = cross(to - from, outward) < 0.0;
        if (same_side && distance_to_segment(point, from, to) <= near_) return true;
      }
    }
    for (const std::vector<Eigen::Vector2d>& points : broken_) {
      for (const Eigen::Vector2d& other : points) {
        if ((point - other).norm() <= near_) return true;
      }
    }
    return false;
  }

  /// Whether most of a closed boundary runs where others do.
  bool know_most_of(const TracedBoundary& boundary) const {
    const std::vector<Eigen::Vector2d> points = boundary.positions();
    const std::size_t stride = 1 + points.size() / 64;
    int balance = 0;
    for (std::size_t k = 0; k < points.size(); k += stride) {
      const Eigen::Vector2d along = points[(k + 1) % points.size()] - points[k];
      balance += know(points[k] + 0.5 * along, -quarter_turned(along)) ? 1 : -1;
    }
    return balance > 0;
  }

 private:
  double near_;
  std::vector<std::vector<Eigen::Vector2d>> polygons_;
  std::vector<std::vector<Eigen::Vector2d>> broken_;
};

/// The points of a square grid around a box, whose outermost points are outside of it.
struct Grid {
  Grid(const Eigen::AlignedBox2d& box, double spacing) {
    const Eigen::Array2d intervals = (box.sizes().array() / spacing).floor() + 2.0;
    constexpr double most = 1e8;
    require((intervals + 1.0).prod() <= most, "spacing", spacing, "so long that the grid has at most 10^8 points");
    columns = static_cast<std::size_t>(intervals.x()) + 1;
    rows = static_cast<std::size_t>(intervals.y()) + 1;
    step = spacing;
    origin = box.center() - 0.5 * spacing * intervals.matrix();
  }

  Eigen::Vector2d at(std::size_t column, std::size_t row) const {
    return origin + step * Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
  }

  std::size_t columns;
  std::size_t rows;
  double step;
  Eigen::Vector2d origin;
};

}  // namespace

std::size_t TracedWorkspace::hole_count() const {
  std::size_t count = 0;
  for (const TracedComponent& component : components) count += component.holes.size();
  return count;
}

std::size_t TracedWorkspace::point_count() const {
  std::size_t count = 0;
  for (const TracedComponent& component : components) {
    count += component.outer.points.size();
    for (const TracedBoundary& hole : component.holes) count += hole.points.size();
  }
  return count;
}

double TracedWorkspace::area() const {
  double sum = 0.0;
  for (const std::vector<Eigen::Vector2d>& polygon : polygons()) sum += signed_area(polygon);
  return sum;
}

std::vector<std::vector<Eigen::Vector2d>> TracedWorkspace::polygons() const {
  std::vector<std::vector<Eigen::Vector2d>> result;
  for (const TracedComponent& component : components) {
    result.push_back(component.outer.positions());
    for (const TracedBoundary& hole : component.holes) result.push_back(hole.positions());
  }
  return result;
}

TracedWorkspace trace_all_boundaries(const Limits& limits, const Region& region, const TraceOptions& options,
                                     const PointSolver& solver) {
  Collection collection(limits, options, solver);
  std::size_t loops = 0;
  const auto trace = [&](const BoundaryLoop& loop) {
    const std::size_t index = loops++;
    double length = 0.0;
    for (const BoundaryEdge& edge : loop.edges) length += edge.length();
    // Each edge may add a corner and a short step after it.
    const double points = 4.0 * (length / options.chord + 2.0 * static_cast<double>(loop.edges.size())) + 10.0;
    TracedBoundary boundary =
        collection.trace(find_start(loop, region, options.chord), static_cast<std::size_t>(std::min(points, 1e18)));
    std::string failure;
    if (!boundary.closed()) {
      failure = boundary.message;
    } else {
      const std::vector<std::vector<Eigen::Vector2d>> polygon{boundary.positions()};
      const HausdorffDistance distance = hausdorff_distance(polygon, Region({{loop, {}}}), 0.1 * options.chord);
      constexpr double chords = 1.5;
      if (distance.polygons_to_region > chords * options.chord) {
        failure = "the walk went over to another boundary";
      } else if (distance.region_to_polygons > chords * options.chord) {
        failure = "the walk left out a part of the boundary";
      } else if (signed_area(polygon.front()) * loop.signed_area() <= 0.0) {
        failure = "the boundary is so small for the chord that its polygon runs the other way around";
      }
    }
    collection.keep(std::move(boundary), std::move(failure), index);
  };
  for (const RegionComponent& component : region.components()) {
    trace(component.outer);
    for (const BoundaryLoop& hole : component.holes) trace(hole);
  }
  return collection.finish();
}

TracedWorkspace trace_all_boundaries(const Limits& limits, double spacing, const TraceOptions& options,
                                     const PointSolver& solver) {
  require(std::isfinite(spacing) && spacing > 0.0, "spacing", spacing, "positive and finite");
  Collection collection(limits, options, solver);
  const Eigen::AlignedBox2d box = limits.box();
  if (box.isEmpty()) return collection.finish();
  const Grid grid(box, spacing);
  LimitEvaluator evaluator(limits);
  KnownBoundaries known(options.chord);

  LimitEvaluation exit;
  const auto trace_between = [&](const Eigen::Vector2d& inside, const Eigen::Vector2d& outside) {
    const Start start{inside, (outside - inside) / grid.step};
    // To see where the ray ends, a part of a chord is accurate enough.
    const double accurate = 1e-3 * options.chord;
    const SolvedPoint solved =
        solver.solve_ray(evaluator, {start.position, start.direction, grid.step, options.chord}, accurate);
    if (solved.outcome == SolvedPoint::Outcome::found) {
      evaluator.evaluate(solved.position, exit);
      Eigen::Index active = 0;
      exit.h.maxCoeff(&active);
      if (known.know(solved.position, evaluator.gradient(solved.position, active))) return;
    }
    TracedBoundary boundary = collection.trace(start, options.max_points);
    std::string failure;
    if (!boundary.closed()) {
      failure = boundary.message;
    } else if (known.know_most_of(boundary)) {
      failure = "the walk led to a boundary that was traced before";
    }
    known.add(boundary);
    collection.keep(std::move(boundary), std::move(failure));
  };

  std::vector<bool> above(grid.columns, false);  // whether the points of the row before are inside
  for (std::size_t row = 0; row < grid.rows; ++row) {
    bool before = false;
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d here = grid.at(column, row);
      const bool inside = evaluator.largest(here) <= 0.0;
      const auto compare = [&](bool other_inside, std::size_t other_column, std::size_t other_row) {
        if (inside == other_inside) return;
        const Eigen::Vector2d other = grid.at(other_column, other_row);
        trace_between(inside ? here : other, inside ? other : here);
      };
      if (column > 0) compare(before, column - 1, row);
      if (row > 0) compare(above[column], column, row - 1);
      before = inside;
      above[column] = inside;
    }
  }
  return collection.finish(&evaluator);
}

}  // namespace reprise
