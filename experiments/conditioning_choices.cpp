// What the choices behind the inverse condition number change: the normalisation of the Jacobian, its norm and the unit
// of length, for every synthesis of Tables 5.3 to 5.5.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "chapter/synthesis_study.hpp"
#include "frame/experiment.hpp"
#include "reprise/io/progress.hpp"

namespace reprise::experiments {
namespace {

constexpr const char* title = "Normalisation and norm of the Jacobian";

/// Points of the outline at which kappa^-1 is looked at.
constexpr int dense_points = 2000;

/// The smallest kappa^-1 over the outline and the ends of the ranges, in the norm of the function given, with all
/// lengths in a unit of which so many make up the thesis's.
template <class KappaInverse>
double smallest(const SynthesisTask& task, const Eigen::VectorXd& design, double unit, const KappaInverse& of) {
  const Manipulator one = task.designs.manipulator(design);
  std::vector<Leg> legs = one.legs();
  for (Leg& leg : legs) {
    leg.base_joint *= unit;
    leg.platform_joint *= unit;
    leg.length = {unit * leg.length.lower, unit * leg.length.upper};
  }
  const Manipulator manipulator(one.name(), legs);
  double least = 1.0;
  for (const double beta : task.prescribed.angles(dense_points)) {
    for (const OrientationRange& range : task.orientations) {
      for (const double phi : range.ends()) {
        least = std::min(least, of(manipulator, Pose{unit * task.prescribed.point(beta), phi}, task.conditioning));
      }
    }
  }
  return least;
}

constexpr auto frobenius = [](const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning) {
  return kappa_inverse(manipulator, pose, conditioning);
};
constexpr auto two_norm = [](const Manipulator& manipulator, const Pose& pose, const Conditioning& conditioning) {
  return kappa_inverse_2norm(manipulator, pose, conditioning);
};

/// The best design of a task: pointwise formulation, SLSQP.
Eigen::VectorXd solve(const SynthesisTask& task, const Eigen::VectorXd& start, const ChapterSettings& settings) {
  const SynthesisProblem posed = formulate(Formulation::pointwise, task, start, settings.formulation_settings());
  const auto solver = make_solver("slsqp", Formulation::pointwise, settings);
  return solver->minimize(posed.problem, posed.start, posed.options).x.head(start.size());
}

Table make_table() {
  return {std::string(title) + ", smallest kappa^-1 over the outline",
          {{"table", "-", "table of the chapter"},
           {"workspace", "-", "prescribed workspace (reconstructed, not published)"},
           {"published_f_d0", "-", "f(d^0) as printed"},
           {"f_d0", "-", "d^0, columns of x and y divided by r as in (5.13), Frobenius norm: what is used"},
           {"f_d0_homogeneous", "-", "d^0, the column of phi divided by r instead"},
           {"f_d0_two_norm", "-", "d^0, as in (5.13), but the 2-norm"},
           {"f_d0_half_unit", "-", "d^0, as in (5.13), with all lengths in a unit half as long"},
           {"f_star", "-", "the best design for (5.13)"},
           {"f_star_homogeneous", "-", "the best design for the homogeneous normalisation, measured by it"},
           {"f_of_homogeneous", "-", "that design, measured by (5.13)"},
           {"r", "length", "r of the best design for (5.13)"},
           {"r_homogeneous", "length", "r of the best design for the homogeneous normalisation"}},
          {"The designs are found by the pointwise formulation with SLSQP, from the chapter's start."}};
}

}  // namespace
}  // namespace reprise::experiments

int main(int argc, char** argv) {
  using namespace reprise;
  using namespace reprise::experiments;

  Experiment experiment(REPRISE_PROGRAM);
  long points = ChapterSettings().points;
  experiment.options().integer("--points", points, 3, 100'000, "outline points of the syntheses");

  return experiment.run(argc, argv, [&](Session& session) {
    if (session.quick()) points = 150;
    Table table = make_table();
    Progress progress(chapter_syntheses.size());
    for (const ChapterSynthesis& synthesis : chapter_syntheses) {
      progress.begin(fmt::format("Table {}", synthesis.table));
      ChapterSettings settings = chapter_settings(synthesis);
      settings.points = points;
      const SynthesisInputs inputs = read_synthesis_inputs(title, synthesis);
      const Eigen::VectorXd start = to_vector(inputs.start);
      for (const std::string& workspace : workspace_names) {
        const SynthesisTask printed = area_formulation(inputs, settings, workspace).task();
        SynthesisTask homogeneous = printed;
        homogeneous.conditioning = {Normalisation::homogeneous, {}};
        const Eigen::VectorXd best = solve(printed, start, settings);
        const Eigen::VectorXd other = solve(homogeneous, start, settings);
        constexpr double same_unit = 1.0;
        constexpr double half_unit = 2.0;
        table.add_row(
            {synthesis.table, workspace, inputs.published.where("workspace", workspace).text(0, "f_d0"),
             smallest(printed, start, same_unit, frobenius), smallest(homogeneous, start, same_unit, frobenius),
             smallest(printed, start, same_unit, two_norm), smallest(printed, start, half_unit, frobenius),
             smallest(printed, best, same_unit, frobenius), smallest(homogeneous, other, same_unit, frobenius),
             smallest(printed, other, same_unit, frobenius), best[4], other[4]});
      }
    }
    session.write(table);
    fmt::print("{:<6}{:<10}{:>9}{:>13}{:>10}{:>11}\n", "table", "workspace", "f(d^0)", "homogeneous", "2-norm",
               "half unit");
    for (std::size_t row = 0; row < table.rows(); ++row) {
      fmt::print("{:<6}{:<10}{:>9.4f}{:>13.4f}{:>10.4f}{:>11.4f}\n", table.text(row, "table"),
                 table.text(row, "workspace"), table.number(row, "f_d0"), table.number(row, "f_d0_homogeneous"),
                 table.number(row, "f_d0_two_norm"), table.number(row, "f_d0_half_unit"));
    }
  });
}
