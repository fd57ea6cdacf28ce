#pragma once

// The linear program of a box of designs: the smallest maximum of a few affine functions under a few affine
// inequalities, in a box. In floating point: its multipliers are a suggestion, which certificates verify.

#include <Eigen/Core>
#include <vector>

namespace reprise {

/// The largest number of variables of a program.
inline constexpr int most_variables = 8;

using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_variables, 1>;

/// value + gradient . x
struct AffineRow {
  double value;
  SmallVector gradient;
  bool is_limit;  ///< at least 0 where it holds; else one of the functions whose maximum is minimised
};

struct RowMultiplier {
  std::size_t row;
  double multiplier;  ///< positive
};

enum class ProgramStatus {
  solved,
  infeasible,  ///< the multipliers, of limits only, show it: their combination is negative all over the box
  failed,      ///< too many steps, or rounding
};

struct ProgramResult {
  ProgramStatus status = ProgramStatus::failed;
  double value = 0.0;                      ///< the smallest maximum
  SmallVector x;                           ///< where
  std::vector<RowMultiplier> multipliers;  ///< those of functions add up to 1 where it is solved
};

/// min over x of max over functions, subject to the limits and to |x_i| <= 1. At least one row must be a function. The
/// dual simplex method, from the first function and the bounds.
ProgramResult smallest_maximum(const std::vector<AffineRow>& rows, int variables);

}  // namespace reprise
