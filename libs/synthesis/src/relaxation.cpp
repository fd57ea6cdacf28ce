#include "reprise/synthesis/relaxation.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/geometry/region_distance.hpp"
#include "reprise/synthesis/constraint_functions.hpp"
#include "reprise/workspace/dextrous_derivatives.hpp"
#include "reprise/workspace/dextrous_limits.hpp"

namespace reprise {
namespace {

/// What workspace, orientations and minimum lengths keep of themselves, so that none of them vanishes.
constexpr double least_share = 1e-3;

void check(const SynthesisTask& task, const Relaxation& relaxation) {
  validate(task);
  if (relaxation.leg) {
    require(*relaxation.leg < task.designs.legs(), "the leg that gives", *relaxation.leg, "below the number of legs");
  }
}

/// Whether a leg's length gives.
bool gives(const Relaxation& relaxation, std::size_t leg) { return !relaxation.leg || *relaxation.leg == leg; }

/// Whether a limit of a leg's length gives.
bool gives(RelaxationKind relaxation, LimitKind limit) {
  switch (relaxation) {
    case RelaxationKind::lengths:
      return limit == LimitKind::minimum_length || limit == LimitKind::maximum_length;
    case RelaxationKind::maximum_lengths:
      return limit == LimitKind::maximum_length;
    case RelaxationKind::minimum_lengths:
      return limit == LimitKind::minimum_length;
    default:
      return false;
  }
}

/// The middle of all orientations.
double middle_of(const std::vector<OrientationRange>& orientations) {
  Interval hull = orientations.front();
  for (const OrientationRange& range : orientations) {
    hull = {std::min(hull.lower, range.lower), std::max(hull.upper, range.upper)};
  }
  return 0.5 * (hull.lower + hull.upper);
}

double scaled_about(double middle, double share, double phi) { return middle + share * (phi - middle); }

/// The legs whose length limits give by the amount.
std::vector<Leg> relaxed(std::vector<Leg> legs, const Relaxation& relaxation, double amount) {
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (!gives(relaxation, i)) continue;
    Interval& length = legs[i].length;
    if (gives(relaxation.kind, LimitKind::maximum_length)) length.upper += amount;
    if (gives(relaxation.kind, LimitKind::minimum_length) && length.lower > 0.0) length.lower -= amount;
  }
  return legs;
}

/// The design variables that move joints and no lengths.
std::vector<Eigen::Index> joint_variables(const DesignSpace& designs) {
  std::vector<Eigen::Index> variables;
  for (Eigen::Index j = 0; j < designs.size(); ++j) {
    if (designs.length_map().col(j).isZero(0.0)) variables.push_back(j);
  }
  return variables;
}

/// Bounds of full length, infinite where there is none.
Eigen::VectorXd filled(const Eigen::VectorXd& bounds, Eigen::Index size, double none) {
  return bounds.size() == 0 ? Eigen::VectorXd::Constant(size, none) : bounds;
}

/// A row of the working set. Of a hole, `direction` has no meaning.
struct Row {
  std::size_t family;
  double direction;
};

/// A local maximum of a family along the outline, or the value of a hole.
struct ReachPeak {
  Row row;
  double value;
};

/// All limits as functions of z = [d, a, s], without s.
class Reach {
 public:
  struct Family {
    std::size_t range;
    std::size_t part;  ///< of the range; of a hole, that whose lower end is the middle
    std::size_t leg;
    Eigen::Index index = 0;  ///< among the leg's limits
    Limit limit;
    bool hole = false;
  };

  Reach(const SynthesisTask& task, std::optional<Relaxation> relaxation, int samples)
      : task_(task),
        relaxation_(relaxation),
        k_(task.designs.size()),
        middle_(middle_of(task.orientations)),
        distance_(task.prescribed),
        directions_(task.prescribed.angles(samples)) {
    const Manipulator& origin = task.designs.origin();
    const std::vector<Limit> limits = list_limits(origin);
    for (std::size_t i = 0; i < task.orientations.size(); ++i) {
      const OrientationRange& range = task.orientations[i];
      const double middle = 0.5 * (range.lower + range.upper);
      // Each half by itself: then no limit has a kink where it is largest, see dextrous_derivatives.hpp.
      if (!range.is_slice()) parts_.push_back({range.lower, middle});
      const std::size_t first = range.is_slice() ? parts_.size() : parts_.size() - 1;
      parts_.push_back({middle, range.upper});
      for (std::size_t part = first; part < parts_.size(); ++part) {
        std::vector<Eigen::Index> index(origin.size(), 0);
        for (const Limit& limit : limits) families_.push_back({i, part, limit.leg, index[limit.leg]++, limit, false});
      }
      for (const Limit& limit : limits) {
        if (limit.kind != LimitKind::minimum_length) continue;
        families_.push_back({i, parts_.size() - 1, limit.leg, 0, limit, true});
      }
    }
    for (std::size_t leg = 0; leg < origin.size(); ++leg) {
      const auto row = static_cast<Eigen::Index>(leg);
      Eigen::Matrix4Xd joints = task.designs.joint_map().middleRows<4>(4 * row);
      joints.topRows<2>() *= -1.0;  // w = u - c
      std::vector<Eigen::Index> columns;
      for (Eigen::Index j = 0; j < k_; ++j) {
        if (!joints.col(j).isZero(0.0) || !task.designs.length_map().middleRows<2>(2 * row).col(j).isZero(0.0)) {
          columns.push_back(j);
        }
      }
      joints_.push_back(std::move(joints));
      columns_.push_back(std::move(columns));
    }
    const std::vector<double>& corners = task.prescribed.corners();
    for (const double beta : directions_) {
      outline_.push_back(task.prescribed.point(beta));
      corner_.push_back(std::binary_search(corners.begin(), corners.end(), beta));
    }
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      step_ = std::max(step_, (outline_[i] - outline_[(i + 1) % outline_.size()]).norm());
    }
    constexpr double rounding = 1e-9;
    touching_ = rounding * task.prescribed.radius(0.0);
  }

  const SynthesisTask& task() const { return task_; }
  const std::vector<Family>& families() const { return families_; }
  /// The design variables on which a leg depends.
  const std::vector<Eigen::Index>& columns(std::size_t leg) const { return columns_[leg]; }
  Eigen::Index design_size() const { return k_; }
  std::size_t samples() const { return directions_.size(); }

  class AtPoint {
   public:
    AtPoint(const Reach& reach, const Eigen::VectorXd& z)
        : reach_(reach),
          legs_(reach.task_.designs.manipulator(z.head(reach.k_)).legs()),
          share_(1.0 - (reach.gives_way(RelaxationKind::workspace) ? z[reach.k_] : 0.0)) {
      if (reach.relaxation_) legs_ = relaxed(std::move(legs_), *reach.relaxation_, z[reach.k_]);
      const double turning = 1.0 - (reach.gives_way(RelaxationKind::orientations) ? z[reach.k_] : 0.0);
      limits_.reserve(reach.parts_.size() * legs_.size());
      for (const Interval& part : reach.parts_) {
        const Interval shrunk = turning == 1.0 ? part
                                               : Interval{scaled_about(reach.middle_, turning, part.lower),
                                                          scaled_about(reach.middle_, turning, part.upper)};
        for (const Leg& leg : legs_) limits_.emplace_back(Manipulator("leg", {leg}), shrunk);
      }
    }

    double value(const Family& family, double beta) {
      if (family.hole) return legs_[family.leg].length.lower - distance(family).value;
      return limit_value(family, position(reach_.task_.prescribed.point(beta)));
    }

    /// Along the columns of the leg, then along a.
    void gradient(const Family& family, double beta, double* entries) {
      const Leg& leg = legs_[family.leg];
      const DextrousLimits& limits = limits_of(family);
      Eigen::Vector4d along_joints;  // dh/d[w, p]
      double along_amount = 0.0;
      if (family.hole) {
        const double phi = limits.orientations().lower;
        const Distance from = distance(family);
        const Eigen::Vector2d& n = from.normal;  // of D at q = c - R p, so that dh = -n . dq
        along_joints << n, Eigen::Rotation2Dd(-phi) * n;
        if (reach_.gives_way(RelaxationKind::workspace)) along_amount = -n.dot(from.outline_point - centre());
        if (reach_.gives_way(RelaxationKind::orientations)) {
          const Eigen::Vector2d arm = Eigen::Rotation2Dd(phi) * leg.platform_joint;
          along_amount = -n.dot(quarter_turned(arm)) * (reach_.parts_[family.part].lower - reach_.middle_);
        }
      } else {
        const Eigen::Vector2d u0 = reach_.task_.prescribed.point(beta);
        const Eigen::Vector2d u = position(u0);
        const double critical = limits.critical_orientation(u, family.index);
        along_joints =
            dextrous_limit_derivatives(leg, family.limit.kind, u - leg.base_joint, limits.orientations(), critical)
                .gradient;
        if (reach_.gives_way(RelaxationKind::workspace)) along_amount = -along_joints.head<2>().dot(u0 - centre());
        if (reach_.gives_way(RelaxationKind::orientations)) {
          // Within the part the slope is zero.
          const Interval& part = reach_.parts_[family.part];
          const double slope = orientation_slope(leg, family.limit.kind, {u, critical});
          if (critical == limits.orientations().lower)
            along_amount = -slope * (part.lower - reach_.middle_);
          else if (critical == limits.orientations().upper)
            along_amount = -slope * (part.upper - reach_.middle_);
        }
      }
      const auto row = 2 * static_cast<Eigen::Index>(family.leg);
      const bool minimum = family.limit.kind == LimitKind::minimum_length;
      const bool maximum = family.limit.kind == LimitKind::maximum_length;
      const Eigen::MatrixXd& lengths = reach_.task_.designs.length_map();
      for (const Eigen::Index j : reach_.columns_[family.leg]) {
        double slope = along_joints.dot(reach_.joints_[family.leg].col(j));
        if (minimum) slope += lengths(row, j);
        if (maximum) slope -= lengths(row + 1, j);
        *entries++ = slope;
      }
      const std::optional<Relaxation>& relaxation = reach_.relaxation_;
      if (relaxation && gives(*relaxation, family.leg) && gives(relaxation->kind, family.limit.kind)) {
        along_amount = -1.0;
      }
      *entries = along_amount;
    }

    /// The local maxima of all families that may be above `level`, and the largest of all.
    std::vector<ReachPeak> peaks(double level) {
      std::vector<ReachPeak> found;
      std::vector<double> values(reach_.samples());
      for (std::size_t f = 0; f < reach_.families_.size(); ++f) {
        const Family& family = reach_.families_[f];
        if (family.hole) {
          const Distance from = distance(family);
          if (from.value <= reach_.touching_) found.push_back({{f, 0.0}, legs_[family.leg].length.lower - from.value});
          continue;
        }
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = limit_value(family, position(reach_.outline_[i]));
        for (std::size_t i = 0; i < values.size(); ++i) {
          const double before = values[i == 0 ? values.size() - 1 : i - 1];
          const double after = values[i + 1 == values.size() ? 0 : i + 1];
          if (!(values[i] > before && values[i] >= after) || values[i] + reach_.step_ < level) continue;
          found.push_back(refined(f, i, values[i]));
        }
        // A circle about the leg's base joint: the value is the same all round.
        const auto highest = std::max_element(values.begin(), values.end());
        if (*highest == *std::min_element(values.begin(), values.end())) {
          const auto i = static_cast<std::size_t>(highest - values.begin());
          found.push_back({{f, reach_.directions_[i]}, *highest});
        }
      }
      return found;
    }

    /// The pose of a row.
    LimitAtPose at_pose(const Row& row) {
      const Family& family = reach_.families_[row.family];
      const DextrousLimits& limits = limits_of(family);
      const Leg& leg = legs_[family.leg];
      if (family.hole) {
        // At q itself the leg has length 0.
        return {family.limit, centre_of(family), limits.orientations().lower, leg.length.lower};
      }
      const Eigen::Vector2d u = position(reach_.task_.prescribed.point(row.direction));
      return {family.limit, u, limits.critical_orientation(u, family.index), limit_value(family, u)};
    }

   private:
    struct Distance {
      double value;                   ///< D, negative inside
      Eigen::Vector2d normal;         ///< dD/dq
      Eigen::Vector2d outline_point;  ///< the nearest one, before the workspace gives
    };

    const Eigen::Vector2d& centre() const { return reach_.task_.prescribed.centre(); }
    Eigen::Vector2d position(const Eigen::Vector2d& u0) const {
      return share_ == 1.0 ? u0 : Eigen::Vector2d(centre() + share_ * (u0 - centre()));
    }
    const DextrousLimits& limits_of(const Family& family) const {
      return limits_[family.part * legs_.size() + family.leg];
    }
    double limit_value(const Family& family, const Eigen::Vector2d& u) {
      const DextrousLimits& limits = limits_of(family);
      h_.resize(limits.count());
      limits.evaluate(u, h_);
      return h_[family.index];
    }

    ReachPeak refined(std::size_t f, std::size_t i, double value) {
      const std::vector<double>& directions = reach_.directions_;
      const double here = directions[i];
      const double before = i == 0 ? directions.back() - full_turn : directions[i - 1];
      const double after = i + 1 == directions.size() ? directions.front() + full_turn : directions[i + 1];
      ReachPeak best{{f, here}, value};
      const auto look_between = [&](double from, double to) {
        constexpr int half_of_the_digits = std::numeric_limits<double>::digits / 2;
        std::uintmax_t limit = 60;
        const auto [beta, negative] = boost::math::tools::brent_find_minima(
            [&](double b) { return -this->value(reach_.families_[f], b); }, from, to, half_of_the_digits, limit);
        if (-negative > best.value) best = {{f, beta}, -negative};
      };
      if (reach_.corner_[i]) {
        look_between(before, here);
        look_between(here, after);
      } else {
        look_between(before, after);
      }
      return best;
    }

    /// q at the middle of a hole's range.
    Eigen::Vector2d centre_of(const Family& family) const {
      const Leg& leg = legs_[family.leg];
      return leg.base_joint - Eigen::Rotation2Dd(limits_of(family).orientations().lower) * leg.platform_joint;
    }

    /// That of q from a workspace which has shrunk about its centre is that of a point farther out from the whole one.
    Distance distance(const Family& family) const {
      const Eigen::Vector2d point = centre() + (centre_of(family) - centre()) / share_;
      const DistanceDerivatives from = reach_.distance_.derivatives(point);
      return {share_ * from.value, from.gradient, point - from.value * from.gradient};
    }

    const Reach& reach_;
    std::vector<Leg> legs_;
    double share_;                        ///< of the workspace
    std::vector<DextrousLimits> limits_;  ///< of each part and leg
    Eigen::VectorXd h_;
  };

  bool gives_way(RelaxationKind kind) const { return relaxation_ && relaxation_->kind == kind; }

 private:
  SynthesisTask task_;
  std::optional<Relaxation> relaxation_;
  Eigen::Index k_;
  double middle_;
  RegionDistance distance_;
  std::vector<OrientationRange> parts_;
  std::vector<Family> families_;
  std::vector<Eigen::Matrix4Xd> joints_;  ///< d[w, p]/dd of each leg
  std::vector<std::vector<Eigen::Index>> columns_;
  std::vector<double> directions_;
  std::vector<Eigen::Vector2d> outline_;
  std::vector<bool> corner_;
  double step_ = 0.0;      ///< the longest between two samples
  double touching_ = 0.0;  ///< what is nearer than this to the outline lies on it
};

/// A row with its life in the set.
struct Member {
  Row row;
  int slack_rounds = 0;
  bool returned = false;  ///< it has left once, and stays now
};

enum class Goal { least_largest, least_amount };

/// The exchange over z = [d, a, s].
class Search {
 public:
  Search(const SynthesisTask& task, std::optional<Relaxation> relaxation, const Eigen::VectorXd& design,
         const Solver& solver, const ReachOptions& options)
      : reach_(task, relaxation, options.samples), solver_(solver), options_(options) {
    const DesignSpace& designs = task.designs;
    const Eigen::Index k = designs.size();
    require(design.size() == k, "the number of entries of the design", design.size(), std::to_string(k));
    require(design.allFinite(), "an entry of the design", "not finite", "finite");
    lower_ = filled(designs.lower(), k, -infinity);
    upper_ = filled(designs.upper(), k, infinity);
    z_ = Eigen::VectorXd::Zero(k + 2);
    z_.head(k) = design.cwiseMax(lower_).cwiseMin(upper_);
    problem_lower_ = Eigen::VectorXd::Zero(k + 2);
    problem_upper_ = Eigen::VectorXd::Zero(k + 2);
    problem_lower_.head(k) = lower_;
    problem_upper_.head(k) = upper_;
    if (relaxation) problem_upper_[k] = largest_amount(task, *relaxation);
    if (reach_.gives_way(RelaxationKind::bounds)) {
      for (const Eigen::Index j : joint_variables(designs)) {
        problem_lower_[j] = -infinity;
        problem_upper_[j] = infinity;
        if (std::isfinite(lower_[j])) moving_bounds_.push_back({j, -1.0});
        if (std::isfinite(upper_[j])) moving_bounds_.push_back({j, 1.0});
      }
    }
  }

  const Reach& reach() const { return reach_; }
  const Eigen::VectorXd& z() const { return z_; }
  double largest() const { return largest_; }
  const std::vector<ReachPeak>& peaks() const { return peaks_; }
  const SearchCost& cost() const { return cost_; }
  double lower(Eigen::Index j) const { return lower_[j]; }
  double upper(Eigen::Index j) const { return upper_[j]; }

  /// Goes on from z. The best point, by the largest value of a limit, is kept; towards the least amount, the last.
  void run(Goal goal, double enough) {
    const Eigen::Index k = reach_.design_size();
    const bool lowering = goal == Goal::least_largest;
    look();
    if (lowering && largest_ <= enough + options_.tolerance) return;
    problem_lower_[k + 1] = lowering ? enough : 0.0;
    problem_upper_[k + 1] = lowering ? infinity : 0.0;
    z_[k + 1] = lowering ? std::max(largest_, enough) : 0.0;
    Eigen::VectorXd best = z_;
    double lowest = largest_;
    members_.clear();
    join(-infinity);
    for (int round = 0; round < options_.max_rounds; ++round) {
      const Eigen::VectorXd before = z_;
      Options options;
      options.feasibility_tolerance = 0.5 * options_.tolerance;
      options.max_function_evaluations = 1000;
      options.record_history = false;
      // Whether the rows are enough is looked at here, from the peaks.
      options.check_stationarity = false;
      options.stop = options_.stop;
      const Result result = solver_.minimize(problem(lowering ? k + 1 : k), z_, options);
      cost_.evaluations += result.counts.function_evaluations();
      ++cost_.rounds;
      cost_.rows = std::max(cost_.rows, members_.size());
      z_ = result.x;
      look();
      if (lowering && largest_ < lowest) {
        lowest = largest_;
        best = z_;
      }
      const double level = z_[k + 1];
      // Where no limit binds at an amount, less of it may do: the solver has stopped early, and goes on from there.
      const bool least = lowering || largest_ >= level - options_.tolerance || z_ == before;
      if (largest_ <= level + options_.tolerance && least) break;
      leave(level);
      const bool joined = join(level);
      if (!joined && z_ == before) break;
      // Not at the edge of what the rows allow, where a small step ends SLSQP.
      if (lowering) z_[k + 1] = largest_ + 1e3 * options_.tolerance;
      if (result.status == Status::stopped) break;
    }
    if (lowering && largest_ > lowest) {
      z_ = best;
      look();
    }
  }

 private:
  struct MovingBound {
    Eigen::Index variable;
    double sign;  ///< 1 of an upper bound, -1 of a lower one
  };

  /// Peaks and largest value at z.
  void look() {
    Reach::AtPoint at(reach_, z_);
    peaks_ = at.peaks(-infinity);
    largest_ = -infinity;
    for (const ReachPeak& peak : peaks_) largest_ = std::max(largest_, peak.value);
  }

  /// The highest peaks above the level become rows, at most a small multiple of the variables at a time. Returns
  /// whether the set has changed.
  bool join(double level) {
    // As long as q lies inside, points of the outline would keep it there: they push it away, back inside.
    const auto keeps_inside = [this](const Row& row) {
      const Reach::Family& family = reach_.families()[row.family];
      if (family.hole || family.limit.kind != LimitKind::minimum_length) return false;
      return std::any_of(peaks_.begin(), peaks_.end(), [&](const ReachPeak& peak) {
        const Reach::Family& other = reach_.families()[peak.row.family];
        return other.hole && other.leg == family.leg && other.range == family.range;
      });
    };
    std::erase_if(members_, [&](const Member& member) { return keeps_inside(member.row); });
    std::vector<ReachPeak> candidates;
    for (const ReachPeak& peak : peaks_) {
      if (keeps_inside(peak.row)) continue;
      if (peak.value > level + 0.5 * options_.tolerance) candidates.push_back(peak);
    }
    std::sort(candidates.begin(), candidates.end(), [](const ReachPeak& a, const ReachPeak& b) {
      if (a.value != b.value) return a.value > b.value;
      return std::pair(a.row.family, a.row.direction) < std::pair(b.row.family, b.row.direction);
    });
    const auto most = 2 * static_cast<std::size_t>(z_.size());
    if (candidates.size() > most) candidates.resize(most);
    bool changed = false;
    for (const ReachPeak& peak : candidates) {
      // Rows nearer than this to each other are nearly parallel, which solvers do not like.
      constexpr double same = 1e-3;
      const auto near = std::find_if(members_.begin(), members_.end(), [&](const Member& member) {
        return member.row.family == peak.row.family &&
               std::abs(std::remainder(member.row.direction - peak.row.direction, full_turn)) < same;
      });
      if (near != members_.end()) {
        changed = changed || near->row.direction != peak.row.direction;
        near->row = peak.row;
        near->slack_rounds = 0;
        continue;
      }
      changed = true;
      const bool returned = std::any_of(left_.begin(), left_.end(), [&](const Row& row) {
        return row.family == peak.row.family &&
               std::abs(std::remainder(row.direction - peak.row.direction, full_turn)) < 10.0 * same;
      });
      members_.push_back({peak.row, 0, returned});
    }
    return changed;
  }

  /// Rows that have been slack for some rounds leave.
  void leave(double level) {
    constexpr int patience = 3;
    Reach::AtPoint at(reach_, z_);
    std::erase_if(members_, [&](Member& member) {
      const double value = at.value(reach_.families()[member.row.family], member.row.direction);
      member.slack_rounds = value < level - 100.0 * options_.tolerance ? member.slack_rounds + 1 : 0;
      if (member.returned || member.slack_rounds < patience) return false;
      left_.push_back(member.row);
      return true;
    });
  }

  Problem problem(Eigen::Index objective) const {
    const Eigen::Index k = reach_.design_size();
    Problem problem;
    problem.name = reach_.task().prescribed.name() + ", working set";
    problem.n = k + 2;
    problem.lower = problem_lower_;
    problem.upper = problem_upper_;
    problem.objective = [objective](const Eigen::VectorXd& z) { return z[objective]; };
    problem.objective_gradient = [objective](const Eigen::VectorXd&, Eigen::VectorXd& gradient) {
      gradient.setZero();
      gradient[objective] = 1.0;
    };
    problem.inequalities = static_cast<Eigen::Index>(members_.size() + moving_bounds_.size());
    problem.inequality = [this, k](const Eigen::VectorXd& z, Eigen::VectorXd& g) {
      Reach::AtPoint at(reach_, z);
      Eigen::Index i = 0;
      for (const Member& member : members_) {
        g[i++] = at.value(reach_.families()[member.row.family], member.row.direction) - z[k + 1];
      }
      for (const MovingBound& bound : moving_bounds_) {
        const double limit = bound.sign > 0.0 ? upper_[bound.variable] : lower_[bound.variable];
        g[i++] = bound.sign * (z[bound.variable] - limit) - z[k];
      }
    };
    problem.inequality_jacobian = [this, k](const Eigen::VectorXd& z, SparseMatrix& jacobian) {
      Reach::AtPoint at(reach_, z);
      std::vector<double> entries(static_cast<std::size_t>(k + 1));
      jacobian.setZero();
      Eigen::Index i = 0;
      for (const Member& member : members_) {
        const Reach::Family& family = reach_.families()[member.row.family];
        at.gradient(family, member.row.direction, entries.data());
        jacobian.startVec(i);
        std::size_t entry = 0;
        for (const Eigen::Index j : reach_.columns(family.leg)) jacobian.insertBack(i, j) = entries[entry++];
        jacobian.insertBack(i, k) = entries[entry];
        jacobian.insertBack(i, k + 1) = -1.0;
        ++i;
      }
      for (const MovingBound& bound : moving_bounds_) {
        jacobian.startVec(i);
        jacobian.insertBack(i, bound.variable) = bound.sign;
        jacobian.insertBack(i, k) = -1.0;
        ++i;
      }
      jacobian.finalize();
    };
    return problem;
  }

  Reach reach_;
  const Solver& solver_;
  ReachOptions options_;
  Eigen::VectorXd lower_, upper_;  ///< of the designs
  Eigen::VectorXd problem_lower_, problem_upper_;
  std::vector<MovingBound> moving_bounds_;
  Eigen::VectorXd z_;
  std::vector<ReachPeak> peaks_;  ///< at z
  double largest_ = 0.0;          ///< of them
  std::vector<Member> members_;
  std::vector<Row> left_;
  SearchCost cost_;
};

void check(const ReachOptions& options) {
  require(options.samples >= 8, "the number of samples of the outline", options.samples, "at least 8");
  require(options.tolerance > 0.0, "the tolerance", options.tolerance, "positive");
  require(options.max_rounds >= 1, "the limit on rounds", options.max_rounds, "at least 1");
  require(!std::isnan(options.enough), "the value that is enough", options.enough, "a number");
}

}  // namespace

double smallest_minimum_length(const SynthesisTask& task, const Relaxation& relaxation) {
  check(task, relaxation);
  double smallest = infinity;
  if (!gives(relaxation.kind, LimitKind::minimum_length)) return smallest;
  const std::vector<Leg>& legs = task.designs.origin().legs();
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (gives(relaxation, i) && legs[i].length.lower > 0.0) smallest = std::min(smallest, legs[i].length.lower);
  }
  return smallest;
}

double largest_amount(const SynthesisTask& task, const Relaxation& relaxation) {
  check(task, relaxation);
  switch (relaxation.kind) {
    case RelaxationKind::maximum_lengths:
      return infinity;
    case RelaxationKind::lengths:
    case RelaxationKind::minimum_lengths: {
      const double smallest = smallest_minimum_length(task, relaxation);
      if (std::isinf(smallest)) return relaxation.kind == RelaxationKind::lengths ? infinity : 0.0;
      return (1.0 - least_share) * smallest;
    }
    case RelaxationKind::workspace:
      return 1.0 - least_share;
    case RelaxationKind::orientations:
      return task.orientations.size() == 1 && task.orientations.front().is_slice() ? 0.0 : 1.0 - least_share;
    case RelaxationKind::bounds:
      for (const Eigen::Index j : joint_variables(task.designs)) {
        const auto bounded = [j](const Eigen::VectorXd& bound) { return bound.size() != 0 && std::isfinite(bound[j]); };
        if (bounded(task.designs.lower()) || bounded(task.designs.upper())) return infinity;
      }
      return 0.0;
  }
  throw std::invalid_argument("the kind of relaxation is none of those that there are");
}

SynthesisTask relax(const SynthesisTask& task, const Relaxation& relaxation, double amount) {
  const double largest = largest_amount(task, relaxation);
  const bool vanishes =
      relaxation.kind == RelaxationKind::minimum_lengths && amount == smallest_minimum_length(task, relaxation);
  require(amount >= 0.0 && (amount <= largest || vanishes) && std::isfinite(amount), "the amount of the relaxation",
          amount, "finite, at least 0 and at most " + shown(largest));
  SynthesisTask result = task;
  const DesignSpace& designs = task.designs;
  const double share = 1.0 - amount;
  switch (relaxation.kind) {
    case RelaxationKind::lengths:
    case RelaxationKind::maximum_lengths:
    case RelaxationKind::minimum_lengths:
      result.designs = DesignSpace(
          Manipulator(designs.origin().name(), relaxed(designs.origin().legs(), relaxation, amount)), designs.names(),
          designs.joint_map(), designs.length_map(), designs.lower(), designs.upper(), designs.reference());
      break;
    case RelaxationKind::workspace: {
      Placement placement = task.prescribed.placement();
      placement.scale *= share;
      result.prescribed = PrescribedWorkspace(task.prescribed.name(), task.prescribed.shape(), placement);
      break;
    }
    case RelaxationKind::orientations: {
      const double middle = middle_of(task.orientations);
      for (Interval& range : result.orientations) {
        range = {scaled_about(middle, share, range.lower), scaled_about(middle, share, range.upper)};
      }
      break;
    }
    case RelaxationKind::bounds: {
      Eigen::VectorXd lower = filled(designs.lower(), designs.size(), -infinity);
      Eigen::VectorXd upper = filled(designs.upper(), designs.size(), infinity);
      for (const Eigen::Index j : joint_variables(designs)) {
        lower[j] -= amount;
        upper[j] += amount;
      }
      result.designs = DesignSpace(designs.origin(), designs.names(), designs.joint_map(), designs.length_map(), lower,
                                   upper, designs.reference());
      break;
    }
  }
  return result;
}

LeastViolation find_least_violation(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                    const ReachOptions& options) {
  check(options);
  validate(task);
  Search search(task, std::nullopt, design, solver, options);
  search.run(Goal::least_largest, options.enough);
  LeastViolation result;
  const Eigen::Index k = task.designs.size();
  result.design = search.z().head(k);
  Reach::AtPoint at(search.reach(), search.z());
  // What is listed as binding: peaks as high as the largest, to the accuracy of the search.
  constexpr double same_height = 1e-6;
  constexpr double same_part = 1e-4;
  const double close = std::max(same_height, same_part * std::abs(search.largest()));
  std::vector<ReachPeak> peaks = search.peaks();
  std::sort(peaks.begin(), peaks.end(), [](const ReachPeak& a, const ReachPeak& b) { return a.value > b.value; });
  result.largest = -infinity;
  for (const ReachPeak& peak : peaks) {
    const LimitAtPose pose = at.at_pose(peak.row);
    result.largest = std::max(result.largest, pose.value);
    if (peak.value < search.largest() - close) break;
    const bool listed = std::any_of(result.binding.begin(), result.binding.end(),
                                    [&](const LimitAtPose& one) { return one.limit == pose.limit; });
    if (!listed) result.binding.push_back(pose);
  }
  for (Eigen::Index j = 0; j < k; ++j) {
    const double room = same_height * (1.0 + std::abs(result.design[j]));
    if (result.design[j] <= search.lower(j) + room || result.design[j] >= search.upper(j) - room) {
      result.binding_bounds.push_back(j);
    }
  }
  result.cost = search.cost();
  return result;
}

LeastRelaxation find_least_relaxation(const SynthesisTask& task, const Relaxation& relaxation,
                                      const Eigen::VectorXd& design, const Solver& solver,
                                      const ReachOptions& options) {
  check(options);
  LeastRelaxation result;
  result.design = design;
  if (largest_amount(task, relaxation) == 0.0) return result;
  Search search(task, relaxation, design, solver, options);
  search.run(Goal::least_largest, 0.0);
  if (search.largest() <= options.tolerance) search.run(Goal::least_amount, 0.0);
  const Eigen::Index k = task.designs.size();
  result.design = search.z().head(k);
  result.amount = search.z()[k];
  result.largest = search.largest();
  result.found = result.largest <= options.tolerance;
  result.cost = search.cost();
  return result;
}

}  // namespace reprise
