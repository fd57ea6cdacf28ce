#include "reprise/io/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "reprise/io/messages.hpp"

namespace reprise {

namespace {

template <typename Number>
std::optional<Number> parse_number(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',', begin)) {
    parts.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

[[noreturn]] void reject(const std::string& name, const std::string& text, const std::string& allowed) {
  throw UsageError(fmt::format("{} is '{}', but must be {}.", name, text, allowed));
}

[[noreturn]] void reject_choice(const std::string& name, const std::string& text, const std::string& sentence,
                                const std::vector<std::string>& allowed) {
  const std::string suggestion = did_you_mean(text, allowed);
  reject(name, text, suggestion.empty() ? sentence : sentence + " (" + suggestion + ")");
}

double number_in(const std::string& name, const std::string& text, const NumberRange& range) {
  const std::optional<double> value = parse_number<double>(text);
  if (!value || !range.contains(*value)) reject(name, text, range.description());
  return *value;
}

template <typename Values>
void reject_repeats(const std::string& name, const std::string& text, Values values) {
  std::sort(values.begin(), values.end());
  if (std::adjacent_find(values.begin(), values.end()) != values.end()) reject(name, text, "a list without repeats");
}

}  // namespace

struct CommandLine::Implementation {
  struct Entry {
    CLI::Option* option;
    std::string allowed;
    /// Checks the texts now; what it returns sets the variable.
    std::function<std::function<void()>(const std::vector<std::string>& texts)> read;
    std::function<nlohmann::json()> value;
    std::vector<std::string> choices = {};
    bool is_path = false;
    std::string takes = {};  ///< of a tuple: "2 numbers, X Y (position)"
    std::size_t size = 0;    ///< of a tuple
  };

  CLI::App app;
  std::vector<Entry> entries;

  Implementation(const std::string& program, const std::string& description) : app(description, program) {}

  Entry& add(const std::string& name, const std::string& help, const std::string& type, const std::string& standard,
             const std::string& allowed, std::function<std::function<void()>(const std::string&)> read,
             std::function<nlohmann::json()> value) {
    // CLI11 only splits the command line; the texts are read by us, so that every error is one sentence of one kind.
    CLI::Option* option = app.add_option(name, help)->type_name(type)->default_str(standard)->expected(1);
    entries.push_back({option, allowed, [read = std::move(read)](const auto& texts) { return read(texts.back()); },
                       std::move(value)});
    return entries.back();
  }

  /// How often an option stands in a command line.
  static std::size_t times(const std::string& name, const std::vector<std::string>& words) {
    return static_cast<std::size_t>(std::count_if(words.begin(), words.end(), [&](const std::string& word) {
      return word == name || word.starts_with(name + "=");
    }));
  }

  /// How many numbers follow the first mention of an option.
  static std::size_t numbers_after(const std::string& name, const std::vector<std::string>& words) {
    std::size_t count = 0;
    bool within = false;
    for (const std::string& word : words) {
      if (!within) {
        const bool joined = word.starts_with(name + "=");
        within = joined || word == name;
        count += joined ? 1 : 0;
      } else if (parse_number<double>(word)) {
        ++count;
      } else {
        break;
      }
    }
    return count;
  }

  /// What is wrong with a command line that CLI11 refuses. Its own messages name neither the values that are allowed
  /// nor the option that a number too many belongs to.
  std::string reason(const CLI::ParseError& error, const std::vector<std::string>& words) const {
    for (const Entry& entry : entries) {
      const std::string name = entry.option->get_name();
      const std::size_t mentions = entry.option->get_positional() ? 1 : times(name, words);
      if (mentions > 1) return fmt::format("{} is given {} times, but must be given once.", name, mentions);
      if (entry.size == 0 || mentions == 0) continue;
      const std::size_t given = numbers_after(name, words);
      if (given == entry.size) continue;
      return fmt::format("{} takes {}, but {} {} given.", name, entry.takes, given, given == 1 ? "was" : "were");
    }
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
      const std::vector<std::string> extras = app.remaining();
      const std::string word = extras.empty() ? error.what() : extras.front();
      if (!word.starts_with("-")) {
        return fmt::format("the argument '{}' is not expected; --help lists what is.", word);
      }
      std::vector<std::string> names{"--help"};
      for (const Entry& entry : entries) names.push_back(entry.option->get_name());
      const std::string suggestion = did_you_mean(word, names);
      return fmt::format("there is no option '{}'{}; --help lists the options.", word,
                         suggestion.empty() ? "" : " (" + suggestion + ")");
    }
    // The message of CLI11 begins with the name of the option, that of a flag without its dashes.
    const std::string message = error.what();
    const std::string name = message.substr(0, message.find_first_of(": ="));
    for (const Entry& entry : entries) {
      const std::string own = entry.option->get_name();
      if (own != name && own != "--" + name) continue;
      if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
        return fmt::format("{} is missing; it must be {}.", own, entry.allowed);
      }
      if (entry.size > 0) {
        // All its numbers are there: CLI11 kept the last one for a file that is missing.
        for (const Entry& file : entries) {
          if (file.option->get_positional()) {
            return fmt::format("{} is missing; it must be {}.", file.option->get_name(), file.allowed);
          }
        }
      }
      if (entry.option->get_expected_max() == 0) return fmt::format("{} takes no value, but one was given.", own);
      return fmt::format("{} has no value, but must be {}.", own, entry.allowed);
    }
    return fmt::format("the options are wrong: {}.", message);
  }
};

CommandLine::CommandLine(const std::string& program, const std::string& description)
    : implementation_(std::make_unique<Implementation>(program, description)) {
  implementation_->app.set_help_flag("--help", "print this help and exit");
}

CommandLine::~CommandLine() = default;

void CommandLine::flag(const std::string& name, bool& value, const std::string& help) {
  CLI::Option* option = implementation_->app.add_flag(name, help)->disable_flag_override();
  implementation_->entries.push_back({option, "given alone, without a value",
                                      [&value](const auto&) { return [&value] { value = true; }; },
                                      [&value] { return nlohmann::json(value); }});
}

void CommandLine::number(const std::string& name, double& value, const NumberRange& range, const std::string& help) {
  implementation_->add(
      name, help, "NUMBER", fmt::format("{}", value), range.description(),
      [=, &value](const std::string& text) -> std::function<void()> {
        const double read = number_in(name, text, range);
        return [&value, read] { value = read; };
      },
      [&value] { return nlohmann::json(value); });
}

void CommandLine::number(const std::string& name, std::optional<double>& value, const NumberRange& range,
                         const std::string& help) {
  implementation_->add(
      name, help, "NUMBER", "", range.description(),
      [=, &value](const std::string& text) -> std::function<void()> {
        const double read = number_in(name, text, range);
        return [&value, read] { value = read; };
      },
      [&value] { return value ? nlohmann::json(*value) : nlohmann::json(); });
}

void CommandLine::tuple(const std::string& name, std::vector<double>& values, const std::string& words,
                        const NumberRange& range, const std::string& help) {
  const auto count = static_cast<int>(std::count(words.begin(), words.end(), ' ')) + 1;
  const std::string takes = fmt::format("{} numbers, {} ({})", count, words, help);
  CLI::Option* option = implementation_->app.add_option(name, help)->expected(count)->option_text(words);
  if (values.empty()) option->required()->option_text(words + " (must be given)");
  implementation_->entries.push_back({option, fmt::format("{}, each of them {}", takes, range.description()),
                                      [=, &values](const std::vector<std::string>& texts) -> std::function<void()> {
                                        std::vector<double> read;
                                        for (const std::string& text : texts)
                                          read.push_back(number_in(name, text, range));
                                        return [&values, read] { values = read; };
                                      },
                                      [&values] { return nlohmann::json(values); }});
  implementation_->entries.back().takes = takes;
  implementation_->entries.back().size = static_cast<std::size_t>(count);
}

void CommandLine::text(const std::string& name, std::string& value, const std::string& word, const std::string& help) {
  implementation_->add(
      name, help, word, value, word,
      [=, &value](const std::string& text) -> std::function<void()> {
        if (text.empty()) reject(name, text, word);
        return [&value, text] { value = text; };
      },
      [&value] { return nlohmann::json(value); });
}

void CommandLine::file(const std::string& word, std::filesystem::path& value, const std::string& help, bool required) {
  implementation_
      ->add(
          word, help, "", "", "the name of a file",
          [=, &value](const std::string& text) -> std::function<void()> {
            if (text.empty()) reject(word, text, "the name of a file");
            return [&value, text] { value = text; };
          },
          [&value] { return nlohmann::json(value.string()); })
      .is_path = true;
  implementation_->entries.back().option->required(required)->option_text(" ");
}

void CommandLine::footer(const std::string& text) { implementation_->app.footer(text); }

void CommandLine::integer(const std::string& name, long& value, long least, long most, const std::string& help) {
  const std::string allowed = most == std::numeric_limits<long>::max()
                                  ? fmt::format("a whole number of at least {}", least)
                                  : fmt::format("a whole number from {} to {}", least, most);
  implementation_->add(
      name, help, "INTEGER", fmt::format("{}", value), allowed,
      [=, &value](const std::string& text) -> std::function<void()> {
        const std::optional<long> read = parse_number<long>(text);
        if (!read || *read < least || *read > most) reject(name, text, allowed);
        return [&value, number = *read] { value = number; };
      },
      [&value] { return nlohmann::json(value); });
}

void CommandLine::path(const std::string& name, std::filesystem::path& value, const std::string& help) {
  const std::string allowed = "the name of a file or folder";
  implementation_
      ->add(
          name, help, "PATH", value.string(), allowed,
          [=, &value](const std::string& text) -> std::function<void()> {
            if (text.empty()) reject(name, text, allowed);
            return [&value, text] { value = text; };
          },
          [&value] { return nlohmann::json(value.string()); })
      .is_path = true;
}

void CommandLine::choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
                         const std::string& help) {
  const std::string sentence = fmt::format("one of {}", fmt::join(allowed, ", "));
  implementation_
      ->add(
          name, help, fmt::format("{}", fmt::join(allowed, "|")), value, sentence,
          [=, &value](const std::string& text) -> std::function<void()> {
            if (std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
              reject_choice(name, text, sentence, allowed);
            }
            return [&value, text] { value = text; };
          },
          [&value] { return nlohmann::json(value); })
      .choices = allowed;
}

void CommandLine::numbers(const std::string& name, std::vector<double>& values, const NumberRange& range,
                          const std::string& help) {
  implementation_->add(
      name, help, "NUMBER,...", fmt::format("{}", fmt::join(values, ",")), range.description(),
      [=, &values](const std::string& text) -> std::function<void()> {
        std::vector<double> read;
        for (const std::string& part : split(text)) read.push_back(number_in(name, part, range));
        reject_repeats(name, text, read);
        return [&values, read] { values = read; };
      },
      [&values] { return nlohmann::json(values); });
}

void CommandLine::choices(const std::string& name, std::vector<std::string>& values,
                          const std::vector<std::string>& allowed, const std::string& help) {
  const std::string sentence = fmt::format("one or more of {}, separated by commas", fmt::join(allowed, ", "));
  implementation_
      ->add(
          name, help, fmt::format("{},...", fmt::join(allowed, "|")), fmt::format("{}", fmt::join(values, ",")),
          sentence,
          [=, &values](const std::string& text) -> std::function<void()> {
            const std::vector<std::string> read = split(text);
            for (const std::string& part : read) {
              if (std::find(allowed.begin(), allowed.end(), part) == allowed.end()) {
                reject_choice(name, part, sentence, allowed);
              }
            }
            reject_repeats(name, text, read);
            return [&values, read] { values = read; };
          },
          [&values] { return nlohmann::json(values); })
      .choices = allowed;
}

bool CommandLine::parse(int argc, const char* const* argv) {
  try {
    implementation_->app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return false;
  } catch (const CLI::ParseError& error) {
    throw UsageError(implementation_->reason(error, {argv + 1, argv + argc}));
  }

  std::vector<std::function<void()>> assignments;
  for (const Implementation::Entry& entry : implementation_->entries) {
    if (entry.option->count() > 0) assignments.push_back(entry.read(entry.option->results()));
  }
  for (const std::function<void()>& assign : assignments) assign();
  return true;
}

std::string CommandLine::help() const { return implementation_->app.help(); }

std::vector<OptionSummary> CommandLine::summaries() const {
  std::vector<OptionSummary> summaries;
  for (const Implementation::Entry& entry : implementation_->entries) {
    const std::string name = entry.option->get_positional() ? "" : entry.option->get_name();
    summaries.push_back({name, entry.choices, entry.option->get_expected_max() > 0, entry.is_path});
  }
  summaries.push_back({"--help", {}, false, false});
  return summaries;
}

std::vector<std::pair<std::string, std::string>> CommandLine::values() const {
  std::vector<std::pair<std::string, std::string>> values;
  for (const Implementation::Entry& entry : implementation_->entries) {
    values.emplace_back(entry.option->get_name(), entry.value().dump());
  }
  return values;
}

}  // namespace reprise
