// Every solver on problems of the standard set that it must solve, and on problems that no solver likes.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "counted_problem.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/optimizers/dynamic_q.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/optimizers/standard_problems.hpp"
#include "sample_count.hpp"

using namespace reprise;
using Eigen::VectorXd;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A solver with what may be expected of it.
struct Method {
  std::string name;
  std::shared_ptr<const Solver> solver;
  double f_tolerance;            ///< of |f - f*| / max(1, |f*|)
  double feasibility_tolerance;  ///< handed to the solver
  bool uses_gradients = true;
  bool settles = true;  ///< ends by a test of its own, not by its limit on iterations
};

Method nlopt_method(NloptAlgorithm algorithm, double f_tolerance, double feasibility_tolerance) {
  NloptOptions options;
  options.algorithm = algorithm;
  if (algorithm == NloptAlgorithm::isres) options.max_iterations = 10'000;
  auto solver = std::make_shared<NloptSolver>(options);
  const bool local = algorithm != NloptAlgorithm::isres;
  return {solver->name(), solver, f_tolerance, feasibility_tolerance, local && algorithm != NloptAlgorithm::cobyla,
          local};
}

Method dynamic_q_method(const DynamicQOptions& options) {
  auto solver = std::make_shared<DynamicQ>(options);
  // First-order method; the accuracy it is asked for in this project.
  return {solver->name(), solver, 1e-6, 2e-6};
}

std::vector<Method> methods() {
  IpoptOptions limited_memory;
  limited_memory.hessian = IpoptHessian::limited_memory;
  DynamicQOptions dual;
  dual.subproblem = SubproblemSolver::dual;
  DynamicQOptions safeguarded = dual;
  safeguarded.safeguard.active = true;
  safeguarded.scale_variables = true;
  safeguarded.max_iterations = 2000;
  return {
      // Newton-like methods: a relative step of 1e-8, or optimality conditions to 1e-8.
      nlopt_method(NloptAlgorithm::slsqp, 1e-6, 1e-6),
      {"ipopt, exact Hessian", std::make_shared<IpoptSolver>(), 1e-7, 1e-6},
      {"ipopt, limited memory", std::make_shared<IpoptSolver>(limited_memory), 1e-7, 1e-6},
      // Their dual problem is solved to about the square root of the rounding error only: violations up to 4e-6.
      nlopt_method(NloptAlgorithm::ccsaq, 1e-6, 1e-5),
      nlopt_method(NloptAlgorithm::mma, 1e-6, 1e-5),
      // No derivatives: 4e-6 on hs1, whose valley its linear models see badly.
      nlopt_method(NloptAlgorithm::cobyla, 1e-5, 1e-6),
      // What a random search comes to with ten thousand points.
      nlopt_method(NloptAlgorithm::isres, 1e-2, 1e-6),
      dynamic_q_method({}),
      dynamic_q_method(dual),
      dynamic_q_method(safeguarded),
      // A method around another one; as accurate as that is.
      {"slsqp, constraint exchange", std::make_shared<ConstraintExchange>(std::make_shared<NloptSolver>()), 1e-6, 1e-6},
  };
}

/// In Release all of them; else a few, spread over the list (sample_count.hpp).
std::vector<std::string> scaled(const std::vector<std::string>& names) {
  const std::size_t count = test::scaled(names.size());
  std::vector<std::string> result;
  for (std::size_t k = 1; k <= count; ++k) result.push_back(names[k * names.size() / count - 1]);
  return result;
}

/// Well-behaved problems of every kind. How the solvers do on the whole set, the experiment
/// compare_optimizers_standard_set tells.
std::vector<StandardProblem> reference_problems() {
  std::vector<StandardProblem> result;
  for (const std::string& name : scaled({"beale", "hs1", "hs5", "hs6", "hs10", "hs12", "hs21", "hs28", "hs29", "hs35",
                                         "hs43", "hs45", "hs65", "hs71", "hs76", "hs78", "hs100", "hs113"})) {
    result.push_back(standard_problem(name));
  }
  return result;
}

bool takes(const Method& method, const Problem& problem) {
  return problem.equalities == 0 || method.solver->handles_equalities();
}

/// Whether the method can be expected to solve a well-behaved problem: a random search only where it is small and has
/// no equalities.
bool must_solve(const Method& method, const Problem& problem) {
  return takes(method, problem) && (method.settles || (problem.n <= 3 && problem.equalities == 0));
}

Options options_for(const Method& method) {
  Options options;
  options.feasibility_tolerance = method.feasibility_tolerance;
  return options;
}

/// Runs the method, checks that the result tells the truth about its point and its cost, and returns it.
Result run(const Method& method, const Problem& problem, const VectorXd& start, Options options) {
  const CountedProblem wrapped = counted(problem);
  // The calls of the check from outside are not counted: they are left out where calls are compared.
  const bool check = std::exchange(options.check_stationarity, false);
  Result result = method.solver->minimize(wrapped.problem, start, options);
  BOOST_TEST_MESSAGE(problem.name << ", " << method.name << ": " << to_string(result.status) << ", f " << result.f
                                  << ", violation " << result.violation << ", N_f "
                                  << result.counts.function_evaluations() << ", N_g "
                                  << result.counts.gradient_evaluations() << " (" << result.solver_code << ": "
                                  << result.message << ")");
  if (options.derivatives == Derivatives::automatic) {
    BOOST_TEST(as_list(result.counts) == as_list(*wrapped.calls), boost::test_tools::per_element());
  } else {
    BOOST_TEST(result.counts.function_evaluations() == wrapped.calls->function_evaluations());
  }
  BOOST_TEST(result.counts.objective > 0);
  BOOST_TEST(result.x.size() == problem.n);
  BOOST_TEST(!result.message.empty());
  const double f = problem.objective(result.x);
  const double violation = largest_violation(problem, result.x);
  BOOST_TEST((result.f == f || (std::isnan(result.f) && std::isnan(f))));
  BOOST_TEST((result.violation == violation || (std::isnan(result.violation) && std::isnan(violation))));
  if (result.status == Status::converged) {
    BOOST_TEST(std::isfinite(result.f));
    BOOST_TEST(result.violation <= options.feasibility_tolerance);
    options.check_stationarity = check;
    if (check && kkt_residual(problem, result.x) > largest_kkt_residual) {
      result = method.solver->minimize(problem, start, options);
    }
  }
  return result;
}

Result run(const Method& method, const Problem& problem, const VectorXd& start) {
  return run(method, problem, start, options_for(method));
}

bool is_optimal(const Method& method, const Result& result, double f_optimum) {
  return std::abs(result.f - f_optimum) <= method.f_tolerance * std::max(1.0, std::abs(f_optimum)) &&
         result.violation <= method.feasibility_tolerance;
}

void check_solved(const Method& method, const Result& result, double f_optimum) {
  BOOST_TEST((result.status == Status::converged || (!method.settles && result.status == Status::iteration_limit)),
             "status " << to_string(result.status) << ": " << result.message);
  BOOST_TEST(is_optimal(method, result, f_optimum),
             "f " << result.f << " for " << f_optimum << ", violation " << result.violation);
}

/// Where a method does not solve a problem, and how it then ends.
struct Weakness {
  std::string method, problem;
  Status status;
};
const std::vector<Weakness> weaknesses = {
    // Linear models see little of the curved valley: f is 2e-5.
    {"cobyla", "hs1", Status::iteration_limit},
    // Spherical approximations creep along the curved valley.
    {"dynamic_q", "hs1", Status::iteration_limit},
    {"dynamic_q_dual", "hs1", Status::iteration_limit},
    // SLSQP needs independent gradients; from dependent ones its steps become short.
    {"slsqp", "the same equality twice", Status::converged},
    {"slsqp, constraint exchange", "the same equality twice", Status::converged},
};

const Weakness* weakness(const Method& method, const Problem& problem) {
  for (const Weakness& known : weaknesses) {
    if (known.method == method.name && known.problem == problem.name) return &known;
  }
  return nullptr;
}

/// One variable with f and f'.
Problem one_variable(std::string name, std::function<double(double)> f, std::function<double(double)> derivative) {
  Problem problem;
  problem.name = std::move(name);
  problem.n = 1;
  problem.objective = [f](const VectorXd& x) { return f(x[0]); };
  problem.objective_gradient = [derivative](const VectorXd& x, VectorXd& gradient) { gradient[0] = derivative(x[0]); };
  return problem;
}

/// Adds one inequality of one variable with its derivative.
void add_inequality(Problem& problem, std::function<double(double)> g, std::function<double(double)> derivative) {
  problem.inequalities = 1;
  problem.inequality = [g](const VectorXd& x, VectorXd& value) { value[0] = g(x[0]); };
  problem.inequality_jacobian =
      dense_jacobian([derivative](const VectorXd& x, Eigen::MatrixXd& jacobian) { jacobian(0, 0) = derivative(x[0]); });
}

Problem square(double centre = 0.0) {
  return one_variable(
      "square", [centre](double x) { return (x - centre) * (x - centre); },
      [centre](double x) { return 2.0 * (x - centre); });
}

VectorXd scalar(double value) { return VectorXd::Constant(1, value); }

}  // namespace

BOOST_AUTO_TEST_CASE(reference_problems_are_solved) {
  for (const Method& method : methods()) {
    for (const StandardProblem& reference : reference_problems()) {
      if (!must_solve(method, reference.problem)) continue;
      BOOST_TEST_CONTEXT(method.name << " on " << reference.problem.name) {
        const Result result = run(method, reference.problem, reference.start);
        if (const Weakness* known = weakness(method, reference.problem)) {
          BOOST_TEST((result.status == known->status));
          BOOST_TEST(!is_optimal(method, result, reference.f_optimum), "the weakness is gone: take it off the list");
        } else {
          check_solved(method, result, reference.f_optimum);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_run_leaves_nothing_behind) {
  const StandardProblem first = standard_problem("hs100");
  const StandardProblem other = standard_problem("hs43");
  for (const Method& method : methods()) {
    BOOST_TEST_CONTEXT(method.name) {
      const Result before = run(method, first.problem, first.start);
      run(method, other.problem, other.start);
      const Result after = run(method, first.problem, first.start);
      BOOST_TEST((before.x == after.x));
      BOOST_TEST(as_list(before.counts) == as_list(after.counts), boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_CASE(finite_differences_do_where_derivatives_are_missing) {
  struct Setting {
    Derivatives derivatives;
    double interval;
  };
  // The settings of thesis chapter 5: forward with Gamma = 1e-6, central with Gamma = 1e-3.
  for (const Setting setting : {Setting{Derivatives::forward, 1e-6}, Setting{Derivatives::central, 1e-3}}) {
    for (const Method& method : methods()) {
      for (const std::string& name : scaled({"hs10", "hs12", "hs29", "hs43", "hs65", "hs71", "hs100", "hs78"})) {
        const StandardProblem reference = standard_problem(name);
        if (!takes(method, reference.problem) || weakness(method, reference.problem) || !method.settles) continue;
        BOOST_TEST_CONTEXT(method.name << " on " << name << ", Gamma = " << setting.interval) {
          Options options = options_for(method);
          options.derivatives = setting.derivatives;
          options.difference_step = setting.interval;
          // The error of a forward difference blurs the step in which MMA sees its violation.
          options.feasibility_tolerance = std::max(options.feasibility_tolerance, 1e-5);
          const Result result = run(method, reference.problem, reference.start, options);
          BOOST_TEST(std::abs(result.f - reference.f_optimum) <= 1e-5 * std::max(1.0, std::abs(reference.f_optimum)));
          BOOST_TEST(result.violation <= options.feasibility_tolerance);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_start_at_the_optimum_stays_there) {
  for (const Method& method : methods()) {
    for (const StandardProblem& reference : reference_problems()) {
      if (!must_solve(method, reference.problem)) continue;
      BOOST_TEST_CONTEXT(method.name << " on " << reference.problem.name) {
        check_solved(method, run(method, reference.problem, reference.optimum), reference.f_optimum);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_start_outside_the_bounds_is_no_obstacle) {
  const StandardProblem hs35 = standard_problem("hs35");
  for (const Method& method : methods()) {
    BOOST_TEST_CONTEXT(method.name) {
      check_solved(method, run(method, hs35.problem, VectorXd::Constant(3, -5.0)), hs35.f_optimum);
    }
  }
}

BOOST_AUTO_TEST_CASE(variables_may_be_fixed) {
  // A variable fixed at its optimal value leaves the optimum where it is.
  for (const char* name : {"hs43", "hs71"}) {
    StandardProblem reference = standard_problem(name);
    Problem& problem = reference.problem;
    if (problem.lower.size() == 0) {
      problem.lower = VectorXd::Constant(4, -infinity);
      problem.upper = VectorXd::Constant(4, infinity);
    }
    problem.lower[2] = problem.upper[2] = reference.optimum[2];
    for (const Method& method : methods()) {
      if (!must_solve(method, problem)) continue;
      BOOST_TEST_CONTEXT(method.name << " on " << name) {
        const Result result = run(method, problem, reference.start);
        check_solved(method, result, reference.f_optimum);
        BOOST_TEST(result.x[2] == reference.optimum[2]);
      }
    }
    problem.lower = problem.upper = reference.optimum;
    for (const Method& method : methods()) {
      if (!must_solve(method, problem)) continue;
      BOOST_TEST_CONTEXT(method.name << ", every variable of " << name) {
        const Result result = run(method, problem, reference.start);
        check_solved(method, result, reference.f_optimum);
        BOOST_TEST((result.x == reference.optimum));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(one_variable_is_enough) {
  for (const Method& method : methods()) {
    BOOST_TEST_CONTEXT(method.name) {
      Problem problem = square(2.0);
      check_solved(method, run(method, problem, scalar(-3.0)), 0.0);
      problem.lower = scalar(-4.0);
      problem.upper = scalar(1.0);
      check_solved(method, run(method, problem, scalar(-3.0)), 1.0);
      add_inequality(
          problem, [](double x) { return x * x - 0.25; }, [](double x) { return 2.0 * x; });
      check_solved(method, run(method, problem, scalar(-3.0)), 2.25);
    }
  }
}

BOOST_AUTO_TEST_CASE(infeasible_problems_have_no_solution) {
  Problem gap = square();
  gap.name = "x >= 1 and x <= -1";
  gap.inequalities = 2;
  gap.inequality = [](const VectorXd& x, VectorXd& g) { g << 1.0 - x[0], x[0] + 1.0; };
  gap.inequality_jacobian = dense_jacobian([](const VectorXd&, Eigen::MatrixXd& jacobian) { jacobian << -1.0, 1.0; });
  Problem curved = square(1.0);
  curved.name = "x^2 + 1 <= 0";
  add_inequality(
      curved, [](double x) { return x * x + 1.0; }, [](double x) { return 2.0 * x; });
  Problem outside = square();
  outside.name = "x >= 3 within [-1, 1]";
  outside.lower = scalar(-1.0);
  outside.upper = scalar(1.0);
  add_inequality(
      outside, [](double x) { return 3.0 - x; }, [](double) { return -1.0; });
  StandardProblem equalities = standard_problem("hs28");
  equalities.problem.name = "two parallel planes";
  equalities.problem.equalities = 2;
  equalities.problem.equality = [](const VectorXd& x, VectorXd& h) { h << x.sum() - 1.0, x.sum() - 2.0; };
  equalities.problem.equality_jacobian =
      dense_jacobian([](const VectorXd&, Eigen::MatrixXd& jacobian) { jacobian.setOnes(); });
  equalities.problem.lagrangian_hessian = nullptr;

  for (const Method& method : methods()) {
    for (const Problem& problem : {gap, curved, outside, equalities.problem}) {
      if (!takes(method, problem)) continue;
      BOOST_TEST_CONTEXT(method.name << " on " << problem.name) {
        const Result result = run(method, problem, VectorXd::Constant(problem.n, 0.5));
        BOOST_TEST((result.status == Status::infeasible || result.status == Status::iteration_limit ||
                    result.status == Status::numerical_failure),
                   "status " << to_string(result.status));
        BOOST_TEST(result.violation > method.feasibility_tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(unbounded_problems_are_recognised) {
  const Problem line = one_variable(
      "-x", [](double x) { return -x; }, [](double) { return -1.0; });
  Problem cubic = one_variable(
      "x^3", [](double x) { return x * x * x; }, [](double x) { return 3.0 * x * x; });
  add_inequality(
      cubic, [](double x) { return x - 1.0; }, [](double) { return 1.0; });
  for (const Method& method : methods()) {
    for (const Problem& problem : {line, cubic}) {
      BOOST_TEST_CONTEXT(method.name << " on " << problem.name) {
        Options options = options_for(method);
        options.max_function_evaluations = 300;
        const Result result = run(method, problem, scalar(-1.0), options);
        // Ipopt and Dynamic-Q go on in even steps where the objective is linear, and ISRES stays in its box.
        const bool in_steps = method.name == "dynamic_q" || method.name == "dynamic_q_dual" || method.name == "isres" ||
                              (method.solver->name() == "ipopt" && problem.name == "-x");
        BOOST_TEST((result.status == (in_steps ? Status::evaluation_limit : Status::unbounded)),
                   "status " << to_string(result.status));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_region_without_values_is_no_optimum) {
  // Minimum 1 at x = 1; no value for x < 0, where the first step from 3 may lead.
  const Problem logarithm = one_variable(
      "x - log x", [](double x) { return x - std::log(x); }, [](double x) { return 1.0 - 1.0 / x; });
  // Minimum 2.25 at x = 1.25; the constraint has no value for x < 1.
  Problem root = one_variable(
      "root", [](double x) { return (x + 0.25) * (x + 0.25); }, [](double x) { return 2.0 * (x + 0.25); });
  add_inequality(
      root, [](double x) { return 0.5 - std::sqrt(x - 1.0); }, [](double x) { return -0.5 / std::sqrt(x - 1.0); });
  for (const Method& method : methods()) {
    for (const double start : {3.0, 30.0}) {
      BOOST_TEST_CONTEXT(method.name << " from " << start) {
        const Result first = run(method, logarithm, scalar(start));
        BOOST_TEST((first.status != Status::converged || is_optimal(method, first, 1.0)));
        BOOST_TEST(std::isfinite(first.f));
        const Result second = run(method, root, scalar(start));
        BOOST_TEST((second.status != Status::converged || is_optimal(method, second, 2.25)));
        BOOST_TEST(std::isfinite(second.f));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_not_a_number_is_never_a_success) {
  const auto nan = [](double) { return not_a_number; };
  const auto fails = [](const Method& method, const Problem& problem, double start) {
    BOOST_TEST_CONTEXT(method.name << " on " << problem.name) {
      const Result result = run(method, problem, scalar(start));
      BOOST_TEST((result.status == Status::numerical_failure), "status " << to_string(result.status));
      BOOST_TEST(result.counts.function_evaluations() < 1000);
    }
  };
  for (const Method& method : methods()) {
    fails(method, one_variable("NaN everywhere", nan, nan), 1.0);
    fails(method,
          one_variable(
              "NaN at the start", [](double x) { return std::sqrt(x); }, [](double x) { return 0.5 / std::sqrt(x); }),
          -1.0);
    Problem constraint = square();
    constraint.name = "NaN in a constraint";
    add_inequality(constraint, nan, nan);
    fails(method, constraint, 1.0);
    if (!method.uses_gradients) continue;
    fails(method,
          one_variable(
              "NaN gradient", [](double x) { return x * x; }, nan),
          1.0);
    Problem gradient = square();
    gradient.name = "NaN gradient of a constraint";
    add_inequality(
        gradient, [](double x) { return 0.5 - x; }, nan);
    fails(method, gradient, 1.0);
  }
}

BOOST_AUTO_TEST_CASE(an_exception_comes_out_wherever_it_is_thrown) {
  for (const Method& method : methods()) {
    for (const char* name : {"hs43", "hs71"}) {
      const StandardProblem reference = standard_problem(name);
      if (!takes(method, reference.problem)) continue;
      // Every function in turn, at its first, second and fifth call.
      for (const long call : {1, 2, 5}) {
        std::vector<Problem> spoiled;
        const auto spoil = [&](auto member) {
          Problem problem = reference.problem;
          auto& function = problem.*member;
          if (!function) return;
          auto calls = std::make_shared<long>(0);
          function = [calls, call, inner = function](auto&&... arguments) {
            if (++*calls == call) throw Thrown("as planned");
            BOOST_REQUIRE_MESSAGE(*calls < call, "called again after it threw");
            return inner(std::forward<decltype(arguments)>(arguments)...);
          };
          spoiled.push_back(problem);
        };
        spoil(&Problem::objective);
        spoil(&Problem::inequality);
        spoil(&Problem::equality);
        if (method.uses_gradients) {
          spoil(&Problem::objective_gradient);
          spoil(&Problem::inequality_jacobian);
          spoil(&Problem::equality_jacobian);
        }
        if (method.name == "ipopt, exact Hessian") spoil(&Problem::lagrangian_hessian);
        for (const Problem& problem : spoiled) {
          BOOST_TEST_CONTEXT(method.name << " on " << name << ", call " << call) {
            BOOST_CHECK_THROW(method.solver->minimize(problem, reference.start), Thrown);
          }
        }
        BOOST_TEST_CONTEXT(method.name << ", observer") {
          BOOST_CHECK_THROW(method.solver->minimize(reference.problem, reference.start, {},
                                                    [call](const Iterate& iterate) {
                                                      if (iterate.index + 1 == call) throw Thrown("as planned");
                                                      return true;
                                                    }),
                            Thrown);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_run_can_be_stopped_and_limited) {
  const StandardProblem reference = standard_problem("hs100");
  for (const Method& method : methods()) {
    BOOST_TEST_CONTEXT(method.name) {
      const CountedProblem wrapped = counted(reference.problem);
      const Result stopped = method.solver->minimize(wrapped.problem, reference.start, {},
                                                     [](const Iterate& iterate) { return iterate.index < 3; });
      BOOST_TEST((stopped.status == Status::stopped));
      BOOST_TEST(stopped.history.size() == 4);
      BOOST_TEST(as_list(stopped.counts) == as_list(*wrapped.calls), boost::test_tools::per_element());

      const CountedProblem asked = counted(reference.problem);
      Options asking = options_for(method);
      asking.stop = [calls = asked.calls] { return calls->objective >= 5; };
      const Result ended = method.solver->minimize(asked.problem, reference.start, asking);
      BOOST_TEST((ended.status == Status::stopped));
      BOOST_TEST(ended.counts.objective == 5);
      BOOST_TEST(as_list(ended.counts) == as_list(*asked.calls), boost::test_tools::per_element());
      BOOST_TEST(ended.f == reference.problem.objective(ended.x));

      for (const long limit : {1, 7}) {
        for (const Derivatives derivatives : {Derivatives::automatic, Derivatives::forward}) {
          Options options = options_for(method);
          options.max_function_evaluations = limit;
          options.derivatives = derivatives;
          const Result limited = run(method, reference.problem, reference.start, options);
          BOOST_TEST((limited.status == Status::evaluation_limit));
          BOOST_TEST(limited.counts.function_evaluations() <= limit + 1);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(wrong_gradients_end_somewhere) {
  StandardProblem flipped = standard_problem("hs43");
  flipped.problem.objective_gradient = [right = flipped.problem.objective_gradient](const VectorXd& x,
                                                                                    VectorXd& gradient) {
    right(x, gradient);
    gradient *= -1.0;
  };
  StandardProblem partly = standard_problem("hs100");
  partly.problem.objective_gradient = [right = partly.problem.objective_gradient](const VectorXd& x,
                                                                                  VectorXd& gradient) {
    right(x, gradient);
    gradient[2] += 1.0;
  };
  StandardProblem constraint = standard_problem("hs71");
  constraint.problem.inequality_jacobian = [right = constraint.problem.inequality_jacobian](const VectorXd& x,
                                                                                            SparseMatrix& jacobian) {
    right(x, jacobian);
    jacobian *= -1.0;
  };
  for (const Method& method : methods()) {
    for (const StandardProblem& wrong : {flipped, partly, constraint}) {
      if (!takes(method, wrong.problem)) continue;
      BOOST_TEST_CONTEXT(method.name << " on " << wrong.problem.name) {
        Options options = options_for(method);
        options.max_function_evaluations = 2000;
        run(method, wrong.problem, wrong.start, options);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(equalities_may_be_many_or_say_the_same) {
  StandardProblem twice = standard_problem("hs28");
  twice.problem.name = "the same equality twice";
  twice.problem.equalities = 2;
  twice.problem.equality = [](const VectorXd& x, VectorXd& h) { h.setConstant(x[0] + 2.0 * x[1] + 3.0 * x[2] - 1.0); };
  twice.problem.equality_jacobian =
      dense_jacobian([](const VectorXd&, Eigen::MatrixXd& jacobian) { jacobian << 1.0, 2.0, 3.0, 1.0, 2.0, 3.0; });
  twice.problem.lagrangian_hessian = nullptr;
  Problem many = square(1.0);
  many.name = "more equalities than variables";
  many.equalities = 2;
  many.equality = [](const VectorXd& x, VectorXd& h) { h << x[0] - 2.0, 3.0 * x[0] - 6.0; };
  many.equality_jacobian = dense_jacobian([](const VectorXd&, Eigen::MatrixXd& jacobian) { jacobian << 1.0, 3.0; });
  for (const Method& method : methods()) {
    if (!method.solver->handles_equalities()) {
      BOOST_CHECK_THROW(method.solver->minimize(many, scalar(0.0)), std::invalid_argument);
      continue;
    }
    BOOST_TEST_CONTEXT(method.name) {
      const Result result = run(method, twice.problem, twice.start);
      if (weakness(method, twice.problem)) {
        BOOST_TEST(!is_optimal(method, result, 0.0), "the weakness is gone: take it off the list");
      } else {
        BOOST_TEST((result.status != Status::converged || is_optimal(method, result, 0.0)));
      }
      const Result point = run(method, many, scalar(0.0));
      BOOST_TEST((point.status != Status::converged || is_optimal(method, point, 1.0)));
    }
  }
}
