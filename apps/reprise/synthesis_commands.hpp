#pragma once

#include <memory>

#include "command.hpp"

namespace reprise::app {

std::unique_ptr<Command> synthesize_command();
std::unique_ptr<Command> compare_command();

}  // namespace reprise::app
