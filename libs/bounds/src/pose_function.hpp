#pragma once

// Functions of the pose with rigorous bounds of their values and derivatives over boxes of poses.

#include <optional>
#include <vector>

#include "reprise/kinematics/conditioning.hpp"
#include "reprise/workspace/limits.hpp"
#include "rigorous_arithmetic.hpp"

namespace reprise::rigorous {

/// Positions in a rectangle, and orientations in an interval.
struct Poses {
  Enclosure x;
  Enclosure y;
  Enclosure orientation;
};

/// Values and derivatives of a function over poses; of a function with kinks, its generalised gradients.
struct FirstOrderBounds {
  Enclosure value;
  Enclosure x;
  Enclosure y;
  Enclosure orientation;
};

class PoseFunction {
 public:
  virtual ~PoseFunction() = default;
  virtual Enclosure value(const Poses& poses) const = 0;
  virtual FirstOrderBounds first_order(const Poses& poses) const = 0;
};

/// kappa^-1 (conditioning.hpp). Where a leg may have length zero, and where the quotient of the formula may be 0 / 0,
/// nothing more is known than that it lies in [0, 1].
class KappaInverse final : public PoseFunction {
 public:
  /// Throws std::invalid_argument as kappa_inverse does.
  KappaInverse(const Manipulator& manipulator, const Conditioning& conditioning);

  Enclosure value(const Poses& poses) const override;
  FirstOrderBounds first_order(const Poses& poses) const override;

 private:
  std::vector<Leg> legs_;
  Enclosure turn_factor_;  ///< of dl/dphi in a row of the Jacobian
};

/// The margin of a limit, -h of limits.hpp: a length, negative where the limit is violated.
class Margin final : public PoseFunction {
 public:
  /// The limit must be one that the leg has.
  Margin(const Leg& leg, LimitKind kind) : leg_(leg), kind_(kind) {}

  Enclosure value(const Poses& poses) const override { return first_order(poses).value; }
  FirstOrderBounds first_order(const Poses& poses) const override;

 private:
  Leg leg_;
  LimitKind kind_;
};

}  // namespace reprise::rigorous
