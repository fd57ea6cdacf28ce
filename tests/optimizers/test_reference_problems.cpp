#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "reference_problems.hpp"
#include "reprise/optimizers/check_derivatives.hpp"

using namespace reprise;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Gradient of the objective and, in rows, of the constraints and bounds that hold with equality; multipliers of the
/// inequalities and bounds among them must not be negative.
struct ActiveSet {
  VectorXd gradient;
  MatrixXd rows;
  std::vector<bool> one_sided;
  std::vector<Eigen::Index> inequalities;  ///< the inequality behind a row, -1 for another kind
  std::vector<Eigen::Index> equalities;    ///< the equality behind a row, -1 for another kind
};

ActiveSet active_set(const Problem& problem, const VectorXd& x) {
  constexpr double active = 1e-9;
  ActiveSet set;
  set.gradient.resize(problem.n);
  problem.objective_gradient(x, set.gradient);
  set.rows.resize(0, problem.n);
  const auto add = [&](const VectorXd& row, bool one_sided, Eigen::Index inequality, Eigen::Index equality) {
    set.rows.conservativeResize(set.rows.rows() + 1, Eigen::NoChange);
    set.rows.bottomRows(1) = row.transpose();
    set.one_sided.push_back(one_sided);
    set.inequalities.push_back(inequality);
    set.equalities.push_back(equality);
  };
  if (problem.inequality) {
    VectorXd g(problem.inequalities);
    SparseMatrix jacobian(problem.inequalities, problem.n);
    problem.inequality(x, g);
    problem.inequality_jacobian(x, jacobian);
    for (Eigen::Index j = 0; j < g.size(); ++j) {
      if (g[j] > -active) add(VectorXd(jacobian.row(j)), true, j, -1);
    }
  }
  if (problem.equality) {
    SparseMatrix jacobian(problem.equalities, problem.n);
    problem.equality_jacobian(x, jacobian);
    for (Eigen::Index k = 0; k < problem.equalities; ++k) add(VectorXd(jacobian.row(k)), false, -1, k);
  }
  for (Eigen::Index i = 0; i < problem.n; ++i) {
    const VectorXd unit = VectorXd::Unit(problem.n, i);
    if (problem.lower.size() != 0 && x[i] <= problem.lower[i] + active) add(-unit, true, -1, -1);
    if (problem.upper.size() != 0 && x[i] >= problem.upper[i] - active) add(unit, true, -1, -1);
  }
  return set;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_set_is_well_formed) {
  std::set<std::string> names;
  std::set<std::string> kinds;
  for (const ReferenceProblem& reference : reference_problems()) {
    const Problem& problem = reference.problem;
    BOOST_TEST_CONTEXT(problem.name) {
      validate(problem);
      BOOST_TEST(names.insert(problem.name).second, "the name is unique");
      BOOST_TEST(!reference.source.empty());
      BOOST_TEST(reference.start.size() == problem.n);
      BOOST_TEST(reference.optimum.size() == problem.n);
      BOOST_TEST(reference_problem(problem.name).f_optimum == reference.f_optimum);
      const bool bounded = problem.lower.size() != 0 || problem.upper.size() != 0;
      kinds.insert(std::string(problem.inequality ? "inequalities " : "") + (problem.equality ? "equalities " : "") +
                   (bounded ? "bounds" : ""));
    }
  }
  BOOST_TEST(names.size() >= 12);
  // Unconstrained, each kind of constraint alone, and all of them together.
  for (const char* kind :
       {"", "bounds", "inequalities ", "equalities ", "inequalities bounds", "inequalities equalities bounds"}) {
    BOOST_TEST(kinds.count(kind) == 1, "a problem with: " << kind);
  }
  BOOST_CHECK_THROW(reference_problem("hs0"), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_the_functions) {
  std::mt19937 generator(1981);
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  for (const ReferenceProblem& reference : reference_problems()) {
    BOOST_TEST_CONTEXT(reference.problem.name) {
      VectorXd moved = reference.start;
      for (double& entry : moved) entry += shift(generator);
      for (const VectorXd& x : {reference.start, reference.optimum, moved}) {
        const DerivativeReport report = check_derivatives(reference.problem, x);
        for (const DerivativeCheck& check : report.checks) {
          BOOST_TEST(check.passed, check.function << ": errors " << check.coordinate_error << ", "
                                                  << check.direction_error << ", order " << check.remainder_order);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(optima_are_feasible_and_have_the_stated_value) {
  for (const ReferenceProblem& reference : reference_problems()) {
    BOOST_TEST_CONTEXT(reference.problem.name) {
      const double scale = std::max(1.0, std::abs(reference.f_optimum));
      BOOST_TEST(std::abs(reference.problem.objective(reference.optimum) - reference.f_optimum) <= 1e-13 * scale);
      BOOST_TEST(largest_violation(reference.problem, reference.optimum) <= 1e-12);
    }
  }
}

// Optimality conditions of first order with multipliers of the right sign, and of second order on the tangent space.
BOOST_AUTO_TEST_CASE(optima_satisfy_the_optimality_conditions) {
  for (const ReferenceProblem& reference : reference_problems()) {
    const Problem& problem = reference.problem;
    BOOST_TEST_CONTEXT(problem.name) {
      const ActiveSet set = active_set(problem, reference.optimum);
      const double scale = std::max(1.0, set.gradient.norm());
      const MatrixXd columns = set.rows.transpose();
      VectorXd multipliers(columns.cols());
      MatrixXd tangents = MatrixXd::Identity(problem.n, problem.n);
      if (columns.cols() > 0) {
        const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
        BOOST_TEST_REQUIRE(qr.rank() == columns.cols(), "active gradients are independent");
        multipliers = qr.solve(-set.gradient);
        tangents = MatrixXd(qr.householderQ()).rightCols(problem.n - columns.cols());
      }
      BOOST_TEST((set.gradient + columns * multipliers).norm() <= 1e-12 * scale);
      VectorXd lambda = VectorXd::Zero(problem.inequalities);
      VectorXd mu = VectorXd::Zero(problem.equalities);
      for (std::size_t row = 0; row < set.one_sided.size(); ++row) {
        const double multiplier = multipliers[static_cast<Eigen::Index>(row)];
        if (set.one_sided[row]) BOOST_TEST(multiplier > 0.0);
        if (set.inequalities[row] >= 0) lambda[set.inequalities[row]] = multiplier;
        if (set.equalities[row] >= 0) mu[set.equalities[row]] = multiplier;
      }
      if (tangents.cols() > 0) {
        SparseMatrix lower(problem.n, problem.n);
        problem.lagrangian_hessian(reference.optimum, 1.0, lambda, mu, lower);
        const MatrixXd hessian = MatrixXd(lower).selfadjointView<Eigen::Lower>();
        const MatrixXd reduced = tangents.transpose() * hessian * tangents;
        BOOST_TEST(Eigen::SelfAdjointEigenSolver<MatrixXd>(reduced).eigenvalues().minCoeff() > 1e-3);
      }
    }
  }
}

// As printed by Hock and Schittkowski, whose digits are right to about 2e-9.
BOOST_AUTO_TEST_CASE(optima_agree_with_the_published_ones) {
  const std::map<std::string, double> published = {
      {"hs10", -1.0},         {"hs12", -30.0},      {"hs29", -16.0 * std::sqrt(2.0)}, {"hs43", -44.0},
      {"hs65", 0.9535288567}, {"hs71", 17.0140173}, {"hs76", -4.681818181},           {"hs78", -2.91970041},
      {"hs100", 680.6300573}, {"hs113", 24.3062091}};
  for (const auto& [name, f] : published) {
    BOOST_TEST_CONTEXT(name) { BOOST_TEST(reference_problem(name).f_optimum == f, boost::test_tools::tolerance(2e-9)); }
  }
}
