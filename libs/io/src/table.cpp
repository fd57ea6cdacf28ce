#include "reprise/io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

#include "reprise/io/files.hpp"

namespace reprise {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_name(std::string_view text) {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

bool is_one_line(std::string_view text) { return text.find_first_of("\r\n") == std::string_view::npos; }

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos && !text.starts_with('#')) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

/// The fields of one line, or nothing when a quote is not closed or followed by anything but a comma.
std::optional<std::vector<std::string>> split_line(std::string_view line) {
  std::vector<std::string> fields;
  std::size_t i = 0;
  while (true) {
    std::string field;
    if (i < line.size() && line[i] == '"') {
      for (++i;; ++i) {
        if (i == line.size()) return std::nullopt;
        if (line[i] == '"') {
          if (i + 1 == line.size() || line[i + 1] != '"') break;
          ++i;
        }
        field += line[i];
      }
      ++i;
      if (i < line.size() && line[i] != ',') return std::nullopt;
    } else {
      const std::size_t end = std::min(line.find(',', i), line.size());
      field = line.substr(i, end - i);
      i = end;
    }
    fields.push_back(std::move(field));
    if (i == line.size()) return fields;
    ++i;
  }
}

/// "name [unit]: meaning", or nothing.
std::optional<Column> parse_column(const std::string& comment) {
  const std::size_t open = comment.find(" [");
  const std::size_t close = comment.find("]: ", open);
  if (open == std::string::npos || close == std::string::npos || !is_name(comment.substr(0, open))) return std::nullopt;
  return Column{comment.substr(0, open), comment.substr(open + 2, close - open - 2), comment.substr(close + 3)};
}

}  // namespace

Field::Field(double value) : text_(fmt::format("{}", value == 0.0 ? 0.0 : value)) {}  // no -0

Table::Table(std::string title, std::vector<Column> columns, std::vector<std::string> notes)
    : title_(std::move(title)), columns_(std::move(columns)), notes_(std::move(notes)) {
  bool one_line = is_one_line(title_) && std::all_of(notes_.begin(), notes_.end(), is_one_line);
  for (auto column = columns_.begin(); column != columns_.end(); ++column) {
    if (!is_name(column->name)) {
      throw std::logic_error(fmt::format("table '{}': '{}' is not a column name.", title_, column->name));
    }
    if (std::any_of(columns_.begin(), column, [&](const Column& other) { return other.name == column->name; })) {
      throw std::logic_error(fmt::format("table '{}': column {} comes twice.", title_, column->name));
    }
    one_line = one_line && is_one_line(column->unit) && is_one_line(column->meaning);
  }
  if (!one_line) throw std::logic_error(fmt::format("table '{}': a text holds a line break.", title_));
}

void Table::add_row(const std::vector<Field>& fields) {
  if (fields.size() != columns_.size()) {
    throw std::logic_error(fmt::format("table '{}': a row has {} fields, but there are {} columns.", title_,
                                       fields.size(), columns_.size()));
  }
  std::vector<std::string> row;
  for (const Field& field : fields) {
    if (!is_one_line(field.text()))
      throw std::logic_error(fmt::format("table '{}': a text holds a line break.", title_));
    row.push_back(field.text());
  }
  rows_.push_back(std::move(row));
}

bool Table::has_column(std::string_view column) const {
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column& other) { return other.name == column; });
}

std::size_t Table::index(std::string_view column) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name == column) return i;
  }
  throw std::runtime_error(fmt::format("table '{}' has no column '{}'.", title_, column));
}

const std::string& Table::text(std::size_t row, std::string_view column) const {
  if (row >= rows_.size()) {
    throw std::runtime_error(fmt::format("table '{}' has {} rows; there is no row {}.", title_, rows_.size(), row));
  }
  return rows_[row][index(column)];
}

double Table::number(std::size_t row, std::string_view column) const {
  const std::string& field = text(row, column);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || stop != field.data() + field.size()) {
    throw std::runtime_error(
        fmt::format("table '{}', column {}, row {}: '{}' is not a number.", title_, column, row, field));
  }
  return value;
}

std::vector<double> Table::numbers(std::string_view column) const {
  std::vector<double> values;
  for (std::size_t row = 0; row < rows_.size(); ++row) values.push_back(number(row, column));
  return values;
}

Table Table::where(std::string_view column, std::string_view text) const {
  const std::size_t i = index(column);
  Table result(title_, columns_, notes_);
  std::copy_if(rows_.begin(), rows_.end(), std::back_inserter(result.rows_),
               [&](const std::vector<std::string>& row) { return row[i] == text; });
  return result;
}

std::vector<std::string> Table::distinct(std::string_view column) const {
  const std::size_t i = index(column);
  std::vector<std::string> texts;
  for (const std::vector<std::string>& row : rows_) {
    if (std::find(texts.begin(), texts.end(), row[i]) == texts.end()) texts.push_back(row[i]);
  }
  return texts;
}

std::string to_csv(const Table& table) {
  std::string csv = fmt::format("# {}\n", table.title());
  for (const std::string& note : table.notes()) csv += fmt::format("# {}\n", note);
  for (const Column& column : table.columns()) {
    csv += fmt::format("# {} [{}]: {}\n", column.name, column.unit, column.meaning);
  }
  const auto append = [&csv, first = true](const std::string& field) mutable {
    csv += (std::exchange(first, false) ? "" : ",") + field;
  };
  auto append_name = append;
  for (const Column& column : table.columns()) append_name(column.name);
  csv += '\n';
  for (std::size_t row = 0; row < table.rows(); ++row) {
    auto append_field = append;
    for (const Column& column : table.columns()) append_field(quoted(table.text(row, column.name)));
    csv += '\n';
  }
  return csv;
}

void write_table(const std::filesystem::path& path, const Table& table) { write_file(path, to_csv(table)); }

Table read_table(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  if (!content.empty() && !content.ends_with('\n')) {
    throw std::runtime_error(fmt::format("{} is cut off: its last line has no end.", path.string()));
  }
  std::vector<std::string> comments;
  std::optional<Table> table;
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    ++line_number;
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    std::string line = content.substr(begin, end - begin);
    begin = end + 1;
    if (line.ends_with('\r')) line.pop_back();
    if (line.starts_with('#')) {
      comments.push_back(line.substr(line.starts_with("# ") ? 2 : 1));
      continue;
    }
    const auto fields = split_line(line);
    if (!fields) {
      throw std::runtime_error(fmt::format("{}, line {}: a quote is not closed.", path.string(), line_number));
    }
    if (table) {
      if (fields->size() != table->columns().size()) {
        throw std::runtime_error(fmt::format("{}, line {}: there are {} fields, but {} columns.", path.string(),
                                             line_number, fields->size(), table->columns().size()));
      }
      table->add_row(std::vector<Field>(fields->begin(), fields->end()));
      continue;
    }
    std::vector<Column> columns;
    for (const std::string& name : *fields) columns.push_back({name, "", ""});
    std::vector<std::string> notes;
    for (std::size_t i = 1; i < comments.size(); ++i) {
      const std::optional<Column> described = parse_column(comments[i]);
      const auto column = std::find_if(columns.begin(), columns.end(), [&](const Column& candidate) {
        return described && candidate.name == described->name;
      });
      if (column == columns.end()) {
        notes.push_back(comments[i]);
      } else {
        *column = *described;
      }
    }
    try {
      table.emplace(comments.empty() ? path.stem().string() : comments.front(), columns, notes);
    } catch (const std::logic_error& error) {
      throw std::runtime_error(fmt::format("{}, line {}: {}", path.string(), line_number, error.what()));
    }
  }
  if (!table) throw std::runtime_error(fmt::format("{} has no line of column names.", path.string()));
  return *std::move(table);
}

}  // namespace reprise
