// Figure 5.15: (a) the prescribed workspaces P1-P3 with dextrous workspace and inverse condition number of the starting
// design, (b) the design found for P1.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(argc, argv,
                                                 {.program = "figure_5_15_d_synthesis",
                                                  .item = "Figure 5.15",
                                                  .title = "D synthesis: starting design, and optimal design for P1",
                                                  .kind = "D",
                                                  .panels = {{"", {-5.0, 5.0}}, {"P1", {-5.0, 5.0}}}});
}
