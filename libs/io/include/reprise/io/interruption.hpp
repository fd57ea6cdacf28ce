#pragma once

// What happens when a signal ends a program: nothing is left behind, and a computation that asks may finish early.
//
//     int main() {
//       handle_interruptions();
//       ...
//       {
//         const PolledInterruption polled;  // from here on the first signal only sets the flag
//         options.stop = [] { return interrupted(); };
//         solver.minimize(...);             // ends with the best point so far
//       }
//       ...                                 // prints what was found
//       return interrupted() ? interruption_exit_code() : 0;
//     }

#include <signal.h>  // NOLINT(modernize-deprecated-headers): POSIX, for sigaction and sigset_t
#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace reprise {

/// To be called before anything else; a second call changes nothing. From then on
/// - SIGINT, SIGTERM and SIGHUP set the flag that interrupted() reads. Where no PolledInterruption lives, and when such
/// a
///   signal comes again, they end the program with the exit code 128 + signal. Signals that come within 0.2 s of the
///   first count as one, since `timeout` and the like send theirs to the program and to its group. One that was
///   ignored when the program began, as by nohup, stays ignored;
/// - any other signal that ends a program ends it as always;
/// - in each of these cases helper processes are killed and temporary files removed first;
/// - SIGXFSZ and SIGPIPE are ignored: writing fails with an error in place of ending the program without a word;
/// - a standard stream that was closed cannot be written to, rather than becoming the next file that is opened.
void handle_interruptions();

/// Whether SIGINT, SIGTERM or SIGHUP has come.
bool interrupted();

/// 128 + the number of the signal that has come first; 0 where none has.
int interruption_exit_code();

/// While one of these lives, the first signal does not end the program: who makes it polls interrupted(), and ends soon
/// when that is true.
class PolledInterruption {
 public:
  PolledInterruption();
  ~PolledInterruption();
  PolledInterruption(const PolledInterruption&) = delete;
  PolledInterruption& operator=(const PolledInterruption&) = delete;
};

/// A file, there already or not, that is removed at the end of this object's life, or when a signal ends the program.
class TemporaryFile {
 public:
  /// The file need not be there yet.
  explicit TemporaryFile(std::filesystem::path path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }  ///< as it was given

 private:
  std::filesystem::path path_;
  std::size_t slot_;
};

/// A process group, by its number, that is killed when a signal ends the program while this object lives.
class HelperProcess {
 public:
  /// The number of the group, as kill takes it.
  explicit HelperProcess(pid_t group);
  ~HelperProcess();
  HelperProcess(const HelperProcess&) = delete;
  HelperProcess& operator=(const HelperProcess&) = delete;
};

/// Holds back all signals from this thread while it lives: they come at its end.
class WithoutSignals {
 public:
  WithoutSignals();
  ~WithoutSignals();
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

  /// Lets them come again; for a new process, which begins with what its parent holds back.
  void end_early() const;

 private:
  sigset_t before_{};
};

}  // namespace reprise
