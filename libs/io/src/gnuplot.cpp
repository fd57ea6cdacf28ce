#include "reprise/io/gnuplot.hpp"

#include <fmt/format.h>
#include <gnuplot-iostream.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/process.hpp>
#include <boost/process/extend.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "reprise/io/interruption.hpp"

namespace reprise {

namespace {

/// A file without a name, in memory.
class MemoryFile {
 public:
  MemoryFile() : file_(::fdopen(::memfd_create("reprise", MFD_CLOEXEC), "w+"), &std::fclose) {
    if (!file_) throw std::runtime_error(fmt::format("gnuplot has no room in memory for its files: {}.", reason()));
  }

  /// As gnuplot-iostream writes to files, which it closes.
  void write(std::string_view text) {
    Gnuplot stream(::fdopen(::dup(::fileno(file_.get())), "w"));
    stream << text << std::flush;
    if (!stream) throw std::runtime_error(fmt::format("gnuplot's script cannot be written: {}.", reason()));
    // The copy shares its position with the original.
    std::rewind(file_.get());
  }

  std::string content() const {
    std::rewind(file_.get());
    std::string text;
    std::array<char, 65536> block;
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file_.get())) {
      text.append(block.data(), count);
    }
    return text;
  }

  std::FILE* get() const { return file_.get(); }

 private:
  static std::string reason() { return std::error_code(errno, std::generic_category()).message(); }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// The folders of PATH. Boost.Process has a function for them, which throws where the locale that the environment names
/// is not installed.
std::vector<boost::filesystem::path> folders_of_programs() {
  std::vector<boost::filesystem::path> folders;
  const char* value = std::getenv("PATH");
  std::istringstream path(value == nullptr ? "" : value);
  for (std::string folder; std::getline(path, folder, ':');) folders.emplace_back(folder);
  return folders;
}

boost::process::environment environment() {
  boost::process::environment variables;
  variables["LC_ALL"] = "C.UTF-8";
  for (const char* name : {"PATH", "LD_LIBRARY_PATH", "XDG_CACHE_HOME"}) {
    if (const char* value = std::getenv(name)) variables[name] = value;
  }
  // Where the system's cache of fonts is out of date, there must be a place for a new one.
  if (const char* home = std::getenv("HOME"); home != nullptr && variables.count("XDG_CACHE_HOME") == 0) {
    variables["XDG_CACHE_HOME"] = std::string(home) + "/.cache";
  }
  return variables;
}

}  // namespace

GnuplotRun run_gnuplot(const std::vector<std::string>& arguments, std::string_view script,
                       std::chrono::milliseconds limit) {
  // gnuplot-iostream writes the script, but opens gnuplot by popen(): it does not tell how gnuplot ended, cannot end
  // one that hangs, and needs a shell. So Boost.Process runs it.
  namespace process = boost::process;
  const boost::filesystem::path program = process::search_path("gnuplot", folders_of_programs());
  if (program.empty()) throw std::runtime_error("gnuplot is not installed: no folder of PATH has it.");

  MemoryFile input;
  const MemoryFile output;
  const MemoryFile said;
  std::vector<std::string> words = arguments;
  if (!script.empty()) {
    input.write(script);
    // gnuplot reads its standard input byte by byte, which takes seconds for a large picture, but a file at once. Where
    // /proc is not there, slowly is better than not at all.
    if (std::filesystem::exists("/proc/self/fd/0")) words.emplace_back("/proc/self/fd/0");
  }

  process::group group;
  std::error_code error;
  std::optional<WithoutSignals> held;
  held.emplace();  // until gnuplot is known as a helper: a signal before that would end this program, but not gnuplot
  // The last argument is called in the new process: gnuplot does not outlive this program, even where that is killed.
  process::child child(process::exe = program, process::args = words, environment(),
                       process::std_in<input.get(), process::std_out> output.get(), process::std_err > said.get(),
                       group, error, process::extend::on_exec_setup([&](auto&) {
                         ::prctl(PR_SET_PDEATHSIG, SIGKILL);
                         held->end_early();
                       }));
  if (error) throw std::runtime_error(fmt::format("gnuplot cannot be run: {}.", error.message()));
  const HelperProcess helper(child.id());
  held.reset();
  // wait_for() of Boost 1.74 sleeps for the whole limit when the process ends just before it begins to wait.
  const auto end = std::chrono::steady_clock::now() + limit;
  while (child.running(error)) {
    if (std::chrono::steady_clock::now() > end) {
      group.terminate(error);
      child.wait(error);
      throw std::runtime_error(
          fmt::format("gnuplot did not end within {} s and was stopped.", static_cast<double>(limit.count()) / 1000.0));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  GnuplotRun run{output.content(), said.content()};
  std::replace(run.said.begin(), run.said.end(), '\n', ' ');
  run.said.erase(run.said.find_last_not_of(' ') + 1);
  run.said.erase(0, run.said.find_first_not_of(' '));
  const int status = child.native_exit_code();
  if (status != 0) {
    throw std::runtime_error(fmt::format("gnuplot {} {}: {}",
                                         WIFSIGNALED(status) ? "was ended by signal" : "ended with exit code",
                                         WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status),
                                         run.said.empty() ? "it gave no reason." : run.said));
  }
  return run;
}

}  // namespace reprise
