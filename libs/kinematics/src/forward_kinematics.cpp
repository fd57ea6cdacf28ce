#include "reprise/kinematics/forward_kinematics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/Polynomials>

#include "checks.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/joint_angles.hpp"

namespace reprise {
namespace {

// Assembly modes are computed with more digits than lengths are given with, so that what their rounding makes of a
// multiple root can be told from what the computation makes of it.
using Real = long double;
using Complex = std::complex<Real>;
using Vector2 = Eigen::Matrix<Real, 2, 1>;
using Vector3 = Eigen::Matrix<Real, 3, 1>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
using Rotation = Eigen::Rotation2D<Real>;

// Everything about assembly modes is computed in units of the manipulator's size, so tolerances are plain numbers.
constexpr Real length_tolerance = 1e-12L;    // lengths closer than this are equal
constexpr Real mode_tolerance = 1e-13L;      // a pose that meets the lengths this well is a mode
constexpr Real input_noise = 1e-14L;         // what rounding of the input makes of a number, beside its terms
constexpr Real far_from_real = 1.0L;         // angles with a larger imaginary part never stem from real ones
constexpr double sorting_resolution = 1e-9;  // coordinates closer than this are equal when modes are sorted
constexpr Eigen::Index greatest_degree = 3;  // of the eliminant
constexpr int most_modes = 2 * greatest_degree;

Real cross_product(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2 quarter_turn(const Vector2& a) { return {-a.y(), a.x()}; }

/// The beginning of a power series: coefficients of 1, t, t^2, ...
using Series = Eigen::Matrix<Real, most_modes, 1>;

Series product(const Series& a, const Series& b) {
  Series result = Series::Zero();
  for (Eigen::Index i = 0; i < result.size(); ++i) result.tail(result.size() - i) += a[i] * b.head(result.size() - i);
  return result;
}

/// Of a series that begins with a positive number.
Series square_root(const Series& a) {
  Series root = Series::Zero();
  root[0] = std::sqrt(a[0]);
  for (Eigen::Index k = 1; k < root.size(); ++k) {
    Real rest = a[k];
    for (Eigen::Index i = 1; i < k; ++i) rest -= root[i] * root[k - i];
    root[k] = rest / (2 * root[0]);
  }
  return root;
}

/// sum over k = -m..m of c_k exp(i k phi), a real function of phi; coefficient c_k is at index k + m.
class TrigonometricPolynomial {
 public:
  using Coefficients = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;

  explicit TrigonometricPolynomial(Coefficients coefficients) : coefficients_(std::move(coefficients)) {}
  /// constant + cosine cos(phi) + sine sin(phi)
  TrigonometricPolynomial(Real constant, Real cosine, Real sine) : coefficients_(3) {
    coefficients_ << Complex(cosine, sine) / Real(2), constant, Complex(cosine, -sine) / Real(2);
  }

  Eigen::Index degree() const { return (coefficients_.size() - 1) / 2; }
  Real norm() const { return coefficients_.cwiseAbs().sum(); }

  Real operator()(Real phi) const {
    Real sum = 0;
    for (Eigen::Index k = -degree(); k <= degree(); ++k) {
      sum += (coefficient(k) * std::polar(Real(1), static_cast<Real>(k) * phi)).real();
    }
    return sum;
  }

  TrigonometricPolynomial derivative() const {
    Coefficients result = coefficients_;
    for (Eigen::Index k = -degree(); k <= degree(); ++k) result[k + degree()] *= Complex(0, static_cast<Real>(k));
    return TrigonometricPolynomial(result);
  }

  /// The beginning of its Taylor series at phi.
  Series taylor(Real phi) const {
    Series result;
    TrigonometricPolynomial derivative = *this;
    Real factorial = 1;
    for (Eigen::Index k = 0; k < result.size(); ++k) {
      if (k > 0) {
        derivative = derivative.derivative();
        factorial *= static_cast<Real>(k);
      }
      result[k] = derivative(phi) / factorial;
    }
    return result;
  }

  /// All complex angles at which it is zero, except those far from the real axis.
  std::vector<Complex> roots() const;

  friend TrigonometricPolynomial operator*(const TrigonometricPolynomial& a, const TrigonometricPolynomial& b) {
    Coefficients result = Coefficients::Zero(a.coefficients_.size() + b.coefficients_.size() - 1);
    for (Eigen::Index j = 0; j < b.coefficients_.size(); ++j) {
      result.segment(j, a.coefficients_.size()) += b.coefficients_[j] * a.coefficients_;
    }
    return TrigonometricPolynomial(result);
  }

  /// a + factor b
  static TrigonometricPolynomial sum(const TrigonometricPolynomial& a, Real factor, const TrigonometricPolynomial& b) {
    const Eigen::Index degree = std::max(a.degree(), b.degree());
    Coefficients result = Coefficients::Zero(2 * degree + 1);
    result.segment(degree - a.degree(), a.coefficients_.size()) += a.coefficients_;
    result.segment(degree - b.degree(), b.coefficients_.size()) += factor * b.coefficients_;
    return TrigonometricPolynomial(result);
  }

 private:
  Complex coefficient(Eigen::Index k) const { return coefficients_[k + degree()]; }

  /// Nothing where the iteration does not end. The origin is one of a circle of samples, of which this is the first.
  std::optional<std::vector<Complex>> roots_from(Real first_sample) const;

  Coefficients coefficients_;
};

std::vector<Complex> TrigonometricPolynomial::roots() const {
  // Where the roots lie symmetrically about the origin the iteration for the companion matrix's eigenvalues may not
  // end, and there are no roots. From another origin they are not symmetric.
  constexpr int most_attempts = 16;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const std::optional<std::vector<Complex>> found = roots_from(static_cast<Real>(attempt) * Real(0.37L));
    if (found) return *found;
  }
  throw std::logic_error("the eigenvalues of a companion matrix cannot be found");
}

std::optional<std::vector<Complex>> TrigonometricPolynomial::roots_from(Real first_sample) const {
  // With t = tan((phi - origin) / 2), exp(i (phi - origin)) = (1 + i t) / (1 - i t). The leading coefficient in t is
  // the value opposite to the origin; choosing that value large keeps all roots away from infinity.
  const Eigen::Index m = degree();
  Real origin = 0;
  Real largest = 0;
  const Eigen::Index samples = 8 * m;
  for (Eigen::Index i = 0; i < samples; ++i) {
    const Real phi = 2 * std::numbers::pi_v<Real> * (static_cast<Real>(i) + first_sample) / static_cast<Real>(samples);
    const Real magnitude = std::abs((*this)(phi + std::numbers::pi_v<Real>));
    if (magnitude > largest) {
      largest = magnitude;
      origin = phi;
    }
  }
  if (largest == 0) return std::vector<Complex>{};
  Coefficients polynomial = Coefficients::Zero(2 * m + 1);
  for (Eigen::Index k = -m; k <= m; ++k) {
    Coefficients term = Coefficients::Zero(2 * m + 1);  // (1 + i t)^(m + k) (1 - i t)^(m - k)
    term[0] = coefficient(k) * std::polar(Real(1), static_cast<Real>(k) * origin);
    for (Eigen::Index factor = 0; factor < 2 * m; ++factor) {
      const Complex slope(0, factor < m + k ? 1 : -1);
      for (Eigen::Index power = factor + 1; power > 0; --power) term[power] += slope * term[power - 1];
    }
    polynomial += term;
  }
  const Eigen::PolynomialSolver<Real, Eigen::Dynamic> solver(polynomial.real().eval());
  if (solver.roots().size() != 2 * m) return std::nullopt;
  std::vector<Complex> angles;
  for (const Complex& root : solver.roots()) {
    const Complex angle = Real(2) * std::atan(root);
    if (std::abs(angle.imag()) <= far_from_real) angles.push_back(origin + angle);
  }
  return angles;
}

/// The real roots of a trigonometric polynomial, each with its multiplicity. Rounding of the input turns a multiple
/// root into several close ones, some of them complex. So roots are taken as one when a polynomial that has just that
/// multiple root differs from the given one by no more than rounding of its coefficients, a noise, makes up: when the
/// Taylor series at the middle begins with as many numbers that are as small. Groups are tried from the largest, split
/// where their gap is widest.
class RealRoots {
 public:
  RealRoots(const TrigonometricPolynomial& polynomial, Real noise) : noise_(noise), roots_(polynomial.roots()) {
    derivatives_.push_back(polynomial);
    while (derivatives_.size() <= roots_.size()) derivatives_.push_back(derivatives_.back().derivative());
  }

  /// Calls accept(phi, multiplicity) for every group, which tells whether it takes the group for one root. Groups that
  /// it does not take are split.
  template <class Accept>
  void visit(const Accept& accept) const {
    if (!roots_.empty()) visit(roots_, accept);
  }

 private:
  static Real distance(const Complex& a, const Complex& b) {
    return std::hypot(std::remainder(a.real() - b.real(), 2 * std::numbers::pi_v<Real>), a.imag() - b.imag());
  }

  template <class Accept>
  void visit(const std::vector<Complex>& group, const Accept& accept) const {
    const std::optional<Real> middle = middle_of(group);
    if (middle && accept(*middle, static_cast<int>(group.size()))) return;
    if (group.size() == 1) return;
    const auto [one, other] = split(group);
    visit(one, accept);
    visit(other, accept);
  }

  /// Where the polynomial nearly has a root as often as there are members in the group, if anywhere.
  std::optional<Real> middle_of(const std::vector<Complex>& group) const {
    const auto above = std::count_if(group.begin(), group.end(), [](const Complex& root) { return root.imag() > 0; });
    const auto below = std::count_if(group.begin(), group.end(), [](const Complex& root) { return root.imag() < 0; });
    if (above != below) return std::nullopt;
    Real offset = 0;
    for (const Complex& root : group) {
      offset += std::remainder(root.real() - group.front().real(), 2 * std::numbers::pi_v<Real>);
    }
    // A root of the derivative of one order less is simple there.
    Real middle = group.front().real() + offset / static_cast<Real>(group.size());
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Real step = derivatives_[group.size() - 1](middle) / derivatives_[group.size()](middle);
      if (!std::isfinite(step)) break;
      middle -= step;
    }
    // Of noise in the coefficients the derivative of order k makes at most degree^k times as much.
    Real bound = noise_;
    for (std::size_t order = 0; order + 1 < group.size(); ++order) {
      if (!(std::abs(derivatives_[order](middle)) <= bound)) return std::nullopt;
      bound *= static_cast<Real>(derivatives_[order].degree());
    }
    // Noise of that size moves none of the roots further than this: otherwise the middle is that of other roots.
    const Real leading =
        std::abs(derivatives_[group.size()](middle)) / std::tgamma(static_cast<Real>(group.size() + 1));
    const bool all_close = std::all_of(group.begin(), group.end(), [&](const Complex& root) {
      return leading * std::pow(distance(root, middle) / 2, static_cast<Real>(group.size())) <= 2 * noise_;
    });
    return all_close ? std::optional(middle) : std::nullopt;
  }

  /// The two groups that are left when the nearest members are put together, one pair after the other.
  static std::pair<std::vector<Complex>, std::vector<Complex>> split(const std::vector<Complex>& group) {
    std::vector<std::vector<Complex>> parts;
    for (const Complex& root : group) parts.push_back({root});
    while (parts.size() > 2) {
      std::size_t first = 0;
      std::size_t second = 1;
      Real nearest = std::numeric_limits<Real>::infinity();
      for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = i + 1; j < parts.size(); ++j) {
          for (const Complex& a : parts[i]) {
            for (const Complex& b : parts[j]) {
              if (distance(a, b) >= nearest) continue;
              nearest = distance(a, b);
              first = i;
              second = j;
            }
          }
        }
      }
      parts[first].insert(parts[first].end(), parts[second].begin(), parts[second].end());
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(second));
    }
    return {parts[0], parts[1]};
  }

  Real noise_;
  std::vector<Complex> roots_;
  std::vector<TrigonometricPolynomial> derivatives_;
};

/// A pose relative to the first leg: its vector A and the orientation phi.
struct LocalPose {
  Vector2 leg;
  Real orientation;
};

struct LocalMode {
  LocalPose pose;
  int multiplicity;
};

/// The three circle equations, in units of the manipulator's size.
class Assembly {
 public:
  Assembly(const Manipulator& manipulator, const std::array<double, 3>& lengths) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto relative = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return Vector2(a.cast<Real>() - b.cast<Real>());
      };
      base_[i] = relative(manipulator.leg(i).base_joint, manipulator.leg(0).base_joint);
      platform_[i] = relative(manipulator.leg(i).platform_joint, manipulator.leg(0).platform_joint);
      lengths_[i] = lengths[i];
      size_ = std::max({size_, base_[i].norm(), platform_[i].norm(), lengths_[i]});
    }
    if (size_ == 0) return;
    for (std::size_t i = 0; i < 3; ++i) {
      base_[i] /= size_;
      platform_[i] /= size_;
      lengths_[i] /= size_;
    }
  }

  double size() const { return static_cast<double>(size_); }

  /// Whether the platform can be put so that all legs are parallel and equally long: it then moves freely in a circle.
  bool has_parallel_motion() const {
    const std::size_t longer = platform_[1].norm() > platform_[2].norm() ? 1 : 2;
    const Real phi = std::atan2(cross_product(platform_[longer], base_[longer]), platform_[longer].dot(base_[longer]));
    for (std::size_t i = 1; i < 3; ++i) {
      if (offset(i, phi).norm() > length_tolerance) return false;
      if (std::abs(lengths_[i] - lengths_[0]) > length_tolerance) return false;
    }
    return lengths_[0] > length_tolerance;
  }

  /// All modes, or nothing when a whole range of orientations has modes.
  std::optional<std::vector<LocalMode>> modes() const {
    using T = TrigonometricPolynomial;
    const std::array<T, 2> squares = {square(1), square(2)};
    const std::array<T, 2> rho = {half_difference(1), half_difference(2)};
    const T delta = determinant();
    const T first = rho[0] * rho[0] * squares[1];
    const T second = rho[0] * rho[1] * inner();
    const T third = rho[1] * rho[1] * squares[0];
    const Real length_square = lengths_[0] * lengths_[0];
    const T numerator = T::sum(T::sum(first, -2, second), 1, third);
    const T eliminant = T::sum(numerator, -length_square, delta * delta);
    // What rounding of the input makes up in the sizes of rho and Delta, which may have cancelled.
    std::array<Real, 2> terms;
    std::array<Real, 2> sizes;
    for (std::size_t k = 0; k < 2; ++k) {
      terms[k] = (lengths_[k + 1] * lengths_[k + 1] + length_square + squares[k].norm()) / 2;
      sizes[k] = rho[k].norm() + input_noise * terms[k];
    }
    const Real delta_terms = std::sqrt(squares[0].norm() * squares[1].norm());
    const Real noise =
        input_noise * (sizes[0] * terms[0] * squares[1].norm() + sizes[1] * terms[1] * squares[0].norm() +
                       (sizes[0] * terms[1] + sizes[1] * terms[0]) * inner().norm() +
                       length_square * (delta.norm() + input_noise * delta_terms) * delta_terms);
    std::vector<LocalMode> modes;
    if (eliminant.norm() > noise) {
      RealRoots(eliminant, noise).visit([&](Real phi, int multiplicity) {
        const std::optional<std::vector<LocalMode>> found = modes_at(phi, multiplicity);
        if (found) modes.insert(modes.end(), found->begin(), found->end());
        return found.has_value();
      });
      return modes;
    }

    // The eliminant vanishes identically. With Delta not zero, A = N / Delta is a solution at every orientation.
    if (delta.norm() > input_noise * delta_terms) return std::nullopt;
    // Otherwise w_2 and w_3 are parallel at every orientation, and the equation of one of them is implied by that of
    // the other. Circles 1 and i meet where l_1^2 |w_i|^2 - rho_i^2 >= 0.
    const std::size_t i = squares[0].norm() > squares[1].norm() ? 0 : 1;
    const T discriminant = T::sum(T(length_square, 0, 0) * squares[i], -1, rho[i] * rho[i]);
    const Real discriminant_noise = input_noise * (length_square * squares[i].norm() + sizes[i] * terms[i]);
    const T slope = discriminant.derivative();
    if (slope.norm() <= discriminant_noise) {
      if (discriminant(0) >= -discriminant_noise) return std::nullopt;
      return modes;
    }
    bool is_positive = false;
    RealRoots(slope, discriminant_noise).visit([&](Real phi, int) {
      is_positive = is_positive || discriminant(phi) > discriminant_noise;
      if (discriminant(phi) < -discriminant_noise) return true;
      const LocalPose pose{foot(i + 1, phi), phi};
      if (residual(pose) <= mode_tolerance) modes.push_back({pose, 0});
      return true;
    });
    if (is_positive) return std::nullopt;
    return modes;
  }

 private:
  /// w_i(phi)
  Vector2 offset(std::size_t i, Real phi) const { return Rotation(phi) * platform_[i] - base_[i]; }

  /// |w_i|^2
  TrigonometricPolynomial square(std::size_t i) const {
    return {platform_[i].squaredNorm() + base_[i].squaredNorm(), -2 * platform_[i].dot(base_[i]),
            -2 * cross_product(platform_[i], base_[i])};
  }

  /// rho_i
  TrigonometricPolynomial half_difference(std::size_t i) const {
    const Real constant = (lengths_[i] - lengths_[0]) * (lengths_[i] + lengths_[0]);
    return TrigonometricPolynomial::sum({constant / 2, 0, 0}, Real(-0.5L), square(i));
  }

  /// w_2 . w_3
  TrigonometricPolynomial inner() const {
    return {platform_[1].dot(platform_[2]) + base_[1].dot(base_[2]),
            -platform_[1].dot(base_[2]) - base_[1].dot(platform_[2]),
            -cross_product(platform_[1], base_[2]) + cross_product(base_[1], platform_[2])};
  }

  /// Delta = w_2 x w_3
  TrigonometricPolynomial determinant() const {
    return {cross_product(platform_[1], platform_[2]) + cross_product(base_[1], base_[2]),
            -cross_product(platform_[1], base_[2]) - cross_product(base_[1], platform_[2]),
            platform_[1].dot(base_[2]) - base_[1].dot(platform_[2])};
  }

  /// The largest error of a leg length; infinity where the pose is not finite.
  Real residual(const LocalPose& pose) const {
    if (!pose.leg.allFinite() || !std::isfinite(pose.orientation)) return std::numeric_limits<Real>::infinity();
    Real largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      largest = std::max(largest, std::abs((pose.leg + offset(i, pose.orientation)).norm() - lengths_[i]));
    }
    return largest;
  }

  /// rho_i at an orientation, from w_i.
  Real half_difference(std::size_t i, const Vector2& w) const {
    return ((lengths_[i] - lengths_[0]) * (lengths_[i] + lengths_[0]) - w.squaredNorm()) / 2;
  }

  /// Of the points at which circles 1 and i meet, the middle.
  Vector2 foot(std::size_t i, Real phi) const {
    const Vector2 w = offset(i, phi);
    return w * (half_difference(i, w) / w.squaredNorm());
  }

  /// The modes at a root of the eliminant. Nothing where the pose there is none, although a simple root with complex
  /// positions is an empty list: then the root is not one but several.
  std::optional<std::vector<LocalMode>> modes_at(Real phi, int multiplicity) const {
    const std::array<Vector2, 2> w = {offset(1, phi), offset(2, phi)};
    const std::array<Real, 2> rho = {half_difference(1, w[0]), half_difference(2, w[1])};
    const std::size_t i = w[0].norm() > w[1].norm() ? 0 : 1;
    const Real apart = w[i].norm();
    if (apart <= length_tolerance) {
      // Three circles about one point: legs of no length, since has_parallel_motion() has told the other case.
      const LocalPose pose{Vector2::Zero(), phi};
      if (residual(pose) > mode_tolerance) return std::vector<LocalMode>{};
      return std::vector<LocalMode>{{pose, 0}};
    }
    const Real delta = cross_product(w[0], w[1]);
    const LocalPose by_determinant{quarter_turn(rho[1] * w[0] - rho[0] * w[1]) / delta, phi};
    if (multiplicity == 1) {
      if (delta == 0) return std::nullopt;
      const LocalPose pose = polished(by_determinant);
      if (!(residual(pose) <= mode_tolerance)) return std::nullopt;
      return std::vector<LocalMode>{{pose, 1}};
    }
    const Vector2 middle = w[i] * (rho[i] / (apart * apart));
    const Real height_square = (lengths_[0] - middle.norm()) * (lengths_[0] + middle.norm());
    const Real noise = input_noise * (1 + 1 / apart);
    std::vector<LocalMode> modes;
    if (std::abs(height_square) <= noise) {
      modes.push_back({{middle, phi}, multiplicity});
    } else if (height_square > 0) {
      const Vector2 side = quarter_turn(w[i]) * (std::sqrt(height_square) / apart);
      const int on_left = multiplicity_on_left(i, phi, multiplicity);
      if (on_left > 0) modes.push_back({{middle + side, phi}, on_left});
      if (on_left < multiplicity) modes.push_back({{middle - side, phi}, multiplicity - on_left});
    }
    // Of a single position Delta, unless it is small, keeps more digits.
    if (modes.size() == 1 && residual(by_determinant) < residual(modes[0].pose)) modes[0].pose = by_determinant;
    for (LocalMode& mode : modes) {
      if (mode.multiplicity == 1) mode.pose = polished(mode.pose);
      if (!(residual(mode.pose) <= mode_tolerance)) return std::nullopt;
    }
    return modes;
  }

  /// How much of a root's multiplicity belongs to the point on the left of w_i at which circles 1 and i meet, the rest
  /// to the one on the right. The eliminant times |w_i|^2 is the product of
  ///     G = rho_i w_i.w_j - rho_j |w_i|^2 +- sqrt(l_1^2 |w_i|^2 - rho_i^2) w_i x w_j,
  /// which vanish where the third leg meets the points: the split under which both series begin with the least numbers.
  int multiplicity_on_left(std::size_t i, Real phi, int multiplicity) const {
    const std::array<Series, 2> squares = {square(1).taylor(phi), square(2).taylor(phi)};
    const std::array<Series, 2> rho = {half_difference(1).taylor(phi), half_difference(2).taylor(phi)};
    const Series height = square_root(lengths_[0] * lengths_[0] * squares[i] - product(rho[i], rho[i]));
    const Series even = product(rho[i], inner().taylor(phi)) - product(rho[1 - i], squares[i]);
    const Series odd = (i == 0 ? 1 : -1) * product(height, determinant().taylor(phi));
    const Series left = even + odd;
    const Series right = even - odd;
    int best = 0;
    Real least = std::numeric_limits<Real>::infinity();
    for (int k = 0; k <= multiplicity; ++k) {
      const Real largest = std::max(k > 0 ? left.head(k).cwiseAbs().maxCoeff() : 0,
                                    k < multiplicity ? right.head(multiplicity - k).cwiseAbs().maxCoeff() : 0);
      if (largest >= least) continue;
      least = largest;
      best = k;
    }
    return best;
  }

  /// Newton's method on |a_i|^2 = l_i^2 down to rounding, at a simple mode. Returns the best iterate.
  LocalPose polished(LocalPose pose) const {
    LocalPose best = pose;
    for (int iteration = 0; iteration < 8; ++iteration) {
      Vector3 values;
      Matrix3 slopes;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const Vector2 arm = Rotation(pose.orientation) * platform_[i];
        const Vector2 a = pose.leg + arm - base_[i];
        const Real length = a.norm();
        values[row] = (length - lengths_[i]) * (length + lengths_[i]);
        slopes.row(row) << 2 * a.x(), 2 * a.y(), 2 * a.dot(quarter_turn(arm));
      }
      const Vector3 step = slopes.fullPivLu().solve(values);
      if (!step.allFinite()) break;
      pose.leg -= step.head<2>();
      pose.orientation -= step[2];
      if (!(residual(pose) < residual(best))) break;
      best = pose;
    }
    return best;
  }

  std::array<Vector2, 3> base_;      // c_i - c_1
  std::array<Vector2, 3> platform_;  // p_i - p_1
  std::array<Real, 3> lengths_;
  Real size_ = 0;
};

void check_length(Eigen::Index leg, double length) {
  if (length >= 0.0 && length <= greatest_length) return;
  reject("length of leg " + std::to_string(leg + 1), shown(length), "between 0 and " + shown(greatest_length));
}

/// The residuals v(u, phi) - lengths of eq. (5.28), filled up with zeros to the three that the solver asks for at
/// least.
struct LengthResiduals {
  const Manipulator& manipulator;
  const Eigen::VectorXd lengths;

  static Pose pose(const Eigen::VectorXd& theta) { return {theta.head<2>(), theta[2]}; }

  Eigen::Index inputs() const { return 3; }
  Eigen::Index values() const { return std::max<Eigen::Index>(lengths.size(), 3); }

  int operator()(const Eigen::VectorXd& theta, Eigen::VectorXd& residuals) const {
    residuals.setZero();
    residuals.head(lengths.size()) = leg_lengths(manipulator, pose(theta)) - lengths;
    return 0;
  }

  int df(const Eigen::VectorXd& theta, Eigen::MatrixXd& slopes) const {
    slopes.setZero();
    slopes.topRows(lengths.size()) = jacobian(manipulator, pose(theta));
    return 0;
  }
};

}  // namespace

AssemblyModes assembly_modes(const Manipulator& manipulator, const std::array<double, 3>& lengths) {
  check_size("number of legs", static_cast<Eigen::Index>(manipulator.size()), 3);
  for (std::size_t i = 0; i < 3; ++i) check_length(static_cast<Eigen::Index>(i), lengths[i]);
  const Assembly assembly(manipulator, lengths);
  AssemblyModes result;
  if (assembly.size() == 0.0 || assembly.has_parallel_motion()) {
    result.infinitely_many = true;
    return result;
  }
  std::optional<std::vector<LocalMode>> modes = assembly.modes();
  if (!modes) {
    result.infinitely_many = true;
    return result;
  }
  for (LocalMode& mode : *modes) {
    mode.pose.orientation = std::remainder(mode.pose.orientation, 2 * std::numbers::pi_v<Real>);
  }
  // Modes that differ in one coordinate by rounding only are ordered by the next, so that the order is reproducible.
  const auto key = [](const LocalMode& mode) {
    const auto rounded = [](Real value) { return std::round(static_cast<double>(value) / sorting_resolution); };
    return std::make_tuple(rounded(mode.pose.orientation), rounded(mode.pose.leg.x()), rounded(mode.pose.leg.y()));
  };
  std::sort(modes->begin(), modes->end(), [&](const LocalMode& a, const LocalMode& b) { return key(a) < key(b); });
  const Leg& leg = manipulator.leg(0);
  for (const LocalMode& mode : *modes) {
    const double orientation = static_cast<double>(mode.pose.orientation);
    result.poses.push_back({leg.base_joint + assembly.size() * mode.pose.leg.cast<double>() -
                                Eigen::Rotation2Dd(orientation) * leg.platform_joint,
                            orientation});
    result.multiplicities.push_back(mode.multiplicity);
  }
  return result;
}

FittedPose fit_pose(const Manipulator& manipulator, const Eigen::Ref<const Eigen::VectorXd>& lengths,
                    const Pose& start) {
  check_size("number of lengths", lengths.size(), static_cast<Eigen::Index>(manipulator.size()));
  for (Eigen::Index i = 0; i < lengths.size(); ++i) check_length(i, lengths[i]);
  check_finite("start", start);
  LengthResiduals residuals{manipulator, lengths};
  Eigen::LevenbergMarquardt<LengthResiduals> solver(residuals);
  solver.parameters.ftol = 1e-15;
  solver.parameters.xtol = 1e-15;
  Eigen::VectorXd theta(3);
  theta << start.position, start.orientation;
  const Eigen::LevenbergMarquardtSpace::Status status = solver.minimize(theta);
  return {LengthResiduals::pose(theta), solver.fvec.norm(),
          status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation};
}

Eigen::VectorXd mean_lengths(const Manipulator& manipulator) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(manipulator.size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    const Interval& length = manipulator.leg(static_cast<std::size_t>(i)).length;
    result[i] = 0.5 * (length.lower + length.upper);
  }
  return result;
}

}  // namespace reprise
