#pragma once

// The whole library: dimensional synthesis.

#include "reprise/synthesis/area_formulation.hpp"
#include "reprise/synthesis/area_measure.hpp"
#include "reprise/synthesis/assessment.hpp"
#include "reprise/synthesis/constraint_functions.hpp"
#include "reprise/synthesis/design_space.hpp"
#include "reprise/synthesis/optimality_certificate.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/synthesis/relaxation.hpp"
#include "reprise/synthesis/semi_infinite.hpp"
#include "reprise/synthesis/synthesis_task.hpp"
