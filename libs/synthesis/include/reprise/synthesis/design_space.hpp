#pragma once

// The family of manipulators a synthesis searches: joints and length limits that depend affinely on the design vector
// d.
//
// The parameters of a manipulator with n legs are ordered leg by leg as
//     joints:   [c_x, c_y, p_x, p_y]  (4 n),      lengths:  [l_min, l_max]  (2 n),
// and a design d in R^k means
//     joints  = joints of the origin  + joint_map  (d - reference),
//     lengths = lengths of the origin + length_map (d - reference),
// so the origin is the manipulator of the design `reference`, which is 0 unless it is given.

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// The designs among which a synthesis chooses: which coordinates of a manipulator vary, and how far.
class DesignSpace {
 public:
  /// `origin` is the manipulator of d = reference, whose joint-angle limits all designs share, and whose length limits
  /// are those of all designs but where length_map moves them (a minimum length that is moved must stay above 0, see
  /// list_limits). joint_map is 4 n x k, length_map 2 n x k. Without bounds, lower and upper are empty. Throws
  /// std::invalid_argument, naming what does not fit, when a size is wrong, a number is not finite (bounds may be
  /// infinite) or bounds are reversed.
  DesignSpace(Manipulator origin, std::vector<std::string> names, Eigen::MatrixXd joint_map, Eigen::MatrixXd length_map,
              Eigen::VectorXd lower = {}, Eigen::VectorXd upper = {}, Eigen::VectorXd reference = {});

  /// The thesis's d = [x_C, y_C, x_D, x_E, r] (eq. (5.36)) with given length limits and no bounds.
  static DesignSpace collinear(const std::array<Interval, 3>& lengths);

  /// k.
  Eigen::Index size() const { return static_cast<Eigen::Index>(names_.size()); }
  const std::vector<std::string>& names() const { return names_; }  ///< of the design variables
  const Eigen::MatrixXd& joint_map() const { return joint_map_; }   ///< 4 n x k, how the joints follow d - reference
  const Eigen::MatrixXd& length_map() const {
    return length_map_;
  }                                                        ///< 2 n x k, how the length limits follow d - reference
  const Eigen::VectorXd& lower() const { return lower_; }  ///< of length k, or empty
  const Eigen::VectorXd& upper() const { return upper_; }  ///< of length k, or empty
  const Eigen::VectorXd& reference() const { return reference_; }  ///< d of the origin

  /// The manipulator of the design `reference`.
  const Manipulator& origin() const { return origin_; }

  /// Number of legs of every design.
  std::size_t legs() const { return origin_.size(); }

  /// The manipulator of a design. Throws std::invalid_argument when d has the wrong length or is not finite, and where
  /// Manipulator does (a design that makes length limits negative or reversed).
  Manipulator manipulator(const Eigen::VectorXd& d) const;

 private:
  Manipulator origin_;
  std::vector<std::string> names_;
  Eigen::MatrixXd joint_map_;
  Eigen::MatrixXd length_map_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::VectorXd reference_;
};

}  // namespace reprise
