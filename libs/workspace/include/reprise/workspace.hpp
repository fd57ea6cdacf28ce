#pragma once

// The whole library: workspaces, exact and by the chord method.

#include "reprise/workspace/complete_trace.hpp"
#include "reprise/workspace/dextrous_boundary.hpp"
#include "reprise/workspace/dextrous_derivatives.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/interior_point.hpp"
#include "reprise/workspace/limit_evaluator.hpp"
#include "reprise/workspace/limits.hpp"
#include "reprise/workspace/multi_level.hpp"
#include "reprise/workspace/orientation_solver.hpp"
#include "reprise/workspace/orientation_workspace.hpp"
#include "reprise/workspace/point_solver.hpp"
#include "reprise/workspace/region_singularity.hpp"
#include "reprise/workspace/region_vertices.hpp"
#include "reprise/workspace/trace.hpp"
