#pragma once

// The inverse problem of synthesis: which prescribed workspaces W_p are compatible with results that were reported for
// them (not in the thesis, which leaves out its own W_p).
//
// A synthesis (5.34), (5.37) or (5.39) reports f(d^0) and f*, the smallest kappa^-1 over W_p with the starting and with
// the final design, and ends where W_p touches the boundary of the final design's workspace W_c from inside. Where the
// two values are known within intervals, every point u of W_p satisfies
//     u in W_c(d*),    kappa^-1(d*, u) >= lower end of f*,    kappa^-1(d^0, u) >= lower end of f(d^0),              (1)
// at all orientations in question, and there are points of W_p where
//     kappa^-1(d^0, u) <= upper end of f(d^0),    kappa^-1(d*, u) <= upper end of f*,    u on the boundary of W_c.  (2)
// The regions that are star-shaped about O' and satisfy (1) all lie within a largest one, the union of the segments
// from O' that satisfy (1) throughout. Since (2) asks only for some points, a compatible W_p exists exactly when the
// largest region itself satisfies (2): no family of shapes has to be assumed. The same holds for several syntheses of
// one W_p in different sizes, with the intersection of their largest regions, brought to one size.
//
// All this is taken along sampled rays from O'. Along a ray kappa^-1 is linear between sampled radii; what lies between
// two rays is not seen. The values are exact at the samples, so that this is evidence to the resolution of the grid,
// not a proof.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reprise/kinematics/conditioning.hpp"
#include "reprise/synthesis/design_space.hpp"

namespace reprise::experiments {

/// What is known of a synthesis whose prescribed workspace is not.
struct ReportedSynthesis {
  DesignSpace designs;
  Conditioning conditioning;
  std::vector<double> orientations;  ///< at which kappa^-1 is taken, radians; at least one
  /// W_c is the dextrous workspace over this range (radians); without it, the points reached at every orientation.
  std::optional<Interval> dextrous_range;
  Eigen::VectorXd start;         ///< d^0
  Interval start_value;          ///< holds f(d^0)
  Eigen::VectorXd final_design;  ///< d*, as reported
  Interval final_value;          ///< holds f*
  /// The true d* differs from the reported one by at most this in each entry; empty for not at all. The conditions are
  /// then relaxed as far as it may matter: length limits by a bound of the change of the leg vectors, kappa^-1(d*) by
  /// its change to first order. (Joint-angle limits are taken as they are.)
  Eigen::VectorXd rounding;
  /// How far W_p may stick out of W_c in addition, a length: where the synthesis allowed W_p to miss W_c by a small
  /// area.
  double protrusion = 0.0;
};

/// The rays from O': directions at equal angles, the first along x; each with this many equal steps up to the boundary
/// of W_c.
struct RaySampling {
  int directions = 360;  ///< at least 3
  int steps = 200;       ///< at least 1
};

/// The outlines compatible with one synthesis, along the rays from O'.
class CompatibleOutlines {
 public:
  /// Throws std::invalid_argument, naming what is wrong, when there is no orientation, a number is not finite, a length
  /// does not fit, an interval is reversed, rounding or protrusion is negative, or the sampling is out of range; and
  /// where Manipulator and DextrousLimits do.
  CompatibleOutlines(const ReportedSynthesis& reported, const Eigen::Vector2d& centre,
                     const RaySampling& sampling = {});

  std::size_t directions() const { return rays_.size(); }

  /// The angle of ray i, in [0, 2 pi).
  double direction(std::size_t i) const;

  /// Radii of the boundary of W_c(d*), seen from O' (where a ray first leaves it); zero when O' is outside.
  const std::vector<double>& workspace() const { return workspace_; }

  /// Radii of the largest star-shaped region that satisfies what (1) says of d*.
  const std::vector<double>& largest_for_final_design() const { return largest_for_final_design_; }

  /// Radii of the largest star-shaped region that satisfies (1).
  const std::vector<double>& largest() const { return largest_; }

  /// Number of rays on which points beyond the largest region, but before the ray leaves W_c, satisfy (1) again. Where
  /// it is zero, an outline whose points satisfy (1) encloses none that does not.
  int rays_with_gaps() const { return rays_with_gaps_; }

  /// What the points of a star-shaped region attain.
  struct Attained {
    double start_value;  ///< smallest kappa^-1 with d^0
    double final_value;  ///< smallest kappa^-1 with d*, as small as the rounding allows
    double gap;  ///< how far the region ends before the boundary of W_c, at the least, along a ray; rounding allowed
  };

  /// Of the points on ray i up to a radius, which is taken to be at most workspace()[i].
  Attained attained_on_ray(std::size_t i, double radius) const;

  /// Of the region with these radii, one for each ray. Throws std::invalid_argument when their number does not fit.
  Attained attained(std::span<const double> radii) const;

  /// Whether (2) is satisfied.
  bool satisfied_by(const Attained& attained) const;

 private:
  struct Ray {
    double step;                       ///< between samples
    std::vector<double> start_values;  ///< smallest kappa^-1 with d^0 up to each sample
    std::vector<double> final_values;  ///< the same with d*, rounding in favour of (2)
    double touching_radius;            ///< where the boundary of W_c begins, rounding in favour of (2)
  };

  Interval start_value_;
  Interval final_value_;
  std::vector<Ray> rays_;
  std::vector<double> workspace_;
  std::vector<double> largest_for_final_design_;
  std::vector<double> largest_;
  int rays_with_gaps_ = 0;
};

/// The same prescribed workspace in the size of one synthesis: its lengths divided by a number.
struct SizedOutlines {
  const CompatibleOutlines* outlines;
  double divisor;  ///< positive and finite
};

/// The largest star-shaped outline, before the division, that satisfies (1) for all.
struct CommonOutline {
  std::vector<double> radii;
  std::vector<CompatibleOutlines::Attained> attained;  ///< in the size of each
  bool compatible;                                     ///< whether (2) is satisfied for all: a common W_p exists
};

/// Throws std::invalid_argument when there is none, their directions differ in number, or a divisor is out of range.
CommonOutline common_outline(std::span<const SizedOutlines> sized);

}  // namespace reprise::experiments
