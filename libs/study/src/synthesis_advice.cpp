#include "reprise/study/synthesis_advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "reprise/bounds/enclosure.hpp"
#include "reprise/study/reach_search.hpp"
#include "reprise/synthesis/relaxation.hpp"

namespace reprise {

namespace {

/// More legs than this are not tried one by one.
constexpr std::size_t most_single_legs = 8;

/// A change with which a design reaches the workspace.
struct Change {
  Relaxation relaxation;
  double amount;           ///< a length of the file, or a share
  SynthesisTask task;      ///< changed, in the file's unit
  Eigen::VectorXd design;  ///< of it, in the file's unit
};

bool is_share(RelaxationKind kind) { return kind == RelaxationKind::workspace || kind == RelaxationKind::orientations; }

/// The next number of four digits that is not below.
double rounded_up(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 3.0);
  return std::ceil(value / digit) * digit;
}

/// Whether the design reaches the whole workspace, proved.
bool is_proved(const SynthesisTask& task, const Eigen::VectorXd& design) {
  const Manipulator manipulator = task.designs.manipulator(design);
  return std::all_of(task.orientations.begin(), task.orientations.end(), [&](const OrientationRange& range) {
    return prove_containment(manipulator, task.prescribed, range).verdict == Verdict::proved;
  });
}

/// Goes through relaxations from the same starts.
class Search {
 public:
  Search(const ScaledProblem& scaled, std::vector<Eigen::VectorXd> starts, const std::function<bool()>& stop)
      : scaled_(scaled), starts_(std::move(starts)) {
    options_.stop = stop;
  }

  /// The least change found, a little more than it so that the numbers stated are round and the design has some room,
  /// with its proof. None where no start leads to a design, and where none could be proved.
  std::optional<Change> find(const Relaxation& relaxation) {
    if (largest_amount(scaled_.task, relaxation) == 0.0) return std::nullopt;
    LeastRelaxation best;
    for (const Eigen::VectorXd& start : starts_) {
      if (options_.stop && options_.stop()) break;
      LeastRelaxation one = find_least_relaxation(scaled_.task, relaxation, start, reach_solver(), options_);
      evaluations_ += one.cost.evaluations;
      if (one.found && (!best.found || one.amount < best.amount)) best = std::move(one);
    }
    if (!best.found) return without_minimum_length(relaxation);
    for (const double room : {1e-6, 1e-3, 1e-2}) {
      const double amount = stated(relaxation.kind, best.amount, room);
      if (amount > largest_amount(scaled_.own, relaxation)) return std::nullopt;
      const double in_units = is_share(relaxation.kind) ? amount : amount / scaled_.unit;
      // The design that is farthest from all limits.
      ReachOptions options = options_;
      options.enough = -std::numeric_limits<double>::infinity();
      const LeastViolation farthest =
          find_least_violation(relax(scaled_.task, relaxation, in_units), best.design, reach_solver(), options);
      evaluations_ += farthest.cost.evaluations;
      Change change{relaxation, amount, relax(scaled_.own, relaxation, amount), farthest.design * scaled_.unit};
      if (is_proved(change.task, change.design)) return change;
    }
    return std::nullopt;
  }

  long evaluations() const { return evaluations_; }

 private:
  /// The change that takes the smallest minimum length away, from the first start.
  std::optional<Change> without_minimum_length(const Relaxation& relaxation) {
    if (relaxation.kind != RelaxationKind::minimum_lengths || (options_.stop && options_.stop())) return std::nullopt;
    const SynthesisTask task = relax(scaled_.task, relaxation, smallest_minimum_length(scaled_.task, relaxation));
    const LeastViolation least = find_least_violation(task, starts_.front(), reach_solver(), options_);
    evaluations_ += least.cost.evaluations;
    if (!reaches(least)) return std::nullopt;
    const double amount = smallest_minimum_length(scaled_.own, relaxation);
    Change change{relaxation, amount, relax(scaled_.own, relaxation, amount), least.design * scaled_.unit};
    return is_proved(change.task, change.design) ? std::optional(std::move(change)) : std::nullopt;
  }

  /// The amount that is stated in place of the least one: lengths with four digits, shares with three.
  double stated(RelaxationKind kind, double least, double room) const {
    if (!is_share(kind)) return rounded_up((least + room) * scaled_.unit);
    return 1.0 - std::max(0.0, std::floor((1.0 - least - room) * 1000.0) / 1000.0);
  }

  const ScaledProblem& scaled_;
  std::vector<Eigen::VectorXd> starts_;
  ReachOptions options_;
  long evaluations_ = 0;
};

const char* name_of(RelaxationKind kind) {
  switch (kind) {
    case RelaxationKind::lengths:
      return "lengths";
    case RelaxationKind::maximum_lengths:
      return "maximum_lengths";
    case RelaxationKind::minimum_lengths:
      return "minimum_lengths";
    case RelaxationKind::workspace:
      return "workspace";
    case RelaxationKind::orientations:
      return "orientations";
    case RelaxationKind::bounds:
      return "bounds";
  }
  return "";
}

/// Which limits give: "all maximum lengths", "the maximum length of leg 2".
std::string subject_of(const Relaxation& relaxation) {
  const bool maximum = relaxation.kind == RelaxationKind::maximum_lengths;
  const std::string which = maximum ? "maximum" : "minimum";
  return relaxation.leg ? fmt::format("the {} length of leg {}", which, *relaxation.leg + 1)
                        : fmt::format("all {} lengths", which);
}

std::string plain(const Relaxation& relaxation) {
  switch (relaxation.kind) {
    case RelaxationKind::lengths:
      return relaxation.leg ? fmt::format("both lengths of leg {}", *relaxation.leg + 1) : "all lengths";
    case RelaxationKind::maximum_lengths:
    case RelaxationKind::minimum_lengths:
      return subject_of(relaxation);
    case RelaxationKind::workspace:
      return "the size of the workspace";
    case RelaxationKind::orientations:
      return "the orientations";
    case RelaxationKind::bounds:
      return "the bounds of the joints";
  }
  return "";
}

/// The length limits before and after, where all legs that give have the same ones, and no design variable moves them.
std::optional<std::pair<Interval, Interval>> common_lengths(const SynthesisTask& before, const Change& change) {
  if (!before.designs.length_map().isZero(0.0)) return std::nullopt;
  const std::vector<Leg>& old_legs = before.designs.origin().legs();
  const std::vector<Leg>& new_legs = change.task.designs.origin().legs();
  const std::size_t first = change.relaxation.leg.value_or(0);
  for (std::size_t i = 0; i < old_legs.size() && !change.relaxation.leg; ++i) {
    const Interval& limits = old_legs[i].length;
    if (limits.lower != old_legs[first].length.lower || limits.upper != old_legs[first].length.upper) {
      return std::nullopt;
    }
  }
  return std::pair(old_legs[first].length, new_legs[first].length);
}

/// A line without its end.
std::string sentence(const SynthesisTask& before, const Change& change) {
  const std::string by = short_number(change.amount);
  switch (change.relaxation.kind) {
    case RelaxationKind::lengths:
    case RelaxationKind::maximum_lengths:
    case RelaxationKind::minimum_lengths: {
      const auto lengths = common_lengths(before, change);
      const RelaxationKind kind = change.relaxation.kind;
      if (kind == RelaxationKind::lengths) {
        if (!lengths) return fmt::format("all minimum lengths smaller and all maximum lengths greater by {}", by);
        return fmt::format("lengths from {} to {} instead of {} to {}, for every leg",
                           short_number(lengths->second.lower), short_number(lengths->second.upper),
                           short_number(lengths->first.lower), short_number(lengths->first.upper));
      }
      const bool maximum = kind == RelaxationKind::maximum_lengths;
      if (!lengths)
        return fmt::format("{} {} by {}", subject_of(change.relaxation), maximum ? "greater" : "smaller", by);
      return fmt::format("{} {} instead of {}", subject_of(change.relaxation),
                         short_number(maximum ? lengths->second.upper : lengths->second.lower),
                         short_number(maximum ? lengths->first.upper : lengths->first.lower));
    }
    case RelaxationKind::workspace:
      return fmt::format("a workspace of {} % of its size, about its centre",
                         short_number(100.0 * (1.0 - change.amount)));
    case RelaxationKind::orientations: {
      std::vector<std::string> ranges;
      for (const OrientationRange& range : change.task.orientations) {
        const std::string lower = short_number(range.lower / degree);
        ranges.push_back(range.is_slice() ? lower
                                          : fmt::format("from {} to {}", lower, short_number(range.upper / degree)));
      }
      return fmt::format("orientations {} degrees", fmt::join(ranges, ", "));
    }
    case RelaxationKind::bounds:
      return fmt::format("bounds of the joints' coordinates that are {} farther out at both ends", by);
  }
  return "";
}

Json to_json(const SynthesisTask& before, const Change& change) {
  const RelaxationKind kind = change.relaxation.kind;
  Json json{{"kind", name_of(kind)},
            {"leg", change.relaxation.leg ? Json(*change.relaxation.leg + 1) : Json()},
            {"amount", is_share(kind) ? Json() : Json(change.amount)},
            {"share", is_share(kind) ? Json(1.0 - change.amount) : Json()},
            {"text", sentence(before, change)},
            {"design", std::vector<double>(change.design.begin(), change.design.end())}};
  return json;
}

std::string pose_text(const LimitAtPose& one, double unit) {
  return fmt::format("{}, at x = {}, y = {}, {} degrees", to_string(one.limit), short_number(one.position.x() * unit),
                     short_number(one.position.y() * unit), short_number(one.orientation / degree));
}

/// What may give: first all legs, then single ones that bind, then the task.
std::vector<Relaxation> candidates(const LeastViolation& least, std::size_t legs) {
  std::vector<Relaxation> all{
      {RelaxationKind::lengths}, {RelaxationKind::maximum_lengths}, {RelaxationKind::minimum_lengths}};
  std::size_t singles = 0;
  for (const LimitAtPose& one : least.binding) {
    if (legs < 2 || singles == most_single_legs) break;
    if (one.limit.kind == LimitKind::maximum_length) all.push_back({RelaxationKind::maximum_lengths, one.limit.leg});
    if (one.limit.kind == LimitKind::minimum_length) all.push_back({RelaxationKind::minimum_lengths, one.limit.leg});
    ++singles;
  }
  for (const RelaxationKind kind : {RelaxationKind::workspace, RelaxationKind::orientations, RelaxationKind::bounds}) {
    all.push_back({kind});
  }
  return all;
}

}  // namespace

Advice advise(const ScaledProblem& scaled, const SynthesisSettings& settings, const SynthesisOutcome& best,
              const std::function<bool()>& stop) {
  std::vector<Eigen::VectorXd> starts = reach_starts(scaled, settings.seed);
  LeastViolation least = search_reach(scaled, best.design, stop);
  long evaluations = least.cost.evaluations;
  for (const Eigen::VectorXd& start : starts) {
    if (stop && stop()) break;
    LeastViolation one = search_reach(scaled, start, stop);
    evaluations += one.cost.evaluations;
    if (one.largest < least.largest) least = std::move(one);
  }

  Advice advice;
  const double unit = scaled.unit;
  Json& json = advice.document;
  const Eigen::VectorXd design = least.design * unit;
  json = {{"violation", std::max(0.0, least.largest) * unit},
          {"design", std::vector<double>(design.begin(), design.end())},
          {"binding", Json::array()},
          {"binding_bounds", Json::array()},
          {"changes", Json::array()},
          {"not_found", Json::array()}};
  if (reaches(least)) {
    advice.text = "\nA design that reaches the workspace exists; more starts, evaluations or points may lead to it.\n";
    json["evaluations"] = evaluations;
    return advice;
  }

  std::string& text = advice.text;
  text = fmt::format("\nNo design was found that reaches the workspace. The least violation found is {}, of\n",
                     short_number(least.largest * unit));
  for (const LimitAtPose& one : least.binding) {
    text += fmt::format("  {}\n", pose_text(one, unit));
    json["binding"].push_back({{"limit", to_string(one.limit)},
                               {"violation", one.value * unit},
                               {"at", to_json(Eigen::Vector2d(one.position * unit))},
                               {"orientation_deg", one.orientation / degree}});
  }
  for (const Eigen::Index j : least.binding_bounds) {
    json["binding_bounds"].push_back(scaled.task.designs.names()[static_cast<std::size_t>(j)]);
  }
  if (!least.binding_bounds.empty()) {
    text += fmt::format("At their bounds there: {}.\n",
                        fmt::join(json["binding_bounds"].get<std::vector<std::string>>(), ", "));
  }

  starts.insert(starts.begin(), least.design);
  Search search(scaled, starts, stop);
  std::vector<std::string> found;
  std::vector<std::string> not_found;
  for (const Relaxation& relaxation : candidates(least, scaled.task.designs.legs())) {
    if (stop && stop()) break;
    if (largest_amount(scaled.task, relaxation) == 0.0) continue;
    if (const std::optional<Change> change = search.find(relaxation)) {
      found.push_back(sentence(scaled.own, *change));
      json["changes"].push_back(to_json(scaled.own, *change));
    } else {
      not_found.push_back(plain(relaxation));
    }
  }
  if (!found.empty()) {
    text += fmt::format(
        "A design exists with {}: proved over the whole workspace and all orientations.\n  {}\n"
        "Each was found by solving that problem from {} starts. The searches are local: smaller changes may do.\n",
        found.size() == 1 ? "this change" : "any one of these changes", fmt::join(found, "\n  "), starts.size());
  }
  if (!not_found.empty()) {
    text += fmt::format("No design was found by changing {} alone.\n", fmt::join(not_found, ", or "));
  }
  json["not_found"] = not_found;
  json["evaluations"] = evaluations + search.evaluations();
  return advice;
}

}  // namespace reprise
