// Figure 5.12: the design found for P2, with workspace and inverse condition number at the three orientations.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv,
      {.program = REPRISE_PROGRAM,
       .kind = "MO",
       .panels = {{"P2", {-5.0, -5.0}}, {"P2", {0.0, 0.0}}, {"P2", {5.0, 5.0}}}});
}
