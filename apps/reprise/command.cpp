#include "command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <ostream>
#include <system_error>

#include "help_texts.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/interruption.hpp"
#include "reprise/io/messages.hpp"
#include "reprise/io/toml_reader.hpp"

namespace reprise::app {

namespace {

std::string describe(const std::string& summary, const std::string& description) {
  return summary + ".\n\n" + description;
}

std::string indented(const std::string& lines) {
  std::string text = "  ";
  for (const char c : lines) text += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return text;
}

/// Whether a zero has a sign is a matter of rounding: -0 becomes 0.
void unsign_zeros(Json& value) {
  if (value.is_number_float() && value.get<double>() == 0.0) value = 0.0;
  if (!value.is_structured()) return;
  for (Json& item : value) unsign_zeros(item);
}

/// Throws where what was printed has not reached its reader.
void flush(std::ostream& out) {
  errno = 0;
  out.flush();
  if (out) return;
  throw std::runtime_error(errno == 0 ? "cannot write to standard output."
                                      : fmt::format("cannot write to standard output: {}.",
                                                    std::error_code(errno, std::generic_category()).message()));
}

std::string overview() {
  std::string text =
      "Workspaces and dimensional synthesis of planar parallel manipulators.\n\n"
      "Usage: reprise COMMAND FILE [OPTIONS]\n\nCommands:\n";
  for (const auto& command : all_commands()) text += fmt::format("  {:<14}{}\n", command->name(), command->summary());
  return text +
         "\nreprise COMMAND --help   the options of a command, with examples\n"
         "reprise help input       the format of manipulator and problem files\n"
         "reprise help json        the documents that --json prints\n"
         "reprise completion bash  a script that completes command lines (bash, zsh or fish)\n"
         "reprise --version        the version\n\n"
         "Angles are in degrees, lengths in the unit of the file. Exit code: 0 for a result, 2 for wrong options or a\n"
         "wrong file, 130 for the best result so far after Ctrl-C, 1 for any other failure.\n";
}

}  // namespace

Command::Command(std::string name, std::string summary, const std::string& description, const std::string& examples,
                 const std::string& file, bool file_required)
    : name_(std::move(name)),
      summary_(std::move(summary)),
      options_("reprise " + name_, describe(summary_, description)) {
  options_.file("FILE", file_, file, file_required);
  options_.flag("--json", json_, "print one JSON document instead of text (see: reprise help json)");
  options_.footer("Examples:\n" + indented(examples));
}

void Command::draws() {
  options_.path(
      "--plot", plot_,
      fmt::format("draw a picture; its kind is that of the extension: {}", fmt::join(Figure::extensions(), ", ")));
}

void Command::writes_files(const std::vector<std::string>& names) {
  out_names_ = names;
  options_.path("--out", out_,
                fmt::format("folder for everything computed, made when it is not there: {}", fmt::join(names, ", ")));
}

void Command::check_targets() const {
  const auto refuse = [](const char* option, const std::filesystem::path& path, const std::string& reason) {
    throw UsageError(fmt::format("{} is '{}', but {}.", option, path.string(), reason));
  };
  const auto is_input = [&](const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::equivalent(path, file_, error) && !error;
  };
  if (!plot_.empty()) {
    const std::vector<std::string>& extensions = Figure::extensions();
    if (std::find(extensions.begin(), extensions.end(), plot_.extension().string()) == extensions.end()) {
      throw UsageError(fmt::format("--plot is '{}', but must be a file name that ends in {}.", plot_.string(),
                                   fmt::join(extensions, ", ")));
    }
    if (is_input(plot_)) refuse("--plot", plot_, "that is the input");
    if (const std::string obstacle = obstacle_to_file(plot_); !obstacle.empty()) {
      refuse("--plot", plot_, obstacle);
    }
  }
  if (out_.empty()) return;
  if (const std::string obstacle = obstacle_to_folder(out_); !obstacle.empty()) {
    refuse("--out", out_, obstacle);
  }
  if (!std::filesystem::is_directory(out_)) return;
  for (const std::string& name : out_names_) {
    if (is_input(out_ / name)) refuse("--out", out_, fmt::format("its {} is the input", name));
    if (const std::string obstacle = obstacle_to_file(out_ / name); !obstacle.empty()) {
      refuse("--out", out_, fmt::format("{} in it cannot be written: {}", name, obstacle));
    }
  }
}

void Command::write_files(const Output& output) const {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [name, table] : output.tables) files.emplace_back(name + ".csv", to_csv(table));
  files.insert(files.end(), output.files.begin(), output.files.end());
  for (const auto& file : files) {
    if (std::find(out_names_.begin(), out_names_.end(), file.first) == out_names_.end()) {
      throw std::logic_error(fmt::format("'{}' is not among the files that {} says it writes", file.first, name_));
    }
  }
  reprise::write_files(out_, files);
}

int Command::run(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  if (!options_.parse(argc, argv)) {
    out << options_.help();
    return 0;
  }
  check_targets();
  const Output output = compute();

  std::vector<std::string> refusals;
  const auto attempt = [&](const std::function<void()>& step) {
    try {
      step();
    } catch (const std::exception& error) {
      refusals.emplace_back(error.what());
    }
  };
  attempt([&] {
    if (json_) {
      Json document{{"schema", schema},
                    {"command", name_},
                    {"file", file_.string()},
                    {"unit", output.unit.empty() ? Json() : Json(output.unit)}};
      document.update(output.document);
      unsign_zeros(document);
      // Names may hold any bytes; a document is UTF-8.
      out << document.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    } else {
      out << output.text;
    }
    flush(out);
  });
  if (!out_.empty()) {
    attempt([&] {
      if (make_folder(out_)) err << "reprise " << name_ << ": made the folder " << out_.string() << ".\n";
      write_files(output);
    });
  }
  if (!plot_.empty()) attempt([&] { output.picture().write(plot_); });
  if (!refusals.empty()) throw std::runtime_error(fmt::format("{}", fmt::join(refusals, " ")));
  return interrupted() ? interruption_exit_code() : output.exit_code;
}

std::vector<std::unique_ptr<Command>> all_commands() {
  std::vector<std::unique_ptr<Command>> all;
  for (auto& group : {pose_commands, workspace_commands, conditioning_commands, synthesis_commands, sweep_commands}) {
    for (auto& command : group()) all.push_back(std::move(command));
  }
  return all;
}

int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  const std::string word = argc > 1 ? argv[1] : "";
  const auto fail = [&](int failure, const std::string& where, std::string sentence) {
    if (!sentence.ends_with('.')) sentence += '.';
    // Names of files, and words of the command line, may hold line breaks.
    err << on_one_line(where + ": " + sentence) << '\n';
    return failure;
  };
  const std::string second = argc > 2 ? argv[2] : "";
  std::string where = "reprise";
  int code = 0;
  try {
    if (word == "--help" || (word == "help" && second.empty())) {
      out << overview();
    } else if (word == "--version") {
      out << "reprise " << help_texts::version << '\n';
    } else if (word == "help" && second == "input") {
      out << help_texts::input;
    } else if (word == "help" && second == "json") {
      out << help_texts::json;
    } else if (word == "completion") {
      out << completion_script(second);
    } else {
      auto commands = all_commands();
      const bool help = word == "help";
      const auto found = std::find_if(commands.begin(), commands.end(),
                                      [&](const auto& command) { return command->name() == (help ? second : word); });
      if (found == commands.end()) {
        if (word.empty()) throw UsageError("a command is missing; reprise --help lists them.");
        std::vector<std::string> names;
        for (const auto& command : commands) names.push_back(command->name());
        const std::string wrong = help ? second : word;
        const std::string suggestion = did_you_mean(wrong, names);
        throw UsageError(fmt::format("there is no command '{}'{}; reprise --help lists them.", wrong,
                                     suggestion.empty() ? "" : " (" + suggestion + ")"));
      }
      where += " " + (*found)->name();
      if (help) {
        out << (*found)->options().help();
      } else {
        code = (*found)->run(argc - 1, argv + 1, out, err);
      }
    }
    flush(out);
    return code;
  } catch (const UsageError& error) {
    return fail(2, where, error.what());
  } catch (const InputError& error) {
    return fail(2, where, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(2, where, error.what());
  } catch (const std::exception& error) {
    return fail(1, where, error.what());
  }
}

std::string completion_script(const std::string& shell) {
  std::string text;
  if (shell == "bash" || shell == "zsh") {
    text = shell == "bash"
               ? "# Completion of reprise for bash.\n"
               : "#compdef reprise\n# Completion of reprise for zsh.\nautoload -U +X bashcompinit && bashcompinit\n";
    text +=
        "_reprise() {\n  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\" words=''\n"
        "  COMPREPLY=()\n  if [[ $COMP_CWORD -eq 1 ]]; then\n    words='";
    for (const auto& command : all_commands()) text += command->name() + " ";
    text +=
        "help completion --help --version'\n    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n    return\n  fi\n"
        "  case \"${COMP_WORDS[1]} $before\" in\n"
        "    'help help') words='";
    for (const auto& command : all_commands()) text += command->name() + " ";
    text += "input json' ;;\n    'completion completion') words='bash zsh fish' ;;\n";
    std::string option_cases;
    for (const auto& command : all_commands()) {
      std::vector<std::string> names;
      for (const auto& option : command->options().summaries()) {
        if (!option.name.empty()) names.push_back(option.name);
        if (!option.choices.empty()) {
          text +=
              fmt::format("    '{} {}') words='{}' ;;\n", command->name(), option.name, fmt::join(option.choices, " "));
        } else if (option.is_path && !option.name.empty()) {
          text += fmt::format("    '{} {}') COMPREPLY=($(compgen -f -- \"$word\")); return ;;\n", command->name(),
                              option.name);
        }
      }
      option_cases += fmt::format("        {}) words='{}' ;;\n", command->name(), fmt::join(names, " "));
    }
    return text +
           "    *)\n      if [[ $word != -* ]]; then COMPREPLY=($(compgen -f -- \"$word\")); return; fi\n"
           "      case \"${COMP_WORDS[1]}\" in\n" +
           option_cases +
           "      esac ;;\n  esac\n  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n}\n"
           "complete -o filenames -F _reprise reprise\n";
  }
  if (shell == "fish") {
    text = "# Completion of reprise for fish.\n";
    for (const auto& command : all_commands()) {
      text += fmt::format("complete -c reprise -n __fish_use_subcommand -f -a {} -d '{}'\n", command->name(),
                          command->summary());
      for (const auto& option : command->options().summaries()) {
        if (option.name.empty()) continue;
        text += fmt::format("complete -c reprise -n '__fish_seen_subcommand_from {}' -l {}", command->name(),
                            option.name.substr(2));
        if (!option.choices.empty()) text += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
        if (option.choices.empty() && option.takes_value) text += " -r";
        text += '\n';
      }
    }
    return text + "complete -c reprise -n __fish_use_subcommand -f -a 'help completion'\n";
  }
  throw UsageError(fmt::format("completion is for '{}', but must be for bash, zsh or fish.", shell));
}

}  // namespace reprise::app
