#pragma once

// Sweeps: the same computation at many points, cut into blocks that do not depend on each other. A block is a file; so
// blocks may be computed in any order, by any number of programs at once, on any number of machines that see one
// folder, and give the same bytes. The folder holds
//
//     plan.json          what is computed, so that no other study is mixed in
//     blocks/000000.csv  the rows of a block, written when all of it is there
//     sweep.csv          all rows, put together at the end

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reprise/io/figure.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/io/table.hpp"
#include "reprise/study/documents.hpp"
#include "reprise/study/sweep_study.hpp"

namespace reprise {

/// A sweep as far as its folder needs it.
struct SweepPlan {
  std::string title;              ///< of the table
  std::size_t points = 0;         ///< in all
  std::size_t block_size = 1;     ///< points of each block but the last, which may have fewer
  std::vector<std::string> axes;  ///< columns of the numbers that vary
  std::vector<bool> logarithmic;  ///< for each of them, whether its steps are factors
  bool sample = false;            ///< no grid
  std::string result;             ///< the column that pictures show
  Json inputs;                    ///< the files it was made from, by name and content

  std::size_t blocks() const { return (points + block_size - 1) / block_size; }  ///< number of blocks
};

/// The plan of a study.
SweepPlan make_plan(const SweepStudy& study);

/// The rows of a block. A synthesis begins at the design of the problem file and, in a grid, also at the design of the
/// point before it in its block, where that reaches its workspace; the better result counts. (Alone, a neighbour's
/// design may lead to a poorer local optimum than the file's.) A point whose problem is wrong is a row that says why.
/// Nothing where `stop` said true before the last row was there.
std::optional<Table> compute_block(const SweepStudy& study, const SweepPlan& plan, std::size_t block,
                                   const std::function<bool()>& stop, Progress& progress);

/// A folder with blocks.
class SweepFolder {
 public:
  /// Makes the folder where it is not there, and writes the plan. Throws std::invalid_argument where the folder has
  /// another plan, std::runtime_error where it cannot be written.
  SweepFolder(std::filesystem::path folder, const SweepPlan& plan);

  /// A folder that is there, with its plan. Throws std::invalid_argument where it has none.
  explicit SweepFolder(std::filesystem::path folder);

  const SweepPlan& plan() const { return plan_; }  ///< as it stands in the folder
  bool is_new() const { return is_new_; }          ///< whether the folder was made

  bool has(std::size_t block) const;  ///< whether the block is there

  /// Writes a block; it appears whole or not at all.
  void write(std::size_t block, const Table& rows) const;

  std::vector<std::size_t> missing() const;  ///< the blocks that are not there

  /// Puts all blocks together, row by row, and returns the file, sweep.csv. Throws std::runtime_error where a block is
  /// missing or the file cannot be written.
  std::filesystem::path merge() const;

 private:
  std::filesystem::path block_file(std::size_t block) const;

  std::filesystem::path folder_;
  SweepPlan plan_;
  bool is_new_ = false;
};

/// Pictures have at most this many points.
constexpr std::size_t most_drawn_points = 200'000;

/// The result over the numbers that vary: a line over one, a map with contours over two; of more, a map of the last two
/// for each of the first values of the others, at most nine. Of a sample, the result over each number.
Figure draw_sweep(const SweepPlan& plan, const Table& rows);

}  // namespace reprise
