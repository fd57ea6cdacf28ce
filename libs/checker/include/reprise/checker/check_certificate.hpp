#pragma once

// Checks a proof that no design of the thesis's family is better than a bound, apart from the program that made it.
//
// The proof is a tree of boxes of designs, in the text format that bound_certificate.hpp describes. What is checked:
//   - the root box holds all designs that can be better than the bound, one sign of r;
//   - the lines are a whole tree, and no more;
//   - what each leaf says is true all over its box.
// All of it is done in interval arithmetic of its own, whose every operation moves its result outwards to the next
// number, with formulas written down a second time. Of the rest of Reprise it uses the statement of the problem only.
// The poses of a certificate are on the outline of the prescribed workspace. A design whose leg with a least length
// leaves a hole inside that does not touch the outline is not left out for it: the bound holds for more designs than it
// must, so it is sound, and may be larger than need be.
//
// It rests on the rounding of IEEE 754, and on sine, cosine and power of the C library being within four units in the
// last place.

#include <string>
#include <string_view>
#include <vector>

#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// What a certificate is to prove.
struct BoundClaim {
  int side = 1;                ///< the sign of r
  double bound = 1.0;          ///< no design has a larger kappa^-1 over the workspace and reaches all of it
  std::vector<Interval> root;  ///< [q_1, q_2, q_3, y, r], or with y_1, y_2, y_3 for base joints anywhere
};

/// What came of it.
struct CheckResult {
  bool proved = false;  ///< whether the tree proves the claim
  std::string failure;  ///< what is wrong, one sentence; empty where it is proved
  long lines = 0;       ///< read
  long leaves = 0;      ///< checked
};

/// Checks a tree. A malformed text is a failure like any other; nothing is thrown for it. Throws std::invalid_argument
/// for a task whose designs are not those of the thesis's family: d = [x_C, y_C, x_D, x_E, r] without bounds, base
/// joints (x_C, y_C), (x_D, y_C), (x_E, y_C), platform joints (-r, 0), (-r, 0), (r, 0), and limits of lengths only,
/// which do not depend on d. A claim with seven variables is about the same platforms and limits, with base joints
/// anywhere.
CheckResult check_certificate(const SynthesisTask& task, const BoundClaim& claim, std::string_view tree);

}  // namespace reprise
