// What synthesize and compare say of a design over the whole workspace and range.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "reprise/io/files.hpp"
#include "reprise/study/problem_file.hpp"
#include "running.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using boost::test_tools::tolerance;
using nlohmann::json;
using reprise::test::run;

namespace {

std::string problem(const std::string& name) {
  return (std::filesystem::path(REPRISE_SOURCE) / "tests/apps/problems" / (name + ".toml")).string();
}

/// The document of a run that ends with this exit code.
json document(std::vector<std::string> arguments, int code = 0) {
  arguments.emplace_back("--json");
  const auto ended = run(arguments);
  BOOST_REQUIRE_MESSAGE(ended.code == code, ended.err);
  return ended.document();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_least_conditioning_of_a_range_is_that_of_all_its_orientations) {
  // No design with the table's own strokes reaches the workspace; longer ones change nothing about its singular poses.
  const TemporaryFolder folder;
  std::string content = read_file(problem("positioning_table"));
  for (std::size_t at = 0; (at = content.find("[150, 250]", at)) != std::string::npos;) {
    content.replace(at, 10, "[150, 320]");
  }
  const json found = document({"synthesize", folder.write("longer.toml", content).string(), "--points", "60"});
  BOOST_TEST(found["start_kappa_inv_min"].get<double>() < 1e-6);
  BOOST_TEST(found["start_kappa_inv_min_bound"].get<double>() == 0.0);
  BOOST_TEST(found["reach_verdict"] == "proved");
  const double bound = found["kappa_inv_min_bound"].get<double>();
  BOOST_TEST(bound > 0.0);
  BOOST_TEST(found["kappa_inv_min"].get<double>() - bound <= 1e-6);
  // The bound against a grid of inside and range.
  const ManipulatorInput design =
      read_manipulator(folder.write("found.toml", found["manipulator_toml"].get<std::string>()));
  double smallest = 1.0;
  for (int i = -12; i <= 12; ++i) {
    for (int j = -8; j <= 8; ++j) {
      for (int k = -10; k <= 10; ++k) {
        const Pose pose{{5.0 * i, 5.0 * j}, 1.5 * k * degree};
        smallest = std::min(smallest, kappa_inverse(design.manipulator, pose, design.conditioning));
      }
    }
  }
  BOOST_TEST(bound <= smallest);
  BOOST_TEST(smallest - bound < 0.02);  // the grid is fine enough to come near
  for (const json& point : found["history"]) {
    BOOST_TEST(point["kappa_inv"].get<double>() >= 0.0);
    BOOST_TEST(point["kappa_inv"].get<double>() <= 1.0);
    BOOST_TEST(!std::signbit(point["kappa_inv"].get<double>()));
  }
}

BOOST_AUTO_TEST_CASE(a_hole_in_the_workspace_is_seen) {
  const std::vector<std::string> arguments{"synthesize", problem("hole"), "--points", "60", "--max-evaluations", "60"};
  const json found = document(arguments, 1);
  BOOST_TEST(found["reach_verdict"] == "refuted");
  BOOST_TEST(!found["reaches_workspace"].get<bool>());
  BOOST_TEST(found["violation"].get<double>() >= 10.0 - 1e-9);
  BOOST_TEST(found["start_violation"].get<double>() == 10.0, tolerance(1e-9));
  const std::string text = run(arguments).out;
  BOOST_TEST(contains(text, "does NOT reach"));
  BOOST_TEST(!contains(text, "reaches the whole workspace: proved"));
}

// The leg's hole is there for any minimum length, and gone without one.
BOOST_AUTO_TEST_CASE(a_hole_of_a_leg_that_stays_needs_the_leg_without_a_minimum_length) {
  const json advice = document({"synthesize", problem("hole"), "--points", "60"}, 1)["advice"];
  BOOST_TEST(advice["violation"].get<double>() == 10.0, tolerance(1e-9));
  BOOST_REQUIRE(!advice["changes"].empty());
  for (const json& change : advice["changes"]) {
    BOOST_TEST(change["kind"] == "minimum_lengths");
    BOOST_TEST(change["amount"].get<double>() == 10.0);
  }
}

// Where the leg may move, it leaves.
BOOST_AUTO_TEST_CASE(a_leg_that_may_leave_the_workspace_does) {
  const TemporaryFolder folder;
  std::string content = read_file(problem("hole"));
  content.replace(content.find("[\"base_2\"]"), 10, "[\"base_1\"]");
  content.replace(content.find("within = 30"), 11, "within = 70");
  const std::string file = folder.write("leaves.toml", content).string();
  const json found = document({"synthesize", file, "--points", "60"});
  BOOST_TEST(found["reach_verdict"] == "proved");
  const Eigen::Vector2d base(found["design"][0].get<double>(), found["design"][1].get<double>());
  const Eigen::Array2d beyond = base.array().abs() - Eigen::Array2d(40.0, 30.0);
  BOOST_TEST(beyond.max(Eigen::Array2d::Zero()).matrix().norm() >= 10.0 - 0.02);
  const std::string text = run({"synthesize", file, "--points", "60"}).out;
  BOOST_TEST(contains(text, "reaches the whole workspace: proved"));
  BOOST_TEST(contains(text, "over the whole workspace: proved"));
}

BOOST_AUTO_TEST_CASE(a_time_limit_ends_with_the_best_design_so_far) {
  const std::vector<std::string> arguments{"synthesize", problem("positioning_table"), "--time", "1e-9"};
  const json found = document(arguments, 1);
  BOOST_TEST(found["status"] == "stopped");
  BOOST_TEST(found["cut_short"] == "Stopped after 1e-09 s");
  BOOST_TEST(found["runs"].size() == 1U);
  BOOST_TEST(contains(run(arguments).out, "Stopped after 1e-09 s: this is the best design so far.\n"));
  const json compared = document({"compare", problem("positioning_table"), "--time", "1e-9"}, 1);
  BOOST_TEST(compared["runs"].size() == 1U);
  BOOST_TEST(compared["cut_short"] == "Stopped after 1e-09 s");
}
