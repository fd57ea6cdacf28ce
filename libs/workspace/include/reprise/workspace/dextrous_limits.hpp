#pragma once

// The limits of the dextrous workspace W^D[phi_min, phi_max] (thesis chapter 5, eqs. (5.21), (5.22)): the positions at
// which every orientation of a range can be attained.
//
// Limit j of the manipulator must hold at every orientation, so its residual here is the largest over the range,
//     h_j(u) = max over phi in [phi_min, phi_max] of h_j(u, phi),
// with h_j(u, phi) of limits.hpp. With w = u - c_i, every one of them is a sinusoid in phi or the root of one,
//     |a|^2              = |w|^2 + |p|^2 + 2 w.p cos(phi) + 2 w.Jp sin(phi)          (J turns by +90 degrees)
//     edges of wedges    = A + B cos(phi) + C sin(phi),
// so the maximum is at an end of the range or at the sinusoid's extreme, if the range sweeps it: a closed form, in
// place of the optimization (5.26) within the problems (5.30), (5.31). The farthest and the nearest leg lengths swept
// are |w| + |p| and ||w| - |p||. A wedge of pi or wider holds where one of its two edges does; the largest of their
// smaller one may also lie where both are equal. As a maximum of 1-Lipschitz functions h_j is 1-Lipschitz.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reprise/workspace/limits.hpp"

namespace reprise {

/// Limits over a range of orientations, however they are computed.
class OrientationRangeLimits : public Limits {
 public:
  /// Orientations in radians, lower <= upper, less than a full turn apart. Throws std::invalid_argument otherwise.
  explicit OrientationRangeLimits(const Interval& orientations);

  const Interval& orientations() const { return orientations_; }  ///< radians

  /// The limit of the manipulator that limit j of the workspace is.
  virtual const Limit& limit(Eigen::Index j) const = 0;

  /// The orientation of the range at which limit j is nearest to being violated at u; of several, the lowest.
  virtual double critical_orientation(const Eigen::Vector2d& u, Eigen::Index j) const = 0;

 private:
  Interval orientations_;
};

/// The limits of a dextrous workspace, each the largest of its values over the range, in closed form.
class DextrousLimits final : public OrientationRangeLimits {
 public:
  /// Throws std::invalid_argument as OrientationRangeLimits does.
  DextrousLimits(const Manipulator& manipulator, const Interval& orientations);

  const Limit& limit(Eigen::Index j) const override { return limits_[static_cast<std::size_t>(j)]; }
  double critical_orientation(const Eigen::Vector2d& u, Eigen::Index j) const override;

  Eigen::Index count() const override { return static_cast<Eigen::Index>(limits_.size()); }  ///< number of limits
  void evaluate(const Eigen::Vector2d& u, Eigen::Ref<Eigen::VectorXd> h) const override;
  Eigen::Vector2d gradient(const Eigen::Vector2d& u, Eigen::Index j) const override;
  /// Where the curves of limit j at both ends of the range meet at a corner: for the limits of a length and for a
  /// narrow wedge at the platform. (A wide wedge may have corners too, which are not given.)
  std::optional<Eigen::Vector2d> corner(Eigen::Index j, const Eigen::Vector2d& near) const override;
  std::string label(Eigen::Index j) const override { return to_string(limit(j)); }
  Eigen::AlignedBox2d box() const override { return box_; }

 private:
  /// The value of a limit with the rotation (cos phi, sin phi) at which it is taken.
  struct Extreme {
    double value;
    Eigen::Vector2d rotation;
  };

  /// The platform joint of a leg, from P, in the world frame.
  struct Arm {
    Eigen::Vector2d first;  ///< at phi_min
    Eigen::Vector2d last;   ///< at phi_max
    double length;
  };
  /// The shortest and the greatest length of a leg over the range.
  struct LengthRange {
    Extreme shortest;
    Extreme longest;
  };

  /// The outward normals of the edges of an angle limit, at phi = 0; zero ones for a length limit.
  struct Edges {
    Eigen::Vector2d lower;
    Eigen::Vector2d upper;
  };

  bool sweeps(const Eigen::Vector2d& direction) const;
  LengthRange length_range(const Eigen::Vector2d& u, std::size_t leg) const;
  /// The largest h_j of a limit on a joint angle.
  Extreme angle_extreme(const Eigen::Vector2d& u, Eigen::Index j) const;

  Manipulator manipulator_;
  Eigen::Vector2d first_;  ///< (cos phi_min, sin phi_min)
  Eigen::Vector2d last_;   ///< (cos phi_max, sin phi_max)
  std::vector<Arm> arms_;  ///< of each leg
  std::vector<Limit> limits_;
  std::vector<Edges> edges_;  ///< of each limit; empty where none is on an angle
  Eigen::AlignedBox2d box_;
};

}  // namespace reprise
