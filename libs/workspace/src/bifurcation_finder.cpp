#include "bifurcation_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

/// A point is after another along a curve, or before it, up to this part of a chord.
constexpr double order_tolerance = 1e-6;

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

}  // namespace

Eigen::Vector2d tangent(LimitEvaluator& evaluator, const Eigen::Vector2d& u, Eigen::Index j) {
  const Eigen::Vector2d outward = evaluator.gradient(u, j);
  return Eigen::Vector2d(-outward.y(), outward.x()).normalized();
}

bool BifurcationFinder::find_bifurcation(Eigen::Index p, Eigen::Index q, const Eigen::Vector2d& guess,
                                         LimitEvaluation& result) {
  SolvedPoint solved;
  if (const auto pair = evaluator_.limits().at_bifurcation(p, q)) {
    LimitEvaluator simpler(*pair->limits);
    solved = solver_.solve_bifurcation(simpler, {pair->first, pair->second, guess, chord_}, tolerances_.length);
    simpler_evaluations_ += simpler.evaluations();
    simpler_gradients_ += simpler.gradients();
  } else {
    solved = solver_.solve_bifurcation(evaluator_, {p, q, guess, chord_}, tolerances_.length);
  }
  if (solved.outcome != SolvedPoint::Outcome::found) return false;
  evaluator_.evaluate(solved.position, result);
  return true;
}

std::optional<Eigen::Index> BifurcationFinder::violated(const LimitEvaluation& at, Eigen::Index p,
                                                        Eigen::Index q) const {
  // The point meets its own two limits no better than this, and may be some times as far away from where they meet.
  const double error = std::max(std::abs(at.h[p]), std::abs(at.h[q]));
  double worst = 10.0 * (tolerances_.slack + error);
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
bool BifurcationFinder::lies_after(const Node& from, const Eigen::Vector2d& u) {
  const Eigen::Vector2d after = u - from.at.position;
  return after.norm() <= 1.5 * chord_ && after.dot(tangent(evaluator_, from.at.position, from.active)) >=
                                             -order_tolerance * chord_ - tolerances_.merge_distance;
}

bool BifurcationFinder::lies_before(const Node& to, const Eigen::Vector2d& u) {
  const Eigen::Vector2d before = to.at.position - u;
  return before.norm() <= 2.5 * chord_ && before.dot(tangent(evaluator_, to.at.position, to.active)) >=
                                              -order_tolerance * chord_ - tolerances_.merge_distance;
}

bool BifurcationFinder::connect(const Node& from, const Node& to, std::vector<BoundaryPoint>& between) {
  between_ = &between;
  const Eigen::Index p = from.active;
  const Eigen::Index q = to.active;
  if (p == q) return follow(from.at, to.at, p, p);
  // Where the tangents at both ends meet is close to where the curves do.
  const Eigen::Vector2d chord = to.at.position - from.at.position;
  const Eigen::Vector2d at_from = tangent(evaluator_, from.at.position, p);
  const double along =
      cross(chord, tangent(evaluator_, to.at.position, q)) / cross(at_from, tangent(evaluator_, to.at.position, q));
  const Eigen::Vector2d middle = from.at.position + 0.5 * chord;
  const bool tangents_meet = along >= 0.0 && along <= chord_;
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
    between_->push_back({corner_.position, {p, q}});
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

bool BifurcationFinder::connect_through(const Node& from, const Node& to, Eigen::Index r,
                                        const Eigen::Vector2d& guess) {
  const Eigen::Index p = from.active;
  const Eigen::Index q = to.active;
  LimitEvaluation& enter = first_crossing_;
  LimitEvaluation& leave = second_crossing_;
  const bool found = find_bifurcation(p, r, guess, enter) && lies_after(from, enter.position) &&
                     !violated(enter, p, r) && find_bifurcation(r, q, guess, leave) &&
                     lies_before(to, leave.position) && !violated(leave, r, q) &&
                     (leave.position - enter.position).dot(tangent(evaluator_, enter.position, r)) >= 0.0;
  if (!found) return false;
  between_->push_back({enter.position, {p, r}});
  between_->push_back({leave.position, {r, q}});
  return true;
}

bool BifurcationFinder::follow(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p,
                               Eigen::Index known) {
  if (!find_own_corner(from, to, p)) return follow_smoothly(from, to, p, known);
  const bool before = follow_smoothly(from, own_corner_, p, known);
  between_->push_back({own_corner_.position, {p, p}});
  return follow_smoothly(own_corner_, to, p, known) && before;
}

bool BifurcationFinder::find_own_corner(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p) {
  const auto corner = evaluator_.limits().corner(p, from.position);
  if (!corner) return false;
  const Eigen::Vector2d after = *corner - from.position;
  const Eigen::Vector2d before = to.position - *corner;
  const bool between = after.norm() > tolerances_.merge_distance && after.norm() <= 1.5 * chord_ &&
                       before.norm() > tolerances_.merge_distance && before.norm() <= 2.5 * chord_ &&
                       after.dot(tangent(evaluator_, from.position, p)) > 0.0 &&
                       before.dot(tangent(evaluator_, to.position, p)) > 0.0;
  if (!between) return false;
  evaluator_.evaluate(*corner, own_corner_);
  return !violated(own_corner_, p, p);
}

bool BifurcationFinder::follow_smoothly(const LimitEvaluation& from, const LimitEvaluation& to, Eigen::Index p,
                                        Eigen::Index known) {
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
  for (int k = 0; k < 4 && std::abs(middle_.h[p]) > tolerances_.length; ++k) {
    const Eigen::Vector2d outward = evaluator_.gradient(middle_.position, p);
    if (outward.isZero()) break;
    const Eigen::Vector2d on_curve = middle_.position - middle_.h[p] / outward.squaredNorm() * outward;
    evaluator_.evaluate(on_curve, middle_);
  }
  const auto j = crossing(10.0 * tolerances_.slack);
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
                     (leave.position - enter.position).dot(chord) > tolerances_.merge_distance * length &&
                     (leave.position - enter.position).dot(tangent(evaluator_, enter.position, *j)) >= 0.0;
  if (!found) return false;
  between_->push_back({enter.position, {p, *j}});
  between_->push_back({leave.position, {*j, p}});
  return true;
}

std::optional<Node> BifurcationFinder::first_takeover(const Node& from) {
  const Eigen::Index p = from.active;
  const Eigen::Vector2d ahead = tangent(evaluator_, from.at.position, p);
  std::optional<Node> first;
  double nearest = 0.0;
  for (Eigen::Index j = 0; j < from.at.h.size(); ++j) {
    if (j == p) continue;
    const double rise = evaluator_.gradient(from.at.position, j).dot(ahead);
    const double place = rise > 0.0 ? std::clamp(-from.at.h[j] / rise, 0.0, chord_) : chord_;
    if (!find_bifurcation(p, j, from.at.position + place * ahead, corner_)) continue;
    const Eigen::Vector2d& u = corner_.position;
    const double distance = (u - from.at.position).norm();
    const bool takes_over = distance > tolerances_.merge_distance && lies_after(from, u) && !violated(corner_, p, j) &&
                            evaluator_.gradient(u, j).dot(tangent(evaluator_, u, p)) > 0.0;
    if (!takes_over || (first && distance >= nearest)) continue;
    nearest = distance;
    first = Node{corner_, j};
  }
  return first;
}

}  // namespace reprise
