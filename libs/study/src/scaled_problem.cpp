#include "reprise/study/scaled_problem.hpp"

#include <algorithm>

namespace reprise {

namespace {

double unit_of(const ManipulatorInput& input) {
  if (input.conditioning.normalisation == Normalisation::printed) return 1.0;
  double longest = 0.0;
  for (const Leg& leg : input.manipulator.legs()) longest = std::max(longest, leg.length.upper);
  return longest / 2.0;
}

}  // namespace

ScaledProblem scale(const ProblemInput& problem) {
  const double unit = unit_of(problem.start);
  const DesignSpace& designs = problem.task.designs;
  std::vector<Leg> legs = designs.origin().legs();
  for (Leg& leg : legs) {
    leg.base_joint /= unit;
    leg.platform_joint /= unit;
    leg.length = {leg.length.lower / unit, leg.length.upper / unit};
  }
  const PrescribedWorkspace& prescribed = problem.task.prescribed;
  Placement placement = prescribed.placement();
  placement.centre /= unit;
  placement.scale /= unit;
  Conditioning conditioning = problem.task.conditioning;
  if (conditioning.characteristic_length) *conditioning.characteristic_length /= unit;
  return {unit,
          {PrescribedWorkspace(prescribed.name(), prescribed.shape(), placement), problem.task.orientations,
           DesignSpace(Manipulator(designs.origin().name(), legs), designs.names(), designs.joint_map(),
                       designs.length_map(), designs.lower() / unit, designs.upper() / unit, problem.design / unit),
           conditioning},
          problem.design / unit,
          problem.task};
}

}  // namespace reprise
