#include "reprise/optimizers/counted_functions.hpp"

namespace reprise {

void CountedFunctions::count_point(long& count) {
  if (limited_ && options_.stop && options_.stop()) {
    throw StopRequest{Status::stopped, "it was asked to stop", &problem_};
  }
  if (limited_ && count >= options_.max_function_evaluations) {
    throw StopRequest{Status::evaluation_limit, "the limit on function evaluations was reached", &problem_};
  }
  ++count;
}

double CountedFunctions::objective(const Eigen::VectorXd& x) {
  count_point(counts_.objective);
  return problem_.objective(x);
}

void CountedFunctions::inequality(const Eigen::VectorXd& x, Eigen::VectorXd& g) {
  if (!problem_.inequality) return;
  count_point(counts_.inequality);
  problem_.inequality(x, g);
}

void CountedFunctions::equality(const Eigen::VectorXd& x, Eigen::VectorXd& h) {
  if (!problem_.equality) return;
  count_point(counts_.equality);
  problem_.equality(x, h);
}

bool CountedFunctions::objective_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
  ++counts_.objective_gradient;
  if (!has_objective_gradient()) return false;
  problem_.objective_gradient(x, gradient);
  return true;
}

bool CountedFunctions::inequality_jacobian(const Eigen::VectorXd& x, SparseMatrix& jacobian, bool new_point) {
  if (new_point) ++counts_.inequality_jacobian;
  if (!has_inequality_jacobian()) return false;
  problem_.inequality_jacobian(x, jacobian);
  return true;
}

void CountedFunctions::inequality_jacobian_rows(const Eigen::VectorXd& x, const std::vector<Eigen::Index>& rows,
                                                SparseMatrix& jacobian, bool new_point) {
  if (new_point) ++counts_.inequality_jacobian;
  problem_.inequality_jacobian_rows(x, rows, jacobian);
}

bool CountedFunctions::equality_jacobian(const Eigen::VectorXd& x, SparseMatrix& jacobian) {
  ++counts_.equality_jacobian;
  if (!has_equality_jacobian()) return false;
  problem_.equality_jacobian(x, jacobian);
  return true;
}

void CountedFunctions::lagrangian_hessian(const Eigen::VectorXd& x, double objective_factor,
                                          const Eigen::VectorXd& inequality_multipliers,
                                          const Eigen::VectorXd& equality_multipliers, SparseMatrix& hessian) {
  ++counts_.lagrangian_hessian;
  problem_.lagrangian_hessian(x, objective_factor, inequality_multipliers, equality_multipliers, hessian);
}

}  // namespace reprise
