#pragma once

// The frame of every program under experiments/:
//
//     int main(int argc, char** argv) {
//       reprise::experiments::Experiment experiment(REPRISE_PROGRAM);
//       double chord = 0.02;
//       experiment.options().number("--chord", chord, NumberRange::positive(), "chord length d");
//       return experiment.run(argc, argv, [&](Session& session) {
//         Table table(...);
//         ...
//         session.write(table);
//       }, [&](Session& session) { session.draw(draw(session.table())); });
//     }
//
// REPRISE_PROGRAM is the program's entry in experiments/manifest; the build defines it for each program.
//
// Every program has --out DIR, --quick and --help, and with pictures --redraw. It writes <program>.csv first, pictures
// from its tables as they are stored, and <program>.json with the provenance last; an old <program>.json is removed
// before anything is written. So a folder that holds <program>.json holds a whole result. While a program writes, no
// other one writes into its folder.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reprise/io/figure.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/options.hpp"
#include "reprise/io/table.hpp"

namespace reprise::experiments {

/// What experiments/manifest says of a program.
struct ManifestEntry {
  std::string program;
  std::string item;   ///< table, figure or section of the thesis: "Figure 5.7"
  std::string title;  ///< a line for people
};

/// One run of an experiment: its settings, the results it reads, what it writes.
class Session {
 public:
  /// True when the user asks for a shorter run, to see whether everything works.
  bool quick() const { return quick_; }

  /// A table that another program has written, <from>/<program>/<program>[_<part>].csv. Throws std::runtime_error,
  /// saying which command makes it, when it is not there, its folder is not whole, or it has other rows than it had.
  Table read(const std::string& program, const std::string& part = "");

  /// Writes <out>/<program>[_<part>].csv.
  void write(const Table& table, const std::string& part = "");

  /// The table that this program has written, read from its file. Throws std::runtime_error when it is not there, or,
  /// in a whole result, has other rows than it had.
  Table table(const std::string& part = "") const;

  /// Draws <out>/<program>[_<part>].svg and .png.
  void draw(const Figure& figure, const std::string& part = "");

  /// Writes <out>/<file>, of any name and content; folders in its name are made. Returns where it stands.
  std::filesystem::path store(const std::filesystem::path& file, std::string_view content);

  /// Puts a measured number that belongs in no table, such as a time, into <program>.json.
  void record(const std::string& name, double value) { measured_[name] = value; }

  /// Puts a number that is built into the program, and that the report names, into <program>.json.
  void constant(const std::string& name, double value) { constants_[name] = value; }

 private:
  friend class Experiment;
  Session(std::string program, std::filesystem::path out, bool parents, std::filesystem::path from, bool quick);

  /// Before the first output: what lies there is not a whole result any more.
  void open();
  std::string file_stem(const std::string& part) const;

  std::string program_;
  std::filesystem::path out_;
  bool parents_;  ///< whether the folders above out_ may be made
  std::filesystem::path from_;
  bool quick_;
  std::optional<FolderLock> lock_;  ///< from the first output on
  std::vector<std::filesystem::path> inputs_;
  std::vector<std::string> outputs_;
  std::map<std::string, std::size_t> rows_;
  std::map<std::string, double> measured_;
  std::map<std::string, double> constants_;
};

class Experiment {
 public:
  explicit Experiment(const ManifestEntry& entry);

  /// For the program's own options.
  CommandLine& options() { return options_; }

  /// For options whose standard values stand in files: called by run() before it reads the options, so that a file that
  /// is missing or wrong is said as all else that fails.
  void prepares(std::function<void(CommandLine&)> prepare) { prepare_ = std::move(prepare); }

  /// Adds --from DIR (default build/results), the folder of the results that Session::read looks into.
  void reads_results();

  /// Reads the options, runs the body and writes the provenance. Returns the exit code of the program: 0 when all that
  /// was promised is written; 2 for a wrong option, results that cannot be written there, or what the libraries reject
  /// as wrong input (std::invalid_argument); 1 for any other failure. What failed is said in one sentence on standard
  /// error. The folder of the results is made; those above it only where --out is not given.
  int run(int argc, const char* const* argv, const std::function<void(Session&)>& body);

  /// The same for a program with pictures: `compute` writes the tables, `draw` the pictures from Session::table. With
  /// --redraw, which this adds, only the second is done, and the provenance stays as it is.
  int run(int argc, const char* const* argv, const std::function<void(Session&)>& compute,
          const std::function<void(Session&)>& draw);

 private:
  std::string program_;
  std::string title_;
  CommandLine options_;
  std::function<void(CommandLine&)> prepare_;
  std::filesystem::path out_;
  std::filesystem::path from_ = "build/results";
  bool quick_ = false;
  bool redraw_ = false;
};

}  // namespace reprise::experiments
