// Section 4.7, which is not available: which prescribed workspaces P1-P3 are compatible with the printed Tables 5.3 to
// 5.5, with no family of shapes and with some, and what is left open.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chapter/problems.hpp"
#include "chapter/stored_synthesis.hpp"
#include "comparison/judge.hpp"
#include "frame/experiment.hpp"
#include "reconstruction/evidence.hpp"
#include "reconstruction/outline_families.hpp"
#include "reconstruction/outline_fit.hpp"
#include "reconstruction/pictures.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/optimizers/nlopt.hpp"
#include "reprise/study/formulation.hpp"
#include "reprise/synthesis/assessment.hpp"
#include "reprise/synthesis/pointwise_formulation.hpp"
#include "reprise/synthesis/synthesis_task.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;

const std::vector<std::string> tables{"5.3", "5.4", "5.5"};

/// Outline points for everything that is reported of an outline of examples/.
constexpr int dense_points = 2000;

/// Outline points of the synthesis in the sensitivity study.
constexpr int synthesis_points = 1500;

const char* yes_or_no(bool yes) { return yes ? "yes" : "no"; }

/// The outline of a prescribed workspace (examples/P1.toml to P3.toml) in the size of each table.
struct DataOutline {
  Shape shape;
  std::map<std::string, PrescribedWorkspace> sized;
  std::map<std::string, double> divisors;
};

std::map<std::string, DataOutline> read_data_outlines() {
  std::map<std::string, DataOutline> outlines;
  for (const ChapterSynthesis& synthesis : chapter_syntheses) {
    for (const PrescribedWorkspace& workspace : read_prescribed_workspaces(synthesis)) {
      DataOutline& outline = outlines[workspace.name()];
      outline.shape = workspace.shape();
      outline.sized.emplace(synthesis.table, workspace);
      outline.divisors[synthesis.table] = 1.0 / workspace.placement().scale;
    }
  }
  return outlines;
}

std::vector<double> in_order(const std::map<std::string, double>& divisors) {
  std::vector<double> list;
  list.reserve(divisors.size());
  for (const auto& [table, divisor] : divisors) list.push_back(divisor);
  return list;
}

/// The rows of one workspace, table by table, in a reading.
std::vector<std::shared_ptr<const RowModel>> models(const Evidence& evidence, const std::string& workspace,
                                                    const std::string& reading) {
  std::vector<std::shared_ptr<const RowModel>> rows;
  rows.reserve(tables.size());
  for (const std::string& table : tables) {
    rows.push_back(std::make_shared<RowModel>(evidence.rows()[evidence.find(table, workspace, reading)]));
  }
  return rows;
}

/// The main table: what the outlines of examples/ predict.
Table compare_predictions(const std::vector<PublishedRow>& rows, const std::map<std::string, DataOutline>& outlines) {
  Table table(
      "The printed values, and what the outlines of examples/P1.toml to P3.toml predict for them",
      {{"table", "-", "table of the chapter"},
       {"workspace", "-", "prescribed workspace"},
       {"quantity", "-",
        "f_d0: f(d^0); f_star: f* at the printed d*; g_star: (5.35) at the printed d*, an area (length^2) where "
        "positive; clearance: the least distance of a leg from a limit at the printed d*, a length, negative "
        "where the outline sticks out"},
       {"printed", "-", "as printed; empty for the clearance, which is not printed but about 0 at an optimum"},
       {"predicted", "-", fmt::format("over {} outline points", dense_points)},
       {"difference", "-", "predicted less printed; for the clearance less 0; empty for g*"},
       {"reading", "-", "of the design: as printed, or what is read in its place"},
       {"allowance", "-",
        "half a unit of the last printed digit; for f* and the clearance with what the rounding of the printed "
        "design may change, to first order; empty for g*"},
       {"within_rounding", "-",
        "whether the difference is within the allowance; for g*, whether the area outside, with the legs' "
        "lengths wider by the clearance's allowance, is at most the printed one with half a unit"}},
      {"The outlines are reconstructed from these very values, not published."});
  for (const PublishedRow& row : rows) {
    const PrescribedWorkspace& outline = outlines.at(row.workspace).sized.at(row.table);
    const std::vector<double> directions = outline.angles(dense_points);
    const RowModel model(row);
    const Prediction prediction = model.predict(outline, directions);
    const Miss miss = model.miss(outline, directions, false);
    const auto add = [&](const char* quantity, const std::string& printed, double predicted, double difference,
                         double allowance) {
      table.add_row({row.table, row.workspace, quantity, printed, predicted, difference, row.reading, allowance,
                     yes_or_no(std::abs(difference) <= allowance)});
    };
    add("f_d0", row.f_d0.text, prediction.f_d0, prediction.f_d0 - row.f_d0.value, row.f_d0.half_unit);
    add("f_star", row.f_star.text, prediction.f_star, prediction.f_star - row.f_star.value,
        row.f_star.half_unit + prediction.f_star_change);
    table.add_row({row.table, row.workspace, "g_star", row.g_star.text,
                   miss.area > 0.0 ? miss.area : -miss.polar_clearance * miss.polar_clearance, Field(), row.reading,
                   Field(), yes_or_no(model.miss(outline, directions, true).area <= model.allowed_area())});
    add("clearance", "", prediction.clearance, prediction.clearance, model.length_change());
  }
  return table;
}

/// What the fits of one workspace leave behind.
struct WorkspaceFits {
  std::vector<Shape> compatible;                      ///< at the sizes of data/
  std::vector<std::pair<std::string, Shape>> others;  ///< least squares of the other families
  struct Candidate {
    std::string outline;
    Shape shape;
    double excess;
  };
  std::vector<Candidate> candidates;  ///< for the sensitivity study
};

std::string write_parameters(const OutlineFamily& family, const Eigen::VectorXd& x) {
  std::string text;
  for (std::size_t i = 0; i < family.parameters.size(); ++i) {
    text += fmt::format("{}{} = {:.4g}", i == 0 ? "" : ", ", family.parameters[i], x[static_cast<Eigen::Index>(i)]);
  }
  return text;
}

/// The outlines at the ends of the extents, each once, with what is least and most in it: "least a, most n".
std::vector<std::pair<std::string, Eigen::VectorXd>> distinct_extremes(const OutlineFit& fit,
                                                                       const std::vector<Extent>& extents) {
  std::vector<std::pair<std::string, Eigen::VectorXd>> distinct;
  for (std::size_t i = 0; i < extents.size(); ++i) {
    for (const auto& [word, x] : {std::pair("least ", &extents[i].least), std::pair("most ", &extents[i].most)}) {
      const auto same = std::find_if(distinct.begin(), distinct.end(), [x = x](const auto& other) {
        return (other.second - *x).cwiseAbs().maxCoeff() < 1e-3;
      });
      const std::string words = word + fit.names()[i];
      if (same == distinct.end()) {
        distinct.emplace_back(words, *x);
      } else {
        same->first += ", " + words;
      }
    }
  }
  return distinct;
}

class Fits {
 public:
  Fits(const Evidence& evidence, const std::map<std::string, DataOutline>& data, int directions, int starts)
      : evidence_(evidence),
        data_(data),
        directions_(directions),
        starts_(starts),
        fits_(
            "Families of outlines fitted to the printed values",
            {{"workspace", "-", "prescribed workspace"},
             {"reading", "-", "of Table 5.3: as printed, or what is read in its place"},
             {"family", "-", "family of outlines"},
             {"sizes", "-",
              "text: the same in all tables, as the text says; data: as in examples/P1.toml to P3.toml; fitted"},
             {"divisor_SO", "-", "by which the outline is divided in Table 5.3"},
             {"divisor_MO", "-", "the same in Table 5.4"},
             {"divisor_D", "-", "the same in Table 5.5"},
             {"any_shape", "-", "whether any star-shaped outline is compatible with these sizes"},
             {"sum_of_squares", "-", "least, of the nine residuals"},
             {"largest_residual", "-", "largest absolute residual of that fit"},
             {"least_excess", "-",
              "of the family's outline nearest to being compatible: largest ratio of a difference to its allowance; "
              "at most 1 when compatible"},
             {"parameters", "-", "of the least-squares fit, before division"},
             {"nearest", "-", "parameters of the outline with the least excess"},
             {"formula", "-", "of the family"}},
            {"Residuals: the differences of f(d^0) and f* from the printed values in half units of their last digit; "
             "the clearance in units of 0.0005.",
             fmt::format("Over {} directions; SLSQP, from {} starts for the families of data/.", directions, starts)}),
        outlines_(
            "The parameters of the outlines: fitted, compatible, and in examples/P1.toml to P3.toml",
            {{"workspace", "-", "prescribed workspace"},
             {"family", "-", "family of outlines"},
             {"parameter", "-", "length before division, exponent, or divisor of a table"},
             {"fitted", "-", "by least squares; the divisors in a fit of their own, together with the parameters"},
             {"lower", "-",
              "least value among the compatible outlines of the family that were found; empty when none is"},
             {"upper", "-", "largest such value"},
             {"search_bound", "-", "which of the two is only the bound of the search"},
             {"in_data", "-", "value in examples/P1.toml to P3.toml"},
             {"within", "-", "whether that lies between lower and upper"}}) {}

  WorkspaceFits run(const std::string& workspace, const std::string& reading) {
    WorkspaceFits kept;
    const DataOutline& data = data_.at(workspace);
    const Eigen::VectorXd in_data = main_parameters(data.shape);
    const std::vector<double> divisors = in_order(data.divisors);
    const Sizes as_in_data{"data", divisors, false};
    const OutlineFamily family = main_family(workspace);
    if (in_data.size() != family.start.size()) {
      throw std::runtime_error("examples/" + workspace + ".toml: " + workspace + " must be of the family " +
                               family.name + ", as which it is reconstructed.");
    }

    fit(workspace, reading, family, {"text", std::vector<double>(tables.size(), divisors.front()), false}, 1);
    const auto [fixed, least, nearest] = fit(workspace, reading, family, as_in_data, starts_);
    const std::vector<Extent> extents = fixed.extents(solver_, nearest);
    describe(workspace, fixed, least, extents, 0, in_data);
    kept.candidates.push_back({"in data", data.shape, fixed.judge(in_data).excess});
    kept.candidates.push_back({family.name + ", least squares", fixed.shape(least.x), least.excess});
    if (nearest.excess <= 1.0) kept.compatible.push_back(fixed.shape(nearest.x));
    for (const auto& [words, x] : distinct_extremes(fixed, extents)) {
      kept.compatible.push_back(fixed.shape(x));
      kept.candidates.push_back({family.name + ", " + words, fixed.shape(x), fixed.judge(x).excess});
    }

    const auto [free, free_least, free_nearest] = fit(workspace, reading, family, {"fitted", divisors, true}, starts_);
    Eigen::VectorXd free_in_data(free_least.x.size());
    free_in_data << in_data, divisors[1], divisors[2];
    describe(workspace, free, free_least, free.extents(solver_, free_nearest), in_data.size(), free_in_data);

    for (const OutlineFamily& other : other_families(workspace)) {
      const auto [other_fit, other_least, other_nearest] = fit(workspace, reading, other, as_in_data, 1);
      kept.others.emplace_back(other.name, other_fit.shape(other_least.x));
      if (other_nearest.excess <= 1.0) kept.compatible.push_back(other_fit.shape(other_nearest.x));
      kept.candidates.push_back(
          {other.name + ", start of the fit", other.shape(other.start), other_fit.judge(other.start).excess});
      kept.candidates.push_back({other.name + ", least squares", other_fit.shape(other_least.x), other_least.excess});
    }
    return kept;
  }

  /// A fit that only shows that it fails.
  void refute(const std::string& workspace, const std::string& reading) {
    fit(workspace, reading, main_family(workspace), {"data", in_order(data_.at(workspace).divisors), false}, starts_);
  }

  const Table& fits() const { return fits_; }
  const Table& outlines() const { return outlines_; }

 private:
  struct Fitted {
    OutlineFit fit;
    FittedOutline least;
    FittedOutline nearest;
  };

  Fitted fit(const std::string& workspace, const std::string& reading, const OutlineFamily& family, const Sizes& sizes,
             int starts) {
    OutlineFit one(models(evidence_, workspace, reading), family, sizes, directions_);
    const FittedOutline least = one.least_squares(solver_, starts);
    const FittedOutline nearest = one.nearest(solver_, least);
    const std::vector<double> by = one.divisors(least.x);
    const bool any = evidence_.common(workspace, reading, {{"5.3", by[0]}, {"5.4", by[1]}, {"5.5", by[2]}}).compatible;
    fits_.add_row({workspace, evidence_.rows()[evidence_.find("5.3", workspace, reading)].reading, family.name,
                   sizes.name, by[0], by[1], by[2], yes_or_no(any), least.sum_of_squares, least.largest_residual,
                   nearest.excess, write_parameters(family, least.x), write_parameters(family, nearest.x),
                   family.formula});
    return {std::move(one), least, nearest};
  }

  void describe(const std::string& workspace, const OutlineFit& fit, const FittedOutline& least,
                const std::vector<Extent>& extents, Eigen::Index first, const Eigen::VectorXd& in_data) {
    for (Eigen::Index j = first; j < least.x.size(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      std::vector<Field> row{workspace, fit.family().name, fit.names()[i], least.x[j]};
      if (extents.empty()) {
        row.insert(row.end(), {Field(), Field(), Field(), in_data[j], "no"});
      } else {
        const double lower = extents[i].least[j];
        const double upper = extents[i].most[j];
        const bool at_bound = j < fit.family().lower.size() && lower <= fit.family().lower[j];
        row.insert(row.end(), {lower, upper, at_bound ? "lower" : "", in_data[j],
                               yes_or_no(lower <= in_data[j] && in_data[j] <= upper)});
      }
      outlines_.add_row(row);
    }
  }

  const Evidence& evidence_;
  const std::map<std::string, DataOutline>& data_;
  int directions_;
  int starts_;
  NloptSolver solver_;
  Table fits_;
  Table outlines_;
};

Table make_sensitivity_table() {
  return {
      "SO synthesis of outlines that the printed values do not tell apart",
      {{"workspace", "-", "prescribed workspace"},
       {"outline", "-", "which outline"},
       {"excess", "-", "largest ratio of a difference from the printed values to its allowance"},
       {"f_star", "-",
        fmt::format("smallest inverse condition number of the design found, over {} points", dense_points)},
       {"f_star_change", "-", "the same less that of the outline in data"},
       {"x_C", "length", "design found, x coordinate of base joint C"},
       {"y_C", "length", "design found, y coordinate of the base joints"},
       {"x_D", "length", "design found, x coordinate of base joint D"},
       {"x_E", "length", "design found, x coordinate of base joint E"},
       {"r", "length", "design found, half the length of the platform"},
       {"design_change", "length", "largest difference of an entry from the design for the outline in data"},
       {"design_difference", "length", "largest difference of an entry from the printed design, in the reading used"},
       {"violation", "length", fmt::format("largest violation of a leg's limit, over {} points", dense_points)},
       {"converged", "-", "number of starts from which the optimizer converged"},
       {"status", "-", "how the optimizer ended"}},
      {fmt::format(
          "Pointwise formulation with {} outline points, SLSQP, the best of several starts: the chapter's, the "
          "printed design, and designs within 0.2 max(1, |x|) of it in each entry.",
          synthesis_points)}};
}

/// SO synthesis of one outline by the pointwise formulation.
struct SynthesisedDesign {
  Eigen::VectorXd design;
  Assessment assessment;
  Status status;
  int converged = 0;  ///< starts from which the optimizer converges
};

/// The best of several starts, so that it does not depend on the valley in which one start lies.
SynthesisedDesign synthesise(const PublishedRow& row, const PrescribedWorkspace& outline,
                             const std::vector<Eigen::VectorXd>& starts, const Solver& solver) {
  const SynthesisTask task{
      outline, slices(row.orientations), DesignSpace::collinear(row.lengths), {Normalisation::printed, {}}};
  const PointwiseOptions options{synthesis_points};
  const Problem problem = pointwise_problem(task, options);
  std::optional<SynthesisedDesign> best;
  int converged = 0;
  for (const Eigen::VectorXd& start : starts) {
    const Result result = solver.minimize(problem, pointwise_start(task, start, options));
    const Eigen::VectorXd design = result.x.head(start.size());
    const SynthesisedDesign found{design, assess(task, design, dense_points), result.status};
    if (result.status == Status::converged) ++converged;
    const bool better =
        !best || best->status != Status::converged || found.assessment.kappa_inverse > best->assessment.kappa_inverse;
    if (!best || (found.status == Status::converged && better)) best = found;
  }
  best->converged = converged;
  return *best;
}

/// The chapter's start, the printed design, and others about it.
std::vector<Eigen::VectorXd> synthesis_starts(const PublishedRow& row, long count) {
  constexpr double distance = 0.2;
  std::vector<Eigen::VectorXd> starts{row.start, row.design};
  for (long k = 2; k < count; ++k) {
    starts.push_back(moved_start(row.design, distance, static_cast<std::uint64_t>(k)));
  }
  starts.resize(static_cast<std::size_t>(count), row.start);
  return starts;
}

void study_sensitivity(Table& table, const PublishedRow& row, double divisor,
                       const std::vector<WorkspaceFits::Candidate>& candidates, long starts) {
  const auto solver = solvers_for(Formulation::pointwise, {"slsqp"}, {}).front().solver;
  std::vector<SynthesisedDesign> designs;
  for (const WorkspaceFits::Candidate& candidate : candidates) {
    designs.push_back(synthesise(row, {row.workspace, candidate.shape, {outline_centre(), 1.0 / divisor, 0.0}},
                                 synthesis_starts(row, starts), *solver));
    const SynthesisedDesign& found = designs.back();
    std::vector<Field> line{row.workspace, candidate.outline, candidate.excess, found.assessment.kappa_inverse,
                            found.assessment.kappa_inverse - designs.front().assessment.kappa_inverse};
    for (const double entry : found.design) line.emplace_back(entry);
    line.insert(line.end(), {(found.design - designs.front().design).cwiseAbs().maxCoeff(),
                             (found.design - row.design).cwiseAbs().maxCoeff(), found.assessment.violation,
                             found.converged, to_string(found.status)});
    table.add_row(line);
  }
}

/// A few lines for the terminal.
std::string summarise(const Table& predictions, const Table& outlines) {
  std::string text = fmt::format("{:<6}{:<10}{:<13}{:<10} {:>9} {:>10}  {}\n", "table", "workspace", "reading",
                                 "quantity", "printed", "predicted", "within rounding");
  for (std::size_t i = 0; i < predictions.rows(); ++i) {
    const bool small = std::abs(predictions.number(i, "predicted")) < 0.1;
    text += fmt::format("{:<6}{:<10}{:<13}{:<10} {:>9} {:>10}  {}\n", predictions.text(i, "table"),
                        predictions.text(i, "workspace"), predictions.text(i, "reading"),
                        predictions.text(i, "quantity"), predictions.text(i, "printed"),
                        small ? fmt::format("{:.2e}", predictions.number(i, "predicted"))
                              : fmt::format("{:.4f}", predictions.number(i, "predicted")),
                        predictions.text(i, "within_rounding"));
  }
  text += fmt::format("\n{:<10}{:<14}{:>8} {:>20} {:>8}  {}\n", "workspace", "parameter", "fitted", "compatible",
                      "in data", "within");
  for (std::size_t i = 0; i < outlines.rows(); ++i) {
    const std::string interval =
        outlines.text(i, "lower").empty()
            ? "none"
            : fmt::format("{:.4f} .. {:.4f}", outlines.number(i, "lower"), outlines.number(i, "upper"));
    text += fmt::format("{:<10}{:<14}{:>8.4f} {:>20} {:>8.4f}  {}\n", outlines.text(i, "workspace"),
                        outlines.text(i, "parameter"), outlines.number(i, "fitted"), interval,
                        outlines.number(i, "in_data"), outlines.text(i, "within"));
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(REPRISE_PROGRAM);
  EvidenceSettings settings;
  // With the printed y_C = 0.2317 of Table 5.3, P1 no outline is compatible. Here one digit is changed; others would
  // do, see the table `_digits`.
  double y_c = 0.0;
  experiment.prepares([&](CommandLine& options) {
    const Table misprint = read_misprints().where("item", "Table 5.3").where("case", "P1").where("quantity", "y_C");
    y_c = misprint.number(0, "read_as");
    options.number("--y-c", y_c, NumberRange::any(), "y_C read in place of the one of Table 5.3, P1, length");
  });
  long rays = settings.rays.directions;
  long steps = settings.rays.steps;
  long directions = 240;
  long starts = 3;
  long synthesis_start_count = 4;
  experiment.options().integer("--rays", rays, 60, 10'000, "rays from O' along which regions are sampled");
  experiment.options().integer("--steps", steps, 20, 10'000, "steps along each ray");
  experiment.options().integer("--directions", directions, 90, 10'000, "directions in which the fits see an outline");
  experiment.options().integer("--starts", starts, 1, 1'000, "starts of each least-squares fit");
  experiment.options().integer("--synthesis-starts", synthesis_start_count, 1, 1'000,
                               "starts of the synthesis of each outline");
  experiment.options().number("--protrusion", settings.protrusion, NumberRange::between(0.0, 0.1),
                              "how far an outline may stick out of the printed design's workspace, length");

  return experiment.run(
      argc, argv,
      [&](Session& session) {
        if (session.quick()) {
          rays = 120;
          steps = 60;
          directions = 90;
          starts = 1;
          synthesis_start_count = 1;
        }
        settings.rays = {static_cast<int>(rays), static_cast<int>(steps)};
        Progress progress(workspace_names.size() + 2);
        progress.begin("evidence");
        std::vector<PublishedRow> rows = read_published_rows();
        const auto misprinted = std::find_if(rows.begin(), rows.end(), [](const PublishedRow& row) {
          return row.table == "5.3" && row.workspace == "P1";
        });
        const PublishedRow corrected = with_y_c(*misprinted, y_c);
        rows.insert(misprinted + 1, corrected);
        const std::map<std::string, DataOutline> data = read_data_outlines();
        const Evidence evidence(rows, settings);
        std::map<std::string, std::map<std::string, double>> divisors;
        for (const auto& [workspace, outline] : data) divisors[workspace] = outline.divisors;

        const Table predictions = compare_predictions(rows, data);
        session.write(predictions);
        session.write(evidence.compare_start_values(), "start_values");
        session.write(evidence.describe_regions(), "regions");
        session.write(evidence.compare_sizes(divisors), "sizes");
        session.write(evidence.change_digits("5.3", "P1"), "digits");

        Fits fits(evidence, data, static_cast<int>(directions), static_cast<int>(starts));
        fits.refute("P1", "as printed");
        Table sensitivity = make_sensitivity_table();
        std::vector<PicturedOutlines> pictured;
        for (const std::string& workspace : workspace_names) {
          progress.begin(workspace);
          const WorkspaceFits kept = fits.run(workspace, corrected.reading);
          const PublishedRow& row = rows[evidence.find("5.3", workspace, corrected.reading)];
          study_sensitivity(sensitivity, row, data.at(workspace).divisors.at("5.3"), kept.candidates,
                            synthesis_start_count);
          pictured.push_back({workspace, corrected.reading, data.at(workspace).divisors, kept.compatible,
                              data.at(workspace).shape, kept.others});
        }
        session.write(fits.fits(), "fits");
        session.write(fits.outlines(), "outlines");
        session.write(sensitivity, "sensitivity");

        progress.begin("what is pictured");
        session.write(picture_outlines(evidence, pictured), "pictured");
        session.write(picture_start_value(evidence, {evidence.find("5.3", "P1", "as printed"),
                                                     evidence.find("5.3", "P1", corrected.reading)}),
                      "y_c");
        fmt::print("{}", summarise(predictions, fits.outlines()));
      },
      [](Session& session) {
        session.draw(draw_outlines(session.table("pictured")));
        session.draw(draw_start_value(session.table("y_c")), "y_c");
      });
}
