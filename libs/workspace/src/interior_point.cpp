#include "reprise/workspace/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "reprise/base/require.hpp"
#include "reprise/workspace/limit_evaluator.hpp"

namespace reprise {
namespace {

struct Cell {
  Eigen::AlignedBox2d box;
  double bound;  ///< no point of the cell has a greater clearance

  bool operator<(const Cell& other) const { return bound < other.bound; }
};

}  // namespace

InteriorPoint find_interior_point(const Limits& limits, const InteriorOptions& options) {
  const double lipschitz = limits.lipschitz_constant();
  require(options.quality > 0.0 && options.quality < 1.0, "quality", options.quality, "between 0 and 1");
  require(options.resolution > 0.0, "resolution", options.resolution, "positive");
  require(options.max_evaluations > 0, "max_evaluations", options.max_evaluations, "positive");
  require(std::isfinite(lipschitz), "lipschitz_constant of the limits", lipschitz, "finite for a certified search");

  InteriorPoint result;
  const Eigen::AlignedBox2d box = limits.box();
  if (box.isEmpty()) {
    result.status = InteriorStatus::empty;
    return result;
  }
  LimitEvaluator evaluator(limits);
  const double resolution = options.resolution * box.diagonal().norm();
  std::priority_queue<Cell> cells;
  const auto add = [&](const Eigen::AlignedBox2d& part) {
    const Eigen::Vector2d centre = part.center();
    const double clearance = -evaluator.largest(centre);
    if (evaluator.evaluations() == 1 || clearance > result.clearance) {
      result.clearance = clearance;
      result.position = centre;
    }
    cells.push({part, clearance + 0.5 * lipschitz * part.diagonal().norm()});
  };
  add(box);
  while (true) {
    const Cell cell = cells.top();
    cells.pop();
    result.clearance_bound = std::max(cell.bound, result.clearance);
    result.evaluations = evaluator.evaluations();
    if (result.clearance > 0.0 && result.clearance >= options.quality * result.clearance_bound) {
      result.status = InteriorStatus::found;
      return result;
    }
    if (result.clearance_bound <= resolution) {
      result.status = result.clearance > 0.0 ? InteriorStatus::found : InteriorStatus::empty;
      return result;
    }
    if (evaluator.evaluations() + 2 > options.max_evaluations) {
      result.status = result.clearance > 0.0 ? InteriorStatus::found : InteriorStatus::undecided;
      return result;
    }
    Eigen::Index longest = 0;
    cell.box.sizes().maxCoeff(&longest);
    Eigen::AlignedBox2d low = cell.box;
    Eigen::AlignedBox2d high = cell.box;
    low.max()[longest] = high.min()[longest] = cell.box.center()[longest];
    add(low);
    add(high);
  }
}

}  // namespace reprise
