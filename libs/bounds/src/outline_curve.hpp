#pragma once

// The points of an outline by a piece and a rational parameter, as certificates name them (bound_certificate.hpp).

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "outline.hpp"
#include "reprise/bounds/bound_certificate.hpp"
#include "reprise/geometry/prescribed_workspace.hpp"
#include "rigorous_arithmetic.hpp"

namespace reprise::rigorous {

/// A position that is known within rounding.
struct EnclosedPosition {
  Enclosure x;
  Enclosure y;
};

class OutlineCurve {
 public:
  explicit OutlineCurve(const PrescribedWorkspace& workspace);

  std::size_t pieces() const { return outline_.pieces(); }

  /// The point of a piece at t in [0, 1].
  EnclosedPosition enclose(std::size_t piece, double t) const;

  /// The same in floating point, for a parameter that runs through all pieces, sigma = piece + t, modulo their number.
  Eigen::Vector2d position(double sigma) const;

  /// The piece and t of such a parameter.
  std::pair<std::size_t, double> split(double sigma) const;

  /// Parameters of about `count` points, all ends of pieces among them.
  std::vector<double> spread(int count) const;

  /// Whether it is its own mirror image in the vertical line through the centre.
  bool mirrored_in_x() const { return mirrored_in_x_; }
  /// And in the horizontal one.
  bool mirrored_in_y() const { return mirrored_in_y_; }

 private:
  /// Of shapes with quadrants: semi-axes towards +x, +y, -x, -y and the exponent.
  struct Quadrants {
    std::array<double, 4> semi_axes;
    double exponent;
  };

  Outline outline_;
  Eigen::Vector2d centre_;
  std::optional<Quadrants> quadrants_;
  std::array<Enclosure, 2> turn_;  ///< scale times cosine and sine of the rotation
  bool mirrored_in_x_ = false;
  bool mirrored_in_y_ = false;
};

}  // namespace reprise::rigorous
