// check_exact_regions [CASES [DEXTROUS [SEED]]]
//
// Exact regions of ten families of random manipulators, most of them nearly degenerate, against slices in numbers of
// 64 binary digits: CASES workspaces at one orientation and DEXTROUS dextrous ones of each family. Prints a line for
// each family. Ends with 1 when an area is off by more than 1e-12 s^2, s being the size of a box about the workspace,
// or when parts or holes are counted wrong where slices tell them apart, and names the case. Without numbers it takes
// as many as a test may; 100000 0 takes about a minute.

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "reprise/workspace/exact_workspace.hpp"
#include "sample_count.hpp"
#include "workspace/families.hpp"
#include "workspace/slices.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

constexpr double promised = 1e-12;

struct Summary {
  std::size_t cases = 0;
  std::size_t nonempty = 0;
  std::size_t counted = 0;    ///< whose parts and holes the slices tell
  std::size_t uncertain = 0;  ///< whose area they do not tell closely enough; only gross errors show there
  std::size_t wrong = 0;
  double worst = 0.0;
};

void check(std::size_t family, std::size_t number, bool is_dextrous, Summary& summary) {
  const FamilyMember member = family_member(family, number);
  const Interval range = is_dextrous ? member.range : Interval{member.orientation, member.orientation};
  const Region region = is_dextrous ? dextrous_workspace(member.manipulator, range)
                                    : constant_orientation_workspace(member.manipulator, member.orientation);
  Slices slices(member.manipulator, range);
  const double square = slices.extent() * slices.extent();
  double uncertain = 0.0;
  const double area = slices.area(uncertain);
  ++summary.cases;
  if (area > 0.0) ++summary.nonempty;
  const double error = square > 0.0 ? std::abs(region.area() - area) / square : std::abs(region.area());
  const bool is_certain = uncertain <= 0.1 * promised * square;
  if (!is_certain) ++summary.uncertain;
  if (is_certain) summary.worst = std::max(summary.worst, error);
  if (error > promised + (is_certain ? 0.0 : uncertain / square)) {
    ++summary.wrong;
    std::printf("%s, case %zu%s: area %.17g, by slices %.17g +- %.1g\n", family_names[family], number,
                is_dextrous ? ", dextrous" : "", region.area(), area, uncertain);
  }
  const auto topology = slices.topology();
  if (!topology) return;
  ++summary.counted;
  const Slices::Topology found{region.components().size(), number_of_holes(region)};
  if (found == *topology) return;
  ++summary.wrong;
  std::printf("%s, case %zu%s: %zu parts with %zu holes, by slices %zu with %zu\n", family_names[family], number,
              is_dextrous ? ", dextrous" : "", found.components, found.holes, topology->components, topology->holes);
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int k, std::size_t usual) {
    return argc > k ? static_cast<std::size_t>(std::strtoul(argv[k], nullptr, 10)) : usual;
  };
  // With the sanitizers slices take tens of times as long.
  const std::size_t cases = number(1, few_samples ? 60 : 1000);
  const std::size_t dextrous = number(2, few_samples ? 4 : 40);
  const std::size_t first = 1'000'000 * number(3, 0);
  std::size_t wrong = 0;
  std::size_t nonempty = 0;
  std::printf("%-28s %8s %9s %8s %9s %6s %8s\n", "family", "cases", "not empty", "counted", "uncertain", "wrong",
              "worst");
  for (std::size_t family = 0; family < family_names.size(); ++family) {
    Summary summary;
    for (std::size_t k = 0; k < cases; ++k) check(family, first + k, false, summary);
    for (std::size_t k = 0; k < dextrous; ++k) check(family, first + k, true, summary);
    std::printf("%-28s %8zu %9zu %8zu %9zu %6zu %8.1e\n", family_names[family], summary.cases, summary.nonempty,
                summary.counted, summary.uncertain, summary.wrong, summary.worst);
    std::fflush(stdout);
    wrong += summary.wrong;
    nonempty += summary.nonempty;
  }
  // A generator that makes empty workspaces only would show nothing.
  return wrong == 0 && 3 * nonempty > cases * family_names.size() ? 0 : 1;
}
