#pragma once

// Shapes of prescribed workspaces in TOML files.

#include <string>
#include <vector>

#include "reprise/geometry/prescribed_workspace.hpp"
#include "reprise/io/toml_reader.hpp"

namespace reprise {

/// The shape that the section's `kind` and its other keys describe, as apps/reprise/input.md says.
Shape read_shape(const TomlSection& section);

/// The keys that read_shape reads: `kind` and those of that kind; where it is missing or unknown, those of all kinds.
std::vector<std::string> shape_keys(const TomlSection& section);

}  // namespace reprise
