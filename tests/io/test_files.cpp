#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/test/unit_test.hpp>
#include <chrono>

#include "reprise/io/files.hpp"
#include "temporary_folder.hpp"

using namespace reprise;

BOOST_AUTO_TEST_CASE(a_file_is_written_and_replaced_and_keeps_its_permissions) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "file.txt";
  write_file(path, "first");
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  write_file(path, "second");
  BOOST_TEST(read_file(path) == "second");
  BOOST_TEST((std::filesystem::status(path).permissions() ==
              (std::filesystem::perms::owner_read | std::filesystem::perms::owner_write)));
  BOOST_TEST(folder.entries() == 1);
}

BOOST_AUTO_TEST_CASE(files_are_written_together_or_not_at_all) {
  const TemporaryFolder folder;
  write_files(folder.path(), {{"a", "1"}, {"b", "2"}});
  std::filesystem::create_directory(folder / "c");
  BOOST_TEST(contains(thrown_by([&] { write_files(folder.path(), {{"a", "3"}, {"b", "4"}, {"c", "5"}}); }), "/c"));
  BOOST_TEST(read_file(folder / "a") == "1");
  BOOST_TEST(read_file(folder / "b") == "2");
  BOOST_TEST(folder.entries() == 3);
}

BOOST_AUTO_TEST_CASE(a_symbolic_link_stays_and_its_target_is_written) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "there");
  for (const char* target : {"there/old", "there/new"}) {
    folder.write("there/old", "old");
    const std::filesystem::path link = folder / ("to_" + std::filesystem::path(target).filename().string());
    std::filesystem::create_symlink(target, link);
    write_file(link, target);
    BOOST_TEST(std::filesystem::is_symlink(link));
    BOOST_TEST(read_file(folder / target) == target);
  }
  std::filesystem::create_symlink("circle", folder / "circle");
  BOOST_TEST(!thrown_by([&] { write_file(folder / "circle", "x"); }).empty());
  std::filesystem::create_symlink("/dev/full", folder / "full");
  BOOST_TEST(contains(thrown_by([&] { write_file(folder / "full", "x"); }), "not a file"));
  BOOST_TEST(std::filesystem::is_character_file("/dev/full"));
}

BOOST_AUTO_TEST_CASE(what_a_killed_program_has_left_is_removed_by_the_next) {
  const TemporaryFolder folder;
  folder.write(".file.txt.12345.part", "half");
  folder.write(".file.txt.note.part", "somebody's own");
  folder.write(".other.txt.12345.part", "half");
  write_file(folder / "file.txt", "whole");
  BOOST_TEST(!std::filesystem::exists(folder / ".file.txt.12345.part"));
  BOOST_TEST(folder.entries() == 3);
}

BOOST_AUTO_TEST_CASE(a_lock_keeps_other_programs_out_and_ends_with_its_program) {
  const TemporaryFolder folder;
  std::array<int, 2> locked{};
  BOOST_REQUIRE(::pipe(locked.data()) == 0);
  const pid_t other = ::fork();
  if (other == 0) {
    const FolderLock lock(folder.path(), std::chrono::seconds(0));
    write_file(folder / "file", "other");  // who holds the lock may write
    if (::write(locked[1], "x", 1) == 1) ::pause();
    ::_exit(1);
  }
  char byte = 0;
  BOOST_TEST(::read(locked[0], &byte, 1) == 1);
  BOOST_TEST(contains(thrown_by([&] { const FolderLock lock(folder.path(), std::chrono::milliseconds(20)); }),
                      folder.path().string()));
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  BOOST_TEST(thrown_by([&] { const FolderLock lock(folder.path(), std::chrono::seconds(0)); }).empty());
  BOOST_TEST(folder.entries() == 1);
  ::close(locked[0]);
  ::close(locked[1]);
}

// Two programs write the same two files again and again; whoever reads them under the lock finds both of one program.
BOOST_AUTO_TEST_CASE(two_programs_do_not_mix_their_files) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& content) {
    write_files(folder.path(), {{"a", content}, {"b", content}, {"c", content}});
  };
  write("first");
  const pid_t other = ::fork();
  if (other == 0) {
    for (int k = 0; k < 100; ++k) write("other");
    ::_exit(0);
  }
  int mixed = 0;
  for (int k = 0; k < 100; ++k) {
    write("this one");
    const FolderLock lock(folder.path(), std::chrono::seconds(20));
    const std::string content = read_file(folder / "a");
    if (read_file(folder / "b") != content || read_file(folder / "c") != content) ++mixed;
  }
  ::waitpid(other, nullptr, 0);
  BOOST_TEST(mixed == 0);
  BOOST_TEST(folder.entries() == 3);
}

BOOST_AUTO_TEST_CASE(obstacles_are_seen_before_anything_is_written) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  std::filesystem::create_directory(folder / "folder");
  std::filesystem::create_symlink("nowhere/file", folder / "dangling");
  BOOST_TEST(obstacle_to_file(folder / "file").empty());
  BOOST_TEST(obstacle_to_file(folder / "new").empty());
  BOOST_TEST(obstacle_to_file("new").empty());
  BOOST_TEST(contains(obstacle_to_file(folder / "none/new"), "no folder"));
  BOOST_TEST(contains(obstacle_to_file(folder / "file/new"), "no folder"));
  BOOST_TEST(contains(obstacle_to_file(folder / "dangling"), "nowhere"));
  BOOST_TEST(!obstacle_to_file(folder / "folder").empty());
  BOOST_TEST(!obstacle_to_file("/dev/full").empty());
  BOOST_TEST(obstacle_to_folder(folder / "folder").empty());
  BOOST_TEST(obstacle_to_folder(folder / "new").empty());
  BOOST_TEST(obstacle_to_folder(folder / "new/").empty());
  BOOST_TEST(!obstacle_to_folder(folder / "new/below").empty());
  BOOST_TEST(obstacle_to_folder(folder / "new/below", true).empty());
  BOOST_TEST(!obstacle_to_folder(folder / "file").empty());
  BOOST_TEST(!obstacle_to_folder(folder / "file/below", true).empty());
  BOOST_TEST(folder.entries() == 3);
}

BOOST_AUTO_TEST_CASE(errors_name_the_file) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  BOOST_TEST(contains(thrown_by([&] { write_file(folder / "file/below", "x"); }), "file"));
  BOOST_TEST(contains(thrown_by([&] { read_file(folder / "none"); }), "none"));
  BOOST_TEST(contains(thrown_by([&] { read_file(folder.path()); }), folder.path().string()));
}

BOOST_AUTO_TEST_CASE(longer_files_than_wanted_are_refused) {
  const TemporaryFolder folder;
  const auto file = folder.write("f", "12345");
  BOOST_TEST(read_file(file, 5) == "12345");
  BOOST_TEST(contains(thrown_by([&] { read_file(file, 4); }), "longer than 4 bytes"));
  BOOST_TEST(contains(thrown_by([] { read_file("/dev/zero", 1000); }), "longer than 1000 bytes"));
}
