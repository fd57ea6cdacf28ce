// The part that all solvers share, driven by a solver that does as a test tells it.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "counted_problem.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/parked_exception.hpp"
#include "reprise/optimizers/solver.hpp"

using namespace reprise;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

using Script = std::function<Outcome(Evaluator&, const VectorXd&)>;

class ScriptedSolver : public Solver {
 public:
  explicit ScriptedSolver(Script script, bool without_derivatives = false, bool equalities = true)
      : script_(std::move(script)), without_derivatives_(without_derivatives), equalities_(equalities) {}
  std::string name() const override { return "scripted"; }
  bool handles_equalities() const override { return equalities_; }
  bool derivative_free() const override { return without_derivatives_; }

 private:
  Outcome solve(Evaluator& evaluator, const VectorXd& x0) const override { return script_(evaluator, x0); }

  Script script_;
  bool without_derivatives_, equalities_;
};

Outcome ends_at(const VectorXd& x) { return {x, Status::converged, 0, "done"}; }

/// f = x1^2 + 2 x2^2 + 3 x3^2 + x1 x3, g = (x1 + x2 - 10, x3^2 - 50), h = x1 - x2 x3, with all derivatives.
Problem three_variables() {
  Problem problem;
  problem.name = "three variables";
  // The solver ends as a test tells it, wherever that is.
  problem.smooth = false;
  problem.n = 3;
  problem.objective = [](const VectorXd& x) {
    return x[0] * x[0] + 2.0 * x[1] * x[1] + 3.0 * x[2] * x[2] + x[0] * x[2];
  };
  problem.objective_gradient = [](const VectorXd& x, VectorXd& gradient) {
    gradient << 2.0 * x[0] + x[2], 4.0 * x[1], 6.0 * x[2] + x[0];
  };
  problem.inequalities = 2;
  problem.inequality = [](const VectorXd& x, VectorXd& g) { g << x[0] + x[1] - 10.0, x[2] * x[2] - 50.0; };
  problem.inequality_jacobian = [](const VectorXd& x, SparseMatrix& jacobian) {
    jacobian.setZero();
    jacobian.insert(0, 0) = 1.0;
    jacobian.insert(0, 1) = 1.0;
    jacobian.insert(1, 2) = 2.0 * x[2];
  };
  problem.equalities = 1;
  problem.equality = [](const VectorXd& x, VectorXd& h) { h[0] = x[0] - x[1] * x[2]; };
  problem.equality_jacobian =
      dense_jacobian([](const VectorXd& x, MatrixXd& jacobian) { jacobian << 1.0, -x[2], -x[1]; });
  problem.lagrangian_hessian = [](const VectorXd&, double factor, const VectorXd& lambda, const VectorXd& mu,
                                  SparseMatrix& hessian) {
    hessian.setZero();
    hessian.insert(0, 0) = 2.0 * factor;
    hessian.insert(1, 1) = 4.0 * factor;
    hessian.insert(2, 0) = factor;
    hessian.insert(2, 1) = -mu[0];
    hessian.insert(2, 2) = 6.0 * factor + 2.0 * lambda[1];
  };
  return problem;
}

Problem without_derivatives(Problem problem) {
  problem.objective_gradient = nullptr;
  problem.inequality_jacobian = nullptr;
  problem.equality_jacobian = nullptr;
  problem.lagrangian_hessian = nullptr;
  return problem;
}

void ask_everything(Evaluator& evaluator, const VectorXd& x) {
  evaluator.objective(x);
  evaluator.inequality(x);
  evaluator.equality(x);
  evaluator.objective_gradient(x);
  evaluator.inequality_jacobian(x);
  evaluator.equality_jacobian(x);
}

void check_counts(const Result& result, const CountedProblem& wrapped, std::vector<long> expected) {
  BOOST_TEST(as_list(result.counts) == expected, boost::test_tools::per_element());
  BOOST_TEST(as_list(*wrapped.calls) == expected, boost::test_tools::per_element());
}

const Vector3d start(1, 2, 3);

}  // namespace

BOOST_AUTO_TEST_CASE(asking_twice_costs_once) {
  const CountedProblem wrapped = counted(three_variables());
  const ScriptedSolver solver([](Evaluator& evaluator, const VectorXd& x0) {
    ask_everything(evaluator, x0);
    ask_everything(evaluator, x0);
    evaluator.violation(x0);
    return ends_at(x0);
  });
  check_counts(solver.minimize(wrapped.problem, start), wrapped, {1, 1, 1, 1, 1, 1, 0});
}

BOOST_AUTO_TEST_CASE(the_final_check_is_free_where_the_point_is_known_and_counted_elsewhere) {
  const CountedProblem wrapped = counted(three_variables());
  const VectorXd other = Vector3d(4, 2, 2);
  const Result remembered = ScriptedSolver([&](Evaluator& evaluator, const VectorXd& x0) {
                              ask_everything(evaluator, x0);
                              evaluator.objective(other);
                              return ends_at(x0);
                            }).minimize(wrapped.problem, start);
  // x0 is the best iterate, of which value and violation are kept.
  check_counts(remembered, wrapped, {2, 1, 1, 1, 1, 1, 0});

  const CountedProblem again = counted(three_variables());
  const Result elsewhere = ScriptedSolver([&](Evaluator& evaluator, const VectorXd& x0) {
                             ask_everything(evaluator, x0);
                             return ends_at(other);
                           }).minimize(again.problem, start);
  check_counts(elsewhere, again, {2, 2, 2, 1, 1, 1, 0});
  BOOST_TEST(elsewhere.f == again.problem.objective(other));
}

BOOST_AUTO_TEST_CASE(finite_differences_cost_what_they_must) {
  for (const Derivatives derivatives : {Derivatives::forward, Derivatives::central, Derivatives::automatic}) {
    const CountedProblem wrapped = counted(without_derivatives(three_variables()));
    const ScriptedSolver solver([](Evaluator& evaluator, const VectorXd& x0) {
      ask_everything(evaluator, x0);
      return ends_at(x0);
    });
    Options options;
    options.derivatives = derivatives;
    const Result result = solver.minimize(wrapped.problem, start, options);
    // Where nothing is exact, automatic means central.
    const long points = derivatives == Derivatives::forward ? 1 + 3 : 1 + 2 * 3;
    BOOST_TEST(result.counts.function_evaluations() == points);
    BOOST_TEST(result.counts.gradient_evaluations() == 1);
    BOOST_TEST(as_list(*wrapped.calls) == (std::vector<long>{points, points, points, 0, 0, 0, 0}),
               boost::test_tools::per_element());
    BOOST_TEST(as_list(result.counts) == (std::vector<long>{points, points, points, 1, 1, 1, 0}),
               boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(only_what_is_not_given_is_differenced) {
  Problem problem = three_variables();
  problem.inequality_jacobian = nullptr;
  const CountedProblem wrapped = counted(problem);
  const ScriptedSolver solver([](Evaluator& evaluator, const VectorXd& x0) {
    ask_everything(evaluator, x0);
    return ends_at(x0);
  });
  const Result result = solver.minimize(wrapped.problem, start);
  BOOST_TEST(as_list(*wrapped.calls) == (std::vector<long>{1, 7, 1, 1, 0, 1, 0}), boost::test_tools::per_element());
  BOOST_TEST(result.counts.function_evaluations() == 7);
}

BOOST_AUTO_TEST_CASE(differences_may_be_asked_for_throughout) {
  const CountedProblem wrapped = counted(three_variables());
  Options options;
  options.derivatives = Derivatives::forward;
  ScriptedSolver([](Evaluator& evaluator, const VectorXd& x0) {
    BOOST_TEST(!evaluator.has_hessian());
    ask_everything(evaluator, x0);
    return ends_at(x0);
  }).minimize(wrapped.problem, start, options);
  BOOST_TEST(as_list(*wrapped.calls) == (std::vector<long>{4, 4, 4, 0, 0, 0, 0}), boost::test_tools::per_element());
}

// f = exp(x1) has forward differences wrong by Gamma f''/2 and central ones by Gamma^2 f'''/6.
BOOST_AUTO_TEST_CASE(differences_have_their_order) {
  Problem problem;
  problem.name = "exponential";
  problem.n = 1;
  problem.objective = [](const VectorXd& x) { return std::exp(x[0]); };
  const auto error = [&](Derivatives derivatives, double interval) {
    Options options;
    options.derivatives = derivatives;
    options.difference_step = interval;
    double gradient = 0.0;
    ScriptedSolver([&](Evaluator& evaluator, const VectorXd& x0) {
      gradient = evaluator.objective_gradient(x0)[0];
      return ends_at(x0);
    }).minimize(problem, VectorXd::Zero(1), options);
    return gradient - 1.0;
  };
  BOOST_TEST(error(Derivatives::forward, 1e-3) == 1e-3 / 2.0, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(error(Derivatives::forward, 1e-4) == 1e-4 / 2.0, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(error(Derivatives::central, 1e-2) == 1e-4 / 6.0, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(error(Derivatives::central, 1e-3) == 1e-6 / 6.0, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(differences_agree_with_exact_derivatives) {
  for (const Derivatives derivatives : {Derivatives::forward, Derivatives::central}) {
    Options options;
    options.derivatives = derivatives;
    // sqrt(eps) and eps^(2/3), each with room for the size of the second and third derivatives.
    const double allowed = derivatives == Derivatives::forward ? 1e-6 : 1e-9;
    ScriptedSolver([&](Evaluator& evaluator, const VectorXd& x) {
      const Problem problem = three_variables();
      VectorXd gradient(3);
      SparseMatrix inequality(2, 3);
      SparseMatrix equality(1, 3);
      problem.objective_gradient(x, gradient);
      problem.inequality_jacobian(x, inequality);
      problem.equality_jacobian(x, equality);
      BOOST_TEST((evaluator.objective_gradient(x) - gradient).norm() < allowed);
      BOOST_TEST((MatrixXd(evaluator.inequality_jacobian(x)) - MatrixXd(inequality)).norm() < allowed);
      BOOST_TEST((MatrixXd(evaluator.equality_jacobian(x)) - MatrixXd(equality)).norm() < allowed);
      return ends_at(x);
    }).minimize(three_variables(), start, options);
  }
}

BOOST_AUTO_TEST_CASE(differences_keep_the_bounds) {
  Problem problem = without_derivatives(three_variables());
  problem.lower = Vector3d(1, 0, -infinity);
  problem.upper = Vector3d(5, 2, infinity);
  const auto inside = [lower = problem.lower, upper = problem.upper](const VectorXd& x) {
    BOOST_TEST((x.array() >= lower.array()).all());
    BOOST_TEST((x.array() <= upper.array()).all());
  };
  problem.objective = [inside, inner = problem.objective](const VectorXd& x) {
    inside(x);
    return inner(x);
  };
  for (const Derivatives derivatives : {Derivatives::forward, Derivatives::central}) {
    const CountedProblem wrapped = counted(problem);
    Options options;
    options.derivatives = derivatives;
    ScriptedSolver([](Evaluator& evaluator, const VectorXd& x) {
      const VectorXd exact = Vector3d(2.0 * x[0] + x[2], 4.0 * x[1], 6.0 * x[2] + x[0]);
      BOOST_TEST((evaluator.objective_gradient(x) - exact).norm() < 1e-4);
      return ends_at(x);
    }).minimize(wrapped.problem, start, options);
    // x1 and x2 sit on a bound: a central difference there is one-sided and takes the value at the point itself.
    BOOST_TEST(wrapped.calls->objective == (derivatives == Derivatives::forward ? 1 + 3 : 1 + 1 + 1 + 2));
  }
}

BOOST_AUTO_TEST_CASE(fixed_variables_are_taken_out) {
  Problem problem = three_variables();
  problem.lower = Vector3d(-infinity, 2, -infinity);
  problem.upper = Vector3d(infinity, 2, 5);
  for (const Derivatives derivatives : {Derivatives::automatic, Derivatives::central}) {
    Options options;
    options.derivatives = derivatives;
    const CountedProblem wrapped = counted(problem);
    const Result result =
        ScriptedSolver([&](Evaluator& evaluator, const VectorXd& x) {
          BOOST_TEST(evaluator.n() == 2);
          BOOST_TEST(x[0] == 1.0);
          BOOST_TEST(x[1] == 3.0);
          BOOST_TEST(evaluator.lower()[1] == -infinity);
          BOOST_TEST(evaluator.upper()[1] == 5.0);
          BOOST_TEST(evaluator.objective(x) == 1.0 + 8.0 + 27.0 + 3.0);
          const VectorXd gradient = Vector2d(2.0 + 3.0, 18.0 + 1.0);
          BOOST_TEST((evaluator.objective_gradient(x) - gradient).norm() < 1e-8);
          const MatrixXd inequality{{1.0, 0.0}, {0.0, 6.0}};
          BOOST_TEST((MatrixXd(evaluator.inequality_jacobian(x)) - inequality).norm() < 1e-8);
          const MatrixXd equality{{1.0, -2.0}};
          BOOST_TEST((MatrixXd(evaluator.equality_jacobian(x)) - equality).norm() < 1e-8);
          if (evaluator.has_hessian()) {
            const MatrixXd hessian{{4.0, 0.0}, {2.0, 12.0 + 2.0 * 7.0}};
            BOOST_TEST(
                (MatrixXd(evaluator.lagrangian_hessian(x, 2.0, Vector2d(5, 7), VectorXd::Constant(1, 3.0))) - hessian)
                    .norm() < 1e-12);
          }
          return ends_at(Vector2d(4, 2));
        }).minimize(wrapped.problem, Vector3d(1, -50, 3), options);
    BOOST_TEST((result.x == Vector3d(4, 2, 2)));
    BOOST_TEST((result.history.at(0).x == Vector3d(1, 2, 3)));
    // Differences are taken in the free variables only.
    if (derivatives == Derivatives::central) BOOST_TEST(wrapped.calls->inequality == 1 + 2 * 2 + 1);
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_left_to_do_when_every_variable_is_fixed) {
  const ScriptedSolver never([](Evaluator&, const VectorXd&) -> Outcome { throw std::logic_error("called"); });
  Problem problem = three_variables();
  problem.lower = problem.upper = Vector3d(6, 2, 3);
  const CountedProblem wrapped = counted(problem);
  const Result result = never.minimize(wrapped.problem, Vector3d::Zero());
  BOOST_TEST((result.status == Status::converged));
  BOOST_TEST((result.x == Vector3d(6, 2, 3)));
  BOOST_TEST(result.f == problem.objective(result.x));
  check_counts(result, wrapped, {1, 1, 1, 0, 0, 0, 0});

  problem.lower = problem.upper = Vector3d(1, 2, 3);
  const Result infeasible = never.minimize(problem, Vector3d::Zero());
  BOOST_TEST((infeasible.status == Status::infeasible));
  BOOST_TEST(infeasible.violation == 5.0);

  problem.objective = [](const VectorXd&) { return not_a_number; };
  BOOST_TEST((never.minimize(problem, Vector3d::Zero()).status == Status::numerical_failure));
}

BOOST_AUTO_TEST_CASE(a_start_outside_is_moved_into_the_bounds) {
  Problem problem = three_variables();
  problem.lower = Vector3d(2, -infinity, -1);
  problem.upper = Vector3d(infinity, 1, 1);
  ScriptedSolver([](Evaluator&, const VectorXd& x0) {
    BOOST_TEST((x0 == Vector3d(2, 1, 1)));
    return ends_at(x0);
  }).minimize(problem, start);
}

BOOST_AUTO_TEST_CASE(each_point_with_a_gradient_is_an_iterate) {
  std::vector<long> seen;
  const Observer observer = [&](const Iterate& iterate) {
    seen.push_back(iterate.index);
    return true;
  };
  const ScriptedSolver solver([](Evaluator& evaluator, const VectorXd& x0) {
    evaluator.objective_gradient(x0);
    evaluator.objective(2.0 * x0);  // a trial without a gradient is none
    evaluator.objective_gradient(3.0 * x0);
    evaluator.inequality_jacobian(3.0 * x0);
    return ends_at(3.0 * x0);
  });
  const Result result = solver.minimize(three_variables(), start, {}, observer);
  BOOST_TEST_REQUIRE(result.history.size() == 2);
  BOOST_TEST(seen == (std::vector<long>{0, 1}), boost::test_tools::per_element());
  const Iterate& last = result.history.back();
  BOOST_TEST((last.x == 3.0 * start));
  BOOST_TEST(last.f == three_variables().objective(last.x));
  VectorXd g(2);
  VectorXd h(1);
  three_variables().inequality(last.x, g);
  three_variables().equality(last.x, h);
  BOOST_TEST((last.g == g));
  BOOST_TEST((last.h == h));
  BOOST_TEST(last.violation == largest_violation(three_variables(), last.x));
  BOOST_TEST(last.counts.objective == 3);
  BOOST_TEST(last.counts.objective_gradient == 1);  // its own gradient comes after it

  Options options;
  options.record_history = false;
  BOOST_TEST(solver.minimize(three_variables(), start, options, observer).history.empty());
  BOOST_TEST(seen.size() == 4);
}

BOOST_AUTO_TEST_CASE(without_derivatives_each_point_is_an_iterate) {
  const ScriptedSolver solver(
      [](Evaluator& evaluator, const VectorXd& x0) {
        for (const double factor : {1.0, 2.0, 2.0, 3.0}) evaluator.objective(factor * x0);
        return ends_at(x0);
      },
      true);
  BOOST_TEST(solver.minimize(three_variables(), start).history.size() == 3);
}

BOOST_AUTO_TEST_CASE(the_observer_stops_the_run) {
  for (const bool through_attempt : {false, true}) {
    const ScriptedSolver endless([&](Evaluator& evaluator, const VectorXd& x0) {
      VectorXd x = x0;
      const auto step = [&] { evaluator.objective_gradient(x *= 0.5); };
      ParkedException parked;
      while (through_attempt ? parked.attempt(step) : (step(), true)) {
      }
      BOOST_TEST(!parked.attempt([] { BOOST_ERROR("called after the end"); }));
      parked.rethrow();
      return ends_at(x);
    });
    const Result result =
        endless.minimize(three_variables(), start, {}, [](const Iterate& iterate) { return iterate.index < 4; });
    BOOST_TEST((result.status == Status::stopped));
    BOOST_TEST(result.history.size() == 5);
    BOOST_TEST((result.x == result.history.back().x));
    BOOST_TEST(result.f == result.history.back().f);
  }
}

BOOST_AUTO_TEST_CASE(the_evaluation_limit_holds) {
  for (const long limit : {1, 2, 10, 23}) {
    for (const Derivatives derivatives : {Derivatives::automatic, Derivatives::forward, Derivatives::central}) {
      const CountedProblem wrapped = counted(three_variables());
      Options options;
      options.max_function_evaluations = limit;
      options.derivatives = derivatives;
      const ScriptedSolver endless([](Evaluator& evaluator, const VectorXd& x0) -> Outcome {
        for (VectorXd x = x0;; x *= 0.9) ask_everything(evaluator, x);
      });
      const Result result = endless.minimize(wrapped.problem, start, options);
      BOOST_TEST((result.status == Status::evaluation_limit));
      BOOST_TEST(wrapped.calls->function_evaluations() == limit);
      BOOST_TEST(result.counts.function_evaluations() == limit);
      BOOST_TEST(result.f == three_variables().objective(result.x));
      BOOST_TEST(result.violation == largest_violation(three_variables(), result.x));
    }
  }
}

BOOST_AUTO_TEST_CASE(what_a_function_throws_comes_out) {
  const ScriptedSolver direct([](Evaluator& evaluator, const VectorXd& x0) {
    ask_everything(evaluator, x0);
    evaluator.lagrangian_hessian(x0, 1.0, VectorXd::Ones(2), VectorXd::Ones(1));
    return ends_at(x0);
  });
  const ScriptedSolver attempting([](Evaluator& evaluator, const VectorXd& x0) {
    ParkedException parked;
    parked.attempt([&] {
      ask_everything(evaluator, x0);
      evaluator.lagrangian_hessian(x0, 1.0, VectorXd::Ones(2), VectorXd::Ones(1));
    });
    BOOST_TEST(!parked.attempt([] { throw std::logic_error("a later one"); }));
    parked.rethrow();
    return ends_at(x0);
  });
  const auto thrown = [](auto&&...) -> double { throw Thrown("by a function"); };
  using Spoil = std::function<void(Problem&)>;
  const std::vector<Spoil> all = {[&](Problem& p) { p.objective = thrown; },
                                  [&](Problem& p) { p.inequality = thrown; },
                                  [&](Problem& p) { p.equality = thrown; },
                                  [&](Problem& p) { p.objective_gradient = thrown; },
                                  [&](Problem& p) { p.inequality_jacobian = thrown; },
                                  [&](Problem& p) { p.equality_jacobian = thrown; },
                                  [&](Problem& p) { p.lagrangian_hessian = thrown; }};
  for (const ScriptedSolver& solver : {direct, attempting}) {
    for (const Spoil& spoil : all) {
      Problem problem = three_variables();
      spoil(problem);
      BOOST_CHECK_THROW(solver.minimize(problem, start), Thrown);
    }
    BOOST_CHECK_THROW(solver.minimize(three_variables(), start, {}, [&](const Iterate&) { return thrown() > 0.0; }),
                      Thrown);
  }
}

BOOST_AUTO_TEST_CASE(the_result_is_judged_by_the_problem_itself) {
  const auto judged = [](const Problem& problem, const VectorXd& x) {
    return ScriptedSolver([&](Evaluator&, const VectorXd&) { return ends_at(x); }).minimize(problem, start);
  };
  BOOST_TEST((judged(three_variables(), Vector3d(4, 2, 2)).status == Status::converged));
  const Result infeasible = judged(three_variables(), Vector3d(4.5, 2, 2));
  BOOST_TEST((infeasible.status == Status::infeasible));
  BOOST_TEST(infeasible.violation == 0.5);
  BOOST_TEST(infeasible.message.find("done") == 0);

  Problem bounded = three_variables();
  bounded.upper = Vector3d(3.75, infinity, infinity);
  BOOST_TEST(judged(bounded, Vector3d(4, 2, 2)).violation == 0.25);

  const auto with_objective = [](double value) {
    Problem problem = three_variables();
    problem.objective = [value](const VectorXd&) { return value; };
    return problem;
  };
  const Vector3d feasible(4, 2, 2);
  BOOST_TEST((judged(with_objective(not_a_number), feasible).status == Status::numerical_failure));
  BOOST_TEST((judged(with_objective(infinity), feasible).status == Status::numerical_failure));
  BOOST_TEST((judged(with_objective(-infinity), feasible).status == Status::unbounded));
  Problem undefined = three_variables();
  undefined.inequality = [](const VectorXd&, VectorXd& g) { g << -1.0, not_a_number; };
  const Result undefined_result = judged(undefined, feasible);
  BOOST_TEST((undefined_result.status == Status::numerical_failure));
  BOOST_TEST(std::isnan(undefined_result.violation));

  // A point that is not finite is no result.
  BOOST_TEST((judged(three_variables(), Vector3d(not_a_number, 0, 0)).x == start));
}

BOOST_AUTO_TEST_CASE(the_tolerance_decides_on_feasibility) {
  const Vector3d x(4.0 + 1e-4, 2, 2);
  Options options;
  for (const double tolerance : {1e-3, 1e-5, 0.0}) {
    options.feasibility_tolerance = tolerance;
    const Result result = ScriptedSolver([&](Evaluator&, const VectorXd&) {
                            return ends_at(x);
                          }).minimize(three_variables(), start, options);
    BOOST_TEST((result.status == (tolerance > 1e-4 ? Status::converged : Status::infeasible)));
  }
}

BOOST_AUTO_TEST_CASE(without_a_point_the_best_iterate_counts) {
  const auto best_of = [](std::vector<VectorXd> points) {
    return ScriptedSolver([&](Evaluator& evaluator, const VectorXd&) {
             for (const VectorXd& x : points) evaluator.objective_gradient(x);
             return Outcome{std::nullopt, Status::iteration_limit, 7, "enough"};
           })
        .minimize(three_variables(), start);
  };
  const Vector3d high(4, 2, 2);      // feasible
  const Vector3d low(1, 1, 1);       // feasible and lower
  const Vector3d lowest(0.1, 0, 0);  // lower still, but h = 0.1
  const Vector3d far(9, 0, 0);       // h = 9
  BOOST_TEST((best_of({high, low, lowest}).x == low));
  BOOST_TEST((best_of({lowest, low, high}).x == low));
  BOOST_TEST((best_of({far, lowest, far}).x == lowest));
  BOOST_TEST((best_of({Vector3d(infinity, 0, 0), far}).x == far));
  BOOST_TEST((best_of({}).x == start));
  BOOST_TEST(best_of({low}).solver_code == 7);
  BOOST_TEST((best_of({low}).status == Status::iteration_limit));
}

BOOST_AUTO_TEST_CASE(derivatives_are_checked_before_a_run_if_asked_for) {
  Options options;
  options.check_derivatives = true;
  bool begun = false;
  const ScriptedSolver solver([&](Evaluator& evaluator, const VectorXd& x0) {
    begun = true;
    evaluator.objective_gradient(x0);
    return ends_at(x0);
  });
  const Result right = solver.minimize(three_variables(), start, options);
  BOOST_TEST(begun);
  BOOST_TEST((right.status != Status::wrong_derivative));
  BOOST_TEST(right.counts.objective == 1);  // those of the check are not counted
  BOOST_TEST(right.iterates == 1);

  Problem wrong = three_variables();
  wrong.inequality_jacobian = [original = wrong.inequality_jacobian](const VectorXd& x, SparseMatrix& jacobian) {
    original(x, jacobian);
    jacobian.coeffRef(1, 2) *= 1.001;
  };
  begun = false;
  const Result result = solver.minimize(wrong, start, options);
  BOOST_TEST(!begun);
  BOOST_TEST((result.status == Status::wrong_derivative));
  BOOST_TEST(result.message.find("inequality 2: ") != std::string::npos, result.message);
  BOOST_TEST((result.x == start));
  BOOST_TEST(result.f == wrong.objective(start));
  BOOST_TEST(result.iterates == 0);
  solver.minimize(wrong, start);
  BOOST_TEST(begun);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_before_any_call) {
  const CountedProblem wrapped = counted(three_variables());
  const ScriptedSolver solver([](Evaluator&, const VectorXd& x0) { return ends_at(x0); });
  const auto refused = [&](const VectorXd& x0, const Options& options) {
    BOOST_CHECK_THROW(solver.minimize(wrapped.problem, x0, options), std::invalid_argument);
  };
  refused(Vector2d(1, 2), {});
  refused(Vector3d(1, 2, not_a_number), {});
  refused(Vector3d(1, 2, infinity), {});
  for (const double step : {0.0, -1e-6, infinity, not_a_number}) {
    Options options;
    options.difference_step = step;
    refused(start, options);
  }
  for (const double tolerance : {-1e-9, not_a_number}) {
    Options options;
    options.feasibility_tolerance = tolerance;
    refused(start, options);
  }
  Options options;
  options.max_function_evaluations = 0;
  refused(start, options);
  Problem broken = wrapped.problem;
  broken.n = 0;
  BOOST_CHECK_THROW(solver.minimize(broken, start), std::invalid_argument);

  const ScriptedSolver inequalities_only([](Evaluator&, const VectorXd& x0) { return ends_at(x0); }, false, false);
  BOOST_CHECK_EXCEPTION(inequalities_only.minimize(wrapped.problem, start), std::invalid_argument,
                        [](const std::invalid_argument& error) {
                          return std::string(error.what()).find("scripted takes inequalities only") !=
                                 std::string::npos;
                        });
  BOOST_TEST(as_list(*wrapped.calls) == std::vector<long>(7, 0), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(statuses_have_names) {
  BOOST_TEST(to_string(Status::converged) == "converged");
  BOOST_TEST(to_string(Status::infeasible) == "infeasible");
  BOOST_TEST(to_string(Status::unbounded) == "unbounded");
  BOOST_TEST(to_string(Status::iteration_limit) == "iteration_limit");
  BOOST_TEST(to_string(Status::evaluation_limit) == "evaluation_limit");
  BOOST_TEST(to_string(Status::stopped) == "stopped");
  BOOST_TEST(to_string(Status::numerical_failure) == "numerical_failure");
}
