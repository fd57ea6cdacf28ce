#pragma once

#include <Eigen/Core>
#include <vector>

#include "reprise/synthesis/synthesis.hpp"

namespace reprise {

/// assess (synthesis.hpp) for many designs of one task: the points of the outline are found once.
class Assessor {
 public:
  /// Throws as assess does.
  explicit Assessor(SynthesisTask task, int points = 2000, int orientations = 21);

  /// What assess gives for this design.
  Assessment operator()(const Eigen::VectorXd& design) const;

 private:
  SynthesisTask task_;
  int orientations_;
  std::vector<Eigen::Vector2d> positions_;
};

}  // namespace reprise
