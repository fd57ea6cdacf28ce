#include "reprise/optimizers/finite_differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reprise {

void FiniteDifferences::take(CountedFunctions& functions, const FreeVariables& variables, const Options& options,
                             const Eigen::VectorXd& x, double f, const Eigen::VectorXd& g, const Eigen::VectorXd& h) {
  const bool of_objective = !functions.has_objective_gradient();
  const bool of_inequality = g.size() > 0 && !functions.has_inequality_jacobian();
  const bool of_equality = h.size() > 0 && !functions.has_equality_jacobian();
  const Eigen::Index n = variables.n();
  objective_changes_.resize(n);
  widths_.resize(n);
  if (of_inequality) inequality_.resize(g.size(), n);
  if (of_equality) equality_.resize(h.size(), n);
  g_above_.resize(g.size());
  g_below_.resize(g.size());
  h_above_.resize(h.size());
  h_below_.resize(h.size());
  moved_ = x;

  constexpr double rounding = std::numeric_limits<double>::epsilon();
  const bool central = options.derivatives != Derivatives::forward;
  for (Eigen::Index i = 0; i < n; ++i) {
    double& moving = moved_[variables.place(i)];
    const double here = moving;
    const double natural_step = (central ? std::cbrt(rounding) : std::sqrt(rounding)) * std::max(1.0, std::abs(here));
    const double step = options.difference_step.value_or(natural_step);
    double above = std::min(here + step, variables.own_upper()[i]);
    double below = std::max(here - step, variables.own_lower()[i]);
    if (!central) (above - here >= here - below ? below : above) = here;

    const auto evaluate_at = [&](double value, double& f_there, Eigen::VectorXd& g_there, Eigen::VectorXd& h_there) {
      if (value == here) {
        f_there = f;
        g_there = g;
        h_there = h;
        return;
      }
      moving = value;
      if (of_objective) f_there = functions.objective(moved_);
      if (of_inequality) functions.inequality(moved_, g_there);
      if (of_equality) functions.equality(moved_, h_there);
      moving = here;
    };
    double f_above = 0.0;
    double f_below = 0.0;
    evaluate_at(above, f_above, g_above_, h_above_);
    evaluate_at(below, f_below, g_below_, h_below_);
    widths_[i] = above - below;
    objective_changes_[i] = f_above - f_below;
    if (of_inequality) inequality_.col(i) = (g_above_ - g_below_) / widths_[i];
    if (of_equality) equality_.col(i) = (h_above_ - h_below_) / widths_[i];
  }
}

}  // namespace reprise
