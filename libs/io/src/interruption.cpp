#include "reprise/io/interruption.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <ctime>
#include <utility>

namespace reprise {

namespace {

// A signal handler may touch nothing but atomic variables without locks, and call few functions of the system, none of
// which allocates: so the names of temporary files are kept as pointers, in a list of fixed length. Programs have a few
// at a time; one that finds no place is removed by its destructor only.
constexpr std::size_t most_temporary_files = 64;
std::array<std::atomic<const char*>, most_temporary_files> temporary_files{};
std::atomic<pid_t> helper{0};
std::atomic<int> first_signal{0};
std::atomic<long> first_signal_at{0};  ///< milliseconds of the monotonic clock
std::atomic<int> polling{0};
std::atomic<pid_t> owner{0};
std::atomic<bool> on_terminal{false};
static_assert(std::atomic<const char*>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free &&
              std::atomic<long>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

constexpr long same_signal = 200;  ///< milliseconds

long milliseconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<long>(now.tv_sec) * 1000 + now.tv_nsec / 1'000'000;
}

void leave_nothing_behind() {
  if (::getpid() != owner) return;  // a child between fork and exec: the files are its parent's
  if (const pid_t group = helper; group > 0) {
    ::kill(-group, SIGKILL);
    ::waitpid(group, nullptr, 0);
  }
  for (const std::atomic<const char*>& file : temporary_files) {
    if (const char* name = file) ::unlink(name);
  }
  // What comes next on the terminal begins on a line of its own.
  if (on_terminal) [[maybe_unused]]
    const auto ignored = ::write(STDERR_FILENO, "\n", 1);
}

/// For the signals by which people and systems ask a program to end.
void on_interruption(int signal) {
  const int error = errno;
  int none = 0;
  if (first_signal.compare_exchange_strong(none, signal)) {
    first_signal_at = milliseconds();
    if (polling > 0) {
      errno = error;
      return;
    }
  } else if (milliseconds() - first_signal_at < same_signal) {
    errno = error;
    return;
  }
  leave_nothing_behind();
  ::_exit(128 + signal);
}

/// For all others that end a program: the signal comes again, to its default action, when this returns.
void on_end(int signal) {
  leave_nothing_behind();
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

void handle(int signal, void (*handler)(int), bool even_if_handled) {
  struct sigaction now {};
  ::sigaction(signal, nullptr, &now);
  const bool ignored = (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == SIG_IGN;
  const bool standard = (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == SIG_DFL;
  if (ignored || (!standard && !even_if_handled)) return;
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  ::sigfillset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void handle_interruptions() {
  owner = ::getpid();
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is the stream's own; what is open for reading only cannot be written to.
    if (::fcntl(stream, F_GETFD) == -1) [[maybe_unused]]
      const int taken = ::open("/dev/null", O_RDONLY);
  }
  on_terminal = ::isatty(STDERR_FILENO) == 1;
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, on_interruption, true);
  // Sanitizers and the like have handlers of their own for some of these, which stay.
  for (const int signal : {SIGQUIT, SIGXCPU, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGIO, SIGABRT, SIGSEGV,
                           SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP}) {
    handle(signal, on_end, false);
  }
}

bool interrupted() { return first_signal != 0; }

int interruption_exit_code() { return interrupted() ? 128 + first_signal : 0; }

PolledInterruption::PolledInterruption() { ++polling; }

PolledInterruption::~PolledInterruption() { --polling; }

TemporaryFile::TemporaryFile(std::filesystem::path path) : path_(std::move(path)), slot_(0) {
  for (const char* none = nullptr; slot_ < most_temporary_files; ++slot_, none = nullptr) {
    if (temporary_files[slot_].compare_exchange_strong(none, path_.c_str())) break;
  }
}

TemporaryFile::~TemporaryFile() {
  // Removed before it is forgotten, so that no signal finds it between the two.
  ::unlink(path_.c_str());
  if (slot_ < most_temporary_files) temporary_files[slot_] = nullptr;
}

HelperProcess::HelperProcess(pid_t group) { helper = group; }

HelperProcess::~HelperProcess() { helper = 0; }

WithoutSignals::WithoutSignals() {
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before_);
}

WithoutSignals::~WithoutSignals() { end_early(); }

void WithoutSignals::end_early() const { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace reprise
