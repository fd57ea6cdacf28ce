#pragma once

namespace reprise::app {

/// Below this smallest singular value of the Jacobian, as a part of the largest, a pose counts as singular.
inline constexpr double singular_ratio = 1e-12;

}  // namespace reprise::app
