#include "frame/source_tree.hpp"

#include "build_information.hpp"

namespace reprise::experiments {

namespace fs = std::filesystem;

fs::path data_folder() { return fs::path(build_information::source_folder) / "data"; }

fs::path examples_folder() { return fs::path(build_information::source_folder) / "examples"; }

}  // namespace reprise::experiments
