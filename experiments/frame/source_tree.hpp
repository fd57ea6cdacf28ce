#pragma once

// Where the project's own files are.

#include <filesystem>

namespace reprise::experiments {

/// The folder data/ of the source tree from which the programs were built.
std::filesystem::path data_folder();

/// The folder examples/ there.
std::filesystem::path examples_folder();

}  // namespace reprise::experiments
