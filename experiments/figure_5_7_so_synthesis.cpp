// Figure 5.7: (a) the prescribed workspaces P1-P3 with workspace and inverse condition number of the starting design,
// (b) the design found for P1.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv, {.program = REPRISE_PROGRAM, .kind = "SO", .panels = {{"", {0.0, 0.0}}, {"P1", {0.0, 0.0}}}});
}
