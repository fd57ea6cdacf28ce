#include "reprise/synthesis/synthesis_task.hpp"

#include <stdexcept>

#include "reprise/workspace/dextrous_limits.hpp"

namespace reprise {

void validate(const SynthesisTask& task) {
  if (task.orientations.empty()) {
    throw std::invalid_argument("the synthesis has 0 ranges of orientations, but at least 1 is needed");
  }
  for (const OrientationRange& range : task.orientations) DextrousLimits(task.designs.origin(), range);
}

}  // namespace reprise
