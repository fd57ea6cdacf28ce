#pragma once

// The assembly modes of manipulators on a lattice, counted in whole numbers: what is independent of rounding, and of
// how the library eliminates. Header only.
//
// Joints have whole coordinates, and the squares L_i of the lengths are whole. At the orientation phi the legs' circles
// have centres q_i(phi), whose squared distances d_ij times 1 + t^2, t = tan(phi / 2), are polynomials in t with whole
// coefficients. The three circles meet in one point only where the Cayley-Menger determinant of the point and the three
// centres vanishes, a polynomial of degree 6 in t. Its square-free parts give the multiplicities, Sturm's sequences the
// real roots. Where the centres are in line as well, the sign of 4 L_1 d_1i - (L_1 + d_1i - L_i)^2 tells whether the
// circles meet in two points, touch, or miss each other: exactly, since a sequence of that polynomial says when an
// interval about the root is narrow enough.

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace reprise::test {

using Whole = boost::multiprecision::cpp_int;

/// Coefficients of 1, t, t^2, ..., the last one not zero; none for the polynomial 0.
class WholePolynomial {
 public:
  WholePolynomial() = default;
  explicit WholePolynomial(std::vector<Whole> coefficients) : coefficients_(std::move(coefficients)) { trim(); }

  bool is_zero() const { return coefficients_.empty(); }
  std::size_t degree() const { return coefficients_.size() - 1; }
  const Whole& leading() const { return coefficients_.back(); }

  friend WholePolynomial operator*(const WholePolynomial& a, const WholePolynomial& b) {
    if (a.is_zero() || b.is_zero()) return {};
    std::vector<Whole> result(a.degree() + b.degree() + 1);
    for (std::size_t i = 0; i <= a.degree(); ++i) {
      for (std::size_t j = 0; j <= b.degree(); ++j) result[i + j] += a.coefficients_[i] * b.coefficients_[j];
    }
    return WholePolynomial(std::move(result));
  }
  friend WholePolynomial operator+(const WholePolynomial& a, const WholePolynomial& b) {
    std::vector<Whole> result(std::max(a.coefficients_.size(), b.coefficients_.size()));
    for (std::size_t i = 0; i < a.coefficients_.size(); ++i) result[i] += a.coefficients_[i];
    for (std::size_t i = 0; i < b.coefficients_.size(); ++i) result[i] += b.coefficients_[i];
    return WholePolynomial(std::move(result));
  }
  friend WholePolynomial operator*(const Whole& factor, const WholePolynomial& a) {
    return WholePolynomial({factor}) * a;
  }
  friend WholePolynomial operator-(const WholePolynomial& a, const WholePolynomial& b) { return a + Whole(-1) * b; }

  WholePolynomial derivative() const {
    std::vector<Whole> result;
    for (std::size_t k = 1; k < coefficients_.size(); ++k) result.push_back(coefficients_[k] * k);
    return WholePolynomial(std::move(result));
  }

  /// Divided by the greatest common divisor of its coefficients.
  WholePolynomial primitive() const {
    Whole divisor = 0;
    for (const Whole& coefficient : coefficients_) divisor = gcd(divisor, coefficient);
    std::vector<Whole> result = coefficients_;
    for (Whole& coefficient : result) coefficient /= divisor;
    return WholePolynomial(std::move(result));
  }

  /// Quotient and remainder of this polynomial times a positive number.
  std::pair<WholePolynomial, WholePolynomial> divided_by(const WholePolynomial& divisor) const {
    WholePolynomial quotient;
    WholePolynomial rest = *this;
    const Whole factor = divisor.leading() * divisor.leading();
    while (!rest.is_zero() && rest.degree() >= divisor.degree()) {
      std::vector<Whole> term(rest.degree() - divisor.degree() + 1);
      term.back() = rest.leading() * divisor.leading();
      const WholePolynomial step(std::move(term));
      quotient = factor * quotient + step;
      rest = factor * rest - step * divisor;
    }
    return {quotient, rest};
  }

  /// The sign at numerator / 2^power.
  int sign_at(const Whole& numerator, unsigned power) const {
    Whole value = 0;
    for (std::size_t k = coefficients_.size(); k-- > 0;) {
      value = value * numerator + (coefficients_[k] << (power * static_cast<unsigned>(coefficients_.size() - 1 - k)));
    }
    return value.sign();
  }

 private:
  void trim() {
    while (!coefficients_.empty() && coefficients_.back() == 0) coefficients_.pop_back();
  }
  std::vector<Whole> coefficients_;
};

/// Up to a factor.
inline WholePolynomial common_divisor(WholePolynomial a, WholePolynomial b) {
  while (!b.is_zero()) {
    WholePolynomial rest = a.divided_by(b).second;
    a = std::move(b);
    b = rest.is_zero() ? rest : rest.primitive();
  }
  return a.is_zero() ? a : a.primitive();
}

/// With every root once.
inline WholePolynomial square_free(const WholePolynomial& polynomial) {
  return polynomial.divided_by(common_divisor(polynomial, polynomial.derivative())).first.primitive();
}

/// The factors with the simple roots, the double ones, and so on.
inline std::vector<WholePolynomial> square_free_parts(const WholePolynomial& polynomial) {
  std::vector<WholePolynomial> parts;
  WholePolynomial rest = polynomial.primitive();
  WholePolynomial at_least;  // the roots of the last multiplicity and of all greater ones
  while (rest.degree() > 0) {
    const WholePolynomial distinct = square_free(rest);
    if (!at_least.is_zero()) parts.push_back(at_least.divided_by(distinct).first.primitive());
    rest = rest.divided_by(distinct).first.primitive();
    at_least = distinct;
  }
  if (!at_least.is_zero()) parts.push_back(at_least);
  return parts;
}

/// Sturm's sequence of a polynomial, which counts its real roots, each once.
class SturmSequence {
 public:
  explicit SturmSequence(const WholePolynomial& polynomial) : sequence_{polynomial, polynomial.derivative()} {
    while (!sequence_.back().is_zero()) {
      const WholePolynomial rest = sequence_[sequence_.size() - 2].divided_by(sequence_.back()).second;
      sequence_.push_back(rest.is_zero() ? rest : (Whole(-1) * rest).primitive());
    }
    sequence_.pop_back();
  }

  /// In the interval from one numerator over 2^power, which is left out, to the other, neither being a multiple root.
  int roots_between(const Whole& from, const Whole& to, unsigned power) const {
    return changes(from, power) - changes(to, power);
  }

 private:
  int changes(const Whole& numerator, unsigned power) const {
    int count = 0;
    int last = 0;
    for (const WholePolynomial& polynomial : sequence_) {
      const int sign = polynomial.sign_at(numerator, power);
      if (sign == 0) continue;
      if (last != 0 && sign != last) ++count;
      last = sign;
    }
    return count;
  }
  std::vector<WholePolynomial> sequence_;
};

/// A root of a polynomial, by an interval that holds no other: (numerator, numerator + 1] / 2^power.
struct IsolatedRoot {
  Whole numerator;
  unsigned power;

  double value() const {
    return static_cast<double>(boost::multiprecision::cpp_rational(2 * numerator + 1, Whole(1) << (power + 1)));
  }
};

/// All real roots of a square-free polynomial, in intervals narrower than 2^-64.
inline std::vector<IsolatedRoot> real_roots(const WholePolynomial& polynomial) {
  const SturmSequence sturm(polynomial);
  constexpr unsigned narrow = 64;
  std::vector<IsolatedRoot> roots;
  const auto search = [&](const auto& self, const Whole& from, const Whole& to, unsigned power, int count) -> void {
    if (count == 0) return;
    if (count == 1 && power >= narrow && to - from == 1) {
      roots.push_back({from, power});
      return;
    }
    if (to - from > 1) {
      const Whole middle = (from + to) / 2;
      const int below = sturm.roots_between(from, middle, power);
      self(self, from, middle, power, below);
      self(self, middle, to, power, count - below);
    } else {
      self(self, 2 * from, 2 * to, power + 1, count);
    }
  };
  Whole bound = 1;
  while (sturm.roots_between(-bound, bound, 0) < sturm.roots_between(-(bound << 64), bound << 64, 0)) bound <<= 1;
  search(search, -bound, bound, 0, sturm.roots_between(-bound, bound, 0));
  return roots;
}

/// The sign of a polynomial at a root of another, which is square-free.
inline int sign_at_root(const WholePolynomial& polynomial, const WholePolynomial& of, IsolatedRoot root) {
  if (polynomial.is_zero()) return 0;
  const WholePolynomial common = common_divisor(polynomial, of);
  if (common.degree() > 0 && SturmSequence(common).roots_between(root.numerator, root.numerator + 1, root.power) > 0) {
    return 0;
  }
  const SturmSequence of_root(of);
  const SturmSequence sturm(square_free(polynomial));
  // Beyond the ends as well, so that none of them is a root.
  while (polynomial.sign_at(root.numerator, root.power) == 0 ||
         sturm.roots_between(root.numerator, root.numerator + 1, root.power) > 0) {
    root.numerator *= 2;
    ++root.power;
    if (of_root.roots_between(root.numerator, root.numerator + 1, root.power) == 0) ++root.numerator;
  }
  return polynomial.sign_at(root.numerator + 1, root.power);
}

/// A manipulator with three legs, joints on a lattice.
struct LatticeAssembly {
  std::array<std::array<int, 2>, 3> base;
  std::array<std::array<int, 2>, 3> platform;
  std::array<int, 3> squares;  ///< of the lengths
};

/// The modes that share one orientation.
struct ModesAtOrientation {
  double orientation;
  std::size_t count;
  int multiplicity;  ///< of all together; 0 for a pose that is isolated among the real ones only
};

/// All of them; nothing where there are infinitely many.
class ExactModes {
 public:
  static std::optional<std::vector<ModesAtOrientation>> of(const LatticeAssembly& assembly) {
    // Seen from another orientation no root is at t = infinity.
    constexpr std::array<std::array<int, 3>, 5> rotations{{{1, 0, 1}, {3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {-3, 4, 5}}};
    for (const auto& [cosine, sine, size] : rotations) {
      ExactModes modes(assembly, cosine, sine, size);
      if (modes.find()) return modes.infinitely_many_ ? std::nullopt : std::optional(std::move(modes.modes_));
    }
    throw std::logic_error("a root at infinity in every frame");
  }

 private:
  ExactModes(const LatticeAssembly& assembly, int cosine, int sine, int size) : turned_(std::atan2(sine, cosine)) {
    const auto& base = assembly.base;
    const auto& platform = assembly.platform;
    for (std::size_t i = 0; i < 3; ++i) squares_[i] = Whole(assembly.squares[i]) * size * size;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        // d = |c|^2 + |p|^2 - 2 cos(phi) p . c - 2 sin(phi) p x c, of differences of joints.
        const Whole cx = size * (base[j][0] - base[i][0]);
        const Whole cy = size * (base[j][1] - base[i][1]);
        const int x = platform[j][0] - platform[i][0];
        const int y = platform[j][1] - platform[i][1];
        const Whole px = cosine * x - sine * y;
        const Whole py = sine * x + cosine * y;
        const Whole sum = cx * cx + cy * cy + px * px + py * py;
        const Whole inner = 2 * (px * cx + py * cy);
        distances_[i][j] = WholePolynomial({sum - inner, -4 * (px * cy - py * cx), sum + inner});
      }
    }
  }

  /// L times 1 + t^2
  static WholePolynomial constant(const Whole& value) { return WholePolynomial({value, 0, value}); }

  static WholePolynomial determinant(const std::vector<std::vector<WholePolynomial>>& matrix) {
    std::vector<std::size_t> order(matrix.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    WholePolynomial sum;
    do {
      int inversions = 0;
      WholePolynomial product({1});
      for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) inversions += order[j] > order[i] ? 1 : 0;
        product = product * matrix[i][order[i]];
        if (product.is_zero()) break;
      }
      if (product.is_zero()) continue;
      sum = sum + Whole(inversions % 2 == 0 ? 1 : -1) * product;
    } while (std::next_permutation(order.begin(), order.end()));
    return sum;
  }

  WholePolynomial cayley_menger() const {
    const WholePolynomial zero;
    const WholePolynomial one({1});
    std::vector<std::vector<WholePolynomial>> matrix(5, std::vector<WholePolynomial>(5));
    for (std::size_t i = 1; i < 5; ++i) matrix[0][i] = matrix[i][0] = one;
    for (std::size_t i = 0; i < 3; ++i) {
      matrix[1][i + 2] = matrix[i + 2][1] = constant(squares_[i]);
      for (std::size_t j = 0; j < 3; ++j) matrix[i + 2][j + 2] = distances_[i][j];
    }
    return determinant(matrix);
  }

  /// 16 times the square of the area of the triangle of the centres.
  WholePolynomial triangle() const {
    const WholePolynomial& a = distances_[0][1];
    const WholePolynomial& b = distances_[0][2];
    const WholePolynomial rest = a + b - distances_[1][2];
    return Whole(4) * (a * b) - rest * rest;
  }

  /// Positive where circles 1 and i meet in two points, zero where they touch.
  WholePolynomial meeting(std::size_t i) const {
    const WholePolynomial& d = distances_[0][i];
    const WholePolynomial rest = constant(squares_[0]) + d - constant(squares_[i]);
    return Whole(4) * (constant(squares_[0]) * d) - rest * rest;
  }

  double orientation(const IsolatedRoot& root) const {
    return std::remainder(2.0 * std::atan(root.value()) + turned_, 2.0 * std::acos(-1.0));
  }

  /// False where a root may be at infinity.
  bool find() {
    const WholePolynomial centres_meet = common_divisor(distances_[0][1], distances_[0][2]);
    const bool equal = squares_[0] == squares_[1] && squares_[0] == squares_[2];
    const bool all_meet = centres_meet.is_zero();
    if (all_meet) {
      infinitely_many_ = equal;
      return true;
    }
    for (const std::size_t i : {1UL, 2UL}) {
      if (!distances_[0][i].is_zero() && distances_[0][i].degree() < 2) return false;
    }
    const bool meet_somewhere = centres_meet.degree() > 0 && !real_roots(square_free(centres_meet)).empty();
    if (meet_somewhere && equal && squares_[0] > 0) {
      infinitely_many_ = true;
      return true;
    }
    const WholePolynomial eliminant = cayley_menger();
    if (eliminant.is_zero()) return find_in_family();
    if (eliminant.degree() < 6) return false;
    const WholePolynomial in_line = triangle();
    int multiplicity = 0;
    for (const WholePolynomial& part : square_free_parts(eliminant)) {
      ++multiplicity;
      if (part.degree() == 0) continue;
      for (const IsolatedRoot& root : real_roots(part)) {
        if (sign_at_root(in_line, part, root) != 0) {
          modes_.push_back({orientation(root), 1, multiplicity});
          continue;
        }
        if (sign_at_root(distances_[0][1], part, root) == 0 && sign_at_root(distances_[0][2], part, root) == 0) {
          if (equal) modes_.push_back({orientation(root), 1, 0});
          continue;
        }
        const std::size_t i = sign_at_root(distances_[0][1], part, root) != 0 ? 1 : 2;
        const int sign = sign_at_root(meeting(i), part, root);
        if (sign >= 0) modes_.push_back({orientation(root), sign > 0 ? std::size_t{2} : 1, multiplicity});
      }
    }
    return true;
  }

  /// Where the determinant is zero at every orientation.
  bool find_in_family() {
    if (!triangle().is_zero()) {
      infinitely_many_ = true;
      return true;
    }
    const std::size_t i = distances_[0][1].is_zero() ? 2 : 1;
    const WholePolynomial both = meeting(i);
    infinitely_many_ = both.is_zero();
    if (infinitely_many_) return true;
    if (both.degree() < 4) return false;
    const std::vector<WholePolynomial> parts = square_free_parts(both);
    infinitely_many_ = both.leading() > 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (parts[k].degree() == 0) continue;
      for (const IsolatedRoot& root : real_roots(parts[k])) {
        if (k % 2 == 0) infinitely_many_ = true;
        modes_.push_back({orientation(root), 1, 0});
      }
    }
    return true;
  }

  double turned_;  ///< the orientation at t = 0
  std::array<Whole, 3> squares_;
  std::array<std::array<WholePolynomial, 3>, 3> distances_;
  bool infinitely_many_ = false;
  std::vector<ModesAtOrientation> modes_;
};

}  // namespace reprise::test
