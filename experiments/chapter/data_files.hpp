#pragma once

// Manipulators and prescribed workspaces from TOML files; data/manipulators.toml and data/prescribed_workspaces.toml
// describe the format.
//
// All functions throw std::runtime_error, in one sentence that names file, line, key and what is allowed, for a file
// that cannot be read, is not TOML, lacks what is asked for, or holds a wrong or unknown value or key.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/kinematics/manipulator.hpp"

namespace reprise::experiments {

/// A manipulator of the thesis's family.
struct CollinearManipulator {
  std::string name;
  CollinearDesign design;
  std::array<Interval, 3> lengths;
};

/// The manipulator of that name.
CollinearManipulator read_manipulator(const std::filesystem::path& path, const std::string& name);

/// A prescribed workspace with what is known about its origin.
struct SourcedWorkspace {
  PrescribedWorkspace workspace;
  std::string kind;       ///< as in the file
  std::string source;     ///< where the outline comes from; may be empty
  std::string certainty;  ///< how sure it is; may be empty
};

/// All prescribed workspaces of a file, in alphabetical order of their names, in the size that belongs to a kind of
/// synthesis: "SO", "MO" or "D".
std::vector<SourcedWorkspace> read_prescribed_workspaces(const std::filesystem::path& path,
                                                         const std::string& synthesis);

}  // namespace reprise::experiments
