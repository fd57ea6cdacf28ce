#pragma once

// All designs that are better than a value, enclosed: whether the best design is the only one of its worth.
//
// Boxes of designs are left out as in global_optimum.hpp, and split until they are small. Every design of the thesis's
// family with this sign of r that reaches the workspace and has a smallest kappa^-1 above the value lies in a box that
// is left, or is the image of one that does: legs 1 and 2 exchanged, or mirrored where the task allows it. A box that
// is left may hold no such design: what is proved is that there is none outside.

#include <optional>
#include <vector>

#include "reprise/bounds/global_optimum.hpp"

namespace reprise {

/// How to search.
struct GoodDesignsOptions {
  int side = 1;                                  ///< the sign of r, 1 or -1
  BaseJoints base_joints = BaseJoints::in_line;  ///< the family
  double resolution = 0.01;                      ///< no side of a box that is left is longer, a length; at least 1e-6
  long max_boxes = 1'000'000;                    ///< limit on boxes that are examined, at least 1
  long threads = 1;                              ///< at least 1; the result does not depend on it
  /// The sizes |r| that are searched, as in GlobalOptions. The value must not be below the bound of kappa^-1 outside.
  std::optional<Interval> sizes = std::nullopt;
  /// The proof that prove_global_optimum made for the same task, side, family and sizes: what it leaves out with a
  /// bound that is not above the value is not examined again. None: the search begins with the root box.
  const BoundCertificate* proof = nullptr;
};

/// A box that may hold good designs.
struct GoodBox {
  std::vector<Interval> variables;  ///< of z, as in certificates (bound_certificate.hpp)
  std::vector<Interval> design;     ///< the smallest box of d around it
  std::size_t group = 0;            ///< boxes that touch each other are of one group
};

/// All designs that may be better than the value.
struct GoodDesigns {
  bool complete = false;       ///< false: max_boxes came first, and nothing is proved
  std::vector<GoodBox> boxes;  ///< that are left, group by group
  /// Of every group the smallest box of d around it. Two designs of different groups are not joined by any way along
  /// which all designs are better than the value.
  std::vector<std::vector<Interval>> hulls;
  long examined = 0;  ///< boxes
};

/// Encloses the designs with a smallest kappa^-1 above `value`, in (0, 1). Throws std::invalid_argument as
/// prove_global_optimum, and for a value or option that is out of its range.
GoodDesigns enclose_good_designs(const SynthesisTask& task, double value, const GoodDesignsOptions& options = {});

}  // namespace reprise
