#pragma once

// What the chapter studies: the manipulators M1 to M3, and the nine syntheses of Tables 5.3 to 5.5. They are the files
// examples/M1.toml to M3.toml, and for each prescribed workspace P1.toml, P1_several.toml and P1_dextrous.toml.
//
// All functions throw InputError as problem_file.hpp does.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/io/table.hpp"
#include "reprise/kinematics/manipulator.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise::experiments {

/// The columns of a design in the tables, in the order of the design vector d.
inline constexpr std::array<const char*, 5> design_columns{"x_C", "y_C", "x_D", "x_E", "r"};

/// The prescribed workspaces.
inline const std::vector<std::string> workspace_names{"P1", "P2", "P3"};

/// kappa^-1 as the thesis has it, eq. (5.13).
inline const Conditioning printed_conditioning{Normalisation::printed, {}};

/// A manipulator of the thesis's family.
struct CollinearManipulator {
  std::string name;
  CollinearDesign design;
  std::array<Interval, 3> lengths;
};

/// M1, M2 or M3 (Table 5.1; limits of section 5.5.4).
CollinearManipulator read_chapter_manipulator(const std::string& name);

/// A kind of synthesis: one orientation, several, or all of a range.
struct ChapterSynthesis {
  const char* table;      ///< that has its results
  const char* kind;       ///< SO, MO or D
  const char* program;    ///< which makes the table
  const char* published;  ///< the printed table, in data/published, without .csv
  const char* file;       ///< a file of examples is called by its workspace and this
};

/// Of sections 5.6, 5.7 and 5.8.
inline constexpr std::array<ChapterSynthesis, 3> chapter_syntheses{
    {{"5.3", "SO", "table_5_3_so_synthesis", "table_5_3", ""},
     {"5.4", "MO", "table_5_4_mo_synthesis", "table_5_4", "_several"},
     {"5.5", "D", "table_5_5_d_synthesis", "table_5_5", "_dextrous"}}};

/// The synthesis of that kind.
const ChapterSynthesis& chapter_synthesis(std::string_view kind);

/// The problem of a kind of synthesis for one prescribed workspace: from the chapter's start, the workspace in the size
/// that belongs to the kind.
ProblemInput read_chapter_problem(const ChapterSynthesis& synthesis, const std::string& workspace);

/// Its prescribed workspaces, P1 to P3.
std::vector<PrescribedWorkspace> read_prescribed_workspaces(const ChapterSynthesis& synthesis);

/// Its orientations.
std::vector<OrientationRange> read_orientations(const ChapterSynthesis& synthesis);

/// Its results as printed. Throws as read_table does.
Table read_published(const ChapterSynthesis& synthesis);

/// The manipulator it starts from.
CollinearManipulator read_start(const ChapterSynthesis& synthesis);

}  // namespace reprise::experiments
