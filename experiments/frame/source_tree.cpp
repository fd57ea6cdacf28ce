#include "frame/source_tree.hpp"

#include "build_information.hpp"

namespace reprise::experiments {

std::filesystem::path data_folder() { return build_information::data_folder; }

}  // namespace reprise::experiments
