#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "support/experiment.hpp"
#include "support/files.hpp"
#include "temporary_folder.hpp"

using namespace reprise::experiments;

namespace {

Table make_table(double value = 1.5) {
  Table table("numbers", {{"x", "-", "a number"}});
  table.add_row({value});
  return table;
}

/// Runs a program of the given name with its results in folder/<name>.
int run(const TemporaryFolder& folder, const std::string& name, const std::function<void(Session&)>& body,
        std::vector<std::string> arguments = {}, const std::function<void(Session&)>& draw = {}) {
  Experiment experiment(name, "A title");
  experiment.reads_results();
  const std::string out = (folder / name).string();
  arguments.insert(arguments.begin(), {name, "--out", out, "--from", folder.path().string()});
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  const int count = static_cast<int>(argv.size());
  return draw ? experiment.run(count, argv.data(), body, draw) : experiment.run(count, argv.data(), body);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_writes_its_table_and_where_it_comes_from) {
  const TemporaryFolder folder;
  const int code = run(folder, "maker",
                       [](Session& session) {
                         BOOST_TEST(session.quick());
                         session.write(make_table());
                         session.write(make_table(), "history");
                         session.record("seconds of something", 0.25);
                       },
                       {"--quick"});
  BOOST_TEST(code == 0);
  BOOST_TEST(read_table(folder / "maker/maker.csv").number(0, "x") == 1.5);
  BOOST_TEST(read_table(folder / "maker/maker_history.csv").rows() == 1U);

  const auto record = nlohmann::json::parse(read_file(folder / "maker/maker.json"));
  BOOST_TEST(record.at("program") == "maker");
  BOOST_TEST(record.at("options").at("--quick") == true);
  BOOST_TEST(record.at("measured").at("seconds of something") == 0.25);
  BOOST_TEST(record.at("seconds").get<double>() >= 0.0);
  BOOST_TEST(record.at("outputs").size() == 3U);
  BOOST_TEST(record.at("source").contains("commit"));
  BOOST_TEST(record.at("source").contains("dirty"));
  for (const char* library : {"Eigen", "Boost", "NLopt", "Ipopt", "gnuplot"}) {
    BOOST_TEST(!record.at("libraries").at(library).get<std::string>().empty());
  }
  for (const char* key : {"type", "compiler", "flags"}) BOOST_TEST(record.at("build").contains(key));
  BOOST_TEST(!record.at("processor").get<std::string>().empty());
}

BOOST_AUTO_TEST_CASE(a_run_that_fails_leaves_no_mark_of_a_whole_result) {
  const TemporaryFolder folder;
  BOOST_REQUIRE_EQUAL(run(folder, "maker", [](Session& session) { session.write(make_table()); }), 0);
  const int code = run(folder, "maker", [](Session& session) {
    session.write(make_table(2.5));
    throw std::runtime_error("it failed.");
  });
  BOOST_TEST(code == 1);
  BOOST_TEST(!std::filesystem::exists(folder / "maker/maker.json"));
}

BOOST_AUTO_TEST_CASE(a_run_that_fails_before_it_writes_leaves_the_old_result) {
  const TemporaryFolder folder;
  BOOST_REQUIRE_EQUAL(run(folder, "maker", [](Session& session) { session.write(make_table()); }), 0);
  BOOST_TEST(run(folder, "maker", [](Session&) { throw std::runtime_error("it failed."); }) == 1);
  BOOST_TEST(std::filesystem::exists(folder / "maker/maker.json"));
}

BOOST_AUTO_TEST_CASE(exit_codes_tell_wrong_input_from_failure) {
  const TemporaryFolder folder;
  const auto nothing = [](Session&) {};
  BOOST_TEST(run(folder, "maker", nothing, {"--nonsense"}) == 2);
  BOOST_TEST(run(folder, "maker", nothing, {"--help"}) == 0);
  BOOST_TEST(folder.entries() == 0);
  BOOST_TEST(run(folder, "maker", [](Session&) { throw std::invalid_argument("wrong."); }) == 2);
  BOOST_TEST(run(folder, "maker", [](Session&) { throw std::runtime_error("failed."); }) == 1);
  BOOST_TEST(run(folder, "maker", [](Session&) { throw std::logic_error("failed."); }) == 1);
  BOOST_TEST(folder.entries() == 0);
}

BOOST_AUTO_TEST_CASE(stored_results_are_read_and_named_in_the_record) {
  const TemporaryFolder folder;
  BOOST_REQUIRE_EQUAL(run(folder, "maker", [](Session& session) { session.write(make_table(), "part"); }), 0);
  const int code = run(folder, "reader", [](Session& session) { session.write(session.read("maker", "part")); });
  BOOST_TEST(code == 0);
  BOOST_TEST(read_file(folder / "reader/reader.csv") == read_file(folder / "maker/maker_part.csv"));
  const auto record = nlohmann::json::parse(read_file(folder / "reader/reader.json"));
  BOOST_TEST(record.at("inputs").at("maker").contains("source"));
}

BOOST_AUTO_TEST_CASE(results_that_are_missing_or_not_whole_name_the_command_that_makes_them) {
  const TemporaryFolder folder;
  const auto read_error = [&] {
    std::string message;
    run(folder, "reader", [&](Session& session) { message = thrown_by([&] { session.read("maker"); }); });
    return message;
  };
  BOOST_TEST(contains(read_error(), "run 'make experiment NAME=maker' first"));
  write_table(folder / "maker/maker.csv", make_table());
  BOOST_TEST(contains(read_error(), "run 'make experiment NAME=maker' first"));
}

BOOST_AUTO_TEST_CASE(pictures_are_drawn_again_from_what_is_stored) {
  const TemporaryFolder folder;
  int computed = 0;
  std::vector<double> drawn;
  const auto compute = [&](Session& session) {
    ++computed;
    session.write(make_table(1.5));
  };
  const auto draw = [&](Session& session) {
    drawn.push_back(session.table().number(0, "x"));
    Figure figure(300, 200);
    figure.add("plot " + figure.add_data({{0.0, 0.0}, {1.0, drawn.back()}}) + " with lines");
    session.draw(figure);
  };
  BOOST_TEST(run(folder, "maker", compute, {"--redraw"}, draw) == 1);  // there is nothing to draw yet
  BOOST_TEST(run(folder, "maker", compute, {}, draw) == 0);
  const std::string record = read_file(folder / "maker/maker.json");
  std::filesystem::remove(folder / "maker/maker.svg");
  write_table(folder / "maker/maker.csv", make_table(2.5));
  BOOST_TEST(run(folder, "maker", compute, {"--redraw"}, draw) == 0);
  BOOST_TEST(computed == 1);
  BOOST_TEST(drawn == std::vector<double>({1.5, 2.5}), boost::test_tools::per_element());
  BOOST_TEST(std::filesystem::exists(folder / "maker/maker.svg"));
  BOOST_TEST(read_file(folder / "maker/maker.json") == record);
}

BOOST_AUTO_TEST_CASE(a_run_that_writes_nothing_leaves_no_record) {
  const TemporaryFolder folder;
  BOOST_TEST(run(folder, "maker", [](Session&) {}) == 0);
  BOOST_TEST(folder.entries() == 0);
}
