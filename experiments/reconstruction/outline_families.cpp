#include "reconstruction/outline_families.hpp"

#include <cmath>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise::experiments {

namespace {

/// Outlines without a shape of their own are sampled at so many points.
constexpr int outline_points = 360;

Eigen::VectorXd vector(std::initializer_list<double> entries) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(entries.size()));
  std::copy(entries.begin(), entries.end(), result.begin());
  return result;
}

double turn(int i) { return 2.0 * pi * i / outline_points; }

OutlineFamily superellipse(const Eigen::VectorXd& start) {
  return {"superellipse",
          "|x/a|^n + |y/b|^n = 1",
          {"a", "b", "n"},
          start,
          vector({0.5, 0.5, 1.2}),
          vector({3.0, 3.0, 8.0}),
          [](const Eigen::VectorXd& p) {
            return Superellipse{{p[0], p[1]}, p[2]};
          }};
}

OutlineFamily quarter_ellipses(const Eigen::VectorXd& start) {
  return {"quarter-ellipses",
          "semi-axes right, up, left, down",
          {"right", "up", "left", "down"},
          start,
          vector({0.5, 0.5, 0.05, 0.2}),
          vector({4.0, 4.0, 4.0, 4.0}),
          [](const Eigen::VectorXd& p) {
            return QuarterEllipses{p[0], p[1], p[2], p[3]};
          }};
}

OutlineFamily cosine_series() {
  return {"cosine series",
          "r = c0 + c2 cos 2b + c4 cos 4b",
          {"c0", "c2", "c4"},
          vector({1.358, 0.151, -0.020}),
          vector({1.0, -0.3, -0.15}),
          vector({2.0, 0.3, 0.15}),
          [](const Eigen::VectorXd& p) {
            PolarTable table;
            for (int i = 0; i < outline_points; ++i) {
              const double beta = turn(i);
              table.angles.push_back(beta);
              table.radii.push_back(p[0] + p[1] * std::cos(2.0 * beta) + p[2] * std::cos(4.0 * beta));
            }
            return table;
          }};
}

OutlineFamily stadium() {
  return {
      "stadium",
      "half length h of the straight sides, radius R of the ends",
      {"h", "R"},
      vector({0.33, 1.17}),
      vector({0.01, 0.5}),
      vector({1.0, 2.0}),
      [](const Eigen::VectorXd& p) {
        Polygon polygon;
        for (int i = 0; i < outline_points; ++i) {
          // Half a step on, so that each end has half of the points.
          const Eigen::Vector2d direction = unit(turn(i) + 0.5 * turn(1));
          polygon.vertices.emplace_back(p[1] * direction + Eigen::Vector2d(std::copysign(p[0], direction.x()), 0.0));
        }
        return polygon;
      }};
}

OutlineFamily tilted_superellipse() {
  return {"tilted superellipse",
          "centre (x0, y0), semi-axes a, b, exponent n, tilted by t degrees",
          {"x0", "y0", "a", "b", "n", "t"},
          vector({0.19, 0.42, 1.52, 1.14, 3.15, 62.0}),
          vector({-0.5, -0.5, 0.9, 0.9, 1.8, 0.0}),
          vector({0.5, 0.5, 3.0, 3.0, 8.0, 90.0}),
          [](const Eigen::VectorXd& p) {
            Polygon polygon;
            const Eigen::Vector2d along = unit(p[5] * pi / 180.0);
            for (int i = 0; i < outline_points; ++i) {
              const double cosine = std::cos(turn(i));
              const double sine = std::sin(turn(i));
              const double x = p[2] * std::copysign(std::pow(std::abs(cosine), 2.0 / p[4]), cosine);
              const double y = p[3] * std::copysign(std::pow(std::abs(sine), 2.0 / p[4]), sine);
              polygon.vertices.emplace_back(Eigen::Vector2d(p[0], p[1]) + x * along + y * quarter_turned(along));
            }
            return polygon;
          }};
}

}  // namespace

OutlineFamily main_family(const std::string& workspace) {
  if (workspace == "P1") return superellipse(vector({1.4, 1.2, 2.5}));
  if (workspace == "P2") return superellipse(vector({1.7, 1.0, 2.0}));
  if (workspace == "P3") return quarter_ellipses(vector({2.0, 2.0, 0.3, 1.1}));
  throw std::runtime_error("There is no family of outlines for " + workspace + ".");
}

std::vector<OutlineFamily> other_families(const std::string& workspace) {
  if (workspace == "P1") return {cosine_series(), stadium()};
  if (workspace == "P3") return {tilted_superellipse()};
  return {};
}

Eigen::VectorXd main_parameters(const Shape& shape) {
  if (const auto* one = std::get_if<Superellipse>(&shape)) {
    return vector({one->semi_axes.x(), one->semi_axes.y(), one->exponent});
  }
  if (const auto* one = std::get_if<Ellipse>(&shape)) return vector({one->semi_axes.x(), one->semi_axes.y(), 2.0});
  if (const auto* one = std::get_if<QuarterEllipses>(&shape))
    return vector({one->right, one->up, one->left, one->down});
  return {};
}

}  // namespace reprise::experiments
