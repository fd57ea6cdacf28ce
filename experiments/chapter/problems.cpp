#include "chapter/problems.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "frame/source_tree.hpp"

namespace reprise::experiments {

namespace {

CollinearManipulator collinear(const Manipulator& manipulator) {
  const std::optional<CollinearDesign> design = collinear_design(manipulator);
  if (!design) throw std::runtime_error("The manipulator " + manipulator.name() + " is not in the thesis's form.");
  const std::vector<Leg>& legs = manipulator.legs();
  return {manipulator.name(), *design, {legs[0].length, legs[1].length, legs[2].length}};
}

}  // namespace

CollinearManipulator read_chapter_manipulator(const std::string& name) {
  return collinear(read_manipulator(examples_folder() / (name + ".toml")).manipulator);
}

const ChapterSynthesis& chapter_synthesis(std::string_view kind) {
  const auto found = std::find_if(chapter_syntheses.begin(), chapter_syntheses.end(),
                                  [&](const ChapterSynthesis& one) { return one.kind == kind; });
  if (found == chapter_syntheses.end()) {
    throw std::logic_error("The chapter has no kind of synthesis " + std::string(kind) + ".");
  }
  return *found;
}

ProblemInput read_chapter_problem(const ChapterSynthesis& synthesis, const std::string& workspace) {
  return read_problem(examples_folder() / (workspace + synthesis.file + ".toml"));
}

std::vector<PrescribedWorkspace> read_prescribed_workspaces(const ChapterSynthesis& synthesis) {
  std::vector<PrescribedWorkspace> workspaces;
  for (const std::string& name : workspace_names) {
    workspaces.push_back(read_chapter_problem(synthesis, name).task.prescribed);
  }
  return workspaces;
}

std::vector<OrientationRange> read_orientations(const ChapterSynthesis& synthesis) {
  return read_chapter_problem(synthesis, workspace_names.front()).task.orientations;
}

Table read_published(const ChapterSynthesis& synthesis) {
  return read_table(data_folder() / "published" / (std::string(synthesis.published) + ".csv"));
}

CollinearManipulator read_start(const ChapterSynthesis& synthesis) {
  return collinear(read_chapter_problem(synthesis, workspace_names.front()).start.manipulator);
}

}  // namespace reprise::experiments
