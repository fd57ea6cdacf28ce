#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "reprise/base/constants.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/toml_reader.hpp"
#include "reprise/study/problem_file.hpp"
#include "reprise/study/sweep_study.hpp"
#include "running.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using namespace reprise::app;
using reprise::test::example;

namespace {

constexpr const char* legs =
    "[manipulator]\n"                                                            // 1
    "name = 'm'\n"                                                               // 2
    "[[manipulator.leg]]\nbase = [0, 0]\nplatform = [0, 1]\nlength = [1, 2]\n"   // 3 to 6
    "[[manipulator.leg]]\nbase = [3, 0]\nplatform = [1, 0]\nlength = [1, 2]\n";  // 7 to 10

constexpr const char* design =
    "[manipulator]\nname = 'm'\ndesign = [-1, 0, 1, 2, 1]\nlength = [[1, 2], [1, 2], [1, 2]]\n";  // 1 to 4

constexpr const char* rest =
    "[workspace]\nkind = 'circle'\nradius = 1\ncentre = [0, 0]\n[orientations]\nslices_deg = [0]\n";  // 6 lines

std::string manipulator_error(const std::string& content) {
  const TemporaryFolder folder;
  return thrown_by([&] { read_manipulator(folder.write("m.toml", content)); });
}

std::string problem_error(const std::string& content) {
  const TemporaryFolder folder;
  return thrown_by([&] { read_problem(folder.write("m.toml", content)); });
}

void check(const std::string& message, int line, const std::string& part) {
  BOOST_TEST(contains(message, "m.toml, line " + std::to_string(line) + ": "), message);
  BOOST_TEST(contains(message, part), message << " should contain " << part);
  BOOST_TEST(message.ends_with('.'), message);
  BOOST_TEST(!contains(message, "\n"), message);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  BOOST_REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The same from its last occurrence on.
std::string replaced_last(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.rfind(from);
  BOOST_REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

void check_same(const Manipulator& one, const Manipulator& other) {
  BOOST_TEST(one.name() == other.name());
  BOOST_REQUIRE_EQUAL(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    BOOST_TEST((one.leg(i).base_joint == other.leg(i).base_joint));
    BOOST_TEST((one.leg(i).platform_joint == other.leg(i).platform_joint));
    BOOST_TEST(one.leg(i).length.lower == other.leg(i).length.lower);
    BOOST_TEST(one.leg(i).length.upper == other.leg(i).length.upper);
    for (const auto member : {&Leg::base_angle, &Leg::platform_angle}) {
      const std::optional<Interval>& a = one.leg(i).*member;
      const std::optional<Interval>& b = other.leg(i).*member;
      BOOST_REQUIRE_EQUAL(a.has_value(), b.has_value());
      if (!a) continue;
      BOOST_TEST(std::abs(a->lower - b->lower) < 1e-14);
      BOOST_TEST(std::abs(a->upper - b->upper) < 1e-14);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_file_may_take_its_manipulator_and_its_workspace_from_others) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& content) { folder.write(name, content); };
  const std::string polygon = "[workspace]\nname = 'W'\nkind = 'polygon'\nvertices = [[4, 4], [8, 4], [6, 10]]\n";
  write("base.toml", std::string(design) + polygon + "scale = 2\n[orientations]\nslices_deg = [0]\n");
  const auto problem = [&](const std::string& workspace) {
    return read_problem(folder.write("m.toml", "[manipulator]\nfile = 'base.toml'\n[workspace]\nfile = 'base.toml'\n" +
                                                   workspace + "[orientations]\nrange_deg = [-1, 1]\n"));
  };
  const ProblemInput base = read_problem(folder / "base.toml");
  const ProblemInput same = problem("");
  check_same(same.start.manipulator, base.start.manipulator);
  BOOST_TEST(same.start.as_design);
  BOOST_TEST(same.task.prescribed.name() == "W");
  const ProblemInput moved = problem("name = 'V'\ncentre = [1, 2]\nscale = 1\nrotation_deg = 90\n");
  BOOST_TEST(moved.task.prescribed.name() == "V");
  BOOST_TEST((moved.task.prescribed.centre() == Eigen::Vector2d(1.0, 2.0)));
  for (double beta = 0.0; beta < 6.3; beta += 0.1) {
    BOOST_TEST((same.task.prescribed.point(beta) == base.task.prescribed.point(beta)));
    // Half the size, turned by a quarter.
    BOOST_TEST(moved.task.prescribed.radius(beta + 90.0 * degree) == 0.5 * base.task.prescribed.radius(beta),
               boost::test_tools::tolerance(1e-12));
  }

  check(thrown_by([&] { problem("kind = 'circle'\n"); }), 5, "workspace has an unknown key 'kind'");
  write("chain.toml", "[manipulator]\nfile = 'base.toml'\n");
  write("own.toml", "[manipulator]\nname = 'x'\nfile = 'base.toml'\n");
  const auto from = [&](const std::string& file) {
    return thrown_by([&] { read_manipulator(folder.write("m.toml", "[manipulator]\nfile = '" + file + "'\n")); });
  };
  BOOST_TEST(contains(from("none.toml"), "none.toml"));
  BOOST_TEST(contains(from("chain.toml"), "chain.toml, line 2: manipulator.file"), from("chain.toml"));
  BOOST_TEST(contains(thrown_by([&] { read_manipulator(folder / "own.toml"); }), "unknown key 'name'"));
}

BOOST_AUTO_TEST_CASE(every_example_is_read_and_written_back) {
  const TemporaryFolder folder;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(REPRISE_SOURCE) / "examples")) {
    BOOST_TEST_CONTEXT(entry.path()) {
      if (contains(read_file(entry.path()), "[sweep]")) {
        BOOST_TEST(reprise::read_study(entry.path()).size() > 1);
        continue;
      }
      const ManipulatorInput input = read_manipulator(entry.path());
      const ManipulatorInput again = read_manipulator(folder.write("again.toml", to_toml(input)));
      check_same(again.manipulator, input.manipulator);
      BOOST_TEST(again.as_design == input.as_design);
      BOOST_TEST(again.unit == input.unit);
      BOOST_TEST((again.conditioning.normalisation == input.conditioning.normalisation));
      BOOST_TEST((again.conditioning.characteristic_length == input.conditioning.characteristic_length));
      if (contains(read_file(entry.path()), "[workspace]")) BOOST_CHECK_NO_THROW(read_problem(entry.path()));
    }
  }
}

BOOST_AUTO_TEST_CASE(names_with_quotes_survive) {
  const TemporaryFolder folder;
  const std::string content = replaced(legs, "'m'", "\"a \\\"b\\\" \\\\ c\"\nunit = '\"'");
  const ManipulatorInput input = read_manipulator(folder.write("m.toml", content));
  BOOST_TEST(input.manipulator.name() == "a \"b\" \\ c");
  const ManipulatorInput again = read_manipulator(folder.write("again.toml", to_toml(input)));
  check_same(again.manipulator, input.manipulator);
  BOOST_TEST(again.unit == "\"");
}

BOOST_AUTO_TEST_CASE(wrong_manipulators_are_named_with_line_and_key) {
  BOOST_TEST(manipulator_error(legs) == "");
  BOOST_TEST(manipulator_error(design) == "");
  check(manipulator_error(""), 1, "empty");
  check(manipulator_error(" \n\n"), 1, "empty");
  check(manipulator_error("# nothing\n"), 1, "no key 'manipulator'");
  check(manipulator_error("manipulator = 3"), 1, "manipulator is 3, but must be a table");
  check(manipulator_error("[manipulator"), 1, "");
  check(manipulator_error(std::string(legs) + "x = 1"), 11, "unknown key 'x'");
  check(manipulator_error("y = 1\n" + std::string(legs)), 1, "the file has an unknown key 'y'");
  check(manipulator_error(replaced(legs, "name = 'm'", "")), 1, "manipulator has no key 'name'");
  check(manipulator_error(replaced(legs, "'m'", "'m'\nunit = ''")), 3, "manipulator.unit is '', but must be a text");
  check(manipulator_error(replaced(legs, "'m'", "'m'\nunit = 'a unit with a long name'")), 3, "1 to 20 bytes");
  check(manipulator_error(replaced(legs, "'m'", "'m'\nunit = 3")), 3, "must be a text");
  check(manipulator_error(replaced(legs, "'m'", "''")), 2, "name");
  check(manipulator_error(replaced(legs, "'m'", "\"two\\nlines\"")), 2, "on one line");
  check(manipulator_error(replaced(legs, "'m'", "7")), 2, "name is 7, but must be a text");
  check(manipulator_error("[manipulator]\nname = 'm'\n"), 1, "neither a key 'design' nor tables");
  check(manipulator_error(replaced(legs, "name = 'm'", "name = 'm'\ndesign = [1, 2, 3, 4, 5]")), 3,
        "both manipulator.design and manipulator.leg are given");
  const std::string one_leg = std::string(legs).substr(0, std::string(legs).rfind("[[manipulator.leg]]"));
  check(manipulator_error(one_leg), 3, "has 1 leg, but the number of legs must be from 2");
  check(manipulator_error("[manipulator]\nname = 'm'\nleg = 3"), 3, "manipulator.leg");
  check(manipulator_error("[manipulator]\nname = 'm'\nleg = []"), 3, "manipulator.leg");
  check(manipulator_error("[manipulator]\nname = 'm'\nleg = [1]"), 3, "manipulator.leg");
  const auto second = [](const std::string& length) { return replaced_last(legs, "[1, 2]", length); };
  check(manipulator_error(second("[1]")), 10, "manipulator.leg 2.length must be a list of 2 numbers");
  check(manipulator_error(second("[1, 2, 3]")), 10, "2 numbers");
  check(manipulator_error(second("['a', 2]")), 10, "'a'");
  check(manipulator_error(second("[2, 1]")), 10, "minimum <= maximum");
  check(manipulator_error(second("[-1, 1]")), 10, "-1");
  check(manipulator_error(second("[0, 0]")), 10, "maximum above 0");
  check(manipulator_error(second("[1, nan]")), 10, "nan");
  check(manipulator_error(second("[1, inf]")), 10, "inf");
  check(manipulator_error(second("[1, 1e300]")), 10, "at most 1000000");
  check(manipulator_error(second("[1, 2]\nbase_angle_deg = [3, 3]")), 11, "base_angle_deg");
  check(manipulator_error(second("[1, 2]\nbase_angle_deg = [30, 10]")), 11, "base_angle_deg");
  check(manipulator_error(second("[1, 2]\nplatform_angle_deg = [0, 360]")), 11, "full turn");
  check(manipulator_error(second("[1, 2]\nlength = [1, 2]")), 11, "");
  check(manipulator_error(replaced(legs, "[3, 0]", "[3, -inf]")), 8, "manipulator.leg 2.base");
  check(manipulator_error(replaced(legs, "[3, 0]", "3")), 8, "manipulator.leg 2.base");
  check(manipulator_error(replaced(legs, "'m'", "'m'\nnormalisation = 'other'")), 3, "'homogeneous' or 'printed'");
  check(manipulator_error(replaced(legs, "'m'", "'m'\ncharacteristic_length = 0")), 3, "above 0");
  check(manipulator_error(replaced(design, "[-1, 0, 1, 2, 1]", "[1, 2]")), 3, "5 numbers");
  check(manipulator_error(replaced(design, "[1, 2], [1, 2]]", "[1, 2]]")), 4, "3 pairs");
  check(manipulator_error(replaced(design, "[1, 2], [1, 2]]", "[2, 1], [1, 2]]")), 4, "the one of leg 2 is [2, 1]");
  const TemporaryFolder folder;
  BOOST_TEST(contains(thrown_by([&] { read_manipulator(folder / "none.toml"); }), "none.toml"));
  BOOST_TEST(thrown_by([&] { read_manipulator(folder.path()); }) ==
             folder.path().string() + " is a folder, but must be a file.");
  BOOST_TEST(contains(thrown_by([] { read_manipulator("/dev/zero"); }), "longer than"));
}

BOOST_AUTO_TEST_CASE(wrong_problems_are_named_with_line_and_key) {
  const std::string good = std::string(design) + rest;
  BOOST_TEST(problem_error(good) == "");
  check(problem_error(design), 1, "no key 'workspace'");
  check(problem_error(replaced(good, "[orientations]\nslices_deg = [0]\n", "")), 1, "no key 'orientations'");
  check(problem_error(std::string(legs) + rest), 1, "[design]");
  const auto with_circle = [&](const std::string& lines) {
    return problem_error(replaced(good, "kind = 'circle'\nradius = 1\ncentre = [0, 0]", lines));
  };
  check(with_circle("kind = 'blob'\ncentre = [0, 0]"), 6, "'blob'");
  check(with_circle("kind = 'circle'\nradius = -1\ncentre = [0, 0]"), 7, "workspace.radius is -1");
  check(with_circle("kind = 'circle'\nradius = 1e7\ncentre = [0, 0]"), 5, "outline");
  check(with_circle("kind = 'circle'\nradius = 1"), 5, "no key 'centre'");
  check(with_circle("kind = 'circle'\nradius = 1\ncentre = [0, 0]\nscale = 0"), 9, "workspace.scale");
  check(with_circle("kind = 'circle'\nradius = 1\ncentre = [0, 0]\nwidth = 2"), 9, "unknown key 'width'");
  check(with_circle("kind = 'superellipse'\nsemi_axes = [1, 1]\nexponent = 1e-3\ncentre = [0, 0]"), 5, "outline");
  // A bow tie, a repeated vertex, an outline that its centroid does not see, and too few vertices.
  check(with_circle("kind = 'polygon'\nvertices = [[0, 0], [1, 1], [1, 0], [0, 1]]"), 7, "does not cross itself");
  check(with_circle("kind = 'polygon'\nvertices = [[0, 0], [1, 0], [1, 0], [0, 1]]"), 7, "2 and 3 are the same");
  check(with_circle("kind = 'polygon'\nvertices = [[0, 0], [4, 0], [4, 4], [3, 4], [3, 1], [0, 1]]"), 5, "centre");
  check(with_circle("kind = 'polygon'\nvertices = [[0, 0], [1, 0]]"), 7, "3 to 1000");
  check(with_circle("kind = 'polygon'\nvertices = [[0, 0], [1, 0], [2, 0]]"), 5, "");
  check(with_circle("kind = 'polar_table'\ncentre = [0, 0]\nangles_deg = [0, 90]\nradii = [1, 1]"), 5, "at least 3");
  const auto with_slices = [&](const std::string& lines) {
    return problem_error(replaced(good, "slices_deg = [0]", lines));
  };
  check(with_slices(""), 9, "either");
  check(with_slices("slices_deg = [0]\nrange_deg = [0, 1]"), 9, "either");
  check(with_slices("slices_deg = []"), 10, "1 to 100");
  check(with_slices("slices_deg = [0, 5, 0]"), 10, "without repeats");
  check(with_slices("range_deg = [5, -5]"), 10, "range_deg");
  check(with_slices("range_deg = [-180, 180]"), 10, "full turn");
  const auto with_design = [&](const std::string& lines) { return problem_error(good + "[design]\n" + lines); };
  check(with_design(""), 11, "no key 'free'");
  check(with_design("free = []"), 12, "at least one");
  check(with_design("free = ['base_1_x']"), 12, "'base_1_x' is not a design variable");
  check(with_design("free = ['x_C', 'base']"), 12, "x_C twice");
  check(with_design("free = ['x_C']\nwithin = 0"), 13, "within");
  check(with_design("free = ['x_C']\n[design.bounds]\nr = [0, 1]"), 14, "not free");
  check(with_design("free = ['x_C']\n[design.bounds]\nq = [0, 1]"), 14, "'q' is not a design variable");
  check(with_design("free = ['x_C']\n[design.bounds]\nx_C = [1, 0]"), 14, "lower at most upper");
  check(with_design("free = ['x_C']\n[design.bounds]\nx_C = [0, 1]"), 14, "own -1 between");
  check(with_design("free = ['length_1_min']"), 11, "needs bounds");
  check(with_design("free = ['length_1_min']\n[design.bounds]\nlength_1_min = [0, 1.5]"), 13, "above 0");
  check(with_design("free = ['length_1_min']\n[design.bounds]\nlength_1_min = [1, 2.5]"), 13, "must not exceed");
  check(with_design("free = ['length_1', 'length_1_max']\n[design.bounds]\nlength_1 = [0.5, 1.5]\n"
                    "length_1_max = [1.5, 3]"),
        13, "moves both");
}

BOOST_AUTO_TEST_CASE(every_number_may_be_an_expression) {
  const TemporaryFolder folder;
  const ProblemInput problem = read_problem(folder.write("p.toml", R"toml(
[manipulator]
name = "m"
unit = "mm"
characteristic_length = "10*sqrt(3)/3"
[[manipulator.leg]]
base = ["-5*sqrt(3)", "pi/6"]
platform = ["2*cos(120)", "2*sin(120)"]
length = ["1/3", "sqrt(2) + sqrt(3)"]
base_angle_deg = ["-90/2", "180 - 60"]
platform_angle_deg = ["-(30 + 15)", 45]
[[manipulator.leg]]
base = ["1 - 0.5", 0]
platform = [0, "-2*(3 - 1)"]
length = [0, "9/4"]
[workspace]
kind = "polar_table"
angles_deg = ["360/3", "2*360/3", "360"]
radii = ["sqrt(4)", "2/2", 1]
centre = ["1/4", "-1/4"]
scale = "1/7"
rotation_deg = "90/4"
[orientations]
slices_deg = ["-10/2", "5"]
[design]
free = ["base_2_x"]
within = "sqrt(2)/2"
[design.bounds]
base_2_x = ["-1/3", "1/2 + 1/4"]
)toml"));
  const double root = std::sqrt(3.0);
  BOOST_TEST(problem.start.unit == "mm");
  BOOST_TEST(*problem.start.conditioning.characteristic_length == 10.0 * root / 3.0);
  const Leg& leg = problem.start.manipulator.leg(0);
  BOOST_TEST((leg.base_joint == Eigen::Vector2d(-5.0 * root, pi / 6.0)));
  BOOST_TEST((leg.platform_joint - Eigen::Vector2d(-1.0, root)).norm() < 1e-15);
  BOOST_TEST(leg.length.lower == 1.0 / 3.0);
  BOOST_TEST(leg.length.upper == std::numbers::sqrt2 + root);
  BOOST_TEST(leg.base_angle->lower == -45.0 * degree);
  BOOST_TEST(leg.base_angle->upper == 120.0 * degree);
  BOOST_TEST(leg.platform_angle->lower == -45.0 * degree);
  BOOST_TEST((problem.start.manipulator.leg(1).platform_joint == Eigen::Vector2d(0.0, -4.0)));
  BOOST_TEST((problem.task.prescribed.centre() == Eigen::Vector2d(0.25, -0.25)));
  BOOST_TEST(problem.task.prescribed.placement().scale == 1.0 / 7.0);
  BOOST_TEST(problem.task.prescribed.placement().rotation == 22.5 * degree);
  BOOST_TEST(problem.task.orientations[0].lower == -5.0 * degree);
  BOOST_TEST(problem.task.designs.lower()[0] == -1.0 / 3.0);
  BOOST_TEST(problem.task.designs.upper()[0] == 0.75);
  // The thesis's form.
  const Manipulator thesis =
      read_manipulator(
          folder.write("d.toml", replaced(replaced(design, "[-1, 0, 1, 2, 1]", "['-1', 0, '2/2', '4/2', '3 - 2']"),
                                          "[[1, 2]", "[['sqrt(1)', '1 + 1']")))
          .manipulator;
  check_same(thesis, read_manipulator(folder.write("e.toml", design)).manipulator);
}

BOOST_AUTO_TEST_CASE(expressions_that_are_wrong_are_named_with_line_and_key) {
  const auto with_length = [](const std::string& length) {
    return manipulator_error(replaced_last(legs, "[1, 2]", length));
  };
  check(
      with_length("[1, '10*sqr(3)']"), 10,
      "manipulator.leg 2.length must be a list of 2 numbers; one is '10*sqr(3)', which cannot be read at character 4 "
      "('sqr'), but must be a number of at least 0 and at most 1000000 (an expression may have + - * / ( ), sqrt, pi, "
      "and sin and cos of degrees)");
  check(with_length("[1, 'sqrt(3)-5']"), 10, "one is 'sqrt(3)-5', which is -3.26794919243112");
  check(with_length("[1, '1/0']"), 10, "one is '1/0', which has no finite value, but must be");
  check(with_length("[1, 'sqrt(-1)']"), 10, "which has no finite value");
  check(with_length("[1, '']"), 10, "one is '', which is empty");
  check(with_length("[1, '1e400']"), 10, "cannot be read at character 1 ('1e400')");
  check(with_length("[1, 1e400]"), 10, "1e400");
  check(with_length("[1, '" + std::string(900, '(') + "2']"), 10, "a parenthesis that is not closed");
  check(with_length("[1, '" + std::string(5000, '2') + "']"), 10, "longer than 1000 characters");
  check(with_length("[1, \"2\\n3\"]"), 10, "one is a text that cannot be read at character 2");
  check(manipulator_error(replaced(legs, "'m'", "'m'\ncharacteristic_length = 'sin(180)'")), 3,
        "manipulator.characteristic_length is 'sin(180)', which is 0, but must be a number above 0");
}

BOOST_AUTO_TEST_CASE(misspelt_keys_are_named_before_missing_ones) {
  check(manipulator_error(replaced(legs, "base", "bsae")), 4,
        "manipulator.leg 1 has an unknown key 'bsae' (did you mean 'base'?)");
  check(manipulator_error("[[manipulator.legs]]\nbase = [0, 0]\n"), 1,
        "manipulator has an unknown key 'legs' (did you mean 'leg'?)");
  check(manipulator_error(replaced(legs, "name", "nome")), 2, "(did you mean 'name'?)");
  check(manipulator_error(replaced(legs, "[manipulator]", "[manipulators]")), 1, "(did you mean 'manipulator'?)");
  check(manipulator_error(replaced(legs, "'m'", "'m'\nlimits = 2")), 3,
        "manipulator has an unknown key 'limits' (known are name, unit, normalisation, characteristic_length, leg, "
        "design, "
        "length)");
  const auto with_rest = [](const std::string& from, const std::string& to) {
    return problem_error(std::string(design) + replaced(rest, from, to));
  };
  check(with_rest("radius", "radus"), 7, "workspace has an unknown key 'radus' (did you mean 'radius'?)");
  check(with_rest("centre", "center"), 8, "(did you mean 'centre'?)");
  check(with_rest("kind", "kid"), 6, "(did you mean 'kind'?)");
  check(with_rest("'circle'", "'cirle'"), 6,
        "workspace.kind is 'cirle', but must be one of superellipse, ellipse, "
        "quarter_ellipses, circle, rectangle, polygon, polar_table (did you mean "
        "'circle'?)");
  check(with_rest("radius", "width"), 7,
        "workspace has an unknown key 'width' (known are kind, radius, name, centre, "
        "scale, rotation_deg, source, certainty)");
  check(with_rest("slices_deg", "slices"), 10, "orientations has an unknown key 'slices' (did you mean 'slices_deg'?)");
  check(with_rest("[orientations]", "[orientation]"), 9,
        "the file has an unknown key 'orientation' (did you mean 'orientations'?)");
  check(problem_error(std::string(design) + rest + "[design]\nfrre = ['base']"), 12, "(did you mean 'free'?)");
  check(problem_error(std::string(design) + rest + "[design]\nfree = ['x_c']"), 12, "(did you mean 'x_C'?)");
}

// A key that is allowed but not read would be ignored: a value that no key takes must be refused, whatever the key.
BOOST_AUTO_TEST_CASE(every_key_is_read) {
  const auto refused = [](const std::string& content, const std::string& key) {
    const std::string message = problem_error(content);
    BOOST_TEST(contains(message, key), key << ": " << message);
    BOOST_TEST(!contains(message, "unknown key"), message);
  };
  const std::string wrong = " = 1979-05-27\n";
  const std::string general = std::string(legs) + rest + "[design]\nfree = ['base']\n";
  for (const std::string key : {"unit", "normalisation", "characteristic_length", "design", "length"}) {
    refused(replaced(general, "name = 'm'\n", "name = 'm'\n" + key + wrong), key);
  }
  refused(replaced(general, "name = 'm'", "name" + wrong), "name");
  for (const std::string key : {"base", "platform", "length"}) {
    const std::size_t from = general.find(key + " = ");
    std::string content = general;
    refused(content.replace(from, content.find('\n', from) + 1 - from, key + wrong), key);
  }
  for (const std::string key : {"base_angle_deg", "platform_angle_deg"}) {
    refused(replaced(general, "length = [1, 2]\n", "length = [1, 2]\n" + key + wrong), key);
  }
  for (const std::string key : {"name", "scale", "rotation_deg"}) {
    refused(replaced(general, "radius = 1\n", "radius = 1\n" + key + wrong), key);
  }
  refused(replaced(general, "centre = [0, 0]\n", "centre" + wrong), "centre");
  refused(replaced(general, "slices_deg = [0]\n", "slices_deg" + wrong), "slices_deg");
  refused(replaced(general, "slices_deg = [0]\n", "range_deg" + wrong), "range_deg");
  refused(general + "within" + wrong, "within");
  refused(general + "bounds" + wrong, "bounds");
  refused(replaced(general, "free = ['base']\n", "free" + wrong), "free");
  const std::vector<std::pair<std::string, std::vector<std::string>>> kinds{
      {"superellipse", {"semi_axes = [1, 1]", "exponent = 2"}},
      {"ellipse", {"semi_axes = [1, 1]"}},
      {"quarter_ellipses", {"right = 1", "up = 1", "left = 1", "down = 1"}},
      {"circle", {"radius = 1"}},
      {"rectangle", {"width = 1", "height = 1"}},
      {"polygon", {"vertices = [[0, 0], [1, 0], [0, 1]]"}},
      {"polar_table", {"angles_deg = [0, 90, 180]", "radii = [1, 1, 1]"}}};
  for (const auto& [kind, lines] : kinds) {
    for (const std::string& chosen : lines) {
      std::string shape = "kind = '" + kind + "'\n";
      const std::string key = chosen.substr(0, chosen.find(' '));
      for (const std::string& line : lines) shape += line == chosen ? key + wrong : line + "\n";
      refused(replaced(general, "kind = 'circle'\nradius = 1\n", shape), key);
    }
  }
}

// The parser's own messages and a file's name may hold line breaks.
BOOST_AUTO_TEST_CASE(messages_have_one_line) {
  check(manipulator_error("a\n= n"), 1, "");
  for (const std::string end :
       {"= n", "a = n", "a = [1", "a = '", "a = \"\\q\"", "[a", "a", "a.", "a = 1e", "a = 1 2"}) {
    const std::string message = manipulator_error("# a comment\n" + end);
    BOOST_TEST(!contains(message, "\n"), message);
    BOOST_TEST(message.ends_with('.'), message);
    BOOST_TEST(!message.ends_with(".."), message);
  }
}

BOOST_AUTO_TEST_CASE(free_variables_move_what_they_name) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& lines) {
    return read_problem(folder.write("p.toml", std::string(legs) + rest + "[design]\n" + lines));
  };
  const ProblemInput problem = read(
      "free = ['platform_2', 'base_1_y', 'length_1', 'length_2_max']\nwithin = 0.5\n"
      "[design.bounds]\nlength_1 = [0.5, 1.5]\nlength_2_max = [1.5, 3]\nbase_1_y = [-2, 3]");
  const DesignSpace& designs = problem.task.designs;
  const std::vector<std::string> names{"base_1_y", "length_1", "platform_2_x", "platform_2_y", "length_2_max"};
  BOOST_TEST(designs.names() == names, boost::test_tools::per_element());
  BOOST_TEST((problem.design == (Eigen::VectorXd(5) << 0.0, 1.0, 1.0, 0.0, 2.0).finished()));
  BOOST_TEST((designs.lower() == (Eigen::VectorXd(5) << -2.0, 0.5, 0.5, -0.5, 1.5).finished()));
  BOOST_TEST((designs.upper() == (Eigen::VectorXd(5) << 3.0, 1.5, 1.5, 0.5, 3.0).finished()));
  check_same(designs.manipulator(problem.design), problem.start.manipulator);
  const Manipulator changed = designs.manipulator((Eigen::VectorXd(5) << 0.25, 1.25, 1.5, -0.5, 2.5).finished());
  BOOST_TEST((changed.leg(0).base_joint == Eigen::Vector2d(0.0, 0.25)));
  BOOST_TEST(changed.leg(0).length.lower == 1.25);
  BOOST_TEST(changed.leg(0).length.upper == 2.25);
  BOOST_TEST((changed.leg(1).platform_joint == Eigen::Vector2d(1.5, -0.5)));
  BOOST_TEST(changed.leg(1).length.lower == 1.0);
  BOOST_TEST(changed.leg(1).length.upper == 2.5);
}

BOOST_AUTO_TEST_CASE(a_polygon_without_a_centre_is_where_its_vertices_are) {
  const TemporaryFolder folder;
  const ProblemInput problem = read_problem(folder.write(
      "p.toml", std::string(design) +
                    "[workspace]\nkind = 'polygon'\nvertices = [[4, 1], [6, 1], [6, 5], [4, 5]]\nscale = 0.5\n"
                    "[orientations]\nrange_deg = [-90, 45]\n"));
  const PrescribedWorkspace& workspace = problem.task.prescribed;
  BOOST_TEST((workspace.centre() - Eigen::Vector2d(5.0, 3.0)).norm() < 1e-14);
  BOOST_TEST((workspace.point(0.0) - Eigen::Vector2d(5.5, 3.0)).norm() < 1e-14);
  BOOST_TEST(problem.task.orientations.front().lower == -0.5 * pi);
}
