#pragma once

// Tables of results: comma-separated values that say themselves what they hold.
//
//     # Table 5.3: single-orientation synthesis          (title)
//     # Settings of section 5.6.2.                       (any number of notes)
//     # x_C [length]: x coordinate of base joint C       (one line for each column: name, unit, meaning)
//     x_C,...                                            (bare column names)
//     -1.1110000000000001,...                            (data)
//
// Numbers are written with the fewest digits that read back to the same value, so the same results are the same bytes.

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// A column: its name, its unit and what it means.
struct Column {
  std::string name;     ///< a letter, then letters, digits and underscores
  std::string unit;     ///< "-" for pure numbers and texts
  std::string meaning;  ///< one line
};

/// What a field of a table is made of: a text, a number, or nothing (a field left empty).
class Field {
 public:
  Field() = default;
  /// A text, as it is.
  Field(std::string text) : text_(std::move(text)) {}
  /// A text, as it is.
  Field(std::string_view text) : text_(text) {}
  /// A text, as it is.
  Field(const char* text) : text_(text) {}
  /// The shortest decimal that reads as the same number.
  Field(double value);
  /// A whole number.
  Field(std::integral auto value) : text_(std::to_string(value)) {}

  const std::string& text() const { return text_; }  ///< as the file has it, without quotes

 private:
  std::string text_;
};

/// A table with named columns, as the CSV files of the results hold it.
class Table {
 public:
  /// Throws std::logic_error when a name is not as Column says or comes twice.
  Table(std::string title, std::vector<Column> columns, std::vector<std::string> notes = {});

  /// Throws std::logic_error when the number of fields is not that of the columns or a text holds a line break.
  void add_row(const std::vector<Field>& fields);

  const std::string& title() const { return title_; }               ///< the first comment line of the file
  const std::vector<std::string>& notes() const { return notes_; }  ///< the further comment lines
  const std::vector<Column>& columns() const { return columns_; }   ///< from left to right
  std::size_t rows() const { return rows_.size(); }                 ///< number of rows
  bool has_column(std::string_view column) const;                   ///< whether a column has this name

  /// The field as it is written; empty where there is nothing.
  /// These three throw std::runtime_error, naming the table and what is wrong, for an unknown column, and number() and
  /// numbers() also for a field that is not a number.
  const std::string& text(std::size_t row, std::string_view column) const;
  /// The field as a number; throws when it is none.
  double number(std::size_t row, std::string_view column) const;
  /// A whole column as numbers; throws when one is none.
  std::vector<double> numbers(std::string_view column) const;

  /// The rows whose field in the column is this text, in their order.
  Table where(std::string_view column, std::string_view text) const;

  /// The different texts of a column, in the order in which they first come.
  std::vector<std::string> distinct(std::string_view column) const;

 private:
  std::size_t index(std::string_view column) const;

  std::string title_;
  std::vector<Column> columns_;
  std::vector<std::string> notes_;
  std::vector<std::vector<std::string>> rows_;
};

/// The table as text, in the form described above.
std::string to_csv(const Table& table);

/// Writes the table; the file appears whole or not at all.
void write_table(const std::filesystem::path& path, const Table& table);

/// Reads a table. Throws std::runtime_error, naming file, line and what is wrong, and where the last line does not end.
Table read_table(const std::filesystem::path& path);

}  // namespace reprise
