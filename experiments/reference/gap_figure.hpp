#pragma once

#include "reprise/io/figure.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

/// Of every problem and source (a) what f is above or below the reference, (b) the residual of the optimality
/// conditions.
Figure draw_gaps(const Table& designs);

}  // namespace reprise::experiments
