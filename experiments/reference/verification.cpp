#include "reference/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>

namespace reprise::experiments {
namespace {

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

/// The keys of a row as "workspace=P1 optimizer=slsqp".
std::string label(const Check& check, const Table& table, std::size_t row) {
  std::string text;
  for (const std::string& key : check.keys) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, table.text(row, key));
  }
  return text;
}

/// The rows of a table by their keys. Throws std::runtime_error when two have the same.
std::map<std::string, std::size_t> rows_by_label(const Check& check, const Table& table) {
  std::map<std::string, std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!rows.emplace(label(check, table, row), row).second) {
      throw std::runtime_error(
          fmt::format("the check {} finds two rows with {}.", check.reference, label(check, table, row)));
    }
  }
  return rows;
}

struct Compared {
  Field difference;
  Field allowed;
  std::string verdict;
};

Compared compare(const std::string& value, const std::string& stored, double tolerance) {
  if (value == stored) return {{}, {}, "same"};
  char* value_end = nullptr;
  char* stored_end = nullptr;
  const double number = std::strtod(value.c_str(), &value_end);
  const double reference = std::strtod(stored.c_str(), &stored_end);
  const bool numbers = !value.empty() && *value_end == '\0' && !stored.empty() && *stored_end == '\0';
  if (!numbers) return {{}, {}, "differs"};
  if (!std::isfinite(number)) return {{}, {}, "not a number"};
  const double difference = number - reference;
  const double allowed = tolerance * std::max(1.0, std::abs(reference));
  return {difference, allowed, std::abs(difference) <= allowed ? "within" : "differs"};
}

}  // namespace

std::vector<Check> read_checks(const std::filesystem::path& file) {
  const Table table = read_table(file);
  std::vector<Check> checks;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string name = table.text(row, "reference");
    const auto fail = [&](const std::string& what) {
      throw std::runtime_error(
          fmt::format("{}: {}, column {}: {}", file.string(), name, table.text(row, "column"), what));
    };
    Check check{name, table.text(row, "program"), table.text(row, "part"), {}, words(table.text(row, "keys")), {}};
    for (const std::string& condition : words(table.text(row, "where"))) {
      const std::size_t equals = condition.find('=');
      if (equals == std::string::npos) fail(fmt::format("'{}' is not a condition such as workspace=P1.", condition));
      check.where.emplace_back(condition.substr(0, equals), condition.substr(equals + 1));
    }
    const CheckedColumn column{table.text(row, "column"), table.number(row, "tolerance"), table.text(row, "reason")};
    if (!(column.tolerance >= 0.0) || !std::isfinite(column.tolerance)) {
      fail(fmt::format("the tolerance is {}, but it must be at least 0.", column.tolerance));
    }
    if (column.reason.empty()) fail("the tolerance has no reason.");
    if (checks.empty() || checks.back().reference != name) checks.push_back(check);
    Check& last = checks.back();
    if (last.program != check.program || last.part != check.part || last.where != check.where ||
        last.keys != check.keys) {
      fail("its program, part, where or keys are not those of the row above.");
    }
    last.columns.push_back(column);
  }
  return checks;
}

Table reduce(const Check& check, const Table& result) {
  Table selected = result;
  for (const auto& [column, text] : check.where) selected = selected.where(column, text);
  std::vector<std::string> names = check.keys;
  for (const CheckedColumn& column : check.columns) names.push_back(column.name);
  std::vector<Column> columns;
  for (const std::string& name : names) {
    const auto found = std::find_if(selected.columns().begin(), selected.columns().end(),
                                    [&name](const Column& column) { return column.name == name; });
    if (found == selected.columns().end()) {
      throw std::runtime_error(fmt::format("the check {} looks for the column {}, but the results of {} have none.",
                                           check.reference, name, check.program));
    }
    columns.push_back(*found);
  }
  Table reduced(result.title(), columns);
  for (std::size_t row = 0; row < selected.rows(); ++row) {
    std::vector<Field> fields;
    for (const std::string& name : names) fields.emplace_back(selected.text(row, name));
    reduced.add_row(fields);
  }
  return reduced;
}

Table make_reference_verdicts() {
  return {"Results against the stored ones",
          {{"reference", "-", "name of the reference in data/reference"},
           {"row", "-", "what tells the row apart"},
           {"column", "-", "name of the column"},
           {"value", "-", "the result"},
           {"stored", "-", "the reference"},
           {"difference", "-", "result less reference, where both are numbers that differ"},
           {"allowed", "-", "largest difference allowed"},
           {"verdict", "-", "same, within, differs, not a number, missing (in the result) or not stored"},
           {"reason", "-", "why no smaller difference is demanded"}}};
}

bool is_right(const std::string& verdict) { return verdict == "same" || verdict == "within"; }

Table hold_against(const Check& check, const Table& result, const Table& reference) {
  const Table values = reduce(check, result);
  const Table stored = reduce({check.reference, "data/reference", "", {}, check.keys, check.columns}, reference);
  const auto value_rows = rows_by_label(check, values);
  const auto stored_rows = rows_by_label(check, stored);
  Table verdicts = make_reference_verdicts();
  for (const auto& [name, row] : stored_rows) {
    const auto found = value_rows.find(name);
    for (const CheckedColumn& column : check.columns) {
      const std::string& expected = stored.text(row, column.name);
      if (found == value_rows.end()) {
        verdicts.add_row({check.reference, name, column.name, {}, expected, {}, {}, "missing", column.reason});
        continue;
      }
      const std::string& value = values.text(found->second, column.name);
      const Compared compared = compare(value, expected, column.tolerance);
      verdicts.add_row({check.reference, name, column.name, value, expected, compared.difference, compared.allowed,
                        compared.verdict, column.reason});
    }
  }
  for (const auto& [name, row] : value_rows) {
    if (stored_rows.contains(name)) continue;
    for (const CheckedColumn& column : check.columns) {
      verdicts.add_row(
          {check.reference, name, column.name, values.text(row, column.name), {}, {}, {}, "not stored", column.reason});
    }
  }
  return verdicts;
}

}  // namespace reprise::experiments
