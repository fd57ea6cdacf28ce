#pragma once

// A local search for a good design, from one in a box that may hold the best: a linear program at a time.

#include "design_peaks.hpp"

namespace reprise::rigorous {

struct LocalDesign {
  Variables<double> z;
  double squared_condition;  ///< largest kappa^2 at peaks along the outline
  double violation;          ///< largest violation of a limit there, in squares of lengths; 0 when none

  /// What is minimised: kappa^2 and a penalty on the violation.
  double merit() const;
};

/// Minimises the largest kappa^2 plus a penalty on the largest violation, linearised at their peaks within a trust
/// region. A vertex is reached within rounding, another optimum to a few digits.
LocalDesign ascend(const DesignFamily& family, const DesignPeaks& peaks, const Variables<double>& start);

}  // namespace reprise::rigorous
