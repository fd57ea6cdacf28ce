#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <functional>
#include <thread>

#include "reprise/io/files.hpp"
#include "reprise/io/interruption.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using namespace std::chrono_literals;

namespace {

/// How a process ends that runs `body` after handle_interruptions(): its exit code, or minus the signal that killed it.
int end_of(const std::function<int()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    handle_interruptions();
    ::_exit(body());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_signal_ends_a_program_with_its_code_and_removes_its_temporary_files) {
  const TemporaryFolder folder;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    BOOST_TEST(end_of([&] {
                 const TemporaryFile file(folder / "half");
                 folder.write("half", "x");
                 ::raise(signal);
                 return 0;
               }) == 128 + signal);
    BOOST_TEST(folder.entries() == 0);
  }
}

BOOST_AUTO_TEST_CASE(other_signals_end_it_as_always_but_leave_nothing) {
  const TemporaryFolder folder;
  for (const int signal : {SIGALRM, SIGUSR1, SIGXCPU}) {
    BOOST_TEST(end_of([&] {
                 const TemporaryFile file(folder / "half");
                 folder.write("half", "x");
                 ::raise(signal);
                 return 0;
               }) == -signal);
    BOOST_TEST(folder.entries() == 0);
  }
}

BOOST_AUTO_TEST_CASE(who_polls_ends_in_order) {
  BOOST_TEST(end_of([] {
               const PolledInterruption polled;
               if (interrupted() || interruption_exit_code() != 0) return 1;
               ::raise(SIGINT);
               return interrupted() ? interruption_exit_code() : 2;
             }) == 130);
}

BOOST_AUTO_TEST_CASE(signals_at_the_same_time_count_as_one_and_a_later_one_ends_at_once) {
  BOOST_TEST(end_of([] {
               const PolledInterruption polled;
               ::raise(SIGTERM);
               ::raise(SIGTERM);
               return 7;
             }) == 7);
  BOOST_TEST(end_of([] {
               const PolledInterruption polled;
               ::raise(SIGTERM);
               std::this_thread::sleep_for(300ms);
               ::raise(SIGINT);
               return 7;
             }) == 130);
}

BOOST_AUTO_TEST_CASE(after_the_part_that_polls_a_signal_ends_the_program_again) {
  BOOST_TEST(end_of([] {
               { const PolledInterruption polled; }
               ::raise(SIGINT);
               return 7;
             }) == 130);
}

BOOST_AUTO_TEST_CASE(a_signal_that_is_ignored_stays_ignored) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGHUP, SIG_IGN);
    handle_interruptions();
    ::raise(SIGHUP);
    ::_exit(interrupted() ? 1 : 7);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  BOOST_TEST(WEXITSTATUS(status) == 7);
}

BOOST_AUTO_TEST_CASE(a_helper_process_is_killed_with_its_children) {
  std::array<int, 2> held{};  // is at its end when no process holds it open
  BOOST_REQUIRE(::pipe(held.data()) == 0);
  BOOST_TEST(end_of([&] {
               const pid_t group = ::fork();
               if (group == 0) {
                 ::setpgid(0, 0);
                 ::fork();
                 for (;;) ::pause();
               }
               ::setpgid(group, group);
               const HelperProcess helper(group);
               ::raise(SIGINT);
               return 0;
             }) == 130);
  ::close(held[1]);
  char byte = 0;
  BOOST_TEST(::read(held[0], &byte, 1) == 0);
  ::close(held[0]);
}

BOOST_AUTO_TEST_CASE(too_long_files_and_broken_pipes_are_errors) {
  const TemporaryFolder folder;
  BOOST_TEST(end_of([&] {
               const rlimit limit{100, 100};
               ::setrlimit(RLIMIT_FSIZE, &limit);
               const std::string message = thrown_by([&] { write_file(folder / "file", std::string(1000, 'x')); });
               return contains(message, "cannot write") ? 7 : 1;
             }) == 7);
  BOOST_TEST(folder.entries() == 0);
  BOOST_TEST(end_of([] {
               std::array<int, 2> ends{};
               if (::pipe(ends.data()) != 0) return 1;
               ::close(ends[0]);
               return ::write(ends[1], "x", 1) == -1 ? 7 : 2;
             }) == 7);
}

BOOST_AUTO_TEST_CASE(a_closed_standard_stream_takes_no_text_and_no_file) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(STDOUT_FILENO);
    handle_interruptions();
    const int file = ::open((folder / "file").c_str(), O_CREAT | O_WRONLY, 0600);
    ::_exit(file != STDOUT_FILENO && ::write(STDOUT_FILENO, "x", 1) == -1 ? 7 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  BOOST_TEST(WEXITSTATUS(status) == 7);
}
