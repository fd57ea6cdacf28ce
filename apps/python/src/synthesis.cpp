// Syntheses, enclosures and certificates.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "reprise/base/require.hpp"
#include "reprise/bounds/global_optimum.hpp"
#include "reprise/io/compression.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/study/bound_claim.hpp"
#include "reprise/study/problem_file.hpp"
#include "reprise/study/reach_search.hpp"
#include "reprise/study/synthesis_documents.hpp"
#include "reprise/study/synthesis_run.hpp"

namespace reprise::python {

namespace {

py::dict minimum(const MinimumEnclosure& smallest) {
  using namespace py::literals;
  py::object witness = py::none();
  if (smallest.witness) {
    witness =
        py::make_tuple(smallest.witness->position.x(), smallest.witness->position.y(), smallest.witness->orientation);
  }
  return py::dict("lower"_a = smallest.lower, "upper"_a = smallest.upper, "witness"_a = witness,
                  "evaluations"_a = smallest.evaluations, "reached"_a = smallest.reached);
}

py::dict prove(const ProblemInput& problem, const Eigen::VectorXd& design) {
  using namespace py::literals;
  const DesignProof proof = [&] {
    const py::gil_scoped_release released;
    return prove_design(problem.task, design);
  }();
  return py::dict("reaches"_a = std::string(to_string(proof.reaches)), "violation"_a = proof.violation,
                  "violation_bound"_a = proof.violation_bound, "kappa_inverse"_a = minimum(proof.kappa_inverse),
                  "evaluations"_a = proof.evaluations);
}

py::dict synthesize(const ProblemInput& problem, const std::string& optimizer, long starts,
                    const std::string& formulation, long points, long max_evaluations, long seed) {
  using namespace py::literals;
  const std::vector<std::string> names = synthesis_solver_names();
  require(std::find(names.begin(), names.end(), optimizer) != names.end(), "optimizer", optimizer,
          "one of synthesis_solver_names()");
  require(formulation == "pointwise" || formulation == "area", "formulation", formulation, "pointwise or area");
  require(starts >= 1, "starts", starts, "at least 1");
  require(points >= 1, "points", points, "at least 1");
  require(max_evaluations >= 1, "max_evaluations", max_evaluations, "at least 1");
  require(seed >= 0, "seed", seed, "at least 0");
  SynthesisSettings settings;
  settings.formulation = formulation;
  settings.points = points;
  settings.max_evaluations = max_evaluations;
  settings.seed = seed;
  std::vector<SynthesisOutcome> runs;
  const ScaledProblem scaled = scale(problem);
  {
    const py::gil_scoped_release released;
    const NamedSolver named = settings.solvers({optimizer}).front();
    Signals signals;
    const std::function<bool()> stopped = [&signals] {
      signals.check();
      return false;
    };
    const Stop no_limit(std::nullopt);
    Progress progress(static_cast<std::size_t>(starts));
    for (const Eigen::VectorXd& start : make_starts(scaled, starts, seed)) {
      runs.push_back(solve_where_reached(scaled, named.name, start, stopped, [&](const Eigen::VectorXd& from) {
        signals.check();
        return solve(scaled, settings, named, from, no_limit, progress);
      }));
      signals.check();
    }
  }
  const SynthesisOutcome& best = *std::min_element(runs.begin(), runs.end(), better);
  const Eigen::VectorXd design = best.design * scaled.unit;
  py::list all;
  for (const SynthesisOutcome& run : runs) all.append(to_python(run_json(run, scaled.unit)));
  return py::dict("design"_a = design, "manipulator"_a = found_manipulator(problem, design),
                  "reaches"_a = std::string(to_string(best.proof.reaches)),
                  "kappa_inverse"_a = minimum(best.proof.kappa_inverse), "violation"_a = best.proof.violation,
                  "history"_a = to_python(history_json(best, scaled.unit)), "runs"_a = all);
}

py::dict global_optimum(const ProblemInput& problem, int side, double gap, long max_boxes, long threads,
                        const std::optional<std::filesystem::path>& certificate,
                        const std::filesystem::path& problem_file) {
  using namespace py::literals;
  const GlobalOptimum found = [&] {
    const py::gil_scoped_release released;
    Signals signals;
    GlobalOptions options{.gap = gap, .side = side, .max_boxes = max_boxes, .threads = threads};
    options.stop = [&signals] {
      signals.check();
      return false;
    };
    return prove_global_optimum(problem.task, options);
  }();
  if (certificate && !found.certificate.nodes.empty()) {
    const std::filesystem::path tree = certificate->filename().replace_extension(".cert.gz");
    write_file(certificate->parent_path() / tree, compress(to_text(found.certificate)));
    write_file(*certificate,
               to_toml(StoredClaim{
                   std::filesystem::absolute(problem_file), tree, {side, found.upper, found.certificate.root}}));
  }
  return py::dict("status"_a = std::string(to_string(found.status)), "design"_a = found.design, "lower"_a = found.lower,
                  "upper"_a = found.upper, "boxes"_a = found.counts.examined);
}

}  // namespace

void bind_synthesis(py::module_& module) {
  using namespace py::literals;
  py::class_<ProblemInput>(module, "SynthesisProblem", "A prescribed workspace, and the designs to choose from.")
      .def_property_readonly(
          "manipulator", [](const ProblemInput& problem) { return problem.start; },
          "The manipulator of the file, from which a search starts.")
      .def_readonly("design", &ProblemInput::design, "Its design vector d, array (k,).")
      .def_property_readonly(
          "names", [](const ProblemInput& problem) { return problem.task.designs.names(); }, "Of the design variables.")
      .def(
          "outline",
          [](const ProblemInput& problem, int count) { return to_array(problem.task.prescribed.points(count)); },
          "count"_a, "At least `count` points of the prescribed outline, all corners among them: array (m, 2).");
  module.def(
      "read_problem", [](const std::filesystem::path& file) { return read_problem(file); }, "file"_a,
      "A synthesis problem from its TOML file, as `reprise help input` describes it. Raises InputError.");
  module.def("synthesis_solver_names", &synthesis_solver_names, "The optimizers that synthesize takes.");
  module.def("synthesize", &synthesize, "problem"_a, py::kw_only(), "optimizer"_a = "dynamic_q_safeguarded",
             "starts"_a = 1, "formulation"_a = "pointwise", "points"_a = 1000, "max_evaluations"_a = 5000, "seed"_a = 1,
             R"(The best conditioned design that reaches the prescribed workspace, near each of some starts.

Returns a dictionary: `design`, array (k,); its `manipulator`; `reaches`, "proved", "refuted" or "undecided";
`kappa_inverse`, the proved bounds of its smallest value with a witness (x, y, radians); `violation`, a length; `history`
and `runs`, as `reprise help json` has them. prove_global_optimum tells how good any design can be.)");
  module.def("prove_design", &prove, "problem"_a, "design"_a,
             "What is proved of a design over the whole prescribed workspace and range: whether it reaches all of it, "
             "and bounds of the smallest kappa^-1.");
  module.def(
      "prove_global_optimum",
      [](const ProblemInput& problem, int side, double gap, long max_boxes, long threads) {
        return global_optimum(problem, side, gap, max_boxes, threads, std::nullopt, {});
      },
      "problem"_a, py::kw_only(), "side"_a = 1, "gap"_a = 1e-6, "max_boxes"_a = 1'000'000, "threads"_a = 1,
      "Bounds of the best kappa^-1 of any design of the thesis's family with this sign (1 or -1) of r.");
  module.def(
      "write_certificate",
      [](const ProblemInput& problem, const std::filesystem::path& problem_file,
         const std::filesystem::path& certificate, int side, double gap,
         long max_boxes) { return global_optimum(problem, side, gap, max_boxes, 1, certificate, problem_file); },
      "problem"_a, "problem_file"_a, "certificate"_a, py::kw_only(), "side"_a = 1, "gap"_a = 1e-6,
      "max_boxes"_a = 1'000'000,
      "prove_global_optimum, with its proof in files: the claim in `certificate`, a name with the ending .toml, and "
      "the "
      "tree of boxes beside it.");
  module.def(
      "check_certificate",
      [](const std::filesystem::path& file) {
        const py::gil_scoped_release released;
        const CheckResult result = check_claim(file).result;
        const py::gil_scoped_acquire acquired;
        return py::dict("proved"_a = result.proved, "failure"_a = result.failure, "leaves"_a = result.leaves);
      },
      "file"_a, "Whether a certificate proves its claim: a checker that shares no code with the prover.");
  module.def(
      "enclose_minimum",
      [](const ManipulatorInput& manipulator, const ProblemInput& problem, double lower, double upper) {
        return minimum([&] {
          const py::gil_scoped_release released;
          return enclose_minimum(manipulator.manipulator, problem.task.prescribed, Interval{lower, upper},
                                 manipulator.conditioning);
        }());
      },
      "manipulator"_a, "problem"_a, "lower"_a, "upper"_a,
      "Bounds of the smallest kappa^-1 over the prescribed workspace and all orientations from lower to upper "
      "(radians).");
}

}  // namespace reprise::python
