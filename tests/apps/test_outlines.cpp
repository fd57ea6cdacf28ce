#include <boost/test/unit_test.hpp>
#include <cmath>

#include "reprise/study/problem_file.hpp"
#include "temporary_folder.hpp"

using namespace reprise;

namespace {

/// Seven lines, then the table [workspace] from line 8 on.
constexpr const char* head =
    "[manipulator]\nname = 'm'\ndesign = [-1, 0, 1, 2, 1]\nlength = [[1, 2], [1, 2], [1, 2]]\n"
    "[orientations]\nslices_deg = [0]\n[workspace]\n";

ProblemInput read_one(const TemporaryFolder& folder, const std::string& body) {
  return read_problem(folder.write("w.toml", head + body));
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_kind_of_outline_can_be_read) {
  const TemporaryFolder folder;
  const auto radius = [&](const std::string& body) { return read_one(folder, body).task.prescribed.radius(0.0); };
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
      const TemporaryFolder folder;
      const std::string message = thrown_by([&] { read_one(folder, body); });
      BOOST_TEST(contains(message, "w.toml, line " + line + ":"), message);
      BOOST_TEST(contains(message, part), message);
    }
  };
  check("kind = 'blob'", "8", "'blob', but must be one of superellipse");
  check("kind = 3", "8", "workspace.kind is 3, but must be a text");
  check(circle, "7", "no key 'radius'");
  check(circle + "radius = 'one'", "10", "workspace.radius is 'one', which cannot be read at character 1");
  check(circle + "radius = 'sqrt(-1)'", "10", "workspace.radius is 'sqrt(-1)', which has no finite value, but must be");
  check(circle + "radius = 1\nraduis = 2", "11", "unknown key 'raduis'");
  check(circle + "radius = -1", "10", "-1");
  check(circle + "radius = nan", "10", "nan");
  check("kind = 'circle'\nradius = 1\ncentre = [0]", "10", "centre must be a list of 2 numbers");
  check(circle + "radius = ", "10", "");
  check("kind = 'polygon'\ncentre = [0, 0]\nvertices = [[1, 1], [2]]", "10", "2 numbers");
}
