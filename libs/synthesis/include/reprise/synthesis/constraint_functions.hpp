#pragma once

// The constraints of a synthesis (synthesis_task.hpp) as functions of the design and of a position, with derivatives;
// what the pointwise formulation, the semi-infinite one and the exchange over the whole region are made of.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "reprise/geometry/region_distance.hpp"
#include "reprise/optimizers/problem.hpp"
#include "reprise/synthesis/synthesis_task.hpp"
#include "reprise/workspace/dextrous_derivatives.hpp"
#include "reprise/workspace/dextrous_limits.hpp"

namespace reprise {

/// A family of constraints, one for each direction of the outline.
struct ConstraintFamily {
  std::size_t range;           ///< index in the task's orientations
  std::optional<Limit> limit;  ///< none: t - kappa^-1
  /// One orientation for kappa^-1 and for a limit at a slice; for a limit over a range, half of it.
  OrientationRange orientations;
};

/// As reports write it: "kappa^-1 at -5 deg", "leg 2, maximum length at 0 deg", "... from -5 to 0 deg".
std::string to_string(const ConstraintFamily& family);

/// All families of a task, range by range: kappa^-1 at its ends, then the limits over each of its parts.
std::vector<ConstraintFamily> list_families(const SynthesisTask& task);

/// The poses on which kappa^-1 counts as positive: the sign of det J there (singularity_side, for two and three legs).
/// With `either` kappa^-1 is as it is; else it is negative at the poses of the other sign.
enum class SingularitySide {
  either,
  positive,
  negative,
};

/// The factor of kappa^-1 at a pose, 1 or -1, and 0 at a singular pose; for `either` always 1.
int sign_on_side(SingularitySide side, const Manipulator& manipulator, const Pose& pose);

/// A constraint without t, with derivatives along [d, u], k + 2 variables.
struct ConstraintDerivatives {
  double value;              ///< g without t
  Eigen::VectorXd gradient;  ///< of length k + 2
  Eigen::MatrixXd hessian;   ///< symmetric
};

/// A constraint as a row of a problem: a family at a position.
struct ConstraintRow {
  std::size_t family;        ///< index into families()
  Eigen::Vector2d position;  ///< u
  /// None: the family's own. With one, a family of the conditioning is t - kappa^-1 at this orientation in place of its
  /// own; a family of a minimum length is l_min less the distance to the prescribed workspace (region_distance.hpp)
  /// from q = c - R(phi) p, the position that the working point has when the leg has length 0, and the row's position
  /// counts for nothing.
  std::optional<double> orientation = std::nullopt;
};

/// The constraints of a task as functions of a design and a position.
class ConstraintFunctions {
 public:
  /// Validates the task.
  explicit ConstraintFunctions(SynthesisTask task, SingularitySide side = SingularitySide::either);

  /// Readies the object for rows of minimum lengths that have an orientation.
  void measure_distances() { distance_.emplace(task_.prescribed); }

  const SynthesisTask& task() const { return task_; }                          ///< as it was given
  const std::vector<ConstraintFamily>& families() const { return families_; }  ///< in the order of list_families
  Eigen::Index design_size() const { return k_; }                              ///< k, the number of design variables

  /// Whether t enters the family.
  bool is_conditioning(std::size_t family) const { return !families_[family].limit.has_value(); }

  /// The design variables on which a family depends.
  const std::vector<Eigen::Index>& columns(std::size_t family) const;

  /// All families at one design. Keeps the limits at the last position, which families share.
  class AtDesign {
   public:
    /// Builds the manipulator of the design. The functions must outlive the object.
    AtDesign(const ConstraintFunctions& functions, const Eigen::VectorXd& design);

    /// g without t: -kappa^-1, or h.
    double value(std::size_t family, const Eigen::Vector2d& u);
    /// The same for a row, which may have an orientation of its own.
    double value(const ConstraintRow& row);
    /// Along the columns of the family, in their order.
    void design_gradient(const ConstraintRow& row, double* gradient);
    /// A family with its first and second derivatives.
    ConstraintDerivatives derivatives(std::size_t family, const Eigen::Vector2d& u);

    /// Adds up multiples of Hessians along d. The limits of a leg are added up along w and p first.
    void add_hessian(const ConstraintRow& row, double factor);
    /// The sum, k x k and symmetric; begins a new one.
    Eigen::MatrixXd take_hessian();

   private:
    /// The factor of kappa^-1 at a pose.
    double sign(const Pose& pose) const;
    /// -kappa^-1 at a pose, with the side's sign.
    double conditioning(const Pose& pose) const;
    /// The position q of a leg at an orientation, and its derivative along the leg's w and p.
    Eigen::Vector2d pivot(std::size_t leg, double orientation) const;
    static Eigen::Matrix<double, 2, 4> pivot_change(double orientation);
    DextrousLimitDerivatives limit_derivatives(std::size_t family, const Eigen::Vector2d& u) const;

    const ConstraintFunctions& functions_;
    Manipulator manipulator_;
    std::vector<DextrousLimits> parts_;
    Eigen::VectorXd h_;  ///< of a part at a position
    std::size_t part_of_h_;
    Eigen::Vector2d position_of_h_;
    Eigen::VectorXd gradient_;
    Eigen::MatrixXd hessian_;
    Eigen::MatrixXd sum_;
    std::vector<Eigen::Matrix4d> leg_sums_;
  };

 private:
  /// How a leg changes with the design.
  struct LegVariation {
    Eigen::Matrix4Xd joints;            ///< d[w, p]/dd, see dextrous_derivatives.hpp
    std::vector<Eigen::Index> columns;  ///< the design variables that move it or its limits
  };
  /// Where the value of a limit's family is found.
  struct LimitPlace {
    std::size_t part = 0;    ///< index in parts_
    Eigen::Index index = 0;  ///< of the limit
  };

  /// The pose of a row of the conditioning.
  Pose pose_of(const ConstraintRow& row) const;
  /// Whether a row is the distance of a leg's pivot from the prescribed workspace.
  bool is_distance(const ConstraintRow& row) const { return row.orientation && !is_conditioning(row.family); }

  /// dh/dd_j at fixed joints, where the design moves the length limit itself.
  double length_change(const Limit& limit, Eigen::Index j) const;

  SynthesisTask task_;
  SingularitySide side_;
  Eigen::Index k_;
  std::vector<ConstraintFamily> families_;
  std::vector<LimitPlace> places_;  ///< of each family
  std::vector<OrientationRange> parts_;
  Eigen::MatrixXd design_directions_;      ///< of kappa_inverse: along d
  Eigen::MatrixXd all_directions_;         ///< along [d, u]
  std::vector<Eigen::Index> all_columns_;  ///< 0, ..., k - 1
  std::vector<LegVariation> legs_;
  std::optional<RegionDistance> distance_;
};

/// The rows of the pointwise problem: all families at points of the outline, range by range and point by point.
std::vector<ConstraintRow> pointwise_rows(const ConstraintFunctions& functions, int points);

/// Variables [d, t], objective -t, one inequality for each row.
Problem make_problem(std::shared_ptr<const ConstraintFunctions> functions, std::vector<ConstraintRow> rows);

}  // namespace reprise
