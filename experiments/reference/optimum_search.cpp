#include "reference/optimum_search.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "reprise/base/in_threads.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/synthesis/optimality_certificate.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/synthesis/semi_infinite.hpp"

namespace reprise::experiments {
namespace {

/// The chapter's designs with r in a range, of either sign. Every design that reaches O' at phi = 0 has its base joints
/// within the longest leg of the platform's joints there; so of those with r in its range none is left out.
DesignSpace boxed_designs(const Lengths& lengths, const Eigen::Vector2d& centre, const Interval& r) {
  const DesignSpace free = DesignSpace::collinear(lengths);
  const double height = std::min({lengths[0].upper, lengths[1].upper, lengths[2].upper});
  Eigen::VectorXd lower(5);
  Eigen::VectorXd upper(5);
  lower << centre.x() - r.upper - lengths[0].upper, centre.y() - height, centre.x() - r.upper - lengths[1].upper,
      centre.x() + r.lower - lengths[2].upper, r.lower;
  upper << centre.x() - r.lower + lengths[0].upper, centre.y() + height, centre.x() - r.lower + lengths[1].upper,
      centre.x() + r.upper + lengths[2].upper, r.upper;
  return {free.manipulator(Eigen::VectorXd::Zero(5)), free.names(), free.joint_map(), free.length_map(), lower, upper};
}

/// Starts: r in its range, each base joint at the platform joint it belongs to at O', within the longest leg.
std::vector<Eigen::VectorXd> make_starts(const SynthesisTask& boxed, const Lengths& lengths, long count) {
  const Eigen::Vector2d centre = boxed.prescribed.centre();
  const Eigen::VectorXd& lower = boxed.designs.lower();
  const Eigen::VectorXd& upper = boxed.designs.upper();
  std::vector<Eigen::VectorXd> starts;
  for (const Eigen::VectorXd& point : sobol_points(count, 5)) {
    const Eigen::VectorXd spread = 2.0 * point.array() - 1.0;
    const double r = lower[4] + point[4] * (upper[4] - lower[4]);
    Eigen::VectorXd start(5);
    start << centre.x() - r + spread[0] * lengths[0].upper, lower[1] + point[1] * (upper[1] - lower[1]),
        centre.x() - r + spread[2] * lengths[1].upper, centre.x() + r + spread[3] * lengths[2].upper, r;
    starts.push_back(start);
  }
  return starts;
}

/// Legs 1 and 2 are alike: a design with C and D exchanged is the same manipulator.
Eigen::VectorXd in_order(Eigen::VectorXd design) {
  if (design.size() == 5 && design[0] > design[2]) std::swap(design[0], design[2]);
  return design;
}

/// From the best on; poor ones last.
void sort_optima(Search& search) {
  std::stable_sort(search.optima.begin(), search.optima.end(), [](const LocalOptimum& a, const LocalOptimum& b) {
    return a.refined != b.refined ? a.refined : a.t > b.t;
  });
}

}  // namespace

std::vector<Eigen::VectorXd> sobol_points(long count, Eigen::Index dimension) {
  boost::random::sobol sequence(static_cast<std::size_t>(dimension));
  sequence.discard(static_cast<boost::uintmax_t>(dimension));
  std::vector<Eigen::VectorXd> points(static_cast<std::size_t>(count), Eigen::VectorXd(dimension));
  for (Eigen::VectorXd& point : points) {
    for (double& entry : point) entry = std::ldexp(static_cast<double>(sequence()), -64);
  }
  return points;
}

IpoptSolver make_ipopt() {
  IpoptOptions options;
  options.tolerance = 1e-11;
  options.acceptable_tolerance = 1e-9;
  options.initial_barrier = 1e-8;
  options.initial_push = 1e-8;
  options.max_iterations = 200;
  return IpoptSolver(options);
}

Search search_globally(const SynthesisTask& task, const std::vector<Eigen::VectorXd>& starts,
                       const SearchSettings& settings) {
  const PointwiseOptions sample{static_cast<int>(settings.sample_points)};
  const Problem problem = pointwise_problem(task, sample);
  const ConstraintExchange slsqp(std::make_shared<NloptSolver>());
  Options options;
  options.feasibility_tolerance = 1e-7;
  options.max_function_evaluations = 3000;
  options.record_history = false;
  std::vector<Result> results(starts.size());
  in_threads(starts.size(), std::max(1U, std::thread::hardware_concurrency()), [&](std::size_t i) {
    results[i] = slsqp.minimize(problem, pointwise_start(task, starts[i], sample), options);
  });

  Search search;
  search.starts = static_cast<long>(starts.size());
  std::vector<LocalOptimum> sampled;
  double best = 0.0;
  const auto join = [](std::vector<LocalOptimum>& optima, LocalOptimum one, double value_tolerance,
                       double design_tolerance) {
    for (LocalOptimum& known : optima) {
      if (std::abs(known.t - one.t) < value_tolerance &&
          (known.design - one.design).cwiseAbs().maxCoeff() < design_tolerance) {
        known.starts += one.starts;
        return;
      }
    }
    optima.push_back(std::move(one));
  };
  for (const Result& result : results) {
    if (result.status != Status::converged) {
      ++search.failed;
      continue;
    }
    const Eigen::VectorXd design = in_order(result.x.head(task.designs.size()));
    join(sampled, {design, design, -result.f, false, 1}, 1e-5, 1e-2);
    best = std::max(best, -result.f);
  }
  const IpoptSolver ipopt = make_ipopt();
  for (LocalOptimum one : sampled) {
    if (one.t > best - worth_refining) {
      const SemiInfiniteResult exchanged = solve_by_exchange(task, one.sampled, ipopt, {.max_rounds = 10});
      one.design = in_order(refine_optimum(task, exchanged.design).design);
      one.refined = true;
    }
    one.t = assess_outline(task, one.design).kappa_inverse;
    join(search.optima, one, one.refined ? same_value : 1e-5, one.refined ? same_design : 1e-2);
  }
  sort_optima(search);
  return search;
}

Search search_both_sides(const SynthesisTask& task, const Lengths& lengths, const SearchSettings& settings) {
  Search both;
  for (const Interval& r :
       {Interval{settings.smallest_r, settings.largest_r}, Interval{-settings.largest_r, -settings.smallest_r}}) {
    SynthesisTask boxed = task;
    boxed.designs = boxed_designs(lengths, task.prescribed.centre(), r);
    const Search side = search_globally(boxed, make_starts(boxed, lengths, settings.starts), settings);
    both.starts += side.starts;
    both.failed += side.failed;
    both.optima.insert(both.optima.end(), side.optima.begin(), side.optima.end());
  }
  sort_optima(both);
  return both;
}

const LocalOptimum& best_of(const SynthesisTask& task, const Search& search) {
  const LocalOptimum* best = nullptr;
  for (const LocalOptimum& one : search.optima) {
    if (!one.refined || assess_outline(task, one.design).violation > 1e-9) continue;
    const auto turned = [](const LocalOptimum& of) { return of.design.size() == 5 && of.design[4] < 0.0; };
    const auto preferred = [&](const LocalOptimum& to) {
      return turned(one) != turned(to) ? turned(to) : one.design[1] < to.design[1];
    };
    if (!best || one.t > best->t + 1e-10 || (one.t > best->t - 1e-10 && preferred(*best))) best = &one;
  }
  if (!best) throw std::runtime_error("No start came to a feasible design.");
  return *best;
}

}  // namespace reprise::experiments
