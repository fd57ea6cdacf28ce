#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "chapter/problems.hpp"
#include "frame/source_tree.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/io/table.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using namespace reprise::experiments;

BOOST_AUTO_TEST_CASE(manipulators_are_those_of_the_printed_table) {
  const Table printed = read_table(data_folder() / "published" / "table_5_1.csv");
  for (std::size_t row = 0; row < printed.rows(); ++row) {
    const CollinearManipulator read = read_chapter_manipulator(printed.text(row, "manipulator"));
    const Eigen::Matrix<double, 5, 1> d = to_vector(read.design);
    for (std::size_t i = 0; i < design_columns.size(); ++i) {
      BOOST_TEST(d[static_cast<Eigen::Index>(i)] == printed.number(row, design_columns[i]));
    }
    BOOST_TEST(read.lengths[0].lower == std::sqrt(2.0));
    BOOST_TEST(read.lengths[1].upper == 2.0);
    BOOST_TEST(read.lengths[2].lower == 1.0);
    BOOST_TEST(read.lengths[2].upper == std::sqrt(3.0));
  }
  BOOST_TEST(contains(thrown_by([] { read_chapter_manipulator("M4"); }), "M4.toml"));
}

BOOST_AUTO_TEST_CASE(the_nine_problems_are_the_chapters) {
  constexpr double five = pi / 36.0;
  const std::vector<std::vector<std::pair<double, double>>> orientations{
      {{0.0, 0.0}}, {{-five, -five}, {0.0, 0.0}, {five, five}}, {{-five, five}}};
  for (std::size_t i = 0; i < chapter_syntheses.size(); ++i) {
    const ChapterSynthesis& synthesis = chapter_syntheses[i];
    BOOST_TEST(read_start(synthesis).name == (i == 0 ? "M1" : "M2"));
    const Table printed = read_published(synthesis);
    for (const std::string& name : workspace_names) {
      const ProblemInput problem = read_chapter_problem(synthesis, name);
      BOOST_TEST_CONTEXT(synthesis.kind << " " << name) {
        BOOST_TEST(printed.where("workspace", name).rows() == 1u);
        BOOST_TEST(problem.task.prescribed.name() == name);
        BOOST_TEST((problem.task.prescribed.centre() == Eigen::Vector2d(1.0, 1.5)));
        BOOST_TEST((problem.task.conditioning.normalisation == Normalisation::printed));
        BOOST_TEST(problem.task.designs.size() == 5);
        BOOST_TEST(contains(problem.origin.source, "reconstructed"));
        BOOST_TEST(!problem.origin.certainty.empty());
        BOOST_REQUIRE_EQUAL(problem.task.orientations.size(), orientations[i].size());
        for (std::size_t k = 0; k < orientations[i].size(); ++k) {
          BOOST_TEST(problem.task.orientations[k].lower == orientations[i][k].first);
          BOOST_TEST(problem.task.orientations[k].upper == orientations[i][k].second);
        }
      }
    }
  }
  BOOST_CHECK_THROW(chapter_synthesis("X"), std::logic_error);
}

BOOST_AUTO_TEST_CASE(prescribed_workspaces_have_the_size_of_each_table) {
  const auto so = read_prescribed_workspaces(chapter_synthesis("SO"));
  const auto mo = read_prescribed_workspaces(chapter_synthesis("MO"));
  BOOST_REQUIRE_EQUAL(so.size(), 3U);
  // P1 and P2: a fifth against a 6.25th; P3: a seventh against 0.9 of a seventh.
  for (const auto& [index, ratio] : std::vector<std::pair<std::size_t, double>>{{0, 0.8}, {1, 0.8}, {2, 0.9}}) {
    for (const double beta : {0.0, 1.0, 2.5, 4.0}) {
      BOOST_TEST(mo[index].radius(beta) == ratio * so[index].radius(beta), boost::test_tools::tolerance(1e-14));
    }
  }
  BOOST_TEST(so[1].radius(0.0) == 1.75 / 5.0, boost::test_tools::tolerance(1e-14));
}
