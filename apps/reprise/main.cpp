// The program reprise: workspaces and dimensional synthesis for any manipulator and workspace.

#include <iostream>

#include "command.hpp"
#include "reprise/io/interruption.hpp"

int main(int argc, char** argv) {
  reprise::handle_interruptions();
  return reprise::app::run(argc, argv, std::cout, std::cerr);
}
