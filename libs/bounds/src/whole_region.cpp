#include "reprise/bounds/whole_region.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/synthesis/constraint_functions.hpp"

namespace reprise {
namespace {

/// Orientations of a range at which the distance of a leg's pivot is taken as soon as it is looked at.
constexpr int first_distances = 9;

bool is_minimum_length(const std::optional<Limit>& limit) { return limit && limit->kind == LimitKind::minimum_length; }

/// The legs whose minimum length is a distance.
std::vector<bool> legs_by_distance(std::size_t legs, const std::vector<PoseConstraint>& constraints) {
  std::vector<bool> chosen(legs, false);
  for (const PoseConstraint& one : constraints) {
    if (is_minimum_length(one.limit)) chosen.at(one.limit->leg) = true;
  }
  return chosen;
}

ConstraintRow row_of(const ConstraintFunctions& functions, const PoseConstraint& constraint) {
  const std::vector<ConstraintFamily>& families = functions.families();
  for (std::size_t family = 0; family < families.size(); ++family) {
    const OrientationRange& range = functions.task().orientations[families[family].range];
    const Interval& part = constraint.limit ? families[family].orientations : range;
    const double phi = constraint.pose.orientation;
    if (families[family].limit != constraint.limit || phi < part.lower || phi > part.upper) continue;
    const bool at_orientation = !constraint.limit || is_minimum_length(constraint.limit);
    return {family, constraint.pose.position, at_orientation ? std::optional(phi) : std::nullopt};
  }
  require(false, "a constraint of the whole region",
          constraint.limit ? to_string(*constraint.limit) : std::string("kappa^-1"),
          "a limit of the manipulator or kappa^-1, at an orientation of a range");
  return {};
}

/// The problem and the functions behind it.
struct Posed {
  std::shared_ptr<const ConstraintFunctions> functions;
  std::vector<ConstraintRow> rows;

  Problem problem() const { return make_problem(functions, rows); }

  /// The largest t at which a design meets the conditioning.
  double smallest_kappa_inverse(const Eigen::VectorXd& design) const {
    ConstraintFunctions::AtDesign at(*functions, design);
    double smallest = infinity;
    for (const ConstraintRow& row : rows) {
      if (functions->is_conditioning(row.family)) smallest = std::min(smallest, -at.value(row));
    }
    return smallest;
  }

  /// The largest violation of a limit, at least 0.
  double violation(const Eigen::VectorXd& design) const {
    ConstraintFunctions::AtDesign at(*functions, design);
    double largest = 0.0;
    for (const ConstraintRow& row : rows) {
      if (!functions->is_conditioning(row.family)) largest = std::max(largest, at.value(row));
    }
    return largest;
  }
};

Posed pose_problem(const SynthesisTask& task, const std::vector<PoseConstraint>& constraints,
                   const PointwiseOptions& options) {
  const auto functions = std::make_shared<ConstraintFunctions>(task, options.side);
  const std::vector<bool> by_distance = legs_by_distance(task.designs.legs(), constraints);
  if (std::find(by_distance.begin(), by_distance.end(), true) != by_distance.end()) functions->measure_distances();
  std::vector<ConstraintRow> rows = pointwise_rows(*functions, options.points);
  const auto left_out = [&](const ConstraintRow& row) {
    const std::optional<Limit>& limit = functions->families()[row.family].limit;
    return is_minimum_length(limit) && by_distance[limit->leg];
  };
  rows.erase(std::remove_if(rows.begin(), rows.end(), left_out), rows.end());
  for (const PoseConstraint& one : constraints) rows.push_back(row_of(*functions, one));
  return {functions, std::move(rows)};
}

/// kappa^-1 with the side's sign, as the problem has it.
double signed_kappa_inverse(const SynthesisTask& task, const Manipulator& manipulator, const Pose& pose,
                            SingularitySide side) {
  return sign_on_side(side, manipulator, pose) * kappa_inverse(manipulator, pose, task.conditioning);
}

/// The pose of a coarse grid over region and range at which the signed kappa^-1 is smallest. Beyond singular poses it
/// is negative, where a bound of kappa^-1 ends at the first singular pose.
Pose lowest_of_grid(const SynthesisTask& task, const Manipulator& manipulator, const OrientationRange& range,
                    SingularitySide side) {
  constexpr int directions = 24, radii = 4, orientations = 5;
  Pose lowest{task.prescribed.centre(), range.lower};
  double smallest = infinity;
  for (const double phi : range.spread(orientations)) {
    for (int i = 0; i < directions; ++i) {
      const double beta = 2.0 * pi * i / directions;
      const Eigen::Vector2d outward = task.prescribed.point(beta) - task.prescribed.centre();
      for (int k = 0; k <= radii; ++k) {
        const Pose pose{task.prescribed.centre() + outward * (static_cast<double>(k) / radii), phi};
        const double value = signed_kappa_inverse(task, manipulator, pose, side);
        if (value < smallest) {
          smallest = value;
          lowest = pose;
        }
      }
    }
  }
  return lowest;
}

/// The exchange.
class Exchange {
 public:
  Exchange(const SynthesisTask& task, const WholeRegionOptions& options) : task_(task), options_(options) {}

  WholeRegionResult run(const Eigen::VectorXd& start, const Solver& solver, const Observer& observer) {
    add_holes(task_.designs.manipulator(start));
    Eigen::VectorXd design = start;
    std::optional<WholeRegionResult> best;
    Counts spent;
    std::vector<Iterate> history;
    long iterates = 0;
    for (int round = 1; round <= options_.max_rounds; ++round) {
      const Posed posed = pose_problem(task_, constraints_, options_.pointwise);
      Eigen::VectorXd x(design.size() + 1);
      x << design, posed.smallest_kappa_inverse(design);
      Options solver_options = options_.solver;
      solver_options.max_function_evaluations -= spent.function_evaluations();
      if (solver_options.max_function_evaluations < 1) break;
      const auto continued = [&](Iterate iterate) {
        iterate.index += iterates;
        iterate.counts += spent;
        return iterate;
      };
      long seen = 0;
      Result solved = solver.minimize(posed.problem(), x, solver_options, [&](const Iterate& iterate) {
        ++seen;
        return !observer || observer(continued(iterate));
      });
      for (const Iterate& iterate : solved.history) history.push_back(continued(iterate));
      spent += solved.counts;
      iterates += seen;
      design = solved.x.head(start.size());
      const bool ended = solved.status == Status::stopped;
      WholeRegionResult result{
          design, std::move(solved), prove_design(task_, design, options_.proof), constraints_, round, false};
      const bool more = !ended && join(posed, result);
      result.closed = !ended && !more;
      if (!best || better(result, *best)) best = std::move(result);
      best->rounds = round;
      if (!more) break;
    }
    best->constraints = constraints_;
    best->solved.counts = spent;
    best->solved.history = std::move(history);
    return *best;
  }

 private:
  /// A later round sees more; it is the better one unless it lost the workspace that an earlier one reaches.
  static bool better(const WholeRegionResult& later, const WholeRegionResult& earlier) {
    const bool reaches = later.proof.reaches == Verdict::proved;
    const bool reached = earlier.proof.reaches == Verdict::proved;
    if (reaches != reached) return reaches;
    return reaches ? later.proof.kappa_inverse.upper >= earlier.proof.kappa_inverse.upper
                   : later.proof.violation <= earlier.proof.violation;
  }

  /// Minimum lengths of a design that leave holes join.
  bool add_holes(const Manipulator& manipulator) {
    bool added = false;
    for (std::size_t leg = 0; leg < manipulator.size(); ++leg) {
      for (const OrientationRange& range : task_.orientations) {
        if (find_hole(task_.prescribed, manipulator.leg(leg), range)) added = take_distances(leg) || added;
      }
    }
    return added;
  }

  /// From now on the minimum length of a leg is a distance, over all ranges.
  bool take_distances(std::size_t leg) {
    if (legs_by_distance(task_.designs.legs(), constraints_)[leg]) return false;
    for (const OrientationRange& range : task_.orientations) {
      for (const double phi : range.spread(first_distances)) {
        constraints_.push_back({Limit{leg, LimitKind::minimum_length}, {task_.prescribed.centre(), phi}});
      }
    }
    return true;
  }

  /// What the proof of a round's design finds and its problem did not see joins. Returns whether anything did.
  bool join(const Posed& posed, const WholeRegionResult& result) {
    const Manipulator manipulator = task_.designs.manipulator(result.design);
    bool added = add_holes(manipulator);
    const double allowed = posed.violation(result.design) + options_.length_tolerance;
    for (const LimitEnclosure& one : result.proof.limits) {
      if (!one.margin.witness || -one.margin.upper <= allowed) continue;
      if (is_minimum_length(one.limit)) take_distances(one.limit.leg);
      constraints_.push_back({one.limit, *one.margin.witness});
      added = true;
    }
    const SingularitySide side = options_.pointwise.side;
    const double smallest = posed.smallest_kappa_inverse(result.design);
    const auto consider = [&](const Pose& pose) {
      if (signed_kappa_inverse(task_, manipulator, pose, side) >= smallest - options_.conditioning_tolerance) return;
      constraints_.push_back({std::nullopt, pose});
      added = true;
    };
    for (const MinimumEnclosure& one : result.proof.kappa_inverses) {
      if (one.witness) consider(*one.witness);
    }
    for (const OrientationRange& range : task_.orientations) consider(lowest_of_grid(task_, manipulator, range, side));
    return added;
  }

  const SynthesisTask& task_;
  const WholeRegionOptions& options_;
  std::vector<PoseConstraint> constraints_;
};

}  // namespace

Problem whole_region_problem(const SynthesisTask& task, const std::vector<PoseConstraint>& constraints,
                             const PointwiseOptions& options) {
  return pose_problem(task, constraints, options).problem();
}

WholeRegionResult solve_whole_region(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                     const WholeRegionOptions& options, const Observer& observer) {
  require(options.conditioning_tolerance > 0.0, "the tolerance of the conditioning", options.conditioning_tolerance,
          "positive");
  require(options.length_tolerance > 0.0, "the tolerance of lengths", options.length_tolerance, "positive");
  require(options.max_rounds >= 1, "the limit on rounds", options.max_rounds, "at least 1");
  return Exchange(task, options).run(design, solver, observer);
}

}  // namespace reprise
