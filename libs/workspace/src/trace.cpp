#include "reprise/workspace/trace.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bifurcation_finder.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "trace_options.hpp"

namespace reprise {
namespace {

/// Two points are one where they are closer than this part of a chord.
constexpr double same_point = 1e-12;

/// Rounding may leave a point this part of a chord short of b^1 where both are the same.
constexpr double short_of_first = 1e-9;

/// The slope of an active limit, per length, up to which the way along another one is still allowed: gradients at a
/// point that two limits share keep half of their digits where the curves nearly touch.
constexpr double allowed_slope = 1e-9;

/// Chords that turn by more than this are not taken for the course of one smooth curve.
constexpr double sharp_turn = pi / 4.0;

double angle_of(const Eigen::Vector2d& a) { return std::atan2(a.y(), a.x()); }

/// Walks along the boundary of one workspace.
class Walk {
 public:
  Walk(const Limits& limits, const TraceOptions& options, const PointSolver& solver);

  TracedBoundary run(const Eigen::Vector2d& start);

 private:
  /// Steps 2 and 3, from b^1 on.
  void walk_around(const Node& first);

  /// Step 3: joins the last boundary point to b^1 over the bifurcation points between them.
  void close(const Node& last);

  /// Whether limit j is active at a point, as nearly as the largest limit is.
  bool is_active(const LimitEvaluation& at, Eigen::Index j) const {
    return at.h[j] >= at.largest - 2.0 * std::max(tolerances_.slack, std::abs(at.largest));
  }
  /// Among the limits active at a point, the one along which the walk can go on.
  Eigen::Index active_ahead(const LimitEvaluation& at);
  /// The chord problem from b^i. `begins` where a curve begins there, so that no last chord says how it goes on.
  SolvedPoint step_from(const Node& here, bool begins);
  /// Which of the pieces from `here` over the bifurcation points to `next` passes b^1, if any does.
  std::optional<std::size_t> piece_that_passes(const Node& first, const Node& here, const Node& next);
  /// Whether the corner that a chord cuts off is near b^1, so that the chord passes it without coming beside it.
  bool cuts_off(const Node& first, const Node& here, const Node& next);

  void append(const BoundaryPoint& point);

  const TraceOptions& options_;
  const PointSolver& solver_;
  LimitEvaluator evaluator_;
  TraceTolerances tolerances_;
  double reach_;  ///< the diagonal of the box
  BifurcationFinder bifurcations_;

  Eigen::Vector2d first_tangent_;  ///< the direction of the boundary at b^1
  // The last chord.
  double last_direction_ = 0.0;
  double last_turn_ = 0.0;        ///< from the chord before
  bool last_was_smooth_ = false;  ///< it joins two points of one smooth curve
  bool has_turn_ = false;         ///< so does the chord before

  TracedBoundary result_;
  std::vector<BoundaryPoint> between_;  ///< bifurcation points of the last chord
};

TraceTolerances tolerances_of(const Limits& limits, const TraceOptions& options, const PointSolver& solver) {
  TraceTolerances result{};
  result.length = std::max(options.tolerance * size_of(limits.box()), limits.accuracy());
  result.slack = solver.attainable(result.length, options.chord);
  result.merge_distance = std::max(same_point * options.chord, 4.0 * result.slack);
  return result;
}

Walk::Walk(const Limits& limits, const TraceOptions& options, const PointSolver& solver)
    : options_(options),
      solver_(solver),
      evaluator_(limits),
      tolerances_(tolerances_of(limits, options, solver)),
      bifurcations_(evaluator_, solver, options.chord, tolerances_) {
  const Eigen::AlignedBox2d box = limits.box();
  reach_ = box.isEmpty() ? options.chord : box.diagonal().norm();
}

Eigen::Index Walk::active_ahead(const LimitEvaluation& at) {
  Eigen::Index largest = 0;
  at.h.maxCoeff(&largest);
  for (Eigen::Index j = 0; j < at.h.size(); ++j) {
    if (!is_active(at, j)) continue;
    const Eigen::Vector2d ahead = tangent(evaluator_, at.position, j);
    bool allowed = true;
    for (Eigen::Index k = 0; k < at.h.size() && allowed; ++k) {
      if (k != j && is_active(at, k)) allowed = evaluator_.gradient(at.position, k).dot(ahead) <= allowed_slope;
    }
    if (allowed) return j;
  }
  return largest;
}

std::optional<std::size_t> Walk::piece_that_passes(const Node& first, const Node& here, const Node& next) {
  const Eigen::Vector2d& u = first.at.position;
  if ((u - here.at.position).norm() > 3.0 * options_.chord) return std::nullopt;
  const double rounding = short_of_first * options_.chord;
  for (std::size_t k = 0; k <= between_.size(); ++k) {
    const Eigen::Vector2d& from = k == 0 ? here.at.position : between_[k - 1].position;
    const Eigen::Vector2d along = (k == between_.size() ? next.at.position : between_[k].position) - from;
    const double length = along.norm();
    if (length == 0.0) continue;
    const double passed = (u - from).dot(along) / length;
    const bool beside = passed >= -rounding && passed <= length + rounding &&
                        std::abs(cross(along, u - from)) <= 0.5 * options_.chord * length;
    // Not the other side of a narrow place, where the walk goes the other way.
    if (beside && first_tangent_.dot(along) >= 0.0) return k;
  }
  if (!options_.bifurcation_points && cuts_off(first, here, next)) return 0;
  return std::nullopt;
}

bool Walk::cuts_off(const Node& first, const Node& here, const Node& next) {
  if (here.active == next.active) return false;
  const double rounding = short_of_first * options_.chord;
  const Eigen::Vector2d after = first.at.position - here.at.position;
  const Eigen::Vector2d before = next.at.position - first.at.position;
  if (after.norm() > options_.chord - rounding) return false;
  // b^1 is on the curve that leads to the corner, or on the one that leads away from it.
  return (first.active == here.active && after.dot(tangent(evaluator_, here.at.position, here.active)) >= -rounding) ||
         (first.active == next.active && before.norm() <= 1.5 * options_.chord &&
          before.dot(tangent(evaluator_, next.at.position, next.active)) >= -rounding);
}

void Walk::append(const BoundaryPoint& point) {
  if (!result_.points.empty() &&
      (result_.points.back().position - point.position).norm() <= tolerances_.merge_distance) {
    result_.points.back().active[1] = point.active[1];
  } else {
    result_.points.push_back(point);
  }
}

SolvedPoint Walk::step_from(const Node& here, bool begins) {
  double predicted = last_direction_ + last_turn_;
  if (!has_turn_) {
    const Eigen::Vector2d ahead = tangent(evaluator_, here.at.position, here.active);
    predicted = ahead.isZero() ? last_direction_ : angle_of(ahead);
    // On a circle the tangent is midway between two chords.
    if (last_was_smooth_) predicted += std::remainder(predicted - last_direction_, 2.0 * pi);
  }
  const double outward = (begins ? predicted : last_direction_) - outward_turn;
  ++result_.chords;
  return solver_.solve_chord(evaluator_, {here.at.position, options_.chord, outward, predicted}, tolerances_.length);
}

void Walk::walk_around(const Node& first) {
  const auto end = [this](TraceStatus status, std::string message) {
    result_.status = status;
    result_.message = std::move(message);
  };
  first_tangent_ = tangent(evaluator_, first.at.position, first.active);
  Node here = first;
  Node next;
  append({here.at.position, {here.active, here.active}});
  bool begins = true;
  for (std::size_t boundary_points = 1;; ++boundary_points) {
    if (result_.points.size() >= options_.max_points) {
      return end(TraceStatus::too_many_points,
                 "the boundary is not closed after " + std::to_string(result_.points.size()) + " points");
    }
    const SolvedPoint solved = step_from(here, begins);
    if (solved.outcome == SolvedPoint::Outcome::no_feasible_direction) {
      return end(TraceStatus::chord_too_long,
                 "the workspace has no point a chord away from boundary point " + std::to_string(boundary_points));
    }
    if (solved.outcome == SolvedPoint::Outcome::failed) {
      return end(TraceStatus::point_solver_failed, "chord " + std::to_string(result_.chords) + ": " + solved.message);
    }
    evaluator_.evaluate(solved.position, next.at);
    next.active = here.active;
    if (!is_active(next.at, here.active)) next.at.h.maxCoeff(&next.active);

    between_.clear();
    std::optional<Node> takeover;
    if (options_.bifurcation_points && !bifurcations_.connect(here, next, between_)) {
      // The chord may have jumped over a gap in the workspace.
      takeover = bifurcations_.first_takeover(here);
      if (takeover) {
        between_.clear();
        next = *takeover;
      } else {
        ++result_.unresolved_bifurcations;
      }
    }
    if (const auto piece = boundary_points > 1 ? piece_that_passes(first, here, next) : std::nullopt) {
      if (boundary_points < 3) return end(TraceStatus::chord_too_long, "the boundary closes in less than 3 chords");
      between_.resize(*piece);
      close(here);
      return end(TraceStatus::closed, {});
    }
    for (const BoundaryPoint& point : between_) append(point);
    append({next.at.position, {takeover ? here.active : next.active, next.active}});

    const double direction = angle_of(next.at.position - here.at.position);
    const double turn = std::remainder(direction - last_direction_, 2.0 * pi);
    const bool smooth =
        here.active == next.active && between_.empty() && (!last_was_smooth_ || std::abs(turn) <= sharp_turn);
    has_turn_ = smooth && last_was_smooth_;
    last_turn_ = turn;
    last_direction_ = direction;
    last_was_smooth_ = smooth;
    begins = takeover.has_value();
    std::swap(here, next);
  }
}

void Walk::close(const Node& last) {
  for (const BoundaryPoint& point : between_) append(point);
  BoundaryPoint& front = result_.points.front();
  front.active[0] = between_.empty() ? last.active : between_.back().active[1];
  if ((result_.points.back().position - front.position).norm() <= tolerances_.merge_distance) {
    front.active[0] = result_.points.back().active[0];
    result_.points.pop_back();
  }
}

TracedBoundary Walk::run(const Eigen::Vector2d& start) {
  result_.start = start;
  if (evaluator_.largest(start) > tolerances_.slack) {
    Eigen::Index worst = 0;
    evaluator_.values().maxCoeff(&worst);
    result_.status = TraceStatus::start_outside;
    result_.message = "the start violates the limit '" + evaluator_.limits().label(worst) + "'";
  } else {
    const SolvedPoint solved = solver_.solve_ray(
        evaluator_, {start, options_.first_direction.normalized(), reach_, options_.chord}, tolerances_.length);
    if (solved.outcome == SolvedPoint::Outcome::found) {
      Node first;
      evaluator_.evaluate(solved.position, first.at);
      first.active = active_ahead(first.at);
      walk_around(first);
    } else {
      result_.status = TraceStatus::point_solver_failed;
      result_.message = "ray: " + solved.message;
    }
  }
  result_.evaluations = evaluator_.evaluations() + bifurcations_.simpler_evaluations();
  result_.gradients = evaluator_.gradients() + bifurcations_.simpler_gradients();
  return std::move(result_);
}

}  // namespace

std::string_view to_string(TraceStatus status) {
  switch (status) {
    case TraceStatus::closed:
      return "closed";
    case TraceStatus::start_outside:
      return "start_outside";
    case TraceStatus::empty:
      return "empty";
    case TraceStatus::no_start:
      return "no_start";
    case TraceStatus::chord_too_long:
      return "chord_too_long";
    case TraceStatus::point_solver_failed:
      return "point_solver_failed";
    case TraceStatus::too_many_points:
      return "too_many_points";
  }
  return "unknown";
}

std::vector<Eigen::Vector2d> TracedBoundary::positions() const {
  std::vector<Eigen::Vector2d> result(points.size());
  std::transform(points.begin(), points.end(), result.begin(), [](const BoundaryPoint& p) { return p.position; });
  return result;
}

TracedBoundary trace_boundary(const Limits& limits, const Eigen::Vector2d& start, const TraceOptions& options,
                              const PointSolver& solver) {
  validate(options);
  require(start.allFinite(), "start", start, "finite");
  require_resolution(limits, options);
  return Walk(limits, options, solver).run(start);
}

TracedBoundary trace_boundary(const Limits& limits, const TraceOptions& options, const PointSolver& solver) {
  validate(options);
  require_resolution(limits, options);
  const InteriorPoint interior = find_interior_point(limits);
  TracedBoundary result;
  if (interior.status == InteriorStatus::found) {
    result = trace_boundary(limits, interior.position, options, solver);
  } else {
    const bool empty = interior.status == InteriorStatus::empty;
    result.status = empty ? TraceStatus::empty : TraceStatus::no_start;
    result.message = std::string(empty ? "the workspace is empty" : "no point inside the workspace was found") +
                     ": no point of it has a clearance above " + shown(interior.clearance_bound);
  }
  result.evaluations += interior.evaluations;
  return result;
}

}  // namespace reprise
