#pragma once

// The check of the tracing options, shared by all that traces.

#include "reprise/workspace/trace.hpp"

namespace reprise {

/// Throws std::invalid_argument when an option is out of its range.
void validate(const TraceOptions& options);

}  // namespace reprise
