#pragma once

// Poses as documents have them; apps/reprise/json.md describes the keys.

#include <Eigen/Core>
#include <vector>

#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/study/documents.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise {

/// Below this smallest singular value of the Jacobian, as a part of the largest, a pose counts as singular.
inline constexpr double singular_ratio = 1e-12;

/// The document of `reprise pose`, without its head: the pose at a position and an orientation in degrees.
Json pose_json(const ManipulatorInput& input, const Eigen::Vector2d& position, double orientation_deg);

/// The document of `reprise assemble`, without its head: the modes of the given leg lengths.
Json modes_json(const ManipulatorInput& input, const std::vector<double>& lengths, const AssemblyModes& modes);

}  // namespace reprise
