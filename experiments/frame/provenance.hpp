#pragma once

// Where a result comes from: <program>.json beside its table. It is written last, so a folder that holds it is whole.

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace reprise::experiments {

struct Provenance {
  std::string program;
  std::string title;
  std::vector<std::pair<std::string, std::string>> options;  ///< name and value as JSON
  std::vector<std::filesystem::path> inputs;                 ///< the JSON files of the results that were read
  std::vector<std::string> outputs;                          ///< file names
  std::map<std::string, std::size_t> rows;                   ///< the number of rows of each table, by its file name
  std::map<std::string, double> measured;                    ///< what was measured and is not in a table, such as times
  std::map<std::string, double> constants;                   ///< what is built into the program and the report names
  double seconds = 0.0;                                      ///< wall time of the run
};

/// Writes the record together with commit and state of the sources at the last build, compiler, flags, build type,
/// versions of the libraries, processor, number of its cores and time of day.
void write_provenance(const std::filesystem::path& path, const Provenance& provenance);

/// Throws std::runtime_error, naming the table's file, when the table beside the record has another number of rows than
/// the record says: one that was cut off between two lines looks whole.
void check_rows(const std::filesystem::path& record, const std::string& file, std::size_t rows);

}  // namespace reprise::experiments
