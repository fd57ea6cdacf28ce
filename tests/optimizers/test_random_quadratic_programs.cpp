#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reprise/optimizers/check_derivatives.hpp"
#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/random_quadratic_programs.hpp"

using namespace reprise;
using Eigen::VectorXd;

BOOST_AUTO_TEST_SUITE(random_quadratic_programs)

// f is convex, so that a point is its minimum over the feasible region when no feasible direction leads down from it.
BOOST_AUTO_TEST_CASE(no_feasible_point_is_below_the_optimum) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RandomQuadraticProgram program = random_quadratic_program(seed);
    const Problem& problem = program.problem;
    BOOST_TEST_CONTEXT(problem.name) {
      BOOST_TEST(largest_violation(problem, program.optimum) <= 1e-12);
      BOOST_TEST(program.start.lpNorm<Eigen::Infinity>() <= 5.0);
      BOOST_TEST(check_derivatives(problem, program.start).passed());
      for (std::uint64_t other = 1; other <= 200; ++other) {
        const VectorXd far = random_quadratic_program(1000 * other).optimum;
        VectorXd x = program.optimum;
        for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += 0.01 * far[i % far.size()];
        if (largest_violation(problem, x) == 0.0) BOOST_TEST(problem.objective(x) >= program.f_optimum);
      }
    }
  }
}

// The conditions of optimality hold at the bent optimum, with the value of the straight one, and not at
// the start.
BOOST_AUTO_TEST_CASE(bent_programs_have_the_optimum_of_the_straight_ones) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RandomQuadraticProgram straight = random_quadratic_program(seed);
    const RandomQuadraticProgram bent = bent_quadratic_program(seed);
    const Problem& problem = bent.problem;
    BOOST_TEST_CONTEXT(problem.name) {
      BOOST_TEST(problem.objective(bent.optimum) == straight.f_optimum, boost::test_tools::tolerance(1e-11));
      BOOST_TEST(bent.f_optimum == straight.f_optimum);
      BOOST_TEST(largest_violation(problem, bent.optimum) <= 1e-12);
      BOOST_TEST(kkt_residual(problem, bent.optimum) <= 1e-6);
      if (bent.start != bent.optimum) BOOST_TEST(kkt_residual(problem, bent.start) >= 1e-3);
      BOOST_TEST(check_derivatives(problem, bent.start).passed());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_seed_means_one_program_and_the_factor_is_a_unit) {
  const RandomQuadraticProgram one = random_quadratic_program(7);
  const RandomQuadraticProgram again = random_quadratic_program(7, 1e6);
  BOOST_TEST(one.start == again.start);
  BOOST_TEST(one.optimum == again.optimum);
  BOOST_TEST(again.f_optimum == 1e6 * one.f_optimum, boost::test_tools::tolerance(1e-14));
  BOOST_CHECK_THROW(random_quadratic_program(1, 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(random_quadratic_program(1, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
