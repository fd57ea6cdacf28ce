// The extension reprise._core.

#include "bindings.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/io/toml_reader.hpp"

namespace reprise::python {

Array to_array(const std::vector<Eigen::Vector2d>& points) {
  Array array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  auto rows = array.mutable_unchecked<2>();
  for (py::ssize_t k = 0; k < rows.shape(0); ++k) {
    for (py::ssize_t j = 0; j < 2; ++j) rows(k, j) = points[static_cast<std::size_t>(k)][j];
  }
  return array;
}

Array to_array(const std::vector<Interval>& intervals) {
  std::vector<Eigen::Vector2d> ends;
  for (const Interval& interval : intervals) ends.emplace_back(interval.lower, interval.upper);
  return to_array(ends);
}

std::vector<Eigen::Vector2d> to_points(const char* name, const Array& array) {
  if (array.ndim() != 2 || array.shape(1) != 2) {
    std::string shape;
    for (py::ssize_t k = 0; k < array.ndim(); ++k) shape += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
    throw std::invalid_argument(std::string(name) + " has the shape (" + shape + "), but it must be (n, 2).");
  }
  std::vector<Eigen::Vector2d> points;
  const auto rows = array.unchecked<2>();
  for (py::ssize_t k = 0; k < rows.shape(0); ++k) points.emplace_back(rows(k, 0), rows(k, 1));
  return points;
}

py::object to_python(const Json& document) {
  if (document.is_object()) {
    py::dict result;
    for (const auto& item : document.items()) result[py::str(item.key())] = to_python(item.value());
    return result;
  }
  if (document.is_array()) {
    py::list result;
    for (const Json& item : document) result.append(to_python(item));
    return result;
  }
  if (document.is_string()) return py::str(document.get<std::string>());
  if (document.is_boolean()) return py::bool_(document.get<bool>());
  if (document.is_number_integer()) return py::int_(document.get<long>());
  if (document.is_number()) return py::float_(document.get<double>());
  return py::none();
}

void Signals::check() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(20)) return;
  last_ = now;
  const py::gil_scoped_acquire acquired;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace reprise::python

PYBIND11_MODULE(_core, module) {
  using namespace reprise::python;
  module.doc() = "Workspaces and dimensional synthesis of planar parallel manipulators: the libraries of Reprise.";
  py::register_exception<reprise::InputError>(module, "InputError", PyExc_ValueError).attr("__doc__") =
      "Something wrong in a file: one sentence that names file, line, key and what is allowed.";
  bind_manipulator(module);
  bind_regions(module);
  bind_optimizers(module);
  bind_problems(module);
  bind_synthesis(module);
}
