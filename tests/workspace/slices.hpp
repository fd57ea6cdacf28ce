#pragma once

// The area of a workspace by slices, in numbers of 64 binary digits: what is independent of curves that are cut and
// joined. Header only.
//
// On the line y = const every limit of every leg allows a few intervals of x, in closed form. Between two heights at
// which a circle turns back or two curves cross, the ends of what all limits allow stay on the same arcs and lines, and
// the area between those is elementary: trapezoids, and the segments that arcs cut off beyond their chords. Three
// slices of such a panel, near its ends and in its middle, say which arcs and lines they are; where they do not agree,
// because a crossing was lost to rounding, the panel is halved.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise::test {

/// Areas, parts and holes of workspaces at one orientation, and of dextrous ones.
class Slices {
 public:
  using Real = long double;

  Slices(const Manipulator& manipulator, const Interval& orientations)
      : is_slice_(orientations.lower == orientations.upper) {
    // From the first base joint, as far as this is exact.
    origin_ = manipulator.leg(0).base_joint;
    range_ = {orientations.lower, orientations.upper};
    for (const Leg& leg : manipulator.legs()) {
      legs_.push_back(leg);
      first_.push_back(fix(leg, range_.first));
      last_.push_back(fix(leg, range_.second));
    }
    for (const Leg& leg : legs_) add_curves(leg);
    lower_ = -infinity;
    upper_ = infinity;
    left_ = -infinity;
    right_ = infinity;
    for (const Leg& leg : legs_) {
      for (const Real phi : {range_.first, range_.second}) {
        const Point q = centre(leg, phi);
        lower_ = std::max(lower_, q.y - leg.length.upper);
        upper_ = std::min(upper_, q.y + leg.length.upper);
        left_ = std::max(left_, q.x - leg.length.upper);
        right_ = std::min(right_, q.x + leg.length.upper);
      }
    }
  }

  /// The size of a box about the workspace.
  double extent() const {
    return lower_ < upper_ && left_ < right_ ? static_cast<double>(std::hypot(upper_ - lower_, right_ - left_)) : 0.0;
  }

  /// Correct to `uncertain`: the rounding of the curves, and what slices do not tell.
  double area(double& uncertain) {
    uncertain = 0.0;
    if (extent() == 0.0) return 0.0;
    Real scale = 0;
    for (const Curve& curve : curves_) {
      scale = std::max({scale, std::abs(curve.centre.x), std::abs(curve.centre.y), curve.radius});
    }
    uncertain = static_cast<double>(4 * std::numeric_limits<Real>::epsilon() * scale) * extent();
    const std::vector<Real> breaks = find_breaks();
    Real sum = 0;
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      if (breaks[k + 1] - breaks[k] <= 2e-19L * (1 + std::abs(breaks[k]))) continue;
      sum += area_between(breaks[k], breaks[k + 1], 0, uncertain);
    }
    return static_cast<double>(sum);
  }

  /// How many parts the workspace has, and how many holes.
  struct Topology {
    std::size_t components;
    std::size_t holes;
    bool operator==(const Topology&) const = default;
  };

  /// Nothing where parts are so close to each other that slices do not tell whether they hang together.
  std::optional<Topology> topology() {
    if (extent() == 0.0) return Topology{0, 0};
    const std::vector<Real> breaks = find_breaks();
    Connections inside(1e-4L * extent());
    Connections outside(1e-4L * extent());
    const std::vector<std::pair<Real, Real>> everywhere{{-infinity, infinity}};
    outside.add(everywhere);
    inside.add({});
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      const Real height = breaks[k + 1] - breaks[k];
      // One point, found from several pairs of curves. What is higher may be a neck.
      if (height <= 1e-18L * extent()) continue;
      if (height < 1e-6L * extent()) return std::nullopt;
      std::optional<std::size_t> count;
      for (const Real y : {breaks[k] + 1e-9L * height, breaks[k] + height / 2, breaks[k + 1] - 1e-9L * height}) {
        slice_at(y);
        if (count && *count != parts_.size()) return std::nullopt;
        const bool same_panel = count.has_value();
        count = parts_.size();
        std::vector<std::pair<Real, Real>> parts;
        std::vector<std::pair<Real, Real>> gaps;
        Real from = -infinity;
        for (const Part& part : parts_) {
          parts.emplace_back(part.from.x, part.to.x);
          gaps.emplace_back(from, part.from.x);
          from = part.to.x;
        }
        gaps.emplace_back(from, infinity);
        // In the middle of a panel nothing ends: what is narrow there is so all along.
        const auto is_narrow = [&](const std::pair<Real, Real>& one) {
          return one.second - one.first < 1e-10L * extent();
        };
        const bool at_middle = y > breaks[k] + height / 3 && y < breaks[k + 1] - height / 3;
        if (at_middle &&
            (std::any_of(parts.begin(), parts.end(), is_narrow) || std::any_of(gaps.begin(), gaps.end(), is_narrow))) {
          return std::nullopt;
        }
        const bool clear =
            same_panel ? inside.follow(parts) && outside.follow(gaps) : inside.add(parts) && outside.add(gaps);
        if (!clear) return std::nullopt;
      }
    }
    if (!outside.add(everywhere)) return std::nullopt;
    return Topology{inside.count(), outside.count() - 1};
  }

 private:
  /// Intervals of one slice after the other, and which of them hang together.
  class Connections {
   public:
    explicit Connections(Real narrow) : narrow_(narrow) {}

    /// The intervals of the next slice, beyond a break. False where an overlap is too short to tell.
    bool add(const std::vector<std::pair<Real, Real>>& parts) {
      const std::size_t first = parents_.size();
      for (std::size_t k = 0; k < parts.size(); ++k) parents_.push_back(first + k);
      for (std::size_t k = 0; k < parts.size(); ++k) {
        for (std::size_t j = 0; j < last_.size(); ++j) {
          const Real overlap = std::min(parts[k].second, last_[j].second) - std::max(parts[k].first, last_[j].first);
          if (std::abs(overlap) <= narrow_) return false;
          if (overlap > 0) parents_[root(first + k)] = root(first_of_last_ + j);
        }
      }
      last_ = parts;
      first_of_last_ = first;
      return true;
    }
    /// The same intervals a little further on.
    bool follow(const std::vector<std::pair<Real, Real>>& parts) {
      last_ = parts;
      return true;
    }
    std::size_t count() {
      std::size_t roots = 0;
      for (std::size_t k = 0; k < parents_.size(); ++k) roots += root(k) == k ? 1 : 0;
      return roots;
    }

   private:
    std::size_t root(std::size_t k) {
      while (parents_[k] != k) k = parents_[k] = parents_[parents_[k]];
      return k;
    }
    Real narrow_;
    std::vector<std::size_t> parents_;
    std::vector<std::pair<Real, Real>> last_;
    std::size_t first_of_last_ = 0;
  };

  static constexpr Real infinity = std::numeric_limits<Real>::infinity();
  struct Point {
    Real x;
    Real y;
  };
  /// A circle, or a line where the radius is 0.
  struct Curve {
    Point centre;
    Real radius;
    Point along;
  };

  /// One end of what the limits allow on a line y = const: on the left or right half of a circle, or on a line.
  struct End {
    Real x;
    std::size_t curve;
    int half;  ///< -1 or 1, 0 on a line
  };
  /// An interval of x that the limits allow.
  struct Part {
    End from;
    End to;
  };

  /// The area between two heights, by the parts in three slices.
  Real area_between(Real from, Real to, int depth, double& uncertain) {
    const Real height = to - from;
    const auto by_slice = [&](Real y) {
      slice_at(y);
      Real sum = 0;
      for (const Part& part : parts_) sum += integral(part.to, from, to) - integral(part.from, from, to);
      return sum;
    };
    const Real middle = from + height / 2;
    const std::array<Real, 3> areas{by_slice(from + 1e-3L * height), by_slice(middle), by_slice(to - 1e-3L * height)};
    const auto [least, greatest] = std::minmax_element(areas.begin(), areas.end());
    const Real spread = *greatest - *least;
    const Real accurate = 1e-17L * extent() * extent();
    if (!(spread > accurate) || depth == 60 || middle <= from || middle >= to) {
      uncertain += static_cast<double>(spread);
      return areas[1];
    }
    return area_between(from, middle, depth + 1, uncertain) + area_between(middle, to, depth + 1, uncertain);
  }

  /// The point of a curve's half at the height y.
  Real x_at(const End& end, Real y) const {
    const Curve& curve = curves_[end.curve];
    const Real off = y - curve.centre.y;
    if (end.half == 0) return curve.centre.x + off / curve.along.y * curve.along.x;
    const Real square = (curve.radius - off) * (curve.radius + off);
    return curve.centre.x + end.half * std::sqrt(std::max(square, Real(0)));
  }

  /// The integral of x along a curve's half, over y.
  Real integral(const End& end, Real from, Real to) const {
    const Real height = to - from;
    const Real first = x_at(end, from);
    const Real last = x_at(end, to);
    const Real trapezoid = height * (first + last) / 2;
    if (end.half == 0) return trapezoid;
    const Curve& circle = curves_[end.curve];
    const Real half_chord = std::hypot(height, last - first) / 2;
    const Real distance = std::hypot(from + height / 2 - circle.centre.y, first + (last - first) / 2 - circle.centre.x);
    const Real angle = 2 * std::atan2(half_chord, distance);
    return trapezoid + end.half * circle.radius * circle.radius / 2 * less_sine(angle);
  }

  /// t - sin t, not negative.
  static Real less_sine(Real t) {
    if (t > 1) return t - std::sin(t);
    Real term = t * t * t / 6;
    Real sum = term;
    for (int k = 4; std::abs(term) > 1e-21L * sum; k += 2) sum += term *= -t * t / Real(k * (k + 1));
    return sum;
  }

  static Point direction(Real angle) { return {std::cos(angle), std::sin(angle)}; }
  Point base(const Leg& leg) const {
    return {Real(leg.base_joint.x()) - Real(origin_.x()), Real(leg.base_joint.y()) - Real(origin_.y())};
  }
  Point centre(const Leg& leg, Real phi) const {
    const Point c = base(leg);
    const Point e = direction(phi);
    const Real px = leg.platform_joint.x();
    const Real py = leg.platform_joint.y();
    return {c.x - (e.x * px - e.y * py), c.y - (e.y * px + e.x * py)};
  }

  void add_curves(const Leg& leg) {
    const auto circle = [&](const Point& at, Real radius) {
      if (radius > 0) curves_.push_back({at, radius, {}});
    };
    const auto line = [&](const Point& at, Real angle) { curves_.push_back({at, 0, direction(angle)}); };
    for (const Real phi : {range_.first, range_.second}) {
      const Point q = centre(leg, phi);
      circle(q, leg.length.upper);
      circle(q, leg.length.lower);
      if (leg.base_angle) {
        line(q, leg.base_angle->lower);
        line(q, leg.base_angle->upper);
      }
      if (leg.platform_angle) {
        line(q, leg.platform_angle->lower + phi);
        line(q, leg.platform_angle->upper + phi);
      }
      if (is_slice_) break;
    }
    if (is_slice_) return;
    const Point c = base(leg);
    const Real px = leg.platform_joint.x();
    const Real py = leg.platform_joint.y();
    const Real arm = std::hypot(px, py);
    circle(c, Real(leg.length.upper) - arm);
    circle(c, Real(leg.length.lower) + arm);
    circle(c, std::abs(arm - Real(leg.length.lower)));
    if (leg.base_angle || leg.platform_angle) circle(c, arm);
    if (leg.base_angle) {
      for (const Real angle : {Real(leg.base_angle->lower), Real(leg.base_angle->upper)}) {
        const Point e = direction(angle);
        line({c.x - arm * e.y, c.y + arm * e.x}, angle);
        line({c.x + arm * e.y, c.y - arm * e.x}, angle);
      }
    }
    if (leg.platform_angle) {
      for (const Real angle : {Real(leg.platform_angle->lower), Real(leg.platform_angle->upper)}) {
        const Point e = direction(angle);
        circle(c, std::abs(e.x * py - e.y * px));
      }
    }
  }

  std::vector<Real> find_breaks() const {
    std::vector<Real> breaks{lower_, upper_};
    const Real touching = 1e-9L * extent();
    const auto add = [&](Real x, Real y) {
      if (y > lower_ && y < upper_ && !is_far({x, y})) breaks.push_back(y);
    };
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const Curve& a = curves_[i];
      if (a.radius > 0) {
        add(a.centre.x, a.centre.y - a.radius);
        add(a.centre.x, a.centre.y + a.radius);
      }
      for (std::size_t j = 0; j < i; ++j) {
        const Curve& b = curves_[j];
        const Real dx = b.centre.x - a.centre.x;
        const Real dy = b.centre.y - a.centre.y;
        if (a.radius == 0 && b.radius == 0) {
          const Real determinant = a.along.x * b.along.y - a.along.y * b.along.x;
          const Real at = (dx * b.along.y - dy * b.along.x) / determinant;
          if (determinant != 0) add(a.centre.x + at * a.along.x, a.centre.y + at * a.along.y);
        } else if (a.radius == 0 || b.radius == 0) {
          const Curve& line = a.radius == 0 ? a : b;
          const Curve& round = a.radius == 0 ? b : a;
          const Real x = round.centre.x - line.centre.x;
          const Real y = round.centre.y - line.centre.y;
          const Real off = line.along.x * y - line.along.y * x;
          const Real at = line.along.x * x + line.along.y * y;
          const Real half = std::sqrt(std::max((round.radius - off) * (round.radius + off), Real(0)));
          // A narrow place between them, whether or not they meet.
          if (std::abs(std::abs(off) - round.radius) <= touching) {
            add(line.centre.x + at * line.along.x, line.centre.y + at * line.along.y);
          }
          if (std::abs(off) > round.radius * (1 + 1e-15L)) continue;
          for (const Real there : {at + half, at - half}) {
            add(line.centre.x + there * line.along.x, line.centre.y + there * line.along.y);
          }
        } else {
          const Real d = std::hypot(dx, dy);
          const Real sum = a.radius + b.radius;
          const Real difference = a.radius - b.radius;
          if (d == 0) continue;
          if (std::min(std::abs(d - sum), std::abs(d - std::abs(difference))) <= touching) {
            const Real toward = (d < std::abs(difference) + touching && difference < 0 ? -a.radius : a.radius) / d;
            add(a.centre.x + toward * dx, a.centre.y + toward * dy);
          }
          if (d > sum * (1 + 1e-15L) || d < std::abs(difference) * (1 - 1e-15L)) continue;
          const Real product = (sum + d) * (sum - d) * (d + difference) * (d - difference);
          const Real across = std::sqrt(std::max(product, Real(0))) / (2 * d);
          const Real along = (d + difference * sum / d) / 2;
          for (const Real side : {across, -across}) {
            add(a.centre.x + (along * dx - side * dy) / d, a.centre.y + (along * dy + side * dx) / d);
          }
        }
      }
    }
    std::sort(breaks.begin(), breaks.end());
    return breaks;
  }

  /// Whether a point violates a limit at an end of the range by much more than rounding: what happens there is outside.
  bool is_far(const Point& u) const {
    const Real slack = 1e-6L * extent();
    const auto violated = [&](const FixedLeg& leg) {
      const Real ax = u.x - leg.centre.x;
      const Real ay = u.y - leg.centre.y;
      const Real length = std::hypot(ax, ay);
      if (length > Real(leg.length.upper) + slack || length < Real(leg.length.lower) - slack) return true;
      return std::any_of(leg.wedges.begin(), leg.wedges.end(), [&](const FixedLeg::Wedge& wedge) {
        const bool right = wedge.lower.x * ay - wedge.lower.y * ax < -slack;
        const bool left = wedge.upper.x * ay - wedge.upper.y * ax > slack;
        return wedge.is_narrow ? left || right : left && right;
      });
    };
    return std::any_of(first_.begin(), first_.end(), violated) || std::any_of(last_.begin(), last_.end(), violated);
  }

  /// Leaves what the limits allow on the line at the height y in parts_.
  void slice_at(Real y) {
    ends_.clear();
    const auto add = [&](Real x, std::size_t curve, int half) {
      if (x >= left_ && x <= right_) ends_.push_back({x, curve, half});
    };
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      const Curve& curve = curves_[k];
      const Real off = y - curve.centre.y;
      if (curve.radius == 0) {
        if (curve.along.y != 0) add(curve.centre.x + off / curve.along.y * curve.along.x, k, 0);
        continue;
      }
      const Real square = (curve.radius - off) * (curve.radius + off);
      if (square <= 0) continue;
      const Real root = std::sqrt(square);
      add(curve.centre.x - root, k, -1);
      add(curve.centre.x + root, k, 1);
    }
    std::sort(ends_.begin(), ends_.end(), [](const End& one, const End& other) { return one.x < other.x; });
    parts_.clear();
    // Left of the first end and right of the last some largest length is exceeded.
    for (std::size_t k = 0; k + 1 < ends_.size(); ++k) {
      const Real width = ends_[k + 1].x - ends_[k].x;
      if (!(width > 0) || !holds(ends_[k].x + width / 2, y)) continue;
      if (!parts_.empty() && parts_.back().to.x == ends_[k].x) {
        parts_.back().to = ends_[k + 1];
      } else {
        parts_.push_back({ends_[k], ends_[k + 1]});
      }
    }
  }

  bool holds(Real x, Real y) const {
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      if (!holds_at(first_[i], x, y) || !(is_slice_ || holds_at(last_[i], x, y))) return false;
    }
    return is_slice_ ||
           std::all_of(legs_.begin(), legs_.end(), [&](const Leg& leg) { return holds_between(leg, x, y); });
  }

  /// Whether a leg's limits hold at all orientations between the ends at which one of them is extreme.
  bool holds_between(const Leg& leg, Real x, Real y) const {
    const Point c = base(leg);
    const Real px = leg.platform_joint.x();
    const Real py = leg.platform_joint.y();
    const Real wx = x - c.x;
    const Real wy = y - c.y;
    const Real turn = std::atan2(wy, wx) - std::atan2(py, px);  // R(phi) p along w
    const Real half_turn = std::numbers::pi_v<Real>;
    const auto inside = [&](Real phi) {
      Real above = std::fmod(phi - range_.first, 2 * half_turn);
      if (above < 0) above += 2 * half_turn;
      return above <= range_.second - range_.first ? std::pair(true, range_.first + above) : std::pair(false, phi);
    };
    const Real w = std::hypot(wx, wy);
    const Real arm = std::hypot(px, py);
    if (inside(turn).first && w + arm > Real(leg.length.upper)) return false;
    if (inside(turn + half_turn).first && std::abs(w - arm) < Real(leg.length.lower)) return false;
    const auto wedge_holds = [&](const Interval& angle, bool at_platform) {
      // Edge distances, n . (w + R p) or n . (R^T w + p), are extreme where the turning part is along n, and both are
      // equal where the difference of the normals is at right angles to the whole.
      const auto check = [&](Real phi) {
        const auto [is_inside, there] = inside(phi);
        return !is_inside || holds_at(fix(leg, there), x, y);
      };
      for (const Real edge : {Real(angle.lower), Real(angle.upper)}) {
        for (const Real side : {-half_turn / 2, half_turn / 2}) {
          const Real normal = edge + side;
          if (!check(at_platform ? std::atan2(wy, wx) - normal : normal - std::atan2(py, px))) return false;
        }
      }
      if (angle.upper - angle.lower < pi) return true;
      // On the wedge's bisector, or opposite to it: the turning part's component across the bisector cancels the rest.
      const Real bisector = (Real(angle.lower) + Real(angle.upper)) / 2;
      const Real cx = -std::sin(bisector);
      const Real cy = std::cos(bisector);
      const Real fixed = at_platform ? cx * px + cy * py : cx * wx + cy * wy;
      const Real size = at_platform ? w : arm;
      if (std::abs(fixed) >= size) return true;
      const Real bend = std::acos(-fixed / size);
      for (const Real side : {-bend, bend}) {
        const Real part = bisector + half_turn / 2 + side;  // direction of the turning part
        if (!check(at_platform ? std::atan2(wy, wx) - part : part - std::atan2(py, px))) return false;
      }
      return true;
    };
    return (!leg.base_angle || wedge_holds(*leg.base_angle, false)) &&
           (!leg.platform_angle || wedge_holds(*leg.platform_angle, true));
  }

  /// A leg at one orientation.
  struct FixedLeg {
    Point centre;
    Interval length;
    struct Wedge {
      Point lower;
      Point upper;
      bool is_narrow;
    };
    std::vector<Wedge> wedges;
  };

  FixedLeg fix(const Leg& leg, Real phi) const {
    FixedLeg fixed{centre(leg, phi), leg.length, {}};
    const auto add = [&](const Interval& angle, Real turned) {
      fixed.wedges.push_back({direction(Real(angle.lower) + turned), direction(Real(angle.upper) + turned),
                              angle.upper - angle.lower < pi});
    };
    if (leg.base_angle) add(*leg.base_angle, 0);
    if (leg.platform_angle) add(*leg.platform_angle, phi);
    return fixed;
  }

  static bool holds_at(const FixedLeg& leg, Real x, Real y) {
    const Real ax = x - leg.centre.x;
    const Real ay = y - leg.centre.y;
    const Real length = std::sqrt(ax * ax + ay * ay);
    if (length > Real(leg.length.upper) || length < Real(leg.length.lower)) return false;
    return std::all_of(leg.wedges.begin(), leg.wedges.end(), [&](const FixedLeg::Wedge& wedge) {
      const bool left = wedge.lower.x * ay - wedge.lower.y * ax >= 0;
      const bool right = wedge.upper.x * ay - wedge.upper.y * ax <= 0;
      return wedge.is_narrow ? left && right : left || right;
    });
  }

  bool is_slice_;
  Eigen::Vector2d origin_;
  std::pair<Real, Real> range_;
  std::vector<Leg> legs_;
  std::vector<FixedLeg> first_;  ///< at the ends of the range
  std::vector<FixedLeg> last_;
  std::vector<Curve> curves_;
  Real lower_, upper_, left_, right_;
  std::vector<End> ends_;
  std::vector<Part> parts_;
};

}  // namespace reprise::test
