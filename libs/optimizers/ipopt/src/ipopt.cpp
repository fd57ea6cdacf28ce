#include "reprise/optimizers/ipopt.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "reprise/base/require.hpp"
#include "reprise/optimizers/evaluator.hpp"
#include "reprise/optimizers/parked_exception.hpp"

namespace reprise {
namespace {

using Ipopt::Index;
using Ipopt::Number;

/// Held while Ipopt itself works, given back while it calls one of the problem's functions.
std::mutex& ipopt_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Positions of a sparse matrix's entries, in the order in which their values are passed on.
struct Pattern {
  std::vector<Index> rows, columns;

  void append(const SparseMatrix& matrix, Index first_row) {
    for (Eigen::Index row = 0; row < matrix.outerSize(); ++row) {
      for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
        rows.push_back(first_row + static_cast<Index>(row));
        columns.push_back(static_cast<Index>(entry.col()));
      }
    }
  }
  std::size_t size() const { return rows.size(); }
  void copy_to(Index* to_rows, Index* to_columns) const {
    std::copy(rows.begin(), rows.end(), to_rows);
    std::copy(columns.begin(), columns.end(), to_columns);
  }
};

/// Writes the entries of the matrices one after the other. Throws unless they are as many as the pattern has.
void copy_values(std::initializer_list<const SparseMatrix*> matrices, Number* values, Index entries) {
  Eigen::Index sum = 0;
  for (const SparseMatrix* matrix : matrices) sum += matrix->nonZeros();
  if (sum != entries) {
    throw std::invalid_argument("a Jacobian or Hessian has " + std::to_string(sum) +
                                " entries, but its pattern at the start had " + std::to_string(entries));
  }
  for (const SparseMatrix* matrix : matrices) {
    for (Eigen::Index row = 0; row < matrix->outerSize(); ++row) {
      for (SparseMatrix::InnerIterator entry(*matrix, row); entry; ++entry) *values++ = entry.value();
    }
  }
}

/// The problem as Ipopt wants it: inequalities first, then equalities.
class Program : public Ipopt::TNLP {
 public:
  Program(Evaluator& evaluator, const Eigen::VectorXd& x0, bool exact_hessian)
      : evaluator_(evaluator), start_(x0), x_(x0) {
    const auto inequalities = static_cast<Index>(evaluator.inequalities());
    jacobian_.append(evaluator.inequality_jacobian(x0), 0);
    jacobian_.append(evaluator.equality_jacobian(x0), inequalities);
    inequality_multipliers_.setOnes(evaluator.inequalities());
    equality_multipliers_.setOnes(evaluator.equalities());
    if (exact_hessian) {
      hessian_.append(evaluator.lagrangian_hessian(x0, 1.0, inequality_multipliers_, equality_multipliers_), 0);
    }
  }

  /// The last point, once Ipopt has ended with one.
  const std::optional<Eigen::VectorXd>& solution() const { return solution_; }
  /// Throws what one of the problem's functions threw.
  void rethrow() const { parked_.rethrow(); }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(evaluator_.n());
    m = static_cast<Index>(evaluator_.inequalities() + evaluator_.equalities());
    jacobian_entries = static_cast<Index>(jacobian_.size());
    hessian_entries = static_cast<Index>(hessian_.size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index /*n*/, Number* lower, Number* upper, Index m, Number* lower_constraint,
                       Number* upper_constraint) override {
    std::copy(evaluator_.lower().begin(), evaluator_.lower().end(), lower);
    std::copy(evaluator_.upper().begin(), evaluator_.upper().end(), upper);
    std::fill_n(lower_constraint, evaluator_.inequalities(), -std::numeric_limits<Number>::infinity());
    std::fill_n(lower_constraint + evaluator_.inequalities(), evaluator_.equalities(), 0.0);
    std::fill_n(upper_constraint, m, 0.0);
    return true;
  }

  bool get_starting_point(Index /*n*/, bool /*init_x*/, Number* x, bool /*init_z*/, Number* /*z_lower*/,
                          Number* /*z_upper*/, Index /*m*/, bool /*init_lambda*/, Number* /*lambda*/) override {
    std::copy(start_.begin(), start_.end(), x);
    return true;
  }

  bool eval_f(Index n, const Number* x, bool /*new_x*/, Number& value) override {
    return evaluate(n, x, &value, 1, [&] { value = evaluator_.objective(x_); });
  }

  bool eval_grad_f(Index n, const Number* x, bool /*new_x*/, Number* gradient) override {
    return evaluate(n, x, gradient, n, [&] {
      const Eigen::VectorXd& value = evaluator_.objective_gradient(x_);
      std::copy(value.begin(), value.end(), gradient);
    });
  }

  bool eval_g(Index n, const Number* x, bool /*new_x*/, Index m, Number* values) override {
    return evaluate(n, x, values, m, [&] {
      const Eigen::VectorXd& g = evaluator_.inequality(x_);
      const Eigen::VectorXd& h = evaluator_.equality(x_);
      std::copy(h.begin(), h.end(), std::copy(g.begin(), g.end(), values));
    });
  }

  bool eval_jac_g(Index n, const Number* x, bool /*new_x*/, Index /*m*/, Index entries, Index* rows, Index* columns,
                  Number* values) override {
    if (values == nullptr) {
      jacobian_.copy_to(rows, columns);
      return true;
    }
    return evaluate(n, x, values, entries, [&] {
      copy_values({&evaluator_.inequality_jacobian(x_), &evaluator_.equality_jacobian(x_)}, values, entries);
    });
  }

  bool eval_h(Index n, const Number* x, bool /*new_x*/, Number objective_factor, Index /*m*/, const Number* multipliers,
              bool /*new_multipliers*/, Index entries, Index* rows, Index* columns, Number* values) override {
    if (values == nullptr) {
      hessian_.copy_to(rows, columns);
      return true;
    }
    return evaluate(n, x, values, entries, [&] {
      const Number* const equality_multipliers = multipliers + evaluator_.inequalities();
      std::copy_n(multipliers, evaluator_.inequalities(), inequality_multipliers_.begin());
      std::copy_n(equality_multipliers, evaluator_.equalities(), equality_multipliers_.begin());
      copy_values(
          {&evaluator_.lagrangian_hessian(x_, objective_factor, inequality_multipliers_, equality_multipliers_)},
          values, entries);
    });
  }

  bool intermediate_callback(Ipopt::AlgorithmMode /*mode*/, Index /*iteration*/, Number /*f*/, Number /*primal*/,
                             Number /*dual*/, Number /*mu*/, Number /*step*/, Number /*regularisation*/,
                             Number /*alpha_dual*/, Number /*alpha_primal*/, Index /*trials*/,
                             const Ipopt::IpoptData* /*data*/,
                             Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    // Fails when an earlier call did: then the run is to stop.
    return parked_.attempt([] {});
  }

  void finalize_solution(Ipopt::SolverReturn /*status*/, Index n, const Number* x, const Number* /*z_lower*/,
                         const Number* /*z_upper*/, Index /*m*/, const Number* /*g*/, const Number* /*lambda*/,
                         Number /*f*/, const Ipopt::IpoptData* /*data*/,
                         Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    parked_.attempt([&] { solution_ = Eigen::Map<const Eigen::VectorXd>(x, n); });
  }

 private:
  /// Calls back with x_ at the point and with Ipopt open to others. When this or an earlier call failed the values are
  /// NaN, from which Ipopt steps back until it is told to stop; a return value of false from eval_g makes Ipopt 3.11
  /// read from null pointers.
  template <class Body>
  bool evaluate(Index n, const Number* x, Number* values, Index count, Body&& body) {
    ipopt_mutex().unlock();
    const bool succeeded = parked_.attempt([&] {
      x_ = Eigen::Map<const Eigen::VectorXd>(x, n);
      body();
    });
    if (!succeeded) std::fill_n(values, count, std::numeric_limits<Number>::quiet_NaN());
    ipopt_mutex().lock();
    return true;
  }

  Evaluator& evaluator_;
  Eigen::VectorXd start_;
  Eigen::VectorXd x_;
  Eigen::VectorXd inequality_multipliers_, equality_multipliers_;
  Pattern jacobian_, hessian_;
  std::optional<Eigen::VectorXd> solution_;
  ParkedException parked_;
};

Status status_of(Ipopt::ApplicationReturnStatus code) {
  switch (code) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Solved_To_Acceptable_Level:
    case Ipopt::Feasible_Point_Found:
      return Status::converged;
    case Ipopt::Infeasible_Problem_Detected:
      return Status::infeasible;
    case Ipopt::Diverging_Iterates:
      return Status::unbounded;
    case Ipopt::Maximum_Iterations_Exceeded:
      return Status::iteration_limit;
    default:
      return Status::numerical_failure;
  }
}

const char* sentence(Ipopt::ApplicationReturnStatus code) {
  switch (code) {
    case Ipopt::Solve_Succeeded:
      return "optimal solution found";
    case Ipopt::Solved_To_Acceptable_Level:
      return "solved to acceptable level";
    case Ipopt::Infeasible_Problem_Detected:
      return "converged to a point of local infeasibility";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "search direction becomes too small";
    case Ipopt::Diverging_Iterates:
      return "iterates diverge; the problem may be unbounded";
    case Ipopt::User_Requested_Stop:
      return "stopped at the user's request";
    case Ipopt::Feasible_Point_Found:
      return "feasible point of a square problem found";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "the limit on iterations was reached";
    case Ipopt::Restoration_Failed:
      return "restoration failed";
    case Ipopt::Error_In_Step_Computation:
      return "error in step computation";
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return "more equalities than free variables";
    case Ipopt::Invalid_Number_Detected:
      return "a function or derivative is not finite";
    case Ipopt::Insufficient_Memory:
      return "out of memory";
    default:
      return "unexpected end; see the code";
  }
}

using Application = Ipopt::SmartPtr<Ipopt::IpoptApplication>;

/// An application with everything set that does not change from run to run.
Application make_application(const IpoptOptions& options) {
  constexpr bool print_to_console = false;
  const Application application = new Ipopt::IpoptApplication(print_to_console);
  // No file name: else Ipopt reads ipopt.opt from the current folder.
  application->Initialize("");
  const Ipopt::SmartPtr<Ipopt::OptionsList> set = application->Options();
  set->SetIntegerValue("print_level", 0);
  set->SetStringValue("sb", "yes");
  set->SetStringValue("linear_solver", "mumps");
  // Ordering by quasi-dense approximate minimum degree. MUMPS's own choice fills in where a few variables meet
  // thousands of constraints: 34 s instead of 1.2 s with 6 variables and 7000 constraints.
  constexpr int quasi_dense_minimum_degree = 6;
  set->SetIntegerValue("mumps_pivot_order", quasi_dense_minimum_degree);
  // MUMPS's own margin of memory. Ipopt's, ten times the estimate, has the heap grow and shrink by megabytes with every
  // factorisation, which takes longer than the factorisation. Where the margin is too small Ipopt doubles it.
  constexpr int memory_margin = 20;
  set->SetIntegerValue("mumps_mem_percent", memory_margin);
  // One factorisation for each limited-memory matrix, in place of a solve for each of its vectors.
  set->SetStringValue("limited_memory_aug_solver", "extended");
  set->SetStringValue("check_derivatives_for_naninf", "yes");
  set->SetNumericValue("tol", options.tolerance);
  set->SetNumericValue("acceptable_tol", options.acceptable_tolerance);
  set->SetNumericValue("bound_relax_factor", options.bound_relax_factor);
  set->SetNumericValue("mu_init", options.initial_barrier);
  for (const char* push : {"bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac"}) {
    set->SetNumericValue(push, options.initial_push);
  }
  set->SetIntegerValue("max_iter", static_cast<Index>(options.max_iterations));
  return application;
}

}  // namespace

struct IpoptApplications {
  IpoptApplications() = default;
  IpoptApplications(const IpoptApplications&) = delete;
  IpoptApplications& operator=(const IpoptApplications&) = delete;
  /// An application keeps what MUMPS has of its last run until the end.
  ~IpoptApplications() {
    const std::lock_guard lock(ipopt_mutex());
    idle.clear();
  }

  std::vector<Application> idle;
};

IpoptSolver::IpoptSolver(IpoptOptions options)
    : options_(options), applications_(std::make_shared<IpoptApplications>()) {
  require(options_.tolerance > 0.0 && std::isfinite(options_.tolerance), "Ipopt option tolerance", options_.tolerance,
          "positive and finite");
  require(options_.acceptable_tolerance >= options_.tolerance && std::isfinite(options_.acceptable_tolerance),
          "Ipopt option acceptable_tolerance", options_.acceptable_tolerance, "finite and not below the tolerance");
  require(options_.initial_barrier > 0.0 && std::isfinite(options_.initial_barrier), "Ipopt option initial_barrier",
          options_.initial_barrier, "positive and finite");
  require(options_.initial_push > 0.0 && options_.initial_push <= 0.5, "Ipopt option initial_push",
          options_.initial_push, "above 0 and at most 0.5");
  require(options_.max_iterations >= 1 && options_.max_iterations <= std::numeric_limits<Index>::max(),
          "Ipopt option max_iterations", options_.max_iterations, "from 1 to 2147483647");
  require(options_.bound_relax_factor >= 0.0 && std::isfinite(options_.bound_relax_factor),
          "Ipopt option bound_relax_factor", options_.bound_relax_factor, "finite and at least 0");
}

Outcome IpoptSolver::solve(Evaluator& evaluator, const Eigen::VectorXd& given_start) const {
  // What Ipopt's own scaling, which only makes functions smaller, takes for the largest good slope.
  constexpr double slope = 100.0;
  const Eigen::VectorXd x0 = evaluator.measure(given_start, {.variables = true, .slope = slope});
  const bool exact_hessian = options_.hessian == IpoptHessian::automatic && evaluator.has_hessian();
  const Ipopt::SmartPtr<Program> program = new Program(evaluator, x0, exact_hessian);
  // Ipopt demands a positive tolerance; a smaller one would be below rounding.
  constexpr double least_feasibility = 1e-14;
  const double feasibility = std::max(evaluator.options().feasibility_tolerance, least_feasibility);

  const std::lock_guard lock(ipopt_mutex());
  // Taken out while it works: a function of the problem may call this solver again.
  std::vector<Application>& idle = applications_->idle;
  const Application application = idle.empty() ? make_application(options_) : idle.back();
  if (!idle.empty()) idle.pop_back();
  const Ipopt::SmartPtr<Ipopt::OptionsList> set = application->Options();
  set->SetStringValue("hessian_approximation", exact_hessian ? "exact" : "limited-memory");
  set->SetNumericValue("constr_viol_tol", feasibility);
  set->SetNumericValue("acceptable_constr_viol_tol", feasibility);
  const Ipopt::ApplicationReturnStatus code =
      application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(program)));
  idle.push_back(application);
  program->rethrow();
  return {program->solution(), status_of(code), static_cast<int>(code), sentence(code)};
}

}  // namespace reprise
