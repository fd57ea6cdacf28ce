#include "reprise/kinematics/forward_kinematics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
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

// Everything about assembly modes is computed in units of the manipulator's size, so tolerances are plain numbers.
constexpr double kLengthTolerance = 1e-12;   // lengths closer than this are equal
constexpr double kModeTolerance = 1e-13;     // a pose that meets the lengths this well is a mode
constexpr double kRoundingNoise = 1e-14;     // coefficients this small beside the terms they come from are zero
constexpr double kCandidateError = 0.1;      // candidates with larger errors stem from roots that are not real
constexpr double kNeighbourhood = 1e-4;      // candidates further apart than this are never the same mode
constexpr double kNearlyReal = 1e-1;         // a pair of roots this near the real axis may be two real ones
constexpr double kSortingResolution = 1e-9;  // coordinates closer than this are equal when modes are sorted

using Complex = std::complex<double>;

/// sum over k = -m..m of c_k exp(i k phi), a real function of phi; coefficient c_k is at index k + m.
class TrigonometricPolynomial {
 public:
  explicit TrigonometricPolynomial(Eigen::VectorXcd coefficients) : coefficients_(std::move(coefficients)) {}
  /// constant + cosine cos(phi) + sine sin(phi)
  TrigonometricPolynomial(double constant, double cosine, double sine) : coefficients_(3) {
    coefficients_ << Complex(cosine, sine) / 2.0, constant, Complex(cosine, -sine) / 2.0;
  }

  Eigen::Index degree() const { return (coefficients_.size() - 1) / 2; }
  double norm() const { return coefficients_.cwiseAbs().sum(); }

  double operator()(double phi) const {
    double sum = 0.0;
    for (Eigen::Index k = -degree(); k <= degree(); ++k) {
      sum += (coefficient(k) * std::polar(1.0, static_cast<double>(k) * phi)).real();
    }
    return sum;
  }

  TrigonometricPolynomial derivative() const {
    Eigen::VectorXcd result = coefficients_;
    for (Eigen::Index k = -degree(); k <= degree(); ++k) result[k + degree()] *= Complex(0.0, static_cast<double>(k));
    return TrigonometricPolynomial(result);
  }

  /// Angles near which all real roots lie: the real parts of all roots, and for pairs near the real axis also either
  /// side, since rounding turns two close real roots into such a pair.
  std::vector<double> root_candidates() const;

  friend TrigonometricPolynomial operator*(const TrigonometricPolynomial& a, const TrigonometricPolynomial& b) {
    Eigen::VectorXcd product = Eigen::VectorXcd::Zero(a.coefficients_.size() + b.coefficients_.size() - 1);
    for (Eigen::Index j = 0; j < b.coefficients_.size(); ++j) {
      product.segment(j, a.coefficients_.size()) += b.coefficients_[j] * a.coefficients_;
    }
    return TrigonometricPolynomial(product);
  }

  /// a + factor b
  static TrigonometricPolynomial sum(const TrigonometricPolynomial& a, double factor,
                                     const TrigonometricPolynomial& b) {
    const Eigen::Index degree = std::max(a.degree(), b.degree());
    Eigen::VectorXcd result = Eigen::VectorXcd::Zero(2 * degree + 1);
    result.segment(degree - a.degree(), a.coefficients_.size()) += a.coefficients_;
    result.segment(degree - b.degree(), b.coefficients_.size()) += factor * b.coefficients_;
    return TrigonometricPolynomial(result);
  }

 private:
  Complex coefficient(Eigen::Index k) const { return coefficients_[k + degree()]; }

  Eigen::VectorXcd coefficients_;
};

std::vector<double> TrigonometricPolynomial::root_candidates() const {
  // With t = tan((phi - origin) / 2), exp(i (phi - origin)) = (1 + i t) / (1 - i t). The leading coefficient in t is
  // the value opposite to the origin; choosing that value large keeps all roots away from infinity.
  const Eigen::Index m = degree();
  double origin = 0.0;
  double largest = 0.0;
  const Eigen::Index samples = 8 * m;
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double phi = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(samples);
    const double magnitude = std::abs((*this)(phi + std::numbers::pi));
    if (magnitude > largest) {
      largest = magnitude;
      origin = phi;
    }
  }
  if (largest == 0.0) return {};
  Eigen::VectorXcd polynomial = Eigen::VectorXcd::Zero(2 * m + 1);
  for (Eigen::Index k = -m; k <= m; ++k) {
    Eigen::VectorXcd term = Eigen::VectorXcd::Zero(2 * m + 1);  // (1 + i t)^(m + k) (1 - i t)^(m - k)
    term[0] = coefficient(k) * std::polar(1.0, static_cast<double>(k) * origin);
    for (Eigen::Index factor = 0; factor < 2 * m; ++factor) {
      const Complex slope(0.0, factor < m + k ? 1.0 : -1.0);
      for (Eigen::Index power = factor + 1; power > 0; --power) term[power] += slope * term[power - 1];
    }
    polynomial += term;
  }
  const Eigen::PolynomialSolver<double, Eigen::Dynamic> solver(polynomial.real().eval());
  std::vector<double> candidates;
  for (const Complex& root : solver.roots()) {
    const Complex angle = 2.0 * std::atan(root);
    candidates.push_back(origin + angle.real());
    if (angle.imag() != 0.0 && std::abs(angle.imag()) < kNearlyReal) {
      candidates.push_back(origin + angle.real() + angle.imag());
    }
  }
  return candidates;
}

/// A pose relative to the first leg: its vector A and the orientation phi.
struct LocalPose {
  Eigen::Vector2d leg;
  double orientation;
};

Eigen::Vector2d quarter_turn(const Eigen::Vector2d& a) { return {-a.y(), a.x()}; }

/// The three circle equations, in units of the manipulator's size.
class Assembly {
 public:
  Assembly(const Manipulator& manipulator, const std::array<double, 3>& lengths) {
    for (std::size_t i = 0; i < 3; ++i) {
      base_[i] = manipulator.leg(i).base_joint - manipulator.leg(0).base_joint;
      platform_[i] = manipulator.leg(i).platform_joint - manipulator.leg(0).platform_joint;
      lengths_[i] = lengths[i];
      size_ = std::max({size_, base_[i].norm(), platform_[i].norm(), lengths[i]});
    }
    if (size_ == 0.0) return;
    for (std::size_t i = 0; i < 3; ++i) {
      base_[i] /= size_;
      platform_[i] /= size_;
      lengths_[i] /= size_;
    }
  }

  double size() const { return size_; }

  /// w_i(phi)
  Eigen::Vector2d offset(std::size_t i, double phi) const { return Eigen::Rotation2Dd(phi) * platform_[i] - base_[i]; }

  /// The largest error of a leg length.
  double residual(const LocalPose& pose) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      largest = std::max(largest, std::abs((pose.leg + offset(i, pose.orientation)).norm() - lengths_[i]));
    }
    return largest;
  }

  /// Whether the platform can be put so that all legs are parallel and equally long: it then moves freely in a circle.
  bool has_parallel_motion() const {
    const std::size_t longer = platform_[1].norm() > platform_[2].norm() ? 1 : 2;
    const double phi = std::atan2(cross(platform_[longer], base_[longer]), platform_[longer].dot(base_[longer]));
    for (std::size_t i = 1; i < 3; ++i) {
      if (offset(i, phi).norm() > kLengthTolerance) return false;
      if (std::abs(lengths_[i] - lengths_[0]) > kLengthTolerance) return false;
    }
    return lengths_[0] > kLengthTolerance;
  }

  /// The orientations at which modes are to be sought, or nothing when a whole range of orientations has modes.
  std::optional<std::vector<double>> orientations() const {
    using T = TrigonometricPolynomial;
    const auto square = [&](std::size_t i) {
      return T(platform_[i].squaredNorm() + base_[i].squaredNorm(), -2.0 * platform_[i].dot(base_[i]),
               -2.0 * cross(platform_[i], base_[i]));
    };
    const auto rho = [&](std::size_t i) {
      const double constant = (lengths_[i] - lengths_[0]) * (lengths_[i] + lengths_[0]);
      return T::sum(T(0.5 * constant, 0.0, 0.0), -0.5, square(i));
    };
    const T delta(cross(platform_[1], platform_[2]) + cross(base_[1], base_[2]),
                  -cross(platform_[1], base_[2]) - cross(base_[1], platform_[2]),
                  platform_[1].dot(base_[2]) - base_[1].dot(platform_[2]));
    const T inner(platform_[1].dot(platform_[2]) + base_[1].dot(base_[2]),
                  -platform_[1].dot(base_[2]) - base_[1].dot(platform_[2]),
                  -cross(platform_[1], base_[2]) + cross(base_[1], platform_[2]));
    const T first = rho(1) * rho(1) * square(2);
    const T second = rho(1) * rho(2) * inner;
    const T third = rho(2) * rho(2) * square(1);
    const double length_square = lengths_[0] * lengths_[0];
    const T numerator = T::sum(T::sum(first, -2.0, second), 1.0, third);
    const T eliminant = T::sum(numerator, -length_square, delta * delta);
    const double terms =
        first.norm() + 2.0 * second.norm() + third.norm() + length_square * delta.norm() * delta.norm();
    if (eliminant.norm() > kRoundingNoise * terms) {
      std::vector<double> candidates = eliminant.root_candidates();
      // Where two modes share an orientation the eliminant has a double root, of which rounding leaves half the digits,
      // but Delta has a simple one.
      const std::vector<double> shared = delta.root_candidates();
      candidates.insert(candidates.end(), shared.begin(), shared.end());
      return candidates;
    }

    // The eliminant vanishes identically. With Delta not zero, A = N / Delta is a solution at every orientation.
    if (delta.norm() > kRoundingNoise) return std::nullopt;
    // Otherwise w_2 and w_3 are parallel at every orientation, and the equation of one of them is implied by that of
    // the other. Circles 1 and i meet where l_1^2 |w_i|^2 - rho_i^2 >= 0.
    const std::size_t i = square(1).norm() > square(2).norm() ? 1 : 2;
    const T discriminant = T::sum(T(length_square, 0.0, 0.0) * square(i), -1.0, rho(i) * rho(i));
    const double noise = kRoundingNoise * (length_square * square(i).norm() + std::pow(rho(i).norm(), 2));
    const T slope = discriminant.derivative();
    if (slope.norm() <= noise) {
      if (discriminant(0.0) >= -noise) return std::nullopt;
      return std::vector<double>{};
    }
    std::vector<double> extremes = slope.root_candidates();
    for (const double phi : extremes) {
      if (discriminant(phi) > noise) return std::nullopt;
    }
    return extremes;
  }

  /// Candidates for A at an orientation: the solution of the linear equations, and the two points at which circle 1
  /// meets circle 2 and circle 3.
  std::vector<LocalPose> positions(double phi) const {
    std::vector<LocalPose> candidates;
    const std::array<Eigen::Vector2d, 2> w = {offset(1, phi), offset(2, phi)};
    std::array<double, 2> rho;
    for (std::size_t i = 0; i < 2; ++i) {
      rho[i] = 0.5 * ((lengths_[i + 1] - lengths_[0]) * (lengths_[i + 1] + lengths_[0]) - w[i].squaredNorm());
      const double square = w[i].squaredNorm();
      if (square == 0.0) continue;
      const double across = std::sqrt(std::max(0.0, lengths_[0] * lengths_[0] - rho[i] * rho[i] / square) / square);
      const Eigen::Vector2d along = w[i] * (rho[i] / square);
      candidates.push_back({along + across * quarter_turn(w[i]), phi});
      candidates.push_back({along - across * quarter_turn(w[i]), phi});
    }
    const double delta = cross(w[0], w[1]);
    if (delta != 0.0) candidates.push_back({quarter_turn(rho[1] * w[0] - rho[0] * w[1]) / delta, phi});
    return candidates;
  }

  /// The values of |a_i|^2 - l_i^2 and their derivatives with respect to A and phi.
  struct Linearisation {
    Eigen::Vector3d values;
    Eigen::Matrix3d slopes;
  };
  Linearisation linearise(const LocalPose& pose) const {
    Linearisation result;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Eigen::Vector2d arm = Eigen::Rotation2Dd(pose.orientation) * platform_[i];
      const Eigen::Vector2d a = pose.leg + arm - base_[i];
      const double length = a.norm();
      result.values[row] = (length - lengths_[i]) * (length + lengths_[i]);
      result.slopes.row(row) << 2.0 * a.x(), 2.0 * a.y(), 2.0 * a.dot(quarter_turn(arm));
    }
    return result;
  }

  /// Newton's method on |a_i|^2 = l_i^2 down to rounding; at a singular pose it converges linearly. Returns the best
  /// iterate.
  LocalPose polish(LocalPose pose) const {
    LocalPose best = pose;
    double best_residual = residual(best);
    int without_progress = 0;
    for (int iteration = 0; iteration < 100 && without_progress < 4 && best_residual > 0.0; ++iteration) {
      const Linearisation linear = linearise(pose);
      const Eigen::Vector3d step = linear.slopes.completeOrthogonalDecomposition().solve(linear.values);
      if (!step.allFinite()) break;
      pose.leg -= step.head<2>();
      pose.orientation -= step[2];
      const double now = residual(pose);
      if (!(now < best_residual)) {
        ++without_progress;
        continue;
      }
      without_progress = 0;
      best_residual = now;
      best = pose;
    }
    return best;
  }

  /// Whether two polished candidates are the same mode: close together, with a pose between them that meets the lengths
  /// as well as they do. The poses that meet them nearly may lie on a curve, so the middle may have to shift a little;
  /// a shift as large as the distance would lead to another mode.
  bool same(const LocalPose& a, const LocalPose& b) const {
    const double turn = wrap_angle(b.orientation - a.orientation);
    const double distance = std::max((b.leg - a.leg).norm(), std::abs(turn));
    if (distance > kNeighbourhood) return false;
    LocalPose middle{0.5 * (a.leg + b.leg), a.orientation + 0.5 * turn};
    const double noise = kRoundingNoise + 2.0 * std::max(residual(a), residual(b));
    for (int correction = 0; correction < 3; ++correction) {
      if (residual(middle) <= noise) return true;
      const Linearisation linear = linearise(middle);
      const Eigen::Vector2d step = linear.slopes.leftCols<2>().completeOrthogonalDecomposition().solve(linear.values);
      if (!(step.norm() <= 0.1 * distance)) return false;
      middle.leg -= step;
    }
    return residual(middle) <= noise;
  }

 private:
  std::array<Eigen::Vector2d, 3> base_;      // c_i - c_1
  std::array<Eigen::Vector2d, 3> platform_;  // p_i - p_1
  std::array<double, 3> lengths_;
  double size_ = 0.0;
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
  const std::optional<std::vector<double>> orientations = assembly.orientations();
  if (!orientations) {
    result.infinitely_many = true;
    return result;
  }
  std::vector<LocalPose> modes;
  for (const double phi : *orientations) {
    for (const LocalPose& candidate : assembly.positions(phi)) {
      if (!(assembly.residual(candidate) <= kCandidateError)) continue;
      LocalPose mode = assembly.polish(candidate);
      if (!(assembly.residual(mode) <= kModeTolerance)) continue;
      mode.orientation = wrap_angle(mode.orientation);
      const auto known =
          std::find_if(modes.begin(), modes.end(), [&](const LocalPose& other) { return assembly.same(mode, other); });
      if (known == modes.end()) {
        modes.push_back(mode);
      } else if (assembly.residual(mode) < assembly.residual(*known)) {
        *known = mode;
      }
    }
  }
  // Modes that differ in one coordinate by rounding only are ordered by the next, so that the order is reproducible.
  const auto key = [](const LocalPose& mode) {
    return std::make_tuple(std::round(mode.orientation / kSortingResolution),
                           std::round(mode.leg.x() / kSortingResolution),
                           std::round(mode.leg.y() / kSortingResolution));
  };
  std::sort(modes.begin(), modes.end(), [&](const LocalPose& a, const LocalPose& b) { return key(a) < key(b); });
  const Leg& leg = manipulator.leg(0);
  for (const LocalPose& mode : modes) {
    result.poses.push_back(
        {leg.base_joint + assembly.size() * mode.leg - Eigen::Rotation2Dd(mode.orientation) * leg.platform_joint,
         mode.orientation});
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
