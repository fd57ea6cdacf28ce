#pragma once

// The frame of the program: subcommands, each with its options, and what they give back.

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reprise/io/figure.hpp"
#include "reprise/io/options.hpp"
#include "reprise/io/table.hpp"
#include "reprise/study/documents.hpp"

namespace reprise::app {

/// What a command has found. Nothing is written before all of it is there.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a JSON value does not throw.
struct Output {
  Json document;                                           ///< without the head that all documents share
  std::string text;                                        ///< the same for people
  std::string unit;                                        ///< of length, where the file gives one
  std::vector<std::pair<std::string, Table>> tables;       ///< for --out, by file name without .csv
  std::vector<std::pair<std::string, std::string>> files;  ///< for --out, name and content
  std::function<Figure()> picture;                         ///< for --plot
  /// 0, or 1 for what is no result, as when a time limit came before there was one. Where a signal has cut the
  /// computation short (interrupted(), see PolledInterruption), the program ends with that signal's code
  /// whatever stands here; the text must say that it is the best so far.
  int exit_code = 0;
};

/// A subcommand. It runs once.
class Command {
 public:
  /// `examples` are command lines, one a line, that --help shows; `file` is what the file is.
  Command(std::string name, std::string summary, const std::string& description, const std::string& examples,
          const std::string& file = "manipulator or problem, in TOML (see: reprise help input)",
          bool file_required = true);
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  const std::string& name() const { return name_; }
  const std::string& summary() const { return summary_; }
  CommandLine& options() { return options_; }
  const CommandLine& options() const { return options_; }

  /// Reads the options, looks whether what is asked for can be written, and computes; then prints the document or the
  /// text to `out`, writes the tables, and draws the picture last: what was found is not lost where a file or gnuplot
  /// refuses. Returns the exit code. Throws UsageError, InputError or std::invalid_argument for wrong input, before
  /// anything is computed where options or files are wrong; std::runtime_error, after all that can be written is
  /// written, with a sentence for each thing that cannot. What else is worth a word goes to `err`.
  int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

 protected:
  /// Adds --plot; the output must then have a picture.
  void draws();
  /// Adds --out, which writes files of these names only (not all of them each time).
  void writes_files(const std::vector<std::string>& names);
  const std::filesystem::path& file() const { return file_; }

 private:
  virtual Output compute() = 0;

  /// Throws UsageError where --plot or --out cannot be written, or would replace the input.
  void check_targets() const;
  void write_files(const Output& output) const;

  std::string name_;
  std::string summary_;
  CommandLine options_;
  std::filesystem::path file_;
  std::filesystem::path plot_;
  std::filesystem::path out_;
  std::vector<std::string> out_names_;
  bool json_ = false;
};

/// All subcommands, in the order of the help.
std::vector<std::unique_ptr<Command>> all_commands();

std::vector<std::unique_ptr<Command>> pose_commands();       ///< pose, assemble
std::vector<std::unique_ptr<Command>> workspace_commands();  ///< workspace, dextrous, orientation
std::vector<std::unique_ptr<Command>> conditioning_commands();
std::vector<std::unique_ptr<Command>> synthesis_commands();  ///< synthesize, compare, check
std::vector<std::unique_ptr<Command>> sweep_commands();

/// The whole program. Returns its exit code: 0 for a result, 2 for wrong options or input, 128 + signal where a signal
/// has cut the computation short, 1 for any other failure; what failed is said in one sentence on `err`.
int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

/// A script that completes command lines of the program: for "bash", "zsh" or "fish". Throws UsageError for another
/// shell.
std::string completion_script(const std::string& shell);

}  // namespace reprise::app
