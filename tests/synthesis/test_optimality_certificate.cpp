#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/bounds/enclosure.hpp"
#include "reprise/optimizers/ipopt.hpp"
#include "reprise/synthesis/optimality_certificate.hpp"
#include "sample_count.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

constexpr double five_degrees = pi / 36.0;

SemiInfiniteResult solve(const SynthesisTask& task, const Eigen::VectorXd& start) {
  IpoptOptions options;
  options.tolerance = 1e-11;
  options.acceptable_tolerance = 1e-9;
  options.initial_barrier = 1e-8;
  options.initial_push = 1e-8;
  return solve_by_exchange(task, start, IpoptSolver(options));
}

Eigen::VectorXd near_so() { return to_vector({-1.116, 0.3, 1.316, 1.9, 0.9}); }
Eigen::VectorXd near_d() { return to_vector({-1.062, 0.2675, 1.3325, 1.7686, 0.868}); }

/// P2, scaled, with length limits moved by the six changes.
SynthesisTask task_with(const std::vector<OrientationRange>& orientations, double scale,
                        const std::array<double, 6>& changes = {}) {
  std::array<Interval, 3> lengths = samples::thesis_lengths();
  for (std::size_t leg = 0; leg < 3; ++leg) {
    lengths[leg].lower += changes[2 * leg];
    lengths[leg].upper += changes[2 * leg + 1];
  }
  return {{"P2", Ellipse{{1.75, 1.0}}, {{1.0, 1.5}, scale, 0.0}},
          orientations,
          DesignSpace::collinear(lengths),
          {Normalisation::printed, {}}};
}

BOOST_AUTO_TEST_SUITE(optimality_certificate)

BOOST_AUTO_TEST_CASE(an_optimum_is_certified_and_its_neighbours_are_not) {
  for (const bool slice : {true, false}) {
    const SynthesisTask task = slice ? task_with(slices({0.0}), 0.2) : task_with({{-five_degrees, five_degrees}}, 0.16);
    const SemiInfiniteResult solved = solve(task, slice ? near_so() : near_d());
    const RefinedOptimum optimum = refine_optimum(task, solved.design);
    BOOST_TEST(optimum.steps > 0);
    BOOST_TEST((optimum.design - solved.design).cwiseAbs().maxCoeff() < 1e-4);
    const OptimalityCertificate certificate = certify_optimality(task, optimum.design);
    BOOST_TEST(certificate.kkt_residual == optimum.kkt_residual);
    BOOST_TEST(std::abs(certificate.kappa_inverse - solved.t) < 1e-9);
    BOOST_TEST(certificate.violation <= 1e-10);
    BOOST_TEST(certificate.kkt_residual < 1e-10);
    BOOST_TEST(certificate.smallest_curvature > 0.0);
    BOOST_TEST(certificate.active.size() >= 3U);
    // The multipliers of kappa^-1 add up to 1: that is the condition's last row, of t.
    double sum = 0.0;
    for (const ActiveConstraint& one : certificate.active) {
      if (!list_families(task)[one.constraint.family].limit) sum += one.multiplier;
    }
    BOOST_TEST(sum == 1.0, tolerance(1e-6));
    for (const Eigen::VectorXd& direction :
         {Eigen::VectorXd(Eigen::VectorXd::Unit(5, 0)), Eigen::VectorXd(-Eigen::VectorXd::Unit(5, 1)),
          Eigen::VectorXd(Eigen::VectorXd::Unit(5, 4))}) {
      double last = certificate.kkt_residual;
      for (const double step : {1e-5, 1e-4, 1e-3, 1e-2}) {
        const double residual = certify_optimality(task, optimum.design + step * direction).kkt_residual;
        BOOST_TEST(residual > last);
        BOOST_TEST(residual <= 1.0);
        last = residual;
      }
    }
  }
}

// The second-order check counts the movement of the peaks. Along every direction of the tangent space the optimum falls
// off: designs at a distance e that are kept feasible lose at least part of curvature * e^2 / 2.
BOOST_AUTO_TEST_CASE(newton_s_method_comes_back_from_a_neighbour) {
  const SynthesisTask task = task_with(slices({0.0}), 0.2);
  const Eigen::VectorXd optimum = refine_optimum(task, solve(task, near_so()).design).design;
  const RefinedOptimum again = refine_optimum(task, optimum + Eigen::VectorXd::Constant(5, 1e-5));
  BOOST_TEST((again.design - optimum).norm() < 1e-10);
  // Where there is nothing near, it stays or makes the residual smaller.
  const RefinedOptimum elsewhere = refine_optimum(task, samples::thesis_start());
  BOOST_TEST(elsewhere.kkt_residual <= certify_optimality(task, samples::thesis_start()).kkt_residual);
}

BOOST_AUTO_TEST_CASE(the_curvature_is_what_the_maximum_loses) {
  const SynthesisTask task = task_with(slices({0.0}), 0.2);
  const Eigen::VectorXd d = solve(task, near_so()).design;
  const OptimalityCertificate certificate = certify_optimality(task, d);
  BOOST_REQUIRE(certificate.tangent_dimension > 0);
  BOOST_REQUIRE(std::isfinite(certificate.smallest_curvature));
  // The Lagrangian with the peaks as they are at d + e v.
  const auto lagrangian = [&](const Eigen::VectorXd& design) {
    double sum = -certificate.kappa_inverse;
    const std::vector<Peak> peaks = find_peaks(task, design, certificate.kappa_inverse, 60);
    for (const ActiveConstraint& one : certificate.active) {
      double nearest = 1e300;
      double value = 0.0;
      for (const Peak& peak : peaks) {
        if (peak.constraint.family != one.constraint.family) continue;
        const double distance =
            std::abs(std::remainder(peak.constraint.direction - one.constraint.direction, 2.0 * pi));
        if (distance < nearest) {
          nearest = distance;
          value = peak.value;
        }
      }
      sum += one.multiplier * value;
    }
    return sum;
  };
  // Its smallest curvature over all directions cannot be above that of the tangent space; sampled over random
  // directions of the tangent space it is not below.
  const double h = 1e-3;
  const double middle = lagrangian(d);
  Eigen::MatrixXd hessian(5, 5);
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = i; j < 5; ++j) {
      const auto at = [&](double a, double b) {
        return lagrangian(d + h * (a * Eigen::VectorXd::Unit(5, i) + b * Eigen::VectorXd::Unit(5, j)));
      };
      hessian(i, j) = i == j ? (at(1, 0) - 2.0 * middle + at(-1, 0)) / (h * h)
                             : (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4.0 * h * h);
      hessian(j, i) = hessian(i, j);
    }
  }
  // Independent derivation of the tangent space: gradients by differences of the peaks' values.
  std::vector<Eigen::VectorXd> gradients;
  for (const ActiveConstraint& one : certificate.active) {
    if (one.multiplier <= 1e-7) continue;
    const Problem problem = outline_problem(task, {one.constraint});
    Eigen::VectorXd gradient(6);
    for (Eigen::Index i = 0; i < 6; ++i) {
      Eigen::VectorXd x(6);
      x << d, certificate.kappa_inverse;
      Eigen::VectorXd above(1);
      Eigen::VectorXd below(1);
      x[i] += 1e-6;
      problem.inequality(x, above);
      x[i] -= 2e-6;
      problem.inequality(x, below);
      gradient[i] = (above[0] - below[0]) / 2e-6;
    }
    gradients.push_back(gradient);
  }
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(gradients.size()), 6);
  for (std::size_t i = 0; i < gradients.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = gradients[i];
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::MatrixXd tangent = svd.matrixV().rightCols(certificate.tangent_dimension);
  BOOST_TEST((rows * tangent).norm() < 1e-6);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(6, 6);
  full.topLeftCorner(5, 5) = hessian;
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tangent.transpose() * full * tangent).eigenvalues();
  BOOST_TEST(certificate.smallest_curvature == values[0], tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(sensitivities_are_the_slopes_of_solved_problems) {
  for (const bool slice : {true, false}) {
    const std::vector<OrientationRange> orientations =
        slice ? slices({0.0}) : std::vector<OrientationRange>{{-five_degrees, five_degrees}};
    const double scale = slice ? 0.2 : 0.16;
    const SynthesisTask task = task_with(orientations, scale);
    const Eigen::VectorXd d = solve(task, slice ? near_so() : near_d()).design;
    const OptimalityCertificate certificate = certify_optimality(task, d);
    const double h = 1e-5;
    for (std::size_t j = 6 - 2 * test::scaled(3u); j < 6; ++j) {
      if (!slice && j != 4) continue;  // an exchange over a range takes long
      // Loosened: a minimum downwards, a maximum upwards.
      std::array<double, 6> change{};
      change[j] = j % 2 == 0 ? -h : h;
      const double looser = solve(task_with(orientations, scale, change), d).t;
      change[j] = -change[j];
      const double tighter = solve(task_with(orientations, scale, change), d).t;
      BOOST_TEST(certificate.limit_sensitivities[j] >= 0.0);
      BOOST_TEST(std::abs((looser - tighter) / (2.0 * h) - certificate.limit_sensitivities[j]) < 1e-3);
    }
    const double larger = solve(task_with(orientations, scale * (1.0 + h)), d).t;
    const double smaller = solve(task_with(orientations, scale * (1.0 - h)), d).t;
    BOOST_TEST(certificate.size_sensitivity < 0.0);
    BOOST_TEST(std::abs((larger - smaller) / (2.0 * h) - certificate.size_sensitivity) < 1e-3);
  }
}

BOOST_AUTO_TEST_CASE(bounds_of_the_design_carry_force) {
  SynthesisTask task = task_with(slices({0.0}), 0.2);
  const double free_r = solve(task, near_so()).design[4];
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(5, std::numeric_limits<double>::infinity());
  upper[4] = free_r - 0.02;
  const DesignSpace space = task.designs;
  task.designs = DesignSpace(space.manipulator(Eigen::VectorXd::Zero(5)), space.names(), space.joint_map(),
                             space.length_map(), {}, upper);
  const SemiInfiniteResult bounded = solve(task, near_so());
  BOOST_TEST(bounded.design[4] == upper[4], tolerance(1e-8));
  const OptimalityCertificate certificate = certify_optimality(task, bounded.design);
  BOOST_TEST(certificate.kkt_residual < 1e-7);
  BOOST_TEST(certificate.bound_multipliers[4] > 1e-6);
  BOOST_TEST(certificate.bound_multipliers.head(4).isZero(0.0));
}

// An optimum moved so that a limit is violated by 1e-5 is found out by first-order conditions and by proof.
BOOST_AUTO_TEST_CASE(a_planted_violation_is_refuted) {
  for (const bool slice : {true, false}) {
    const Interval range = slice ? Interval{0.0, 0.0} : Interval{-five_degrees, five_degrees};
    const SynthesisTask task = task_with({range}, slice ? 0.2 : 0.16);
    Eigen::VectorXd d = solve(task, slice ? near_so() : near_d()).design;
    const auto contained = [&](double allowance) {
      return prove_containment(task.designs.manipulator(d), task.prescribed, range, allowance).verdict;
    };
    BOOST_TEST((contained(1e-8) == Verdict::proved));
    // The lowest and the highest points are the ones at a limit: upwards, a minimum or a maximum is violated.
    d[1] += 1e-5;
    const double violation = assess_outline(task, d).violation;
    BOOST_TEST(violation > 2e-6);
    BOOST_TEST(violation < 1.1e-5);
    BOOST_TEST((contained(1e-8) == Verdict::refuted));
    BOOST_TEST((contained(1.2e-5) == Verdict::proved));
    const MinimumEnclosure minimum =
        enclose_minimum(task.designs.manipulator(d), task.prescribed, range, task.conditioning);
    BOOST_TEST(minimum.reached);
    const double claimed = certify_optimality(task, d).kappa_inverse;
    BOOST_TEST((at_least(minimum, claimed - 1e-6) == Verdict::proved));
    BOOST_TEST((at_least(minimum, claimed + 1e-5) == Verdict::refuted));
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused) {
  const SynthesisTask task = samples::thesis_task();
  BOOST_CHECK_THROW(certify_optimality(task, Eigen::VectorXd::Zero(4)), std::invalid_argument);
  BOOST_CHECK_THROW(certify_optimality(task, near_so(), {.samples = 3}), std::invalid_argument);
  BOOST_CHECK_THROW(certify_optimality(task, near_so(), {.active_tolerance = -1.0}), std::invalid_argument);
  BOOST_CHECK_THROW(certify_optimality(task, near_so(), {.multiplier_tolerance = 0.0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
