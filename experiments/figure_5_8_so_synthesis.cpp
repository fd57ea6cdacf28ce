// Figure 5.8: the designs found for (a) P2 and (b) P3, with workspace and inverse condition number.

#include "chapter/synthesis_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_design_figure(
      argc, argv, {.program = REPRISE_PROGRAM, .kind = "SO", .panels = {{"P2", {0.0, 0.0}}, {"P3", {0.0, 0.0}}}});
}
