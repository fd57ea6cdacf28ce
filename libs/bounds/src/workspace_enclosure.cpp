#include "reprise/bounds/workspace_enclosure.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>
#include <vector>

#include "pose_function.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"

namespace reprise {
namespace {

using rigorous::Enclosure;
using rigorous::FirstOrderBounds;
using rigorous::Margin;
using rigorous::Poses;

struct PositionCell {
  Interval x;
  Interval y;
  double lower;                     ///< bound of the function's values
  long number;                      ///< cells of equal bounds are taken in the order in which they were made
  std::vector<std::size_t> limits;  ///< that may be violated in the cell
};

struct LaterPositions {
  bool operator()(const PositionCell& a, const PositionCell& b) const {
    return a.lower != b.lower ? a.lower > b.lower : a.number > b.number;
  }
};

/// Whether bounds of values and slopes along the position are numbers.
bool bounded(const FirstOrderBounds& f) {
  return std::isfinite(f.x.lower()) && std::isfinite(f.x.upper()) && std::isfinite(f.y.lower()) &&
         std::isfinite(f.y.upper());
}

Eigen::Vector2d middle_slope(const FirstOrderBounds& f) { return {median(f.x), median(f.y)}; }

class WorkspaceSearch {
 public:
  WorkspaceSearch(const Manipulator& manipulator, double orientation, double allowance,
                  const Conditioning& conditioning, const EnclosureOptions& options)
      : function_(manipulator, conditioning), orientation_(orientation), allowance_(allowance), options_(options) {
    for (const Limit& limit : list_limits(manipulator)) margins_.emplace_back(manipulator.leg(limit.leg), limit.kind);
    const Eigen::AlignedBox2d box = ConstantOrientationLimits(manipulator, orientation).box();
    if (box.isEmpty()) return;
    // The box is rounded, and so may leave out a little of the workspace.
    const double more = 1e-9 * (box.diagonal().norm() + box.center().cwiseAbs().maxCoeff());
    std::vector<std::size_t> all(margins_.size());
    std::iota(all.begin(), all.end(), 0U);
    cells_.push({{box.min().x() - more, box.max().x() + more},
                 {box.min().y() - more, box.max().y() + more},
                 -infinity,
                 0,
                 std::move(all)});
  }

  MinimumEnclosure run(std::span<const Eigen::Vector2d> candidates) {
    for (const Eigen::Vector2d& candidate : candidates) look_at(candidate);
    while (true) {
      result_.lower =
          std::min({cells_.empty() ? result_.upper : std::max(cells_.top().lower, 0.0), leftover_, result_.upper});
      const bool nothing_left = result_.lower >= result_.upper;
      result_.reached = nothing_left || (result_.witness && result_.upper - result_.lower <= options_.tolerance);
      if (result_.reached || cells_.empty() || result_.evaluations >= options_.max_evaluations) return result_;
      PositionCell cell = cells_.top();
      cells_.pop();
      examine(cell);
    }
  }

 private:
  Poses poses(const Enclosure& x, const Enclosure& y) const { return {x, y, Enclosure(orientation_)}; }

  /// The function at a position, which may be the smallest value found so far.
  Enclosure look_at(const Eigen::Vector2d& u) {
    const Poses here = poses(Enclosure(u.x()), Enclosure(u.y()));
    ++result_.evaluations;
    const Enclosure value = function_.value(here);
    const bool smaller = value.upper() < result_.upper;
    if (smaller && std::all_of(margins_.begin(), margins_.end(),
                               [&](const Margin& margin) { return margin.value(here).lower() >= -allowance_; })) {
      result_.upper = value.upper();
      result_.witness = Pose{u, orientation_};
    }
    return value;
  }

  void examine(PositionCell& cell) {
    const Poses box = poses(rigorous::to_enclosure(cell.x), rigorous::to_enclosure(cell.y));
    slopes_.clear();
    std::size_t kept = 0;
    for (const std::size_t limit : cell.limits) {
      const FirstOrderBounds margin = margins_[limit].first_order(box);
      if (margin.value.upper() < 0.0) return;
      if (margin.value.lower() > 0.0) continue;
      cell.limits[kept++] = limit;
      slopes_.push_back(margin);
    }
    cell.limits.resize(kept);
    ++result_.evaluations;
    const FirstOrderBounds f = function_.first_order(box);
    cell.lower = std::max(cell.lower, f.value.lower());
    if (cell.lower >= result_.upper) return;
    if (bounded(f)) {
      const bool slopes = rigorous::nonzero(f.x) || rigorous::nonzero(f.y);
      if (cell.limits.empty() && slopes) return;
      bound_by_lagrangian(cell, f);
      if (cell.lower >= result_.upper) return;
    }
    split(cell, f);
  }

  /// Mean value forms of f + sum lambda_j h_j, for no factor, for one and for each pair of a few limits.
  void bound_by_lagrangian(PositionCell& cell, const FirstOrderBounds& f) {
    const Eigen::Vector2d centre(std::midpoint(cell.x.lower, cell.x.upper), std::midpoint(cell.y.lower, cell.y.upper));
    const Poses at = poses(Enclosure(centre.x()), Enclosure(centre.y()));
    const Enclosure dx = rigorous::to_enclosure(cell.x) - centre.x();
    const Enclosure dy = rigorous::to_enclosure(cell.y) - centre.y();
    const Enclosure value = look_at(centre);
    cell.lower = std::max(cell.lower, (value + f.x * dx + f.y * dy).lower());
    constexpr std::size_t few = 6;
    if (slopes_.size() > few) return;
    std::array<Enclosure, few> margin;
    for (std::size_t j = 0; j < slopes_.size(); ++j) {
      if (!bounded(slopes_[j])) return;
      margin[j] = margins_[cell.limits[j]].value(at);
    }
    const Eigen::Vector2d slope = middle_slope(f);
    for (std::size_t j = 0; j < slopes_.size(); ++j) {
      const FirstOrderBounds& first = slopes_[j];
      const Eigen::Vector2d a = middle_slope(first);
      const double one = slope.dot(a) / a.squaredNorm();
      if (one > 0.0 && std::isfinite(one)) {
        const Enclosure factor(one);
        const Enclosure bound =
            value - factor * margin[j] + (f.x - factor * first.x) * dx + (f.y - factor * first.y) * dy;
        cell.lower = std::max(cell.lower, bound.lower());
      }
      for (std::size_t k = 0; k < j; ++k) {
        const FirstOrderBounds& second = slopes_[k];
        Eigen::Matrix2d both;
        both << a, middle_slope(second);
        if (both.determinant() == 0.0) continue;
        const Eigen::Vector2d factors = both.inverse() * slope;
        if (!factors.allFinite() || factors.minCoeff() <= 0.0) continue;
        const Enclosure p(factors[0]);
        const Enclosure q(factors[1]);
        const Enclosure bound = value - p * margin[j] - q * margin[k] + (f.x - p * first.x - q * second.x) * dx +
                                (f.y - p * first.y - q * second.y) * dy;
        cell.lower = std::max(cell.lower, bound.lower());
      }
    }
  }

  /// Halves the cell in the coordinate in which the function varies most; where nothing is known, in the longer one.
  void split(const PositionCell& cell, const FirstOrderBounds& f) {
    const double width = cell.x.upper - cell.x.lower;
    const double height = cell.y.upper - cell.y.lower;
    const bool known = bounded(f) && cell.limits.empty();
    const double along_x = known ? norm(f.x) * width : width;
    const double along_y = known ? norm(f.y) * height : height;
    for (const bool in_x : {along_x >= along_y, along_x < along_y}) {
      Interval PositionCell::*side = in_x ? &PositionCell::x : &PositionCell::y;
      const Interval& range = cell.*side;
      const double middle = std::midpoint(range.lower, range.upper);
      if (middle == range.lower || middle == range.upper) continue;
      PositionCell half = cell;
      (half.*side).upper = middle;
      half.number = ++made_;
      cells_.push(half);
      half = cell;
      (half.*side).lower = middle;
      half.number = ++made_;
      cells_.push(std::move(half));
      return;
    }
    leftover_ = std::min(leftover_, std::max(cell.lower, 0.0));
  }

  rigorous::KappaInverse function_;
  double orientation_;
  double allowance_;
  EnclosureOptions options_;
  std::vector<Margin> margins_;
  std::vector<FirstOrderBounds> slopes_;  ///< of the limits that may be violated in the cell at hand
  MinimumEnclosure result_{0.0, infinity, std::nullopt, 0, false};
  std::priority_queue<PositionCell, std::vector<PositionCell>, LaterPositions> cells_;
  long made_ = 0;
  /// The smallest bound of the cells that cannot be split any further.
  double leftover_ = infinity;
};

}  // namespace

MinimumEnclosure enclose_minimum_in_workspace(const Manipulator& manipulator, double orientation, double allowance,
                                              std::span<const Eigen::Vector2d> candidates,
                                              const Conditioning& conditioning, const EnclosureOptions& options) {
  require(allowance >= 0.0 && std::isfinite(allowance), "the allowance", allowance, "finite and at least 0");
  require(options.tolerance > 0.0 && std::isfinite(options.tolerance), "the tolerance", options.tolerance,
          "positive and finite");
  require(options.max_evaluations >= 1, "the limit on evaluations", options.max_evaluations, "at least 1");
  return WorkspaceSearch(manipulator, orientation, allowance, conditioning, options).run(candidates);
}

}  // namespace reprise
