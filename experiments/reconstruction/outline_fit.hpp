#pragma once

// Families of outlines fitted to the printed values, and how far the fit leaves them open.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "reconstruction/published_rows.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise::experiments {

/// What a row would print if its W_p had a given outline.
struct Prediction {
  double f_d0 = 0.0;
  double f_star = 0.0;         ///< at the row's design
  double f_star_change = 0.0;  ///< bound, to first order, of its change within the rounding of the design
  /// The least distance in which a leg reaches a limit, over the outline, at the row's design; negative where the
  /// outline sticks out. A length.
  double clearance = 0.0;
};

/// The area of W_p outside of the workspace of a row's design, summed over its slices, and the chapter's smallest
/// clearance rho in polar radii.
struct Miss {
  double area = 0.0;
  double polar_clearance = 0.0;
};

/// A row, ready to be held against many outlines. Shared and never changed.
class RowModel {
 public:
  explicit RowModel(PublishedRow row);

  const PublishedRow& row() const { return row_; }

  /// A bound of how far the legs' lengths differ within the rounding of the design.
  double length_change() const { return length_change_; }

  /// The outline is in the size of the row's table, and seen in these directions (at least 2, increasing within one
  /// turn).
  Prediction predict(const PrescribedWorkspace& outline, const std::vector<double>& directions) const;

  /// What the design's workspace misses of it; with the legs' lengths wider by length_change() where allowed.
  Miss miss(const PrescribedWorkspace& outline, const std::vector<double>& directions, bool allowed) const;

  /// The area that may be missed: the printed g* and half a unit of its last digit, but not less than 1e-7, some 2e-5
  /// deep, for the sake of scaling.
  double allowed_area() const;

 private:
  PublishedRow row_;
  Manipulator start_;
  Manipulator design_;
  double length_change_;
  std::vector<std::shared_ptr<const Limits>> limits_;
  std::vector<PolarBoundary> boundaries_;
  std::vector<PolarBoundary> widened_boundaries_;
};

/// The centre O' = [1, 1.5] of all prescribed workspaces, section 5.6.2.
Eigen::Vector2d outline_centre();

/// A family of outlines, before the division by the factors of the tables.
struct OutlineFamily {
  std::string name;
  std::string formula;
  std::vector<std::string> parameters;
  Eigen::VectorXd start;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  std::function<Shape(const Eigen::VectorXd&)> shape;
};

/// By which numbers an outline is divided in the tables; two of them may be left to the fit.
struct Sizes {
  std::string name;
  std::vector<double> divisors;  ///< one for each row of the fit
  bool fitted = false;           ///< all but the first are variables, and these their start
};

/// A point of a fit.
struct FittedOutline {
  Eigen::VectorXd x;              ///< parameters, then divisors where they are fitted
  double sum_of_squares = 0.0;    ///< of the residuals
  double largest_residual = 0.0;  ///< largest absolute residual
  double excess = 0.0;            ///< largest ratio of a difference to its allowance: at most 1 when compatible
};

/// The outlines in which one entry of x is least and most.
struct Extent {
  Eigen::VectorXd least;
  Eigen::VectorXd most;
};

/// One family against the rows of one workspace.
///
/// Residuals, three for each row: the differences of f(d^0) and f* from the printed values, in half units of their last
/// digit, and the clearance, which is about 0 at a published optimum, in units of 0.0005, the rounding of the designs.
///
/// Allowances: half a unit of the last digit for f(d^0); the same and f_star_change for f*; for the contact, a
/// clearance of at most length_change, and an area outside, within rounding, of at most the printed g* with half a unit
/// (but not less than 1e-7, some 2e-5 deep).
class OutlineFit {
 public:
  OutlineFit(std::vector<std::shared_ptr<const RowModel>> rows, OutlineFamily family, Sizes sizes, int directions);

  const OutlineFamily& family() const { return family_; }
  /// Names of the entries of x.
  const std::vector<std::string>& names() const { return names_; }

  Shape shape(const Eigen::VectorXd& x) const;
  std::vector<double> divisors(const Eigen::VectorXd& x) const;

  Eigen::VectorXd residuals(const Eigen::VectorXd& x) const;
  FittedOutline judge(const Eigen::VectorXd& x) const;

  /// The least sum of squares found from the family's start and from further ones within 10 % of it (fixed seed).
  FittedOutline least_squares(const Solver& solver, int starts) const;

  /// The least excess found from the given point and from the family's start.
  FittedOutline nearest(const Solver& solver, const FittedOutline& from) const;

  /// Of each entry of x, the outlines with an excess of at most 1 in which it is least and most, as far as local
  /// searches from a compatible outline get. Empty when that one is not compatible.
  std::vector<Extent> extents(const Solver& solver, const FittedOutline& compatible) const;

 private:
  /// The outline in the size of row k's table.
  PrescribedWorkspace outline(const Eigen::VectorXd& x, std::size_t k) const;
  /// Differences over allowances, six for each row; what is compatible is at most 1.
  Eigen::VectorXd ratios(const Eigen::VectorXd& x) const;
  Problem problem(const std::string& name) const;

  std::vector<std::shared_ptr<const RowModel>> rows_;
  OutlineFamily family_;
  Sizes sizes_;
  std::vector<double> directions_;
  std::vector<std::string> names_;
  Eigen::VectorXd start_, lower_, upper_;
};

}  // namespace reprise::experiments
