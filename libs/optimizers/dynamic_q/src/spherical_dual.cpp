#include "reprise/optimizers/spherical_dual.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "reprise/base/require.hpp"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Conditions are met well enough for an answer to this, even where rounding keeps the method from its tolerance.
constexpr double acceptable = 1e-8;

/// minimise cost . z subject to rows z + values <= 0, planes z + offsets = 0 and |u|^2 <= t, with z = (u, t) or
/// z = (u, t, violation), all in units of the move limit.
struct ConeProgram {
  Index n = 0;  ///< length of u
  VectorXd cost;
  MatrixXd rows, planes;
  VectorXd values, offsets;

  /// Values of the rows, and of the cone last.
  VectorXd evaluate(const VectorXd& z) const {
    VectorXd f(values.size() + 1);
    f << values + rows * z, z.head(n).squaredNorm() - z[n];
    return f;
  }
};

struct ConeSolution {
  VectorXd z, row_multipliers, plane_multipliers;
  double error = std::numeric_limits<double>::infinity();  ///< of the optimality conditions
  long steps = 0;

  bool good() const { return error <= acceptable; }
};

/// The longest step <= 1 that keeps value + step change positive.
double longest_step(const VectorXd& value, const VectorXd& change) {
  double length = 1.0;
  for (Index i = 0; i < value.size(); ++i) {
    if (change[i] < 0.0) length = std::min(length, -value[i] / change[i]);
  }
  return length;
}

double largest_entry(const VectorXd& values) { return values.size() == 0 ? 0.0 : values.cwiseAbs().maxCoeff(); }

/// The primal-dual interior-point method; z is the start. Keeps the best point that it passes.
ConeSolution interior_point(const ConeProgram& program, VectorXd z, const SphericalDualOptions& options) {
  // Keeps the linear system regular where constraints depend on each other, and costs no accuracy: the residuals are
  // exact.
  constexpr double regularisation = 1e-11;
  constexpr double fraction_to_boundary = 0.99;
  const Index n = program.n;
  const Index size = program.cost.size();
  const Index count = program.values.size() + 1;
  const Index planes = program.offsets.size();

  ConeSolution best;
  VectorXd f = program.evaluate(z);
  VectorXd slack = (-f).cwiseMax(0.1);
  VectorXd lambda = VectorXd::Ones(count);
  VectorXd mu = VectorXd::Zero(planes);
  MatrixXd jacobian = MatrixXd::Zero(count, size);
  jacobian.topRows(count - 1) = program.rows;
  jacobian(count - 1, n) = -1.0;
  for (long step = 0;; ++step) {
    jacobian.row(count - 1).head(n) = 2.0 * z.head(n).transpose();
    const VectorXd dual_residual = program.cost + jacobian.transpose() * lambda + program.planes.transpose() * mu;
    const VectorXd row_residual = f + slack;
    const VectorXd plane_residual = program.offsets + program.planes * z;
    const double gap = slack.dot(lambda) / static_cast<double>(count);
    const double unit = std::max({1.0, largest_entry(lambda), largest_entry(mu)});
    const double error = std::max(
        {largest_entry(dual_residual) / unit, largest_entry(row_residual), largest_entry(plane_residual), gap});
    best.steps = step;
    if (step == 0 || error < best.error) {
      best.z = z;
      best.row_multipliers = lambda.head(count - 1);
      best.plane_multipliers = mu;
      best.error = error;
    }
    if (error <= options.tolerance || step >= options.max_steps || !std::isfinite(error)) return best;

    const VectorXd denominator = slack + regularisation * lambda;
    const VectorXd weight = lambda.cwiseQuotient(denominator);
    MatrixXd system = MatrixXd::Zero(size + planes, size + planes);
    system.topLeftCorner(size, size) = jacobian.transpose() * weight.asDiagonal() * jacobian;
    system.topLeftCorner(n, n).diagonal().array() += 2.0 * lambda[count - 1];
    system.topLeftCorner(size, size).diagonal().array() += regularisation;
    system.topRightCorner(size, planes) = program.planes.transpose();
    system.bottomLeftCorner(planes, size) = program.planes;
    system.bottomRightCorner(planes, planes).diagonal().setConstant(-regularisation);
    const Eigen::PartialPivLU<MatrixXd> factors(system);
    VectorXd dz, dmu, dlambda, dslack;
    const auto solve_for = [&](const VectorXd& complementarity) {
      const VectorXd push = (complementarity + lambda.cwiseProduct(row_residual)).cwiseQuotient(denominator);
      VectorXd right(size + planes);
      right << -dual_residual - jacobian.transpose() * push, -plane_residual;
      const VectorXd solution = factors.solve(right);
      dz = solution.head(size);
      dmu = solution.tail(planes);
      dlambda = push + weight.cwiseProduct(jacobian * dz);
      dslack = (complementarity - slack.cwiseProduct(dlambda)).cwiseQuotient(lambda);
    };
    solve_for(-slack.cwiseProduct(lambda));
    const VectorXd slack_ahead = slack + longest_step(slack, dslack) * dslack;
    const VectorXd lambda_ahead = lambda + longest_step(lambda, dlambda) * dlambda;
    const double gap_ahead = slack_ahead.dot(lambda_ahead) / static_cast<double>(count);
    const double centring = std::pow(std::clamp(gap_ahead / gap, 0.0, 1.0), 3);
    solve_for(VectorXd::Constant(count, centring * gap) - slack.cwiseProduct(lambda) - dslack.cwiseProduct(dlambda));
    const double primal_length = fraction_to_boundary * longest_step(slack, dslack);
    const double dual_length = fraction_to_boundary * longest_step(lambda, dlambda);
    z += primal_length * dz;
    slack += primal_length * dslack;
    lambda += dual_length * dlambda;
    mu += dual_length * dmu;
    f = program.evaluate(z);
  }
}

/// The convex program of a spherical one. Its rows are the inequalities that can be violated within the move limit,
/// then bounds and t <= 1; every constraint is in units of its gradient.
struct Relaxation {
  ConeProgram program;
  std::vector<Index> inequality_of;  ///< behind the first rows
  VectorXd row_units, plane_units;   ///< of their multipliers
  double curvature_unit = 1.0;       ///< |a| / move_limit

  Index inequalities() const { return static_cast<Index>(inequality_of.size()); }
};

/// (a, c / 2) of function k, in units of the move limit.
VectorXd coefficients(const SphericalQuadratics& functions, Index k, double move_limit) {
  VectorXd row(functions.gradient.cols() + 1);
  row << move_limit * functions.gradient.row(k).transpose(), 0.5 * move_limit * move_limit * functions.curvature[k];
  return row;
}

/// The size of a function's change within the move limit.
double unit_of(const VectorXd& row, double value) {
  const double size = std::max(row.head(row.size() - 1).norm(), std::abs(row[row.size() - 1]));
  return size > 1e-12 * std::abs(value) && size > 0.0 ? size : std::max(std::abs(value), 1.0);
}

Relaxation relax(const SphericalProgram& original, const SphericalDualOptions& options) {
  Relaxation result;
  ConeProgram& program = result.program;
  const double rho = original.move_limit;
  const Index n = program.n = original.lower.size();
  program.cost = coefficients(original.objective, 0, rho);
  const double cost_unit = unit_of(program.cost, 0.0);
  program.cost /= cost_unit;
  program.cost[n] += 0.5 * options.least_curvature;
  result.curvature_unit = cost_unit / (rho * rho);

  std::vector<VectorXd> rows;
  std::vector<double> values, units;
  for (Index j = 0; j < original.inequality.size(); ++j) {
    const VectorXd row = coefficients(original.inequality, j, rho);
    const double value = original.inequality.value[j];
    if (value + row.head(n).norm() + std::max(0.0, row[n]) < 0.0) continue;
    const double unit = unit_of(row, value);
    rows.emplace_back(row / unit);
    values.push_back(value / unit);
    units.push_back(cost_unit / unit);
    result.inequality_of.push_back(j);
  }
  const auto add_bound = [&](Index i, double sign, double value) {
    // Others are out of reach.
    if (value < -1.0) return;
    rows.emplace_back(sign * VectorXd::Unit(n + 1, i));
    values.push_back(value);
  };
  for (Index i = 0; i < n; ++i) {
    add_bound(i, -1.0, original.lower[i] / rho);
    add_bound(i, 1.0, -original.upper[i] / rho);
  }
  add_bound(n, 1.0, -1.0);
  program.rows.resize(static_cast<Index>(rows.size()), n + 1);
  for (std::size_t k = 0; k < rows.size(); ++k) program.rows.row(static_cast<Index>(k)) = rows[k].transpose();
  program.values = Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
  result.row_units = Eigen::Map<const VectorXd>(units.data(), static_cast<Index>(units.size()));

  const Index planes = original.equality.size();
  program.planes.resize(planes, n + 1);
  program.offsets.resize(planes);
  result.plane_units.resize(planes);
  for (Index k = 0; k < planes; ++k) {
    const VectorXd row = coefficients(original.equality, k, rho);
    const double unit = unit_of(row, original.equality.value[k]);
    program.planes.row(k) = row.transpose() / unit;
    program.offsets[k] = original.equality.value[k] / unit;
    result.plane_units[k] = cost_unit / unit;
  }
  return result;
}

VectorXd centre(Index n) {
  VectorXd z = VectorXd::Zero(n + 1);
  z[n] = 0.5;
  return z;
}

/// With the least violation granted to all inequalities and equalities: the lowest objective.
ConeSolution solve_with_least_violation(const Relaxation& relaxation, const SphericalDualOptions& options) {
  const ConeProgram& program = relaxation.program;
  const Index n = program.n;
  const Index rows = program.values.size();
  const Index planes = program.offsets.size();
  const Index inequalities = relaxation.inequalities();

  ConeProgram granted;  // equalities as two inequalities each
  granted.n = n;
  granted.cost = program.cost;
  granted.rows.resize(rows + 2 * planes, n + 1);
  granted.rows << program.rows, program.planes, -program.planes;
  granted.values.resize(rows + 2 * planes);
  granted.values << program.values, program.offsets, -program.offsets;
  granted.planes.resize(0, n + 1);
  VectorXd price = VectorXd::Zero(rows + 2 * planes);
  price.head(inequalities).setOnes();
  price.tail(2 * planes).setOnes();

  ConeProgram least = granted;
  least.cost = VectorXd::Unit(n + 2, n + 1);
  least.rows.resize(granted.rows.rows() + 1, n + 2);
  least.rows.setZero();
  least.rows.topLeftCorner(granted.rows.rows(), n + 1) = granted.rows;
  least.rows.col(n + 1) << -price, -1.0;
  least.values.resize(granted.values.size() + 1);
  least.values << granted.values, 0.0;
  least.planes.resize(0, n + 2);
  VectorXd start(n + 2);
  start << centre(n), std::max(0.0, granted.values.cwiseProduct(price).maxCoeff()) + 0.5;
  ConeSolution found = interior_point(least, start, options);

  const double violation = std::max(found.z[n + 1], 0.0) * (1.0 + 1e-6) + 10.0 * options.tolerance;
  granted.values -= violation * price;
  ConeSolution last = interior_point(granted, found.z.head(n + 1), options);
  last.steps += found.steps;
  if (!last.good()) last.z = found.z.head(n + 1);
  last.plane_multipliers =
      last.row_multipliers.segment(rows, planes) - last.row_multipliers.segment(rows + planes, planes);
  last.row_multipliers.conservativeResize(rows);
  return last;
}

}  // namespace

SphericalDualResult solve_dual(const SphericalProgram& original, const SphericalDualOptions& options) {
  require(options.tolerance > 0.0, "dual option tolerance", options.tolerance, "positive");
  require(options.max_steps >= 1, "dual option max_steps", options.max_steps, "at least 1");
  require(options.least_curvature > 0.0, "dual option least_curvature", options.least_curvature, "positive");
  require(options.slack_tolerance > 0.0, "dual option slack_tolerance", options.slack_tolerance, "positive");
  require(options.first_raise > 0.0, "dual option first_raise", options.first_raise, "positive");
  require(options.max_raises >= 0, "dual option max_raises", options.max_raises, "at least 0");

  SphericalDualResult result;
  Relaxation relaxation = relax(original, options);
  ConeProgram& program = relaxation.program;
  const Index n = program.n;
  const double given_curvature = program.cost[n];
  ConeSolution found;
  double slack = 0.0;
  for (double raise = options.first_raise;; raise *= 10.0, ++result.raises) {
    found = interior_point(program, centre(n), options);
    result.steps += found.steps;
    result.relaxed = !found.good();
    if (result.relaxed) {
      found = solve_with_least_violation(relaxation, options);
      result.steps += found.steps;
    }
    slack = found.z[n] - found.z.head(n).squaredNorm();
    if (slack <= options.slack_tolerance || result.raises >= options.max_raises) break;
    program.cost[n] = std::max(given_curvature, 0.0) + 0.5 * raise;
  }
  result.exact = found.good() && slack <= options.slack_tolerance;

  const double rho = original.move_limit;
  result.step = (rho * found.z.head(n)).cwiseMax(original.lower).cwiseMin(original.upper);
  result.inequality_multipliers = VectorXd::Zero(original.inequality.size());
  for (Index k = 0; k < relaxation.inequalities(); ++k) {
    result.inequality_multipliers[relaxation.inequality_of[static_cast<std::size_t>(k)]] =
        found.row_multipliers[k] * relaxation.row_units[k];
  }
  result.equality_multipliers = found.plane_multipliers.cwiseProduct(relaxation.plane_units);
  return result;
}

}  // namespace reprise
