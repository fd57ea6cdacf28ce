#include "outline.hpp"

#include <boost/numeric/interval/constants.hpp>

namespace reprise::rigorous {

Outline::Outline(const PrescribedWorkspace& workspace) : centre_(workspace.centre()) {
  const Placement& placement = workspace.placement();
  const Enclosure rotation(placement.rotation);
  turn_ = {placement.scale * cos(rotation), placement.scale * sin(rotation)};

  const auto add_quarters = [&](double right, double up, double left, double down, double exponent) {
    pieces_.emplace_back(SuperellipticArc{right, up, exponent});
    pieces_.emplace_back(SuperellipticArc{-left, up, exponent});
    pieces_.emplace_back(SuperellipticArc{-left, -down, exponent});
    pieces_.emplace_back(SuperellipticArc{right, -down, exponent});
  };
  const auto add_polygon = [&](const std::vector<Eigen::Vector2d>& vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      pieces_.emplace_back(Segment{vertices[i], vertices[(i + 1) % vertices.size()]});
    }
  };
  const auto visitor = [&](const auto& shape) {
    using Type = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Type, Superellipse>) {
      const Eigen::Vector2d& axes = shape.semi_axes;
      add_quarters(axes.x(), axes.y(), axes.x(), axes.y(), shape.exponent);
    } else if constexpr (std::is_same_v<Type, Ellipse>) {
      const Eigen::Vector2d& axes = shape.semi_axes;
      add_quarters(axes.x(), axes.y(), axes.x(), axes.y(), 2.0);
    } else if constexpr (std::is_same_v<Type, QuarterEllipses>) {
      add_quarters(shape.right, shape.up, shape.left, shape.down, 2.0);
    } else if constexpr (std::is_same_v<Type, Circle>) {
      add_quarters(shape.radius, shape.radius, shape.radius, shape.radius, 2.0);
    } else if constexpr (std::is_same_v<Type, Rectangle>) {
      const double x = shape.width / 2.0;
      const double y = shape.height / 2.0;
      add_polygon({{x, y}, {-x, y}, {-x, -y}, {x, -y}});
    } else if constexpr (std::is_same_v<Type, Polygon>) {
      add_polygon(shape.vertices);
    } else {
      const std::size_t size = shape.angles.size();
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t next = (i + 1) % size;
        Enclosure turn = Enclosure(shape.angles[next]) - shape.angles[i];
        if (next == 0) turn += boost::numeric::interval_lib::pi_twice<Enclosure>();
        pieces_.emplace_back(Spiral{shape.radii[i], shape.radii[next], shape.angles[i], turn});
      }
    }
  };
  std::visit(visitor, workspace.shape());
}

OutlineBounds Outline::bounds(const SuperellipticArc& arc, const Enclosure& t) {
  // The points (1 - t, t) scaled to X^p + Y^p = 1, where X falls and Y grows with t. From X + Y = 1 / M, with M the
  // p-norm of (1 - t, t), follow dX/dt = -Y^(p - 1) / M^2 and dY/dt = X^(p - 1) / M^2.
  const bool elliptic = arc.exponent == 2.0;
  const Enclosure p(arc.exponent);
  const auto p_norm = [&](const Enclosure& x, const Enclosure& y) {
    return elliptic ? sqrt(square(x) + square(y)) : power(power(x, p) + power(y, p), 1.0 / p);
  };
  const auto normalised = [&](double at) -> std::array<Enclosure, 2> {
    const Enclosure x = 1.0 - Enclosure(at);
    const Enclosure y(at);
    const Enclosure norm = p_norm(x, y);
    return {x / norm, y / norm};
  };
  const auto [first_x, first_y] = normalised(t.lower());
  const auto [last_x, last_y] = normalised(t.upper());
  const Enclosure x(std::max(0.0, last_x.lower()), std::min(1.0, first_x.upper()));
  const Enclosure y(std::max(0.0, first_y.lower()), std::min(1.0, last_y.upper()));
  const Enclosure scale = square(x + y);
  const Enclosure x_change = -(elliptic ? y : power(y, p - 1.0)) * scale;
  const Enclosure y_change = (elliptic ? x : power(x, p - 1.0)) * scale;
  return {arc.a * x, arc.b * y, arc.a * x_change, arc.b * y_change};
}

OutlineBounds Outline::bounds(const Segment& segment, const Enclosure& t) {
  const Enclosure x_change = Enclosure(segment.to.x()) - segment.from.x();
  const Enclosure y_change = Enclosure(segment.to.y()) - segment.from.y();
  return {segment.from.x() + t * x_change, segment.from.y() + t * y_change, x_change, y_change};
}

OutlineBounds Outline::bounds(const Spiral& spiral, const Enclosure& t) {
  const Enclosure radius_change = Enclosure(spiral.to_radius) - spiral.from_radius;
  const Enclosure radius = spiral.from_radius + t * radius_change;
  const Enclosure angle = spiral.from_angle + t * spiral.turn;
  const Enclosure cosine = cos(angle);
  const Enclosure sine = sin(angle);
  return {radius * cosine, radius * sine, radius_change * cosine - radius * spiral.turn * sine,
          radius_change * sine + radius * spiral.turn * cosine};
}

OutlineBounds Outline::bounds(std::size_t piece, const Enclosure& t) const {
  const OutlineBounds own = std::visit([&](const auto& shape) { return bounds(shape, t); }, pieces_[piece]);
  const auto& [cosine, sine] = turn_;
  return {cosine * own.x - sine * own.y, sine * own.x + cosine * own.y, cosine * own.x_change - sine * own.y_change,
          sine * own.x_change + cosine * own.y_change};
}

}  // namespace reprise::rigorous
