#pragma once

// The whole library: what is proved with interval arithmetic.

#include "reprise/bounds/bound_certificate.hpp"
#include "reprise/bounds/design_proof.hpp"
#include "reprise/bounds/enclosure.hpp"
#include "reprise/bounds/global_optimum.hpp"
#include "reprise/bounds/good_designs.hpp"
#include "reprise/bounds/whole_region.hpp"
#include "reprise/bounds/workspace_enclosure.hpp"
