// fuzz_commands: the readers and the commands of reprise under libFuzzer (https://llvm.org/docs/LibFuzzer.html).
// The bytes are files, one after the other: each but the first begins with a line "# file NAME", and is left out where
// the name is none of those below. The first is input.toml, and every command is run on it; it may name outline.toml.
// claim.toml is what `check` gets, with tree.cert, whose text is compressed first, as the command expects it. table.csv
// is a stored table, such as the history of a run. Every run must end in a result or in one clear sentence.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "apps/running.hpp"
#include "reprise/io/compression.hpp"
#include "reprise/io/table.hpp"
#include "temporary_folder.hpp"

namespace {

/// The commands, quick whatever the file is; --json comes with all of them.
const std::vector<std::vector<std::string>>& commands() {
  static const std::vector<std::vector<std::string>> list{
      {"pose", "--at", "0.5", "1.5", "--orientation", "10"},
      {"assemble", "--lengths", "1", "1.5", "2"},
      {"workspace", "--orientation", "0"},
      {"workspace", "--orientation", "20", "--chord", "0.1"},
      {"dextrous", "--range", "-5", "20"},
      {"orientation", "--at", "0.5", "1.5"},
      {"conditioning", "--orientation", "0", "--grid", "3"},
      {"synthesize", "--points", "6", "--max-evaluations", "5", "--no-prove", "--time", "2"},
  };
  return list;
}

[[noreturn]] void find(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

void run(std::vector<std::string> arguments, const std::string& file) {
  arguments.insert(arguments.begin() + 1, file);
  arguments.emplace_back("--json");
  const reprise::test::Ended ended = reprise::test::run(arguments);
  if (ended.is_answer() || ended.is_refusal()) return;
  find(arguments[0] + " ends with exit code " + std::to_string(ended.code) + ": " + ended.err);
}

/// A table that can be read is the same when it is written and read again.
void read(const std::string& file) {
  std::string text;
  try {
    text = reprise::to_csv(reprise::read_table(file));
  } catch (const std::runtime_error& error) {
    const std::string_view sentence = error.what();
    if (sentence.find(file) == std::string_view::npos)
      find("a table is refused without its name: " + std::string(sentence));
    return;
  }
  const TemporaryFolder folder;
  if (reprise::to_csv(reprise::read_table(folder.write("again.csv", text))) != text) find("not the same table again");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const TemporaryFolder folder;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  constexpr std::string_view mark = "\n# file ";
  std::string name = "input.toml";
  while (true) {
    const std::size_t end = rest.find(mark);
    const std::string content(rest.substr(0, end));
    if (name == "tree.cert") {
      folder.write(name, reprise::compress(content));
    } else if (name == "input.toml" || name == "outline.toml" || name == "claim.toml" || name == "table.csv") {
      folder.write(name, content);
    }
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + mark.size());
    const std::size_t line = std::min(rest.find('\n'), rest.size());
    name = rest.substr(0, line);
    rest.remove_prefix(std::min(line + 1, rest.size()));
  }
  for (const std::vector<std::string>& arguments : commands()) run(arguments, folder / "input.toml");
  if (std::filesystem::exists(folder / "claim.toml")) run({"check"}, folder / "claim.toml");
  if (std::filesystem::exists(folder / "table.csv")) read(folder / "table.csv");
  return 0;
}
