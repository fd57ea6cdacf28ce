#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>

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
}

BOOST_AUTO_TEST_CASE(equalities_are_for_slsqp_and_cobyla) {
  const StandardProblem hs71 = standard_problem("hs71");
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::slsqp, NloptAlgorithm::cobyla}) {
    BOOST_TEST(NloptSolver(options_of(algorithm)).handles_equalities());
  }
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::ccsaq, NloptAlgorithm::mma}) {
    const NloptSolver solver(options_of(algorithm));
    BOOST_TEST(!solver.handles_equalities());
    BOOST_CHECK_THROW(solver.minimize(hs71.problem, hs71.start), std::invalid_argument);
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
  refused([](NloptOptions& o) { o.ftol_rel = std::numeric_limits<double>::infinity(); }, "ftol_rel");
  refused([](NloptOptions& o) { o.max_iterations = 0; }, "max_iterations");
  refused([](NloptOptions& o) { o.max_iterations = 1L << 40; }, "max_iterations");
  refused([](NloptOptions& o) { o.algorithm = static_cast<NloptAlgorithm>(17); }, "algorithm");
}

BOOST_AUTO_TEST_CASE(iterations_are_limited) {
  const StandardProblem hs100 = standard_problem("hs100");
  for (const NloptAlgorithm algorithm :
       {NloptAlgorithm::slsqp, NloptAlgorithm::ccsaq, NloptAlgorithm::mma, NloptAlgorithm::cobyla}) {
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
    const Result quick = NloptSolver(loose).minimize(hs43.problem, hs43.start);
    const Result full = NloptSolver(options_of(algorithm)).minimize(hs43.problem, hs43.start);
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
