#include "reprise/synthesis/design_space.hpp"

#include <string>
#include <utility>

#include "reprise/base/require.hpp"

namespace reprise {
namespace {

std::string size_text(Eigen::Index rows, Eigen::Index columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
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
  require(k >= 1, "design space: the number of design variables", k, "at least 1");
  const auto check_map = [k](const char* name, const Eigen::MatrixXd& map, Eigen::Index rows) {
    if (map.rows() != rows || map.cols() != k) reject(name, size_text(map.rows(), map.cols()), size_text(rows, k));
    require(map.allFinite(), name, "not finite", "finite");
  };
  check_map("design space: the joint map, 4 n x k,", joint_map_, 4 * n);
  check_map("design space: the length map, 2 n x k,", length_map_, 2 * n);
  if (reference_.size() == 0) reference_ = Eigen::VectorXd::Zero(k);
  require(reference_.size() == k, "design space: the number of entries of the reference", reference_.size(),
          "the number of design variables");
  require(reference_.allFinite(), "design space: the reference", reference_, "finite");
  for (const auto* bound : {&lower_, &upper_}) {
    require(bound->size() == 0 || bound->size() == k, "design space: the number of entries of a bound", bound->size(),
            "0 or the number of design variables");
    require(!bound->hasNaN(), "design space: a bound", *bound, "without NaN");
  }
  if (lower_.size() != 0 && upper_.size() != 0) {
    for (Eigen::Index i = 0; i < k; ++i) {
      if (lower_[i] <= upper_[i]) continue;
      reject("design space: the lower bound of " + names_[static_cast<std::size_t>(i)], shown(lower_[i]),
             "at most the upper bound, " + shown(upper_[i]));
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
  require(d.size() == size(), "the number of entries of the design", d.size(), "the number of design variables");
  require(d.allFinite(), "the design", d, "finite");
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
