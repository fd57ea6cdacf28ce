#include "reprise/geometry/prescribed_workspace.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/geometry/plane.hpp"

namespace reprise {
namespace {

/// The angle of the same direction in [0, 2 pi).
double wrapped(double angle) {
  const double remainder = std::fmod(angle, full_turn);
  const double positive = remainder < 0.0 ? remainder + full_turn : remainder;
  return positive < full_turn ? positive : 0.0;  // a tiny negative remainder rounds up to a full turn
}

class Checker {
 public:
  explicit Checker(const std::string& name) : name_(name) {}

  void require(bool allowed, const std::string& quantity, double value, const char* range) const {
    if (!allowed) reject("prescribed workspace '" + name_ + "': " + quantity, shown(value), range);
  }
  void positive(const char* quantity, double value) const {
    require(value > 0.0 && std::isfinite(value), quantity, value, "positive and finite");
  }

 private:
  const std::string& name_;
};

double superellipse_radius(const Eigen::Vector2d& semi_axes, double exponent, double angle) {
  const double x = std::abs(std::cos(angle)) / semi_axes.x();
  const double y = std::abs(std::sin(angle)) / semi_axes.y();
  // Scaled by the larger term, so that no power overflows.
  const double larger = std::max(x, y);
  return 1.0 / (larger * std::pow(std::pow(x / larger, exponent) + std::pow(y / larger, exponent), 1.0 / exponent));
}

double ellipse_radius(double a, double b, double angle) {
  return 1.0 / std::hypot(std::cos(angle) / a, std::sin(angle) / b);
}

/// A radius with its first two derivatives along the angle.
struct RadiusDerivatives {
  double value;
  double first;
  double second;
};

/// r = F^(-1/p) with F = X^p + Y^p, X = |cos| / a, Y = |sin| / b, and X'' = -X, Y'' = -Y.
RadiusDerivatives superellipse_derivatives(const Eigen::Vector2d& semi_axes, double exponent, double angle) {
  const double x = std::abs(std::cos(angle)) / semi_axes.x();
  const double y = std::abs(std::sin(angle)) / semi_axes.y();
  const double x_change = -std::copysign(std::sin(angle), std::sin(angle) * std::cos(angle)) / semi_axes.x();
  const double y_change = std::copysign(std::cos(angle), std::sin(angle) * std::cos(angle)) / semi_axes.y();
  const double f = std::pow(x, exponent) + std::pow(y, exponent);
  // The first two derivatives of F, over p F.
  const double first = (std::pow(x, exponent - 1.0) * x_change + std::pow(y, exponent - 1.0) * y_change) / f;
  const double second =
      (exponent - 1.0) *
          (std::pow(x, exponent - 2.0) * x_change * x_change + std::pow(y, exponent - 2.0) * y_change * y_change) / f -
      1.0;
  const double radius = std::pow(f, -1.0 / exponent);
  return {radius, -radius * first, radius * ((1.0 + exponent) * first * first - second)};
}

/// Index of the last of the increasing angles that is not beyond the given one; the last of all when none is.
std::size_t sector_of(const std::vector<double>& angles, double angle) {
  const auto after = std::upper_bound(angles.begin(), angles.end(), angle);
  return after == angles.begin() ? angles.size() - 1 : static_cast<std::size_t>(after - angles.begin()) - 1;
}

std::vector<Eigen::Vector2d> rectangle_vertices(const Rectangle& rectangle) {
  const double x = rectangle.width / 2.0;
  const double y = rectangle.height / 2.0;
  return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
}

/// Checks that the vertices go round the origin once, always in the same sense, which is what star-shaped means and
/// leaves no room for crossings; returns them counter-clockwise, from the smallest polar angle on.
std::vector<Eigen::Vector2d> checked_vertices(const Checker& checker, std::vector<Eigen::Vector2d> vertices) {
  checker.require(vertices.size() >= 3, "the number of vertices", static_cast<double>(vertices.size()), "at least 3");
  double winding = 0.0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector2d& from = vertices[i];
    const Eigen::Vector2d& to = vertices[(i + 1) % vertices.size()];
    checker.require(from.allFinite(), "a coordinate of vertex " + std::to_string(i + 1),
                    std::isfinite(from.x()) ? from.y() : from.x(), "finite");
    winding += std::atan2(cross(from, to), from.dot(to));
  }
  if (winding < 0.0) std::reverse(vertices.begin(), vertices.end());
  checker.require(std::abs(std::abs(winding) - full_turn) < 1e-6,
                  "the number of turns its outline makes about the centre", winding / full_turn,
                  "1 or -1: the centre must lie inside a polygon that does not cross itself");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double sense = cross(vertices[i], vertices[(i + 1) % vertices.size()]);
    checker.require(sense > 0.0, "the turn about the centre from one vertex to the next", sense,
                    "positive: the centre must see the whole outline, and no edge may cross another");
  }
  const auto angle = [](const Eigen::Vector2d& v) { return wrapped(std::atan2(v.y(), v.x())); };
  const auto first = std::min_element(vertices.begin(), vertices.end(),
                                      [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  std::rotate(vertices.begin(), first, vertices.end());
  return vertices;
}

}  // namespace

PrescribedWorkspace::PrescribedWorkspace(std::string name, Shape shape, Placement placement)
    : name_(std::move(name)), shape_(std::move(shape)), placement_(std::move(placement)) {
  const Checker checker(name_);
  checker.require(std::isfinite(placement_.centre.x()), "the centre's x", placement_.centre.x(), "finite");
  checker.require(std::isfinite(placement_.centre.y()), "the centre's y", placement_.centre.y(), "finite");
  checker.positive("the scale", placement_.scale);
  checker.require(std::isfinite(placement_.rotation), "the rotation", placement_.rotation, "finite");

  std::vector<double> own_corners;
  if (const auto* superellipse = std::get_if<Superellipse>(&shape_)) {
    checker.positive("the first semi-axis", superellipse->semi_axes.x());
    checker.positive("the second semi-axis", superellipse->semi_axes.y());
    checker.positive("the exponent", superellipse->exponent);
    // Up to exponent 1 the outline has corners on its axes.
    if (superellipse->exponent <= 1.0) {
      own_corners = {0.0, 0.25 * full_turn, 0.5 * full_turn, 0.75 * full_turn};
    }
  } else if (const auto* ellipse = std::get_if<Ellipse>(&shape_)) {
    checker.positive("the first semi-axis", ellipse->semi_axes.x());
    checker.positive("the second semi-axis", ellipse->semi_axes.y());
  } else if (const auto* quarters = std::get_if<QuarterEllipses>(&shape_)) {
    checker.positive("the semi-axis to the right", quarters->right);
    checker.positive("the semi-axis up", quarters->up);
    checker.positive("the semi-axis to the left", quarters->left);
    checker.positive("the semi-axis down", quarters->down);
  } else if (const auto* circle = std::get_if<Circle>(&shape_)) {
    checker.positive("the radius", circle->radius);
  } else if (const auto* rectangle = std::get_if<Rectangle>(&shape_)) {
    checker.positive("the width", rectangle->width);
    checker.positive("the height", rectangle->height);
    vertices_ = checked_vertices(checker, rectangle_vertices(*rectangle));
  } else if (const auto* polygon = std::get_if<Polygon>(&shape_)) {
    vertices_ = checked_vertices(checker, polygon->vertices);
  } else if (const auto* table = std::get_if<PolarTable>(&shape_)) {
    const std::size_t size = table->angles.size();
    checker.require(size >= 3, "the number of angles", static_cast<double>(size), "at least 3");
    checker.require(table->radii.size() == size, "the number of radii", static_cast<double>(table->radii.size()),
                    "the number of angles");
    for (std::size_t i = 0; i < size; ++i) {
      checker.positive("a radius", table->radii[i]);
      const double step = i == 0 ? full_turn : table->angles[i] - table->angles[i - 1];
      checker.require(step > 0.0 && std::isfinite(table->angles[i]), "angle " + std::to_string(i + 1) + " of the table",
                      table->angles[i], "finite and above the one before");
    }
    checker.require(table->angles.back() - table->angles.front() < full_turn, "the span of the angles",
                    table->angles.back() - table->angles.front(), "below a full turn");
    own_corners = table->angles;
  }
  for (const Eigen::Vector2d& vertex : vertices_) {
    vertex_angles_.push_back(wrapped(std::atan2(vertex.y(), vertex.x())));
    own_corners.push_back(vertex_angles_.back());
  }
  for (const double angle : own_corners) corners_.push_back(wrapped(angle + placement_.rotation));
  std::sort(corners_.begin(), corners_.end());
}

double PrescribedWorkspace::radius(double beta) const {
  const double angle = wrapped(beta - placement_.rotation);
  const auto along_edge = [&] {
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const std::size_t i = sector_of(vertex_angles_, angle);
    const Eigen::Vector2d& from = vertices_[i];
    const Eigen::Vector2d edge = vertices_[(i + 1) % vertices_.size()] - from;
    return cross(from, edge) / cross(direction, edge);
  };
  const auto visitor = [&](const auto& shape) -> double {
    using Type = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Type, Superellipse>) {
      return superellipse_radius(shape.semi_axes, shape.exponent, angle);
    } else if constexpr (std::is_same_v<Type, Ellipse>) {
      return ellipse_radius(shape.semi_axes.x(), shape.semi_axes.y(), angle);
    } else if constexpr (std::is_same_v<Type, QuarterEllipses>) {
      return ellipse_radius(std::cos(angle) >= 0.0 ? shape.right : shape.left,
                            std::sin(angle) >= 0.0 ? shape.up : shape.down, angle);
    } else if constexpr (std::is_same_v<Type, Circle>) {
      return shape.radius;
    } else if constexpr (std::is_same_v<Type, PolarTable>) {
      const double first = shape.angles.front();
      const double along = first + wrapped(angle - first);
      const std::size_t i = sector_of(shape.angles, along);
      const bool last = i + 1 == shape.angles.size();
      const double next_angle = last ? first + full_turn : shape.angles[i + 1];
      const double next_radius = last ? shape.radii.front() : shape.radii[i + 1];
      const double fraction = (along - shape.angles[i]) / (next_angle - shape.angles[i]);
      return shape.radii[i] + fraction * (next_radius - shape.radii[i]);
    } else {
      return along_edge();
    }
  };
  return placement_.scale * std::visit(visitor, shape_);
}

Eigen::Vector2d PrescribedWorkspace::point(double beta) const {
  return placement_.centre + radius(beta) * Eigen::Vector2d(std::cos(beta), std::sin(beta));
}

OutlinePoint PrescribedWorkspace::outline(double beta) const {
  const double angle = wrapped(beta - placement_.rotation);
  const auto visitor = [&](const auto& shape) -> RadiusDerivatives {
    using Type = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Type, Superellipse>) {
      return superellipse_derivatives(shape.semi_axes, shape.exponent, angle);
    } else if constexpr (std::is_same_v<Type, Ellipse>) {
      return superellipse_derivatives(shape.semi_axes, 2.0, angle);
    } else if constexpr (std::is_same_v<Type, QuarterEllipses>) {
      const Eigen::Vector2d semi_axes(std::cos(angle) >= 0.0 ? shape.right : shape.left,
                                      std::sin(angle) >= 0.0 ? shape.up : shape.down);
      return superellipse_derivatives(semi_axes, 2.0, angle);
    } else if constexpr (std::is_same_v<Type, Circle>) {
      return {shape.radius, 0.0, 0.0};
    } else if constexpr (std::is_same_v<Type, PolarTable>) {
      const double first = shape.angles.front();
      const std::size_t i = sector_of(shape.angles, first + wrapped(angle - first));
      const std::size_t next = (i + 1) % shape.angles.size();
      const double step = shape.angles[next] - shape.angles[i] + (next == 0 ? full_turn : 0.0);
      return {radius(beta) / placement_.scale, (shape.radii[next] - shape.radii[i]) / step, 0.0};
    } else {
      // r = (from x edge) / (direction x edge), and the direction's second derivative is its opposite.
      const Eigen::Vector2d direction = unit(angle);
      const std::size_t i = sector_of(vertex_angles_, angle);
      const Eigen::Vector2d edge = vertices_[(i + 1) % vertices_.size()] - vertices_[i];
      const double value = cross(vertices_[i], edge) / cross(direction, edge);
      const double relative = -cross(quarter_turned(direction), edge) / cross(direction, edge);
      return {value, value * relative, value * (2.0 * relative * relative + 1.0)};
    }
  };
  const RadiusDerivatives r = std::visit(visitor, shape_);
  const Eigen::Vector2d along = unit(beta);
  const Eigen::Vector2d across = quarter_turned(along);
  return {point(beta), placement_.scale * (r.first * along + r.value * across),
          placement_.scale * ((r.second - r.value) * along + 2.0 * r.first * across)};
}

std::vector<double> PrescribedWorkspace::angles(int count) const {
  if (count < 1) {
    throw std::invalid_argument("the number of outline points is " + std::to_string(count) +
                                ", but it must be at least 1");
  }
  // Steps of the angle so small that the outline is nearly straight along each.
  constexpr int steps_per_point = 16;
  constexpr int fewest_steps = 8192;
  const int steps = std::max(steps_per_point * count, fewest_steps);
  std::vector<Eigen::Vector2d> pieces;
  pieces.reserve(static_cast<std::size_t>(steps));
  double length = 0.0;
  Eigen::Vector2d last = point(0.0);
  for (int k = 1; k <= steps; ++k) {
    const Eigen::Vector2d next = point(full_turn * k / steps);
    pieces.emplace_back(next - last);
    length += pieces.back().norm();
    last = next;
  }
  // An arc of length s that turns by theta is s theta / 8 away from its chord. Along a circle both parts are the same.
  std::vector<double> along{0.0};
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Eigen::Vector2d& piece = pieces[k];
    const Eigen::Vector2d& before = pieces[k == 0 ? pieces.size() - 1 : k - 1];
    const double part = piece.norm() / length;
    const double turn = std::abs(std::atan2(cross(before, piece), before.dot(piece))) / full_turn;
    along.push_back(along.back() + part + std::sqrt(part * turn));
  }
  std::vector<double> all = corners_;
  for (int i = 0; i < count; ++i) {
    const double wanted = along.back() * i / count;
    const auto after = std::upper_bound(along.begin(), along.end(), wanted);
    const auto k = static_cast<std::size_t>(after - along.begin()) - 1;
    const double fraction = (wanted - along[k]) / (along[k + 1] - along[k]);
    all.push_back(full_turn * (static_cast<double>(k) + fraction) / steps);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<Eigen::Vector2d> PrescribedWorkspace::points(int count) const {
  std::vector<Eigen::Vector2d> result;
  for (const double beta : angles(count)) result.push_back(point(beta));
  return result;
}

}  // namespace reprise
