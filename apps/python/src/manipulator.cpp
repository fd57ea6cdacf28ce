// Manipulators, poses, assembly modes and conditioning.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/base/require.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/kinematics/conditioning_field.hpp"
#include "reprise/kinematics/forward_kinematics.hpp"
#include "reprise/study/pose_documents.hpp"
#include "reprise/study/problem_file.hpp"
#include "reprise/workspace/orientation_workspace.hpp"

namespace reprise::python {

namespace {

Normalisation normalisation_called(const std::string& name) {
  require(name == "homogeneous" || name == "printed", "normalisation", name, "homogeneous or printed");
  return name == "printed" ? Normalisation::printed : Normalisation::homogeneous;
}

using Angles = std::optional<std::vector<std::optional<std::array<double, 2>>>>;

std::optional<Interval> angle_of(const char* name, const Angles& angles, std::size_t leg, std::size_t legs) {
  if (!angles) return std::nullopt;
  require(angles->size() == legs, name, angles->size(), "one entry for each leg");
  const auto& limits = (*angles)[leg];
  return limits ? std::optional<Interval>({(*limits)[0], (*limits)[1]}) : std::nullopt;
}

ManipulatorInput make(const Array& base_joints, const Array& platform_joints, const Array& lengths,
                      const Angles& base_angles, const Angles& platform_angles, const std::string& name,
                      const std::string& normalisation, std::optional<double> characteristic_length,
                      const std::string& unit) {
  const auto base = to_points("base_joints", base_joints);
  const auto platform = to_points("platform_joints", platform_joints);
  const auto limits = to_points("lengths", lengths);
  require(platform.size() == base.size(), "platform_joints' number of legs", platform.size(), "that of base_joints");
  require(limits.size() == base.size(), "lengths' number of legs", limits.size(), "that of base_joints");
  std::vector<Leg> legs;
  for (std::size_t i = 0; i < base.size(); ++i) {
    legs.push_back({base[i],
                    platform[i],
                    {limits[i].x(), limits[i].y()},
                    angle_of("base_angles' number of legs", base_angles, i, base.size()),
                    angle_of("platform_angles' number of legs", platform_angles, i, base.size())});
  }
  ManipulatorInput input{Manipulator(name, std::move(legs)),
                         {normalisation_called(normalisation), characteristic_length}};
  reprise::characteristic_length(input.manipulator, input.conditioning);  // throws where the length is out of bounds
  input.unit = unit;
  return input;
}

Array joints(const ManipulatorInput& input, Eigen::Vector2d Leg::*joint) {
  std::vector<Eigen::Vector2d> points;
  for (const Leg& leg : input.manipulator.legs()) points.push_back(leg.*joint);
  return to_array(points);
}

py::list angles(const ManipulatorInput& input, std::optional<Interval> Leg::*angle) {
  py::list result;
  for (const Leg& leg : input.manipulator.legs()) {
    const std::optional<Interval>& limits = leg.*angle;
    if (limits) {
      result.append(py::make_tuple(limits->lower, limits->upper));
    } else {
      result.append(py::none());
    }
  }
  return result;
}

Array lengths(const ManipulatorInput& input) {
  std::vector<Interval> limits;
  for (const Leg& leg : input.manipulator.legs()) limits.push_back(leg.length);
  return to_array(limits);
}

const char* normalisation(const ManipulatorInput& input) {
  return input.conditioning.normalisation == Normalisation::printed ? "printed" : "homogeneous";
}

constexpr py::ssize_t block_size = 512;

/// x, y and orientation of some poses.
using PoseBlock = std::array<Eigen::Array<double, block_size, 1>, 3>;

/// kappa^-1 at the first poses of a block: together where all have one orientation, one by one elsewhere.
void kappa_inverse_block(const ManipulatorInput& input, const PoseBlock& poses, Eigen::Index size, double* values) {
  const auto& [x, y, orientation] = poses;
  const bool finite = x.head(size).isFinite().all() && y.head(size).isFinite().all();
  if (finite && std::isfinite(orientation[0]) && (orientation.head(size) == orientation[0]).all()) {
    kappa_inverse_at(input.manipulator, orientation[0], x.head(size), y.head(size), input.conditioning,
                     Eigen::Map<Eigen::ArrayXd>(values, size));
    return;
  }
  for (Eigen::Index k = 0; k < size; ++k) {
    values[k] = std::isfinite(x[k] + y[k] + orientation[k])
                    ? kappa_inverse(input.manipulator, {{x[k], y[k]}, orientation[k]}, input.conditioning)
                    : std::numeric_limits<double>::quiet_NaN();
  }
}

/// All poses of arrays that are broadcast against each other, block by block.
py::object kappa_inverses(const ManipulatorInput& input, const Array& x, const Array& y, const Array& orientation) {
  const py::tuple all = py::module_::import("numpy").attr("broadcast_arrays")(x, y, orientation);
  const std::array<py::array, 3> arrays{all[0], all[1], all[2]};
  const std::vector<py::ssize_t> shape(arrays[0].shape(), arrays[0].shape() + arrays[0].ndim());
  py::array_t<double> result(shape);
  double* const values = result.mutable_data();
  const py::ssize_t count = result.size();
  {
    const py::gil_scoped_release released;
    PoseBlock coordinates;
    std::vector<py::ssize_t> index(shape.size(), 0);
    Signals signals;
    for (py::ssize_t first = 0; first < count; first += block_size) {
      const py::ssize_t size = std::min(block_size, count - first);
      std::array<const char*, 3> at{};
      for (std::size_t a = 0; a < 3; ++a) {
        at[a] = static_cast<const char*>(arrays[a].data());
        for (std::size_t d = 0; d < shape.size(); ++d)
          at[a] += index[d] * arrays[a].strides(static_cast<py::ssize_t>(d));
      }
      for (py::ssize_t k = 0; k < size; ++k) {
        for (std::size_t a = 0; a < 3; ++a) {
          coordinates[a][k] = *reinterpret_cast<const double*>(at[a]);
        }
        for (std::size_t d = shape.size(); d-- > 0;) {
          const bool over = ++index[d] == shape[d];
          for (std::size_t a = 0; a < 3; ++a) {
            const py::ssize_t stride = arrays[a].strides(static_cast<py::ssize_t>(d));
            at[a] += over ? -(shape[d] - 1) * stride : stride;
          }
          if (!over) break;
          index[d] = 0;
        }
      }
      kappa_inverse_block(input, coordinates, size, values + first);
      signals.check();
    }
  }
  if (shape.empty()) return py::float_(values[0]);
  return result;
}

/// For designs of the thesis's family, the last axis of `designs`.
py::object kappa_inverses_of_designs(const Array& designs, const Array& x, const Array& y, const Array& orientation,
                                     const std::string& normalisation) {
  require(designs.ndim() > 0 && designs.shape(designs.ndim() - 1) == 5, "designs' last axis",
          designs.ndim() > 0 ? designs.shape(designs.ndim() - 1) : 0, "5: x_C, y_C, x_D, x_E, r");
  const Conditioning conditioning{normalisation_called(normalisation), std::nullopt};
  const auto one = [&](double x_c, double y_c, double x_d, double x_e, double r, double px, double py, double phi) {
    const Pose pose{{px, py}, phi};
    if (!std::isfinite(px + py + phi + x_c + y_c + x_d + x_e + r)) return std::numeric_limits<double>::quiet_NaN();
    const Manipulator manipulator =
        make_manipulator({x_c, y_c, x_d, x_e, r}, {Interval{0.0, 1.0}, Interval{0.0, 1.0}, Interval{0.0, 1.0}});
    return kappa_inverse(manipulator, pose, conditioning);
  };
  std::vector<Array> parts;
  for (int k = 0; k < 5; ++k) parts.push_back(designs[py::make_tuple(py::ellipsis(), k)].cast<Array>());
  return py::vectorize(one)(parts[0], parts[1], parts[2], parts[3], parts[4], x, y, orientation);
}

}  // namespace

void bind_manipulator(py::module_& module) {
  using namespace py::literals;
  py::class_<ManipulatorInput>(module, "Manipulator",
                               R"(A planar parallel manipulator: a platform on legs of variable length.

base_joints: array (n, 2), c_i in the world frame, lengths.
platform_joints: array (n, 2), p_i in the platform's frame, whose origin is the working point P.
lengths: array (n, 2), the least and the greatest length of each leg.
base_angles, platform_angles: one (lower, upper) in radians, or None, for each leg.
normalisation: "homogeneous" (free of units) or "printed" (eq. (5.13) of the thesis), for kappa_inverse.
characteristic_length: a length, or None for the root mean square distance of the platform joints from P.
Raises ValueError for what no manipulator has.

>>> import reprise
>>> m = reprise.Manipulator([[0, 0], [2, 0], [1, 2]], [[-1, 0], [1, 0], [0, 1]], [[1, 2]] * 3)
>>> m.legs
3
)")
      .def(py::init(&make), "base_joints"_a, "platform_joints"_a, "lengths"_a, py::kw_only(),
           "base_angles"_a = py::none(), "platform_angles"_a = py::none(), "name"_a = "manipulator",
           "normalisation"_a = "homogeneous", "characteristic_length"_a = py::none(), "unit"_a = "")
      .def_static(
          "from_file", [](const std::filesystem::path& file) { return read_manipulator(file); }, "file"_a,
          "The manipulator of a TOML file, as `reprise help input` describes it. Raises InputError, a ValueError, with "
          "file, line and key.")
      .def(
          "to_toml", [](const ManipulatorInput& input) { return to_toml(input); },
          "The manipulator as a file that from_file reads back.")
      .def_property_readonly("name", [](const ManipulatorInput& input) { return input.manipulator.name(); })
      .def_property_readonly(
          "legs", [](const ManipulatorInput& input) { return input.manipulator.size(); }, "Number of legs.")
      .def_property_readonly(
          "base_joints", [](const ManipulatorInput& i) { return joints(i, &Leg::base_joint); },
          "c_i, array (n, 2), lengths.")
      .def_property_readonly(
          "platform_joints", [](const ManipulatorInput& i) { return joints(i, &Leg::platform_joint); },
          "p_i, array (n, 2), lengths.")
      .def_property_readonly("lengths", &lengths, "Least and greatest leg lengths, array (n, 2).")
      .def_property_readonly(
          "base_angles", [](const ManipulatorInput& i) { return angles(i, &Leg::base_angle); },
          "For each leg (lower, upper) in radians, or None.")
      .def_property_readonly(
          "platform_angles", [](const ManipulatorInput& i) { return angles(i, &Leg::platform_angle); },
          "For each leg (lower, upper) in radians, or None.")
      .def_property_readonly("normalisation", &normalisation, "\"homogeneous\" or \"printed\".")
      .def_property_readonly(
          "characteristic_length", [](const ManipulatorInput& i) { return i.conditioning.characteristic_length; },
          "L, a length, where one was given.")
      .def_readonly("unit", &ManipulatorInput::unit, "The unit of its lengths; may be empty.")
      .def("__copy__", [](const ManipulatorInput& input) { return input; })
      .def("__deepcopy__", [](const ManipulatorInput& input, const py::dict&) { return input; })
      .def("__repr__",
           [](const ManipulatorInput& input) {
             return "<reprise.Manipulator '" + input.manipulator.name() + "', " +
                    std::to_string(input.manipulator.size()) + " legs>";
           })
      .def(py::pickle(
          [](const ManipulatorInput& i) {
            return py::make_tuple(joints(i, &Leg::base_joint), joints(i, &Leg::platform_joint), lengths(i),
                                  angles(i, &Leg::base_angle), angles(i, &Leg::platform_angle), i.manipulator.name(),
                                  normalisation(i), i.conditioning.characteristic_length, i.unit, i.as_design);
          },
          [](const py::tuple& state) {
            ManipulatorInput input =
                make(state[0].cast<Array>(), state[1].cast<Array>(), state[2].cast<Array>(), state[3].cast<Angles>(),
                     state[4].cast<Angles>(), state[5].cast<std::string>(), state[6].cast<std::string>(),
                     state[7].cast<std::optional<double>>(), state[8].cast<std::string>());
            input.as_design = state[9].cast<bool>();
            return input;
          }));

  module.def(
      "collinear",
      [](const Eigen::Matrix<double, 5, 1>& design, const Array& limits) {
        const auto rows = to_points("lengths", limits);
        require(rows.size() == 3, "lengths' number of legs", rows.size(), "3");
        std::array<Interval, 3> intervals{};
        for (std::size_t i = 0; i < 3; ++i) intervals[i] = {rows[i].x(), rows[i].y()};
        ManipulatorInput input{make_manipulator(to_collinear_design(design), intervals), {}};
        return input;
      },
      "design"_a, "lengths"_a, R"(The thesis's manipulator of a design [x_C, y_C, x_D, x_E, r] (eq. (5.36)).

lengths: array (3, 2), the least and the greatest length of each leg.

>>> import reprise
>>> reprise.collinear([-0.5, 0, 0.5, 1.5, 0.5], [[1, 2]] * 3).legs
3
)");
  module.def(
      "pose",
      [](const ManipulatorInput& input, const Eigen::Vector2d& position, double orientation) {
        return to_python(pose_json(input, position, orientation / degree));
      },
      "manipulator"_a, "position"_a, "orientation"_a = 0.0,
      R"(What `reprise pose` tells of a pose, as a dictionary: leg lengths, limits, Jacobian, conditioning.

position: (x, y) of the working point, lengths. orientation: radians. `reprise help json` describes the keys.

>>> import reprise
>>> m = reprise.Manipulator([[0, 0], [2, 0]], [[0, 0], [0, 0]], [[1, 2]] * 2)
>>> reprise.pose(m, [0, 1.5])["legs"]
[1.5, 2.5]
)");
  module.def(
      "assembly_modes",
      [](const ManipulatorInput& input, const std::array<double, 3>& given) {
        const AssemblyModes modes = assembly_modes(input.manipulator, given);
        Array poses({static_cast<py::ssize_t>(modes.poses.size()), py::ssize_t{3}});
        auto rows = poses.mutable_unchecked<2>();
        for (std::size_t k = 0; k < modes.poses.size(); ++k) {
          const auto row = static_cast<py::ssize_t>(k);
          rows(row, 0) = modes.poses[k].position.x();
          rows(row, 1) = modes.poses[k].position.y();
          rows(row, 2) = modes.poses[k].orientation;
        }
        return py::dict("poses"_a = poses, "multiplicities"_a = modes.multiplicities,
                        "infinitely_many"_a = modes.infinitely_many);
      },
      "manipulator"_a, "lengths"_a,
      R"(All poses of a manipulator with three legs of the given lengths, at most six.

Returns a dictionary: `poses`, array (k, 3) of x, y and orientation in radians, sorted by orientation; `multiplicities`,
how many modes come together at each; `infinitely_many`, whether the lengths leave a motion free. Limits play no part.

>>> import reprise
>>> m = reprise.collinear([-0.5, 0, 0.5, 1.5, 0.5], [[1, 2]] * 3)
>>> reprise.assembly_modes(m, [1.5, 1.5, 1.5])["poses"].shape[1]
3
)");
  module.def(
      "kappa_inverse", &kappa_inverses, "manipulator"_a, "x"_a, "y"_a, "orientation"_a = 0.0,
      R"(The inverse condition number kappa^-1 in the Frobenius norm, from 0 (singular) to 1 (isotropic), at many poses.

x, y: positions, lengths; orientation: radians. The three are broadcast against each other, whatever their strides, and
no array of doubles is copied. Returns an array of the broadcast shape, or a number; NaN where a pose is not finite.

>>> import numpy, reprise
>>> m = reprise.collinear([-0.5, 0, 0.5, 1.5, 0.5], [[1, 2]] * 3)
>>> reprise.kappa_inverse(m, numpy.linspace(0, 1, 4)[:, None], [1.0, 1.5]).shape
(4, 2)
)");
  module.def("kappa_inverse_of_designs", &kappa_inverses_of_designs, "designs"_a, "x"_a, "y"_a, "orientation"_a = 0.0,
             py::kw_only(), "normalisation"_a = "homogeneous",
             R"(kappa^-1 for many designs of the thesis's family, and poses, broadcast against each other.

designs: array (..., 5) of [x_C, y_C, x_D, x_E, r]; its last axis is taken off before broadcasting.

>>> import reprise
>>> reprise.kappa_inverse_of_designs([[-0.5, 0, 0.5, 1.5, 0.5], [-0.5, 0, 0.5, 1.5, 0.6]], 0.5, 1.5).shape
(2,)
)");
  module.def(
      "orientation_workspace",
      [](const ManipulatorInput& input, const Eigen::Vector2d& position) {
        return to_array(orientation_workspace(input.manipulator, position));
      },
      "manipulator"_a, "position"_a,
      R"(All orientations that can be attained at a position (x, y): array (k, 2) of intervals, radians, in closed form.

>>> import reprise
>>> m = reprise.Manipulator([[0, 0], [2, 0]], [[0, 0], [0, 0]], [[1, 2]] * 2)
>>> reprise.orientation_workspace(m, [1, 1]).round(3).tolist()
[[-3.142, 3.142]]
)");
}

}  // namespace reprise::python
