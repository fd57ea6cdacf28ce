// Figure 5.10: the prescribed workspaces P1-P3 with workspace and inverse condition number of the starting design at
// the three orientations.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv,
      {.program = REPRISE_PROGRAM, .kind = "MO", .panels = {{"", {-5.0, -5.0}}, {"", {0.0, 0.0}}, {"", {5.0, 5.0}}}});
}
