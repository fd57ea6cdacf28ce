// Standard problems with a known solution.

#include "bindings.hpp"
#include "reprise/optimizers/standard_problems.hpp"

namespace reprise::python {

void bind_problems(py::module_& module) {
  using namespace py::literals;
  py::class_<StandardProblem>(module, "StandardProblem", "A problem with the start of its source and its solution.")
      .def_property_readonly("name", [](const StandardProblem& one) { return one.problem.name; })
      .def_readonly("problem", &StandardProblem::problem, "A Problem, with exact derivatives.")
      .def_readonly("start", &StandardProblem::start, "Array (n,), as printed in the source.")
      .def_readonly("optimum", &StandardProblem::optimum, "Array (n,): the lowest feasible point that is known.")
      .def_readonly("f_optimum", &StandardProblem::f_optimum, "f at the optimum.")
      .def_readonly("source", &StandardProblem::source, "Where the problem is taken from.")
      .def_readonly("remark", &StandardProblem::remark, "What is irregular about it; may be empty.")
      .def(py::pickle([](const StandardProblem& one) { return py::make_tuple(one.problem.name); },
                      [](const py::tuple& state) { return standard_problem(state[0].cast<std::string>()); }));
  module.def("standard_problems", &standard_problems,
             "All problems with a known solution: those of Hock and Schittkowski, and beale.\n\n"
             ">>> import reprise\n>>> len(reprise.standard_problems())\n109\n");
  module.def(
      "standard_problem", [](const std::string& name) { return standard_problem(name); }, "name"_a,
      "The problem of that name, such as \"hs71\".\n\n"
      ">>> import reprise\n>>> hs71 = reprise.standard_problem(\"hs71\")\n"
      ">>> hs71.problem.solve(hs71.start)[\"fun\"].__round__(4)\n17.014\n");
}

}  // namespace reprise::python
