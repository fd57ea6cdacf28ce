#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "chapter/data_files.hpp"
#include "frame/source_tree.hpp"
#include "reprise/io/table.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using namespace reprise::experiments;

namespace {

constexpr const char* manipulator =
    "[manipulators.M1]\ndesign = [-1.0, 0, 1, 2, 1]\nlength = [[\"sqrt(2)\", 2], [1, 2], [1.0, \"sqrt(3)\"]]\n";

std::string workspace(const std::string& body) { return "[workspaces.W]\n" + body; }

SourcedWorkspace read_one(const TemporaryFolder& folder, const std::string& body, const std::string& synthesis = "SO") {
  return read_prescribed_workspaces(folder.write("w.toml", workspace(body)), synthesis).at(0);
}

std::string workspace_error(const std::string& body) {
  const TemporaryFolder folder;
  return thrown_by([&] { read_one(folder, body); });
}

std::string manipulator_error(const std::string& content) {
  const TemporaryFolder folder;
  return thrown_by([&] { read_manipulator(folder.write("m.toml", content), "M1"); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(manipulators_are_those_of_the_printed_table) {
  const Table printed = read_table(data_folder() / "published" / "table_5_1.csv");
  for (std::size_t row = 0; row < printed.rows(); ++row) {
    const CollinearManipulator read =
        read_manipulator(data_folder() / "manipulators.toml", printed.text(row, "manipulator"));
    BOOST_TEST(read.design.x_c == printed.number(row, "x_C"));
    BOOST_TEST(read.design.y_c == printed.number(row, "y_C"));
    BOOST_TEST(read.design.x_d == printed.number(row, "x_D"));
    BOOST_TEST(read.design.x_e == printed.number(row, "x_E"));
    BOOST_TEST(read.design.r == printed.number(row, "r"));
    BOOST_TEST(read.lengths[0].lower == std::sqrt(2.0));
    BOOST_TEST(read.lengths[1].upper == 2.0);
    BOOST_TEST(read.lengths[2].lower == 1.0);
    BOOST_TEST(read.lengths[2].upper == std::sqrt(3.0));
  }
}

BOOST_AUTO_TEST_CASE(prescribed_workspaces_have_the_size_of_each_table) {
  const auto so = read_prescribed_workspaces(data_folder() / "prescribed_workspaces.toml", "SO");
  const auto mo = read_prescribed_workspaces(data_folder() / "prescribed_workspaces.toml", "MO");
  BOOST_REQUIRE_EQUAL(so.size(), 3U);
  // P1 and P2: a fifth against a 6.25th; P3: a seventh against 0.9 of a seventh.
  for (const auto& [index, ratio] : std::vector<std::pair<std::size_t, double>>{{0, 0.8}, {1, 0.8}, {2, 0.9}}) {
    BOOST_TEST(so[index].workspace.name() == fmt::format("P{}", index + 1));
    BOOST_TEST(contains(so[index].source, "reconstructed"));
    BOOST_TEST(!so[index].certainty.empty());
    BOOST_TEST((so[index].workspace.centre() == Eigen::Vector2d(1.0, 1.5)));
    for (const double beta : {0.0, 1.0, 2.5, 4.0}) {
      BOOST_TEST(mo[index].workspace.radius(beta) == ratio * so[index].workspace.radius(beta),
                 boost::test_tools::tolerance(1e-14));
    }
  }
  BOOST_TEST(so[1].workspace.radius(0.0) == 1.75 / 5.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(every_kind_of_outline_can_be_read) {
  const TemporaryFolder folder;
  const auto radius = [&](const std::string& body) { return read_one(folder, body).workspace.radius(0.0); };
  const std::string centre = "centre = [0, 0]\n";
  const auto tolerance = boost::test_tools::tolerance(1e-14);
  BOOST_TEST(radius(centre + "kind = 'superellipse'\nsemi_axes = [3, 2]\nexponent = 2.5") == 3.0, tolerance);
  BOOST_TEST(radius(centre + "kind = 'ellipse'\nsemi_axes = ['sqrt(2)', 2]") == std::sqrt(2.0), tolerance);
  BOOST_TEST(radius(centre + "kind = 'quarter_ellipses'\nright = 4\nup = 1\nleft = 2\ndown = 3") == 4.0, tolerance);
  BOOST_TEST(radius(centre + "kind = 'circle'\nradius = 5\nscale = 0.5") == 2.5, tolerance);
  BOOST_TEST(radius(centre + "kind = 'rectangle'\nwidth = 6\nheight = 2\nrotation_deg = 90") == 1.0, tolerance);
  BOOST_TEST(radius(centre + "kind = 'polygon'\nvertices = [[1, 1], [-1, 1], [-1, -1], [1, -1]]") == 1.0, tolerance);
  BOOST_TEST(radius(centre + "kind = 'polar_table'\nangles_deg = [0, 120, 240]\nradii = [7, 8, 9]") == 7.0, tolerance);
}

BOOST_AUTO_TEST_CASE(wrong_workspaces_are_named_with_line_and_key) {
  const std::string circle = "kind = 'circle'\ncentre = [0, 0]\n";
  const auto check = [](const std::string& body, const std::string& line, const std::string& part) {
    BOOST_TEST_CONTEXT(body) {
      const std::string message = workspace_error(body);
      BOOST_TEST(contains(message, "w.toml, line " + line + ":"), message);
      BOOST_TEST(contains(message, part), message);
    }
  };
  check("kind = 'blob'", "2", "'blob', but must be one of superellipse");
  check("kind = 3", "2", "workspaces.W.kind is 3, but must be a text");
  check(circle, "1", "no key 'radius'");
  check(circle + "radius = 'one'", "4", "workspaces.W.radius is 'one', which cannot be read at character 1");
  check(circle + "radius = 'sqrt(-1)'", "4",
        "workspaces.W.radius is 'sqrt(-1)', which has no finite value, but must be");
  check(circle + "radius = 1\nraduis = 2", "5", "unknown key 'raduis'");
  check(circle + "radius = -1", "4", "-1");
  check(circle + "radius = nan", "4", "nan");
  check("kind = 'circle'\nradius = 1\ncentre = [0]", "4", "centre must be a list of 2 numbers");
  check(circle + "radius = 1\nscale = 1\nscaled_down_by = { SO = 2 }", "5", "both");
  check(circle + "radius = 1\nscaled_down_by = { MO = 2 }", "5", "no key 'SO'");
  check(circle + "radius = 1\nscaled_down_by = { SO = 0 }", "5", "above 0");
  check(circle + "radius = ", "4", "");
  check("kind = 'polygon'\ncentre = [0, 0]\nvertices = [[1, 1], [2]]", "4", "2 numbers");
}

BOOST_AUTO_TEST_CASE(wrong_manipulators_are_named_with_line_and_key) {
  const TemporaryFolder folder;
  BOOST_TEST(contains(thrown_by([&] { read_manipulator(folder / "none.toml", "M1"); }), "none.toml"));
  BOOST_TEST(manipulator_error(manipulator).empty());
  BOOST_TEST(contains(manipulator_error(""), "m.toml, line 1: the file is empty"));
  BOOST_TEST(contains(manipulator_error("[manipulators.M2]"), "manipulators has no key 'M1'"));
  BOOST_TEST(contains(manipulator_error("[manipulators.M1]\ndesign = [1, 2]"), "line 2"));
  BOOST_TEST(contains(manipulator_error(std::string(manipulator) + "extra = 1"), "unknown key 'extra'"));
  const std::string reversed = "[manipulators.M1]\ndesign = [-1, 0, 1, 2, 1]\nlength = [[2, 1], [1, 2], [1, 2]]\n";
  BOOST_TEST(contains(manipulator_error(reversed), "m.toml, line 1"));
}
