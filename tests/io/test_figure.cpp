#include <unistd.h>

#include <array>
#include <boost/process/search_path.hpp>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "reprise/io/figure.hpp"
#include "reprise/io/files.hpp"
#include "temporary_folder.hpp"

using namespace reprise;

namespace {

Figure make_figure() {
  Figure figure(300, 200);
  const std::string data = figure.add_data({{0, 0}, {1, 1}, {}, {2, 0}, {3, 1}});
  figure.add("plot " + data + " using 1:2 with lines title " + gnuplot_string("it's"));
  return figure;
}

/// A variable of the environment for the time of a test; an empty value takes it away.
class Variable {
 public:
  Variable(std::string name, const std::string& value) : name_(std::move(name)) {
    if (const char* old = std::getenv(name_.c_str())) old_ = old;
    set(value.empty() ? std::nullopt : std::optional(value));
  }
  ~Variable() { set(old_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    value ? ::setenv(name_.c_str(), value->c_str(), 1) : ::unsetenv(name_.c_str());
  }

  std::string name_;
  std::optional<std::string> old_;
};

class Path : public Variable {
 public:
  explicit Path(const std::string& value) : Variable("PATH", value) {}
};

const std::string gnuplot = boost::process::search_path("gnuplot").string();

/// A program named gnuplot that does what these commands say.
void make_gnuplot(const TemporaryFolder& folder, const std::string& commands) {
  const auto file = folder.write("gnuplot", "#!/bin/sh\n" + commands + "\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

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
  const auto message = [&] { return thrown_by([&] { make_figure().write(folder.path(), "picture"); }); };
  {
    const Path path(programs.path().string());
    BOOST_TEST(contains(message(), "picture.svg"));
    BOOST_TEST(contains(message(), "not installed"));
  }
  const Path path(programs.path().string() + ":/usr/bin:/bin");
  make_gnuplot(programs, "exit 7");
  BOOST_TEST(contains(message(), "exit code 7"));
  make_gnuplot(programs, "kill -9 $$");
  BOOST_TEST(contains(message(), "signal 9"));
  make_gnuplot(programs, "echo 'no such thing' >&2; exit 1");
  BOOST_TEST(contains(message(), "no such thing"));
  BOOST_TEST(folder.entries() == 0);
}

BOOST_AUTO_TEST_CASE(a_picture_without_its_end_is_an_error_and_keeps_the_old_one) {
  const TemporaryFolder folder;
  for (const std::string& extension : Figure::extensions()) {
    const auto file = folder.write("picture" + extension, "old");
    const TemporaryFolder programs;
    make_gnuplot(programs, gnuplot + " \"$@\" | head -c 200");
    const Path path(programs.path().string() + ":/usr/bin:/bin");
    BOOST_TEST(contains(thrown_by([&] { make_figure().write(file); }), "only a part"));
    BOOST_TEST(read_file(file) == "old");
  }
  BOOST_TEST(folder.entries() == 3);
}

BOOST_AUTO_TEST_CASE(a_gnuplot_that_only_warns_has_drawn) {
  const TemporaryFolder folder;
  const TemporaryFolder programs;
  make_gnuplot(programs, "echo 'warning: no font' >&2; exec " + gnuplot + " \"$@\"");
  make_figure().write(folder / "without.svg");
  const Path path(programs.path().string() + ":/usr/bin:/bin");
  make_figure().write(folder / "with.svg");
  BOOST_TEST(read_file(folder / "with.svg") == read_file(folder / "without.svg"));
}

BOOST_AUTO_TEST_CASE(a_gnuplot_that_hangs_is_given_up_with_its_children) {
  const TemporaryFolder folder;
  const TemporaryFolder programs;
  std::array<int, 2> held{};  // is at its end when no process holds it open
  BOOST_REQUIRE(::pipe(held.data()) == 0);
  make_gnuplot(programs, "sleep 1000 & sleep 1000");
  const Path path(programs.path().string() + ":/usr/bin:/bin");
  Figure figure = make_figure();
  figure.limit_time(std::chrono::milliseconds(200));
  BOOST_TEST(contains(thrown_by([&] { figure.write(folder / "picture.svg"); }), "did not end within 0.2 s"));
  ::close(held[1]);
  char byte = 0;
  BOOST_TEST(::read(held[0], &byte, 1) == 0);
  ::close(held[0]);
  BOOST_TEST(folder.entries() == 0);
}

// What is called a command in a name would be one where a shell, or gnuplot, reads it.
BOOST_AUTO_TEST_CASE(names_are_never_commands) {
  const TemporaryFolder folder;
  const std::string made = (folder / "made").string();
  for (const std::string& name :
       {"a\nsystem 'touch " + made.substr(made.rfind('/') + 1) + "'", std::string("$(touch made)"),
        std::string("a'; touch made; '"), std::string("| touch made")}) {
    std::filesystem::create_directory(folder / name);
    make_figure().write(folder.path() / name / "picture.svg");
    BOOST_TEST(std::filesystem::exists(folder.path() / name / "picture.svg"));
  }
  BOOST_TEST(folder.entries() == 4);
  BOOST_TEST(!std::filesystem::exists("made"));
}

BOOST_AUTO_TEST_CASE(pictures_do_not_depend_on_the_environment) {
  Figure figure = make_figure();
  figure.add("set title '\u03ba at 5\u00b0'\nreplot");
  const TemporaryFolder folder;
  const auto pictures = [&] {
    figure.write(folder.path(), "picture");
    return read_file(folder / "picture.svg") + read_file(folder / "picture.png");
  };
  const std::string usual = pictures();
  BOOST_TEST(contains(usual, "\u03ba at 5\u00b0"));
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{{"LANG", ""},
                                                                                    {"LC_ALL", "C"},
                                                                                    {"LC_ALL", "tr_TR.UTF-8"},
                                                                                    {"HOME", ""},
                                                                                    {"HOME", "/nonexistent"},
                                                                                    {"TERM", ""},
                                                                                    {"TMPDIR", "/nonexistent"},
                                                                                    {"GNUTERM", "nonsense"},
                                                                                    {"FONTCONFIG_FILE", "/dev/null"}}) {
    BOOST_TEST_CONTEXT(name << "=" << value) {
      const Variable variable(name, value);
      BOOST_TEST((pictures() == usual));
      const char* after = std::getenv(name.c_str());
      BOOST_TEST((after == nullptr ? "" : after) == value);  // a library leaves its program's environment alone
    }
  }
}
