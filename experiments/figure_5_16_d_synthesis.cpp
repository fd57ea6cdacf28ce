// Figure 5.16: the designs found for (a) P2 and (b) P3, with dextrous workspace and inverse condition number.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv, {.program = REPRISE_PROGRAM, .kind = "D", .panels = {{"P2", {-5.0, 5.0}}, {"P3", {-5.0, 5.0}}}});
}
