// Figure 5.6: dextrous workspaces of M3 for nested ranges of orientations. The chapter's own page with this figure is
// lost.

#include "chapter/dextrous_figure.hpp"

int main(int argc, char** argv) {
  return reprise::experiments::run_dextrous_figure(argc, argv, REPRISE_PROGRAM, "M3",
                                                   {0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0});
}
