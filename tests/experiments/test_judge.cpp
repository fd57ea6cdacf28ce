#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "comparison/judge.hpp"
#include "frame/spread.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/in_threads.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/optimizers/standard_problems.hpp"
#include "reprise/study/solvers.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using namespace reprise::experiments;

namespace {

Iterate iterate(double f, double violation, long gradients, long functions) {
  Iterate result;
  result.f = f;
  result.violation = violation;
  result.counts.objective_gradient = gradients;
  result.counts.objective = functions;
  return result;
}

/// A run towards f* = 2: too high, too low but infeasible, close, closer; then a result that lies elsewhere.
Result example() {
  Result result;
  result.history = {iterate(5.0, 0.0, 0, 1), iterate(1.0, 0.3, 1, 2), iterate(2.01, 1e-8, 2, 5),
                    iterate(2.0001, 0.0, 3, 9)};
  result.f = 2.5;
  result.violation = 0.0;
  result.counts.objective_gradient = 7;
  result.counts.objective = 20;
  result.status = Status::converged;
  return result;
}

double fraction_at(const Table& profiles, const std::string& profile, const std::string& solver, double x) {
  const Table rows = profiles.where("profile", profile).where("solver", solver);
  double fraction = -1.0;
  for (std::size_t row = 0; row < rows.rows() && rows.number(row, "x") <= x; ++row) {
    fraction = rows.number(row, "fraction");
  }
  return fraction;
}

}  // namespace

BOOST_AUTO_TEST_CASE(errors_are_relative_to_large_optima_only) {
  BOOST_TEST(relative_error(110.0, 100.0) == 0.1, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(relative_error(-90.0, -100.0) == 0.1, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(relative_error(0.3, 0.1) == 0.2, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(relative_error(0.0, 0.1) < 0.0);
}

BOOST_AUTO_TEST_CASE(the_first_iterate_that_meets_the_target_counts) {
  const Judgement loose = judge(example(), 2.0, {1e-2, 1e-6});
  BOOST_TEST(loose.solved);
  BOOST_TEST(loose.f == 2.01);
  BOOST_TEST(loose.counts.gradient_evaluations() == 2);
  BOOST_TEST(loose.counts.function_evaluations() == 5);
  const Judgement tight = judge(example(), 2.0, {1e-3, 1e-6});
  BOOST_TEST(tight.counts.gradient_evaluations() == 3);
  BOOST_TEST(!tight.false_success());
  // With a violation of 0.3 allowed, a value below the optimum is as good as any.
  BOOST_TEST(judge(example(), 2.0, {1e-3, 0.5}).f == 1.0);
}

BOOST_AUTO_TEST_CASE(what_meets_no_target_is_judged_by_its_result) {
  Result result = example();
  const Judgement judgement = judge(result, 2.0, {1e-6, 1e-6});
  BOOST_TEST(!judgement.solved);
  BOOST_TEST(judgement.f == 2.5);
  BOOST_TEST(judgement.f_error == 0.25);
  BOOST_TEST(judgement.counts.gradient_evaluations() == 7);
  BOOST_TEST(judgement.false_success());
  result.status = Status::iteration_limit;
  BOOST_TEST(!judge(result, 2.0, {1e-6, 1e-6}).false_success());
  // A result that is no iterate counts with the whole cost.
  result.f = 2.0;
  BOOST_TEST(judge(result, 2.0, {1e-6, 1e-6}).solved);
  BOOST_TEST(judge(result, 2.0, {1e-6, 1e-6}).counts.function_evaluations() == 20);
  result.f = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!judge(result, 2.0, {1e-6, 1e-6}).solved);
}

BOOST_AUTO_TEST_CASE(a_gradient_is_worth_n_function_values) {
  Counts counts;
  counts.objective = 12;
  counts.objective_gradient = 12;
  BOOST_TEST(cost_in_gradients(counts, 5) == 12.0);
  counts.objective_gradient = 0;
  BOOST_TEST(cost_in_gradients(counts, 5) == 2.0);
  // The functions that are called most often count.
  counts.inequality = 18;
  counts.inequality_jacobian = 6;
  BOOST_TEST(cost_in_gradients(counts, 5) == 8.0);
}

BOOST_AUTO_TEST_CASE(profiles_count_the_problems_solved) {
  const Table profiles = compute_profiles("example", {{"all",
                                                       {{"one", "quick", 4.0},
                                                        {"one", "slow", 8.0},
                                                        {"two", "quick", infinity},
                                                        {"two", "slow", 3.0},
                                                        {"three", "quick", 0.5},
                                                        {"three", "slow", infinity},
                                                        {"four", "quick", infinity},
                                                        {"four", "slow", infinity}}}});
  BOOST_TEST(fraction_at(profiles, "data", "quick", 1.0) == 0.25);
  BOOST_TEST(fraction_at(profiles, "data", "quick", 3.9) == 0.25);
  BOOST_TEST(fraction_at(profiles, "data", "quick", 4.0) == 0.5);
  BOOST_TEST(fraction_at(profiles, "data", "slow", 1.0) == 0.0);
  BOOST_TEST(fraction_at(profiles, "data", "slow", 1e6) == 0.5);
  BOOST_TEST(fraction_at(profiles, "performance", "quick", 1.0) == 0.5);
  BOOST_TEST(fraction_at(profiles, "performance", "slow", 1.0) == 0.25);
  BOOST_TEST(fraction_at(profiles, "performance", "slow", 2.0) == 0.5);

  const TemporaryFolder folder;
  draw_profiles(profiles, "data", 100.0).write(folder.path(), "data");
  BOOST_TEST(std::filesystem::file_size(folder.path() / "data.svg") > 0);
}

BOOST_AUTO_TEST_CASE(profiles_from_several_starts_have_a_median_and_a_range) {
  // One problem more is solved from every start, at a cost that doubles.
  std::vector<RunCost> runs;
  for (int start = 0; start < 4; ++start) {
    for (int problem = 0; problem < 4; ++problem) {
      runs.push_back({std::to_string(problem), "solver", problem < start ? std::ldexp(1.0, start) : infinity, start});
    }
  }
  const Table profiles = compute_profiles("example", {{"all", runs}}).where("profile", "data");
  const std::size_t last = profiles.rows() - 1;
  BOOST_TEST(profiles.number(last, "x") == 8.0);
  BOOST_TEST(profiles.number(last, "lowest") == 0.0);
  BOOST_TEST(profiles.number(last, "fraction") == 0.375);
  BOOST_TEST(profiles.number(last, "highest") == 0.75);
  BOOST_TEST(fraction_at(profiles, "data", "solver", 2.0) == 0.0);
  BOOST_TEST(fraction_at(profiles, "data", "solver", 4.0) == 0.125);
}

BOOST_AUTO_TEST_CASE(the_median_of_an_even_count_is_the_mean_of_the_two_in_the_middle) {
  BOOST_TEST(spread_of({4.0, 1.0, 3.0, 2.0}).median == 2.5);
  BOOST_TEST(spread_of({4.0, 1.0, 3.0}).median == 3.0);
  BOOST_TEST(spread_of({4.0, 1.0, 3.0}).lowest == 1.0);
  BOOST_TEST(spread_of({4.0, 1.0, 3.0}).highest == 4.0);
  BOOST_CHECK_THROW(spread_of({}), std::logic_error);
}

// In whatever order they come; 7 k mod n goes through all of 0, ..., n - 1 where 7 does not divide n.
BOOST_AUTO_TEST_CASE(the_spread_of_many_numbers_has_their_ends) {
  for (const int n : {2, 3, 4, 5, 10, 16, 50, 101}) {
    std::vector<double> sorted, mixed;
    for (int k = 0; k < n; ++k) {
      sorted.push_back(k);
      mixed.push_back(7 * k % n);
    }
    for (const std::vector<double>& values : {sorted, mixed}) {
      const Spread spread = spread_of(values);
      BOOST_TEST(spread.lowest == 0.0);
      BOOST_TEST(spread.highest == n - 1.0);
      BOOST_TEST(spread.median == 0.5 * (n - 1.0));
    }
  }
}

BOOST_AUTO_TEST_CASE(starts_are_moved_by_no_more_than_is_asked_for) {
  const Eigen::VectorXd start = (Eigen::VectorXd(4) << 0.0, 1.0, -200.0, 1e-9).finished();
  double largest = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Eigen::VectorXd moved = moved_start(start, 0.01, seed);
    const Eigen::VectorXd parts = (moved - start).cwiseQuotient(start.cwiseAbs().cwiseMax(1.0));
    largest = std::max(largest, parts.lpNorm<Eigen::Infinity>());
    BOOST_TEST((moved == moved_start(start, 0.01, seed)));
    BOOST_TEST((moved != moved_start(start, 0.01, seed + 1)));
  }
  BOOST_TEST(largest <= 0.01 + 1e-15);
  BOOST_TEST(largest > 0.0099);
}

BOOST_AUTO_TEST_CASE(every_part_of_the_work_is_done_once_in_any_number_of_threads) {
  for (const long threads : {1L, 2L, 5L}) {
    std::vector<int> done(100, 0);
    in_threads(done.size(), threads, [&](std::size_t k) { ++done[k]; });
    BOOST_TEST(std::count(done.begin(), done.end(), 1) == 100);
    BOOST_CHECK_THROW(in_threads(10, threads,
                                 [](std::size_t k) {
                                   if (k == 3) throw std::runtime_error("three");
                                 }),
                      std::runtime_error);
  }
}

BOOST_AUTO_TEST_CASE(every_solver_is_found_by_its_name) {
  const std::vector<NamedSolver> all = named_solvers();
  BOOST_TEST(all.size() == solver_names().size());
  for (const NamedSolver& named : all) {
    BOOST_TEST(select_solvers({named.name}, {}).front().name == named.name);
    // Ipopt's own name does not tell its Hessians apart.
    BOOST_TEST(named.name.rfind(named.solver->name(), 0) == 0u, named.name << " is " << named.solver->name());
  }
  BOOST_CHECK_THROW(select_solvers({"nonsense"}, {}), std::logic_error);
}

BOOST_AUTO_TEST_CASE(a_real_run_is_judged) {
  const StandardProblem hs43 = standard_problem("hs43");
  const Result result = NloptSolver().minimize(hs43.problem, hs43.start);
  const Judgement coarse = judge(result, hs43.f_optimum, {1e-2, 1e-1});
  const Judgement fine = judge(result, hs43.f_optimum, {1e-7, 1e-6});
  BOOST_TEST(coarse.solved);
  BOOST_TEST(fine.solved);
  BOOST_TEST(coarse.counts.gradient_evaluations() < fine.counts.gradient_evaluations());
  BOOST_TEST(fine.counts.gradient_evaluations() <= result.counts.gradient_evaluations());
}
