#include <boost/test/unit_test.hpp>
#include <fstream>
#include <stdexcept>

#include "support/files.hpp"
#include "temporary_folder.hpp"

using namespace reprise::experiments;

BOOST_AUTO_TEST_CASE(a_file_is_written_with_its_folder_and_replaced) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "some/where/file.txt";
  write_file(path, "first");
  write_file(path, "second");
  BOOST_TEST(read_file(path) == "second");
}

BOOST_AUTO_TEST_CASE(a_failure_leaves_the_old_file_and_nothing_else) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "file.txt";
  write_file(path, "old");

  const auto half_written = [](const std::filesystem::path& beside) {
    std::ofstream(beside) << "half";
    throw std::runtime_error("stopped");
  };
  BOOST_TEST(thrown_by([&] { replace_file(path, half_written); }) == "stopped");
  BOOST_TEST(read_file(path) == "old");
  BOOST_TEST(folder.entries() == 1);

  BOOST_TEST(contains(thrown_by([&] { replace_file(path, [](const auto&) {}); }), "nothing was written"));
  BOOST_TEST(contains(thrown_by([&] { write_file(path, ""); }), "nothing was written"));
  BOOST_TEST(read_file(path) == "old");
  BOOST_TEST(folder.entries() == 1);
}

BOOST_AUTO_TEST_CASE(the_target_is_untouched_until_the_new_file_is_whole) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "file.txt";
  write_file(path, "old");
  replace_file(path, [&](const std::filesystem::path& beside) {
    std::ofstream(beside) << "new";
    BOOST_TEST(read_file(path) == "old");
    BOOST_TEST(beside.parent_path() == path.parent_path());
  });
  BOOST_TEST(read_file(path) == "new");
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
