#pragma once

// The files of the program: a manipulator, or a manipulator with a workspace that is prescribed to it. input.md
// describes the format.

#include <toml++/toml.h>

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace reprise {

/// No length in a file is larger than this in magnitude, so that squares and products of a few are far from overflow.
constexpr double largest_length = 1e6;

/// The table [manipulator].
struct ManipulatorInput {
  Manipulator manipulator;    ///< with the legs of the file
  Conditioning conditioning;  ///< how its Jacobian is made comparable
  bool as_design = false;     ///< given in the thesis's form, design = [x_C, y_C, x_D, x_E, r]
  std::string unit = {};      ///< of its lengths, "mm", for labels and texts; empty where the file does not say

  /// The unit that axes and tables have: that of the file, or "length".
  std::string column_unit() const { return unit.empty() ? "length" : unit; }
};

/// What a file says of the outline of its prescribed workspace.
struct OutlineOrigin {
  std::string kind;       ///< of the shape, as in the file
  std::string source;     ///< where the outline comes from; may be empty
  std::string certainty;  ///< how sure it is; may be empty
};

/// All tables of a problem: the synthesis that they ask for, and the design it starts from, which is the manipulator of
/// the file.
struct ProblemInput {
  ManipulatorInput start;  ///< the manipulator of the file
  SynthesisTask task;      ///< in the unit of the file
  Eigen::VectorXd design;  ///< d of the start, in the unit of the file
  OutlineOrigin origin;    ///< of the prescribed workspace
};

/// What a file says: a manipulator, and perhaps a problem about it.
struct FileInput {
  ManipulatorInput manipulator;         ///< the manipulator of the file
  std::optional<ProblemInput> problem;  ///< none in a manipulator file
};

/// Reads a file of either kind. Throws as read_manipulator.
FileInput read_input(const std::filesystem::path& file);

/// Reads the manipulator of a file. The rest of a problem, when it is there, is read and checked too, and left out.
/// Throws InputError, in one sentence with file, line and key, for whatever is wrong.
ManipulatorInput read_manipulator(const std::filesystem::path& file);

/// Reads a whole problem. Throws as read_manipulator.
ProblemInput read_problem(const std::filesystem::path& file);

/// The same two from the tables of a file, whose name messages have, and from whose folder other files are seen.
ManipulatorInput read_manipulator(const toml::table& tables, const std::filesystem::path& file);
/// The whole problem.
ProblemInput read_problem(const toml::table& tables, const std::filesystem::path& file);

/// The manipulator as a file that read_manipulator reads back: joints, lengths and names to the last bit, angles to
/// rounding.
std::string to_toml(const ManipulatorInput& input);

}  // namespace reprise
