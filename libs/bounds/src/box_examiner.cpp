#include "box_examiner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reprise::rigorous {
namespace {

/// About how many points of the outline peaks and limits are looked for at.
constexpr int outline_points = 48;
/// Every so many of them kappa^2 is bounded over the whole box.
constexpr std::size_t conditioning_step = 4;
/// Peaks of kappa^2 in a linear program.
constexpr std::size_t most_peaks = 10;
/// By this share of its half width a box is looked at wider than it is.
constexpr double room = 1.0 / 16.0;
/// In squares of lengths: a limit that is violated in a whole box is by this.
constexpr double slack_room = 1e-10;
/// Limits with less slack than this join a linear program, in squares of the longest leg.
constexpr double near_limit = 0.01;
/// A slab is worth a line of the certificate when it takes this share of the box.
constexpr double worth_cutting = 0.08;

double half_width(const Interval& range) { return 0.5 * (range.upper - range.lower); }
double middle(const Interval& range) { return 0.5 * (range.lower + range.upper); }

Enclosure to_box(const Interval& range) { return {range.lower, range.upper}; }

/// Towards plus or minus infinity, to 24 bits: certificates are shorter for it.
double rounded_down(double x) {
  const auto nearest = static_cast<float>(x);
  return static_cast<double>(
      static_cast<double>(nearest) <= x ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity()));
}
double rounded_up(double x) { return -rounded_down(-x); }

/// The smallest and the largest square of the numbers of an interval, in floating point.
Interval squares(const Interval& range) {
  const double low = range.lower * range.lower;
  const double high = range.upper * range.upper;
  const bool holds_zero = range.lower <= 0.0 && range.upper >= 0.0;
  return {holds_zero ? 0.0 : std::min(low, high), std::max(low, high)};
}

Interval times(double factor, const Interval& range) {
  return factor >= 0.0 ? Interval{factor * range.lower, factor * range.upper}
                       : Interval{factor * range.upper, factor * range.lower};
}

/// The best slabs of one variable found so far.
struct Slabs {
  double lower;
  double upper;
  CertificateTerm below;
  CertificateTerm above;
};

/// What remains of a variable z when  least <= (a - z)^2 + other <= most  is needed for all of a and some of `other`
/// (squares). Takes slabs off either end.
void narrow(Slabs& slabs, const Interval& a, double least, double most, const CertificateTerm& term) {
  if (term.side == LegSide::too_long) {
    const double reach = most > 0.0 ? std::sqrt(most) : 0.0;
    if (a.lower - reach > slabs.lower) {
      slabs.lower = a.lower - reach;
      slabs.below = term;
    }
    if (a.upper + reach < slabs.upper) {
      slabs.upper = a.upper + reach;
      slabs.above = term;
    }
    return;
  }
  if (least <= 0.0) return;
  const double reach = std::sqrt(least);
  const Interval hole{a.upper - reach, a.lower + reach};
  if (hole.lower < slabs.lower && slabs.lower < hole.upper) {
    slabs.lower = hole.upper;
    slabs.below = term;
  }
  if (hole.lower < slabs.upper && slabs.upper < hole.upper) {
    slabs.upper = hole.lower;
    slabs.above = term;
  }
}

bool symmetric_orientations(const SynthesisTask& task) {
  return std::all_of(task.orientations.begin(), task.orientations.end(), [&](const OrientationRange& one) {
    return std::any_of(task.orientations.begin(), task.orientations.end(), [&](const OrientationRange& other) {
      return other.lower == -one.upper && other.upper == -one.lower;
    });
  });
}

bool only_zero(const SynthesisTask& task) {
  return std::all_of(task.orientations.begin(), task.orientations.end(),
                     [](const OrientationRange& one) { return one.lower == 0.0 && one.upper == 0.0; });
}

}  // namespace

BoxExaminer::BoxExaminer(const SynthesisTask& task, const DesignFamily& family, const DesignBox& root)
    : task_(task),
      family_(family),
      curve_(task.prescribed),
      peaks_(family, curve_, outline_points),
      root_(root),
      legs_alike_(family.length(0).lower == family.length(1).lower && family.length(0).upper == family.length(1).upper),
      mirrored_in_y_(family.in_line() && curve_.mirrored_in_y() && symmetric_orientations(task)),
      mirrored_in_x_(curve_.mirrored_in_x() && only_zero(task)) {
  for (const double sigma : peaks_.parameters()) {
    const auto [piece, t] = curve_.split(sigma);
    points_.push_back({piece, t, position({0, piece, t})});
  }
}

Vector2<Enclosure> BoxExaminer::position(const OutlinePose& pose) const {
  const EnclosedPosition point = curve_.enclose(pose.piece, pose.t);
  return {point.x, point.y};
}

Examination BoxExaminer::examine(const DesignBox& box, double target) const {
  Examination result{{}, box, by_symmetry(box), 0, {}};
  if (result.exclusion.kind != CertificateKind::split) return result;
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    const Outcome outcome = cut(result);
    if (outcome == Outcome::left_out) return result;
    if (outcome == Outcome::unchanged) break;
  }
  Variables<double> centre{};
  Box wide;
  double widest = -1.0;
  for (int i = 0; i < family_.variables(); ++i) {
    const Interval& range = result.box[index(i)];
    centre[index(i)] = middle(range);
    const double more = room * half_width(range);
    wide[index(i)] = Enclosure(down(range.lower - more), up(range.upper + more));
    const double share = half_width(range) / half_width(root_[index(i)]);
    if (share > widest) {
      widest = share;
      result.widest = i;
    }
  }
  result.promising = centre;
  const std::vector<DesignPeak> peaks = peaks_.of_conditioning(centre, most_peaks);
  bound_by_conditioning(wide, peaks, target, result.exclusion);
  if (result.exclusion.bound > target) bound_by_combination(result.box, wide, peaks, result);
  return result;
}

Exclusion BoxExaminer::by_symmetry(const DesignBox& box) const {
  if (legs_alike_ && box[0].lower >= box[1].upper) return {CertificateKind::legs_alike, 0.0, {}};
  const Eigen::Vector2d& centre = task_.prescribed.centre();
  if (mirrored_in_y_ && box[3].lower >= centre.y()) return {CertificateKind::mirrored_in_y, 0.0, {}};
  if (mirrored_in_x_ && box[2].upper <= centre.x()) return {CertificateKind::mirrored_in_x, 0.0, {}};
  return {};
}

bool BoxExaminer::violated(const DesignBox& box, const CertificateTerm& term) const {
  Box all;
  for (int i = 0; i < family_.variables(); ++i) all[index(i)] = to_box(box[index(i)]);
  const Orientation& orientation = family_.orientations()[term.pose.orientation];
  const Vector2<Enclosure> v = leg_vector(family_, term.leg, orientation, position(term.pose), all);
  const Enclosure length = squared(v.x) + squared(v.y);
  const Interval& limits = family_.length(term.leg);
  if (term.side == LegSide::too_long) return (length - squared(Enclosure(limits.upper))).lower() > slack_room;
  return (length - squared(Enclosure(limits.lower))).upper() < -slack_room;
}

/// Takes off the box what one limit at one pose leaves out all over a slab of it. What is found in floating point is
/// verified.
BoxExaminer::Outcome BoxExaminer::cut(Examination& result) const {
  DesignBox& box = result.box;
  std::array<Slabs, most_variables> slabs;
  for (int i = 0; i < family_.variables(); ++i) slabs[index(i)] = {box[index(i)].lower, box[index(i)].upper, {}, {}};
  const Interval& r = box[index(family_.r_of())];
  for (std::size_t o = 0; o < family_.orientations().size(); ++o) {
    const Orientation& orientation = family_.orientations()[o];
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const double end = DesignFamily::end_of(leg);
      const Interval across = times(-end * orientation.rounded.versine, r);
      const Interval upwards = times(end * orientation.rounded.sine, r);
      const Interval& x = box[index(family_.x_of(leg))];
      const Interval& y = box[index(family_.y_of(leg))];
      const double most = squared(family_.length(leg).upper) + 2.0 * slack_room;
      const double least = squared(family_.length(leg).lower) - 2.0 * slack_room;
      for (std::size_t k = 0; k < points_.size(); ++k) {
        const Eigen::Vector2d& u = peaks_.positions()[k];
        const Interval from_x{u.x() + across.lower, u.x() + across.upper};
        const Interval from_y{u.y() + upwards.lower, u.y() + upwards.upper};
        const Interval dx = squares({from_x.lower - x.upper, from_x.upper - x.lower});
        const Interval dy = squares({from_y.lower - y.upper, from_y.upper - y.lower});
        const bool too_long = dx.lower + dy.lower > most;
        const bool too_short = dx.upper + dy.upper < least;
        CertificateTerm term{true, 1.0, {o, points_[k].piece, points_[k].t}, leg, LegSide::too_long};
        if (too_long || too_short) {
          term.side = too_long ? LegSide::too_long : LegSide::too_short;
          if (violated(box, term)) {
            result.exclusion = {CertificateKind::limit, 0.0, {term}};
            return Outcome::left_out;
          }
          continue;
        }
        for (const LegSide side : {LegSide::too_long, LegSide::too_short}) {
          term.side = side;
          narrow(slabs[index(family_.x_of(leg))], from_x, least - dy.upper, most - dy.lower, term);
          narrow(slabs[index(family_.y_of(leg))], from_y, least - dx.upper, most - dx.lower, term);
        }
      }
    }
  }
  Outcome outcome = Outcome::unchanged;
  const auto take_off = [&](int variable, double at, bool below, const CertificateTerm& term) {
    Interval& range = box[index(variable)];
    if (!(at > range.lower && at < range.upper)) return;
    const double share = (below ? at - range.lower : range.upper - at) / (range.upper - range.lower);
    if (share < worth_cutting) return;
    DesignBox slab = box;
    (below ? slab[index(variable)].upper : slab[index(variable)].lower) = at;
    if (!violated(slab, term)) return;
    (below ? range.lower : range.upper) = at;
    result.slabs.push_back({variable, at, below, term});
    outcome = Outcome::smaller;
  };
  for (int i = 0; i < family_.variables(); ++i) {
    take_off(i, rounded_down(slabs[index(i)].lower), true, slabs[index(i)].below);
    take_off(i, rounded_up(slabs[index(i)].upper), false, slabs[index(i)].above);
  }
  return outcome;
}

/// The largest of the least values of kappa^2 at some poses.
void BoxExaminer::bound_by_conditioning(const Box& wide, const std::vector<DesignPeak>& peaks, double target,
                                        Exclusion& exclusion) const {
  double best = 0.0;
  const double enough = 1.0 / (target * target);
  const auto look = [&](const OutlinePose& pose, const Vector2<Enclosure>& u) {
    const Orientation& orientation = family_.orientations()[pose.orientation];
    const double least = least_squared_condition(family_, orientation, u, wide);
    if (least <= best) return;
    best = least;
    exclusion.terms = {{false, 1.0, pose, 0, LegSide::too_long}};
  };
  for (const DesignPeak& peak : peaks) {
    if (best <= enough) look(peak.term.pose, position(peak.term.pose));
  }
  for (std::size_t k = 0; k < points_.size() && best <= enough; k += conditioning_step) {
    for (const std::size_t o : family_.conditioned()) look({o, points_[k].piece, points_[k].t}, points_[k].position);
  }
  if (best <= 1.0) return;
  exclusion.kind = CertificateKind::conditioning;
  exclusion.bound = std::min(1.0, (1.0 / sqrt(Enclosure(best))).upper());
}

/// The linear program of a box in the variables delta = (z - middle) / half width, its rows by the middles and radii of
/// interval gradients; then what its multipliers prove.
void BoxExaminer::bound_by_combination(const DesignBox& box, const Box& wide, const std::vector<DesignPeak>& peaks,
                                       Examination& result) const {
  const int variables = family_.variables();
  Variables<double> centre{};
  Variables<double> radius{};
  double longest = 0.0;
  for (std::size_t leg = 0; leg < 3; ++leg) longest = std::max(longest, family_.length(leg).upper);
  for (int i = 0; i < variables; ++i) {
    centre[index(i)] = middle(box[index(i)]);
    radius[index(i)] = (1.0 + room) * half_width(box[index(i)]);
  }
  std::vector<AffineRow> rows;
  std::vector<CertificateTerm> terms;
  std::vector<Variables<double>> blurs;
  const auto add = [&](const DesignPeak& peak, const WithGradient<Enclosure>& function) {
    AffineRow row{peak.function.value, SmallVector::Zero(variables), peak.term.is_limit};
    Variables<double> blur{};
    double sum = 0.0;
    for (int i = 0; i < variables; ++i) {
      const Enclosure& slope = function.gradient[index(i)];
      row.gradient[i] = radius[index(i)] * median(slope);
      blur[index(i)] = 0.5 * radius[index(i)] * width(slope);
      sum += blur[index(i)];
    }
    if (!std::isfinite(sum) || !row.gradient.allFinite()) return;
    row.value += peak.term.is_limit ? sum : -sum;
    rows.push_back(row);
    terms.push_back(peak.term);
    blurs.push_back(blur);
  };
  for (const DesignPeak& peak : peaks) {
    const Orientation& orientation = family_.orientations()[peak.term.pose.orientation];
    const auto function = squared_condition(family_, orientation, position(peak.term.pose), wide);
    if (function) add(peak, *function);
  }
  if (rows.empty()) return;
  for (const DesignPeak& peak : peaks_.of_limits(centre, radius, near_limit * longest * longest)) {
    const Orientation& orientation = family_.orientations()[peak.term.pose.orientation];
    add(peak, limit_slack(family_, peak.term.leg, peak.term.side, orientation, position(peak.term.pose), wide));
  }
  const ProgramResult program = smallest_maximum(rows, variables);
  if (program.status == ProgramStatus::failed || program.multipliers.empty()) return;
  std::vector<CertificateTerm> combined;
  double largest = 0.0;
  for (const RowMultiplier& one : program.multipliers) largest = std::max(largest, one.multiplier);
  Variables<double> blur{};
  for (const RowMultiplier& one : program.multipliers) {
    if (one.multiplier < 1e-10 * largest) continue;
    combined.push_back(terms[one.row]);
    combined.back().multiplier = static_cast<double>(static_cast<float>(one.multiplier));
    for (int i = 0; i < variables; ++i) blur[index(i)] += one.multiplier * blurs[one.row][index(i)];
  }
  // The variable that blurs the inequality most, and a little for its width.
  double most = -1.0;
  for (int i = 0; i < variables; ++i) {
    const double weight = blur[index(i)] + 0.02 * largest * radius[index(i)] / half_width(root_[index(i)]);
    if (weight > most) {
      most = weight;
      result.widest = i;
    }
  }
  if (program.status == ProgramStatus::solved) {
    for (int i = 0; i < variables; ++i) result.promising[index(i)] = centre[index(i)] + radius[index(i)] * program.x[i];
  }
  Exclusion exclusion = verify(wide, std::move(combined));
  if (exclusion.kind == CertificateKind::combination && exclusion.bound < result.exclusion.bound) {
    result.exclusion = std::move(exclusion);
  }
}

/// The mean value form of the sum of all terms over the box.
Exclusion BoxExaminer::verify(const Box& wide, std::vector<CertificateTerm> terms) const {
  Box centre;
  for (int i = 0; i < family_.variables(); ++i) centre[index(i)] = Enclosure(median(wide[index(i)]));
  Enclosure value(0.0);
  Enclosure weight(0.0);
  Variables<Enclosure> gradient;
  gradient.fill(Enclosure(0.0));
  for (const CertificateTerm& term : terms) {
    const Orientation& orientation = family_.orientations()[term.pose.orientation];
    const Vector2<Enclosure> u = position(term.pose);
    WithGradient<Enclosure> all;
    Enclosure here;
    if (term.is_limit) {
      all = limit_slack(family_, term.leg, term.side, orientation, u, wide);
      here = limit_slack(family_, term.leg, term.side, orientation, u, centre).value;
    } else {
      const auto over_box = squared_condition(family_, orientation, u, wide);
      const auto at_centre = squared_condition(family_, orientation, u, centre);
      if (!over_box || !at_centre) return {};
      all = *over_box;
      here = at_centre->value;
      weight += Enclosure(term.multiplier);
    }
    const double factor = term.is_limit ? -term.multiplier : term.multiplier;
    value += factor * here;
    for (int i = 0; i < family_.variables(); ++i) gradient[index(i)] += factor * all.gradient[index(i)];
  }
  for (int i = 0; i < family_.variables(); ++i) value += gradient[index(i)] * (wide[index(i)] - centre[index(i)]);
  if (weight.upper() <= 0.0) {
    return value.lower() > 0.0 ? Exclusion{CertificateKind::combination, 0.0, std::move(terms)} : Exclusion{};
  }
  const Enclosure least = Enclosure(value.lower()) / weight;
  if (!(least.lower() > 1.0)) return {};
  return {CertificateKind::combination, (1.0 / sqrt(Enclosure(least.lower()))).upper(), std::move(terms)};
}

}  // namespace reprise::rigorous
