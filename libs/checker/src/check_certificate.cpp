#include "reprise/checker/check_certificate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <stdexcept>

#include "reprise/base/constants.hpp"

namespace reprise {
namespace {

// Interval arithmetic.

/// The next number. Those of one sign are in the order of their bits; std::nextafter, which does the same, is a call of
/// the C library, and takes most of the time of a check.
double above(double x) {
  if (std::isnan(x) || x == infinity) return x;
  if (x == 0.0) return std::numeric_limits<double>::denorm_min();
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(x) + (x > 0.0 ? 1 : -1));
}
double below(double x) { return -above(-x); }

/// All numbers from lo to hi.
struct Range {
  double lo = 0.0;
  double hi = 0.0;
};

Range number(double x) { return {x, x}; }
Range everything() { return {-infinity, infinity}; }
/// Where an operation has no result (0 times infinity), nothing is known.
Range sound(const Range& x) { return std::isnan(x.lo) || std::isnan(x.hi) ? everything() : x; }

Range operator-(const Range& a) { return {-a.hi, -a.lo}; }
Range operator+(const Range& a, const Range& b) { return sound({below(a.lo + b.lo), above(a.hi + b.hi)}); }
Range operator-(const Range& a, const Range& b) { return a + -b; }
Range operator*(const Range& a, const Range& b) {
  const std::array<double, 4> products{a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  for (const double product : products) {
    if (std::isnan(product)) return everything();
  }
  return {below(*std::min_element(products.begin(), products.end())),
          above(*std::max_element(products.begin(), products.end()))};
}
Range reciprocal(const Range& a) {
  if (a.lo <= 0.0 && a.hi >= 0.0) return everything();
  return {below(1.0 / a.hi), above(1.0 / a.lo)};
}
Range operator/(const Range& a, const Range& b) { return a * reciprocal(b); }
Range square(const Range& a) {
  const double most = std::max(std::abs(a.lo), std::abs(a.hi));
  const double least = a.lo <= 0.0 && a.hi >= 0.0 ? 0.0 : std::min(std::abs(a.lo), std::abs(a.hi));
  return {std::max(0.0, below(least * least)), above(most * most)};
}
Range root(const Range& a) { return {std::max(0.0, below(std::sqrt(std::max(0.0, a.lo)))), above(std::sqrt(a.hi))}; }

/// A value of the C library, moved by four units.
Range library(double x) {
  Range result = number(x);
  for (int unit = 0; unit < 4; ++unit) result = {below(result.lo), above(result.hi)};
  return result;
}
Range cosine(double angle) { return angle == 0.0 ? number(1.0) : library(std::cos(angle)); }
Range sine(double angle) { return angle == 0.0 ? number(0.0) : library(std::sin(angle)); }
/// Powers of numbers within [0, 1] with a positive exponent.
Range power(const Range& x, const Range& exponent) {
  const double least = std::pow(std::max(0.0, x.lo), exponent.hi);
  const double most = std::pow(std::max(0.0, x.hi), exponent.lo);
  return {std::max(0.0, library(least).lo), library(most).hi};
}
/// Sine and cosine of a small range of angles: those of the middle, and no more than half the width apart.
Range around(const Range& at_middle, const Range& angle) {
  const double half = above(angle.hi - angle.lo);
  return at_middle + Range{-half, half};
}

// Values with derivatives along the variables z.

constexpr std::size_t most_variables = 7;

struct Dual {
  Range value;
  std::array<Range, most_variables> slope{};
};

Dual constant(const Range& value) { return {value, {}}; }

template <class SlopeOf>
Dual dual(const Range& value, const SlopeOf& slope_of) {
  Dual result{value, {}};
  for (std::size_t i = 0; i < most_variables; ++i) result.slope[i] = slope_of(i);
  return result;
}
bool zero(const Range& x) { return x.lo == 0.0 && x.hi == 0.0; }
/// Products with an exact zero need no rounding.
Range times(const Range& a, const Range& b) { return zero(a) || zero(b) ? number(0.0) : a * b; }
Range plus(const Range& a, const Range& b) { return zero(a) ? b : zero(b) ? a : a + b; }

Dual operator+(const Dual& a, const Dual& b) {
  return dual(a.value + b.value, [&](std::size_t i) { return plus(a.slope[i], b.slope[i]); });
}
Dual operator-(const Dual& a, const Dual& b) {
  return dual(a.value - b.value, [&](std::size_t i) { return plus(a.slope[i], -b.slope[i]); });
}
Dual operator*(const Dual& a, const Dual& b) {
  return dual(a.value * b.value,
              [&](std::size_t i) { return plus(times(a.slope[i], b.value), times(a.value, b.slope[i])); });
}
Dual square(const Dual& a) {
  const Range twice = number(2.0) * a.value;
  return dual(square(a.value), [&](std::size_t i) { return times(twice, a.slope[i]); });
}
Dual reciprocal(const Dual& a) {
  const Range value = reciprocal(a.value);
  const Range factor = -square(value);
  return dual(value, [&](std::size_t i) { return times(factor, a.slope[i]); });
}
Dual operator+(double a, const Dual& b) { return {number(a) + b.value, b.slope}; }
Dual operator*(const Range& a, const Dual& b) {
  return dual(a * b.value, [&](std::size_t i) { return times(a, b.slope[i]); });
}

// The outline.

struct Point {
  Range x;
  Range y;
};

/// A shape by its pieces.
class Outline {
 public:
  explicit Outline(const PrescribedWorkspace& workspace) : placement_(workspace.placement()) {
    std::visit([&](const auto& shape) { take(shape); }, workspace.shape());
  }

  std::size_t pieces() const { return quadrants_ ? 4 : polar_ ? polar_->angles.size() : vertices_.size(); }
  bool symmetric(std::size_t axis) const {
    if (placement_.rotation != 0.0) return false;
    return box_ || (quadrants_ && semi_axes_[axis] == semi_axes_[axis + 2]);
  }

  Point at(std::size_t piece, double t) const {
    const Point own = quadrants_ ? on_quadrant(piece, t) : polar_ ? on_table(piece, t) : on_edge(piece, t);
    const Range c = number(placement_.scale) * cosine(placement_.rotation);
    const Range s = number(placement_.scale) * sine(placement_.rotation);
    return {number(placement_.centre.x()) + (c * own.x - s * own.y),
            number(placement_.centre.y()) + (s * own.x + c * own.y)};
  }

 private:
  void take_axes(double right, double up, double left, double down, double exponent) {
    quadrants_ = true;
    semi_axes_ = {right, up, left, down};
    exponent_ = exponent;
  }
  void take(const Superellipse& shape) {
    take_axes(shape.semi_axes.x(), shape.semi_axes.y(), shape.semi_axes.x(), shape.semi_axes.y(), shape.exponent);
  }
  void take(const Ellipse& shape) {
    take_axes(shape.semi_axes.x(), shape.semi_axes.y(), shape.semi_axes.x(), shape.semi_axes.y(), 2.0);
  }
  void take(const QuarterEllipses& shape) { take_axes(shape.right, shape.up, shape.left, shape.down, 2.0); }
  void take(const Circle& shape) { take_axes(shape.radius, shape.radius, shape.radius, shape.radius, 2.0); }
  void take(const Rectangle& shape) {
    box_ = true;
    const double x = shape.width / 2.0;
    const double y = shape.height / 2.0;
    vertices_ = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
  }
  void take(const Polygon& shape) { vertices_ = shape.vertices; }
  void take(const PolarTable& shape) { polar_ = shape; }

  Point on_quadrant(std::size_t piece, double t) const {
    const Range t_squared = square(number(t));
    const Range over = number(1.0) + t_squared;
    Range c = (number(1.0) - t_squared) / over;
    Range s = number(2.0) * number(t) / over;
    if (exponent_ != 2.0) {
      const Range exponent = number(2.0) / number(exponent_);
      c = power(c, exponent);
      s = power(s, exponent);
    }
    const auto axis = [&](std::size_t k) { return number(semi_axes_[k]); };
    switch (piece) {
      case 0:
        return {axis(0) * c, axis(1) * s};
      case 1:
        return {-(axis(2) * s), axis(1) * c};
      case 2:
        return {-(axis(2) * c), -(axis(3) * s)};
      default:
        return {axis(0) * s, -(axis(3) * c)};
    }
  }
  Point on_edge(std::size_t piece, double t) const {
    const Eigen::Vector2d& from = vertices_[piece];
    const Eigen::Vector2d& to = vertices_[(piece + 1) % vertices_.size()];
    const Range share = number(t);
    return {number(from.x()) + share * (number(to.x()) - number(from.x())),
            number(from.y()) + share * (number(to.y()) - number(from.y()))};
  }
  Point on_table(std::size_t piece, double t) const {
    const std::size_t next = (piece + 1) % polar_->angles.size();
    const Range share = number(t);
    Range turn = number(polar_->angles[next]) - number(polar_->angles[piece]);
    if (next == 0) turn = turn + Range{2.0 * pi, above(2.0 * pi)};
    const Range radius =
        number(polar_->radii[piece]) + share * (number(polar_->radii[next]) - number(polar_->radii[piece]));
    const Range angle = number(polar_->angles[piece]) + share * turn;
    const double middle = 0.5 * angle.lo + 0.5 * angle.hi;
    return {radius * around(library(std::cos(middle)), angle), radius * around(library(std::sin(middle)), angle)};
  }

  Placement placement_;
  bool quadrants_ = false;
  bool box_ = false;
  std::array<double, 4> semi_axes_{};
  double exponent_ = 2.0;
  std::vector<Eigen::Vector2d> vertices_;
  std::optional<PolarTable> polar_;
};

// The text.

/// Texts one after the other.
std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text.append(part);
  return text;
}

/// What is wrong with a certificate.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Goes through the lines word by word.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  long line() const { return line_; }
  bool at_end() const { return rest_.empty() && words_.empty(); }

  void next_line() {
    if (!words_.empty()) fail("has more words than it should");
    if (rest_.empty()) fail("is missing");
    ++line_;
    const std::size_t end = rest_.find('\n');
    words_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  }
  std::string_view word() {
    const std::size_t end = words_.find(' ');
    const std::string_view first = words_.substr(0, end);
    words_ = end == std::string_view::npos ? std::string_view() : words_.substr(end + 1);
    if (first.empty()) fail("has a word too few");
    return first;
  }
  long whole(long least, long most) {
    const std::string_view text = word();
    long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
      fail(joined({"has '", text, "', not a whole number from ", std::to_string(least), " to ", std::to_string(most)}));
    }
    return value;
  }
  double real() {
    std::string_view text = word();
    const bool negative = text.starts_with('-');
    std::string_view digits = text.substr(negative ? 1 : 0);
    if (!digits.starts_with("0x")) fail(joined({"has '", text, "', not a hexadecimal number"}));
    digits.remove_prefix(2);
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::hex);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
      fail(joined({"has '", text, "', not a hexadecimal number"}));
    }
    return negative ? -value : value;
  }
  [[noreturn]] void fail(std::string_view what) const {
    throw Failure(joined({"Line ", std::to_string(std::max(1L, line_)), " of the certificate ", what, "."}));
  }

 private:
  std::string_view rest_;
  std::string_view words_;
  long line_ = 0;
};

// The check.

using Box = std::vector<Range>;

/// A pose on the outline.
struct Pose2 {
  double phi;
  bool conditioned;  ///< whether kappa counts there
  Point u;
};

class Check {
 public:
  Check(const SynthesisTask& task, const BoundClaim& claim, std::string_view tree)
      : task_(task), claim_(claim), outline_(task.prescribed), reader_(tree) {
    for (const OrientationRange& range : task.orientations) {
      orientations_.push_back({range.lower, true});
      if (range.is_slice()) continue;
      orientations_.push_back({0.5 * range.lower + 0.5 * range.upper, false});
      orientations_.push_back({range.upper, true});
    }
    for (std::size_t leg = 0; leg < 3; ++leg) lengths_[leg] = task.designs.origin().leg(leg).length;
    in_line_ = claim.root.size() == 5;
    target_ = number(1.0) / square(number(claim.bound));
  }

  CheckResult run() {
    CheckResult result;
    try {
      check_root();
      check_tree(result);
      result.proved = true;
    } catch (const Failure& failure) {
      result.failure = failure.what();
    }
    result.lines = reader_.line();
    return result;
  }

 private:
  struct OrientationOf {
    double phi;
    bool conditioned;
  };

  std::size_t r() const { return claim_.root.size() - 1; }
  std::size_t y(std::size_t leg) const { return in_line_ ? 3 : 3 + leg; }
  static double end(std::size_t leg) { return leg == 2 ? 1.0 : -1.0; }

  // The root box.

  /// w as a function of |r|, which it grows with, or not at all.
  Range weight(const Range& size) const {
    const std::optional<double>& given = task_.conditioning.characteristic_length;
    const bool printed = task_.conditioning.normalisation == Normalisation::printed;
    if (!given) return printed ? square(square(size)) : number(1.0);
    const Range length = number(*given);
    return square(printed ? length * size : size / length);
  }

  /// kappa^2 >= (3 + w)(1 + 1 / w) / 36, which falls up to w = sqrt 3 and grows from there.
  bool too_small(double size) const {
    const Range w = weight(number(size));
    return w.lo > 0.0 && square(w).hi <= 3.0 && least_for(w).lo >= target_.hi;
  }
  bool too_large(double size) const {
    const Range w = weight(number(size));
    if (square(w).lo >= 3.0 && least_for(w).lo >= target_.hi) return true;
    // At two orientations a leg is around points 2 r sin(difference / 2) apart, and reaches O' from both.
    for (const OrientationOf& one : orientations_) {
      for (const OrientationOf& other : orientations_) {
        const Range turn = library(std::abs(std::sin(0.5 * (one.phi - other.phi))));
        for (const Interval& length : lengths_) {
          if ((number(size) * turn).lo > length.upper && one.phi != other.phi) return true;
        }
      }
    }
    return false;
  }
  static Range least_for(const Range& w) {
    return (number(3.0) + w) * (number(1.0) + reciprocal(w)) * (number(1.0) / number(36.0));
  }

  void check_root() const {
    const std::size_t size = claim_.root.size();
    if (size != 5 && size != 7)
      throw Failure(joined({"The root box has ", std::to_string(size), " variables, not 5 or 7."}));
    if (!(claim_.bound > 0.0 && claim_.bound <= 1.0)) throw Failure("The bound is not in (0, 1].");
    if (claim_.side != 1 && claim_.side != -1) throw Failure("The side is neither 1 nor -1.");
    for (const Interval& range : claim_.root) {
      if (!(std::isfinite(range.lower) && std::isfinite(range.upper) && range.lower <= range.upper)) {
        throw Failure("A range of the root box is not a range of numbers.");
      }
    }
    const Interval& own = claim_.root[r()];
    const Interval sizes = claim_.side > 0 ? own : Interval{-own.upper, -own.lower};
    const bool from_zero = sizes.lower <= 0.0;
    if (!from_zero && !too_small(sizes.lower))
      throw Failure("The root box leaves out small platforms that may be better.");
    if (!too_large(sizes.upper)) throw Failure("The root box leaves out large platforms that may be better.");
    double moved = infinity;
    for (const OrientationOf& one : orientations_) {
      const Range chord = number(2.0 * sizes.upper) * library(std::abs(std::sin(0.5 * one.phi)));
      moved = std::min(moved, one.phi == 0.0 ? 0.0 : chord.hi);
    }
    double lowest = infinity;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const double reach = moved == 0.0 ? lengths_[leg].upper : above(moved + lengths_[leg].upper);
      require_within(claim_.root[leg], task_.prescribed.centre().x(), reach);
      lowest = std::min(lowest, reach);
      if (!in_line_) require_within(claim_.root[y(leg)], task_.prescribed.centre().y(), reach);
    }
    if (in_line_) require_within(claim_.root[3], task_.prescribed.centre().y(), lowest);
  }

  static void require_within(const Interval& range, double centre, double reach) {
    if ((number(centre) - number(reach)).hi < range.lower || (number(centre) + number(reach)).lo > range.upper) {
      throw Failure("The root box leaves out base joints from which the centre of the workspace is reached.");
    }
  }

  // The tree.

  void check_tree(CheckResult& result) {
    std::vector<Box> open(1);
    for (const Interval& range : claim_.root) open.front().push_back({range.lower, range.upper});
    while (!open.empty()) {
      const Box box = open.back();
      open.pop_back();
      reader_.next_line();
      const std::string_view kind = reader_.word();
      if (kind == "B") {
        const auto variable = static_cast<std::size_t>(reader_.whole(0, static_cast<long>(box.size()) - 1));
        const double at = reader_.real();
        if (!(at >= box[variable].lo && at <= box[variable].hi)) reader_.fail("splits a box outside of it");
        Box half = box;
        half[variable].lo = at;
        open.push_back(half);
        half = box;
        half[variable].hi = at;
        open.push_back(half);
      } else {
        ++result.leaves;
        check_leaf(kind, box);
      }
    }
    if (!reader_.at_end()) reader_.fail("is followed by lines that belong to no box");
  }

  void check_leaf(std::string_view kind, const Box& box) {
    if (kind == "S") {
      claim(lengths_[0].lower == lengths_[1].lower && lengths_[0].upper == lengths_[1].upper && box[0].lo >= box[1].hi);
    } else if (kind == "Y") {
      claim(in_line_ && outline_.symmetric(1) && symmetric_orientations() &&
            box[3].lo >= task_.prescribed.centre().y());
    } else if (kind == "X") {
      claim(outline_.symmetric(0) && at_zero_only() && box[2].hi <= task_.prescribed.centre().x());
    } else if (kind == "L") {
      const Limit2 limit = read_limit();
      claim(slack(limit, duals(box)).value.hi < 0.0);
    } else if (kind == "N") {
      const Pose2 pose = read_pose();
      if (!pose.conditioned) reader_.fail("takes kappa where it does not count");
      claim(least_squared_kappa(pose, box) >= target_.hi);
    } else if (kind == "M") {
      check_combination(box);
    } else {
      reader_.fail(joined({"begins with '", kind, "', which is no kind of line"}));
    }
  }

  void claim(bool holds) const {
    if (!holds) reader_.fail("says what is not true, or not shown, in its box");
  }

  bool symmetric_orientations() const {
    return std::all_of(orientations_.begin(), orientations_.end(), [&](const OrientationOf& one) {
      return std::any_of(orientations_.begin(), orientations_.end(), [&](const OrientationOf& other) {
        return other.phi == -one.phi && other.conditioned == one.conditioned;
      });
    });
  }
  bool at_zero_only() const {
    return std::all_of(orientations_.begin(), orientations_.end(),
                       [](const OrientationOf& one) { return one.phi == 0.0; });
  }

  struct Limit2 {
    std::size_t leg;
    long side;
    Pose2 pose;
  };

  Pose2 read_pose() {
    const auto phi = static_cast<std::size_t>(reader_.whole(0, static_cast<long>(orientations_.size()) - 1));
    const auto piece = static_cast<std::size_t>(reader_.whole(0, static_cast<long>(outline_.pieces()) - 1));
    const double t = reader_.real();
    if (!(t >= 0.0 && t <= 1.0)) reader_.fail("has a t outside of [0, 1]");
    return {orientations_[phi].phi, orientations_[phi].conditioned, outline_.at(piece, t)};
  }
  Limit2 read_limit() {
    const auto leg = static_cast<std::size_t>(reader_.whole(1, 3) - 1);
    const long side = reader_.whole(-1, 1);
    if (side == 0) reader_.fail("has the side 0");
    return {leg, side, read_pose()};
  }

  // The functions.

  static std::vector<Dual> duals(const Box& box) {
    std::vector<Dual> z;
    for (std::size_t i = 0; i < box.size(); ++i) {
      z.push_back(constant(box[i]));
      z.back().slope[i] = number(1.0);
    }
    return z;
  }

  /// l_max^2 - l^2, or l^2 - l_min^2.
  Dual slack(const Limit2& limit, const std::vector<Dual>& z) const {
    Dual x = constant(limit.pose.u.x) - z[limit.leg];
    Dual y_of = constant(limit.pose.u.y) - z[y(limit.leg)];
    if (limit.pose.phi != 0.0) {
      const Range turn = cosine(limit.pose.phi) - number(1.0);
      x = x + number(end(limit.leg)) * turn * z[r()];
      y_of = y_of + number(end(limit.leg)) * sine(limit.pose.phi) * z[r()];
    }
    const Dual length = square(x) + square(y_of);
    const Interval& limits = lengths_[limit.leg];
    return limit.side > 0 ? constant(square(number(limits.upper))) - length
                          : length - constant(square(number(limits.lower)));
  }

  /// X_i / Y_i of the leg's vector in the platform's frame.
  Dual ratio(std::size_t leg, const Pose2& pose, const std::vector<Dual>& z) const {
    const Dual x = constant(pose.u.x) - z[leg];
    const Dual y_of = constant(pose.u.y) - z[y(leg)];
    if (pose.phi == 0.0) return x * reciprocal(y_of);
    const Range c = cosine(pose.phi);
    const Range s = sine(pose.phi);
    const Range e = number(end(leg));
    const Dual across = c * x + s * y_of + e * (number(1.0) - c) * z[r()];
    const Dual upwards = c * y_of - s * x + e * s * z[r()];
    return across * reciprocal(upwards);
  }

  Dual weight(const Dual& r_of) const {
    const std::optional<double>& given = task_.conditioning.characteristic_length;
    const bool printed = task_.conditioning.normalisation == Normalisation::printed;
    if (!given) return printed ? square(square(r_of)) : constant(number(1.0));
    const Range factor = printed ? number(*given) : reciprocal(number(*given));
    return square(factor * r_of);
  }

  Dual squared_kappa(const Pose2& pose, const std::vector<Dual>& z) const {
    const Dual k1 = ratio(0, pose, z);
    const Dual k2 = ratio(1, pose, z);
    const Dual k3 = ratio(2, pose, z);
    const Dual w = weight(z[r()]);
    const Dual t1 = 1.0 + square(k1);
    const Dual t2 = 1.0 + square(k2);
    const Dual t3 = 1.0 + square(k3);
    const Dual apart = reciprocal(square(k1 - k2));
    const Dual a = reciprocal(t1) + reciprocal(t2) + reciprocal(t3);
    const Dual c = t3 + ((4.0 + square(k1 + k3)) * t2 + (4.0 + square(k2 + k3)) * t1) * apart;
    const Dual b = t3 + (square(k1 - k3) * t2 + square(k2 - k3) * t1) * apart;
    return (number(1.0) / number(36.0)) * ((3.0 + a * w) * (c + b * reciprocal(w)));
  }

  /// A lower bound of kappa^2 = (3 c + A b + A c w + 3 b / w) / 36 over a box; A c w + 3 b / w >= 2 sqrt(3 A b c).
  double least_squared_kappa(const Pose2& pose, const Box& box) const {
    const std::vector<Dual> z = duals(box);
    std::array<Range, 3> k;
    std::array<double, 3> t;
    double a = 0.0;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      k[leg] = ratio(leg, pose, z).value;
      const Range one_more = number(1.0) + square(k[leg]);
      if (!std::isfinite(one_more.hi)) return 0.0;
      t[leg] = one_more.lo;
      a = below(a + below(1.0 / one_more.hi));
    }
    const double apart = square(k[0] - k[1]).hi;
    if (!(apart > 0.0)) return 0.0;
    const auto low = [](const Range& x) { return number(x.lo); };
    const Range over = number(apart);
    const Range c = number(t[2]) + ((number(4.0) + low(square(k[0] + k[2]))) * number(t[1]) +
                                    (number(4.0) + low(square(k[1] + k[2]))) * number(t[0])) /
                                       over;
    const Range b =
        number(t[2]) + (low(square(k[0] - k[2])) * number(t[1]) + low(square(k[1] - k[2])) * number(t[0])) / over;
    const Range fixed = number(3.0) * low(c) + number(a) * low(b);
    const Range rising = number(a) * low(c);
    const Range falling = number(3.0) * low(b);
    const Range w = weight(z[r()]).value;
    Range rest = number(2.0) * root(low(rising * falling));
    for (const double weight_of : {w.lo, w.hi}) {
      if (!(weight_of > 0.0) || !std::isfinite(weight_of)) continue;
      const Range slope = rising - falling / square(number(weight_of));
      const bool least_here = weight_of == w.lo ? slope.lo >= 0.0 : slope.hi <= 0.0;
      if (least_here) rest = rising * number(weight_of) + falling / number(weight_of);
    }
    return ((fixed + rest) / number(36.0)).lo;
  }

  /// The mean value form of sum lambda (kappa^2 - 1 / bound^2) - sum mu slack.
  void check_combination(const Box& box) {
    const long terms = reader_.whole(1, 1000);
    const std::vector<Dual> over_box = duals(box);
    Box middle;
    for (const Range& range : box) middle.push_back(number(0.5 * range.lo + 0.5 * range.hi));
    const std::vector<Dual> at_middle = duals(middle);
    Dual sum = constant(number(0.0));
    Range value = number(0.0);
    bool any_kappa = false;
    for (long k = 0; k < terms; ++k) {
      reader_.next_line();
      const std::string_view kind = reader_.word();
      const double multiplier = reader_.real();
      if (!(multiplier >= 0.0)) reader_.fail("has a negative multiplier");
      if (kind == "F") {
        const Pose2 pose = read_pose();
        if (!pose.conditioned) reader_.fail("takes kappa where it does not count");
        any_kappa = any_kappa || multiplier > 0.0;
        sum = sum + number(multiplier) * squared_kappa(pose, over_box);
        value = value + number(multiplier) * (squared_kappa(pose, at_middle).value - target_);
      } else if (kind == "L") {
        const Limit2 limit = read_limit();
        sum = sum - number(multiplier) * slack(limit, over_box);
        value = value - number(multiplier) * slack(limit, at_middle).value;
      } else {
        reader_.fail(joined({"begins with '", kind, "', not with F or L"}));
      }
    }
    for (std::size_t i = 0; i < box.size(); ++i) value = value + sum.slope[i] * (box[i] - middle[i]);
    claim(any_kappa ? value.lo >= 0.0 : value.lo > 0.0);
  }

  const SynthesisTask& task_;
  const BoundClaim& claim_;
  Outline outline_;
  Reader reader_;
  std::vector<OrientationOf> orientations_;
  std::array<Interval, 3> lengths_;
  bool in_line_;
  Range target_;  ///< 1 / bound^2
};

/// Throws unless the designs are those of the thesis's family.
void require_family(const DesignSpace& designs) {
  const auto refuse = [](const char* what) {
    throw std::invalid_argument(
        joined({"A certificate is of manipulators of the thesis's family, not of ", what, "."}));
  };
  if (designs.legs() != 3) refuse("ones without three legs");
  for (const Leg& leg : designs.origin().legs()) {
    if (leg.base_angle || leg.platform_angle) refuse("ones whose joint angles have limits");
  }
  // Rows are [c_x, c_y, p_x, p_y] of each leg, columns x_C, y_C, x_D, x_E and r.
  Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(12, 5);
  joints(0, 0) = joints(4, 2) = joints(8, 3) = 1.0;
  joints(1, 1) = joints(5, 1) = joints(9, 1) = 1.0;
  joints(2, 4) = joints(6, 4) = -1.0;
  joints(10, 4) = 1.0;
  if (designs.size() != 5 || designs.joint_map() != joints) refuse("ones whose joints follow a design otherwise");
  if (!designs.length_map().isZero(0.0)) refuse("ones whose limits depend on the design");
  const Manipulator of_zero = designs.manipulator(Eigen::VectorXd::Zero(5));
  for (const Leg& leg : of_zero.legs()) {
    if (!leg.base_joint.isZero(0.0) || !leg.platform_joint.isZero(0.0)) refuse("ones whose joints are moved");
  }
  for (const Eigen::VectorXd& bound : {designs.lower(), designs.upper()}) {
    if (!std::all_of(bound.begin(), bound.end(), [](double x) { return std::isinf(x); })) refuse("ones within bounds");
  }
}

}  // namespace

CheckResult check_certificate(const SynthesisTask& task, const BoundClaim& claim, std::string_view tree) {
  require_family(task.designs);
  return Check(task, claim, tree).run();
}

}  // namespace reprise
