#pragma once

// A prescribed workspace as boxes of parameters, in exact terms.
//
// The outline is cut into pieces, smooth curves w(t) about the centre with t in [0, 1], and the region is
//     u = O' + s w(t),    s in [0, 1],    t in [0, 1],    all pieces.
// Pieces end exactly where the shape's definition changes: at the axes of ellipses and superellipses, at vertices and
// at the nodes of a table. Such an end is t = 0 or 1, with no rounding, and an ellipse has an algebraic parameter in
// place of an angle; so the union of the pieces is the region that the shape's numbers define, no more and no less.

#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"
#include "rigorous_arithmetic.hpp"

namespace reprise::rigorous {

/// Bounds of w and dw/dt over an interval of t.
struct OutlineBounds {
  Enclosure x;
  Enclosure y;
  Enclosure x_change;
  Enclosure y_change;
};

class Outline {
 public:
  explicit Outline(const PrescribedWorkspace& workspace);

  std::size_t pieces() const { return pieces_.size(); }
  const Eigen::Vector2d& centre() const { return centre_; }

  OutlineBounds bounds(std::size_t piece, const Enclosure& t) const;

 private:
  /// One quadrant of |x / a|^exponent + |y / b|^exponent = 1, from the x-axis (t = 0) to the y-axis; the signs of the
  /// semi-axes say which.
  struct SuperellipticArc {
    double a;
    double b;
    double exponent;  ///< 2 for an ellipse
  };
  struct Segment {
    Eigen::Vector2d from;
    Eigen::Vector2d to;
  };
  /// Radius and angle run linearly with t.
  struct Spiral {
    double from_radius;
    double to_radius;
    double from_angle;
    Enclosure turn;
  };
  using Piece = std::variant<SuperellipticArc, Segment, Spiral>;

  static OutlineBounds bounds(const SuperellipticArc& arc, const Enclosure& t);
  static OutlineBounds bounds(const Segment& segment, const Enclosure& t);
  static OutlineBounds bounds(const Spiral& spiral, const Enclosure& t);

  Eigen::Vector2d centre_;
  std::array<Enclosure, 2> turn_;  ///< scale times cosine and sine of the rotation
  std::vector<Piece> pieces_;
};

}  // namespace reprise::rigorous
