#include "reprise/synthesis/design_space.hpp"

#include <stdexcept>
#include <utility>

namespace reprise {
namespace {

void require(bool allowed, const std::string& message) {
  if (!allowed) throw std::invalid_argument("design space: " + message);
}

std::string size_text(const Eigen::MatrixXd& matrix) {
  return std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols());
}

}  // namespace

DesignSpace::DesignSpace(Manipulator origin, std::vector<std::string> names, Eigen::MatrixXd joint_map,
                         Eigen::MatrixXd length_map, Eigen::VectorXd lower, Eigen::VectorXd upper,
                         Eigen::VectorXd reference)
    : origin_(std::move(origin)),
      names_(std::move(names)),
      joint_map_(std::move(joint_map)),
      length_map_(std::move(length_map)),
      lower_(std::move(lower)),
      upper_(std::move(upper)),
      reference_(std::move(reference)) {
  const auto n = static_cast<Eigen::Index>(origin_.size());
  const Eigen::Index k = size();
  require(k >= 1, "there are 0 design variables, but at least 1 is needed");
  require(joint_map_.rows() == 4 * n && joint_map_.cols() == k,
          "the joint map is " + size_text(joint_map_) + ", but it must be 4 n x k = " + std::to_string(4 * n) + " x " +
              std::to_string(k));
  require(length_map_.rows() == 2 * n && length_map_.cols() == k,
          "the length map is " + size_text(length_map_) + ", but it must be 2 n x k = " + std::to_string(2 * n) +
              " x " + std::to_string(k));
  require(joint_map_.allFinite() && length_map_.allFinite(), "a map has an entry that is not finite");
  if (reference_.size() == 0) reference_ = Eigen::VectorXd::Zero(k);
  require(reference_.size() == k && reference_.allFinite(), "the reference has " + std::to_string(reference_.size()) +
                                                                " entries, but it must have " + std::to_string(k) +
                                                                " finite ones");
  for (const auto* bound : {&lower_, &upper_}) {
    require(bound->size() == 0 || bound->size() == k, "a bound has " + std::to_string(bound->size()) +
                                                          " entries, but it must have " + std::to_string(k) +
                                                          " or none");
    require(!bound->hasNaN(), "a bound has an entry that is not a number");
  }
  if (lower_.size() != 0 && upper_.size() != 0) {
    for (Eigen::Index i = 0; i < k; ++i) {
      require(lower_[i] <= upper_[i], "the lower bound of " + names_[static_cast<std::size_t>(i)] + " is " +
                                          std::to_string(lower_[i]) + ", but it must not exceed the upper bound " +
                                          std::to_string(upper_[i]));
    }
  }
}

DesignSpace DesignSpace::collinear(const std::array<Interval, 3>& lengths) {
  return {make_manipulator({0.0, 0.0, 0.0, 0.0, 0.0}, lengths),
          {"x_C", "y_C", "x_D", "x_E", "r"},
          collinear_design_map(),
          Eigen::MatrixXd::Zero(6, 5)};
}

Manipulator DesignSpace::manipulator(const Eigen::VectorXd& d) const {
  require(d.size() == size(),
          "the design has " + std::to_string(d.size()) + " entries, but it must have " + std::to_string(size()));
  require(d.allFinite(), "the design has an entry that is not finite");
  const Eigen::VectorXd change = d - reference_;
  std::vector<Leg> legs = origin_.legs();
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::Vector4d joints = joint_map_.middleRows<4>(4 * row) * change;
    const Eigen::Vector2d lengths = length_map_.middleRows<2>(2 * row) * change;
    legs[i].base_joint += joints.head<2>();
    legs[i].platform_joint += joints.tail<2>();
    legs[i].length.lower += lengths[0];
    legs[i].length.upper += lengths[1];
  }
  return {origin_.name(), std::move(legs)};
}

}  // namespace reprise
