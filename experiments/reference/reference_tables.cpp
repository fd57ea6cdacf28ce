#include "reference/reference_tables.hpp"

#include <cmath>
#include <vector>

#include "reprise/workspace/limits.hpp"

namespace reprise::experiments {
namespace {

const std::vector<Column> design_columns{{"x_C", "length", "x coordinate of base joint C"},
                                         {"y_C", "length", "y coordinate of the base joints"},
                                         {"x_D", "length", "x coordinate of base joint D"},
                                         {"x_E", "length", "x coordinate of base joint E"},
                                         {"r", "length", "half the length of the platform"}};

std::vector<Column> with_design(std::vector<Column> columns, const std::vector<Column>& more = {}) {
  columns.insert(columns.end(), design_columns.begin(), design_columns.end());
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

const Column table_column{"table", "-", "table of the chapter that the problem belongs to"};
const Column workspace_column{"workspace", "-", "prescribed workspace (reconstructed, not published)"};

}  // namespace

ReferenceTables::ReferenceTables()
    : designs{"The reference optimum, and how far every design of Tables 5.3 to 5.5 is from it",
              with_design({table_column,
                           workspace_column,
                           {"source", "-",
                            "published, published_corrected (P1 of Table 5.3 with y_C = 0.2617), the "
                            "optimizer, or reference"},
                           {"formulation", "-", "what the optimizer solved; empty for published designs"},
                           {"f", "-", "smallest inverse condition number along the outline, at slices or range ends"},
                           {"gap", "-", "f of the reference less f; negative designs violate limits"},
                           {"kkt_residual", "-", "distance from the conditions of Karush, Kuhn and Tucker"},
                           {"violation", "length", "largest violation of a leg's limit along the outline"}},
                          {{"active", "-", "constraints that are active, along the whole outline"},
                           {"tangent_dimension", "-", "dimension of the tangent space of the active constraints"},
                           {"smallest_curvature", "-", "of the Lagrangian there; inf where the dimension is 0"},
                           {"lower", "-", "proved: f over the whole region and range is not below this"},
                           {"upper", "-", "proved: and not above this"},
                           {"violation_proved", "length", "proved: no limit is violated by more than this"},
                           {"violation_throughout", "length",
                            "proved: the same at every orientation from the lowest slice to the highest"},
                           {"evaluations", "-", "evaluations in interval arithmetic"}}),
              {"Prescribed workspaces are reconstructed from the printed results, not published."}},
      starts{"Local optima from many starts",
             with_design({table_column,
                          workspace_column,
                          {"rank", "-", "1 for the best"},
                          {"starts", "-", "number of starts that came to it"},
                          {"refined", "-", "yes: by exchange and Newton's method; no: a poor one, on a sample"},
                          {"f", "-", "smallest inverse condition number along the outline"},
                          {"violation", "length", "largest violation of a leg's limit along the outline"},
                          {"kkt_residual", "-", "distance from the conditions of Karush, Kuhn and Tucker"},
                          {"smallest_curvature", "-", "of the Lagrangian in the tangent space"}})},
      agreement{"The reference optimum by two methods",
                {table_column,
                 workspace_column,
                 {"starts", "-", "number of starts"},
                 {"failed", "-", "starts from which SLSQP came to no feasible optimum"},
                 {"reached", "-", "starts that came to the best optimum, or one as good"},
                 {"optima", "-", "different local optima within 0.03 of the best"},
                 {"poor_optima", "-", "different local optima below that"},
                 {"t_exchange", "-", "optimum by exchange, as Ipopt has it"},
                 {"t_discretised", "-", "optimum of the large sparse problem"},
                 {"difference_t", "-", "absolute difference of the two"},
                 {"difference_d", "length",
                  "largest difference of the designs' variables, that of the exchange refined by Newton's method"},
                 {"rounds", "-", "of the exchange"},
                 {"exchange_constraints", "-", "of its last round"},
                 {"exchange_violation", "-", "largest violation at its end, lengths and inverse condition numbers"},
                 {"discretised_constraints", "-", "of the large problem"},
                 {"exchange_hessians", "-", "evaluations of the Lagrangian's Hessian, all rounds"},
                 {"discretised_hessians", "-", "the same of the large problem"}}},
      sensitivities{"What the reference optimum depends on",
                    {table_column,
                     workspace_column,
                     {"limit", "-", "limit of a leg, or size: the prescribed workspace scaled about its centre"},
                     {"slope", "1/length", "growth of f when the limit is loosened; of size, per relative change"}}},
      claim{"Section 5.8.2: f_D <= f_MO for the same prescribed workspace",
            {workspace_column,
             {"size", "-", "the table whose size it has; both where that is the same"},
             {"f_MO", "-", "reference optimum for the slices -5, 0, 5 degrees"},
             {"f_D", "-", "reference optimum for all orientations from -5 to 5 degrees"},
             {"difference", "-", "f_MO less f_D"}}},
      general{"How much better more general manipulators are",
              {table_column,
               workspace_column,
               {"family", "-",
                "collinear: the chapter's; base: base joints "
                "not in line; general: platform joints free as well"},
               {"variables", "-", "number of design variables"},
               {"starts", "-", "number of starts"},
               {"f", "-", "smallest inverse condition number of the best design found, along the outline"},
               {"gain", "-", "what that is above the reference optimum"},
               {"kkt_residual", "-", "distance from the conditions of Karush, Kuhn and Tucker"},
               {"violation", "length", "largest violation of a leg's limit along the outline"}}} {}

void ReferenceTables::add_design(const Study& study, const std::string& source, const std::string& formulation,
                                 const Eigen::VectorXd& design, const Judged& judged, double reference) {
  const OptimalityCertificate& certificate = judged.certificate;
  std::vector<Field> row{study.table,
                         study.workspace,
                         source,
                         formulation,
                         certificate.kappa_inverse,
                         reference - certificate.kappa_inverse,
                         certificate.kkt_residual,
                         certificate.violation};
  row.insert(row.end(), design.begin(), design.end());
  row.insert(row.end(), {certificate.active.size(), certificate.tangent_dimension, certificate.smallest_curvature,
                         judged.lower, judged.upper, judged.overreach, judged.throughout, judged.evaluations});
  designs.add_row(row);
}

void ReferenceTables::add_starts(const Study& study, const Search& search) {
  int rank = 0;
  for (const LocalOptimum& one : search.optima) {
    const OptimalityCertificate certificate = certify_optimality(study.task, one.design);
    std::vector<Field> row{study.table,
                           study.workspace,
                           ++rank,
                           one.starts,
                           one.refined ? "yes" : "no",
                           one.t,
                           certificate.violation,
                           certificate.kkt_residual,
                           certificate.smallest_curvature};
    row.insert(row.end(), one.design.begin(), one.design.end());
    starts.add_row(row);
  }
}

void ReferenceTables::add_agreement(const Study& study, const Search& search, const LocalOptimum& best,
                                    const Agreement& both) {
  long reached = 0;
  long optima = 0;
  for (const LocalOptimum& one : search.optima) {
    if (one.refined) ++optima;
    if (one.refined && one.t > best.t - same_value) reached += one.starts;
  }
  const auto& [exchange, discretised] = both;
  agreement.add_row({study.table, study.workspace, search.starts, search.failed, reached, optima,
                     static_cast<long>(search.optima.size()) - optima, exchange.t, discretised.t,
                     std::abs(exchange.t - discretised.t), (best.design - discretised.design).cwiseAbs().maxCoeff(),
                     exchange.rounds.size(), exchange.constraints.size(), exchange.violation,
                     discretised.constraints.size(), exchange.counts.lagrangian_hessian,
                     discretised.counts.lagrangian_hessian});
}

void ReferenceTables::add_sensitivities(const Study& study, const Eigen::VectorXd& design,
                                        const OptimalityCertificate& certificate) {
  const std::vector<Limit> limits = list_limits(study.task.designs.manipulator(design));
  for (std::size_t j = 0; j < limits.size(); ++j) {
    sensitivities.add_row({study.table, study.workspace, to_string(limits[j]), certificate.limit_sensitivities[j]});
  }
  sensitivities.add_row({study.table, study.workspace, "size", certificate.size_sensitivity});
}

}  // namespace reprise::experiments
