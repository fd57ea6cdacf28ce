#pragma once

// Rigorous bounds over all poses of a prescribed workspace, in place of samples of them.
//
// A pose is a position u of the prescribed region W_p (inside and outline) and an orientation phi of a closed range; a
// range whose ends are equal is a single orientation. Bounds are found by branch and bound: boxes of poses are bounded
// in interval arithmetic, by the function's own formula and by its mean value form
//     f(z) in f(c) + F'(box) (z - c)  for all z of the box,
// split where they are not sharp enough, and thrown away where the smallest value cannot be: where it would be larger
// than a value already found, and where a derivative along the workspace differs from zero in the whole box, unless the
// box touches the outline or an end of the range; of such a box only that face is kept.
//
// The bounds are theorems about the numbers given (joints, limits, outline and orientations as the double-precision
// numbers they are), rounding errors included. They rest on two assumptions: that the processor rounds to nearest, as
// it does unless told otherwise, and that sine, cosine and power of the C library, of which glibc documents an error of
// at most one unit in the last place, are not wrong by more than four.
//
// All functions throw std::invalid_argument, naming what is wrong, for an orientation that is not finite, a range that
// is reversed or wider than a full turn, a tolerance that is not positive and finite, and a limit on evaluations below
// 1; and where kappa_inverse of conditioning.hpp throws.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

/// All poses with position in a rectangle and orientation in an interval (radians).
struct PoseBox {
  Interval x;            ///< a length
  Interval y;            ///< a length
  Interval orientation;  ///< radians
};

/// Bounds of kappa^-1 and of its derivatives over a box. Where kappa^-1 may be zero it has a kink, and these are its
/// generalised derivatives; where nothing is known they are infinite.
struct KappaInverseBounds {
  Interval value;        ///< within [0, 1]
  Interval x;            ///< d/dx, per length
  Interval y;            ///< d/dy, per length
  Interval orientation;  ///< d/dphi, per radian
};

/// The interval extension of kappa^-1: its values and derivatives at every pose of the box lie within the bounds. The
/// excess of the value's bounds falls with the square of the box's size, that of the derivatives' bounds linearly.
/// Any number of legs from two; where a leg may have length zero nothing is known.
KappaInverseBounds bound_kappa_inverse(const Manipulator& manipulator, const PoseBox& box,
                                       const Conditioning& conditioning = {});

/// When a search for bounds ends.
struct EnclosureOptions {
  double tolerance = 1e-6;           ///< width of the bounds that is aimed at, in the unit of what is bounded
  long max_evaluations = 1'000'000;  ///< of the function, over boxes and at poses; a box may exceed it by one
};

/// lower <= smallest value <= upper, the smallest over all poses. The bounds hold whatever the number of evaluations.
struct MinimumEnclosure {
  double lower;  ///< no value of the function is below it, proved
  double upper;  ///< at most the value at the witness
  /// A pose with a value of at most `upper`, rounded to double precision. Empty, with upper infinite, when the limit on
  /// evaluations came before any pose was looked at.
  std::optional<Pose> witness;
  long evaluations;  ///< of the function, over boxes and at poses
  bool reached;      ///< upper - lower is within the tolerance
};

/// Encloses the smallest kappa^-1 over the prescribed workspace and a range of orientations. For a design of the thesis
/// and its workspaces that takes some 500 evaluations at one orientation and 5000 over ten degrees: milliseconds.
MinimumEnclosure enclose_minimum(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                                 const Interval& orientations, const Conditioning& conditioning = {},
                                 const EnclosureOptions& options = {});

/// What is known of a claim.
enum class Verdict {
  proved,
  refuted,    ///< a witness contradicts it
  undecided,  ///< the bounds are too wide to tell
};

/// "proved", "refuted" or "undecided".
std::string_view to_string(Verdict verdict);

/// The claim that the smallest value is at least this one.
Verdict at_least(const MinimumEnclosure& smallest, double claimed);

/// What is known of one limit over all poses.
struct LimitEnclosure {
  Limit limit;      ///< of which leg, and of which kind
  Verdict verdict;  ///< on the claim about this limit
  /// The smallest margin -h (limits.hpp), a length: negative where the limit is violated.
  MinimumEnclosure margin;
};

/// The claim that one limit, which must be one of list_limits, is violated by no more than `allowance` (a length, at
/// least 0) at any pose. The tolerance is on the margin, and a margin that is within it of -allowance leaves the claim
/// undecided.
LimitEnclosure prove_limit(const Manipulator& manipulator, const Limit& limit, const PrescribedWorkspace& prescribed,
                           const Interval& orientations, double allowance = 0.0,
                           const EnclosureOptions& options = {.tolerance = 1e-9});

/// What is known of all limits. The verdict is on all of them: proved when each is, refuted when one is.
struct Containment {
  Verdict verdict;                     ///< on the claim about all limits
  std::vector<LimitEnclosure> limits;  ///< in the order of list_limits
  std::size_t tightest;                ///< index of the limit whose margin has the smallest lower bound
  long evaluations;                    ///< of all margins together
};

/// The claim that the manipulator reaches every pose, that is, that no limit of any leg is violated by more than
/// `allowance` (a length, at least 0) at any of them. The tolerance is on the margins; a limit whose margin is within
/// it of -allowance stays undecided.
Containment prove_containment(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                              const Interval& orientations, double allowance = 0.0,
                              const EnclosureOptions& options = {.tolerance = 1e-9});

/// A claim that the smallest kappa^-1 over all poses is found already on a part of them.
struct PartCheck {
  Verdict verdict;        ///< on the claim about the part
  MinimumEnclosure part;  ///< over the part
  MinimumEnclosure all;   ///< over all poses; its witness contradicts the claim when that is refuted
};

/// The claim that the smallest kappa^-1 lies on the outline (thesis chapter 5, sections 5.6.1 and 5.8.1). It is an
/// exact statement and proved as such, not within a tolerance: inside, kappa^-1 either has a gradient or is larger than
/// on the outline. Undecided, too, where a smallest value inside differs from that on the outline by less than the
/// tolerance, and where the latter may be zero.
PartCheck check_minimum_on_outline(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                                   const Interval& orientations, const Conditioning& conditioning = {},
                                   const EnclosureOptions& options = {});

/// The claim that the smallest kappa^-1 belongs to an end of the range of orientations (section 5.8.1), alike. The ends
/// must differ.
PartCheck check_minimum_at_range_ends(const Manipulator& manipulator, const PrescribedWorkspace& prescribed,
                                      const Interval& orientations, const Conditioning& conditioning = {},
                                      const EnclosureOptions& options = {});

}  // namespace reprise
