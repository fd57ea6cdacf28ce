#include "reprise/workspace/trace.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "trace_options.hpp"

namespace reprise {
namespace {

/// How far psi is turned outward from the last chord.
constexpr double outward_turn = pi / 4.0;

/// The shortest chord, to the size of the workspace as seen from the origin: that many times longer than rounding.
constexpr double least_chord = 1e-12;

/// Chords that turn by more than this are not taken for the course of one smooth curve.
constexpr double sharp_turn = pi / 4.0;

double angle_of(const Eigen::Vector2d& a) { return std::atan2(a.y(), a.x()); }

/// The parabola through (0, first), (1/2, middle), (1, last).
struct Parabola {
  double first, middle, last;

  double square() const { return 2.0 * (first - 2.0 * middle + last); }
  double slope() const { return 4.0 * middle - 3.0 * first - last; }
  double at(double t) const { return first + t * (slope() + t * square()); }

  /// Its largest value on [0, 1].
  double maximum() const {
    const double ends = std::max({first, middle, last});
    if (square() >= 0.0) return ends;
    const double top = -0.5 * slope() / square();
    return top > 0.0 && top < 1.0 ? std::max(ends, at(top)) : ends;
  }

  /// Where it crosses zero, upward and downward, when it is positive in between only.
  std::array<double, 2> crossings() const {
    const double a = square();
    const double b = slope();
    const double top = std::clamp(-0.5 * b / a, 0.0, 1.0);
    const double half_width = std::sqrt(std::max(-at(top) / a, 0.0));
    return {std::clamp(top - half_width, 0.0, 1.0), std::clamp(top + half_width, 0.0, 1.0)};
  }
};

/// A boundary point with all limits there and the one that is active from here on.
struct Node {
  LimitEvaluation at;
  Eigen::Index active = -1;
};

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
    return at.h[j] >= at.largest - 2.0 * std::max(slack_, std::abs(at.largest));
  }
  /// Among the limits active at a point, the one along which the walk can go on.
  Eigen::Index active_ahead(const LimitEvaluation& at);
  /// Unit vector along the curve h_j = 0 with the workspace on its left; zero where h_j has no gradient.
  Eigen::Vector2d tangent(const Eigen::Vector2d& u, Eigen::Index j);
  /// The chord problem from b^i. `begins` where a curve begins there, so that no last chord says how it goes on.
  SolvedPoint step_from(const Node& here, bool begins);
  /// Which of the pieces from `here` over the bifurcation points to `next` passes b^1, if any does.
  std::optional<std::size_t> piece_that_passes(const Node& first, const Node& here, const Node& next);
  /// Whether the corner that a chord cuts off is near b^1, so that the chord passes it without coming beside it.
  bool cuts_off(const Node& first, const Node& here, const Node& next);

  void append(const BoundaryPoint& point);

  /// Step 4: finds the bifurcation points between two consecutive boundary points. False when they are not joined so.
  bool connect(const Node& from, const Node& to);
  /// The same where the limit r comes between the limits p of `from` and q of `to`.
  bool connect_through(const Node& from, const Node& to, Eigen::Index r, const Eigen::Vector2d& guess);
  /// The same between two points on the curve h_p = 0. `known` is a limit that is known not to cross in between.
  bool follow(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p, Eigen::Index known);
  /// The same where the curve has no corner of its own in between.
  bool follow_smoothly(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p, Eigen::Index known);
  /// Whether the curve h_p = 0 itself has a corner between two points on it; own_corner_ is there.
  bool find_own_corner(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p);
  /// The first point on the curve h_p = 0 after a boundary point at which another limit takes over, if there is one
  /// within about a chord.
  std::optional<Node> first_takeover(const Node& from);

  bool find_bifurcation(Eigen::Index p, Eigen::Index q, const Eigen::Vector2d& guess, LimitEvaluation& result);
  /// The limit other than p and q that a point violates most, or nothing.
  std::optional<Eigen::Index> violated(const LimitEvaluation& at, Eigen::Index p, Eigen::Index q) const;
  /// Whether a point can lie on the walk after b^i and before b^(i+1).
  bool lies_after(const Node& from, const Eigen::Vector2d& u);
  bool lies_before(const Node& to, const Eigen::Vector2d& u);

  const TraceOptions& options_;
  const PointSolver& solver_;
  LimitEvaluator evaluator_;
  double tolerance_;       ///< as a length
  double slack_;           ///< how far from zero an active limit may be
  double merge_distance_;  ///< of two points that are closer, one is enough
  double reach_;           ///< the diagonal of the box

  Eigen::Vector2d first_tangent_;  ///< the direction of the boundary at b^1
  // The last chord.
  double last_direction_ = 0.0;
  double last_turn_ = 0.0;        ///< from the chord before
  bool last_was_smooth_ = false;  ///< it joins two points of one smooth curve
  bool has_turn_ = false;         ///< so does the chord before

  TracedBoundary result_;
  // Of the simpler limits that stand in for a pair at a bifurcation point.
  std::size_t simpler_evaluations_ = 0;
  std::size_t simpler_gradients_ = 0;
  // Kept from call to call, so that nothing is allocated for each point.
  std::vector<BoundaryPoint> between_;  ///< bifurcation points of the last chord
  LimitEvaluation middle_;
  LimitEvaluation corner_;
  LimitEvaluation own_corner_;
  LimitEvaluation first_crossing_;
  LimitEvaluation second_crossing_;
};

double size_of(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return 1.0;
  return std::max({box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff(), box.diagonal().norm()});
}

Walk::Walk(const Limits& limits, const TraceOptions& options, const PointSolver& solver)
    : options_(options), solver_(solver), evaluator_(limits) {
  const Eigen::AlignedBox2d box = limits.box();
  tolerance_ = std::max(options.tolerance * size_of(box), limits.accuracy());
  slack_ = solver.attainable(tolerance_, options.chord);
  merge_distance_ = std::max(1e-12 * options.chord, 4.0 * slack_);
  reach_ = box.isEmpty() ? options.chord : box.diagonal().norm();
}

Eigen::Vector2d Walk::tangent(const Eigen::Vector2d& u, Eigen::Index j) {
  const Eigen::Vector2d outward = evaluator_.gradient(u, j);
  return Eigen::Vector2d(-outward.y(), outward.x()).normalized();
}

Eigen::Index Walk::active_ahead(const LimitEvaluation& at) {
  Eigen::Index largest = 0;
  at.h.maxCoeff(&largest);
  for (Eigen::Index j = 0; j < at.h.size(); ++j) {
    if (!is_active(at, j)) continue;
    const Eigen::Vector2d ahead = tangent(at.position, j);
    bool allowed = true;
    for (Eigen::Index k = 0; k < at.h.size() && allowed; ++k) {
      if (k != j && is_active(at, k)) allowed = evaluator_.gradient(at.position, k).dot(ahead) <= 1e-9;
    }
    if (allowed) return j;
  }
  return largest;
}

std::optional<std::size_t> Walk::piece_that_passes(const Node& first, const Node& here, const Node& next) {
  const Eigen::Vector2d& u = first.at.position;
  if ((u - here.at.position).norm() > 3.0 * options_.chord) return std::nullopt;
  // Rounding may leave a point a little short of b^1 where both are the same.
  const double rounding = 1e-9 * options_.chord;
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
  const double rounding = 1e-9 * options_.chord;
  const Eigen::Vector2d after = first.at.position - here.at.position;
  const Eigen::Vector2d before = next.at.position - first.at.position;
  if (after.norm() > options_.chord - rounding) return false;
  // b^1 is on the curve that leads to the corner, or on the one that leads away from it.
  return (first.active == here.active && after.dot(tangent(here.at.position, here.active)) >= -rounding) ||
         (first.active == next.active && before.norm() <= 1.5 * options_.chord &&
          before.dot(tangent(next.at.position, next.active)) >= -rounding);
}

void Walk::append(const BoundaryPoint& point) {
  if (!result_.points.empty() && (result_.points.back().position - point.position).norm() <= merge_distance_) {
    result_.points.back().active[1] = point.active[1];
  } else {
    result_.points.push_back(point);
  }
}

bool Walk::find_bifurcation(Eigen::Index p, Eigen::Index q, const Eigen::Vector2d& guess, LimitEvaluation& result) {
  SolvedPoint solved;
  if (const auto pair = evaluator_.limits().at_bifurcation(p, q)) {
    LimitEvaluator simpler(*pair->limits);
    solved = solver_.solve_bifurcation(simpler, {pair->first, pair->second, guess, options_.chord}, tolerance_);
    simpler_evaluations_ += simpler.evaluations();
    simpler_gradients_ += simpler.gradients();
  } else {
    solved = solver_.solve_bifurcation(evaluator_, {p, q, guess, options_.chord}, tolerance_);
  }
  if (solved.outcome != SolvedPoint::Outcome::found) return false;
  evaluator_.evaluate(solved.position, result);
  return true;
}

std::optional<Eigen::Index> Walk::violated(const LimitEvaluation& at, Eigen::Index p, Eigen::Index q) const {
  // The point meets its own two limits no better than this, and may be some times as far away from where they meet.
  const double error = std::max(std::abs(at.h[p]), std::abs(at.h[q]));
  double worst = 10.0 * (slack_ + error);
  std::optional<Eigen::Index> result;
  for (Eigen::Index j = 0; j < at.h.size(); ++j) {
    if (j == p || j == q || at.h[j] <= worst) continue;
    worst = at.h[j];
    result = j;
  }
  return result;
}

// A tip of the workspace may be cut off by the chord. No point of the tip is much more than a chord away from b^i, or
// the next point would be there; so none is much more than two chords away from b^(i+1).
bool Walk::lies_after(const Node& from, const Eigen::Vector2d& u) {
  const Eigen::Vector2d after = u - from.at.position;
  return after.norm() <= 1.5 * options_.chord &&
         after.dot(tangent(from.at.position, from.active)) >= -1e-6 * options_.chord - merge_distance_;
}

bool Walk::lies_before(const Node& to, const Eigen::Vector2d& u) {
  const Eigen::Vector2d before = to.at.position - u;
  return before.norm() <= 2.5 * options_.chord &&
         before.dot(tangent(to.at.position, to.active)) >= -1e-6 * options_.chord - merge_distance_;
}

bool Walk::connect(const Node& from, const Node& to) {
  const Eigen::Index p = from.active;
  const Eigen::Index q = to.active;
  if (p == q) return follow(from.at, to.at, p, p);
  // Where the tangents at both ends meet is close to where the curves do.
  const Eigen::Vector2d chord = to.at.position - from.at.position;
  const Eigen::Vector2d at_from = tangent(from.at.position, p);
  const double along = cross(chord, tangent(to.at.position, q)) / cross(at_from, tangent(to.at.position, q));
  const Eigen::Vector2d middle = from.at.position + 0.5 * chord;
  const bool tangents_meet = along >= 0.0 && along <= options_.chord;
  const std::array<Eigen::Vector2d, 2> guesses = {
      tangents_meet ? Eigen::Vector2d(from.at.position + along * at_from) : middle, middle};
  for (const Eigen::Vector2d& guess : guesses) {
    const bool found = find_bifurcation(p, q, guess, corner_) && lies_after(from, corner_.position) &&
                       lies_before(to, corner_.position);
    if (!found) continue;
    if (const auto r = violated(corner_, p, q)) {
      if (connect_through(from, to, *r, corner_.position)) return true;
      continue;
    }
    const bool before = follow(from.at, corner_, p, q);
    between_.push_back({corner_.position, {p, q}});
    return follow(corner_, to.at, q, p) && before;
  }
  // The two curves need not meet: a third may run between them.
  evaluator_.evaluate(middle, middle_);
  std::optional<Eigen::Index> nearest;
  for (Eigen::Index j = 0; j < middle_.h.size(); ++j) {
    if (j != p && j != q && (!nearest || middle_.h[j] > middle_.h[*nearest])) nearest = j;
  }
  return nearest && connect_through(from, to, *nearest, middle);
}

bool Walk::connect_through(const Node& from, const Node& to, Eigen::Index r, const Eigen::Vector2d& guess) {
  const Eigen::Index p = from.active;
  const Eigen::Index q = to.active;
  LimitEvaluation& enter = first_crossing_;
  LimitEvaluation& leave = second_crossing_;
  const bool found = find_bifurcation(p, r, guess, enter) && lies_after(from, enter.position) &&
                     !violated(enter, p, r) && find_bifurcation(r, q, guess, leave) &&
                     lies_before(to, leave.position) && !violated(leave, r, q) &&
                     (leave.position - enter.position).dot(tangent(enter.position, r)) >= 0.0;
  if (!found) return false;
  between_.push_back({enter.position, {p, r}});
  between_.push_back({leave.position, {r, q}});
  return true;
}

bool Walk::follow(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p, Eigen::Index known) {
  if (!find_own_corner(from, to, p)) return follow_smoothly(from, to, p, known);
  const bool before = follow_smoothly(from, own_corner_, p, known);
  between_.push_back({own_corner_.position, {p, p}});
  return follow_smoothly(own_corner_, to, p, known) && before;
}

bool Walk::find_own_corner(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p) {
  const auto corner = evaluator_.limits().corner(p, from.position);
  if (!corner) return false;
  const Eigen::Vector2d after = *corner - from.position;
  const Eigen::Vector2d before = to.position - *corner;
  const bool between = after.norm() > merge_distance_ && after.norm() <= 1.5 * options_.chord &&
                       before.norm() > merge_distance_ && before.norm() <= 2.5 * options_.chord &&
                       after.dot(tangent(from.position, p)) > 0.0 && before.dot(tangent(to.position, p)) > 0.0;
  if (!between) return false;
  evaluator_.evaluate(*corner, own_corner_);
  return !violated(own_corner_, p, p);
}

bool Walk::follow_smoothly(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p, Eigen::Index known) {
  const Eigen::Vector2d chord = to.position - from.position;
  const double length = chord.norm();
  const double lipschitz = evaluator_.limits().lipschitz_constant();
  // Between the ends no limit rises by more than this above the mean of its values there; the curve is not far from
  // the chord.
  const double rise = 0.75 * length * lipschitz;
  const auto may_cross = [&](Eigen::Index j) {
    return j != p && j != known && 0.5 * (from.h[j] + to.h[j]) + rise >= 0.0;
  };
  bool any = false;
  for (Eigen::Index j = 0; j < from.h.size(); ++j) any = any || may_cross(j);
  if (!any) return true;

  const auto along = [&](Eigen::Index j) { return Parabola{from.h[j], middle_.h[j], to.h[j]}; };
  const auto crossing = [&](double beyond) {
    std::optional<Eigen::Index> result;
    double highest = beyond;
    for (Eigen::Index j = 0; j < from.h.size(); ++j) {
      if (!may_cross(j) || along(j).maximum() <= highest) continue;
      highest = along(j).maximum();
      result = j;
    }
    return result;
  };
  evaluator_.evaluate(from.position + 0.5 * chord, middle_);
  if (!crossing(-std::abs(middle_.h[p]))) return true;
  // Close: move the middle from the chord to the curve.
  for (int k = 0; k < 4 && std::abs(middle_.h[p]) > tolerance_; ++k) {
    const Eigen::Vector2d outward = evaluator_.gradient(middle_.position, p);
    if (outward.isZero()) break;
    const Eigen::Vector2d on_curve = middle_.position - middle_.h[p] / outward.squaredNorm() * outward;
    evaluator_.evaluate(on_curve, middle_);
  }
  const auto j = crossing(10.0 * slack_);
  if (!j) return true;
  const std::array<double, 2> places = along(*j).crossings();
  const auto on_curve = [&](double t) {
    return Eigen::Vector2d(Parabola{from.position.x(), middle_.position.x(), to.position.x()}.at(t),
                           Parabola{from.position.y(), middle_.position.y(), to.position.y()}.at(t));
  };
  const auto lies_within = [&](const Eigen::Vector2d& u) {
    const double passed = (u - from.position).dot(chord) / length;
    return passed >= -0.1 * length && passed <= 1.1 * length && (u - from.position).norm() <= 1.5 * length;
  };
  LimitEvaluation& enter = first_crossing_;
  LimitEvaluation& leave = second_crossing_;
  const bool found = find_bifurcation(p, *j, on_curve(places[0]), enter) &&
                     find_bifurcation(p, *j, on_curve(places[1]), leave) && lies_within(enter.position) &&
                     lies_within(leave.position) && !violated(enter, p, *j) && !violated(leave, p, *j) &&
                     (leave.position - enter.position).dot(chord) > merge_distance_ * length &&
                     (leave.position - enter.position).dot(tangent(enter.position, *j)) >= 0.0;
  if (!found) return false;
  between_.push_back({enter.position, {p, *j}});
  between_.push_back({leave.position, {*j, p}});
  return true;
}

std::optional<Node> Walk::first_takeover(const Node& from) {
  const Eigen::Index p = from.active;
  const Eigen::Vector2d ahead = tangent(from.at.position, p);
  std::optional<Node> first;
  double nearest = 0.0;
  for (Eigen::Index j = 0; j < from.at.h.size(); ++j) {
    if (j == p) continue;
    const double rise = evaluator_.gradient(from.at.position, j).dot(ahead);
    const double place = rise > 0.0 ? std::clamp(-from.at.h[j] / rise, 0.0, options_.chord) : options_.chord;
    if (!find_bifurcation(p, j, from.at.position + place * ahead, corner_)) continue;
    const Eigen::Vector2d& u = corner_.position;
    const double distance = (u - from.at.position).norm();
    const bool takes_over = distance > merge_distance_ && lies_after(from, u) && !violated(corner_, p, j) &&
                            evaluator_.gradient(u, j).dot(tangent(u, p)) > 0.0;
    if (!takes_over || (first && distance >= nearest)) continue;
    nearest = distance;
    first = Node{corner_, j};
  }
  return first;
}

SolvedPoint Walk::step_from(const Node& here, bool begins) {
  double predicted = last_direction_ + last_turn_;
  if (!has_turn_) {
    const Eigen::Vector2d ahead = tangent(here.at.position, here.active);
    predicted = ahead.isZero() ? last_direction_ : angle_of(ahead);
    // On a circle the tangent is midway between two chords.
    if (last_was_smooth_) predicted += std::remainder(predicted - last_direction_, 2.0 * pi);
  }
  const double outward = (begins ? predicted : last_direction_) - outward_turn;
  ++result_.chords;
  return solver_.solve_chord(evaluator_, {here.at.position, options_.chord, outward, predicted}, tolerance_);
}

void Walk::walk_around(const Node& first) {
  const auto end = [this](TraceStatus status, std::string message) {
    result_.status = status;
    result_.message = std::move(message);
  };
  first_tangent_ = tangent(first.at.position, first.active);
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
    if (options_.bifurcation_points && !connect(here, next)) {
      // The chord may have jumped over a gap in the workspace.
      takeover = first_takeover(here);
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
  if ((result_.points.back().position - front.position).norm() <= merge_distance_) {
    front.active[0] = result_.points.back().active[0];
    result_.points.pop_back();
  }
}

TracedBoundary Walk::run(const Eigen::Vector2d& start) {
  result_.start = start;
  if (evaluator_.largest(start) > slack_) {
    Eigen::Index worst = 0;
    evaluator_.values().maxCoeff(&worst);
    result_.status = TraceStatus::start_outside;
    result_.message = "the start violates the limit '" + evaluator_.limits().label(worst) + "'";
  } else {
    const SolvedPoint solved = solver_.solve_ray(
        evaluator_, {start, options_.first_direction.normalized(), reach_, options_.chord}, tolerance_);
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
  result_.evaluations = evaluator_.evaluations() + simpler_evaluations_;
  result_.gradients = evaluator_.gradients() + simpler_gradients_;
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

void validate(const TraceOptions& options) {
  require(options.chord > 0.0 && std::isfinite(options.chord), "chord", options.chord, "positive and finite");
  require(options.first_direction.allFinite() && options.first_direction.norm() > 0.0, "first_direction",
          options.first_direction, "finite and not zero");
  require(options.max_points > 0, "max_points", options.max_points, "positive");
  require(options.tolerance >= 1e-15 && options.tolerance <= 1e-3, "tolerance", options.tolerance,
          "between 1e-15 and 1e-3");
}

void require_resolution(const Limits& limits, const TraceOptions& options) {
  const double size = size_of(limits.box());
  if (options.chord >= least_chord * size) return;
  throw std::invalid_argument("chord is " + shown(options.chord) + ", but at the distance " + shown(size) +
                              " from the origin it must be at least " + shown(least_chord * size) +
                              " for points to be told apart");
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
