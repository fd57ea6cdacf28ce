// fuzz_commands: the input reader and the commands of reprise under libFuzzer (https://llvm.org/docs/LibFuzzer.html).
// The bytes are a file, and every command is run on it. Every run must end in a result or in one clear sentence.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "apps/running.hpp"
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
      {"synthesize", "--points", "6", "--max-evaluations", "5", "--no-prove"},
  };
  return list;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::string file = folder.write("input.toml", {reinterpret_cast<const char*>(data), size}).string();
  for (std::vector<std::string> arguments : commands()) {
    arguments.insert(arguments.begin() + 1, file);
    arguments.emplace_back("--json");
    const reprise::test::Ended ended = reprise::test::run(arguments);
    if (ended.is_answer() || ended.is_refusal()) continue;
    std::fprintf(stderr, "%s ends with exit code %d: %s\n", arguments[0].c_str(), ended.code, ended.err.c_str());
    std::abort();
  }
  return 0;
}
