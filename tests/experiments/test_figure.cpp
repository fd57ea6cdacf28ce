#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <stdexcept>

#include "support/figure.hpp"
#include "support/files.hpp"
#include "temporary_folder.hpp"

using namespace reprise::experiments;

namespace {

Figure make_figure() {
  Figure figure(300, 200);
  const std::string data = figure.add_data({{0, 0}, {1, 1}, {}, {2, 0}, {3, 1}});
  figure.add("plot " + data + " using 1:2 with lines title " + gnuplot_string("it's"));
  return figure;
}

/// PATH for the time of a test.
class Path {
 public:
  explicit Path(const std::string& value) : old_(std::getenv("PATH")) { ::setenv("PATH", value.c_str(), 1); }
  ~Path() { ::setenv("PATH", old_.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

 private:
  std::string old_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_figure_is_drawn_as_svg_and_png_and_the_same_each_time) {
  const TemporaryFolder folder;
  const std::vector<std::string> files = make_figure().write(folder.path(), "picture");
  BOOST_TEST(files == std::vector<std::string>({"picture.svg", "picture.png"}), boost::test_tools::per_element());
  BOOST_TEST(folder.entries() == 2);
  const std::string svg = read_file(folder / "picture.svg");
  const std::string png = read_file(folder / "picture.png");
  BOOST_TEST(contains(svg, "</svg>"));
  BOOST_TEST(contains(svg, "it's"));
  BOOST_TEST(png.substr(1, 3) == "PNG");
  make_figure().write(folder.path(), "picture");
  BOOST_TEST(read_file(folder / "picture.svg") == svg);
  BOOST_TEST((read_file(folder / "picture.png") == png));
}

BOOST_AUTO_TEST_CASE(a_single_picture_is_of_the_kind_of_its_extension) {
  const TemporaryFolder folder;
  for (const std::string& extension : Figure::extensions()) make_figure().write(folder / ("one" + extension));
  BOOST_TEST(folder.entries() == 3);
  BOOST_TEST(contains(read_file(folder / "one.svg"), "</svg>"));
  BOOST_TEST(read_file(folder / "one.png").substr(1, 3) == "PNG");
  BOOST_TEST(read_file(folder / "one.pdf").starts_with("%PDF"));
  BOOST_CHECK_THROW(make_figure().write(folder / "one.gif"), std::logic_error);
}

BOOST_AUTO_TEST_CASE(what_gnuplot_complains_of_is_an_error_and_leaves_nothing) {
  for (const char* command : {"plot $nothing", "plot sin(x) with nonsense", "set xrange [1:1]\nplot sin(x)",
                              "plot 'no_such_file'", "exit status 3", "not a command"}) {
    BOOST_TEST_CONTEXT(command) {
      const TemporaryFolder folder;
      Figure figure(300, 200);
      figure.add(command);
      const std::string message = thrown_by([&] { figure.write(folder.path(), "picture"); });
      BOOST_TEST(contains(message, "picture.svg"));
      BOOST_TEST(folder.entries() == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_script_that_draws_nothing_is_an_error) {
  const TemporaryFolder folder;
  BOOST_TEST(!thrown_by([&] { Figure(300, 200).write(folder.path(), "picture"); }).empty());
  BOOST_TEST(folder.entries() == 0);
}

BOOST_AUTO_TEST_CASE(a_failure_keeps_the_old_picture) {
  const TemporaryFolder folder;
  make_figure().write(folder.path(), "picture");
  const std::string old = read_file(folder / "picture.svg");
  Figure figure(300, 200);
  figure.add("plot $nothing");
  BOOST_CHECK_THROW(figure.write(folder.path(), "picture"), std::runtime_error);
  BOOST_TEST(read_file(folder / "picture.svg") == old);
}

BOOST_AUTO_TEST_CASE(a_gnuplot_that_is_missing_or_ends_early_is_an_error_not_a_crash) {
  const TemporaryFolder folder;
  const TemporaryFolder programs;
  for (const char* tool : {"sh", "cat"}) {
    std::filesystem::create_symlink(std::filesystem::path("/bin") / tool, programs / tool);
  }
  const Path path(programs.path().string());
  const std::string missing = thrown_by([&] { make_figure().write(folder.path(), "picture"); });
  BOOST_TEST(contains(missing, "picture.svg"));
  BOOST_TEST(contains(missing, "not found"));

  programs.write("gnuplot", "#!/bin/sh\nexit 7\n");
  std::filesystem::permissions(programs / "gnuplot", std::filesystem::perms::owner_all);
  const std::string early = thrown_by([&] { make_figure().write(folder.path(), "picture"); });
  BOOST_TEST(contains(early, "exit code 7"));
  BOOST_TEST(folder.entries() == 0);
}
