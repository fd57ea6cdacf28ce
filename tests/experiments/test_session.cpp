#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "frame/experiment.hpp"
#include "reprise/io/files.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
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
  Experiment experiment({name, "Table 9", "A title"});
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
                         session.constant("points", 720);
                       },
                       {"--quick"});
  BOOST_TEST(code == 0);
  BOOST_TEST(read_table(folder / "maker/maker.csv").number(0, "x") == 1.5);
  BOOST_TEST(read_table(folder / "maker/maker_history.csv").rows() == 1U);

  const auto record = nlohmann::json::parse(read_file(folder / "maker/maker.json"));
  BOOST_TEST(record.at("program") == "maker");
  BOOST_TEST(record.at("options").at("--quick") == true);
  BOOST_TEST(record.at("measured").at("seconds of something") == 0.25);
  BOOST_TEST(record.at("constants").at("points") == 720.0);
  BOOST_TEST(record.at("seconds").get<double>() >= 0.0);
  BOOST_TEST(record.at("outputs").size() == 3U);
  BOOST_TEST(record.at("source").contains("commit"));
  BOOST_TEST(record.at("source").contains("dirty"));
  for (const char* library : {"Eigen", "Boost", "NLopt", "Ipopt", "SuiteSparse", "gnuplot"}) {
    BOOST_TEST(!record.at("libraries").at(library).get<std::string>().empty());
  }
  for (const char* key : {"type", "compiler", "flags"}) BOOST_TEST(record.at("build").contains(key));
  BOOST_TEST(!record.at("processor").get<std::string>().empty());
  BOOST_TEST(record.at("cores").get<int>() >= 1);
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
  std::filesystem::create_directory(folder / "maker");
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

BOOST_AUTO_TEST_CASE(a_table_that_was_cut_off_is_not_read) {
  const TemporaryFolder folder;
  const auto three_rows = [](Session& session) {
    Table table = make_table(1.0);
    for (const double value : {2.25, 3.5}) table.add_row({value});
    session.write(table);
  };
  BOOST_REQUIRE(run(folder, "maker", three_rows) == 0);
  const std::string whole = read_file(folder / "maker/maker.csv");
  for (const std::size_t lost : {1U, 3U, 4U, 5U}) {  // the end of a line, a part of a number, a line, more
    folder.write("maker/maker.csv", whole.substr(0, whole.size() - lost));
    std::string message;
    run(folder, "reader", [&](Session& session) { message = thrown_by([&] { session.read("maker"); }); });
    BOOST_TEST(contains(message, "maker.csv"), lost);
    BOOST_TEST(run(folder, "maker", {}, {"--redraw"}, [](Session& session) { session.table(); }) == 1);
  }
  folder.write("maker/maker.csv", whole);
  BOOST_TEST(run(folder, "reader", [](Session& session) { session.read("maker"); }) == 0);
}

BOOST_AUTO_TEST_CASE(a_picture_that_fails_takes_no_table_with_it) {
  const TemporaryFolder folder;
  const auto draw = [](Session& session) {
    Figure figure(300, 200);
    figure.add("not a command");
    session.draw(figure);
  };
  BOOST_TEST(run(
                 folder, "maker", [](Session& session) { session.write(make_table()); }, {}, draw) == 1);
  BOOST_TEST(read_table(folder / "maker/maker.csv").rows() == 1U);
  BOOST_TEST(!std::filesystem::exists(folder / "maker/maker.json"));
}

BOOST_AUTO_TEST_CASE(results_that_cannot_be_written_are_refused_before_anything_is_computed) {
  const TemporaryFolder folder;
  int computed = 0;
  const auto compute = [&](Session&) { ++computed; };
  folder.write("file", "x");
  for (const char* name : {"file", "none/maker", "file/maker"}) BOOST_TEST(run(folder, name, compute) == 2);
  BOOST_TEST(computed == 0);
  BOOST_TEST(folder.entries() == 1);
}

BOOST_AUTO_TEST_CASE(two_runs_do_not_write_into_the_same_folder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "maker");
  std::array<int, 2> locked{};
  BOOST_REQUIRE(::pipe(locked.data()) == 0);
  const pid_t other = ::fork();
  if (other == 0) {
    const FolderLock lock(folder / "maker", std::chrono::seconds(0));
    if (::write(locked[1], "x", 1) == 1) ::pause();
    ::_exit(1);
  }
  char byte = 0;
  BOOST_TEST(::read(locked[0], &byte, 1) == 1);
  const auto body = [](Session& session) { session.write(make_table()); };
  BOOST_TEST(run(folder, "maker", body) == 1);
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  BOOST_TEST(run(folder, "maker", body) == 0);
  ::close(locked[0]);
  ::close(locked[1]);
}

BOOST_AUTO_TEST_CASE(a_run_that_writes_nothing_leaves_no_record) {
  const TemporaryFolder folder;
  BOOST_TEST(run(folder, "maker", [](Session&) {}) == 0);
  BOOST_TEST(folder.entries() == 0);
}
