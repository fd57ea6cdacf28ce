#include "reprise/bounds/enclosure.hpp"

#include <algorithm>
#include <cmath>

#include "branch_and_bound.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"

namespace reprise {
namespace {

using rigorous::Part;

void check(const std::string& name, const Interval& range) {
  require(std::isfinite(range.lower), "the lower bound of " + name, range.lower, "finite");
  require(std::isfinite(range.upper) && range.upper >= range.lower, "the upper bound of " + name, range.upper,
          "finite and not below the lower bound");
}

void check(const Interval& orientations, const EnclosureOptions& options) {
  check("the orientations", orientations);
  const double width = orientations.upper - orientations.lower;
  require(width <= 2.0 * pi, "the width of the range of orientations", width, "at most a full turn");
  require(options.tolerance > 0.0 && std::isfinite(options.tolerance), "the tolerance", options.tolerance,
          "positive and finite");
  require(options.max_evaluations >= 1, "the limit on evaluations", options.max_evaluations, "at least 1");
}

MinimumEnclosure to_enclosure(const rigorous::SearchResult& found) {
  return {found.lower, found.upper, found.witness, found.evaluations, found.finished};
}

void check_allowance(double allowance) {
  require(allowance >= 0.0 && std::isfinite(allowance), "the allowance", allowance, "finite and at least 0");
}

LimitEnclosure prove_limit(const Manipulator& manipulator, const Limit& limit, const rigorous::Outline& outline,
                           const Interval& orientations, double allowance, const EnclosureOptions& options) {
  const rigorous::Margin margin(manipulator.leg(limit.leg), limit.kind);
  const MinimumEnclosure smallest = to_enclosure(search(margin, outline, orientations, {}, options));
  return {limit, at_least(smallest, -allowance), smallest};
}

PartCheck check_part(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                     const Interval& orientations, const Conditioning& conditioning, const EnclosureOptions& options,
                     Part rigorous::Search::*searched) {
  const rigorous::KappaInverse function(manipulator, conditioning);
  const rigorous::Outline outline(prescribed);
  rigorous::Search what;
  what.*searched = Part::border;
  const MinimumEnclosure border = to_enclosure(search(function, outline, orientations, what, options));
  PartCheck result{Verdict::undecided, border, border};
  if (border.lower <= 0.0) return result;  // nothing can be smaller, and equality to zero cannot be seen by bounds

  what.*searched = Part::interior;
  what.below = border.upper;
  what.found_below = border.lower;
  const rigorous::SearchResult interior = search(function, outline, orientations, what, options);
  result.all.lower = std::min(border.lower, interior.lower);
  result.all.evaluations += interior.evaluations;
  result.all.reached = border.reached && interior.finished;
  if (interior.witness) {
    result.verdict = Verdict::refuted;
    result.all.upper = interior.upper;
    result.all.witness = interior.witness;
  } else if (interior.finished) {
    result.verdict = Verdict::proved;
  }
  return result;
}

}  // namespace

KappaInverseBounds bound_kappa_inverse(const Manipulator& manipulator, const PoseBox& box,
                                       const Conditioning& conditioning) {
  check("x", box.x);
  check("y", box.y);
  check("orientation", box.orientation);
  const rigorous::KappaInverse function(manipulator, conditioning);
  const rigorous::Poses poses{rigorous::to_enclosure(box.x), rigorous::to_enclosure(box.y),
                              rigorous::to_enclosure(box.orientation)};
  const rigorous::Poses centre{median(poses.x), median(poses.y), median(poses.orientation)};
  const rigorous::FirstOrderBounds f = function.first_order(poses);
  const rigorous::Enclosure mean_value = function.value(centre) + f.x * (poses.x - centre.x) +
                                         f.y * (poses.y - centre.y) +
                                         f.orientation * (poses.orientation - centre.orientation);
  // A box too large for its derivatives to be bounded is left with the formula's own bounds.
  const rigorous::Enclosure value = empty(mean_value) ? f.value : intersect(f.value, mean_value);
  return {rigorous::to_interval(value), rigorous::to_interval(f.x), rigorous::to_interval(f.y),
          rigorous::to_interval(f.orientation)};
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::proved:
      return "proved";
    case Verdict::refuted:
      return "refuted";
    case Verdict::undecided:
      return "undecided";
  }
  return "unknown verdict";
}

Verdict at_least(const MinimumEnclosure& smallest, double claimed) {
  if (smallest.lower >= claimed) return Verdict::proved;
  return smallest.upper < claimed ? Verdict::refuted : Verdict::undecided;
}

MinimumEnclosure enclose_minimum(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                                 const Interval& orientations, const Conditioning& conditioning,
                                 const EnclosureOptions& options) {
  check(orientations, options);
  return to_enclosure(search(rigorous::KappaInverse(manipulator, conditioning), rigorous::Outline(prescribed),
                             orientations, {}, options));
}

LimitEnclosure prove_limit(const Manipulator& manipulator, const Limit& limit, const PrescribedWorkspace& prescribed,
                           const Interval& orientations, double allowance, const EnclosureOptions& options) {
  check(orientations, options);
  check_allowance(allowance);
  return prove_limit(manipulator, limit, rigorous::Outline(prescribed), orientations, allowance, options);
}

Containment prove_containment(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                              const Interval& orientations, double allowance, const EnclosureOptions& options) {
  check(orientations, options);
  check_allowance(allowance);
  const rigorous::Outline outline(prescribed);
  Containment result{Verdict::proved, {}, 0, 0};
  for (const Limit& limit : list_limits(manipulator)) {
    result.limits.push_back(prove_limit(manipulator, limit, outline, orientations, allowance, options));
    const LimitEnclosure& last = result.limits.back();
    result.evaluations += last.margin.evaluations;
    if (last.margin.lower < result.limits[result.tightest].margin.lower) result.tightest = result.limits.size() - 1;
    if (result.verdict == Verdict::proved || last.verdict == Verdict::refuted) result.verdict = last.verdict;
  }
  return result;
}

PartCheck check_minimum_on_outline(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                                   const Interval& orientations, const Conditioning& conditioning,
                                   const EnclosureOptions& options) {
  check(orientations, options);
  return check_part(manipulator, prescribed, orientations, conditioning, options, &rigorous::Search::positions);
}

PartCheck check_minimum_at_range_ends(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                                      const Interval& orientations, const Conditioning& conditioning,
                                      const EnclosureOptions& options) {
  check(orientations, options);
  require(orientations.lower < orientations.upper, "the width of the range of orientations", 0.0, "positive");
  return check_part(manipulator, prescribed, orientations, conditioning, options, &rigorous::Search::orientations);
}

}  // namespace reprise
