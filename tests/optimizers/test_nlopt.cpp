#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/optimizers/standard_problems.hpp"

using namespace reprise;
using Eigen::VectorXd;

namespace {

NloptOptions options_of(NloptAlgorithm algorithm) {
  NloptOptions options;
  options.algorithm = algorithm;
  return options;
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_algorithm_has_its_name) {
  BOOST_TEST(NloptSolver().name() == "slsqp");
  BOOST_TEST(NloptSolver(options_of(NloptAlgorithm::slsqp)).name() == "slsqp");
  BOOST_TEST(NloptSolver(options_of(NloptAlgorithm::ccsaq)).name() == "ccsaq");
  BOOST_TEST(NloptSolver(options_of(NloptAlgorithm::mma)).name() == "mma");
  BOOST_TEST(NloptSolver(options_of(NloptAlgorithm::cobyla)).name() == "cobyla");
  BOOST_TEST(NloptSolver(options_of(NloptAlgorithm::isres)).name() == "isres");
  BOOST_TEST(NloptSolver(options_of(NloptAlgorithm::crs2)).name() == "crs2");
  BOOST_TEST(NloptSolver(options_of(NloptAlgorithm::esch)).name() == "esch");
}

BOOST_AUTO_TEST_CASE(equalities_are_for_slsqp_cobyla_and_isres) {
  const StandardProblem hs71 = standard_problem("hs71");
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::slsqp, NloptAlgorithm::cobyla, NloptAlgorithm::isres}) {
    BOOST_TEST(NloptSolver(options_of(algorithm)).handles_equalities());
  }
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::ccsaq, NloptAlgorithm::mma}) {
    const NloptSolver solver(options_of(algorithm));
    BOOST_TEST(!solver.handles_equalities());
    BOOST_CHECK_THROW(solver.minimize(hs71.problem, hs71.start), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_CASE(crs2_and_esch_take_bounds_only) {
  const StandardProblem with_equality = standard_problem("hs71");
  const StandardProblem with_inequalities = standard_problem("hs43");
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::crs2, NloptAlgorithm::esch}) {
    const NloptSolver solver(options_of(algorithm));
    BOOST_TEST(solver.derivative_free());
    BOOST_CHECK_THROW(solver.minimize(with_equality.problem, with_equality.start), std::invalid_argument);
    BOOST_CHECK_THROW(solver.minimize(with_inequalities.problem, with_inequalities.start), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_CASE(options_out_of_range_are_refused) {
  const auto refused = [](auto spoil, const std::string& name) {
    NloptOptions options;
    spoil(options);
    BOOST_CHECK_EXCEPTION(NloptSolver{options}, std::invalid_argument, [&](const std::invalid_argument& error) {
      return std::string(error.what()).find(name) != std::string::npos;
    });
  };
  refused([](NloptOptions& o) { o.xtol_rel = -1e-8; }, "xtol_rel");
  refused([](NloptOptions& o) { o.xtol_abs = std::numeric_limits<double>::quiet_NaN(); }, "xtol_abs");
  refused([](NloptOptions& o) { o.ftol_rel = infinity; }, "ftol_rel");
  refused([](NloptOptions& o) { o.max_iterations = 0; }, "max_iterations");
  refused([](NloptOptions& o) { o.max_iterations = 1L << 40; }, "max_iterations");
  refused([](NloptOptions& o) { o.search_radius = 0.0; }, "search_radius");
  refused([](NloptOptions& o) { o.algorithm = static_cast<NloptAlgorithm>(17); }, "algorithm");
}

BOOST_AUTO_TEST_CASE(iterations_are_limited) {
  const StandardProblem hs100 = standard_problem("hs100");
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::slsqp, NloptAlgorithm::ccsaq, NloptAlgorithm::mma,
                                         NloptAlgorithm::cobyla, NloptAlgorithm::isres}) {
    NloptOptions options = options_of(algorithm);
    options.max_iterations = 5;
    const Result result = NloptSolver(options).minimize(hs100.problem, hs100.start);
    BOOST_TEST((result.status == Status::iteration_limit));
    BOOST_TEST(result.counts.function_evaluations() <= 5 + 1);
  }
}

BOOST_AUTO_TEST_CASE(a_looser_step_costs_less) {
  const StandardProblem hs43 = standard_problem("hs43");
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::slsqp, NloptAlgorithm::mma, NloptAlgorithm::cobyla}) {
    NloptOptions loose = options_of(algorithm);
    loose.xtol_rel = 1e-2;
    // Looked at from outside, a loose end would not do, and the run would go on.
    Options unchecked;
    unchecked.check_stationarity = false;
    const Result quick = NloptSolver(loose).minimize(hs43.problem, hs43.start, unchecked);
    const Result full = NloptSolver(options_of(algorithm)).minimize(hs43.problem, hs43.start, unchecked);
    BOOST_TEST(quick.counts.function_evaluations() < full.counts.function_evaluations());
    BOOST_TEST((quick.x - hs43.optimum).norm() > (full.x - hs43.optimum).norm());
  }
}

// NLopt itself returns SLSQP's lowest feasible point. From here, with a tolerance that its last iterate misses by a
// little, that point has f = 690.6.
BOOST_AUTO_TEST_CASE(slsqp_ends_at_its_last_iterate) {
  const StandardProblem hs100 = standard_problem("hs100");
  const Result result = NloptSolver().minimize(hs100.problem, hs100.start);
  BOOST_TEST((result.status == Status::converged));
  BOOST_TEST((result.x == result.history.back().x));
  BOOST_TEST(result.f == hs100.f_optimum, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(equalities_hold_to_rounding_at_the_end_of_slsqp) {
  const StandardProblem hs78 = standard_problem("hs78");
  BOOST_TEST(NloptSolver().minimize(hs78.problem, hs78.start).violation < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_random_search_can_be_repeated) {
  Problem valley = standard_problem("hs43").problem;
  valley.inequalities = 0;
  valley.inequality = {};
  valley.inequality_jacobian = {};
  valley.lagrangian_hessian = {};
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::isres, NloptAlgorithm::crs2, NloptAlgorithm::esch}) {
    const auto search = [&](unsigned long seed) {
      NloptOptions options = options_of(algorithm);
      options.seed = seed;
      options.max_iterations = 500;
      return NloptSolver(options).minimize(valley, VectorXd::Zero(4));
    };
    const Result first = search(1);
    const Result other = search(2);
    const Result again = search(1);
    BOOST_TEST_REQUIRE(first.history.size() == again.history.size());
    for (std::size_t k = 0; k < first.history.size(); ++k) BOOST_TEST((first.history[k].x == again.history[k].x));
    BOOST_TEST((first.history.back().x != other.history.back().x));
  }
}

BOOST_AUTO_TEST_CASE(a_random_search_stays_in_its_box) {
  Problem problem;
  problem.name = "plane";
  problem.n = 3;
  problem.objective = [](const VectorXd& x) { return x.sum(); };
  problem.lower = Eigen::Vector3d(-1.0, -infinity, -infinity);
  problem.upper = Eigen::Vector3d(infinity, infinity, 2.0);
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::isres, NloptAlgorithm::crs2, NloptAlgorithm::esch}) {
    NloptOptions options = options_of(algorithm);
    options.max_iterations = 2000;
    options.search_radius = 3.0;
    const Eigen::Vector3d start(0.0, 10.0, -5.0);
    const Result result = NloptSolver(options).minimize(problem, start);
    // [-1, 3] x [-20, 40] x [-20, 2].
    for (const Iterate& iterate : result.history) {
      BOOST_TEST((iterate.x.array() >= Eigen::Array3d(-1.0, -20.0, -20.0)).all());
      BOOST_TEST((iterate.x.array() <= Eigen::Array3d(3.0, 40.0, 2.0)).all());
    }
    BOOST_TEST(result.f < -35.0);
  }
}
