#pragma once

// Dimensional synthesis: the design whose worst conditioning over a prescribed workspace is best, among those that
// reach all of it (thesis chapter 5, sections 5.6 to 5.8).
//
//     maximise over d   min over u in W_p and the ends phi of the ranges of  kappa^-1(d, u, phi)
//     subject to        W_p within the dextrous workspace W_c = W^D[phi_min, phi_max] of d, for each range
//
// The orientations are a list of ranges. A range of one orientation is a slice, whose dextrous workspace is the
// constant-orientation workspace W^C[phi]: one slice is the thesis's SO synthesis (5.34), several are its MO synthesis
// (5.37), one wider range is its D synthesis (5.39). Limits hold at every orientation of a range; the conditioning
// counts at its ends, where the thesis expects it to be worst (assess tells whether it is). The minimum over W_p is
// looked for on its outline, as the thesis does. area_formulation.hpp and pointwise_formulation.hpp make an
// optimization problem of it, assessment.hpp judges a design from outside of both.

#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/orientation_range.hpp"
#include "reprise/synthesis/design_space.hpp"

namespace reprise {

/// What is asked for.
struct SynthesisTask {
  PrescribedWorkspace prescribed;  ///< W_p
  std::vector<OrientationRange>
      orientations;           ///< the ranges of phi, radians, each as DextrousLimits takes it; at least one
  DesignSpace designs;        ///< the designs to choose from
  Conditioning conditioning;  ///< how the Jacobian is made comparable
};

/// Throws std::invalid_argument when the task has no range of orientations or one that DextrousLimits does not take.
void validate(const SynthesisTask& task);

}  // namespace reprise
