// reprise sweep: the same computation at many points.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>

#include "command.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/interruption.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/study/sweep.hpp"

namespace reprise::app {

namespace {

/// One of n shares of the blocks.
struct Share {
  std::size_t number = 1;
  std::size_t of = 1;
};

/// "3/8". Throws UsageError for another text.
Share read_share(const std::string& text) {
  constexpr std::size_t most = 1'000'000;
  Share share{0, 0};
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, share.number);
  if (error == std::errc() && slash != end && *slash == '/') {
    const auto [rest, second_error] = std::from_chars(slash + 1, end, share.of);
    if (second_error == std::errc() && rest == end && share.number >= 1 && share.number <= share.of && share.of <= most)
      return share;
  }
  throw UsageError(
      fmt::format("--part is '{}', but must be K/N, two whole numbers with 1 <= K <= N <= {}.", text, most));
}

class SweepCommand final : public Command {
 public:
  SweepCommand()
      : Command("sweep", "The same computation at many points",
                "A study names a problem file, which of its numbers vary, and what is computed at each point: pose,\n"
                "workspace, dextrous workspace or synthesis (see: reprise help input). The folder gets one file for\n"
                "each block of points as soon as it is computed; what is there is never computed again, so the same\n"
                "command goes on after an interruption. When all blocks are there they are put together in sweep.csv\n"
                "and drawn in sweep.svg and sweep.png. --part K/N computes one share of N only, so that several\n"
                "programs, on one machine or on a cluster, fill one folder; --merge then puts it together.\n"
                "The rows do not depend on how the work was divided.",
                "reprise sweep examples/sweep_rectangle.toml --out sweep\n"
                "reprise sweep examples/sweep_rectangle.toml --out sweep --part 3/8\n"
                "reprise sweep --merge sweep",
                "study, in TOML (see: reprise help input)", false) {
    options().path("--out", folder_, "folder of the sweep, made when it is not there");
    options().path("--merge", merged_, "put the blocks of this folder together; computes nothing");
    options().text("--part", part_, "K/N", "compute share K of N only, and put nothing together");
  }

 private:
  Output compute() override {
    if (!merged_.empty()) {
      if (!file().empty() || !folder_.empty() || !part_.empty())
        throw UsageError("--merge is given with a study, --out or --part, but stands alone.");
      return finish(SweepFolder(merged_), merged_, 0);
    }
    if (file().empty()) throw UsageError("FILE is missing; the study must be given.");
    if (folder_.empty()) throw UsageError("--out is missing; the folder of the sweep must be given.");
    const Share share = part_.empty() ? Share() : read_share(part_);
    const SweepStudy study = read_study(file());
    if (const std::string obstacle = obstacle_to_folder(folder_); !obstacle.empty())
      throw UsageError(fmt::format("--out is '{}', but {}.", folder_.string(), obstacle));
    const SweepFolder folder(folder_, make_plan(study));
    std::vector<std::size_t> blocks = folder.missing();
    std::erase_if(blocks, [&](std::size_t block) { return block % share.of != share.number - 1; });
    const std::size_t computed = compute_blocks(study, folder, blocks);
    if (computed < blocks.size() || !part_.empty()) return report(folder, computed, blocks.size());
    return finish(folder, folder_, computed);
  }

  /// Computes blocks until a signal comes, and returns how many are written.
  static std::size_t compute_blocks(const SweepStudy& study, const SweepFolder& folder,
                                    const std::vector<std::size_t>& blocks) {
    const PolledInterruption polled;
    Progress progress(blocks.size() * folder.plan().block_size);
    std::size_t computed = 0;
    for (const std::size_t block : blocks) {
      const std::optional<Table> rows = compute_block(
          study, folder.plan(), block, [] { return interrupted(); }, progress);
      if (!rows) break;
      folder.write(block, *rows);
      ++computed;
    }
    return computed;
  }

  static void describe(Output& output, const SweepFolder& folder, std::size_t computed) {
    const SweepPlan& plan = folder.plan();
    const std::size_t missing = folder.missing().size();
    output.document = {{"points", plan.points},
                       {"blocks", plan.blocks()},
                       {"block_size", plan.block_size},
                       {"computed_blocks", computed},
                       {"missing_blocks", missing}};
    output.text = fmt::format("{}: {} in {}, varying {}\n{} computed now, {} missing\n", plan.title,
                              counted(plan.points, "point"), counted(plan.blocks(), "block"),
                              fmt::join(plan.axes, ", "), counted(computed, "block"), missing);
    if (folder.is_new()) output.text += "The folder was made.\n";
  }

  /// After a share, or an interruption.
  static Output report(const SweepFolder& folder, std::size_t computed, std::size_t wanted) {
    Output output;
    describe(output, folder, computed);
    output.text += computed < wanted ? "Stopped; the same command goes on from here.\n" : "This share is done.\n";
    return output;
  }

  /// All blocks should be there.
  Output finish(const SweepFolder& folder, const std::filesystem::path& path, std::size_t computed) {
    Output output;
    describe(output, folder, computed);
    const std::vector<std::size_t> missing = folder.missing();
    if (!missing.empty()) {
      const std::vector<std::size_t> first(missing.begin(),
                                           missing.begin() + std::min<std::ptrdiff_t>(10, std::ssize(missing)));
      output.document["first_missing"] = first;
      output.text += fmt::format("The sweep is not complete: missing are the blocks {}{}.\n", fmt::join(first, ", "),
                                 missing.size() > first.size() ? ", ..." : "");
      output.exit_code = 1;
      return output;
    }
    const std::filesystem::path table = folder.merge();
    output.document["table"] = table.string();
    output.text += fmt::format("The table is {}.\n", table.string());
    if (folder.plan().points > most_drawn_points) {
      output.text += fmt::format("It is not drawn, since it has more than {} points.\n", most_drawn_points);
      return output;
    }
    const Table rows = read_table(table);
    std::size_t found = 0;
    for (std::size_t row = 0; row < rows.rows(); ++row) found += rows.text(row, "status") == "found" ? 1 : 0;
    output.document["found"] = found;
    output.text += fmt::format("Of {}, {} have a result.\n", counted(rows.rows(), "point"), found);
    if (found > 0) {
      try {
        draw_sweep(folder.plan(), rows).write(path, "sweep");
        output.text += fmt::format("The picture is {}, and sweep.png beside it.\n", (path / "sweep.svg").string());
      } catch (const std::runtime_error& error) {
        output.text += fmt::format("There is no picture: {}\n", error.what());
        output.exit_code = 1;
      }
    }
    return output;
  }

  std::filesystem::path folder_;
  std::filesystem::path merged_;
  std::string part_;
};

}  // namespace

std::vector<std::unique_ptr<Command>> sweep_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<SweepCommand>());
  return commands;
}

}  // namespace reprise::app
