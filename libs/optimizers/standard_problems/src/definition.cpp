#include "definition.hpp"

namespace reprise::standard {

std::string hock_schittkowski(int number) {
  return "W. Hock, K. Schittkowski, Test Examples for Nonlinear Programming Codes, Springer 1981, problem " +
         std::to_string(number);
}

void set_functions(Problem& problem, const Functions& objective, const Functions& inequalities,
                   const Functions& equalities) {
  problem.objective_gradient = [jacobian = objective.jacobian, n = problem.n](const Eigen::VectorXd& x,
                                                                              Eigen::VectorXd& gradient) {
    Eigen::MatrixXd row(1, n);
    jacobian(x, row);
    gradient = row.transpose();
  };
  if (inequalities.count > 0) {
    problem.inequalities = inequalities.count;
    problem.inequality = inequalities.values;
    problem.inequality_jacobian = dense_jacobian(inequalities.jacobian);
  }
  if (equalities.count > 0) {
    problem.equalities = equalities.count;
    problem.equality = equalities.values;
    problem.equality_jacobian = dense_jacobian(equalities.jacobian);
  }
  problem.lagrangian_hessian = [=, n = problem.n](const Eigen::VectorXd& x, double factor,
                                                  const Eigen::VectorXd& inequality_multipliers,
                                                  const Eigen::VectorXd& equality_multipliers, SparseMatrix& hessian) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    objective.add_hessians(x, Eigen::VectorXd::Constant(1, factor), dense);
    if (inequalities.count > 0) inequalities.add_hessians(x, inequality_multipliers, dense);
    if (equalities.count > 0) equalities.add_hessians(x, equality_multipliers, dense);
    std::vector<Eigen::Triplet<double>> lower_triangle;
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        lower_triangle.emplace_back(static_cast<int>(i), static_cast<int>(j), dense(i, j));
      }
    }
    hessian.setFromTriplets(lower_triangle.begin(), lower_triangle.end());
  };
}

}  // namespace reprise::standard
