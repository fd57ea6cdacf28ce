#include "reprise/synthesis/pointwise_formulation.hpp"

#include <algorithm>
#include <memory>

#include "reprise/base/constants.hpp"

namespace reprise {

SingularitySide prevailing_side(const SynthesisTask& task, const Eigen::VectorXd& design, int points) {
  validate(task);
  if (task.designs.legs() > 3) return SingularitySide::either;
  const Manipulator manipulator = task.designs.manipulator(design);
  int sum = 0;
  for (const Eigen::Vector2d& position : task.prescribed.points(points)) {
    for (const OrientationRange& range : task.orientations) {
      for (const double phi : range.ends()) sum += singularity_side(manipulator, {position, phi});
    }
  }
  return sum < 0 ? SingularitySide::negative : SingularitySide::positive;
}

std::vector<ConstraintRow> pointwise_rows(const ConstraintFunctions& functions, int points) {
  const SynthesisTask& task = functions.task();
  std::vector<ConstraintRow> rows;
  const std::vector<Eigen::Vector2d> positions = task.prescribed.points(points);
  for (std::size_t range = 0; range < task.orientations.size(); ++range) {
    for (const Eigen::Vector2d& position : positions) {
      for (std::size_t family = 0; family < functions.families().size(); ++family) {
        if (functions.families()[family].range == range) rows.push_back({family, position});
      }
    }
  }
  return rows;
}

Problem pointwise_problem(const SynthesisTask& task, const PointwiseOptions& options) {
  const auto functions = std::make_shared<const ConstraintFunctions>(task, options.side);
  return make_problem(functions, pointwise_rows(*functions, options.points));
}

Eigen::VectorXd pointwise_start(const SynthesisTask& task, const Eigen::VectorXd& design,
                                const PointwiseOptions& options) {
  const ConstraintFunctions functions(task, options.side);
  ConstraintFunctions::AtDesign at(functions, design);
  double smallest = infinity;
  for (const Eigen::Vector2d& position : task.prescribed.points(options.points)) {
    for (std::size_t family = 0; family < functions.families().size(); ++family) {
      if (functions.is_conditioning(family)) smallest = std::min(smallest, -at.value(family, position));
    }
  }
  Eigen::VectorXd start(design.size() + 1);
  start << design, smallest;
  return start;
}

}  // namespace reprise
