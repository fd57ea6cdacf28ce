// reprise conditioning: the inverse condition number over a workspace.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "command.hpp"
#include "reprise/bounds/workspace_enclosure.hpp"
#include "reprise/geometry/region_quadrature.hpp"
#include "reprise/kinematics/coordinates.hpp"
#include "reprise/kinematics/singular_positions.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/study/drawing.hpp"
#include "reprise/study/mapped_workspace.hpp"
#include "reprise/study/pose_documents.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/region_singularity.hpp"

namespace reprise::app {

namespace {

/// kappa^-1 of a manipulator at an orientation, as a function of the position.
class ConditioningField {
 public:
  ConditioningField(ManipulatorInput input, double orientation)
      : input_(std::move(input)),
        orientation_(orientation),
        limits_(input_.manipulator, orientation),
        positions_(Eigen::MatrixXd::Identity(coordinate_count(input_.manipulator.size()), 2)) {}

  const ManipulatorInput& input() const { return input_; }
  const ConstantOrientationLimits& limits() const { return limits_; }

  double at(const Eigen::Vector2d& u) const {
    return kappa_inverse(input_.manipulator, {u, orientation_}, input_.conditioning);
  }

  /// Whether a position is singular, as `reprise pose` has it.
  bool singular_at(const Eigen::Vector2d& u) const {
    return kappa_inverse_2norm(input_.manipulator, {u, orientation_}, input_.conditioning) < singular_ratio;
  }

  /// Whether all limits hold, apart from rounding.
  bool allows(const Eigen::Vector2d& u, double rounding) const {
    Eigen::VectorXd h(limits_.count());
    limits_.evaluate(u, h);
    return h.maxCoeff() <= rounding;
  }

  double orientation() const { return orientation_; }

  /// The least (sign = 1) or greatest (sign = -1) value near a point of the workspace, by SLSQP; the point itself where
  /// that finds nothing better.
  MapPoint refine(const MapPoint& point, double sign, double size) const {
    Problem problem;
    problem.name = "extreme of the conditioning";
    problem.n = 2;  // the way from the point, in sizes of the workspace
    const auto position = [&, from = point.position](const Eigen::VectorXd& z) -> Eigen::Vector2d {
      return from + size * z;
    };
    // SLSQP may try a point that is not finite, where its linear systems are singular.
    problem.objective = [&](const Eigen::VectorXd& z) {
      return z.allFinite() ? sign * at(position(z)) : std::numeric_limits<double>::quiet_NaN();
    };
    problem.objective_gradient = [&](const Eigen::VectorXd& z, Eigen::VectorXd& gradient) {
      gradient.setZero();
      if (!z.allFinite()) return;
      kappa_inverse(input_.manipulator, {position(z), orientation_}, input_.conditioning, positions_, gradient);
      gradient *= sign * size;
    };
    problem.inequalities = limits_.count();
    problem.inequality = [&](const Eigen::VectorXd& z, Eigen::VectorXd& g) {
      limits_.evaluate(position(z), g);
      g /= size;
    };
    problem.inequality_jacobian = dense_jacobian([&](const Eigen::VectorXd& z, Eigen::MatrixXd& jacobian) {
      for (Eigen::Index j = 0; j < limits_.count(); ++j) jacobian.row(j) = limits_.gradient(position(z), j);
    });
    Options options;
    options.feasibility_tolerance = 1e-9;
    options.max_function_evaluations = 200;
    options.record_history = false;
    const Result result = NloptSolver().minimize(problem, Eigen::VectorXd::Zero(2), options);
    const bool better = result.violation <= options.feasibility_tolerance && result.f < sign * point.value;
    return better ? MapPoint{position(result.x), sign * result.f} : point;
  }

 private:
  ManipulatorInput input_;
  double orientation_;
  ConstantOrientationLimits limits_;
  Eigen::MatrixXd positions_;  ///< directions of the derivatives: x and y
};

enum class SingularPoses {
  all,
  some,
  none,        ///< proved
  none_found,  ///< not proved
};

/// Extremes and mean over a workspace.
struct ConditioningSummary {
  MapPoint least{Eigen::Vector2d::Zero(), 0.0};
  MapPoint greatest{Eigen::Vector2d::Zero(), 0.0};
  double least_bound = 0.0;  ///< no value of the workspace is below: proved
  double mean = 0.0;         ///< the global conditioning index
  double mean_error = 0.0;
  SingularPoses singular = SingularPoses::none_found;  ///< `least` is one of them, if there are any
};

using SampledLines = std::vector<std::pair<QuadratureLine, std::vector<double>>>;

SampledLines sample(const Region& region, const ConditioningField& field, int panels) {
  SampledLines lines;
  for (QuadratureLine& line : region_quadrature(region, panels)) {
    std::vector<double> values;
    for (const QuadratureNode& node : line) values.push_back(field.at(node.position));
    lines.emplace_back(std::move(line), std::move(values));
  }
  return lines;
}

double mean_over(const SampledLines& lines) {
  double area = 0.0;
  double integral = 0.0;
  for (const auto& [line, values] : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      area += line[k].weight;
      integral += line[k].weight * values[k];
    }
  }
  return integral / area;
}

/// The least (sign = 1) or greatest (sign = -1) of many points, no two of them close together.
std::vector<MapPoint> spread_extremes(std::vector<MapPoint> points, double sign, double size) {
  constexpr std::size_t most = 6;
  std::vector<MapPoint> chosen;
  std::sort(points.begin(), points.end(),
            [&](const MapPoint& a, const MapPoint& b) { return sign * a.value < sign * b.value; });
  for (const MapPoint& point : points) {
    if (chosen.size() == most) break;
    const bool apart = std::all_of(chosen.begin(), chosen.end(), [&](const MapPoint& other) {
      return (other.position - point.position).norm() > 0.1 * size;
    });
    if (apart) chosen.push_back(point);
  }
  return chosen;
}

/// A singular position of the workspace, if one is found: two and three legs have them where a conic meets the exact
/// region, more legs are sought for from the least values sampled.
std::optional<Eigen::Vector2d> find_singular(const Region& region, const ConditioningField& field,
                                             const std::vector<MapPoint>& least, double rounding) {
  const Manipulator& manipulator = field.input().manipulator;
  if (manipulator.size() <= 3) {
    for (const Eigen::Vector2d& u :
         nearest_to_singular(region, singularity_polynomial(manipulator, field.orientation()))) {
      if (field.singular_at(u)) return u;
    }
    return std::nullopt;
  }
  for (const MapPoint& point : least) {
    const Eigen::Vector2d there = approach_singular(manipulator, {point.position, field.orientation()});
    if (field.allows(there, rounding) && field.singular_at(there)) return there;
  }
  return std::nullopt;
}

ConditioningSummary summarise(const Region& region, const MappedWorkspace& mapped, const ConditioningField& field,
                              double size) {
  const Manipulator& manipulator = field.input().manipulator;
  const auto legs = static_cast<long>(manipulator.size());
  // Many legs bound the region by many edges, between which there are as many panels.
  const int panels = legs <= 12 ? 4 : 2;
  const SampledLines lines = sample(region, field, panels);
  ConditioningSummary summary;
  summary.mean = mean_over(lines);
  summary.mean_error = std::abs(summary.mean - mean_over(sample(region, field, panels / 2)));

  std::vector<MapPoint> points;
  for (const auto& [line, values] : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) points.push_back({line[k].position, values[k]});
  }
  for (const MappedComponent& component : mapped.components) {
    for (const Eigen::Vector2d& u : component.boundary) points.push_back({u, field.at(u)});
    for (const Outline& hole : component.holes) {
      for (const Eigen::Vector2d& u : hole) points.push_back({u, field.at(u)});
    }
  }
  const auto best = [&](double sign) {
    std::vector<MapPoint> refined = spread_extremes(points, sign, size);
    for (MapPoint& point : refined) point = field.refine(point, sign, size);
    return refined;
  };
  summary.greatest = spread_extremes(best(-1.0), -1.0, size).front();

  const double rounding = 1e-12 * (size + region.components().front().outer.edges.front().start.cwiseAbs().maxCoeff());
  const bool all_singular = legs <= 3 && singularity_polynomial(manipulator, field.orientation()).vanishes();
  std::vector<MapPoint> least = best(1.0);
  std::sort(least.begin(), least.end(), [](const MapPoint& a, const MapPoint& b) { return a.value < b.value; });
  if (const auto singular = find_singular(region, field, least, rounding)) {
    summary.least = {*singular, 0.0};
    summary.singular = all_singular ? SingularPoses::all : SingularPoses::some;
    return summary;
  }
  // The bounds, and what the search for them finds where the samples have missed it.
  std::vector<Eigen::Vector2d> candidates;
  for (const MapPoint& point : least) candidates.push_back(point.position);
  constexpr long evaluations_of_legs = 300'000;
  const EnclosureOptions options{.tolerance = 1e-6, .max_evaluations = evaluations_of_legs / legs};
  const MinimumEnclosure enclosure = enclose_minimum_in_workspace(manipulator, field.orientation(), rounding,
                                                                  candidates, field.input().conditioning, options);
  summary.least = least.front();
  if (enclosure.witness && enclosure.upper < summary.least.value) {
    const Eigen::Vector2d there = enclosure.witness->position;
    summary.least = field.refine({there, field.at(there)}, 1.0, size);
  }
  summary.least_bound = std::min(enclosure.lower, summary.least.value);
  summary.singular = summary.least_bound > 0.0 ? SingularPoses::none : SingularPoses::none_found;
  return summary;
}

const char* name_of(SingularPoses singular) {
  switch (singular) {
    case SingularPoses::all:
      return "all";
    case SingularPoses::some:
      return "some";
    case SingularPoses::none:
      return "none";
    case SingularPoses::none_found:
      return "none_found";
  }
  return "";
}

std::string sentence_on(const ConditioningSummary& summary) {
  switch (summary.singular) {
    case SingularPoses::all:
      return "yes: every pose is singular";
    case SingularPoses::some:
      return fmt::format("yes, at x = {}, y = {}", short_number(summary.least.position.x()),
                         short_number(summary.least.position.y()));
    case SingularPoses::none:
      return "none, proved";
    case SingularPoses::none_found:
      return "none found (which is no proof)";
  }
  return "";
}

class ConditioningCommand final : public Command {
 public:
  ConditioningCommand()
      : Command(
            "conditioning", "The inverse condition number over the workspace",
            "A map of kappa^-1 (Frobenius norm) over the workspace at one orientation, its least and greatest value, "
            "and\n"
            "the global conditioning index, which is its mean over the workspace's area. 0 is a singular pose, 1 an\n"
            "isotropic one. Singular poses are looked for where det J = 0 meets the exact workspace; that there are "
            "none\n"
            "is proved by interval arithmetic, which also gives a lower bound of kappa^-1.",
            "reprise conditioning examples/M1.toml --orientation 0\n"
            "reprise conditioning examples/triangle.toml --grid 201 --plot map.png --out results --json") {
    options().number("--orientation", orientation_deg_, NumberRange::between(-1e6, 1e6),
                     "orientation of the platform, degrees");
    options().integer("--grid", grid_, 2, 1001, "points of the map along x and along y");
    draws();
    writes_files({"map.csv"});
  }

 private:
  Output compute() override {
    const ConditioningField field(read_manipulator(file()), orientation_deg_ * degree);
    const Manipulator& manipulator = field.input().manipulator;
    const Region region = constant_orientation_workspace(manipulator, orientation_deg_ * degree);
    const MappedWorkspace mapped = exact_workspace(field.limits(), region);
    const std::string title =
        fmt::format("{}, κ⁻¹ at orientation {}°", manipulator.name(), short_number(orientation_deg_));
    Output output;
    Json& document = output.document;
    output.unit = field.input().unit;
    document["manipulator"] = manipulator.name();
    document["orientation_deg"] = orientation_deg_;
    document["normalisation"] =
        field.input().conditioning.normalisation == Normalisation::printed ? "printed" : "homogeneous";
    document["characteristic_length"] = characteristic_length(manipulator, field.input().conditioning);
    document["area"] = region.area();
    if (region.empty()) {
      for (const char* key :
           {"kappa_inv_min", "kappa_inv_min_at", "kappa_inv_max", "kappa_inv_max_at", "kappa_inv_min_bound",
            "global_conditioning_index", "global_conditioning_index_error", "singular_at"}) {
        document[key] = nullptr;
      }
      document["singular_poses"] = name_of(SingularPoses::none);
      document["singular_inside"] = false;
      document["map"] = {{"x", Json::array()}, {"y", Json::array()}, {"kappa_inv", Json::array()}};
      output.text = title + "\nthe workspace is empty\n";
      output.tables = {{"map", map_table(title, {})}};
      output.picture = [title, input = field.input()] { return draw_workspace(title, input, {}, {}); };
      return output;
    }
    Eigen::AlignedBox2d box;
    for (const MappedComponent& component : mapped.components) {
      for (const Eigen::Vector2d& point : component.boundary) box.extend(point);
    }
    const ConditioningSummary summary = summarise(region, mapped, field, box.sizes().maxCoeff());
    document["kappa_inv_min"] = summary.least.value;
    document["kappa_inv_min_at"] = to_json(summary.least.position);
    document["kappa_inv_min_bound"] = summary.least_bound;
    document["kappa_inv_max"] = summary.greatest.value;
    document["kappa_inv_max_at"] = to_json(summary.greatest.position);
    document["global_conditioning_index"] = summary.mean;
    document["global_conditioning_index_error"] = summary.mean_error;
    const bool singular_inside = summary.singular == SingularPoses::all || summary.singular == SingularPoses::some;
    document["singular_inside"] = singular_inside;
    document["singular_poses"] = name_of(summary.singular);
    document["singular_at"] = singular_inside ? to_json(summary.least.position) : Json();
    const auto place = [](const MapPoint& point) {
      return fmt::format("{:<10} at x = {}, y = {}", short_number(point.value), short_number(point.position.x()),
                         short_number(point.position.y()));
    };
    output.text = fmt::format(
        "{}\narea                        {}\nleast kappa^-1              {}\n  proved to be at least     {}\n"
        "greatest kappa^-1           {}\nglobal conditioning index   {} (+- {:.1g})\nsingular poses              {}\n",
        title, short_number(region.area()), place(summary.least), lower_number(summary.least_bound),
        place(summary.greatest), short_number(summary.mean), summary.mean_error, sentence_on(summary));
    // A map over the workspace's box.
    const auto steps = static_cast<double>(grid_ - 1);
    std::vector<std::vector<MapPoint>> map;
    Json xs = Json::array();
    Json ys = Json::array();
    Json values = Json::array();
    for (long i = 0; i < grid_; ++i) {
      const double x = box.min().x() + box.sizes().x() * static_cast<double>(i) / steps;
      xs.push_back(x);
      Json column = Json::array();
      std::vector<MapPoint>& line = map.emplace_back();
      for (long j = 0; j < grid_; ++j) {
        const Eigen::Vector2d u(x, box.min().y() + box.sizes().y() * static_cast<double>(j) / steps);
        if (i == 0) ys.push_back(u.y());
        const bool inside = region.contains(u);
        column.push_back(inside ? Json(field.at(u)) : Json());
        if (inside) line.push_back({u, field.at(u)});
      }
      values.push_back(column);
    }
    document["map"] = {{"x", xs}, {"y", ys}, {"kappa_inv", values}};
    output.tables = {{"map", map_table(title, map)}};
    output.picture = [=] {
      return draw_conditioning(title, field.input(), picture_values(region, field, box), drawn(mapped), summary.least,
                               summary.greatest);
    };
    return output;
  }

  /// Finer than the map, with square cells, and a little beyond the boundary, whose line covers that.
  static std::vector<std::vector<MapPoint>> picture_values(const Region& region, const ConditioningField& field,
                                                           const Eigen::AlignedBox2d& box) {
    const double cell = box.sizes().maxCoeff() / 300.0;
    const Eigen::Array2i count = (box.sizes() / cell).array().ceil().cast<int>() + 1;
    std::vector<std::vector<MapPoint>> scan_lines;
    for (int i = 0; i < count.x(); ++i) {
      std::vector<MapPoint>& line = scan_lines.emplace_back();
      for (int j = 0; j < count.y(); ++j) {
        const Eigen::Vector2d u = box.min() + cell * Eigen::Vector2d(i, j);
        const bool shown = region.contains(u) || region.distance_to_boundary(u) < 0.45 * cell;
        line.push_back({u, shown ? field.at(u) : std::numeric_limits<double>::quiet_NaN()});
      }
    }
    return scan_lines;
  }

  static Table map_table(const std::string& title, const std::vector<std::vector<MapPoint>>& scan_lines) {
    Table table(title, {{"x", "length", "x coordinate of the working point"},
                        {"y", "length", "y coordinate of the working point"},
                        {"kappa_inv", "-", "inverse condition number; only points in the workspace are listed"}});
    for (const std::vector<MapPoint>& line : scan_lines) {
      for (const MapPoint& point : line) table.add_row({point.position.x(), point.position.y(), point.value});
    }
    return table;
  }

  double orientation_deg_ = 0.0;
  long grid_ = 101;
};

}  // namespace

std::vector<std::unique_ptr<Command>> conditioning_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<ConditioningCommand>());
  return commands;
}

}  // namespace reprise::app
