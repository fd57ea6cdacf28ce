#include "synthesis_commands.hpp"

#include "global_proof.hpp"

namespace reprise::app {

std::vector<std::unique_ptr<Command>> synthesis_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(synthesize_command());
  commands.push_back(compare_command());
  commands.push_back(check_command());
  return commands;
}

}  // namespace reprise::app
