#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>

#include "counted_problem.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/standard_problems.hpp"

using namespace reprise;
using Eigen::VectorXd;

namespace {

/// sum_i (x_i - 1)^4 + (x_i + x_{i+1} - 2)^2 under x_i x_{i+1} <= 4, with the sparse pattern of a chain. Minimum 0.
Problem chain(Eigen::Index n) {
  Problem problem;
  problem.name = "chain";
  problem.n = n;
  problem.objective = [n](const VectorXd& x) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) sum += std::pow(x[i] - 1.0, 4);
    for (Eigen::Index i = 0; i + 1 < n; ++i) sum += std::pow(x[i] + x[i + 1] - 2.0, 2);
    return sum;
  };
  problem.objective_gradient = [n](const VectorXd& x, VectorXd& gradient) {
    gradient = 4.0 * (x.array() - 1.0).cube();
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      const double slope = 2.0 * (x[i] + x[i + 1] - 2.0);
      gradient[i] += slope;
      gradient[i + 1] += slope;
    }
  };
  problem.inequalities = n - 1;
  problem.inequality = [n](const VectorXd& x, VectorXd& g) {
    g = (x.head(n - 1).array() * x.tail(n - 1).array()) - 4.0;
  };
  problem.inequality_jacobian = [n](const VectorXd& x, SparseMatrix& jacobian) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i + 1 < n; ++i) {
      entries.emplace_back(i, i, x[i + 1]);
      entries.emplace_back(i, i + 1, x[i]);
    }
    jacobian.setFromTriplets(entries.begin(), entries.end());
  };
  problem.lagrangian_hessian = [n](const VectorXd& x, double factor, const VectorXd& lambda, const VectorXd&,
                                   SparseMatrix& hessian) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      const double neighbours = i == 0 || i == n - 1 ? 1.0 : 2.0;
      entries.emplace_back(i, i, factor * (12.0 * std::pow(x[i] - 1.0, 2) + 2.0 * neighbours));
      if (i > 0) entries.emplace_back(i, i - 1, 2.0 * factor + lambda[i - 1]);
    }
    hessian.setFromTriplets(entries.begin(), entries.end());
  };
  return problem;
}

}  // namespace

BOOST_AUTO_TEST_CASE(it_has_a_name_and_takes_equalities) {
  BOOST_TEST(IpoptSolver().name() == "ipopt");
  BOOST_TEST(IpoptSolver().handles_equalities());
}

BOOST_AUTO_TEST_CASE(options_out_of_range_are_refused) {
  const auto refused = [](auto spoil, const std::string& name) {
    IpoptOptions options;
    spoil(options);
    BOOST_CHECK_EXCEPTION(IpoptSolver{options}, std::invalid_argument, [&](const std::invalid_argument& error) {
      return std::string(error.what()).find(name) != std::string::npos;
    });
  };
  refused([](IpoptOptions& o) { o.tolerance = 0.0; }, "tolerance");
  refused([](IpoptOptions& o) { o.tolerance = std::numeric_limits<double>::quiet_NaN(); }, "tolerance");
  refused([](IpoptOptions& o) { o.acceptable_tolerance = 1e-9; }, "acceptable_tolerance");
  refused([](IpoptOptions& o) { o.initial_barrier = 0.0; }, "initial_barrier");
  refused([](IpoptOptions& o) { o.initial_push = 0.0; }, "initial_push");
  refused([](IpoptOptions& o) { o.initial_push = 0.6; }, "initial_push");
  refused([](IpoptOptions& o) { o.max_iterations = 0; }, "max_iterations");
  refused([](IpoptOptions& o) { o.bound_relax_factor = -1e-8; }, "bound_relax_factor");
}

BOOST_AUTO_TEST_CASE(the_hessian_is_used_unless_forbidden) {
  const StandardProblem hs100 = standard_problem("hs100");
  BOOST_TEST(IpoptSolver().minimize(hs100.problem, hs100.start).counts.lagrangian_hessian > 0);
  IpoptOptions first_derivatives;
  first_derivatives.hessian = IpoptHessian::limited_memory;
  BOOST_TEST(IpoptSolver(first_derivatives).minimize(hs100.problem, hs100.start).counts.lagrangian_hessian == 0);
  Options differences;
  differences.derivatives = Derivatives::central;
  BOOST_TEST(IpoptSolver().minimize(hs100.problem, hs100.start, differences).counts.lagrangian_hessian == 0);
}

BOOST_AUTO_TEST_CASE(large_sparse_problems_are_solved_with_their_pattern) {
  const Eigen::Index n = 2000;
  Problem problem = chain(n);
  const Result result = IpoptSolver().minimize(problem, VectorXd::Constant(n, -1.0));
  BOOST_TEST((result.status == Status::converged));
  BOOST_TEST(result.f < 1e-8);
  BOOST_TEST(result.counts.gradient_evaluations() < 100);

  // Every third variable fixed at its optimal value: the pattern shrinks with them.
  problem.lower = VectorXd::Constant(n, -3.0);
  problem.upper = VectorXd::Constant(n, 3.0);
  for (Eigen::Index i = 0; i < n; i += 3) problem.lower[i] = problem.upper[i] = 1.0;
  const Result fixed = IpoptSolver().minimize(problem, VectorXd::Constant(n, -1.0));
  BOOST_TEST((fixed.status == Status::converged));
  BOOST_TEST(fixed.f < 1e-8);
}

BOOST_AUTO_TEST_CASE(a_pattern_that_changes_is_refused) {
  Problem problem = chain(3);
  problem.inequality_jacobian = [](const VectorXd& x, SparseMatrix& jacobian) {
    jacobian.setZero();
    for (int i = 0; i < 2; ++i) {
      if (x[i + 1] != 0.0) jacobian.insert(i, i) = x[i + 1];
      if (x[i] != 0.0) jacobian.insert(i, i + 1) = x[i];
    }
  };
  BOOST_CHECK_THROW(IpoptSolver().minimize(problem, VectorXd::Zero(3)), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(no_function_is_called_outside_the_bounds) {
  StandardProblem hs45 = standard_problem("hs45");
  bool outside = false;
  hs45.problem.objective = [&outside, f = hs45.problem.objective, lower = hs45.problem.lower,
                            upper = hs45.problem.upper](const VectorXd& x) {
    outside = outside || (x.array() < lower.array()).any() || (x.array() > upper.array()).any();
    return f(x);
  };
  BOOST_TEST((IpoptSolver().minimize(hs45.problem, hs45.start).status == Status::converged));
  BOOST_TEST(!outside);
}

BOOST_AUTO_TEST_CASE(any_feasibility_tolerance_can_be_kept) {
  for (const char* name : {"hs10", "hs43", "hs65", "hs100", "hs113"}) {
    const StandardProblem reference = standard_problem(name);
    Options options;
    options.feasibility_tolerance = 1e-12;
    const Result result = IpoptSolver().minimize(reference.problem, reference.start, options);
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST((result.status == Status::converged));
      BOOST_TEST(result.violation <= 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(iterations_are_limited) {
  const StandardProblem hs100 = standard_problem("hs100");
  IpoptOptions options;
  options.max_iterations = 2;
  const Result result = IpoptSolver(options).minimize(hs100.problem, hs100.start);
  BOOST_TEST((result.status == Status::iteration_limit));
  BOOST_TEST(result.solver_code == -1);
}

BOOST_AUTO_TEST_CASE(no_option_file_is_read_or_written) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / fs::path("reprise_test_ipopt");
  const fs::path before = fs::current_path();
  fs::create_directories(folder);
  std::ofstream(folder / "ipopt.opt") << "max_iter 0\n";
  fs::current_path(folder);
  const StandardProblem hs71 = standard_problem("hs71");
  const Result result = IpoptSolver().minimize(hs71.problem, hs71.start);
  fs::current_path(before);
  BOOST_TEST((result.status == Status::converged));
  BOOST_TEST(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
  fs::remove_all(folder);
}

BOOST_AUTO_TEST_CASE(runs_may_be_nested) {
  // The inner problem's minimum x^2 + x is the objective of the outer one: minimum -1/4 at x = -1/2.
  Problem outer;
  outer.name = "outer";
  outer.n = 1;
  outer.objective = [](const VectorXd& x) {
    Problem inner;
    inner.name = "inner";
    inner.n = 1;
    inner.objective = [centre = x[0]](const VectorXd& y) {
      return std::pow(y[0] - centre, 2) + centre * centre + centre;
    };
    return IpoptSolver().minimize(inner, VectorXd::Constant(1, 3.0)).f;
  };
  const Result result = IpoptSolver().minimize(outer, VectorXd::Constant(1, 2.0));
  BOOST_TEST(result.f == -0.25, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(threads_do_not_disturb_each_other) {
  const StandardProblem hs113 = standard_problem("hs113");
  const Result alone = IpoptSolver().minimize(hs113.problem, hs113.start);
  std::vector<Result> results(8);
  std::vector<std::thread> threads;
  for (Result& result : results) {
    threads.emplace_back([&] {
      for (int repetition = 0; repetition < 5; ++repetition) {
        result = IpoptSolver().minimize(hs113.problem, hs113.start);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Result& result : results) {
    BOOST_TEST((result.x == alone.x));
    BOOST_TEST(as_list(result.counts) == as_list(alone.counts), boost::test_tools::per_element());
  }
}
