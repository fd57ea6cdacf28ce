#pragma once

// The files of a sweep: a problem file, what of it varies, and what is computed at each point. input.md of the program
// describes the format.

#include <toml++/toml.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reprise {

/// No sweep has more points than this.
constexpr std::size_t most_sweep_points = 10'000'000;

/// What a sweep computes at each point.
enum class SweepKind {
  pose,       ///< limits and conditioning at a pose
  workspace,  ///< the constant-orientation workspace, exactly
  dextrous,   ///< the dextrous workspace, exactly
  synthesis,  ///< the best design
};

/// One of the numbers that vary.
struct SweepAxis {
  std::string name;               ///< of its column
  std::vector<std::string> keys;  ///< TOML paths of the problem file; after a "-", the negative of the number is set
  std::vector<double> values;     ///< in the order of the file; of a sample, the least and the largest
  bool logarithmic = false;       ///< whether steps are factors
};

/// A sweep as its file says it.
struct SweepStudy {
  std::filesystem::path file;             ///< of the study
  std::filesystem::path problem_file;     ///< whose numbers vary
  toml::table problem;                    ///< the tables of that file
  SweepKind kind = SweepKind::synthesis;  ///< what is computed
  std::vector<SweepAxis> axes;            ///< what varies; at least one number
  /// Number of points of Sobol's sequence in the box of all axes; none: the grid of all values, the last axis fastest.
  std::optional<std::size_t> sample;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of a pose, a length of the file
  double orientation_deg = 0.0;                        ///< of a pose and of a workspace
  std::array<double, 2> range_deg{};                   ///< of a dextrous workspace

  std::size_t size() const;  ///< number of points

  /// The numbers of a point, one for each axis, from its index below size().
  std::vector<double> point(std::size_t index) const;

  /// The tables of the problem at a point.
  toml::table problem_at(const std::vector<double>& values) const;
};

/// Reads a study. The problem itself is read too, so that what is wrong with it is said once. Throws InputError, in one
/// sentence with file, line and key, for whatever is wrong.
SweepStudy read_study(const std::filesystem::path& file);

}  // namespace reprise
