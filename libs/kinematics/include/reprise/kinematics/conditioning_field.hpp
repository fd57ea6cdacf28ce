#pragma once

// kappa^-1 (conditioning.hpp) at many positions at once, for maps and dense samples.

#include <Eigen/Core>

#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// kappa^-1 at the positions (x_i, y_i) and one orientation (radians), to the last bit as kappa_inverse at each of
/// these poses, but several at a time, as many as the processor multiplies at once. Allocates nothing for two and three
/// legs. Throws as kappa_inverse, and std::invalid_argument when `y` or `values` are not as long as `x`.
void kappa_inverse_at(const Manipulator& manipulator, double orientation, const Eigen::Ref<const Eigen::ArrayXd>& x,
                      const Eigen::Ref<const Eigen::ArrayXd>& y, const Conditioning& conditioning,
                      Eigen::Ref<Eigen::ArrayXd> values);

}  // namespace reprise
