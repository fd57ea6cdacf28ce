#include "reprise/io/toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "reprise/io/expression.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/messages.hpp"

namespace reprise {

namespace {

constexpr std::size_t longest_file = 1'000'000;  // bytes

/// A number, or a text that holds an expression.
Evaluated number_of(const toml::node& node) {
  const auto finite = [](double value) {
    return std::isfinite(value) ? Evaluated{value, ""} : Evaluated{std::nullopt, ""};
  };
  if (const auto value = node.value_exact<double>()) return finite(*value);
  if (const auto value = node.value_exact<int64_t>()) return finite(static_cast<double>(*value));
  if (const auto text = node.value_exact<std::string>()) return evaluate(*text);
  return {};
}

/// A value as messages show it: a number or a short text; nothing for the rest.
std::string shown(const toml::node& node) {
  constexpr std::size_t longest = 60;
  if (const auto value = node.value_exact<double>()) return fmt::format(" is {}", *value);
  if (const auto value = node.value_exact<int64_t>()) return fmt::format(" is {}", *value);
  const auto text = node.value_exact<std::string>();
  const bool printable = text && text->size() <= longest &&
                         std::all_of(text->begin(), text->end(), [](char c) { return c >= ' ' && c <= '~'; });
  return printable ? fmt::format(" is '{}'", *text) : "";
}

/// "what is 3, but must be ...".
std::string rejection(const std::string& what, const toml::node& node, const std::string& must_be) {
  const std::string value = shown(node);
  return fmt::format("{}{}{} must be {}", what, value, value.empty() ? "" : ", but", must_be);
}

/// The same for a number: what its expression is worth, or why it cannot be read.
std::string number_rejection(const std::string& what, const toml::node& node, const NumberRange& range) {
  const std::string allowed = range.description();
  if (!node.is_string()) return rejection(what, node, allowed);
  const Evaluated evaluated = number_of(node);
  if (evaluated.value) {
    return fmt::format("{}{}, which is {}, but must be {}", what, shown(node), *evaluated.value, allowed);
  }
  const std::string value = shown(node);
  return fmt::format("{}{}{}, but must be {} (an expression may have {})", what,
                     value.empty() ? " is a text that " : value + ", which ", evaluated.trouble, allowed,
                     expression_parts);
}

/// A list of items, as messages say it: "a list of 2 numbers".
std::string list_of(std::size_t size, const char* items) {
  return size == 0 ? fmt::format("a list of {}", items) : fmt::format("a list of {} {}", size, items);
}

}  // namespace

TomlSection::TomlSection(std::filesystem::path file, const toml::table& table, std::string name)
    : file_(std::move(file)), table_(table), name_(std::move(name)) {}

void TomlSection::fail(const toml::node& node, const std::string& what) const {
  const bool sentence = what.ends_with('.');
  throw InputError(fmt::format("{}, line {}: {}{}", file_.string(),
                               std::max<toml::source_index>(node.source().begin.line, 1), what, sentence ? "" : "."));
}

void TomlSection::reject(const std::string& key, const std::string& must_be) const {
  const toml::node& node = *table_.get(key);
  fail(node, rejection(path_of(key), node, must_be));
}

void TomlSection::allow_only(const std::vector<std::string>& keys) const {
  for (const auto& [key, node] : table_) {
    const std::string word(key.str());
    if (std::find(keys.begin(), keys.end(), word) != keys.end()) continue;
    const std::string suggestion = did_you_mean(word, keys);
    fail(node, fmt::format("{} has an unknown key '{}' ({}).", name_.empty() ? "the file" : name_, word,
                           suggestion.empty() ? fmt::format("known are {}", fmt::join(keys, ", ")) : suggestion));
  }
}

const toml::node& TomlSection::need(const std::string& key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) fail(table_, fmt::format("{} has no key '{}'.", name_.empty() ? "the file" : name_, key));
  return *node;
}

double TomlSection::number(const std::string& key, const NumberRange& range) const {
  const toml::node& node = need(key);
  const auto value = number_of(node).value;
  if (!value || !range.contains(*value)) fail(node, number_rejection(path_of(key), node, range));
  return *value;
}

double TomlSection::number_or(const std::string& key, double standard, const NumberRange& range) const {
  return has(key) ? number(key, range) : standard;
}

std::string TomlSection::text(const std::string& key) const {
  const auto value = need(key).value_exact<std::string>();
  if (!value) reject(key, "a text");
  return *value;
}

std::string TomlSection::text_or(const std::string& key, const std::string& standard) const {
  return has(key) ? text(key) : standard;
}

std::vector<double> TomlSection::numbers(const std::string& key, std::size_t size, const NumberRange& range) const {
  return numbers(need(key), path_of(key), size, range);
}

std::vector<double> TomlSection::numbers(const toml::node& node, const std::string& name, std::size_t size,
                                         const NumberRange& range) const {
  const toml::array* array = node.as_array();
  if (array == nullptr || (size != 0 && array->size() != size)) {
    fail(node, fmt::format("{} must be {}.", name, list_of(size, "numbers")));
  }
  std::vector<double> values;
  for (const toml::node& item : *array) {
    const auto value = number_of(item).value;
    if (!value || !range.contains(*value)) {
      fail(item,
           fmt::format("{} must be {}; {}.", name, list_of(size, "numbers"), number_rejection("one", item, range)));
    }
    values.push_back(*value);
  }
  return values;
}

std::vector<std::array<double, 2>> TomlSection::pairs(const std::string& key, std::size_t size,
                                                      const NumberRange& range) const {
  const toml::array* array = need(key).as_array();
  if (array == nullptr || (size != 0 && array->size() != size)) reject(key, list_of(size, "pairs of numbers"));
  std::vector<std::array<double, 2>> values;
  for (const toml::node& pair : *array) {
    const std::vector<double> read = numbers(pair, "each item of " + path_of(key), 2, range);
    values.push_back({read[0], read[1]});
  }
  return values;
}

std::vector<std::string> TomlSection::texts(const std::string& key) const {
  const toml::array* array = need(key).as_array();
  if (array == nullptr) reject(key, "a list of texts");
  std::vector<std::string> values;
  for (const toml::node& item : *array) {
    const auto value = item.value_exact<std::string>();
    if (!value) reject(key, "a list of texts");
    values.push_back(*value);
  }
  return values;
}

TomlSection TomlSection::section(const std::string& key) const {
  const toml::table* table = need(key).as_table();
  if (table == nullptr) reject(key, "a table");
  return {file_, *table, path_of(key)};
}

std::vector<TomlSection> TomlSection::sections(const std::string& key) const {
  const toml::array* array = need(key).as_array();
  if (array == nullptr || array->empty())
    reject(key, fmt::format("a list of tables, each of them a [[{}]]", path_of(key)));
  std::vector<TomlSection> all;
  for (const toml::node& item : *array) {
    if (!item.is_table()) fail(item, fmt::format("{} must be a list of tables.", path_of(key)));
    all.emplace_back(file_, *item.as_table(), fmt::format("{} {}", path_of(key), all.size() + 1));
  }
  return all;
}

toml::table parse_toml(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) {
    throw InputError(fmt::format("{} is a folder, but must be a file.", file.string()));
  }
  const std::string content = [&] {
    try {
      return read_file(file, longest_file);
    } catch (const std::runtime_error& error) {
      throw InputError(error.what());
    }
  }();
  if (content.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(fmt::format("{}, line 1: the file is empty.", file.string()));
  }
  try {
    return toml::parse(content, file.string());
  } catch (const toml::parse_error& error) {
    // Descriptions end with a full stop or without, and may show a line break of the file.
    std::string description = on_one_line(std::string(error.description()));
    if (!description.ends_with('.')) description += '.';
    throw InputError(fmt::format("{}, line {}: {}", file.string(), error.source().begin.line, description));
  }
}

}  // namespace reprise
