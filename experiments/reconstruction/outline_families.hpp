#pragma once

// The families of outlines that are tried for P1 to P3, about O' and before the division by the factors of the tables.

#include <string>
#include <vector>

#include "reconstruction/outline_fit.hpp"

namespace reprise::experiments {

/// The family that examples/P1.toml to P3.toml uses for P1, P2 or P3 (a superellipse for the ellipse P2, so that
/// its exponent is left to the fit). Throws std::runtime_error for another name.
OutlineFamily main_family(const std::string& workspace);

/// Others that come about as close. May be empty.
std::vector<OutlineFamily> other_families(const std::string& workspace);

/// The parameters of the main family in an outline of that kind; empty when the shape is of another.
Eigen::VectorXd main_parameters(const Shape& shape);

}  // namespace reprise::experiments
