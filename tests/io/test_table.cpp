#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "reprise/io/table.hpp"
#include "temporary_folder.hpp"

using namespace reprise;

namespace {

Table make_table() {
  return Table(
      "Title, with a comma",
      {{"name", "-", "a text"}, {"x_C", "length", "a number: with a colon"}, {"n", "-", "a count [of things]"}},
      {"A note."});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_table_reads_back_as_it_was_written) {
  const TemporaryFolder folder;
  Table table = make_table();
  table.add_row({"plain", 0.1, 3});
  table.add_row({"comma, \"quote\" and # mark", -1e-300, 0});
  table.add_row({"# begins with a mark", 2.0 / 3.0, {}});
  write_table(folder / "table.csv", table);
  const Table read = read_table(folder / "table.csv");

  BOOST_TEST(read.title() == table.title());
  BOOST_TEST(read.notes() == table.notes(), boost::test_tools::per_element());
  BOOST_REQUIRE_EQUAL(read.columns().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST(read.columns()[i].name == table.columns()[i].name);
    BOOST_TEST(read.columns()[i].unit == table.columns()[i].unit);
    BOOST_TEST(read.columns()[i].meaning == table.columns()[i].meaning);
  }
  BOOST_REQUIRE_EQUAL(read.rows(), 3U);
  for (std::size_t row = 0; row < 3; ++row) {
    BOOST_TEST(read.text(row, "name") == table.text(row, "name"));
    BOOST_TEST(read.number(row, "x_C") == table.number(row, "x_C"));
    BOOST_TEST(read.text(row, "n") == table.text(row, "n"));
  }
  BOOST_TEST(to_csv(read) == to_csv(table));
}

BOOST_AUTO_TEST_CASE(numbers_read_back_to_the_last_bit) {
  const TemporaryFolder folder;
  Table table("numbers", {{"x", "-", "a number"}});
  std::mt19937_64 random(5);
  std::vector<double> values = {0.0,
                                -0.0,
                                std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::infinity(),
                                std::sqrt(2.0)};
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  for (int i = 0; i < 1000; ++i) values.push_back(std::pow(10.0, exponent(random)));
  for (const double value : values) table.add_row({value});
  write_table(folder / "numbers.csv", table);
  const std::vector<double> read = read_table(folder / "numbers.csv").numbers("x");
  BOOST_TEST(read == values, boost::test_tools::per_element());

  table.add_row({std::numeric_limits<double>::quiet_NaN()});
  write_table(folder / "numbers.csv", table);
  BOOST_TEST(std::isnan(read_table(folder / "numbers.csv").numbers("x").back()));
}

BOOST_AUTO_TEST_CASE(the_head_says_what_the_columns_are_and_the_names_are_bare) {
  const std::string csv = to_csv(make_table());
  BOOST_TEST(csv ==
             "# Title, with a comma\n# A note.\n# name [-]: a text\n# x_C [length]: a number: with a colon\n"
             "# n [-]: a count [of things]\nname,x_C,n\n");
}

BOOST_AUTO_TEST_CASE(rows_are_selected_by_text_and_texts_listed_in_order) {
  Table table("t", {{"a", "-", ""}, {"b", "-", ""}});
  table.add_row({"P2", 1});
  table.add_row({"P1", 2});
  table.add_row({"P2", 3});
  BOOST_TEST(table.where("a", "P2").numbers("b") == std::vector<double>({1, 3}), boost::test_tools::per_element());
  BOOST_TEST(table.where("a", "P9").rows() == 0U);
  BOOST_TEST(table.distinct("a") == std::vector<std::string>({"P2", "P1"}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(wrong_tables_are_refused) {
  using Columns = std::vector<Column>;
  for (const std::string name : {"", "1a", "a b", "a-b", "κ"}) {
    BOOST_CHECK_THROW(Table("t", Columns{{name, "-", ""}}), std::logic_error);
  }
  BOOST_CHECK_THROW(Table("t", Columns{{"a", "-", ""}, {"a", "-", ""}}), std::logic_error);
  BOOST_CHECK_THROW(Table("two\nlines", Columns{{"a", "-", ""}}), std::logic_error);
  Table table = make_table();
  BOOST_CHECK_THROW(table.add_row({"too few", 1.0}), std::logic_error);
  BOOST_CHECK_THROW(table.add_row({"two\nlines", 1.0, 1}), std::logic_error);
  BOOST_TEST(table.rows() == 0U);
}

BOOST_AUTO_TEST_CASE(errors_name_table_column_and_value) {
  Table table = make_table();
  table.add_row({"P1", "abc", 1});
  BOOST_TEST(contains(thrown_by([&] { table.number(0, "nothing"); }), "no column 'nothing'"));
  const std::string message = thrown_by([&] { table.number(0, "x_C"); });
  BOOST_TEST(contains(message, "x_C"));
  BOOST_TEST(contains(message, "'abc' is not a number"));
  BOOST_TEST(contains(thrown_by([&] { table.text(1, "name"); }), "no row 1"));
}

BOOST_AUTO_TEST_CASE(damaged_files_are_refused_with_their_line) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& content) {
    return thrown_by([&] { read_table(folder.write("damaged.csv", content)); });
  };
  BOOST_TEST(contains(thrown_by([&] { read_table(folder / "none.csv"); }), "none.csv"));
  BOOST_TEST(contains(error(""), "no line of column names"));
  BOOST_TEST(contains(error("# only a title\n"), "no line of column names"));
  BOOST_TEST(contains(error("a,b\n1\n"), "line 2: there are 1 fields, but 2 columns"));
  BOOST_TEST(contains(error("a,b\n1,\"2\n"), "line 2: a quote is not closed"));
  BOOST_TEST(contains(error("a,a\n"), "line 1"));
  BOOST_TEST(contains(error("a b,c\n"), "line 1"));
}

BOOST_AUTO_TEST_CASE(published_tables_are_read_as_printed) {
  const Table table = read_table(REPRISE_SOURCE "/data/published/table_5_3.csv");
  BOOST_TEST(table.rows() == 3U);
  BOOST_TEST(table.text(2, "x_C") == "-1.170");
  BOOST_TEST(table.number(0, "g_star") == 0.2e-5);
}
