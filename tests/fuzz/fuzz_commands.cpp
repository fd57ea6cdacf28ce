// fuzz_commands: the input reader and the commands of reprise under libFuzzer (https://llvm.org/docs/LibFuzzer.html).
// The last byte chooses a command, what comes before is its file. Every run must end in a result or in one clear
// sentence.

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "apps/running.hpp"

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

const std::filesystem::path& file() {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("reprise-fuzz-" + std::to_string(::getpid()) + ".toml");
  static const int removed_at_end = std::atexit([] { std::filesystem::remove(path); });
  static_cast<void>(removed_at_end);
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::ofstream(file(), std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size - 1));
  std::vector<std::string> arguments = commands()[data[size - 1] % commands().size()];
  arguments.insert(arguments.begin() + 1, file().string());
  arguments.emplace_back("--json");
  const reprise::test::Ended ended = reprise::test::run(arguments);
  if (ended.is_answer() || ended.is_refusal()) return 0;
  std::fprintf(stderr, "%s ends with exit code %d: %s\n", arguments[0].c_str(), ended.code, ended.err.c_str());
  std::abort();
}
