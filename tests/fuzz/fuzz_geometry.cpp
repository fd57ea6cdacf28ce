// fuzz_geometry: the numeric layer under libFuzzer (https://llvm.org/docs/LibFuzzer.html). The bytes are a manipulator,
// mostly with joints and lengths on a lattice, some of them moved by ever so little, and what holds for all
// manipulators must hold for it: a finding is an exception, a sanitizer's report, or a broken promise of a header.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/kinematics/joint_angles.hpp"
#include "reprise/workspace/exact_workspace.hpp"

namespace {

using namespace reprise;

/// Numbers from bytes; zeros when there are no more.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  int below(int limit) { return next_ == end_ ? 0 : *next_++ % limit; }
  /// A multiple of 1/2 between -2 and 2, or a number beside it, or any other.
  double coordinate() {
    const double whole = 0.5 * (below(9) - 4);
    switch (below(8)) {
      case 0:
        return whole + tiny();
      case 1:
        return whole + 0.001 * below(256);
      default:
        return whole;
    }
  }
  /// Not negative: often the root of a whole number.
  double length() {
    const double root = std::sqrt(below(17)) / 2.0;
    return below(8) == 0 ? std::max(root + tiny(), 0.0) : root;
  }
  double angle() { return 0.25 * pi * (below(9) - 4) + (below(8) == 0 ? tiny() : 0.0); }

 private:
  double tiny() { return (below(2) == 0 ? 1.0 : -1.0) * std::pow(10.0, -3 - below(13)); }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", what);
  std::abort();
}

Manipulator manipulator_from(Bytes& bytes, int legs) {
  std::vector<Leg> list;
  for (int i = 0; i < legs; ++i) {
    Leg leg;
    leg.base_joint.x() = bytes.coordinate();
    leg.base_joint.y() = bytes.coordinate();
    leg.platform_joint.x() = bytes.coordinate();
    leg.platform_joint.y() = bytes.coordinate();
    leg.length.lower = bytes.length();
    leg.length.upper = leg.length.lower + bytes.length();
    if (leg.length.upper == 0.0) leg.length.upper = 1.0;
    const auto range = [&]() -> std::optional<Interval> {
      if (bytes.below(4) != 0) return std::nullopt;
      const double lower = bytes.angle();
      return Interval{lower, lower + 0.25 * pi * (1 + bytes.below(7))};
    };
    leg.base_angle = range();
    leg.platform_angle = range();
    list.push_back(leg);
  }
  return {"fuzz", list};
}

void check_modes(const Manipulator& manipulator, const std::array<double, 3>& lengths) {
  const AssemblyModes modes = assembly_modes(manipulator, lengths);
  expect(modes.poses.size() == modes.multiplicities.size(), "every mode has a multiplicity");
  expect(!modes.infinitely_many || modes.poses.empty(), "no poses where there are infinitely many");
  double size = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Leg& leg = manipulator.leg(i);
    size = std::max({size, lengths[i], (leg.base_joint - manipulator.leg(0).base_joint).norm(),
                     (leg.platform_joint - manipulator.leg(0).platform_joint).norm()});
  }
  int sum = 0;
  for (std::size_t k = 0; k < modes.poses.size(); ++k) {
    sum += modes.multiplicities[k];
    for (std::size_t i = 0; i < 3; ++i) {
      expect(std::abs(leg_length(manipulator.leg(i), modes.poses[k]) - lengths[i]) <= 1e-12 * size + 1e-14,
             "the modes have the lengths");
    }
  }
  expect(sum <= 6, "at most six modes");
}

/// Area, boundary and limits of a region agree.
void check_region(const Region& region, const Limits& limits) {
  double sum = 0.0;
  const double size = limits.box().isEmpty() ? 0.0 : limits.box().diagonal().norm();
  for (const RegionComponent& component : region.components()) {
    expect(component.outer.signed_area() > 0.0, "outer boundaries run counter-clockwise");
    sum += component.outer.signed_area();
    for (const BoundaryLoop& hole : component.holes) {
      expect(hole.signed_area() <= 0.0, "holes run clockwise");
      sum += hole.signed_area();
    }
    Eigen::VectorXd h(limits.count());
    for (const BoundaryEdge& edge : component.outer.edges) {
      expect(edge.start.allFinite() && edge.end.allFinite(), "vertices are finite");
      limits.evaluate(edge.at(0.5), h);
      expect(std::abs(h.maxCoeff()) <= 1e-7 * std::max(size, 1.0), "the boundary is where a limit is zero");
    }
  }
  expect(std::abs(sum - region.area()) <= 1e-12 * std::max(size * size, 1e-3), "the area is that of the loops");
  expect(region.area() >= 0.0 && region.area() <= 1.001 * size * size, "the area is that of a part of the box");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const int legs = 1 + bytes.below(5);
  const double phi = bytes.angle();
  const Manipulator manipulator = manipulator_from(bytes, legs);
  if (legs == 3) {
    check_modes(manipulator, {bytes.length(), bytes.length(), bytes.length()});
    const Eigen::VectorXd reached = leg_lengths(manipulator, {{bytes.coordinate(), bytes.coordinate()}, phi});
    check_modes(manipulator, {reached[0], reached[1], reached[2]});
  }
  check_region(constant_orientation_workspace(manipulator, phi), ConstantOrientationLimits(manipulator, phi));
  const Interval range{phi, phi + 0.25 * pi * (1 + bytes.below(4))};
  check_region(dextrous_workspace(manipulator, range), DextrousLimits(manipulator, range));
  return 0;
}
