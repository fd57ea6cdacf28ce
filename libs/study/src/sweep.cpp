#include "reprise/study/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "reprise/base/constants.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/interruption.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/io/toml_reader.hpp"
#include "reprise/kinematics/conditioning.hpp"
#include "reprise/study/problem_file.hpp"
#include "reprise/study/reach_search.hpp"
#include "reprise/workspace/exact_workspace.hpp"
#include "reprise/workspace/limits.hpp"

namespace reprise {

namespace {

/// So that the rows of a block are not many seconds' work, and are lost together only when a program is killed.
constexpr std::size_t least_block_size = 16;
/// Folders with more files are slow on the file systems of clusters.
constexpr std::size_t most_blocks = 10'000;

constexpr const char* optimizer = "dynamic_q_safeguarded";

/// The design variables of a synthesis.
std::vector<std::string> design_names(const SweepStudy& study) {
  if (study.kind != SweepKind::synthesis) return {};
  return read_problem(study.problem, study.problem_file).task.designs.names();
}

const char* result_column(SweepKind kind) {
  switch (kind) {
    case SweepKind::pose:
      return "kappa_inv";
    case SweepKind::workspace:
    case SweepKind::dextrous:
      return "area";
    case SweepKind::synthesis:
      break;
  }
  return "kappa_inv_min";
}

std::vector<Column> columns_of(const SweepStudy& study) {
  std::vector<Column> columns{{"point", "-", "number of the point, from 0"}};
  for (const SweepAxis& axis : study.axes) {
    columns.push_back({axis.name, "as in the file", fmt::format("{}", fmt::join(axis.keys, ", "))});
  }
  columns.push_back({"status", "-",
                     "'found'; 'not_found' where there is no such pose, workspace or design; "
                     "'wrong_input' where the problem is wrong"});
  switch (study.kind) {
    case SweepKind::pose:
      columns.push_back({"kappa_inv", "-", "inverse condition number"});
      columns.push_back({"largest_limit", "length", "largest h; the pose is within its limits where it is at most 0"});
      break;
    case SweepKind::workspace:
    case SweepKind::dextrous:
      columns.push_back({"area", "length^2", "of the workspace"});
      columns.push_back({"components", "-", "parts of the workspace"});
      columns.push_back({"holes", "-", "in all of its parts"});
      break;
    case SweepKind::synthesis:
      columns.push_back({"kappa_inv_min", "-", "least inverse condition number of the design found, at a pose"});
      columns.push_back({"kappa_inv_min_bound", "-", "proved: it is nowhere below this"});
      columns.push_back({"violation", "length", "largest violation of a limit"});
      columns.push_back({"start", "-", "'file' or 'neighbour': where the search that found it began"});
      columns.push_back({"evaluations", "-", "function evaluations of all searches, finite differences counted in"});
      for (const std::string& name : design_names(study)) {
        columns.push_back({"found_" + name, "length", "of the design found"});
      }
      break;
  }
  columns.push_back({"message", "-", "what is wrong, in a sentence"});
  return columns;
}

/// What fills a row between status and message.
struct PointResult {
  std::string status;
  std::vector<Field> fields;
};

PointResult measure_pose(const SweepStudy& study, const ManipulatorInput& input) {
  const Pose pose{study.position, study.orientation_deg * degree};
  const ConstantOrientationLimits limits(input.manipulator, pose.orientation);
  Eigen::VectorXd h(limits.count());
  limits.evaluate(pose.position, h);
  const double limit = h.maxCoeff();
  return {limit <= 0.0 ? "found" : "not_found", {kappa_inverse(input.manipulator, pose, input.conditioning), limit}};
}

PointResult measure_region(const Region& region) {
  std::size_t holes = 0;
  for (const RegionComponent& component : region.components()) holes += component.holes.size();
  return {region.components().empty() ? "not_found" : "found", {region.area(), region.components().size(), holes}};
}

/// Syntheses of a block, one after the other.
class Synthesizer {
 public:
  explicit Synthesizer(const std::function<bool()>& stop, Progress& progress) : stop_(stop), progress_(progress) {}

  /// The next point follows none.
  void forget() { neighbour_.reset(); }

  PointResult operator()(const ProblemInput& problem) {
    const ScaledProblem scaled = scale(problem);
    const NamedSolver named = settings_.solvers({optimizer}).front();
    const auto from = [&](const Eigen::VectorXd& start) {
      return solve(scaled, settings_, named, start, never_, progress_);
    };
    SynthesisOutcome run = solve_where_reached(scaled, named.name, scaled.start, stop_, from);
    const char* start = "file";
    long evaluations = run.result.counts.function_evaluations();
    if (neighbour_ && neighbour_->size() == scaled.start.size()) {
      const DesignSpace& designs = scaled.task.designs;
      const SynthesisOutcome other =
          from((*neighbour_ / scaled.unit).cwiseMax(designs.lower()).cwiseMin(designs.upper()));
      evaluations += other.result.counts.function_evaluations();
      if (better(other, run)) {
        run = other;
        start = "neighbour";
      }
    }
    const Eigen::VectorXd design = run.design * scaled.unit;
    neighbour_ = run.reaches() ? std::optional(design) : std::nullopt;
    PointResult result{run.reaches() ? "found" : "not_found", {}};
    if (run.reaches()) {
      result.fields = {run.proof.kappa_inverse.upper, run.proof.kappa_inverse.lower};
    } else {
      result.fields = {Field(), Field()};
    }
    result.fields.insert(result.fields.end(), {run.proof.violation, start, evaluations});
    for (const double value : design) result.fields.emplace_back(value);
    return result;
  }

 private:
  const std::function<bool()>& stop_;
  Progress& progress_;
  SynthesisSettings settings_;
  Stop never_{std::nullopt};
  std::optional<Eigen::VectorXd> neighbour_;
};

Json to_json(const SweepPlan& plan) {
  return {{"schema", schema},      {"title", plan.title},
          {"points", plan.points}, {"block_size", plan.block_size},
          {"axes", plan.axes},     {"logarithmic", plan.logarithmic},
          {"sample", plan.sample}, {"result", plan.result},
          {"inputs", plan.inputs}};
}

std::string text_of(const SweepPlan& plan) {
  return to_json(plan).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The files that a problem takes tables from.
std::vector<std::filesystem::path> shared_files(const SweepStudy& study) {
  std::vector<std::filesystem::path> files;
  for (const char* name : {"manipulator", "workspace"}) {
    if (const auto file = study.problem[name]["file"].value<std::string>()) {
      files.push_back(study.problem_file.parent_path() / *file);
    }
  }
  return files;
}

}  // namespace

SweepPlan make_plan(const SweepStudy& study) {
  SweepPlan plan;
  plan.title = fmt::format("Sweep of {}", study.problem_file.filename().string());
  plan.points = study.size();
  plan.block_size = std::max(least_block_size, (plan.points + most_blocks - 1) / most_blocks);
  for (const SweepAxis& axis : study.axes) {
    plan.axes.push_back(axis.name);
    plan.logarithmic.push_back(axis.logarithmic);
  }
  plan.sample = study.sample.has_value();
  plan.result = result_column(study.kind);
  std::vector<std::filesystem::path> files = shared_files(study);
  files.insert(files.begin(), {study.file, study.problem_file});
  for (const std::filesystem::path& file : files) plan.inputs[file.filename().string()] = read_file(file);
  return plan;
}

std::optional<Table> compute_block(const SweepStudy& study, const SweepPlan& plan, std::size_t block,
                                   const std::function<bool()>& stop, Progress& progress) {
  Table table(plan.title, columns_of(study));
  const std::size_t fields = table.columns().size() - study.axes.size() - 3;
  Synthesizer synthesize(stop, progress);
  const std::size_t end = std::min(plan.points, (block + 1) * plan.block_size);
  for (std::size_t index = block * plan.block_size; index < end; ++index) {
    const std::vector<double> values = study.point(index);
    progress.begin(fmt::format("point {} of {}", index + 1, plan.points));
    if (study.sample) synthesize.forget();
    PointResult result;
    std::string message;
    try {
      const toml::table tables = study.problem_at(values);
      if (study.kind == SweepKind::synthesis) {
        result = synthesize(read_problem(tables, study.problem_file));
      } else {
        const ManipulatorInput input = read_manipulator(tables, study.problem_file);
        result = study.kind == SweepKind::pose ? measure_pose(study, input)
                 : study.kind == SweepKind::workspace
                     ? measure_region(constant_orientation_workspace(input.manipulator, study.orientation_deg * degree))
                     : measure_region(dextrous_workspace(input.manipulator,
                                                         {study.range_deg[0] * degree, study.range_deg[1] * degree}));
      }
    } catch (const InputError& error) {
      result = {"wrong_input", std::vector<Field>(fields)};
      message = on_one_line(error.what());
      synthesize.forget();
    }
    if (stop()) return std::nullopt;
    std::vector<Field> row{index};
    row.insert(row.end(), values.begin(), values.end());
    row.emplace_back(result.status);
    row.insert(row.end(), result.fields.begin(), result.fields.end());
    row.emplace_back(message);
    table.add_row(row);
  }
  return table;
}

SweepFolder::SweepFolder(std::filesystem::path folder, const SweepPlan& plan)
    : folder_(std::move(folder)), plan_(plan) {
  const std::filesystem::path file = folder_ / "plan.json";
  if (std::filesystem::exists(file)) {
    if (read_file(file) != text_of(plan)) {
      throw std::invalid_argument(
          fmt::format("{} holds another sweep, or this one with other files; choose another folder or remove it.",
                      folder_.string()));
    }
  } else {
    is_new_ = make_folder(folder_);
    write_file(file, text_of(plan));
  }
  make_folder(folder_ / "blocks");
}

SweepFolder::SweepFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  const std::filesystem::path file = folder_ / "plan.json";
  if (!std::filesystem::exists(file)) {
    throw std::invalid_argument(fmt::format("{} holds no sweep: there is no plan.json in it.", folder_.string()));
  }
  const Json plan = Json::parse(read_file(file), nullptr, false);
  try {
    plan_ = {plan.at("title"),       plan.at("points"), plan.at("block_size"), plan.at("axes"),
             plan.at("logarithmic"), plan.at("sample"), plan.at("result"),     plan.at("inputs")};
  } catch (const Json::exception&) {
    throw std::invalid_argument(fmt::format("{} is not the plan of a sweep.", file.string()));
  }
}

std::filesystem::path SweepFolder::block_file(std::size_t block) const {
  return folder_ / "blocks" / fmt::format("{:06}.csv", block);
}

bool SweepFolder::has(std::size_t block) const { return std::filesystem::exists(block_file(block)); }

void SweepFolder::write(std::size_t block, const Table& rows) const { write_table(block_file(block), rows); }

std::vector<std::size_t> SweepFolder::missing() const {
  std::vector<std::size_t> blocks;
  for (std::size_t block = 0; block < plan_.blocks(); ++block) {
    if (!has(block)) blocks.push_back(block);
  }
  return blocks;
}

std::filesystem::path SweepFolder::merge() const {
  const std::filesystem::path file = folder_ / "sweep.csv";
  // Beside its place and under another name until it is whole: it may be too long to be held in memory.
  const TemporaryFile part(folder_ / ".sweep.csv.part");
  {
    std::ofstream out(part.path(), std::ios::binary);
    for (std::size_t block = 0; block < plan_.blocks(); ++block) {
      if (!has(block)) throw std::runtime_error(fmt::format("{} is missing.", block_file(block).string()));
      std::istringstream rows(read_file(block_file(block)));
      bool in_head = block > 0;
      for (std::string line; std::getline(rows, line);) {
        const bool comment = line.starts_with('#');
        if (!in_head) out << line << '\n';
        if (in_head && !comment) in_head = false;
      }
    }
    out.close();
    if (!out) throw std::runtime_error(fmt::format("{} cannot be written.", file.string()));
  }
  std::filesystem::rename(part.path(), file);
  return file;
}

}  // namespace reprise
