#pragma once

// Where along the outline the functions of a design have their peaks, in floating point: the poses that matter for it.

#include <Eigen/Core>
#include <vector>

#include "design_functions.hpp"
#include "outline_curve.hpp"

namespace reprise::rigorous {

/// A local maximum of kappa^2, or a local minimum of a limit's slack.
struct DesignPeak {
  CertificateTerm term;           ///< of which function, and where; the multiplier is 1
  Eigen::Vector2d position;       ///< u
  WithGradient<double> function;  ///< kappa^2 or the slack there, with its derivatives along the design
};

class DesignPeaks {
 public:
  /// `count`: about how many points of the outline the peaks are looked for between.
  DesignPeaks(const DesignFamily& family, const OutlineCurve& curve, int count);

  /// Those of kappa^2 at the orientations where the conditioning counts, from the largest on, `most` at most.
  std::vector<DesignPeak> of_conditioning(const Variables<double>& z, std::size_t most) const;

  /// Those of all limits whose slack may fall below `most` when the design moves by `reach`, each variable by its own.
  std::vector<DesignPeak> of_limits(const Variables<double>& z, const Variables<double>& reach, double most) const;

  /// The largest kappa^2 and the largest violation, in squares of lengths, at the points themselves.
  struct Worth {
    double squared_condition;
    double violation;
  };
  Worth at_points(const Variables<double>& z) const;

  const std::vector<double>& parameters() const { return parameters_; }
  const std::vector<Eigen::Vector2d>& positions() const { return positions_; }

 private:
  template <class Function>
  double climb(double sigma, const Function& function) const;
  OutlinePose pose(std::size_t orientation, double sigma) const;

  const DesignFamily& family_;
  const OutlineCurve& curve_;
  std::vector<double> parameters_;
  std::vector<Eigen::Vector2d> positions_;
  double step_;
};

}  // namespace reprise::rigorous
