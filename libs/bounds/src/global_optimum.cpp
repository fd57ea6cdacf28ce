#include "reprise/bounds/global_optimum.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <queue>

#include "box_examiner.hpp"
#include "design_ascent.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/base/require.hpp"
#include "reprise/synthesis/optimality_certificate.hpp"
#include "root_box.hpp"

namespace reprise {
namespace {

using namespace rigorous;

/// A node while the tree grows: what it does with its box, and what leaves its box out as a whole, if anything does.
struct GrowingNode {
  std::optional<std::size_t> lower;  ///< none: a leaf, or not examined
  std::size_t upper = 0;
  int variable = 0;
  double at = 0.0;
  Exclusion exclusion;
};

struct OpenBox {
  DesignBox box;
  std::size_t node;
  double bound;  ///< of kappa^-1, from boxes that hold this one
  double share;  ///< of the root box's volume
  long number;
};

struct LesserBound {
  bool operator()(const OpenBox& a, const OpenBox& b) const {
    return a.bound != b.bound ? a.bound < b.bound : a.number > b.number;
  }
};

/// A number of ten decimals above x, by at least one unit of them: tables hold it, and a check that is done with a
/// little more rounding has room.
double short_number_above(double x) {
  constexpr double units = 1e10;
  return (std::floor(x * units) + 2.0) / units;
}

class GlobalSearch {
 public:
  GlobalSearch(const SynthesisTask& task, const GlobalOptions& options)
      : task_(task),
        options_(options),
        family_(task, options.base_joints),
        sizes_(options.sizes ? *options.sizes : default_sizes(family_)),
        root_(root_box(task, family_, sizes_, options.side)),
        examiner_(task, family_, root_) {
    nodes_.emplace_back();
    add_open({root_, 0, 1.0, 1.0, 0});
    if (examiner_.mirrored_in_y()) split_root(3, task.prescribed.centre().y());
    if (examiner_.mirrored_in_x()) split_root(2, task.prescribed.centre().x());
  }

  GlobalOptimum run() {
    look_from_everywhere();
    // Boxes come in the order of their bounds. What was split for want of a better design may need no more by now.
    while (!open_.empty() && open_.top().bound > target()) {
      if (result_.counts.examined >= options_.max_boxes) return finish(GlobalStatus::box_limit);
      if (options_.stop && options_.stop()) return finish(GlobalStatus::stopped);
      examine_batch();
      if (options_.observe) options_.observe({done_, result_.counts.examined, result_.lower, bound_now()});
    }
    return finish(exhausted_ ? GlobalStatus::exhausted : GlobalStatus::proved);
  }

 private:
  double target() const { return std::max(result_.lower, options_.known) + 0.95 * options_.gap; }

  /// An upper bound as far as it is known.
  double bound_now() const { return open_.empty() ? target() : std::max(open_.top().bound, target()); }

  void add_open(OpenBox box) {
    box.number = ++made_;
    open_.push(std::move(box));
  }

  std::size_t add_node() {
    nodes_.emplace_back();
    return nodes_.size() - 1;
  }

  /// Gives a node two children.
  void split_node(std::size_t node, int variable, double at) {
    const std::size_t lower = add_node();
    const std::size_t upper = add_node();
    GrowingNode& parent = nodes_[node];
    parent.lower = lower;
    parent.upper = upper;
    parent.variable = variable;
    parent.at = at;
  }

  /// Splits the box that is left of the root where a mirror image leaves out a half.
  void split_root(int variable, double at) {
    std::vector<OpenBox> boxes;
    for (; !open_.empty(); open_.pop()) boxes.push_back(open_.top());
    for (const OpenBox& box : boxes) open_halves(box, box.box, box.share, variable, at);
  }

  void open_halves(const OpenBox& parent, const DesignBox& box, double share, int variable, double at) {
    split_node(parent.node, variable, at);
    const Interval& range = box[index(variable)];
    const double lower_share = (at - range.lower) / (range.upper - range.lower);
    OpenBox half{box, *nodes_[parent.node].lower, parent.bound, share * lower_share, 0};
    half.box[index(variable)].upper = at;
    add_open(half);
    half = {box, nodes_[parent.node].upper, parent.bound, share * (1.0 - lower_share), 0};
    half.box[index(variable)].lower = at;
    add_open(half);
  }

  void examine_batch() {
    std::vector<OpenBox> batch;
    while (batch.size() < boxes_in_batch && !open_.empty() && open_.top().bound > target()) {
      batch.push_back(open_.top());
      open_.pop();
    }
    const double wanted = target();
    std::vector<Examination> examined(batch.size());
    in_threads(batch.size(), options_.threads,
               [&](std::size_t k) { examined[k] = examiner_.examine(batch[k].box, wanted); });
    look_for_designs(examined);
    for (std::size_t k = 0; k < batch.size(); ++k) enter(batch[k], examined[k]);
  }

  /// Puts what was found of a box into the tree.
  void enter(const OpenBox& from, Examination& found) {
    ++result_.counts.examined;
    OpenBox rest = from;
    for (const CutSlab& slab : found.slabs) cut_off(rest, slab);
    rest.box = found.box;
    Exclusion& exclusion = found.exclusion;
    const bool left_out = exclusion.kind != CertificateKind::split && exclusion.bound <= target();
    rest.bound = std::min(rest.bound, exclusion.bound);
    if (left_out) {
      count(exclusion);
      done_ += rest.share;
    } else {
      split(rest, found.widest);
    }
    nodes_[rest.node].exclusion = std::move(exclusion);
  }

  void cut_off(OpenBox& rest, const CutSlab& slab) {
    ++result_.counts.limits;
    split_node(rest.node, slab.variable, slab.at);
    const GrowingNode& node = nodes_[rest.node];
    const std::size_t left_out = slab.below ? *node.lower : node.upper;
    rest.node = slab.below ? node.upper : *node.lower;
    nodes_[left_out].exclusion = {CertificateKind::limit, 0.0, {slab.term}};
    Interval& range = rest.box[index(slab.variable)];
    const double width = range.upper - range.lower;
    (slab.below ? range.lower : range.upper) = slab.at;
    const double share = rest.share * (1.0 - (range.upper - range.lower) / width);
    done_ += share;
    rest.share -= share;
  }

  void split(const OpenBox& rest, int variable) {
    const Interval& range = rest.box[index(variable)];
    const double middle = 0.5 * (range.lower + range.upper);
    constexpr double smallest = 1e-12;
    if (range.upper - range.lower < smallest * (1.0 + std::abs(middle))) {
      exhausted_ = true;
      return;
    }
    ++result_.counts.split;
    open_halves(rest, rest.box, rest.share, variable, middle);
  }

  void count(const Exclusion& exclusion) {
    BoxCounts& counts = result_.counts;
    switch (exclusion.kind) {
      case CertificateKind::limit:
        ++counts.limits;
        break;
      case CertificateKind::conditioning:
        ++counts.conditioning;
        break;
      case CertificateKind::combination:
        ++(exclusion.bound > 0.0 ? counts.combinations : counts.infeasible);
        break;
      case CertificateKind::legs_alike:
      case CertificateKind::mirrored_in_x:
      case CertificateKind::mirrored_in_y:
        ++counts.alike;
        break;
      case CertificateKind::split:
        break;
    }
  }

  /// Searches on from the boxes of a batch where the best designs may be; after failures less and less often.
  void look_for_designs(const std::vector<Examination>& examined) {
    if (++batches_ < next_search_) return;
    std::vector<const Examination*> promising;
    for (const Examination& one : examined) {
      if (one.exclusion.kind == CertificateKind::combination && one.exclusion.bound > target()) {
        promising.push_back(&one);
      }
    }
    if (promising.empty()) return;
    constexpr std::size_t starts = 4;
    const std::size_t count = std::min(promising.size(), starts);
    std::partial_sort(promising.begin(), promising.begin() + static_cast<std::ptrdiff_t>(count), promising.end(),
                      [](const Examination* a, const Examination* b) {
                        if (a->exclusion.bound != b->exclusion.bound) return a->exclusion.bound > b->exclusion.bound;
                        return a < b;
                      });
    std::vector<LocalDesign> found(count);
    in_threads(count, options_.threads,
               [&](std::size_t k) { found[k] = ascend(family_, examiner_.peaks(), promising[k]->promising); });
    failures_ = take_best(std::move(found), 1) ? 0 : failures_ + 1;
    constexpr long longest_pause = 32;
    next_search_ = batches_ + std::min(longest_pause, 1L << std::min(failures_, 5L));
  }

  /// Searches from points of a Sobol sequence, spread all over the root box.
  void look_from_everywhere() {
    boost::random::sobol sequence(static_cast<std::size_t>(family_.variables()));
    std::vector<Variables<double>> starts(static_cast<std::size_t>(options_.starts));
    for (Variables<double>& start : starts) {
      for (int i = 0; i < family_.variables(); ++i) {
        const Interval& range = root_[index(i)];
        start[index(i)] = std::lerp(range.lower, range.upper, std::ldexp(static_cast<double>(sequence()), -64));
      }
    }
    std::vector<LocalDesign> found(starts.size());
    in_threads(starts.size(), options_.threads,
               [&](std::size_t k) { found[k] = ascend(family_, examiner_.peaks(), starts[k]); });
    constexpr std::size_t most = 6;
    take_best(std::move(found), most);
  }

  /// Takes the best of what local searches have found, so many of them. Returns whether one is the best so far.
  bool take_best(std::vector<LocalDesign> found, std::size_t most) {
    std::stable_sort(found.begin(), found.end(),
                     [](const LocalDesign& a, const LocalDesign& b) { return a.merit() < b.merit(); });
    bool better = false;
    for (std::size_t k = 0; k < std::min(found.size(), most); ++k) {
      const double worth = 1.0 / std::sqrt(found[k].squared_condition);
      if (worth > result_.lower + 0.1 * options_.gap) better = take(found[k]) || better;
    }
    return better;
  }

  /// Of the images of a design that are as good, the one with leg 1 left of leg 2, and the base below the workspace.
  Variables<double> usual_image(Variables<double> z) const {
    const auto swap = [&](int one, int other) { std::swap(z[index(one)], z[index(other)]); };
    if (examiner_.legs_alike() && z[index(family_.x_of(0))] > z[index(family_.x_of(1))]) {
      swap(family_.x_of(0), family_.x_of(1));
      swap(family_.y_of(0), family_.y_of(1));
    }
    double& y = z[index(family_.y_of(0))];
    const double centre = task_.prescribed.centre().y();
    if (examiner_.mirrored_in_y() && y > centre) y = centre - (y - centre);
    return z;
  }

  /// Makes better what a local search has found, a little off all limits, and proves what it is worth. Returns whether
  /// it is the best so far.
  bool take(const LocalDesign& found) {
    const Variables<double> z = usual_image(found.z);
    const double margin = options_.gap / 50.0;
    SynthesisTask task = task_;
    task.designs = designs(margin);
    const RefinedOptimum refined = refine_optimum(task, family_.to_design(z));
    if (refined.design[refined.design.size() - 1] * options_.side <= 0.0) return false;
    task.designs = designs(0.0);
    constexpr long most_evaluations = 1'000'000;
    DesignProof proof = prove_design(task, refined.design, {0.0, 0.25 * margin, options_.gap / 40.0, most_evaluations});
    if (proof.reaches != Verdict::proved || proof.kappa_inverse.lower <= result_.lower) return false;
    result_.lower = proof.kappa_inverse.lower;
    result_.design = refined.design;
    result_.proof = std::move(proof);
    return true;
  }

  /// The family with limits that are narrower by a margin on both sides.
  DesignSpace designs(double margin) const {
    std::array<Interval, 3> lengths;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const Interval& own = family_.length(leg);
      lengths[leg] = {own.lower > 0.0 ? own.lower + margin : 0.0, own.upper - margin};
    }
    DesignSpace in_line = DesignSpace::collinear(lengths);
    if (family_.in_line()) return in_line;
    Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(12, 7);
    for (Eigen::Index leg = 0; leg < 3; ++leg) {
      joints(4 * leg, 2 * leg) = 1.0;
      joints(4 * leg + 1, 2 * leg + 1) = 1.0;
    }
    joints.col(6) = in_line.joint_map().col(4);
    return {
        in_line.origin(), {"c_1x", "c_1y", "c_2x", "c_2y", "c_3x", "c_3y", "r"}, joints, Eigen::MatrixXd::Zero(6, 7)};
  }

  /// Of every node, from below: its own bound, or the larger of its children's.
  double bound_of_root() const {
    std::vector<double> bounds(nodes_.size(), 1.0);
    for (std::size_t k = nodes_.size(); k-- > 0;) {
      const GrowingNode& node = nodes_[k];
      if (node.exclusion.kind != CertificateKind::split) bounds[k] = node.exclusion.bound;
      if (node.lower) bounds[k] = std::min(bounds[k], std::max(bounds[*node.lower], bounds[node.upper]));
    }
    return bounds.front();
  }

  GlobalOptimum finish(GlobalStatus status) {
    const double inside = bound_of_root();
    if (status == GlobalStatus::proved && inside == 0.0 && !result_.design) status = GlobalStatus::unreachable;
    result_.upper =
        std::min(1.0, short_number_above(std::max({inside, result_.lower, bound_outside(family_, sizes_)})));
    if (status == GlobalStatus::unreachable) result_.upper = 0.0;
    if (status == GlobalStatus::proved && result_.upper > std::max(result_.lower, options_.known) + options_.gap) {
      status = GlobalStatus::exhausted;
    }
    result_.status = status;
    if (result_.upper < 1.0) keep();
    return std::move(result_);
  }

  /// The part of the tree that proves the bound.
  void keep() {
    BoundCertificate& certificate = result_.certificate;
    for (int i = 0; i < family_.variables(); ++i) certificate.root.push_back(root_[index(i)]);
    const double bound = result_.upper;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, 0}};
    certificate.nodes.emplace_back();
    while (!open.empty()) {
      const auto [from, to] = open.back();
      open.pop_back();
      GrowingNode& node = nodes_[from];
      const bool leaf = !node.lower || (node.exclusion.kind != CertificateKind::split && node.exclusion.bound <= bound);
      if (leaf) {
        certificate.nodes[to].kind = node.exclusion.kind;
        certificate.nodes[to].bound = node.exclusion.bound;
        certificate.nodes[to].terms = std::move(node.exclusion.terms);
        continue;
      }
      const std::size_t lower = certificate.nodes.size();
      certificate.nodes.resize(lower + 2);
      CertificateNode& split = certificate.nodes[to];
      split.variable = node.variable;
      split.at = node.at;
      split.lower = lower;
      split.upper = lower + 1;
      open.emplace_back(*node.lower, lower);
      open.emplace_back(node.upper, lower + 1);
    }
  }

  SynthesisTask task_;
  GlobalOptions options_;
  DesignFamily family_;
  Interval sizes_;
  DesignBox root_;
  BoxExaminer examiner_;
  GlobalOptimum result_;
  std::vector<GrowingNode> nodes_;
  std::priority_queue<OpenBox, std::vector<OpenBox>, LesserBound> open_;
  long made_ = 0;
  long batches_ = 0;
  long next_search_ = 0;  ///< the batch after which a local search is next
  long failures_ = 0;     ///< local searches that found nothing better, one after the other
  double done_ = 0.0;
  bool exhausted_ = false;
};

void check(const GlobalOptions& options) {
  require(options.gap >= 1e-8 && options.gap <= 1.0, "the gap of the bounds", options.gap, "in [1e-8, 1]");
  require(options.known >= 0.0 && options.known <= 1.0, "the known value", options.known, "in [0, 1]");
  require(options.starts >= 0, "the number of starts", options.starts, "at least 0");
  check_search(options.side, options.max_boxes, options.threads, options.sizes);
}

}  // namespace

std::string_view to_string(GlobalStatus status) {
  switch (status) {
    case GlobalStatus::proved:
      return "proved";
    case GlobalStatus::unreachable:
      return "unreachable";
    case GlobalStatus::box_limit:
      return "box limit";
    case GlobalStatus::stopped:
      return "stopped";
    case GlobalStatus::exhausted:
      return "exhausted";
  }
  return "unknown";
}

GlobalOptimum prove_global_optimum(const SynthesisTask& task, const GlobalOptions& options) {
  validate(task);
  check(options);
  return GlobalSearch(task, options).run();
}

}  // namespace reprise
