// Figure 5.13: the design found for P3, with workspace and inverse condition number at the three orientations.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv,
      {.program = REPRISE_PROGRAM,
       .kind = "MO",
       .panels = {{"P3", {-5.0, -5.0}}, {"P3", {0.0, 0.0}}, {"P3", {5.0, 5.0}}}});
}
