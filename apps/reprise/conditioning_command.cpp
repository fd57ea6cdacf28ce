// reprise conditioning: the inverse condition number over a workspace.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "command.hpp"
#include "drawing.hpp"
#include "mapped_workspace.hpp"
#include "reprise/kinematics/coordinates.hpp"
#include "reprise/kinematics/jacobian.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/region_quadrature.hpp"

namespace reprise::app {

namespace {

using experiments::NumberRange;
using experiments::Table;

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

  /// The determinant of the Jacobian of two or three legs, which changes its sign where it is singular; of more legs
  /// there is none, and kappa^-1 stands in.
  double signed_value(const Eigen::Vector2d& u) const {
    const std::size_t legs = input_.manipulator.size();
    if (legs > 3) return at(u);
    const Eigen::MatrixX3d rows = normalised_jacobian(input_.manipulator, {u, orientation_}, input_.conditioning);
    return legs == 2 ? rows.topLeftCorner<2, 2>().determinant() : rows.topRows<3>().determinant();
  }

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
    reprise::Options options;
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

/// Extremes and mean over a workspace.
struct ConditioningSummary {
  MapPoint least{Eigen::Vector2d::Zero(), std::numeric_limits<double>::infinity()};
  MapPoint greatest{Eigen::Vector2d::Zero(), -std::numeric_limits<double>::infinity()};
  double mean = 0.0;  ///< the global conditioning index
  double mean_error = 0.0;
  bool singular_inside = false;
};

double mean_over(const Region& region, const ConditioningField& field, int panels) {
  double area = 0.0;
  double integral = 0.0;
  for (const QuadratureLine& line : region_quadrature(region, panels)) {
    for (const QuadratureNode& node : line) {
      area += node.weight;
      integral += node.weight * field.at(node.position);
    }
  }
  return integral / area;
}

/// Where the sign changes between two points of the workspace, to rounding.
Eigen::Vector2d singular_point(const ConditioningField& field, Eigen::Vector2d negative, Eigen::Vector2d positive) {
  for (int step = 0; step < 100; ++step) {
    const Eigen::Vector2d middle = 0.5 * (negative + positive);
    (field.signed_value(middle) < 0.0 ? negative : positive) = middle;
  }
  return negative;
}

ConditioningSummary summarise(const Region& region, const MappedWorkspace& mapped, const ConditioningField& field,
                              double size) {
  constexpr int panels = 4;
  ConditioningSummary summary;
  const auto consider = [&](const Eigen::Vector2d& u) {
    const double value = field.at(u);
    if (value < summary.least.value) summary.least = {u, value};
    if (value > summary.greatest.value) summary.greatest = {u, value};
  };
  for (const QuadratureLine& line : region_quadrature(region, panels)) {
    double last = 0.0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      consider(line[k].position);
      const double here = field.signed_value(line[k].position);
      if (k > 0 && last * here < 0.0 && !summary.singular_inside) {
        const Eigen::Vector2d before = line[k - 1].position;
        summary.singular_inside = true;
        const Eigen::Vector2d at = last < 0.0 ? singular_point(field, before, line[k].position)
                                              : singular_point(field, line[k].position, before);
        summary.least = {at, 0.0};
      }
      last = here;
    }
  }
  for (const MappedComponent& component : mapped.components) {
    for (const Eigen::Vector2d& u : component.boundary) consider(u);
    for (const Outline& hole : component.holes) {
      for (const Eigen::Vector2d& u : hole) consider(u);
    }
  }
  if (!summary.singular_inside) summary.least = field.refine(summary.least, 1.0, size);
  summary.greatest = field.refine(summary.greatest, -1.0, size);
  summary.mean = mean_over(region, field, panels);
  summary.mean_error = std::abs(summary.mean - mean_over(region, field, panels / 2));
  return summary;
}

class ConditioningCommand final : public Command {
 public:
  ConditioningCommand()
      : Command(
            "conditioning", "The inverse condition number over the workspace",
            "A map of kappa^-1 (Frobenius norm) over the workspace at one orientation, its least and greatest value, "
            "and\n"
            "the global conditioning index, which is its mean over the workspace's area. 0 is a singular pose, 1 an\n"
            "isotropic one.",
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
      for (const char* key : {"kappa_inv_min", "kappa_inv_min_at", "kappa_inv_max", "kappa_inv_max_at",
                              "global_conditioning_index", "global_conditioning_index_error"}) {
        document[key] = nullptr;
      }
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
    document["kappa_inv_max"] = summary.greatest.value;
    document["kappa_inv_max_at"] = to_json(summary.greatest.position);
    document["global_conditioning_index"] = summary.mean;
    document["global_conditioning_index_error"] = summary.mean_error;
    document["singular_inside"] = summary.singular_inside;
    const auto place = [](const MapPoint& point) {
      return fmt::format("{:<10} at x = {}, y = {}", short_number(point.value), short_number(point.position.x()),
                         short_number(point.position.y()));
    };
    output.text = fmt::format(
        "{}\narea                        {}\nleast kappa^-1              {}\ngreatest kappa^-1           {}\n"
        "global conditioning index   {} (+- {:.1g})\n{}\n",
        title, short_number(region.area()), place(summary.least), place(summary.greatest), short_number(summary.mean),
        summary.mean_error,
        summary.singular_inside ? "The workspace holds singular poses."
                                : "No singular pose was found in the workspace.");
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
