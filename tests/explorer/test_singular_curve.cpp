#include <Eigen/Geometry>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/singular_positions.hpp"
#include "reprise/study/problem_file.hpp"
#include "singular_curve.hpp"

using namespace reprise;

namespace {

Eigen::AlignedBox2d around(const SingularityPolynomial& polynomial) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(1.7 * polynomial.unit);
  return {polynomial.centre - reach, polynomial.centre + reach};
}

double distance(const std::vector<std::vector<Eigen::Vector2d>>& curves, const Eigen::Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& curve : curves) {
    for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
      const Eigen::Vector2d along = curve[k + 1] - curve[k];
      const double share = along.isZero() ? 0.0 : (point - curve[k]).dot(along) / along.squaredNorm();
      least = std::min(least, (point - curve[k] - std::clamp(share, 0.0, 1.0) * along).norm());
    }
  }
  return least;
}

}  // namespace

// On the curves the polynomial is zero, and between two points at which its signs differ there is a curve.
BOOST_AUTO_TEST_CASE(the_curves_are_the_zeros_and_all_of_them) {
  for (const std::string name : {"M1", "M3", "triangle", "rectangle", "polygon", "two_legs"}) {
    const ManipulatorInput input =
        read_manipulator(std::filesystem::path(REPRISE_SOURCE) / "examples" / (name + ".toml"));
    for (const double degrees : {0.0, 7.0, -33.0, 120.0}) {
      const SingularityPolynomial polynomial = singularity_polynomial(input.manipulator, degrees * degree);
      const Eigen::AlignedBox2d box = around(polynomial);
      const auto curves = explorer::singular_curve(polynomial, box);
      BOOST_TEST(curves.empty() == polynomial.vanishes());
      for (const auto& curve : curves) {
        for (const Eigen::Vector2d& point : curve) {
          // At a double zero half of the digits are lost.
          BOOST_TEST(std::abs(polynomial.at(point)) < 1e-9);
        }
      }
      constexpr int cells = 40;
      const Eigen::Vector2d step = box.sizes() / cells;
      for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
          const Eigen::Vector2d from = box.min() + step.cwiseProduct(Eigen::Vector2d(column, row));
          for (const Eigen::Vector2d& to :
               {Eigen::Vector2d(from.x() + step.x(), from.y()), Eigen::Vector2d(from.x(), from.y() + step.y())}) {
            if (polynomial.at(from) * polynomial.at(to) >= 0.0) continue;
            BOOST_TEST(distance(curves, from) <= 1.01 * (to - from).norm(), name << " at " << degrees << " degrees");
          }
        }
      }
    }
  }
}
