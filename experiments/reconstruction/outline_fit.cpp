#include "reconstruction/outline_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "reprise/base/constants.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/synthesis/area_measure.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/exact_workspace.hpp"

namespace reprise::experiments {

namespace {

/// Unit of the clearance among the residuals: half a unit of the third decimal, to which designs are printed.
constexpr double contact_unit = 5e-4;

/// Least area of a miss that is allowed.
constexpr double least_area = 1e-7;

/// Spacing of the exact boundaries as polygons; their sagitta is below 1e-6.
constexpr double boundary_spacing = 2e-3;

/// Functions are not smooth where the lowest point of the outline jumps, and SLSQP may then go on for ever without
/// getting better.
constexpr long most_evaluations = 1000;

/// Central differences where accuracy near kinks counts, forward ones for the many searches along constraints.
Options search_options(Derivatives derivatives) {
  Options options;
  options.derivatives = derivatives;
  options.max_function_evaluations = most_evaluations;
  options.record_history = false;
  return options;
}

constexpr Conditioning conditioning{Normalisation::printed, {}};

std::array<Interval, 3> widened(std::array<Interval, 3> lengths, double amount) {
  for (Interval& length : lengths) length = {length.lower - amount, length.upper + amount};
  return lengths;
}

/// The boundaries around the centre, one for each slice.
std::vector<PolarBoundary> boundaries(const PublishedRow& row, const Manipulator& manipulator) {
  std::vector<Region> regions;
  if (row.dextrous_range) {
    regions.push_back(dextrous_workspace(manipulator, *row.dextrous_range));
  } else {
    for (const double phi : row.orientations) regions.push_back(constant_orientation_workspace(manipulator, phi));
  }
  std::vector<PolarBoundary> result;
  for (const Region& region : regions) {
    for (const RegionComponent& component : region.components()) {
      if (!component.outer.encloses(outline_centre())) continue;
      result.emplace_back(component.outer.sample(boundary_spacing), outline_centre());
    }
  }
  if (result.size() != regions.size()) {
    throw std::runtime_error("Table " + row.table + ", " + row.workspace + ": the centre is outside of the workspace.");
  }
  return result;
}

}  // namespace

Eigen::Vector2d outline_centre() { return {1.0, 1.5}; }

RowModel::RowModel(PublishedRow row)
    : row_(std::move(row)),
      start_(make_manipulator(to_collinear_design(row_.start), row_.lengths)),
      design_(make_manipulator(to_collinear_design(row_.design), row_.lengths)),
      // Of a leg's vector: base joint and platform joint each by their rounding.
      length_change_(std::hypot(std::max({row_.rounding[0], row_.rounding[2], row_.rounding[3]}), row_.rounding[1]) +
                     row_.rounding[4]),
      boundaries_(boundaries(row_, design_)),
      widened_boundaries_(
          boundaries(row_, make_manipulator(to_collinear_design(row_.design), widened(row_.lengths, length_change_)))) {
  if (row_.dextrous_range) {
    limits_.push_back(std::make_shared<DextrousLimits>(design_, *row_.dextrous_range));
  } else {
    for (const double phi : row_.orientations) {
      limits_.push_back(std::make_shared<ConstantOrientationLimits>(design_, phi));
    }
  }
}

Prediction RowModel::predict(const PrescribedWorkspace& outline, const std::vector<double>& directions) const {
  Prediction prediction;
  prediction.f_d0 = infinity;
  prediction.f_star = infinity;
  Pose lowest{outline.centre(), 0.0};
  double largest_limit = -infinity;
  Eigen::VectorXd h(limits_.front()->count());
  for (const double beta : directions) {
    const Eigen::Vector2d u = outline.point(beta);
    for (const double phi : row_.orientations) {
      prediction.f_d0 = std::min(prediction.f_d0, kappa_inverse(start_, {u, phi}, conditioning));
      const double here = kappa_inverse(design_, {u, phi}, conditioning);
      if (here < prediction.f_star) {
        prediction.f_star = here;
        lowest = {u, phi};
      }
    }
    for (const auto& limits : limits_) {
      limits->evaluate(u, h);
      largest_limit = std::max(largest_limit, h.maxCoeff());
    }
  }
  prediction.f_star_change = collinear_kappa_inverse(to_collinear_design(row_.design), lowest, conditioning)
                                 .design.cwiseAbs()
                                 .dot(row_.rounding);
  prediction.clearance = -largest_limit;
  return prediction;
}

Miss RowModel::miss(const PrescribedWorkspace& outline, const std::vector<double>& directions, bool allowed) const {
  Miss miss{0.0, infinity};
  for (const PolarBoundary& boundary : allowed ? widened_boundaries_ : boundaries_) {
    const AreaMeasure measure = measure_area(outline, &boundary, directions);
    miss.area += measure.prescribed_outside;
    miss.polar_clearance = std::min(miss.polar_clearance, measure.clearance);
  }
  return miss;
}

double RowModel::allowed_area() const { return std::max(row_.g_star.value + row_.g_star.half_unit, least_area); }

OutlineFit::OutlineFit(std::vector<std::shared_ptr<const RowModel>> rows, OutlineFamily family, Sizes sizes,
                       int directions)
    : rows_(std::move(rows)),
      family_(std::move(family)),
      sizes_(std::move(sizes)),
      names_(family_.parameters),
      start_(family_.start),
      lower_(family_.lower),
      upper_(family_.upper) {
  if (sizes_.divisors.size() != rows_.size()) throw std::logic_error("there must be one divisor for each row.");
  for (int i = 0; i < directions; ++i) directions_.push_back(2.0 * pi * i / directions);
  if (!sizes_.fitted) return;
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    names_.push_back("divisor_" + rows_[i]->row().synthesis);
    for (auto* bound : {&start_, &lower_, &upper_}) bound->conservativeResize(bound->size() + 1);
    start_[start_.size() - 1] = sizes_.divisors[i];
    lower_[lower_.size() - 1] = 0.5 * sizes_.divisors[i];
    upper_[upper_.size() - 1] = 2.0 * sizes_.divisors[i];
  }
}

Shape OutlineFit::shape(const Eigen::VectorXd& x) const { return family_.shape(x.head(family_.start.size())); }

std::vector<double> OutlineFit::divisors(const Eigen::VectorXd& x) const {
  std::vector<double> divisors = sizes_.divisors;
  for (Eigen::Index i = family_.start.size(); i < x.size(); ++i) {
    divisors[static_cast<std::size_t>(i - family_.start.size() + 1)] = x[i];
  }
  return divisors;
}

PrescribedWorkspace OutlineFit::outline(const Eigen::VectorXd& x, std::size_t k) const {
  return {"outline", shape(x), {outline_centre(), 1.0 / divisors(x)[k], 0.0}};
}

Eigen::VectorXd OutlineFit::residuals(const Eigen::VectorXd& x) const {
  Eigen::VectorXd residuals(static_cast<Eigen::Index>(3 * rows_.size()));
  Eigen::Index i = 0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const PublishedRow& row = rows_[k]->row();
    const Prediction prediction = rows_[k]->predict(outline(x, k), directions_);
    residuals[i++] = (prediction.f_d0 - row.f_d0.value) / row.f_d0.half_unit;
    residuals[i++] = (prediction.f_star - row.f_star.value) / row.f_star.half_unit;
    residuals[i++] = prediction.clearance / contact_unit;
  }
  return residuals;
}

Eigen::VectorXd OutlineFit::ratios(const Eigen::VectorXd& x) const {
  Eigen::VectorXd ratios(static_cast<Eigen::Index>(6 * rows_.size()));
  Eigen::Index i = 0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const PublishedRow& row = rows_[k]->row();
    const PrescribedWorkspace sized = outline(x, k);
    const Prediction prediction = rows_[k]->predict(sized, directions_);
    const double start = (prediction.f_d0 - row.f_d0.value) / row.f_d0.half_unit;
    const double final_value =
        (prediction.f_star - row.f_star.value) / (row.f_star.half_unit + prediction.f_star_change);
    ratios[i++] = start;
    ratios[i++] = -start;
    ratios[i++] = final_value;
    ratios[i++] = -final_value;
    ratios[i++] = prediction.clearance / rows_[k]->length_change();
    // An outline that sticks out by no more than the allowance lies within the widened workspace.
    const bool within = prediction.clearance >= -rows_[k]->length_change();
    ratios[i++] = within ? 0.0 : rows_[k]->miss(sized, directions_, true).area / rows_[k]->allowed_area();
  }
  return ratios;
}

FittedOutline OutlineFit::judge(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd r = residuals(x);
  return {x, r.squaredNorm(), r.cwiseAbs().maxCoeff(), ratios(x).maxCoeff()};
}

Problem OutlineFit::problem(const std::string& name) const {
  Problem problem;
  problem.name = name;
  problem.n = start_.size();
  problem.lower = lower_;
  problem.upper = upper_;
  return problem;
}

FittedOutline OutlineFit::least_squares(const Solver& solver, int starts) const {
  Problem problem = this->problem("least squares");
  problem.objective = [this](const Eigen::VectorXd& x) { return residuals(x).squaredNorm(); };
  std::mt19937 random(1);
  std::optional<FittedOutline> best;
  for (int i = 0; i < starts; ++i) {
    Eigen::VectorXd x = start_;
    if (i > 0) {
      // A fixed arithmetic of the generator's whole numbers, the same with every library.
      for (double& entry : x) entry *= 0.9 + 0.2 * static_cast<double>(random()) / 4294967295.0;
    }
    const FittedOutline found = judge(solver.minimize(problem, x, search_options(Derivatives::central)).x);
    if (!best || found.sum_of_squares < best->sum_of_squares) best = found;
  }
  return *best;
}

FittedOutline OutlineFit::nearest(const Solver& solver, const FittedOutline& from) const {
  // Variables [x, t]: minimise t subject to all ratios being at most t.
  const Eigen::Index n = start_.size();
  Problem problem = this->problem("least excess");
  problem.n = n + 1;
  problem.lower.conservativeResize(n + 1);
  problem.upper.conservativeResize(n + 1);
  problem.lower[n] = 0.0;
  problem.upper[n] = infinity;
  problem.objective = [n](const Eigen::VectorXd& x) { return x[n]; };
  problem.inequalities = static_cast<Eigen::Index>(6 * rows_.size());
  problem.inequality = [this, n](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    g = ratios(x.head(n)).array() - x[n];
  };
  FittedOutline best = from;
  for (const Eigen::VectorXd& begin : {from.x, start_}) {
    Eigen::VectorXd x(n + 1);
    x << begin, judge(begin).excess;
    const FittedOutline found = judge(solver.minimize(problem, x, search_options(Derivatives::forward)).x.head(n));
    if (found.excess < best.excess) best = found;
  }
  return best;
}

std::vector<Extent> OutlineFit::extents(const Solver& solver, const FittedOutline& compatible) const {
  if (compatible.excess > 1.0) return {};
  const Eigen::Index n = start_.size();
  Problem problem = this->problem("extent");
  problem.inequalities = static_cast<Eigen::Index>(6 * rows_.size());
  problem.inequality = [this](const Eigen::VectorXd& x, Eigen::VectorXd& g) { g = ratios(x).array() - 1.0; };
  // Every compatible point found is a start for what comes: twice around, since late finds help early searches.
  std::vector<Eigen::VectorXd> pool{compatible.x};
  for (int round = 0; round < 2; ++round) {
    for (Eigen::Index j = 0; j < n; ++j) {
      for (const double sign : {1.0, -1.0}) {
        problem.objective = [j, sign](const Eigen::VectorXd& x) { return sign * x[j]; };
        const auto begin = std::min_element(pool.begin(), pool.end(),
                                            [&](const auto& a, const auto& b) { return sign * a[j] < sign * b[j]; });
        const Result result = solver.minimize(problem, *begin, search_options(Derivatives::forward));
        if (result.violation <= 1e-6) pool.push_back(result.x);
      }
    }
  }
  std::vector<Extent> extents;
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto [least, most] =
        std::minmax_element(pool.begin(), pool.end(), [j](const auto& a, const auto& b) { return a[j] < b[j]; });
    extents.push_back({*least, *most});
  }
  return extents;
}

}  // namespace reprise::experiments
