#include "trace_options.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reprise/base/require.hpp"

namespace reprise {
namespace {

/// The shortest chord, to the size of the workspace as seen from the origin: that many times longer than rounding.
constexpr double least_chord = 1e-12;

}  // namespace

double size_of(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return 1.0;
  return std::max({box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff(), box.diagonal().norm()});
}

void validate(const TraceOptions& options) {
  require(options.chord > 0.0 && std::isfinite(options.chord), "chord", options.chord, "positive and finite");
  require(options.first_direction.allFinite() && options.first_direction.norm() > 0.0, "first_direction",
          options.first_direction, "finite and not zero");
  require(options.max_points > 0, "max_points", options.max_points, "positive");
  require(options.tolerance >= 1e-15 && options.tolerance <= 1e-3, "tolerance", options.tolerance,
          "between 1e-15 and 1e-3");
}

void require_resolution(const Limits& limits, const TraceOptions& options) {
  const double size = size_of(limits.box());
  if (options.chord >= least_chord * size) return;
  throw std::invalid_argument("chord is " + shown(options.chord) + ", but at the distance " + shown(size) +
                              " from the origin it must be at least " + shown(least_chord * size) +
                              " for points to be told apart");
}

}  // namespace reprise
