#pragma once

// Command-line options with one sentence for everything that can be wrong with them.
//
// An option that need not be given has a default: the value that its variable holds when it is declared. The variables
// are set by parse(), all or none.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reprise/io/number_range.hpp"

namespace reprise {

/// A wrong option or value; what() is one sentence that names option, value and what is allowed.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option as a completion of command lines needs it.
struct OptionSummary {
  std::string name;                  ///< "--chord"; empty for a file that is given without a name
  std::vector<std::string> choices;  ///< the values that are allowed, where they are words
  bool takes_value = true;           ///< false for a flag
  bool is_path = false;              ///< the value names a file or a folder
};

/// The options of a program, and what it says about them with --help.
class CommandLine {
 public:
  /// The program's name begins every message; the description begins the help.
  CommandLine(const std::string& program, const std::string& description);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Names are written as on the command line, "--chord". The variables must outlive parse().
  void flag(const std::string& name, bool& value, const std::string& help);
  /// A number of this range.
  void number(const std::string& name, double& value, const NumberRange& range, const std::string& help);
  /// A whole number between two others, which are allowed.
  void integer(const std::string& name, long& value, long least, long most, const std::string& help);
  /// A file or a folder; it need not be there.
  void path(const std::string& name, std::filesystem::path& value, const std::string& help);
  /// One of the words allowed.
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
              const std::string& help);

  /// A number without a default.
  void number(const std::string& name, std::optional<double>& value, const NumberRange& range, const std::string& help);

  /// As many numbers, separated by blanks, as the text has words ("X Y"). Where `values` is empty the option must be
  /// given.
  void tuple(const std::string& name, std::vector<double>& values, const std::string& words, const NumberRange& range,
             const std::string& help);

  /// A text that is not empty; the help calls it by `word`.
  void text(const std::string& name, std::string& value, const std::string& word, const std::string& help);

  /// A file that is given without a name, as in "program FILE", and must be given where it is required.
  void file(const std::string& word, std::filesystem::path& value, const std::string& help, bool required = true);

  /// Text that --help prints after the options.
  void footer(const std::string& text);

  /// Lists separated by commas: at least one value, none twice, in the order given.
  void numbers(const std::string& name, std::vector<double>& values, const NumberRange& range, const std::string& help);
  /// Some of the words allowed.
  void choices(const std::string& name, std::vector<std::string>& values, const std::vector<std::string>& allowed,
               const std::string& help);

  /// Reads the command line and sets the variables. Returns false, and sets nothing, when --help is among the options.
  /// Throws UsageError.
  bool parse(int argc, const char* const* argv);

  /// What --help prints.
  std::string help() const;

  /// All options, in the order of declaration, and --help.
  std::vector<OptionSummary> summaries() const;

  /// Name and value, as JSON, of every option, in the order of declaration.
  std::vector<std::pair<std::string, std::string>> values() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace reprise
