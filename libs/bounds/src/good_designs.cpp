#include "reprise/bounds/good_designs.hpp"

#include <algorithm>
#include <utility>

#include "box_examiner.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/base/require.hpp"
#include "reprise/synthesis/constraint_functions.hpp"
#include "root_box.hpp"

namespace reprise {
namespace {

using namespace rigorous;

double extent(const Interval& range) { return range.upper - range.lower; }

/// The two halves of a box that is too large; nothing of one that is small enough. The variable that blurs the bound
/// most is split first.
std::vector<DesignBox> halves(const Examination& from, int variables, double resolution) {
  auto widest = static_cast<std::size_t>(from.widest);
  for (std::size_t i = 0; i < static_cast<std::size_t>(variables); ++i) {
    if (extent(from.box[widest]) <= resolution && extent(from.box[i]) > extent(from.box[widest])) widest = i;
  }
  if (extent(from.box[widest]) <= resolution) return {};
  const double middle = 0.5 * from.box[widest].lower + 0.5 * from.box[widest].upper;
  std::vector<DesignBox> both(2, from.box);
  both[0][widest].upper = middle;
  both[1][widest].lower = middle;
  return both;
}

bool small(const DesignBox& box, int variables, double resolution) {
  return std::all_of(box.begin(), box.begin() + variables,
                     [&](const Interval& range) { return extent(range) <= resolution; });
}

/// The boxes of a proof that may hold a design above the value: leaves, or what is split though it is small. Without a
/// proof the root box.
std::vector<DesignBox> boxes_above(double value, const DesignBox& root, int variables, double resolution,
                                   const BoundCertificate* proof) {
  if (!proof || proof->nodes.empty()) return {root};
  const bool same =
      std::equal(proof->root.begin(), proof->root.end(), root.begin(), root.begin() + variables,
                 [](const Interval& a, const Interval& b) { return a.lower == b.lower && a.upper == b.upper; });
  require(same, "the proof", "one with another root box", "of the same search");
  // The bound of a split node is the larger one of its halves, which come after it.
  std::vector<double> bounds(proof->nodes.size());
  for (std::size_t k = bounds.size(); k-- > 0;) {
    const CertificateNode& node = proof->nodes[k];
    bounds[k] = node.kind == CertificateKind::split ? std::max(bounds[node.lower], bounds[node.upper]) : node.bound;
  }
  std::vector<DesignBox> boxes;
  std::vector<std::pair<std::size_t, DesignBox>> open{{0, root}};
  while (!open.empty()) {
    const auto [index, box] = open.back();
    open.pop_back();
    if (bounds[index] <= value) continue;
    const CertificateNode& node = proof->nodes[index];
    if (node.kind != CertificateKind::split || small(box, variables, resolution)) {
      boxes.push_back(box);
      continue;
    }
    const auto variable = static_cast<std::size_t>(node.variable);
    open.emplace_back(node.upper, box);
    open.back().second[variable].lower = node.at;
    open.emplace_back(node.lower, box);
    open.back().second[variable].upper = node.at;
  }
  return boxes;
}

std::vector<Interval> design_of(const DesignFamily& family, const DesignBox& box) {
  Variables<Enclosure> z;
  for (std::size_t i = 0; i < static_cast<std::size_t>(family.variables()); ++i) z[i] = rigorous::to_enclosure(box[i]);
  const Enclosure& r = z[static_cast<std::size_t>(family.r_of())];
  std::vector<Interval> design;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Enclosure x = z[static_cast<std::size_t>(family.x_of(leg))] + DesignFamily::end_of(leg) * r;
    design.push_back(to_interval(x));
    if (leg == 0 || !family.in_line()) design.push_back(box[static_cast<std::size_t>(family.y_of(leg))]);
  }
  design.push_back(box[static_cast<std::size_t>(family.r_of())]);
  return design;
}

bool touch(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const Interval& one, const Interval& other) {
    return one.lower <= other.upper && other.lower <= one.upper;
  });
}

/// Numbers the groups of boxes that touch, and puts the boxes in their order.
void group(std::vector<GoodBox>& boxes) {
  std::vector<std::size_t> open;
  std::vector<bool> seen(boxes.size(), false);
  std::vector<GoodBox> ordered;
  std::size_t groups = 0;
  for (std::size_t first = 0; first < boxes.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    open.push_back(first);
    while (!open.empty()) {
      const std::size_t here = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (seen[k] || !touch(boxes[here].variables, boxes[k].variables)) continue;
        seen[k] = true;
        open.push_back(k);
      }
      ordered.push_back(boxes[here]);
      ordered.back().group = groups;
    }
    ++groups;
  }
  boxes = std::move(ordered);
}

std::vector<std::vector<Interval>> hulls_of(const std::vector<GoodBox>& boxes) {
  std::vector<std::vector<Interval>> hulls;
  for (const GoodBox& box : boxes) {
    if (box.group == hulls.size()) hulls.push_back(box.design);
    std::vector<Interval>& hull = hulls.back();
    for (std::size_t i = 0; i < hull.size(); ++i) {
      hull[i] = {std::min(hull[i].lower, box.design[i].lower), std::max(hull[i].upper, box.design[i].upper)};
    }
  }
  return hulls;
}

}  // namespace

GoodDesigns enclose_good_designs(const SynthesisTask& task, double value, const GoodDesignsOptions& options) {
  validate(task);
  check_search(options.side, options.max_boxes, options.threads, options.sizes);
  require(options.resolution >= 1e-6, "the resolution", options.resolution, "at least 1e-6");
  const DesignFamily family(task, options.base_joints);
  const Interval sizes = options.sizes ? *options.sizes : default_sizes(family);
  const DesignBox root = root_box(task, family, sizes, options.side);
  require(value < 1.0 && value >= bound_outside(family, sizes), "the value", value,
          "below 1, and not below what designs of other sizes may reach");
  const BoxExaminer examiner(task, family, root);

  GoodDesigns good;
  std::vector<DesignBox> open = boxes_above(value, root, family.variables(), options.resolution, options.proof);
  while (!open.empty()) {
    good.examined += static_cast<long>(open.size());
    if (good.examined > options.max_boxes) return {false, {}, {}, options.max_boxes};
    std::vector<Examination> examined(open.size());
    in_threads(open.size(), options.threads, [&](std::size_t k) { examined[k] = examiner.examine(open[k], value); });
    open.clear();
    for (const Examination& one : examined) {
      if (one.exclusion.kind != CertificateKind::split && one.exclusion.bound <= value) continue;
      const std::vector<DesignBox> both = halves(one, family.variables(), options.resolution);
      open.insert(open.end(), both.begin(), both.end());
      if (!both.empty()) continue;
      const auto end = one.box.begin() + family.variables();
      good.boxes.push_back({{one.box.begin(), end}, design_of(family, one.box), 0});
    }
  }
  group(good.boxes);
  good.hulls = hulls_of(good.boxes);
  good.complete = true;
  return good;
}

}  // namespace reprise
