// check_exact_modes [CASES [FIRST]]
//
// Assembly modes of random manipulators on a lattice, where multiple roots are common, against their exact number and
// multiplicities. Ends with 1 when modes are missing, reported twice, in the wrong place, or with another multiplicity,
// and names the case. Without a number it takes as many as a test may.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "kinematics/exact_modes.hpp"
#include "kinematics/samples.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "sample_count.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

/// The lengths are those at a pose on the lattice, turned by quarters of a turn; few joints are apart, so that many are
/// in line or in one point.
LatticeAssembly random_assembly(std::mt19937& random) {
  const auto whole = [&random](int limit) { return std::uniform_int_distribution<int>(-limit, limit)(random); };
  const int spread = 1 + std::abs(whole(3));
  LatticeAssembly assembly;
  for (auto& joint : assembly.base) joint = {whole(spread), whole(spread)};
  for (auto& joint : assembly.platform) joint = {whole(spread), whole(spread)};
  const int x = whole(spread);
  const int y = whole(spread);
  const int turn = whole(2);
  for (std::size_t i = 0; i < 3; ++i) {
    int px = assembly.platform[i][0];
    int py = assembly.platform[i][1];
    for (int k = 0; k < std::abs(turn); ++k) px = std::exchange(py, px) * -1;
    const int ax = x + px - assembly.base[i][0];
    const int ay = y + py - assembly.base[i][1];
    assembly.squares[i] = ax * ax + ay * ay;
  }
  return assembly;
}

AssemblyModes modes_of(const LatticeAssembly& assembly) {
  std::vector<Leg> legs;
  std::array<double, 3> lengths;
  for (std::size_t i = 0; i < 3; ++i) {
    legs.push_back(leg_between(Eigen::Vector2d(assembly.base[i][0], assembly.base[i][1]),
                               Eigen::Vector2d(assembly.platform[i][0], assembly.platform[i][1])));
    lengths[i] = std::sqrt(assembly.squares[i]);
  }
  return assembly_modes(Manipulator("lattice", legs), lengths);
}

/// What is wrong with the modes, or null.
const char* fault_of(const AssemblyModes& found, const std::optional<std::vector<ModesAtOrientation>>& expected) {
  if (found.infinitely_many != !expected) return "infinitely many or not";
  if (!expected) return found.poses.empty() ? nullptr : "poses beside infinitely many";
  std::size_t count = 0;
  for (const ModesAtOrientation& one : *expected) {
    count += one.count;
    std::vector<Pose> here;
    int multiplicity = 0;
    for (std::size_t k = 0; k < found.poses.size(); ++k) {
      // Half of the digits of a double root are lost by rounding of the lengths, if they are not brought back.
      if (std::abs(wrap_angle(found.poses[k].orientation - one.orientation)) > 1e-10) continue;
      here.push_back(found.poses[k]);
      multiplicity += found.multiplicities[k];
      if ((found.multiplicities[k] == 0) != (one.multiplicity == 0)) return "an isolated pose or not";
    }
    if (here.size() != one.count) return here.size() < one.count ? "a mode is missing" : "a mode is there twice";
    if (multiplicity != one.multiplicity) return "another multiplicity";
    if (here.size() == 2 && (here[0].position - here[1].position).norm() < 1e-3) return "two modes in one place";
  }
  return count == found.poses.size() ? nullptr : "a mode too many";
}

}  // namespace

int main(int argc, char** argv) {
  const long cases = argc > 1 ? std::atol(argv[1]) : scaled(1000L);
  const long first = argc > 2 ? std::atol(argv[2]) : 0;
  long wrong = 0;
  std::map<int, long> orientations;  ///< by their multiplicity
  long shared = 0;
  long infinitely_many = 0;
  for (long number = first; number < first + cases; ++number) {
    std::seed_seq seed{number};
    std::mt19937 random(seed);
    const LatticeAssembly assembly = random_assembly(random);
    const auto expected = ExactModes::of(assembly);
    const AssemblyModes found = modes_of(assembly);
    if (!expected) ++infinitely_many;
    for (const ModesAtOrientation& one : expected.value_or(std::vector<ModesAtOrientation>{})) {
      ++orientations[one.multiplicity];
      if (one.count == 2) ++shared;
    }
    const char* fault = fault_of(found, expected);
    if (fault == nullptr) continue;
    ++wrong;
    std::printf("case %ld: %s\n", number, fault);
    for (std::size_t i = 0; i < 3; ++i) {
      std::printf("  base %d %d platform %d %d length sqrt(%d)\n", assembly.base[i][0], assembly.base[i][1],
                  assembly.platform[i][0], assembly.platform[i][1], assembly.squares[i]);
    }
    for (const ModesAtOrientation& one : expected.value_or(std::vector<ModesAtOrientation>{})) {
      std::printf("  exact: %zu at %.17g, multiplicity %d\n", one.count, one.orientation, one.multiplicity);
    }
    for (std::size_t k = 0; k < found.poses.size(); ++k) {
      std::printf("  found: %.17g %.17g %.17g, multiplicity %d\n", found.poses[k].position.x(),
                  found.poses[k].position.y(), found.poses[k].orientation, found.multiplicities[k]);
    }
  }
  std::printf("%ld cases, %ld wrong; %ld with infinitely many modes; %ld orientations with two modes\n", cases, wrong,
              infinitely_many, shared);
  for (const auto& [multiplicity, count] : orientations) {
    std::printf("%ld orientations of multiplicity %d\n", count, multiplicity);
  }
  // A generator that makes simple modes only would show nothing.
  const bool is_varied = infinitely_many > 0 && shared > 0 && orientations[2] > shared &&
                         orientations[3] + orientations[4] + orientations[6] > 0;
  return wrong == 0 && is_varied ? 0 : 1;
}
