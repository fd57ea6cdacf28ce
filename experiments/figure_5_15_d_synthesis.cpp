// Figure 5.15: (a) the prescribed workspaces P1-P3 with dextrous workspace and inverse condition number of the starting
// design, (b) the design found for P1.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv, {.program = REPRISE_PROGRAM, .kind = "D", .panels = {{"", {-5.0, 5.0}}, {"P1", {-5.0, 5.0}}}});
}
