#include "careful_region.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "reprise/base/constants.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {
namespace {

template <class Real>
struct PlaneVector {
  Real x{};
  Real y{};

  PlaneVector operator+(const PlaneVector& other) const { return {x + other.x, y + other.y}; }
  PlaneVector operator-(const PlaneVector& other) const { return {x - other.x, y - other.y}; }
  PlaneVector operator-() const { return {-x, -y}; }
  PlaneVector operator*(const Real& factor) const { return {x * factor, y * factor}; }
  Real dot(const PlaneVector& other) const { return x * other.x + y * other.y; }
  Real cross(const PlaneVector& other) const { return x * other.y - y * other.x; }
  PlaneVector quarter_turned() const { return {-y, x}; }
  /// Turned by the angle whose cosine and sine the rotation holds.
  PlaneVector turned(const PlaneVector& rotation) const {
    return {rotation.x * x - rotation.y * y, rotation.y * x + rotation.x * y};
  }
  PlaneVector turned_back(const PlaneVector& rotation) const { return turned({rotation.x, -rotation.y}); }
  Real norm() const {
    using std::sqrt;
    return sqrt(x * x + y * y);
  }
};

template <class Real>
PlaneVector<Real> exact(const Eigen::Vector2d& a) {
  return {Real(a.x()), Real(a.y())};
}

template <class Real>
PlaneVector<Real> direction_at(const Real& angle) {
  using std::cos;
  using std::sin;
  return {cos(angle), sin(angle)};
}

template <class Real>
Real half_turn() {
  using std::atan2;
  return atan2(Real(0), Real(-1));
}

/// The limits of limits.hpp and dextrous_limits.hpp, in numbers of more digits.
template <class Real>
class RealLimits {
 public:
  RealLimits(const Manipulator& manipulator, const Interval& orientations, const Eigen::Vector2d& origin)
      : manipulator_(manipulator),
        is_slice_(orientations.lower == orientations.upper),
        is_wide_(orientations.upper - orientations.lower > pi),
        first_(direction_at<Real>(Real(orientations.lower))),
        last_(direction_at<Real>(Real(orientations.upper))) {
    for (const Leg& leg : manipulator.legs()) {
      const PlaneVector<Real> p = exact<Real>(leg.platform_joint);
      FixedLeg& fixed = legs_.emplace_back(FixedLeg{
          exact<Real>(leg.base_joint) - exact<Real>(origin), p, p.norm(), p.turned(first_), p.turned(last_), {}});
      if (leg.base_angle) fixed.wedges.push_back(wedge_of(*leg.base_angle, false));
      if (leg.platform_angle) fixed.wedges.push_back(wedge_of(*leg.platform_angle, true));
    }
  }

  bool hold(const PlaneVector<Real>& u) const {
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      const FixedLeg& leg = legs_[i];
      const PlaneVector<Real> w = u - leg.base;
      if (!length_holds(leg, manipulator_.leg(i).length, w)) return false;
      for (const Wedge& wedge : leg.wedges) {
        if (!wedge_holds(leg, wedge, w)) return false;
      }
    }
    return true;
  }

 private:
  /// constant + amplitude . (cos phi, sin phi).
  struct Sinusoid {
    Real constant;
    PlaneVector<Real> amplitude;
    Real at(const PlaneVector<Real>& rotation) const { return constant + amplitude.dot(rotation); }
  };
  struct Wedge {
    bool is_at_platform;
    bool is_narrow;
    PlaneVector<Real> lower;  ///< outward normals at phi = 0
    PlaneVector<Real> upper;
  };
  struct FixedLeg {
    PlaneVector<Real> base;
    PlaneVector<Real> platform;
    Real arm;
    PlaneVector<Real> first;  ///< R(phi) p at the ends of the range
    PlaneVector<Real> last;
    std::vector<Wedge> wedges;
  };

  static Wedge wedge_of(const Interval& angle, bool is_at_platform) {
    return {is_at_platform, angle.upper - angle.lower < pi, -direction_at<Real>(Real(angle.lower)).quarter_turned(),
            direction_at<Real>(Real(angle.upper)).quarter_turned()};
  }

  bool sweeps(const PlaneVector<Real>& direction) const {
    if (!is_wide_) {
      if (first_.cross(direction) < 0 || direction.cross(last_) < 0) return false;
      // The opposite side, which a narrow range does not tell from its own. Of half a turn the sum would be rounding.
      return first_.dot(last_) < 0 || (first_ + last_).dot(direction) >= 0;
    }
    return !(last_.cross(direction) > 0 && direction.cross(first_) > 0);
  }

  bool length_holds(const FixedLeg& leg, const Interval& length, const PlaneVector<Real>& w) const {
    const auto allows = [&](const Real& value) { return value >= Real(length.lower) && value <= Real(length.upper); };
    if (!allows((w + leg.first).norm())) return false;
    if (is_slice_) return true;
    if (!allows((w + leg.last).norm())) return false;
    const PlaneVector<Real> aligned{w.dot(leg.platform), w.dot(leg.platform.quarter_turned())};
    if (aligned.x == 0 && aligned.y == 0) return true;
    using std::abs;
    const Real distance = w.norm();
    if (sweeps(aligned) && distance + leg.arm > Real(length.upper)) return false;
    return !(sweeps(-aligned) && abs(Real(distance - leg.arm)) < Real(length.lower));
  }

  static Sinusoid edge_distance(const FixedLeg& leg, bool is_at_platform, const PlaneVector<Real>& normal,
                                const PlaneVector<Real>& w) {
    const PlaneVector<Real>& p = leg.platform;
    if (is_at_platform) return {normal.dot(p), {normal.dot(w), normal.quarter_turned().dot(w)}};
    return {normal.dot(w), {normal.dot(p), normal.dot(p.quarter_turned())}};
  }

  bool wedge_holds(const FixedLeg& leg, const Wedge& wedge, const PlaneVector<Real>& w) const {
    const Sinusoid lower = edge_distance(leg, wedge.is_at_platform, wedge.lower, w);
    const Sinusoid upper = edge_distance(leg, wedge.is_at_platform, wedge.upper, w);
    const auto holds_at = [&](const PlaneVector<Real>& rotation) {
      const bool within_lower = lower.at(rotation) <= 0;
      const bool within_upper = upper.at(rotation) <= 0;
      return wedge.is_narrow ? within_lower && within_upper : within_lower || within_upper;
    };
    if (!holds_at(first_)) return false;
    if (is_slice_) return true;
    if (!holds_at(last_)) return false;
    for (const Sinusoid& one : {lower, upper}) {
      const Real size = one.amplitude.norm();
      if (size > 0 && sweeps(one.amplitude) && !holds_at(one.amplitude * Real(1 / size))) return false;
    }
    if (wedge.is_narrow) return true;
    // The largest of the smaller one of both may lie where they are equal.
    const Real constant = lower.constant - upper.constant;
    const PlaneVector<Real> amplitude = lower.amplitude - upper.amplitude;
    const Real size = amplitude.norm();
    using std::abs;
    using std::sqrt;
    if (!(size > abs(constant))) return true;
    const PlaneVector<Real> along = amplitude * Real(1 / size);
    const Real cosine = -constant / size;
    const Real sine = sqrt(Real((1 - cosine) * (1 + cosine)));
    for (const Real& side : {sine, Real(-sine)}) {
      const PlaneVector<Real> rotation = along * cosine + along.quarter_turned() * side;
      if (sweeps(rotation) && !holds_at(rotation)) return false;
    }
    return true;
  }

  const Manipulator& manipulator_;
  bool is_slice_;
  bool is_wide_;
  PlaneVector<Real> first_;
  PlaneVector<Real> last_;
  std::vector<FixedLeg> legs_;
};

/// A circle, or a line (radius 0).
template <class Real>
struct Curve {
  PlaneVector<Real> centre;
  Real radius{0};
  PlaneVector<Real> direction{};
  bool is_line() const { return radius == 0; }
  bool is_point() const { return is_line() && direction.x == 0 && direction.y == 0; }
};

/// The curves of the quick method (owned_curves in exact_workspace.cpp), in their order, with more digits.
template <class Real>
std::vector<Curve<Real>> real_curves(const Manipulator& manipulator, const Interval& orientations,
                                     const Eigen::Vector2d& origin) {
  std::vector<Curve<Real>> curves;
  const auto base_of = [&](const Leg& leg) { return exact<Real>(leg.base_joint) - exact<Real>(origin); };
  const auto add_slice = [&](double orientation) {
    const Real phi(orientation);
    for (const Leg& leg : manipulator.legs()) {
      const PlaneVector<Real> q = base_of(leg) - exact<Real>(leg.platform_joint).turned(direction_at<Real>(phi));
      curves.push_back({q, Real(leg.length.upper), {}});
      if (leg.length.lower > 0.0) curves.push_back({q, Real(leg.length.lower), {}});
      const auto add_edges = [&](const std::optional<Interval>& angle, const Real& turned) {
        if (!angle) return;
        curves.push_back({q, Real(0), direction_at<Real>(Real(angle->lower) + turned)});
        curves.push_back({q, Real(0), direction_at<Real>(Real(angle->upper) + turned)});
      };
      add_edges(leg.base_angle, Real(0));
      add_edges(leg.platform_angle, phi);
    }
  };
  add_slice(orientations.lower);
  if (orientations.lower == orientations.upper) return curves;
  add_slice(orientations.upper);
  using std::abs;
  for (const Leg& leg : manipulator.legs()) {
    const PlaneVector<Real> base = base_of(leg);
    const PlaneVector<Real> platform = exact<Real>(leg.platform_joint);
    const Real arm = platform.norm();
    const auto add_circle = [&](const Real& radius) { curves.push_back({base, radius > 0 ? radius : Real(0), {}}); };
    add_circle(Real(leg.length.upper) - arm);
    add_circle(arm + Real(leg.length.lower));
    add_circle(abs(Real(arm - Real(leg.length.lower))));
    if (leg.base_angle || leg.platform_angle) add_circle(arm);
    if (leg.base_angle) {
      for (const double angle : {leg.base_angle->lower, leg.base_angle->upper}) {
        const PlaneVector<Real> along = direction_at<Real>(Real(angle));
        const PlaneVector<Real> across = along.quarter_turned();
        curves.push_back({base + across * arm, Real(0), along});
        curves.push_back({base - across * arm, Real(0), along});
      }
    }
    if (leg.platform_angle) {
      for (const double angle : {leg.platform_angle->lower, leg.platform_angle->upper}) {
        add_circle(abs(direction_at<Real>(Real(angle)).cross(platform)));
      }
    }
  }
  return curves;
}

template <class Real>
class Slabs {
 public:
  Slabs(const Manipulator& manipulator, const Interval& orientations, const SlabOptions& options)
      : options_(options),
        limits_(manipulator, orientations, options.origin),
        rounding_(8 * std::numeric_limits<Real>::epsilon() * Real(options.size)),
        narrow_(std::max(Real(1e-14 * options.extent), Real(8 * rounding_))),
        pi_(half_turn<Real>()) {
    std::vector<Curve<Real>> all = real_curves<Real>(manipulator, orientations, options.origin);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (options.is_relevant(k) && !all[k].is_point()) curves_.push_back(all[k]);
    }
    turn();
  }

  std::vector<BoundaryLoop> run() {
    find_breaks();
    std::size_t begin = 0;
    std::vector<std::size_t> left;  // the bounds of the slab before, from below to above
    while (begin < breaks_.size()) {
      std::size_t end = begin + 1;
      while (end < breaks_.size() && breaks_[end].x - breaks_[begin].x <= rounding_) ++end;
      std::vector<std::size_t> right;
      if (end < breaks_.size()) right = bounds_between(breaks_[begin].x, breaks_[end].x);
      join(left, right, begin, end);
      left = std::move(right);
      begin = end;
    }
    return loops();
  }

 private:
  using Point = PlaneVector<Real>;

  /// Where two curves cross, or one turns back (then both are the same).
  struct Break {
    Real x;
    Real y;
    std::size_t first;
    std::size_t second;
  };

  /// A curve that bounds the workspace through a whole slab.
  struct Piece {
    std::size_t curve;
    bool is_upper_half;   ///< of its circle
    bool is_lower_bound;  ///< the workspace is above it, so it is run to the right; else to the left
    Point start{};
    Point end{};
    std::size_t next = 0;
    bool used = false;

    bool is_counter_clockwise() const { return is_upper_half != is_lower_bound; }
  };

  /// Turns all curves so that none of the lines is close to upright.
  void turn() {
    double best = -1.0;
    double best_turn = 0.0;
    for (int k = 0; k < 16; ++k) {
      const double turn = 0.37 + 0.193 * k;
      double least = 1.0;
      for (const Curve<Real>& curve : curves_) {
        if (!curve.is_line()) continue;
        const double angle = std::atan2(static_cast<double>(curve.direction.y), static_cast<double>(curve.direction.x));
        least = std::min(least, std::abs(std::cos(angle + turn)));
      }
      if (least <= best) continue;
      best = least;
      best_turn = turn;
    }
    turn_ = Real(best_turn);
    rotation_ = direction_at<Real>(turn_);
    for (Curve<Real>& curve : curves_) {
      curve.centre = curve.centre.turned(rotation_);
      curve.direction = curve.direction.turned(rotation_);
    }
  }

  Eigen::Vector2d unturned(const Point& point) const {
    const Point back = point.turned_back(rotation_);
    return {static_cast<double>(back.x), static_cast<double>(back.y)};
  }

  void find_breaks() {
    const auto add = [&](const Point& point, std::size_t first, std::size_t second) {
      if (!options_.is_far(unturned(point))) breaks_.push_back({point.x, point.y, first, second});
    };
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const Curve<Real>& curve = curves_[i];
      if (!curve.is_line()) {
        add({curve.centre.x - curve.radius, curve.centre.y}, i, i);
        add({curve.centre.x + curve.radius, curve.centre.y}, i, i);
      }
      for (std::size_t j = i + 1; j < curves_.size(); ++j) {
        cross(curve, curves_[j], [&](const Point& point) { add(point, i, j); });
      }
    }
    std::sort(breaks_.begin(), breaks_.end(), [](const Break& a, const Break& b) { return a.x < b.x; });
  }

  /// Where two curves cross, or come so close to each other that what is between them counts as closed: a slab that
  /// reached over such a place would be taken for closed all along.
  template <class Add>
  void cross(const Curve<Real>& a, const Curve<Real>& b, Add&& add) const {
    using std::abs;
    using std::sqrt;
    if (b.is_line() && !a.is_line()) return cross(b, a, add);
    const Point between = b.centre - a.centre;
    if (a.is_line() && b.is_line()) {
      const Real determinant = a.direction.cross(b.direction);
      if (determinant != 0) add(a.centre + a.direction * Real(between.cross(b.direction) / determinant));
      return;
    }
    if (a.is_line()) {
      const Real off = a.direction.cross(between);
      const Real square = (b.radius - off) * (b.radius + off);
      if (abs(off) > b.radius + narrow_) return;
      const Real half = square > 0 ? Real(sqrt(square)) : Real(0);
      const Point middle = a.centre + a.direction * a.direction.dot(between);
      add(middle + a.direction * half);
      add(middle - a.direction * half);
      return;
    }
    const Real distance = between.norm();
    const Real sum = a.radius + b.radius;
    const Real difference = a.radius - b.radius;
    if (distance == 0 || distance > sum + narrow_ || distance < abs(difference) - narrow_) return;
    const Real product = (sum + distance) * (sum - distance) * (distance + difference) * (distance - difference);
    const Real across = product > 0 ? Real(sqrt(product) / (2 * distance)) : Real(0);
    const Real along = (distance + difference * sum / distance) / 2;
    const Point direction = between * Real(1 / distance);
    // Where the centres nearly coincide, the distance has lost digits; the point stays on the circle all the same.
    const Real onto = a.radius / Point{along, across}.norm();
    const Point foot = a.centre + direction * Real(along * onto);
    const Point side = direction.quarter_turned() * Real(across * onto);
    add(foot + side);
    add(foot - side);
  }

  Real height(std::size_t index, bool is_upper_half, const Real& x) const {
    using std::sqrt;
    const Curve<Real>& curve = curves_[index];
    const Real off = x - curve.centre.x;
    if (curve.is_line()) return curve.centre.y + off * curve.direction.y / curve.direction.x;
    const Real square = (curve.radius - off) * (curve.radius + off);
    if (!(square > 0)) return curve.centre.y;
    const Real root = sqrt(square);
    return is_upper_half ? Real(curve.centre.y + root) : Real(curve.centre.y - root);
  }

  /// How far from the truth the height of a curve may be: where a circle turns back, an error of x moves it by the root
  /// of twice the error times the radius. Circles that are hardly more than points have it small beside their radius.
  Real uncertainty_of_height(std::size_t index) const {
    using std::abs;
    using std::sqrt;
    const Curve<Real>& curve = curves_[index];
    const Real error = 8 * rounding_;
    if (curve.is_line()) return error / abs(curve.direction.x);
    return error + sqrt(Real(2 * curve.radius * error));
  }

  std::vector<std::size_t> bounds_between(const Real& from, const Real& to) {
    const Real x = (from + to) / 2;
    branches_.clear();
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      const Curve<Real>& curve = curves_[k];
      if (curve.is_line()) {
        branches_.push_back({height(k, true, x), k, true});
      } else if (x > curve.centre.x - curve.radius && x < curve.centre.x + curve.radius) {
        branches_.push_back({height(k, true, x), k, true});
        branches_.push_back({height(k, false, x), k, false});
      }
    }
    std::sort(branches_.begin(), branches_.end(), [](const Branch& a, const Branch& b) { return a.y < b.y; });
    // A gap that is too narrow to count is closed as its neighbours are: inside only between two that are.
    std::vector<std::size_t> bounds;
    const auto add = [&](std::size_t branch, bool is_lower_bound) {
      bounds.push_back(pieces_.size());
      pieces_.push_back({branches_[branch].curve, branches_[branch].is_upper_half, is_lower_bound});
    };
    bool inside = false;
    std::size_t last = 0;  // the upper end of the last gap that counts
    for (std::size_t k = 0; k + 1 < branches_.size(); ++k) {
      const Real& below = branches_[k].y;
      const Real& above = branches_[k + 1].y;
      if (above - below <= narrow_) continue;
      const Point middle{x, (below + above) / 2};
      const bool here = !options_.is_far(unturned(middle)) && limits_.hold(middle.turned_back(rotation_));
      if (here && !inside) add(k, true);
      if (!here && inside) add(last, false);
      inside = here;
      last = k + 1;
    }
    if (inside) add(last, false);
    return bounds;
  }

  /// One end of a bound at the x between two slabs.
  struct End {
    std::size_t piece;
    Real y;
    bool is_left;  ///< of the slab on the left
    bool opens;    ///< the workspace is above
  };

  std::vector<End> ends_of(const std::vector<std::size_t>& bounds, bool is_left, std::size_t begin,
                           std::size_t end) const {
    using std::abs;
    std::vector<End> ends;
    for (const std::size_t bound : bounds) {
      const Piece& piece = pieces_[bound];
      Real y = height(piece.curve, piece.is_upper_half, breaks_[begin].x);
      // A crossing is known better than the height of a curve that is steep there.
      Real nearest = uncertainty_of_height(piece.curve);
      Real better = y;
      for (std::size_t k = begin; k < end; ++k) {
        const Break& at = breaks_[k];
        if (at.first != piece.curve && at.second != piece.curve) continue;
        const Real off = abs(Real(at.y - y));
        if (off >= nearest) continue;
        nearest = off;
        better = at.y;
      }
      ends.push_back({bound, better, is_left, piece.is_lower_bound});
    }
    return ends;
  }

  /// Joins the bounds on both sides of the x of the breaks from `begin` to `end`.
  void join(const std::vector<std::size_t>& left, const std::vector<std::size_t>& right, std::size_t begin,
            std::size_t end) {
    const std::vector<End> on_left = ends_of(left, true, begin, end);
    const std::vector<End> on_right = ends_of(right, false, begin, end);
    const End* open = nullptr;
    std::size_t i = 0;
    std::size_t j = 0;
    const auto closes_at_once = [&](const std::vector<End>& ends, std::size_t k) {
      return k + 1 < ends.size() && ends[k + 1].y - ends[k].y <= narrow_;
    };
    while (i < on_left.size() || j < on_right.size()) {
      bool take_left = j == on_right.size();
      if (i < on_left.size() && j < on_right.size()) {
        const End& a = on_left[i];
        const End& b = on_right[j];
        using std::abs;
        if (abs(Real(a.y - b.y)) > narrow_) {
          take_left = a.y < b.y;
        } else if (a.opens != b.opens) {
          // Where parts only touch they are kept apart: what closes comes first.
          take_left = !a.opens;
        } else {
          take_left = !a.opens || closes_at_once(on_left, i) || !closes_at_once(on_right, j);
        }
      }
      const End& next = take_left ? on_left[i++] : on_right[j++];
      if (open != nullptr) {
        connect(*open, next, begin, end);
        open = nullptr;
      } else {
        open = &next;
      }
    }
  }

  void connect(const End& a, const End& b, std::size_t begin, std::size_t end) {
    // Bounds from below end on the right, those from above begin there.
    const bool a_ends = a.is_left == a.opens;
    Piece& before = pieces_[a_ends ? a.piece : b.piece];
    Piece& after = pieces_[a_ends ? b.piece : a.piece];
    const Point point = meeting(a, b, begin, end);
    before.end = point;
    before.next = a_ends ? b.piece : a.piece;
    after.start = point;
  }

  Point meeting(const End& a, const End& b, std::size_t begin, std::size_t end) const {
    using std::abs;
    const std::size_t p = pieces_[a.piece].curve;
    const std::size_t q = pieces_[b.piece].curve;
    const Real near = std::max(uncertainty_of_height(p), uncertainty_of_height(q));
    for (std::size_t k = begin; k < end; ++k) {
      const Break& at = breaks_[k];
      const bool both = (at.first == p && at.second == q) || (at.first == q && at.second == p);
      if (both && abs(Real(at.y - a.y)) <= near) return {at.x, at.y};
    }
    // The curve that is less steep knows its height better.
    const auto steepness = [&](std::size_t k, const Real& y) {
      const Curve<Real>& curve = curves_[k];
      if (curve.is_line()) return Real(abs(Real(curve.direction.y)));
      return Real(1 - abs(Real(y - curve.centre.y)) / curve.radius);
    };
    return {breaks_[begin].x, steepness(p, a.y) <= steepness(q, b.y) ? a.y : b.y};
  }

  std::vector<BoundaryLoop> loops() {
    std::vector<BoundaryLoop> result;
    for (std::size_t first = 0; first < pieces_.size(); ++first) {
      if (pieces_[first].used) continue;
      walk_.clear();
      for (std::size_t here = first; !pieces_[here].used; here = pieces_[here].next) {
        pieces_[here].used = true;
        walk_.push_back(here);
      }
      BoundaryLoop loop = loop_of_walk();
      if (!loop.edges.empty()) result.push_back(std::move(loop));
    }
    return result;
  }

  bool goes_on(std::size_t before, std::size_t after) const {
    const Piece& a = pieces_[before];
    const Piece& b = pieces_[after];
    if (a.curve != b.curve) return false;
    return curves_[a.curve].is_line() ? a.is_lower_bound == b.is_lower_bound
                                      : a.is_counter_clockwise() == b.is_counter_clockwise();
  }

  /// Signed angle of a piece of a circle about its centre.
  Real sweep_of(const Piece& piece) const {
    using std::atan2;
    const Curve<Real>& curve = curves_[piece.curve];
    const Point from = piece.start - curve.centre;
    const Point to = piece.end - curve.centre;
    Real sweep = atan2(from.cross(to), from.dot(to));
    // At most half a turn: where it is just that, rounding may have taken the other way.
    if (piece.is_counter_clockwise() && sweep < -1) sweep += 2 * pi_;
    if (!piece.is_counter_clockwise() && sweep > 1) sweep -= 2 * pi_;
    return sweep;
  }

  BoundaryLoop loop_of_walk() const {
    using std::abs;
    using std::atan2;
    const std::size_t count = walk_.size();
    std::size_t begin = 0;
    while (begin < count && goes_on(walk_[(begin + count - 1) % count], walk_[begin])) ++begin;
    BoundaryLoop loop;
    double length = 0.0;
    for (std::size_t k = 0; k < count;) {
      const Piece& first = pieces_[walk_[(begin + k) % count]];
      const Curve<Real>& curve = curves_[first.curve];
      Real sweep = 0;
      std::size_t last = k;
      while (true) {
        if (!curve.is_line()) sweep += sweep_of(pieces_[walk_[(begin + last) % count]]);
        if (last + 1 == count || !goes_on(walk_[(begin + last) % count], walk_[(begin + last + 1) % count])) {
          break;
        }
        ++last;
      }
      const Piece& end = pieces_[walk_[(begin + last) % count]];
      k = last + 1;
      BoundaryEdge edge;
      edge.start = unturned(first.start);
      edge.end = unturned(end.end);
      if (!curve.is_line()) {
        const Point from = first.start - curve.centre;
        edge.centre = unturned(curve.centre);
        edge.radius = static_cast<double>(curve.radius);
        edge.start_angle = static_cast<double>(Real(atan2(from.y, from.x) - turn_));
        edge.sweep = static_cast<double>(sweep);
      }
      if (Real(edge.length()) <= 2 * narrow_) continue;
      length += edge.length();
      loop.edges.push_back(edge);
    }
    for (std::size_t k = 0; k < loop.edges.size(); ++k) {
      loop.edges[(k + 1) % loop.edges.size()].start = loop.edges[k].end;
    }
    // A part without area.
    if (loop.edges.empty() || Real(std::abs(loop.signed_area())) <= narrow_ * Real(length)) return {};
    return loop;
  }

  struct Branch {
    Real y;
    std::size_t curve;
    bool is_upper_half;
  };

  const SlabOptions& options_;
  RealLimits<Real> limits_;
  Real rounding_;  ///< distances that rounding makes up
  Real narrow_;    ///< gaps that do not count
  Real pi_;
  Real turn_{0};
  PlaneVector<Real> rotation_;
  std::vector<Curve<Real>> curves_;
  std::vector<Break> breaks_;
  std::vector<Branch> branches_;
  std::vector<Piece> pieces_;
  std::vector<std::size_t> walk_;
};

}  // namespace

std::vector<BoundaryLoop> careful_loops(const Manipulator& manipulator, const Interval& orientations,
                                        const SlabOptions& options) {
  constexpr double much_larger = 1e4;
  if (options.size <= much_larger * options.extent) return Slabs<long double>(manipulator, orientations, options).run();
  using boost::multiprecision::cpp_bin_float;
  using boost::multiprecision::et_off;
  using boost::multiprecision::number;
  return Slabs<number<cpp_bin_float<50>, et_off>>(manipulator, orientations, options).run();
}

}  // namespace reprise
