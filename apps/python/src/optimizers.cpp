// Optimization problems and solvers.

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "bindings.hpp"
#include "reprise/base/require.hpp"
#include "reprise/optimizers/problem.hpp"
#include "reprise/optimizers/solver.hpp"
#include "reprise/study/solvers.hpp"

namespace reprise::python {

namespace {

using Vector = Eigen::VectorXd;

/// A Python function that C++ may copy, call and forget without the GIL.
class Function {
 public:
  explicit Function(py::object function)
      : function_(new py::object(std::move(function)), [](py::object* held) {
          const py::gil_scoped_acquire acquired;
          delete held;
        }) {}

  double number(const Vector& x) const {
    const py::gil_scoped_acquire acquired;
    return py::float_((*function_)(x));
  }

  /// Values as an array of this shape, named in the message where they are not.
  template <class Result>
  Result values(const char* name, const Vector& x, Eigen::Index rows, Eigen::Index columns) const {
    const py::gil_scoped_acquire acquired;
    const py::object numpy = py::module_::import("numpy");
    const py::object given = numpy.attr("asarray")((*function_)(x), py::arg("dtype") = "float64");
    const py::object shaped = columns > 0 ? numpy.attr("atleast_2d")(given) : numpy.attr("atleast_1d")(given);
    const py::tuple shape = shaped.attr("shape");
    const bool fits = static_cast<Eigen::Index>(shape.size()) == (columns > 0 ? 2 : 1) &&
                      shape[0].cast<Eigen::Index>() == rows &&
                      (columns == 0 || shape[1].cast<Eigen::Index>() == columns);
    if (!fits) {
      throw std::invalid_argument(std::string(name) + " returned an array of shape " +
                                  py::str(given.attr("shape")).cast<std::string>() + ", but it must be (" +
                                  std::to_string(rows) + (columns > 0 ? ", " + std::to_string(columns) : ",") + ").");
    }
    return shaped.cast<Result>();
  }

 private:
  std::shared_ptr<py::object> function_;
};

std::function<void(const Vector&, SparseMatrix&)> jacobian_of(const char* name, const py::object& function,
                                                              Eigen::Index rows, Eigen::Index n) {
  if (function.is_none()) return {};
  return dense_jacobian([call = Function(function), name, rows, n](const Vector& x, Eigen::MatrixXd& jacobian) {
    jacobian = call.values<Eigen::MatrixXd>(name, x, rows, n);
  });
}

std::function<void(const Vector&, Vector&)> values_of(const char* name, const py::object& function, Eigen::Index rows) {
  if (function.is_none()) return {};
  return [call = Function(function), name, rows](const Vector& x, Vector& values) {
    values = call.values<Vector>(name, x, rows, 0);
  };
}

Problem make_problem(Eigen::Index n, const py::object& objective, const py::object& gradient, const Vector& lower,
                     const Vector& upper, Eigen::Index inequalities, const py::object& inequality,
                     const py::object& inequality_jacobian, Eigen::Index equalities, const py::object& equality,
                     const py::object& equality_jacobian, const std::string& name) {
  Problem problem;
  problem.name = name;
  problem.n = n;
  problem.lower = lower;
  problem.upper = upper;
  problem.objective = [call = Function(objective)](const Vector& x) { return call.number(x); };
  problem.objective_gradient = values_of("the gradient of the objective", gradient, n);
  problem.inequalities = inequalities;
  problem.inequality = values_of("the inequalities", inequality, inequalities);
  problem.inequality_jacobian = jacobian_of("the Jacobian of the inequalities", inequality_jacobian, inequalities, n);
  problem.equalities = equalities;
  problem.equality = values_of("the equalities", equality, equalities);
  problem.equality_jacobian = jacobian_of("the Jacobian of the equalities", equality_jacobian, equalities, n);
  validate(problem);
  return problem;
}

Derivatives derivatives_called(const std::string& name) {
  require(name == "automatic" || name == "forward" || name == "central", "derivatives", name,
          "automatic, forward or central");
  if (name == "forward") return Derivatives::forward;
  return name == "central" ? Derivatives::central : Derivatives::automatic;
}

/// What the dictionary sets; every key must be known.
void set(const py::dict& given, SolverSettings& solver, Options& run) {
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    const py::object item = py::reinterpret_borrow<py::object>(value);
    const auto number = [&](double& target) { target = py::float_(item); };
    const auto integer = [&](long& target) { target = py::int_(item); };
    if (name == "move_limit")
      number(solver.move_limit);
    else if (name == "relative_move_limit")
      number(solver.relative_move_limit);
    else if (name == "step_tolerance")
      number(solver.step_tolerance);
    else if (name == "value_tolerance")
      number(solver.value_tolerance);
    else if (name == "max_iterations")
      integer(solver.max_iterations);
    else if (name == "initial_barrier")
      number(solver.initial_barrier);
    else if (name == "seed")
      integer(solver.seed);
    else if (name == "max_points")
      integer(solver.max_points);
    else if (name == "search_radius")
      number(solver.search_radius);
    else if (name == "max_function_evaluations")
      integer(run.max_function_evaluations);
    else if (name == "feasibility_tolerance")
      number(run.feasibility_tolerance);
    else if (name == "difference_step")
      run.difference_step = py::float_(item);
    else if (name == "derivatives")
      run.derivatives = derivatives_called(item.cast<std::string>());
    else if (name == "record_history")
      run.record_history = py::bool_(item);
    else if (name == "check_stationarity")
      run.check_stationarity = py::bool_(item);
    else if (name == "check_derivatives")
      run.check_derivatives = py::bool_(item);
    else
      reject("option", name,
             "move_limit, relative_move_limit, step_tolerance, value_tolerance, max_iterations, initial_barrier, "
             "seed, max_points, search_radius, max_function_evaluations, feasibility_tolerance, difference_step, "
             "derivatives, record_history, check_stationarity or check_derivatives");
  }
}

py::dict solve(const Problem& problem, const Vector& start, const std::string& method, const py::dict& options,
               const py::object& callback) {
  using namespace py::literals;
  SolverSettings settings;
  Options run;
  run.record_history = false;
  set(options, settings, run);
  const std::vector<std::string> names = solver_names();
  std::string allowed;
  for (const std::string& name : names) allowed += (allowed.empty() ? "" : ", ") + name;
  require(std::find(names.begin(), names.end(), method) != names.end(), "method", method, "one of " + allowed);
  const std::shared_ptr<const Solver> solver = select_solvers({method}, settings).front().solver;
  Signals signals;
  run.stop = [&signals] {
    signals.check();
    return false;
  };
  Observer observer;
  if (!callback.is_none()) {
    observer = [&callback](const Iterate& iterate) {
      const py::gil_scoped_acquire acquired;
      const py::object answer = callback(iterate.x);
      return !py::isinstance<py::bool_>(answer) || !answer.cast<bool>();
    };
  }
  const Result result = [&] {
    const py::gil_scoped_release released;
    return solver->minimize(problem, start, run, observer);
  }();
  py::list history;
  for (const Iterate& iterate : result.history) {
    history.append(py::dict("x"_a = iterate.x, "fun"_a = iterate.f, "violation"_a = iterate.violation));
  }
  const Counts& counts = result.counts;
  return py::dict("x"_a = result.x, "fun"_a = result.f, "success"_a = result.status == Status::converged,
                  "status"_a = static_cast<int>(result.status), "status_name"_a = std::string(to_string(result.status)),
                  "message"_a = result.message, "nfev"_a = counts.function_evaluations(),
                  "njev"_a = counts.gradient_evaluations(), "nhev"_a = counts.lagrangian_hessian,
                  "nit"_a = result.iterates, "maxcv"_a = result.violation, "kkt_residual"_a = result.kkt_residual,
                  "solver_code"_a = result.solver_code, "history"_a = history);
}

void check_length(const Problem& problem, const Vector& x) {
  require(x.size() == problem.n, "x's length", x.size(), "the number of variables, " + std::to_string(problem.n));
}

Vector values_at(const Problem& problem, const Vector& x, Eigen::Index size,
                 const std::function<void(const Vector&, Vector&)>& function) {
  check_length(problem, x);
  Vector values(size);
  if (function) function(x, values);
  return values;
}

Eigen::MatrixXd jacobian_at(const Problem& problem, const Vector& x, Eigen::Index rows,
                            const std::function<void(const Vector&, SparseMatrix&)>& function) {
  check_length(problem, x);
  SparseMatrix jacobian(rows, problem.n);
  if (function) function(x, jacobian);
  return jacobian;
}

}  // namespace

void bind_optimizers(py::module_& module) {
  using namespace py::literals;
  py::class_<Problem>(module, "Problem", R"(minimise f(x) subject to g(x) <= 0, h(x) = 0 and bounds, x of length n.

objective(x): a number; gradient(x): array (n,), or None for differences. inequality(x), equality(x): arrays of
`inequalities` and `equalities` values; their Jacobians arrays of one row for each. lower, upper: arrays (n,), or empty.

>>> import reprise
>>> reprise.Problem(1, lambda x: (x[0] - 1) ** 2).solve([0.0])["x"].round(5).tolist()
[1.0]
)")
      .def(py::init(&make_problem), "n"_a, "objective"_a, "gradient"_a = py::none(), "lower"_a = Vector(),
           "upper"_a = Vector(), "inequalities"_a = 0, "inequality"_a = py::none(),
           "inequality_jacobian"_a = py::none(), "equalities"_a = 0, "equality"_a = py::none(),
           "equality_jacobian"_a = py::none(), "name"_a = "problem")
      .def_readonly("name", &Problem::name)
      .def_readonly("n", &Problem::n, "Number of variables.")
      .def_readonly("lower", &Problem::lower, "Array (n,), or empty.")
      .def_readonly("upper", &Problem::upper, "Array (n,), or empty.")
      .def_readonly("inequalities", &Problem::inequalities, "Number of inequalities.")
      .def_readonly("equalities", &Problem::equalities, "Number of equalities.")
      .def(
          "objective",
          [](const Problem& problem, const Vector& x) {
            check_length(problem, x);
            return problem.objective(x);
          },
          "x"_a, "f(x).")
      .def(
          "gradient", [](const Problem& p, const Vector& x) { return values_at(p, x, p.n, p.objective_gradient); },
          "x"_a, "Of the objective, array (n,).")
      .def(
          "inequality", [](const Problem& p, const Vector& x) { return values_at(p, x, p.inequalities, p.inequality); },
          "x"_a, "g(x), not positive where it holds.")
      .def(
          "equality", [](const Problem& p, const Vector& x) { return values_at(p, x, p.equalities, p.equality); },
          "x"_a, "h(x).")
      .def(
          "inequality_jacobian",
          [](const Problem& p, const Vector& x) { return jacobian_at(p, x, p.inequalities, p.inequality_jacobian); },
          "x"_a, "Array (inequalities, n).")
      .def(
          "equality_jacobian",
          [](const Problem& p, const Vector& x) { return jacobian_at(p, x, p.equalities, p.equality_jacobian); }, "x"_a,
          "Array (equalities, n).")
      .def("solve", &solve, "x0"_a, "method"_a = "dynamic_q", "options"_a = py::dict(), "callback"_a = py::none(),
           "Minimises from x0 by a solver of solver_names(). Returns a dictionary with the keys of minimize().");
  module.def("solver_names", &solver_names,
             "The methods of minimize().\n\n>>> import reprise\n>>> \"dynamic_q\" in reprise.solver_names()\nTrue\n");
}

}  // namespace reprise::python
