#pragma once

// The limits of a manipulator as constraints h_j <= 0, all of them lengths.
//
// The limits (5.3) on the leg lengths and (5.4) on the joint angles (thesis chapter 5) are, for one leg, conditions on
// its leg vector a alone, and for the joint at the platform on the orientation phi as well:
//     minimum length   h = l_min - |a|
//     maximum length   h = |a| - l_max
//     angle limits     a must lie in the wedge with apex 0 that is swept counter-clockwise from the direction `lower`
//                      to the direction `upper` (both less than a turn apart, and turned by phi for the joint at the
//                      platform). With e_lower, e_upper the unit vectors along its edges,
//                          lower edge   h = -(e_lower x a)        left of the lower edge's line
//                          upper edge   h =   e_upper x a         right of the upper edge's line
//                      A wedge narrower than pi needs both: two smooth limits. A wider one is the union of the two
//                      half planes: one limit, h = min(-(e_lower x a), e_upper x a).
// Every h is 1-Lipschitz in a, hence in the position u: |h(u) - h(u')| <= |u - u'|. So a point with h_j = -s for the
// largest h_j has only points of the workspace within the distance s: s is a clearance. Searches rely on this.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// The kinds of limit that a leg can have.
enum class LimitKind {
  minimum_length,
  maximum_length,
  base_angle_lower,      ///< edge of a wedge narrower than pi
  base_angle_upper,      ///< edge of a wedge narrower than pi
  base_angle,            ///< both edges of a wedge of pi or wider
  platform_angle_lower,  ///< as for the base
  platform_angle_upper,
  platform_angle,
};

/// As reports write it: "minimum length", "lower base angle", ...
std::string_view to_string(LimitKind kind);

/// One limit of one leg.
struct Limit {
  std::size_t leg;  ///< index from 0
  LimitKind kind;   ///< what it limits, and on which side

  bool operator==(const Limit&) const = default;  ///< same leg and same kind
};

/// As reports write it, with legs counted from 1: "leg 2, maximum length".
std::string to_string(const Limit& limit);

/// All limits of a manipulator, leg by leg, in the order of LimitKind. A minimum length of zero restricts nothing and
/// is left out.
std::vector<Limit> list_limits(const Manipulator& manipulator);

/// h as a function of the leg vector a (world frame) at the orientation phi. The limit's kind must be one that the leg
/// has (see list_limits); std::invalid_argument is thrown for an angle limit it has not.
double limit_value(const Leg& leg, LimitKind kind, const Eigen::Vector2d& a, double orientation);

/// h with its derivatives along a at a fixed orientation. Along the rest they follow from the chain rule with
/// da/du = I, da/dc = -I, da/dp = R(phi); along phi, da/dphi = R(phi) p turned by +90 degrees, and a limit at the
/// platform also has dh/dphi = -gradient . (a turned by +90 degrees) at a fixed a.
struct LimitDerivatives {
  double value;              ///< h, a length
  Eigen::Vector2d gradient;  ///< dh/da, of length 1 (or 0, see below)
  Eigen::Matrix2d hessian;   ///< d2h/da2, symmetric; zero for the angle limits
};

/// Where h is not differentiable, a one-sided choice is made: a leg of length zero gives a zero gradient and Hessian
/// for its length limits; on the bisector of the edges a wide wedge counts its lower edge.
LimitDerivatives limit_derivatives(const Leg& leg, LimitKind kind, const Eigen::Vector2d& a, double orientation);

/// dh/dphi, per radian, at a fixed position u; where h is not differentiable, the same choice is made.
double orientation_slope(const Leg& leg, LimitKind kind, const Pose& pose);

class Limits;

/// Two limits as those of another workspace; see Limits::at_bifurcation.
struct LimitPair {
  const Limits* limits;  ///< those of the other workspace
  Eigen::Index first;    ///< stands for p
  Eigen::Index second;   ///< stands for q
};

/// The limits of a workspace in the plane: the set of all u with h_j(u) <= 0 for every j. This is all that searches and
/// tracing know of a workspace, so any planar workspace can be traced that can be written so.
class Limits {
 public:
  virtual ~Limits() = default;

  virtual Eigen::Index count() const = 0;  ///< number of limits

  /// All h_j(u); h has length count(). Defined and continuous at every finite u. Allocates nothing.
  virtual void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const = 0;

  /// dh_j/du; zero where h_j has no gradient.
  virtual Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j) const = 0;

  /// The point where the curve h_j = 0 has a corner of its own, if it has one; of several, the one nearest to `near`.
  virtual std::optional<Eigen::Vector2d> corner([[maybe_unused]] Eigen::Index j,
                                                [[maybe_unused]] const Eigen::Vector2d& near) const {
    return std::nullopt;
  }

  /// Where limits p and q are zero both, so are two limits of another workspace, if it returns that: one that costs
  /// less to evaluate, for problem (5.20).
  virtual std::optional<LimitPair> at_bifurcation([[maybe_unused]] Eigen::Index p,
                                                  [[maybe_unused]] Eigen::Index q) const {
    return std::nullopt;
  }

  /// What limit j is, for people.
  virtual std::string label(Eigen::Index j) const = 0;

  /// A finite box that holds the whole workspace; empty when the workspace is known to be.
  virtual Eigen::AlignedBox2d box() const = 0;

  /// A number L with |h_j(u) - h_j(u')| <= L |u - u'| for all j; infinity when none is known.
  virtual double lipschitz_constant() const { return 1.0; }

  /// How far computed values may be from h_j, where that is more than rounding.
  virtual double accuracy() const { return 0.0; }
};

/// The limits of the constant-orientation workspace W^C[phi], thesis Section 5.4.1: limit j is list_limits()[j].
class ConstantOrientationLimits final : public Limits {
 public:
  /// Throws std::invalid_argument when the orientation (radians) is not finite.
  ConstantOrientationLimits(const Manipulator& manipulator, double orientation);

  double orientation() const { return orientation_; }  ///< phi, radians
  const Limit& limit(Eigen::Index j) const {
    return limits_[static_cast<std::size_t>(j)];
  }  ///< of which leg, and of which kind

  Eigen::Index count() const override { return static_cast<Eigen::Index>(limits_.size()); }  ///< number of limits
  void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const override;
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j) const override;
  /// The apex of a wide wedge: q_i.
  std::optional<Eigen::Vector2d> corner(Eigen::Index j, const Eigen::Vector2d& near) const override;
  std::string label(Eigen::Index j) const override { return to_string(limit(j)); }
  /// The intersection of the boxes around the legs' outer circles.
  Eigen::AlignedBox2d box() const override { return box_; }

 private:
  /// a_i = u - q_i with q_i = c_i - R(phi) p_i.
  struct FixedLeg {
    Eigen::Vector2d centre;  ///< q_i
    double minimum_length;
    double maximum_length;
  };
  /// What is left of a limit at a fixed orientation.
  struct FixedLimit {
    std::size_t leg;
    LimitKind kind;
    Eigen::Vector2d lower_normal;  ///< h = lower_normal . a for the lower edge, zero for the length limits
    Eigen::Vector2d upper_normal;  ///< h = upper_normal . a for the upper edge, zero for the length limits
  };

  double orientation_;
  std::vector<Limit> limits_;
  std::vector<FixedLeg> fixed_legs_;
  std::vector<FixedLimit> fixed_limits_;
  Eigen::AlignedBox2d box_;
};

}  // namespace reprise
