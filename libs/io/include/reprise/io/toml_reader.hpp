#pragma once

// TOML files whose every value is checked, with one sentence for everything that can be wrong with them: file, line,
// key, and what is allowed.

#include <toml++/toml.h>

#include <array>
#include <concepts>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "reprise/io/number_range.hpp"

namespace reprise {

/// Something wrong in a file; what() is one sentence that names file, line, key and what is allowed.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One table of a file. It knows where it stands.
/// Numbers are never NaN or infinite; any of them may be written as a text that holds an expression, "10*sqrt(3)/3"
/// (see expression.hpp).
class TomlSection {
 public:
  /// The tables must outlive the section. Messages call it by `name`; the whole file has an empty one.
  TomlSection(std::filesystem::path file, const toml::table& table, std::string name = "");

  /// Throws InputError for something that is wrong at a node.
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const;
  /// The same where the value of a key is wrong: "line 3: leg 2.length must be ...".
  [[noreturn]] void reject(const std::string& key, const std::string& must_be) const;

  /// Throws InputError where the table has a key that is none of these, and says which of them it is like. To be called
  /// before anything is read, so that a misspelt key is not answered by one that is missing.
  void allow_only(const std::vector<std::string>& keys) const;

  bool has(const std::string& key) const { return table_.contains(key); }  ///< whether the key is there
  const toml::table& table() const { return table_; }                      ///< what it reads from
  const std::string& name() const { return name_; }                        ///< as messages call it
  const std::filesystem::path& file() const { return file_; }              ///< where it stands

  /// These throw InputError when the key is not there, or its value is of another kind or out of its range.
  const toml::node& need(const std::string& key) const;
  /// A number of this range.
  double number(const std::string& key, const NumberRange& range = NumberRange::any()) const;
  /// The number, or the standard where the key is not there.
  double number_or(const std::string& key, double standard, const NumberRange& range = NumberRange::any()) const;
  /// A text.
  std::string text(const std::string& key) const;
  /// The text, or the standard where the key is not there.
  std::string text_or(const std::string& key, const std::string& standard) const;
  /// An array of numbers; of any length when `size` is 0.
  std::vector<double> numbers(const std::string& key, std::size_t size = 0,
                              const NumberRange& range = NumberRange::any()) const;
  /// An array of arrays of two numbers each; of any length when `size` is 0.
  std::vector<std::array<double, 2>> pairs(const std::string& key, std::size_t size = 0,
                                           const NumberRange& range = NumberRange::any()) const;
  /// An array of texts.
  std::vector<std::string> texts(const std::string& key) const;
  /// A table, which messages call "<this name>.<key>".
  TomlSection section(const std::string& key) const;
  /// The tables of an array of tables; messages call them "<name>.<key> 1" and so on.
  std::vector<TomlSection> sections(const std::string& key) const;

  /// What the libraries reject becomes an error of this section.
  template <std::invocable Make>
  auto make(const Make& function) const {
    try {
      return function();
    } catch (const std::invalid_argument& error) {
      fail(table_, error.what());
    }
  }

 private:
  std::string path_of(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }
  std::vector<double> numbers(const toml::node& node, const std::string& name, std::size_t size,
                              const NumberRange& range) const;

  std::filesystem::path file_;
  const toml::table& table_;
  std::string name_;
};

/// The content of a file as TOML. Throws InputError when it cannot be read, is empty, longer than a megabyte, or not
/// TOML.
toml::table parse_toml(const std::filesystem::path& file);

}  // namespace reprise
