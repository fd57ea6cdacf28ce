#include "reprise/synthesis/semi_infinite.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/synthesis/constraint_functions.hpp"

namespace reprise {
namespace {

void check_samples(int samples) {
  require(samples >= 8, "the number of samples of the outline", samples, "at least 8");
}

/// The families along the outline at a design, without t.
class Along {
 public:
  Along(const ConstraintFunctions& functions, const Eigen::VectorXd& design)
      : functions_(functions), at_(functions, design) {}

  double value(std::size_t family, double beta) { return at_.value(family, functions_.task().prescribed.point(beta)); }

  /// Where the family is largest in [from, to], in which it is taken to have one maximum and the outline no corner.
  double maximum(std::size_t family, double from, double to) {
    constexpr int half_of_the_digits = std::numeric_limits<double>::digits / 2;
    std::uintmax_t limit = 100;
    double beta = boost::math::tools::brent_find_minima([&](double b) { return -value(family, b); }, from, to,
                                                        half_of_the_digits, limit)
                      .first;
    // Values near a maximum are alike to rounding; the slope tells more. The maximum is known to half of the digits, so
    // a longer step leaves it for another one, and no step may lower the value by more than rounding does.
    constexpr double longest_step = 1e-4;
    constexpr double rounding = 1e-14;
    for (int step = 0; step < 3; ++step) {
      const OutlinePoint u = functions_.task().prescribed.outline(beta);
      const ConstraintDerivatives g = at_.derivatives(family, u.position);
      const auto along_u = g.gradient.tail<2>();
      const double slope = along_u.dot(u.slope);
      const double bend = along_u.dot(u.bend) + u.slope.dot(g.hessian.bottomRightCorner<2, 2>() * u.slope);
      const double next = beta - slope / bend;
      const bool near = bend < 0.0 && next >= from && next <= to && std::abs(next - beta) < longest_step;
      if (!near || value(family, next) < value(family, beta) - rounding) break;
      beta = next;
    }
    return beta;
  }

 private:
  const ConstraintFunctions& functions_;
  ConstraintFunctions::AtDesign at_;
};

/// The directions of an outline's samples with its corners marked.
struct Samples {
  std::vector<double> directions;
  std::vector<bool> corner;

  Samples(const PrescribedWorkspace& prescribed, int count) : directions(prescribed.angles(count)) {
    const std::vector<double>& corners = prescribed.corners();
    for (const double beta : directions) corner.push_back(std::binary_search(corners.begin(), corners.end(), beta));
  }

  std::size_t size() const { return directions.size(); }
  double before(std::size_t i) const { return i == 0 ? directions.back() - full_turn : directions[i - 1]; }
  double after(std::size_t i) const { return i + 1 == size() ? directions.front() + full_turn : directions[i + 1]; }
};

/// Calls highest(family, i) for each sample i at which a family is above the sample before and not below that after. Of
/// a family that is the same all along, such as kappa^-1 = 0 where two legs are one, it is the first sample.
template <class Highest>
void visit_highest(const ConstraintFunctions& functions, Along& along, const Samples& samples, Highest&& highest) {
  std::vector<double> values(samples.size());
  for (std::size_t family = 0; family < functions.families().size(); ++family) {
    for (std::size_t i = 0; i < samples.size(); ++i) values[i] = along.value(family, samples.directions[i]);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double before = values[i == 0 ? samples.size() - 1 : i - 1];
      const double after = values[i + 1 == samples.size() ? 0 : i + 1];
      if (values[i] > before && values[i] >= after) highest(family, i, values[i]);
    }
    if (std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); })) {
      highest(family, std::size_t{0}, values.front());
    }
  }
}

std::vector<Peak> find_peaks(const ConstraintFunctions& functions, const Samples& samples,
                             const Eigen::VectorXd& design, double t) {
  Along along(functions, design);
  std::vector<Peak> peaks;
  visit_highest(functions, along, samples, [&](std::size_t family, std::size_t i, double value) {
    double best = samples.directions[i];
    const auto try_between = [&](double from, double to) {
      const double beta = along.maximum(family, from, to);
      const double there = along.value(family, beta);
      if (there > value) {
        value = there;
        best = beta;
      }
    };
    if (samples.corner[i]) {
      try_between(samples.before(i), best);
      try_between(samples.directions[i], samples.after(i));
    } else {
      try_between(samples.before(i), samples.after(i));
    }
    peaks.push_back({{family, best}, value + (functions.is_conditioning(family) ? t : 0.0)});
  });
  return peaks;
}

double largest(const std::vector<Peak>& peaks) {
  double value = 0.0;
  for (const Peak& peak : peaks) value = std::max(value, peak.value);
  return value;
}

/// The largest t at which a design meets the conditioning.
double smallest_kappa_inverse(const ConstraintFunctions& functions, const std::vector<Peak>& peaks_at_zero) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Peak& peak : peaks_at_zero) {
    if (functions.is_conditioning(peak.constraint.family)) smallest = std::min(smallest, -peak.value);
  }
  return smallest;
}

Eigen::VectorXd with_t(const Eigen::VectorXd& design, double t) {
  Eigen::VectorXd x(design.size() + 1);
  x << design, t;
  return x;
}

std::vector<ConstraintRow> rows_of(const SynthesisTask& task, const std::vector<OutlineConstraint>& constraints) {
  std::vector<ConstraintRow> rows;
  rows.reserve(constraints.size());
  for (const OutlineConstraint& one : constraints) rows.push_back({one.family, task.prescribed.point(one.direction)});
  return rows;
}

/// Both methods: problems of constraints that grow from round to round.
class Rounds {
 public:
  Rounds(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver, int samples)
      : functions_(std::make_shared<const ConstraintFunctions>(task)),
        solver_(solver),
        samples_(task.prescribed, samples),
        result_{design, 0.0, 0.0, Status::iteration_limit, {}, {}, {}, {}} {
    options_.record_history = false;
    // Violations are found between the points, and to a smaller tolerance than the solver's own.
    options_.feasibility_tolerance = ExchangeOptions().violation_tolerance;
    peaks_ = find_peaks(*functions_, samples_, design, 0.0);
    result_.t = smallest_kappa_inverse(*functions_, peaks_);
  }

  const ConstraintFunctions& functions() const { return *functions_; }
  const std::vector<Peak>& peaks() const { return peaks_; }
  SemiInfiniteResult& result() { return result_; }

  void solve() {
    const Problem problem = make_problem(functions_, rows_of(functions_->task(), result_.constraints));
    const Result solved = solver_.minimize(problem, with_t(result_.design, result_.t), options_);
    const Eigen::Index k = result_.design.size();
    result_.design = solved.x.head(k);
    result_.t = solved.x[k];
    result_.status = solved.status;
    result_.message = solved.message;
    result_.counts += solved.counts;
    peaks_ = find_peaks(*functions_, samples_, result_.design, result_.t);
    result_.violation = largest(peaks_);
    result_.rounds.push_back({result_.constraints.size(), result_.t, result_.violation});
  }

 private:
  std::shared_ptr<const ConstraintFunctions> functions_;
  const Solver& solver_;
  Samples samples_;
  Options options_;
  std::vector<Peak> peaks_;  ///< at the result so far
  SemiInfiniteResult result_;
};

std::vector<OutlineConstraint> everywhere(const ConstraintFunctions& functions, const std::vector<double>& directions) {
  std::vector<OutlineConstraint> constraints;
  for (const double beta : directions) {
    for (std::size_t family = 0; family < functions.families().size(); ++family) constraints.push_back({family, beta});
  }
  return constraints;
}

}  // namespace

std::string to_string(const ConstraintFamily& family) {
  const auto degrees = [](double angle) { return angle * 180.0 / pi; };
  std::ostringstream text;
  text.precision(4);
  text << (family.limit ? to_string(*family.limit) : "kappa^-1");
  const auto& [lower, upper] = family.orientations;
  if (lower == upper) {
    text << " at " << degrees(lower) << " deg";
  } else {
    text << " from " << degrees(lower) << " to " << degrees(upper) << " deg";
  }
  return text.str();
}

std::vector<ConstraintFamily> list_families(const SynthesisTask& task) { return ConstraintFunctions(task).families(); }

Problem outline_problem(const SynthesisTask& task, const std::vector<OutlineConstraint>& constraints) {
  auto functions = std::make_shared<const ConstraintFunctions>(task);
  for (const auto& [family, direction] : constraints) {
    require(family < functions->families().size(), "the index of a family of constraints", family,
            "below the number of families");
    require(std::isfinite(direction), "the direction of a constraint", direction, "finite");
  }
  return make_problem(std::move(functions), rows_of(task, constraints));
}

std::vector<Peak> find_peaks(const SynthesisTask& task, const Eigen::VectorXd& design, double t, int samples) {
  check_samples(samples);
  return find_peaks(ConstraintFunctions(task), Samples(task.prescribed, samples), design, t);
}

OutlineAssessment assess_outline(const SynthesisTask& task, const Eigen::VectorXd& design, int samples) {
  check_samples(samples);
  const ConstraintFunctions functions(task);
  const std::vector<Peak> peaks = find_peaks(functions, Samples(task.prescribed, samples), design, 0.0);
  // At t = 0 the conditioning is never violated.
  return {smallest_kappa_inverse(functions, peaks), largest(peaks)};
}

SemiInfiniteResult solve_by_exchange(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                     const ExchangeOptions& options) {
  check_samples(options.samples);
  require(options.first_directions >= 1, "the number of first directions", options.first_directions, "at least 1");
  require(options.violation_tolerance > 0.0, "the violation tolerance", options.violation_tolerance, "positive");
  require(options.max_rounds >= 1, "the limit on rounds", options.max_rounds, "at least 1");
  Rounds rounds(task, design, solver, options.samples);
  SemiInfiniteResult& result = rounds.result();
  result.constraints = everywhere(rounds.functions(), task.prescribed.angles(options.first_directions));
  for (const Peak& peak : rounds.peaks()) result.constraints.push_back(peak.constraint);
  for (int round = 0; round < options.max_rounds; ++round) {
    rounds.solve();
    if (result.violation <= options.violation_tolerance) return result;
    for (const Peak& peak : rounds.peaks()) {
      if (peak.value > options.violation_tolerance) result.constraints.push_back(peak.constraint);
    }
  }
  result.status = Status::iteration_limit;
  result.message = "the limit on rounds of the exchange was reached";
  return result;
}

SemiInfiniteResult solve_discretised(const SynthesisTask& task, const Eigen::VectorXd& design, const Solver& solver,
                                     const DiscretisationOptions& options) {
  require(options.points >= 8, "the number of points", options.points, "at least 8");
  require(options.refinement >= 0, "the number of refining points", options.refinement, "at least 0");
  require(options.margin > 0.0, "the margin of refinement", options.margin, "positive");
  Rounds rounds(task, design, solver, options.points);
  SemiInfiniteResult& result = rounds.result();
  const Samples samples(task.prescribed, options.points);
  result.constraints = everywhere(rounds.functions(), samples.directions);
  rounds.solve();
  if (options.refinement == 0) return result;
  Along along(rounds.functions(), result.design);
  visit_highest(rounds.functions(), along, samples, [&](std::size_t family, std::size_t i, double value) {
    if (value + (rounds.functions().is_conditioning(family) ? result.t : 0.0) < -options.margin) return;
    const auto spread = [&](double from, double to) {
      const int parts = options.refinement / 2 + 1;
      for (int k = 1; k < parts; ++k) result.constraints.push_back({family, from + (to - from) * k / parts});
    };
    spread(samples.before(i), samples.directions[i]);
    spread(samples.directions[i], samples.after(i));
  });
  rounds.solve();
  // Twice the step between the points just added, on either side of each peak.
  const double step = 4.0 * pi / (static_cast<double>(options.points) * options.refinement);
  for (const Peak& peak : rounds.peaks()) {
    if (peak.value < -options.margin) continue;
    const auto& [family, beta] = peak.constraint;
    for (int k = -options.refinement / 2; k <= options.refinement / 2; ++k) {
      const double share = 2.0 * k / options.refinement;  // closer together the nearer to the peak
      result.constraints.push_back({family, beta + 2.0 * step * share * std::abs(share)});
    }
  }
  rounds.solve();
  return result;
}

}  // namespace reprise
