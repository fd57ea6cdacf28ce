// Figure 5.4: dextrous workspaces of M1 for nested ranges of orientations.

#include "chapter/dextrous_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_dextrous_figure(argc, argv, REPRISE_PROGRAM, "M1", {0.0, 5.0, 10.0, 15.0, 20.0});
}
