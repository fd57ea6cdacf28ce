#include <boost/test/unit_test.hpp>

#include "reference/verification.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using namespace reprise::experiments;

namespace {

const std::string comment =
    "# Tolerances\n# reference [-]: a\n# program [-]: a\n# part [-]: a\n# where [-]: a\n# keys [-]: a\n# column [-]: "
    "a\n"
    "# tolerance [-]: a\n# reason [-]: a\nreference,program,part,where,keys,column,tolerance,reason\n";

std::string error_of(const std::string& rows) {
  const TemporaryFolder folder;
  return thrown_by([&] { read_checks(folder.write("tolerances.csv", comment + rows)); });
}

Check make_check() {
  return {"some", "maker", "", {{"kind", "a"}}, {"name"}, {{"value", 1e-3, "rounding"}, {"status", 0.0, "a word"}}};
}

Table make_table(const std::vector<std::vector<Field>>& rows) {
  Table table("results", {{"name", "-", "a name"},
                          {"kind", "-", "a kind"},
                          {"value", "-", "a value"},
                          {"status", "-", "a word"},
                          {"other", "-", "not checked"}});
  for (const auto& row : rows) table.add_row(row);
  return table;
}

Table right() {
  return make_table({{"P1", "a", 0.5, "converged", 1}, {"P2", "a", 2000.0, "converged", 2}, {"P1", "b", 7, "x", 3}});
}

/// The verdicts about a result, as "P1 value differs" and so on, those that are right left out.
std::vector<std::string> wrongs(const Table& result) {
  const Table verdicts = hold_against(make_check(), result, reduce(make_check(), right()));
  std::vector<std::string> found;
  for (std::size_t row = 0; row < verdicts.rows(); ++row) {
    if (is_right(verdicts.text(row, "verdict"))) continue;
    found.push_back(verdicts.text(row, "row") + " " + verdicts.text(row, "column") + " " +
                    verdicts.text(row, "verdict"));
  }
  return found;
}

using Wrongs = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_stored_is_what_the_check_is_about) {
  const Table stored = reduce(make_check(), right());
  BOOST_TEST(stored.rows() == 2U);
  BOOST_TEST(!stored.has_column("other"));
  BOOST_TEST(stored.has_column("name"));
}

BOOST_AUTO_TEST_CASE(equal_results_and_those_within_the_tolerance_are_right) {
  BOOST_TEST(wrongs(right()).empty());
  // The tolerance is absolute for small numbers and relative for large ones.
  BOOST_TEST(wrongs(make_table({{"P2", "a", 2001.9, "converged", 9}, {"P1", "a", 0.5009, "converged", 9}})).empty());
}

BOOST_AUTO_TEST_CASE(broken_results_are_caught) {
  const auto with = [](const Field& value, const Field& status) {
    return make_table({{"P1", "a", value, status, 1}, {"P2", "a", 2000.0, "converged", 2}});
  };
  BOOST_TEST(wrongs(with(0.5011, "converged")) == Wrongs{"name=P1 value differs"}, boost::test_tools::per_element());
  BOOST_TEST(wrongs(with(-0.5, "converged")) == Wrongs{"name=P1 value differs"}, boost::test_tools::per_element());
  BOOST_TEST(wrongs(with("nan", "converged")) == Wrongs{"name=P1 value not a number"},
             boost::test_tools::per_element());
  BOOST_TEST(wrongs(with("inf", "converged")) == Wrongs{"name=P1 value not a number"},
             boost::test_tools::per_element());
  BOOST_TEST(wrongs(with({}, "converged")) == Wrongs{"name=P1 value differs"}, boost::test_tools::per_element());
  BOOST_TEST(wrongs(with("0.5x", "converged")) == Wrongs{"name=P1 value differs"}, boost::test_tools::per_element());
  BOOST_TEST(wrongs(with(0.5, "infeasible")) == Wrongs{"name=P1 status differs"}, boost::test_tools::per_element());
  const Table one = make_table({{"P1", "a", 0.5, "converged", 1}});
  BOOST_TEST(wrongs(one) == (Wrongs{"name=P2 value missing", "name=P2 status missing"}),
             boost::test_tools::per_element());
  Table three = right();
  three.add_row({"P3", "a", 1.0, "converged", 1});
  BOOST_TEST(wrongs(three) == (Wrongs{"name=P3 value not stored", "name=P3 status not stored"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_check_that_cannot_be_made_is_an_error) {
  const Table stored = reduce(make_check(), right());
  Check unknown = make_check();
  unknown.columns.push_back({"nothing", 0.0, "none"});
  BOOST_TEST(contains(thrown_by([&] { hold_against(unknown, right(), stored); }), "column nothing"));
  Table twice = right();
  twice.add_row({"P1", "a", 0.5, "converged", 1});
  BOOST_TEST(contains(thrown_by([&] { hold_against(make_check(), twice, stored); }), "two rows with name=P1"));
}

BOOST_AUTO_TEST_CASE(tolerances_are_read_with_their_reasons) {
  const TemporaryFolder folder;
  const std::vector<Check> checks = read_checks(folder.write(
      "tolerances.csv", comment +
                            "a,maker,part,kind=a size=2,name other,value,1e-3,rounding\n"
                            "a,maker,part,kind=a size=2,name other,status,0,a word\nb,maker,,,name,value,0,exact\n"));
  BOOST_TEST(checks.size() == 2U);
  BOOST_TEST(checks[0].columns.size() == 2U);
  BOOST_TEST(checks[0].where.size() == 2U);
  BOOST_TEST(checks[0].where[1].first == "size");
  BOOST_TEST(checks[0].keys.size() == 2U);
  BOOST_TEST(checks[0].columns[0].tolerance == 1e-3);
  BOOST_TEST(checks[1].part.empty());
}

BOOST_AUTO_TEST_CASE(wrong_tolerances_are_errors) {
  BOOST_TEST(contains(error_of("a,maker,,,name,value,-1,why\n"), "at least 0"));
  BOOST_TEST(contains(error_of("a,maker,,,name,value,nan,why\n"), "at least 0"));
  BOOST_TEST(contains(error_of("a,maker,,,name,value,1,\n"), "no reason"));
  BOOST_TEST(contains(error_of("a,maker,,kind,name,value,1,why\n"), "'kind' is not a condition"));
  BOOST_TEST(contains(error_of("a,maker,,,name,value,1,why\na,other,,,name,size,1,why\n"), "row above"));
  BOOST_TEST(contains(error_of("a,maker,,,name,value,much,why\n"), "tolerance"));
}
