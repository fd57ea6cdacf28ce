#include "small_linear_program.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace reprise {
namespace {

constexpr int most = most_variables + 1;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

/// The program in the variables [x, tau]: minimise tau subject to coefficients . [x, tau] >= least. Constraints
/// 0 .. 2 n - 1 are the bounds, x_i >= -1 and -x_i >= -1; the rows follow.
class DualSimplex {
 public:
  DualSimplex(const std::vector<AffineRow>& rows, int variables) : rows_(rows), n_(variables) {}

  ProgramResult run() {
    start();
    constexpr int most_steps = 100;
    for (int step = 0; step < most_steps; ++step) {
      // Columns of the inverse are the edges that leave the vertex.
      Matrix basis(n_ + 1, n_ + 1);
      Vector least(n_ + 1);
      for (int k = 0; k <= n_; ++k) {
        basis.row(k) = coefficients(basis_[static_cast<std::size_t>(k)]).transpose();
        least[k] = least_of(basis_[static_cast<std::size_t>(k)]);
      }
      const Eigen::PartialPivLU<Matrix> factors(basis);
      const Vector vertex = factors.solve(least);
      const Vector duals = factors.transpose().solve(Vector::Unit(n_ + 1, n_));
      if (!vertex.allFinite() || !duals.allFinite()) return {};
      const int entering = most_violated(vertex);
      if (entering < 0) return solved(vertex, duals);
      const Vector combination = factors.transpose().solve(coefficients(entering));
      const int leaving = leaving_position(duals, combination);
      if (leaving < 0) return infeasible(entering, combination);
      basis_[static_cast<std::size_t>(leaving)] = entering;
    }
    return {};
  }

 private:
  void start() {
    const auto first = static_cast<std::size_t>(
        std::find_if(rows_.begin(), rows_.end(), [](const AffineRow& row) { return !row.is_limit; }) - rows_.begin());
    for (int i = 0; i < n_; ++i) basis_.push_back(rows_[first].gradient[i] >= 0.0 ? 2 * i : 2 * i + 1);
    basis_.push_back(2 * n_ + static_cast<int>(first));
  }

  const AffineRow& row(int constraint) const { return rows_[static_cast<std::size_t>(constraint - 2 * n_)]; }

  Vector coefficients(int constraint) const {
    Vector result = Vector::Zero(n_ + 1);
    if (constraint < 2 * n_) {
      result[constraint / 2] = constraint % 2 == 0 ? 1.0 : -1.0;
      return result;
    }
    const AffineRow& from = row(constraint);
    result.head(n_) = from.is_limit ? from.gradient : SmallVector(-from.gradient);
    result[n_] = from.is_limit ? 0.0 : 1.0;
    return result;
  }

  double least_of(int constraint) const {
    if (constraint < 2 * n_) return -1.0;
    const AffineRow& from = row(constraint);
    return from.is_limit ? -from.value : from.value;
  }

  /// The constraint that is violated most, measured by the size of its gradient; -1 where none is.
  int most_violated(const Vector& vertex) const {
    constexpr double tolerance = 1e-13;
    int worst = -1;
    double most_by = 0.0;
    const auto look = [&](int constraint, double slack, double size) {
      if (slack < -tolerance * size && -slack / size > most_by) {
        most_by = -slack / size;
        worst = constraint;
      }
    };
    for (int i = 0; i < n_; ++i) {
      look(2 * i, vertex[i] + 1.0, 1.0);
      look(2 * i + 1, 1.0 - vertex[i], 1.0);
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const AffineRow& here = rows_[k];
      const double value = here.value + here.gradient.dot(vertex.head(n_));
      const double size = 1e-3 + here.gradient.cwiseAbs().maxCoeff();
      look(2 * n_ + static_cast<int>(k), here.is_limit ? value : vertex[n_] - value, size);
    }
    return worst;
  }

  static int leaving_position(const Vector& duals, const Vector& combination) {
    const double size = combination.cwiseAbs().maxCoeff();
    int leaving = -1;
    double least = 0.0;
    for (int k = 0; k < combination.size(); ++k) {
      if (combination[k] <= 1e-11 * size) continue;
      const double ratio = std::max(0.0, duals[k]) / combination[k];
      if (leaving < 0 || ratio < least) {
        least = ratio;
        leaving = k;
      }
    }
    return leaving;
  }

  void add_multiplier(ProgramResult& result, int constraint, double multiplier) const {
    if (constraint >= 2 * n_ && multiplier > 0.0) {
      result.multipliers.push_back({static_cast<std::size_t>(constraint - 2 * n_), multiplier});
    }
  }

  ProgramResult solved(const Vector& vertex, const Vector& duals) const {
    ProgramResult result{ProgramStatus::solved, vertex[n_], vertex.head(n_), {}};
    for (int k = 0; k <= n_; ++k) add_multiplier(result, basis_[static_cast<std::size_t>(k)], duals[k]);
    return result;
  }

  /// The entering constraint is a combination of the others with multipliers of the wrong sign.
  ProgramResult infeasible(int entering, const Vector& combination) const {
    ProgramResult result{ProgramStatus::infeasible, 0.0, {}, {}};
    add_multiplier(result, entering, 1.0);
    for (int k = 0; k <= n_; ++k) {
      const int constraint = basis_[static_cast<std::size_t>(k)];
      if (constraint >= 2 * n_ && row(constraint).is_limit) add_multiplier(result, constraint, -combination[k]);
    }
    return result;
  }

  const std::vector<AffineRow>& rows_;
  int n_;
  std::vector<int> basis_;
};

}  // namespace

ProgramResult smallest_maximum(const std::vector<AffineRow>& rows, int variables) {
  return DualSimplex(rows, variables).run();
}

}  // namespace reprise
