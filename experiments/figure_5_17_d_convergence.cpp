// Figure 5.17: how objective and constraint develop over the iterations for (a) P1, (b) P2 and (c) P3.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_convergence_figure(argc, argv, REPRISE_PROGRAM, "D");
}
