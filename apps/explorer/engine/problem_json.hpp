#pragma once

// A problem file as JSON: the tables of the file with the keys of apps/reprise/input.md.

#include "reprise/study/documents.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise::explorer {

/// The tables manipulator and, where the file has a problem, workspace, orientations and design. Expressions are
/// numbers, and what the file takes from another one is copied in. The design has `free` with single variables, and
/// `bounds` in place of `within`.
Json problem_json(const FileInput& input);

/// The table [manipulator] alone.
Json manipulator_json(const ManipulatorInput& input);

}  // namespace reprise::explorer
