// Figure 5.9: how objective and constraint develop over the iterations for (a) P1, (b) P2 and (c) P3.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_convergence_figure(argc, argv, "figure_5_9_so_convergence", "Figure 5.9",
                                                      "SO synthesis: convergence histories", "table_5_3_so_synthesis");
}
