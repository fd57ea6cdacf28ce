#pragma once

// The whole library: plane geometry.

#include "reprise/geometry/hausdorff_distance.hpp"
#include "reprise/geometry/plane.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/geometry/region.hpp"
#include "reprise/geometry/region_distance.hpp"
#include "reprise/geometry/region_quadrature.hpp"
