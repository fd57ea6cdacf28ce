// fuzz_reprise [--inputs N] [--manipulators N] [--seed S] [--folder DIR]
//
// Runs the program, in this process, on files that are mutations of the corpus and on random valid manipulators. Every
// run must end within its time in a result (one JSON document and exit code 0, or 1 where a synthesis finds no design
// that reaches the workspace, or a boundary is not traced) or in one clear sentence (exit code 2); for a valid
// manipulator it must be a result. Whatever does not, a crash and a finding of a sanitizer included, leaves its file
// behind. The same seed gives the same runs.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "reprise/base/constants.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/options.hpp"
#include "reprise/study/problem_file.hpp"
#include "running.hpp"

namespace {

using namespace reprise;
using reprise::test::Ended;
using reprise::test::run;

/// Seconds for one run, with sanitizers on a busy machine; without them most take milliseconds.
constexpr unsigned patience = 120;

char running[4096];  ///< the command line of the run, for the signal handler

void say_what_runs(int signal) {
  const char* const reason = signal == SIGALRM ? "no end: " : "crash: ";
  [[maybe_unused]] auto written = ::write(STDERR_FILENO, reason, std::strlen(reason));
  written = ::write(STDERR_FILENO, running, std::strlen(running));
  ::_exit(3);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  double between(double lower, double upper) {
    return lower + static_cast<double>(engine_() >> 11) * 0x1p-53 * (upper - lower);
  }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  template <class Value>
  const Value& of(const std::vector<Value>& values) {
    return values[below(values.size())];
  }

 private:
  std::mt19937_64 engine_;
};

std::string number(double value) { return fmt::format("{}", value); }

/// A command with its options, for any file.
std::vector<std::string> some_command(Random& random, const std::string& file, double size) {
  const std::string x = number(random.between(-size, size));
  const std::string y = number(random.between(-size, size));
  const std::string phi = number(random.between(-180.0, 180.0));
  switch (random.below(8)) {
    case 0:
      return {"pose", file, "--at", x, y, "--orientation", phi};
    case 1:
      return {"assemble",
              file,
              "--lengths",
              number(random.between(0.0, size)),
              number(random.between(0.0, size)),
              number(random.between(0.0, size))};
    case 2:
      return {"workspace", file, "--orientation", phi, "--chord", number(size * random.between(0.005, 0.2))};
    case 3: {
      const double lower = random.between(-180.0, 180.0);
      return {"dextrous", file, "--range", number(lower), number(lower + std::pow(random.between(0.0, 6.5), 3.0))};
    }
    case 4:
      return {"orientation", file, "--at", x, y};
    case 5:
      return {"conditioning", file, "--orientation", phi, "--grid", "5"};
    case 6:
      return {"synthesize", file, "--points", "12", "--max-evaluations", "15", "--no-prove"};
    default:
      return {"workspace", file, "--orientation", random.chance(0.5) ? phi : "0"};
  }
}

/// Whether the run ended as it must; says what is wrong where it did not.
bool ends_well(std::vector<std::string> arguments, bool must_succeed) {
  arguments.emplace_back("--json");
  const std::string line = fmt::format("reprise {}\n", fmt::join(arguments, " "));
  std::strncpy(running, line.c_str(), sizeof running - 1);
  ::alarm(patience);
  const Ended ended = run(arguments);
  ::alarm(0);
  if (ended.is_answer() || (!must_succeed && ended.is_refusal())) return true;
  fmt::print(stderr, "exit code {}: {}{}", ended.code, line, ended.err);
  return false;
}

std::vector<std::string> read_corpus(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& folder : folders) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> contents;
  for (const std::filesystem::path& file : files) contents.push_back(read_file(file));
  return contents;
}

/// One mutation: of bytes, lines, numbers or words.
void mutate(Random& random, std::string& text, const std::vector<std::string>& corpus) {
  static const std::vector<std::string> words{"nan",
                                              "inf",
                                              "-inf",
                                              "-1",
                                              "0",
                                              "-0.0",
                                              "1e308",
                                              "1e-308",
                                              "1e999",
                                              "9223372036854775807",
                                              "1e6",
                                              "-1e6",
                                              "[]",
                                              "[[]]",
                                              "{}",
                                              "\"\"",
                                              "'x'",
                                              "\"sqrt(2)\"",
                                              "\"sqrt(-1)\"",
                                              "\"sqrt(1e999)\"",
                                              "\"10*sqrt(3)/3\"",
                                              "\"-(1 + 2)*cos(60)\"",
                                              "\"1/0\"",
                                              "\"1e308*1e308\"",
                                              "\"((((((((1\"",
                                              "\"2 pi\"",
                                              "\"sin(\"",
                                              "(",
                                              ")",
                                              "*",
                                              "/",
                                              "sqrt(",
                                              "unit = 'mm'\n",
                                              "true",
                                              "1979-05-27",
                                              "[1, 2]",
                                              "[nan, inf]",
                                              "[[1, 2], [3, 4]]",
                                              "[[manipulator.leg]]\n",
                                              "[manipulator]\n",
                                              "[workspace]\n",
                                              "[design]\n",
                                              "[design.bounds]\n",
                                              "[orientations]\n",
                                              "free = ['base']\n",
                                              "within = 1\n",
                                              "range_deg = [-5, 5]\n",
                                              "slices_deg = [0, 1]\n",
                                              "kind = 'polygon'\n",
                                              "vertices = [[0, 0], [1, 0], [0, 1]]\n",
                                              "base_angle_deg = [0, 90]\n",
                                              "platform_angle_deg = [-90, 200]\n",
                                              "scale = 1e-300\n",
                                              "length = [0, 1]\n",
                                              "length = [1, 1]\n",
                                              "exponent = 0.3\n",
                                              "\xff",
                                              "\xc3",
                                              std::string(1, '\0'),
                                              "#",
                                              "\"\"\"",
                                              "=",
                                              ",",
                                              "]",
                                              "[",
                                              "\n"};
  const auto position = [&] { return random.below(text.size() + 1); };
  const auto number_at = [&](std::size_t from) {
    const std::size_t begin = text.find_first_of("0123456789", from);
    const std::size_t end = begin == std::string::npos ? begin : text.find_first_not_of("0123456789.", begin);
    return std::pair(begin, end == std::string::npos ? text.size() : end);
  };
  switch (random.below(8)) {
    case 0:
      if (!text.empty()) text[random.below(text.size())] = static_cast<char>(random.below(256));
      break;
    case 1:
      text.erase(position(), random.below(20));
      break;
    case 2:
      text.insert(position(), random.of(words));
      break;
    case 3: {  // a number becomes another one, or a word
      const auto [begin, end] = number_at(position());
      if (begin == std::string::npos) break;
      text.replace(begin, end - begin, random.chance(0.5) ? random.of(words) : number(random.between(-5.0, 5.0)));
      break;
    }
    case 4: {  // a line comes again elsewhere
      const std::size_t begin = text.rfind('\n', position());
      const std::size_t from = begin == std::string::npos ? 0 : begin + 1;
      const std::string line = text.substr(from, text.find('\n', from) - from) + "\n";
      text.insert(std::min(text.size(), text.find('\n', position())), "\n" + line);
      break;
    }
    case 5:
      text.resize(position());
      break;
    case 6: {  // the end of another file
      const std::string& other = random.of(corpus);
      text.resize(position());
      text += other.substr(random.below(other.size() + 1));
      break;
    }
    default: {  // a number moves a little
      const auto [begin, end] = number_at(position());
      if (begin == std::string::npos) break;
      text.replace(begin, end - begin, number(std::strtod(text.c_str() + begin, nullptr) * random.between(0.5, 1.5)));
    }
  }
}

/// A valid manipulator: many are special, with joints on a lattice, equal legs, a fixed length, all joints in line.
std::string random_manipulator(Random& random, double size) {
  const bool lattice = random.chance(0.4);
  const auto coordinate = [&](double range) {
    const double value = random.between(-range, range);
    return size * (lattice ? std::round(2.0 * value) / 2.0 : value);
  };
  std::vector<Leg> legs;
  const std::size_t count = random.chance(0.7) ? 3 : 2 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && random.chance(0.1)) {
      legs.push_back(legs.back());
      continue;
    }
    Leg leg;
    leg.base_joint = {coordinate(1.5), random.chance(0.3) ? 0.0 : coordinate(1.5)};
    leg.platform_joint = random.chance(0.15)
                             ? Eigen::Vector2d(0.0, 0.0)
                             : Eigen::Vector2d(coordinate(0.7), random.chance(0.3) ? 0.0 : coordinate(0.7));
    const double shortest = random.chance(0.15) ? 0.0 : std::abs(coordinate(1.0));
    const double stroke = random.chance(0.1) ? 0.0 : size * random.between(0.0, 1.5);
    leg.length = {shortest, shortest + stroke};
    if (leg.length.upper <= 0.0) leg.length.upper = size;
    const auto angles = [&]() -> std::optional<Interval> {
      if (!random.chance(0.2)) return std::nullopt;
      const double lower = random.chance(0.5) ? random.between(-3.0, 3.0) : pi / 2.0;
      return Interval{lower, lower + (random.chance(0.3) ? pi : random.between(0.01, 6.2))};
    };
    leg.base_angle = angles();
    leg.platform_angle = angles();
    legs.push_back(leg);
  }
  return to_toml({Manipulator("random", legs), {}, false});
}

void write(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
}

}  // namespace

int main(int argc, char** argv) {
  long inputs = 10'000;
  long manipulators = 10'000;
  long seed = 1;
  std::filesystem::path folder = std::filesystem::temp_directory_path() / fmt::format("reprise-fuzz-{}", ::getpid());
  CommandLine options("fuzz_reprise", "Runs reprise on mutated files and on random manipulators");
  options.integer("--inputs", inputs, 0, 1'000'000'000, "number of mutated files");
  options.integer("--manipulators", manipulators, 0, 1'000'000'000, "number of random manipulators");
  options.integer("--seed", seed, 0, 1'000'000'000, "seed");
  options.path("--folder", folder, "where the files go; those that fail stay there");
  try {
    if (!options.parse(argc, argv)) {
      fmt::print("{}", options.help());
      return 0;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "fuzz_reprise: {}\n", error.what());
    return 2;
  }
  std::signal(SIGALRM, say_what_runs);
#ifdef NDEBUG  // sanitizers have handlers of their own, which say more
  std::signal(SIGSEGV, say_what_runs);
  std::signal(SIGABRT, say_what_runs);
  std::signal(SIGFPE, say_what_runs);
#endif
  std::filesystem::create_directories(folder);
  Random random(static_cast<std::uint64_t>(seed));
  const std::vector<std::string> corpus =
      read_corpus({REPRISE_SOURCE "/examples", REPRISE_SOURCE "/tests/apps/corpus"});
  long failures = 0;
  const auto keep_unless = [&](bool well, const std::filesystem::path& file) {
    failures += !well;
    if (well) std::filesystem::remove(file);
  };
  for (long k = 0; k < inputs; ++k) {
    std::string text = random.of(corpus);
    for (std::size_t count = 1 + random.below(4); count > 0; --count) mutate(random, text, corpus);
    const std::filesystem::path file = folder / fmt::format("input_{}.toml", k);
    write(file, text);
    keep_unless(ends_well(some_command(random, file.string(), 2.0), false), file);
  }
  fmt::print("{} mutated files\n", inputs);
  for (long k = 0; k < manipulators; ++k) {
    const double size = std::pow(10.0, random.between(-3.0, 4.0));
    const std::filesystem::path file = folder / fmt::format("manipulator_{}.toml", k);
    write(file, random_manipulator(random, size));
    std::vector<std::string> command = some_command(random, file.string(), size);
    const bool for_others = command[0] == "synthesize" || command[0] == "assemble";
    keep_unless(ends_well(command, !for_others), file);
  }
  fmt::print("{} random manipulators\n{} failures{}\n", manipulators, failures,
             failures > 0 ? fmt::format(", files in {}", folder.string()) : "");
  if (failures == 0) std::filesystem::remove_all(folder);
  return failures == 0 ? 0 : 1;
}
