#include "reprise/workspace/region_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace reprise {

std::vector<RegionVertex> vertices(const Region& region, const Limits& limits) {
  std::vector<RegionVertex> found;
  const Eigen::AlignedBox2d box = limits.box();
  Eigen::VectorXd h(limits.count());
  const auto add = [&](const BoundaryEdge& before, const BoundaryEdge& after) {
    const Eigen::Vector2d& position = after.start;
    const bool known = std::any_of(found.begin(), found.end(),
                                   [&](const RegionVertex& vertex) { return vertex.position == position; });
    if (known) return;
    constexpr double active = 1e-9;
    constexpr double rounding = 1e-13;
    const double tolerance = active * box.diagonal().norm() + rounding * position.cwiseAbs().maxCoeff();
    limits.evaluate(position, h);
    RegionVertex vertex{position, {}};
    for (Eigen::Index j = 0; j < h.size(); ++j) {
      if (j == before.limit || j == after.limit || std::abs(h[j]) <= tolerance) vertex.limits.push_back(j);
    }
    found.push_back(std::move(vertex));
  };
  const auto add_all = [&](const BoundaryLoop& loop) {
    const std::size_t n = loop.edges.size();
    if (n < 2) return;
    for (std::size_t k = 0; k < n; ++k) add(loop.edges[(k + n - 1) % n], loop.edges[k]);
  };
  for (const RegionComponent& component : region.components()) {
    add_all(component.outer);
    for (const BoundaryLoop& hole : component.holes) add_all(hole);
  }
  return found;
}

}  // namespace reprise
