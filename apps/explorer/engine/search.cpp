#include "search.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "problem_json.hpp"
#include "reprise/optimizers/constraint_exchange.hpp"
#include "reprise/study/formulation.hpp"
#include "reprise/study/scaled_problem.hpp"
#include "reprise/study/solvers.hpp"
#include "reprise/synthesis/assessment.hpp"

namespace reprise::explorer {

namespace {

/// As many points as `reprise` judges a design on the way at.
constexpr int history_points = 100;
/// Points at which the design found is judged.
constexpr int judged_points = 2000;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// A solver by its name, with the options that fit.
std::shared_ptr<const Solver> dynamic_q(const std::string& name, const SolverSettings& settings) {
  for (const NamedSolver& one : dynamic_q_variants(settings)) {
    if (one.name == name) return one.solver;
  }
  throw std::logic_error("no variant of Dynamic-Q is called " + name);
}

/// One run, and what its design is worth.
struct Run {
  Result result;
  Eigen::VectorXd design;  ///< in units
  Assessment seen;
};

class Search {
 public:
  Search(const ProblemInput& problem, const std::function<void(const Json&)>& report)
      : problem_(problem), scaled_(scale(problem)), assess_(scaled_.task, history_points, 2), report_(report) {}

  Json area() const {
    FormulationSettings settings;
    SolverSettings solver;
    solver.move_limit = 0.1;
    solver.step_tolerance = 1e-4;
    solver.value_tolerance = 1e-6;
    solver.max_iterations = 500;
    const std::vector<OrientationRange>& orientations = scaled_.task.orientations;
    if (orientations.size() > 1) solver.value_tolerance = 1e-5;  // MO
    if (!orientations.front().is_slice()) {                      // D
      solver.move_limit = 0.05;
      settings.differences = Derivatives::central;
      settings.difference_step = 1e-3;
    }
    const SynthesisProblem posed = formulate(Formulation::area, scaled_.task, scaled_.start, settings);
    return document(run(*dynamic_q("dynamic_q", solver), posed));
  }

  Json pointwise() const {
    const SingularitySide side = prevailing_side(scaled_.task, scaled_.start);
    Run best = pointwise_on(side);
    if (side != SingularitySide::either && !(reaches(best) && best.seen.kappa_inverse > 0.0)) {
      Run other =
          pointwise_on(side == SingularitySide::positive ? SingularitySide::negative : SingularitySide::positive);
      const bool better = reaches(other) == reaches(best)
                              ? (reaches(other) ? other.seen.kappa_inverse > best.seen.kappa_inverse
                                                : other.seen.violation < best.seen.violation)
                              : reaches(other);
      if (better) best = std::move(other);
    }
    return document(best);
  }

 private:
  static bool reaches(const Run& run) { return run.seen.violation <= reach_tolerance; }

  Run pointwise_on(SingularitySide side) const {
    SolverSettings solver;
    solver.step_tolerance = 1e-6;
    solver.value_tolerance = 1e-8;
    solver.max_iterations = pointwise_iterations;
    const FormulationSettings settings{.points = 1000};
    const PointwiseOptions points{static_cast<int>(settings.points), side};
    const SynthesisProblem posed{pointwise_problem(scaled_.task, points),
                                 pointwise_start(scaled_.task, scaled_.start, points),
                                 run_options(Formulation::pointwise, settings)};
    return run(ConstraintExchange(dynamic_q("dynamic_q_safeguarded", solver)), posed);
  }

  Run run(const Solver& solver, const SynthesisProblem& posed) const {
    Options options = posed.options;
    options.record_history = false;
    const Observer observer = [this](const Iterate& iterate) {
      const Eigen::VectorXd design = iterate.x.head(scaled_.start.size());
      const Assessment seen = assess_(design);
      report_({{"iteration", iterate.index},
               {"evaluations", iterate.counts.function_evaluations()},
               {"gradient_evaluations", iterate.counts.gradient_evaluations()},
               {"design", in_file_unit(design)},
               {"kappa_inv", seen.kappa_inverse},
               {"violation", seen.violation * scaled_.unit},
               {"manipulator", manipulator_of(design)}});
      return true;
    };
    Run run;
    run.result = solver.minimize(posed.problem, posed.start, options, observer);
    run.design = run.result.x.head(scaled_.start.size());
    run.seen = assess(scaled_.task, run.design, judged_points, 2);
    return run;
  }

  Json document(const Run& run) const {
    return {{"design", in_file_unit(run.design)},
            {"kappa_inv", number_or_null(run.seen.kappa_inverse)},
            {"violation", run.seen.violation * scaled_.unit},
            {"reaches", reaches(run)},
            {"status", std::string(to_string(run.result.status))},
            {"message", run.result.message},
            {"evaluations", run.result.counts.function_evaluations()},
            {"gradient_evaluations", run.result.counts.gradient_evaluations()},
            {"manipulator", manipulator_of(run.design)}};
  }

  std::vector<double> in_file_unit(const Eigen::VectorXd& design) const {
    const Eigen::VectorXd own = design * scaled_.unit;
    return {own.begin(), own.end()};
  }

  Json manipulator_of(const Eigen::VectorXd& design) const {
    const ManipulatorInput& start = problem_.start;
    const Manipulator found = problem_.task.designs.manipulator(design * scaled_.unit);
    return manipulator_json({found, start.conditioning, start.as_design, start.unit});
  }

  const ProblemInput& problem_;
  ScaledProblem scaled_;
  Assessor assess_;
  const std::function<void(const Json&)>& report_;
};

}  // namespace

Json design_json(const ProblemInput& problem) {
  const ScaledProblem scaled = scale(problem);
  const AreaEvaluation seen = AreaFormulation(scaled.task).evaluate(scaled.start);
  return {{"kappa_inv", number_or_null(seen.kappa_inverse)},
          {"constraint", number_or_null(seen.constraint * scaled.unit * scaled.unit)}};
}

Json assessment_json(const ProblemInput& problem) {
  const ScaledProblem scaled = scale(problem);
  const Assessment seen = assess(scaled.task, scaled.start, judged_points, 2);
  return {{"kappa_inv", seen.kappa_inverse}, {"violation", seen.violation * scaled.unit}};
}

Json search(const ProblemInput& problem, const std::string& formulation,
            const std::function<void(const Json&)>& report) {
  const Search search(problem, report);
  if (formulation == "area") return search.area();
  if (formulation == "pointwise") return search.pointwise();
  throw std::invalid_argument("The formulation is '" + formulation + "', but must be pointwise or area.");
}

}  // namespace reprise::explorer
