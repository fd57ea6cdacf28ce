// Figure 5.8: the designs found for (a) P2 and (b) P3, with workspace and inverse condition number.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(argc, argv,
                                                 {.program = "figure_5_8_so_synthesis",
                                                  .item = "Figure 5.8",
                                                  .title = "SO synthesis: optimal designs for P2 and P3",
                                                  .kind = "SO",
                                                  .panels = {{"P2", {0.0, 0.0}}, {"P3", {0.0, 0.0}}}});
}
