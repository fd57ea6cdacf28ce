#pragma once

// The best design there is, with a proof: dimensional synthesis (synthesis_task.hpp) over all of the thesis's family,
//     maximise over d = [x_C, y_C, x_D, x_E, r]   the smallest kappa^-1 over W_p and the ranges of orientations
//     subject to                                  every limit of every leg, there,
// by branch and bound over boxes of designs in interval arithmetic.
//
// Variables. At the orientation 0 a leg's limits involve z = [q_1, q_2, q_3, y, r] two at a time, with
//     q_1 = x_C + r,   q_2 = x_D + r,   q_3 = x_E - r,   y = y_C:
// leg i reaches the annulus about (q_i, y). r has either sign: with r < 0 legs 1 and 2 are at the platform's right end,
// the platform is turned round; each sign is a search of its own.
//
// Upper bound. Any finite set of poses of W_p gives one: the smallest kappa^-1 over all poses is not larger than that
// over some. A box of designs is left out where, rigorously, all over the box
//     1. a leg is too long or too short at one pose of the outline;
//     2. kappa^-1 is at most the bound at one pose, by its closed form's least value over w (design_functions.hpp);
//     3. sum lambda_j (kappa_j^2 - 1 / bound^2) >= sum mu_k slack_k with multipliers lambda_j, mu_k >= 0, of kappa^2
//        and of slacks of limits at several poses. The multipliers are those of a linear program in floating point;
//        that the inequality holds is verified by its mean value form, so nothing rests on the program.
// By 1, boxes are also made smaller; else they are split in the variable that most blurs 3. The poses are the peaks
// along the outline for the design in the middle of the box. Each box is looked at a little wider than it is, so that
// another implementation with wider enclosures can check the proof (bound_certificate.hpp).
//
// All of these poses are on the outline, and the upper bound asks no more: a hole that a leg's least length leaves
// inside W_p without touching the outline leaves no box out. The bound holds all the same, for it is of more designs
// than those that reach all of W_p.
//
// The root box holds all designs. A design that reaches O' has |q_i - O'_x| and |y - O'_y| within the leg's greatest
// length (and the way by which orientations move them), and
//     kappa^2 >= (3 + w)(1 + 1 / w) / 36,    w = r^4 in the printed normalisation,
// for c, b >= T_3 and A >= 1 / T_3, so that designs with very small or very large |r| are worse than the bound.
//
// Lower bound. A design is found by local searches, at first from points spread over the root box and then from the
// boxes where the upper bound is largest, and it is proved to reach all of W_p at all orientations, inside and outline,
// and to have its smallest kappa^-1 there, by prove_design. So the two bounds enclose the global optimum over whole
// ranges of orientations, though the upper one looks at a few of them.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "reprise/bounds/bound_certificate.hpp"
#include "reprise/bounds/design_proof.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// Where base joints may be.
enum class BaseJoints {
  in_line,   ///< at one height: the thesis's family, d = [x_C, y_C, x_D, x_E, r]
  anywhere,  ///< d = [c_1x, c_1y, c_2x, c_2y, c_3x, c_3y, r]
};

/// Boxes are examined in batches of so many, so that the result does not depend on the number of threads.
inline constexpr std::size_t boxes_in_batch = 256;

/// How far a search has come.
struct GlobalProgress {
  double share;  ///< of the root box's volume that is done
  long boxes;    ///< examined so far
  double lower;  ///< the smallest kappa^-1 of the best design so far, proved; 0 without one
  double upper;  ///< no design is better than this, proved; at most 1
};

/// How to search.
struct GlobalOptions {
  double gap = 1e-6;                             ///< between the bounds, which is aimed at; in [1e-8, 1]
  int side = 1;                                  ///< the sign of r, 1 or -1
  BaseJoints base_joints = BaseJoints::in_line;  ///< the family
  long max_boxes = 1'000'000;                    ///< limit on boxes, at least 1
  long starts = 100;                             ///< of local searches before the first box, at least 0
  long threads = 1;                              ///< at least 1; the result does not depend on it
  /// The sizes |r| that are searched, positive. None: those at which kappa^-1 may be above 0.25, as the root box's
  /// lemma says. No bound below that of the sizes left out is claimed.
  std::optional<Interval> sizes = std::nullopt;
  /// A value known to be reached by a design elsewhere, such as one of the other side: boxes that are not better than
  /// this and the gap are left alone.
  double known = 0.0;
  /// Polled between boxes, by one thread; true ends the search with what is proved so far.
  std::function<bool()> stop = {};
  std::function<void(const GlobalProgress&)> observe = {};  ///< called now and then, by one thread
};

/// How a search ended.
enum class GlobalStatus {
  proved,       ///< the bounds are within the gap
  unreachable,  ///< no design reaches the workspace, proved
  box_limit,    ///< max_boxes came first
  stopped,      ///< by the caller
  exhausted,    ///< boxes that are too small to be split are left: the found design cannot be improved to the gap
};

/// "proved", "unreachable", "box limit", "stopped", "exhausted".
std::string_view to_string(GlobalStatus status);

/// How many boxes were examined, and what became of them.
struct BoxCounts {
  long examined = 0;      ///< all
  long split = 0;         ///< into two
  long alike = 0;         ///< left out by a symmetry
  long limits = 0;        ///< left out by one limit at one pose, slabs that were cut off others included
  long conditioning = 0;  ///< left out by kappa^-1 at one pose
  long combinations = 0;  ///< left out by multipliers, some of them of kappa^-1
  long infeasible = 0;    ///< left out by multipliers of limits only
};

/// The best design there is, within bounds.
struct GlobalOptimum {
  GlobalStatus status = GlobalStatus::stopped;  ///< how the search ended
  std::optional<Eigen::VectorXd> design;        ///< d, proved to reach the workspace; none when none was found
  double lower = 0.0;                           ///< its smallest kappa^-1 over all poses, proved; 0 without one
  double upper = 1.0;                ///< no design of this side has a larger one, proved; 0 where none reaches
  std::optional<DesignProof> proof;  ///< of the design
  BoundCertificate certificate;      ///< of `upper`; without nodes where that is 1
  BoxCounts counts;                  ///< what became of the boxes
};

/// Searches one sign of r. Throws std::invalid_argument for a task that is ill-formed, whose designs are not all of
/// DesignSpace::collinear, or where the size of the platform matters neither for kappa^-1 nor for the limits (the
/// homogeneous normalisation at orientations that are all 0), and for an option that is out of its range.
GlobalOptimum prove_global_optimum(const SynthesisTask& task, const GlobalOptions& options = {});

}  // namespace reprise
