#pragma once

// What the bindings of all subjects share.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <vector>

#include "reprise/kinematics/manipulator.hpp"
#include "reprise/study/documents.hpp"

namespace reprise::python {

namespace py = pybind11;

/// Numbers of any shape and strides; only what is no array of doubles is converted.
using Array = py::array_t<double, py::array::forcecast>;

/// Points as an array of shape (n, 2).
Array to_array(const std::vector<Eigen::Vector2d>& points);
/// Intervals as an array of shape (n, 2).
Array to_array(const std::vector<Interval>& intervals);

/// The rows of an array of shape (n, 2). Throws std::invalid_argument, naming it, for another shape.
std::vector<Eigen::Vector2d> to_points(const char* name, const Array& array);

/// A document as dictionaries, lists, numbers and texts.
py::object to_python(const Json& document);

/// Throws what a signal handler of Python has thrown, such as KeyboardInterrupt. May be called without the GIL; looks
/// at most every 20 ms, so that it may be called often.
class Signals {
 public:
  void check();  ///< see above

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void bind_manipulator(py::module_& module);
void bind_regions(py::module_& module);
void bind_optimizers(py::module_& module);
void bind_problems(py::module_& module);
void bind_synthesis(py::module_& module);

}  // namespace reprise::python
