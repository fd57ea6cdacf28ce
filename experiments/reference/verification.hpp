#pragma once

// Holds results against the ones that are stored in data/reference, and against printed numbers.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "reprise/io/table.hpp"

namespace reprise::experiments {

/// A column of a result that is held against its reference.
struct CheckedColumn {
  std::string name;
  double tolerance =
      0.0;             ///< |value - reference| <= tolerance max(1, |reference|); 0 for a text, which must be the same
  std::string reason;  ///< why no smaller tolerance
};

/// A table of results, or some of its rows, and how close it must come to its reference.
struct Check {
  std::string reference;  ///< the reference is <folder>/<reference>.csv
  std::string program;
  std::string part;                                        ///< of the program's tables; empty for the main one
  std::vector<std::pair<std::string, std::string>> where;  ///< the rows of which these columns hold these texts
  std::vector<std::string> keys;                           ///< columns that tell the rows apart
  std::vector<CheckedColumn> columns;
};

/// Reads tolerances.csv, a row for each column: reference, program, part, where ("column=text column=text"), keys
/// ("column column"), column, tolerance, reason. Throws std::runtime_error, naming the file and what is wrong: a
/// tolerance that is negative or no number, a missing reason, rows of one reference that contradict each other.
std::vector<Check> read_checks(const std::filesystem::path& file);

/// The rows and columns of a result that a check is about: what is stored as its reference.
Table reduce(const Check& check, const Table& result);

/// One row for each value: reference, row (its keys), column, value, stored, difference, allowed, verdict, reason. The
/// verdict is "same", "within" (the tolerance), or what is wrong: "differs", "not a number", "missing" (in the result),
/// "not stored" (in the reference). A number that is not finite is the same as another only when both are written
/// alike.
Table hold_against(const Check& check, const Table& result, const Table& reference);

/// The columns of hold_against without rows, to which the rows of several checks are added.
Table make_reference_verdicts();

/// Whether the verdict is one of those that are right.
bool is_right(const std::string& verdict);

}  // namespace reprise::experiments
