#pragma once

// Tasks that several tests of the synthesis share.

#include <cmath>
#include <numbers>
#include <vector>

#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise::samples {

/// The leg limits of thesis section 5.6.2.
inline std::array<Interval, 3> thesis_lengths() {
  return {Interval{std::numbers::sqrt2, 2.0}, Interval{std::numbers::sqrt2, 2.0}, Interval{1.0, std::numbers::sqrt3}};
}

/// d^0 of thesis section 5.6.2.
inline Eigen::VectorXd thesis_start() { return to_vector({-1.0, 0.0, 1.0, 2.0, 1.0}); }

/// The prescribed workspace P2 as reconstructed, in the size of Table 5.3.
inline PrescribedWorkspace p2() { return {"P2", Ellipse{{1.75, 1.0}}, {{1.0, 1.5}, 0.2, 0.0}}; }

inline SynthesisTask thesis_task(std::vector<OrientationRange> orientations = slices({0.0})) {
  return {p2(), std::move(orientations), DesignSpace::collinear(thesis_lengths()), {Normalisation::printed, {}}};
}

/// A three-leg manipulator with a triangular platform, base joints out of line and joint-angle limits of both widths.
inline Manipulator general_manipulator() {
  return {"general",
          {Leg{{-1.1, 0.1}, {-0.7, -0.2}, {1.2, 2.2}, Interval{0.2, 2.9}, {}},
           Leg{{1.2, -0.2}, {0.1, 0.6}, {1.1, 2.6}, {}, Interval{-0.5, 3.5}},
           Leg{{2.1, 0.3}, {0.8, -0.1}, {0.7, 1.9}, {}, {}}}};
}

/// A design space around it in which every joint coordinate and both length limits of leg 2 depend on four variables.
inline DesignSpace general_space() {
  const Manipulator origin = general_manipulator();
  Eigen::MatrixXd joint_map(12, 4);
  for (Eigen::Index i = 0; i < 12; ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) joint_map(i, j) = std::cos(1.0 + static_cast<double>(3 * i + 5 * j));
  }
  Eigen::MatrixXd length_map = Eigen::MatrixXd::Zero(6, 4);
  length_map(2, 1) = 0.3;
  length_map(3, 2) = -0.4;
  return {origin, {"a", "b", "c", "d"}, joint_map, length_map};
}

}  // namespace reprise::samples
