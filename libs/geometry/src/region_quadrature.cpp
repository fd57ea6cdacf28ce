#include "reprise/geometry/region_quadrature.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reprise/base/constants.hpp"

namespace reprise {
namespace {

struct Node {
  double at;
  double weight;
};

/// The Gauss-Legendre rule of ten nodes on [from, to], in increasing order.
std::array<Node, 10> gauss_nodes(double from, double to) {
  using Rule = boost::math::quadrature::gauss<double, 10>;
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  std::array<Node, 10> nodes{};
  for (std::size_t k = 0; k < 5; ++k) {
    const double offset = half * Rule::abscissa()[k];
    const double weight = half * Rule::weights()[k];
    nodes[4 - k] = {middle - offset, weight};
    nodes[5 + k] = {middle + offset, weight};
  }
  return nodes;
}

/// Whether the arc passes the direction at its centre.
bool passes(const BoundaryEdge& arc, double angle) {
  const double turned = arc.sweep < 0.0 ? arc.start_angle - angle : angle - arc.start_angle;
  const double positive = turned - 2.0 * pi * std::floor(turned / (2.0 * pi));
  return positive <= std::abs(arc.sweep);
}

/// Where the line x = const meets an edge.
void append_crossings(const BoundaryEdge& edge, double x, std::vector<double>& ys) {
  if (!edge.is_arc()) {
    const double width = edge.end.x() - edge.start.x();
    const double part = (x - edge.start.x()) / width;
    if (part >= 0.0 && part <= 1.0) ys.push_back(edge.start.y() + part * (edge.end.y() - edge.start.y()));
    return;
  }
  const double along = x - edge.centre.x();
  if (std::abs(along) >= edge.radius) return;
  const double height = std::sqrt(edge.radius * edge.radius - along * along);
  for (const double y : {-height, height}) {
    if (passes(edge, std::atan2(y, along))) ys.push_back(edge.centre.y() + y);
  }
}

std::vector<const BoundaryEdge*> edges_of(const RegionComponent& component) {
  std::vector<const BoundaryEdge*> edges;
  const auto append = [&](const BoundaryLoop& loop) {
    for (const BoundaryEdge& edge : loop.edges) edges.push_back(&edge);
  };
  append(component.outer);
  for (const BoundaryLoop& hole : component.holes) append(hole);
  return edges;
}

/// The x at which the boundary has a vertex or runs along y, in increasing order.
std::vector<double> breakpoints(const std::vector<const BoundaryEdge*>& edges) {
  std::vector<double> xs;
  for (const BoundaryEdge* edge : edges) {
    xs.push_back(edge->start.x());
    xs.push_back(edge->end.x());
    if (!edge->is_arc()) continue;
    if (passes(*edge, 0.0)) xs.push_back(edge->centre.x() + edge->radius);
    if (passes(*edge, pi)) xs.push_back(edge->centre.x() - edge->radius);
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

}  // namespace

std::vector<QuadratureLine> region_quadrature(const Region& region, int panels) {
  if (panels < 1) {
    throw std::invalid_argument("the number of panels is " + std::to_string(panels) + ", but it must be at least 1");
  }
  std::vector<QuadratureLine> lines;
  std::vector<double> ys;
  for (const RegionComponent& component : region.components()) {
    const std::vector<const BoundaryEdge*> edges = edges_of(component);
    const std::vector<double> xs = breakpoints(edges);
    if (xs.empty()) continue;
    // What is narrower than rounding holds no area, and its lines could not be distinguished from its ends.
    const double narrowest = 1e-13 * std::max(std::abs(xs.front()), std::abs(xs.back()));
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      const double middle = 0.5 * (xs[i] + xs[i + 1]);
      const double half = 0.5 * (xs[i + 1] - xs[i]);
      if (half <= narrowest) continue;
      for (int panel = 0; panel < panels; ++panel) {
        for (const Node& t : gauss_nodes(2.0 * panel / panels - 1.0, 2.0 * (panel + 1) / panels - 1.0)) {
          const double x = middle + half * std::sin(0.5 * pi * t.at);
          const double x_weight = t.weight * half * 0.5 * pi * std::cos(0.5 * pi * t.at);
          ys.clear();
          for (const BoundaryEdge* edge : edges) append_crossings(*edge, x, ys);
          std::sort(ys.begin(), ys.end());
          for (std::size_t k = 0; k + 1 < ys.size(); k += 2) {
            const double height = ys[k + 1] - ys[k];
            if (!(height > 0.0)) continue;
            QuadratureLine& line = lines.emplace_back();
            for (int part = 0; part < panels; ++part) {
              for (const Node& y : gauss_nodes(ys[k] + height * part / panels, ys[k] + height * (part + 1) / panels)) {
                line.push_back({{x, y.at}, x_weight * y.weight});
              }
            }
          }
        }
      }
    }
  }
  return lines;
}

}  // namespace reprise
