#include "reprise/optimizers/result_report.hpp"

#include <cmath>

#include "reprise/base/require.hpp"
#include "reprise/optimizers/kkt_residual.hpp"
#include "reprise/optimizers/tolerances.hpp"
#include "short_text.hpp"

namespace reprise {
namespace {

constexpr int digits = 6;

std::string counted(long count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

void add_line(std::string& text, std::string_view name, std::string_view value) {
  constexpr std::size_t width = 20;
  text += name;
  text.append(width - name.size(), ' ');
  text += value;
  text += '\n';
}

void add_count(std::string& list, std::string_view name, long count) {
  if (count == 0) return;
  if (!list.empty()) list += ", ";
  list += std::string(name) + " " + std::to_string(count);
}

std::string or_none(const std::string& list) { return list.empty() ? "none" : list; }

/// "x_1 at its lower bound, x_3 fixed"
std::string active_bounds(const Problem& problem, const Eigen::VectorXd& x) {
  const Eigen::VectorXd units = variable_units(problem, x);
  std::string list;
  for (Eigen::Index i = 0; i < problem.n; ++i) {
    const double tolerance = active_bound_tolerance * units[i];
    const bool at_lower = problem.lower.size() != 0 && x[i] - problem.lower[i] <= tolerance;
    const bool at_upper = problem.upper.size() != 0 && problem.upper[i] - x[i] <= tolerance;
    if (!at_lower && !at_upper) continue;
    if (!list.empty()) list += ", ";
    list += "x_" + std::to_string(i + 1);
    list += at_lower && at_upper ? " fixed" : at_lower ? " at its lower bound" : " at its upper bound";
  }
  return or_none(list);
}

}  // namespace

std::string brief_report(const Result& result) {
  std::string text(to_string(result.status));
  text += ": f = " + short_text(result.f, digits) + ", violation " + short_text(result.violation, digits);
  if (!std::isnan(result.kkt_residual)) text += ", KKT residual " + short_text(result.kkt_residual, digits);
  text += "; " + counted(result.iterates, "iterate", "iterates") + ", " +
          std::to_string(result.counts.function_evaluations()) + " + " +
          std::to_string(result.counts.gradient_evaluations()) + " evaluations (functions + gradients)";
  return text;
}

std::string full_report(const Result& result, const Problem& problem) {
  require(result.x.size() == problem.n, "the number of variables of the result", result.x.size(),
          std::to_string(problem.n) + ", as the problem has");
  const Counts& counts = result.counts;
  std::string functions;
  add_count(functions, "objective", counts.objective);
  add_count(functions, "inequalities", counts.inequality);
  add_count(functions, "equalities", counts.equality);
  std::string derivatives;
  add_count(derivatives, "objective's gradient", counts.objective_gradient);
  add_count(derivatives, "inequalities' Jacobian", counts.inequality_jacobian);
  add_count(derivatives, "equalities' Jacobian", counts.equality_jacobian);
  add_count(derivatives, "Lagrangian's Hessian", counts.lagrangian_hessian);

  std::string text;
  add_line(text, "problem",
           problem.name + ": " + counted(problem.n, "variable", "variables") + ", " +
               counted(problem.inequalities, "inequality", "inequalities") + ", " +
               counted(problem.equalities, "equality", "equalities"));
  add_line(text, "status",
           std::string(to_string(result.status)) + " (code " + std::to_string(result.solver_code) + ")");
  add_line(text, "reason", result.message);
  add_line(text, "f", short_text(result.f, digits));
  add_line(text, "largest violation", short_text(result.violation, digits));
  add_line(text, "KKT residual",
           std::isnan(result.kkt_residual) ? "not looked at" : short_text(result.kkt_residual, digits));
  add_line(text, "iterates", std::to_string(result.iterates));
  add_line(text, "functions", or_none(functions));
  add_line(text, "derivatives", or_none(derivatives));
  add_line(text, "active bounds", active_bounds(problem, result.x));
  add_line(text, "x", shown(result.x));
  return text;
}

std::string history_csv(const Result& result) {
  std::string text = "iterate,f,violation,functions,gradients";
  const Eigen::Index n = result.history.empty() ? 0 : result.history.front().x.size();
  for (Eigen::Index i = 0; i < n; ++i) text += ",x_" + std::to_string(i + 1);
  text += '\n';
  for (const Iterate& iterate : result.history) {
    text += std::to_string(iterate.index) + "," + shown(iterate.f) + "," + shown(iterate.violation) + "," +
            std::to_string(iterate.counts.function_evaluations()) + "," +
            std::to_string(iterate.counts.gradient_evaluations());
    for (const double x : iterate.x) text += "," + shown(x);
    text += '\n';
  }
  return text;
}

}  // namespace reprise
