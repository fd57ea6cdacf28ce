#include "outline_curve.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace reprise::rigorous {
namespace {

/// Cosine and sine of an angle by the tangent of its half.
struct Direction {
  Enclosure cosine;
  Enclosure sine;
};

Direction direction_of(double t) {
  const Enclosure square_of_t = square(Enclosure(t));
  const Enclosure scale = 1.0 + square_of_t;
  return {(1.0 - square_of_t) / scale, 2.0 * Enclosure(t) / scale};
}

}  // namespace

OutlineCurve::OutlineCurve(const PrescribedWorkspace& workspace) : outline_(workspace), centre_(workspace.centre()) {
  const Placement& placement = workspace.placement();
  const bool turned = placement.rotation != 0.0;
  const Enclosure rotation(placement.rotation);
  turn_ = {turned ? placement.scale * cos(rotation) : Enclosure(placement.scale),
           turned ? placement.scale * sin(rotation) : Enclosure(0.0)};
  const auto visitor = [&](const auto& shape) {
    using Type = std::decay_t<decltype(shape)>;
    const auto centred = [&](double a, double b, double exponent) { quadrants_ = Quadrants{{a, b, a, b}, exponent}; };
    if constexpr (std::is_same_v<Type, Superellipse>) {
      centred(shape.semi_axes.x(), shape.semi_axes.y(), shape.exponent);
    } else if constexpr (std::is_same_v<Type, Ellipse>) {
      centred(shape.semi_axes.x(), shape.semi_axes.y(), 2.0);
    } else if constexpr (std::is_same_v<Type, Circle>) {
      centred(shape.radius, shape.radius, 2.0);
    } else if constexpr (std::is_same_v<Type, QuarterEllipses>) {
      quadrants_ = Quadrants{{shape.right, shape.up, shape.left, shape.down}, 2.0};
    }
    const bool rectangle = std::is_same_v<Type, Rectangle> && !turned;
    mirrored_in_x_ = rectangle || (quadrants_ && !turned && quadrants_->semi_axes[0] == quadrants_->semi_axes[2]);
    mirrored_in_y_ = rectangle || (quadrants_ && !turned && quadrants_->semi_axes[1] == quadrants_->semi_axes[3]);
  };
  std::visit(visitor, workspace.shape());
}

EnclosedPosition OutlineCurve::enclose(std::size_t piece, double t) const {
  if (!quadrants_) {
    const OutlineBounds bounds = outline_.bounds(piece, Enclosure(t));
    return {centre_.x() + bounds.x, centre_.y() + bounds.y};
  }
  Direction along = direction_of(t);
  if (quadrants_->exponent != 2.0) {
    const Enclosure exponent = 2.0 / Enclosure(quadrants_->exponent);
    along = {power(along.cosine, exponent), power(along.sine, exponent)};
  }
  const bool odd = piece % 2 == 1;
  const bool right = piece == 0 || piece == 3;
  const bool up = piece < 2;
  const Enclosure across =
      (right ? 1.0 : -1.0) * quadrants_->semi_axes[right ? 0 : 2] * (odd ? along.sine : along.cosine);
  const Enclosure upwards = (up ? 1.0 : -1.0) * quadrants_->semi_axes[up ? 1 : 3] * (odd ? along.cosine : along.sine);
  const auto& [cosine, sine] = turn_;
  return {centre_.x() + (cosine * across - sine * upwards), centre_.y() + (sine * across + cosine * upwards)};
}

std::pair<std::size_t, double> OutlineCurve::split(double sigma) const {
  const auto count = static_cast<double>(pieces());
  const double within = sigma - count * std::floor(sigma / count);
  const double piece = std::min(std::floor(within), count - 1.0);
  return {static_cast<std::size_t>(piece), std::min(within - piece, 1.0)};
}

Eigen::Vector2d OutlineCurve::position(double sigma) const {
  const auto [piece, t] = split(sigma);
  if (!quadrants_) {
    const EnclosedPosition point = enclose(piece, t);
    return {median(point.x), median(point.y)};
  }
  double cosine = (1.0 - t * t) / (1.0 + t * t);
  double sine = 2.0 * t / (1.0 + t * t);
  if (quadrants_->exponent != 2.0) {
    cosine = std::pow(cosine, 2.0 / quadrants_->exponent);
    sine = std::pow(sine, 2.0 / quadrants_->exponent);
  }
  if (piece % 2 == 1) std::swap(cosine, sine);
  const bool right = piece == 0 || piece == 3;
  const bool up = piece < 2;
  const Eigen::Vector2d own{(right ? 1.0 : -1.0) * quadrants_->semi_axes[right ? 0 : 2] * cosine,
                            (up ? 1.0 : -1.0) * quadrants_->semi_axes[up ? 1 : 3] * sine};
  const double along = median(turn_[0]);
  const double across = median(turn_[1]);
  return centre_ + Eigen::Vector2d{along * own.x() - across * own.y(), across * own.x() + along * own.y()};
}

std::vector<double> OutlineCurve::spread(int count) const {
  const auto each = std::max<std::size_t>(1, static_cast<std::size_t>(count) / pieces());
  std::vector<double> parameters;
  for (std::size_t piece = 0; piece < pieces(); ++piece) {
    for (std::size_t k = 0; k < each; ++k) {
      parameters.push_back(static_cast<double>(piece) + static_cast<double>(k) / static_cast<double>(each));
    }
  }
  return parameters;
}

}  // namespace reprise::rigorous
