// Figure 5.12: the design found for P2, with workspace and inverse condition number at the three orientations.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv,
      {.program = "figure_5_12_mo_synthesis",
       .item = "Figure 5.12",
       .title = "MO synthesis: optimal design for P2",
       .kind = "MO",
       .panels = {{"P2", {-5.0, -5.0}}, {"P2", {0.0, 0.0}}, {"P2", {5.0, 5.0}}}});
}
