// json.md holds the documents of all commands to what it says of them: no key is missing, none is unknown, every value
// is of the type given there.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "reprise/io/files.hpp"
#include "reprise/study/documents.hpp"
#include "running.hpp"
#include "temporary_folder.hpp"

using nlohmann::json;
using reprise::lower_number;
using reprise::upper_number;
using reprise::test::example;
using reprise::test::run;

namespace {

/// The keys of a command, with their types.
using Keys = std::map<std::string, std::string>;

/// The tables of json.md by the heading above them.
std::map<std::string, Keys> described() {
  std::map<std::string, Keys> all;
  std::istringstream lines(reprise::read_file(std::filesystem::path(REPRISE_SOURCE) / "apps/reprise/json.md"));
  std::string heading;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) heading = line.substr(3);
    if (!line.starts_with("| `")) continue;
    const std::size_t key_end = line.find('`', 3);
    const std::size_t type_begin = line.find("| ", key_end) + 2;
    const std::size_t type_end = line.find(" |", type_begin);
    all[heading][line.substr(3, key_end - 3)] = line.substr(type_begin, type_end - type_begin);
  }
  return all;
}

Keys keys_of(const std::string& command) {
  const std::map<std::string, Keys> all = described();
  Keys keys = all.at("all documents");
  if (command == "dextrous") {
    keys.insert(all.at("workspace").begin(), all.at("workspace").end());
    keys.erase("orientation_deg");
  }
  if (command == "sweep") keys.erase("manipulator");
  for (const auto& [key, type] : all.at(command)) keys[key] = type;
  return keys;
}

bool all_of(const json& list, const std::function<bool(const json&)>& test) {
  return list.is_array() && std::all_of(list.begin(), list.end(), test);
}

bool is_point(const json& value) {
  return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

bool has_type(const json& value, const std::string& type) {
  const auto number = [](const json& one) { return one.is_number(); };
  const auto number_or_null = [](const json& one) { return one.is_number() || one.is_null(); };
  const auto text = [](const json& one) { return one.is_string(); };
  if (type.starts_with("optional ")) return has_type(value, type.substr(9));
  if (type == "numbers or null") return all_of(value, number_or_null);
  if (type == "rows of numbers or null") {
    return all_of(value, [&](const json& row) { return all_of(row, number_or_null); });
  }
  if (type.ends_with(" or null")) return value.is_null() || has_type(value, type.substr(0, type.size() - 8));
  if (type == "text") return value.is_string();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  if (type == "point") return is_point(value);
  if (type == "points") return all_of(value, is_point);
  if (type == "numbers") return all_of(value, number);
  if (type == "texts") return all_of(value, text);
  if (type == "rows of numbers") return all_of(value, [&](const json& row) { return all_of(row, number); });
  if (type == "lists of points") return all_of(value, [](const json& list) { return all_of(list, is_point); });
  if (type == "lists of texts") return all_of(value, [&](const json& list) { return all_of(list, text); });
  if (type == "list") return all_of(value, [](const json& one) { return one.is_object(); });
  if (type == "table") return value.is_object();
  BOOST_ERROR("json.md has a type that is not known here: " << type);
  return false;
}

/// Checks an object whose keys json.md gives behind a prefix.
void check(const json& object, const std::string& prefix, const Keys& keys) {
  for (const auto& [key, value] : object.items()) {
    const auto found = keys.find(prefix + key);
    BOOST_TEST((found != keys.end()), "json.md does not describe " << prefix << key);
    if (found == keys.end()) continue;
    BOOST_TEST(has_type(value, found->second),
               prefix << key << " is not " << found->second << ": " << value.dump().substr(0, 80));
    if (found->second.ends_with("list")) {
      for (const json& item : value) check(item, prefix + key + "[].", keys);
    }
    if (found->second.starts_with("table") && value.is_object()) check(value, prefix + key + ".", keys);
  }
  for (const auto& [key, type] : keys) {
    if (!key.starts_with(prefix) || type.starts_with("optional ")) continue;
    const std::string own = key.substr(prefix.size());
    if (own.find('.') == std::string::npos) BOOST_TEST(object.contains(own), prefix << own << " is missing");
  }
}

void check_command(std::vector<std::string> arguments, int code = 0) {
  arguments.emplace_back("--json");
  BOOST_TEST_CONTEXT(arguments[0] << " " << arguments[1]) {
    const auto ended = run(arguments);
    BOOST_REQUIRE_MESSAGE(ended.code == code, ended.err);
    const json document = ended.document();
    BOOST_TEST(document["schema"] == "reprise/1");
    BOOST_TEST(document["command"] == arguments[0]);
    check(document, "", keys_of(arguments[0]));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_command_is_described) {
  const std::map<std::string, Keys> all = described();
  for (const auto& command : reprise::app::all_commands()) BOOST_TEST(all.contains(command->name()), command->name());
}

BOOST_AUTO_TEST_CASE(documents_are_as_described) {
  const std::string m1 = example("M1").string();
  const std::string triangle = example("triangle").string();
  const std::string circle = example("circle").string();
  check_command({"pose", triangle, "--at", "20", "100", "--orientation", "5"});
  check_command({"pose", m1, "--at", "0", "0"});      // a leg of length 0
  check_command({"pose", circle, "--at", "3", "0"});  // singular
  check_command({"assemble", m1, "--lengths", "1.8", "1.8", "1.5"});
  check_command({"assemble", m1, "--lengths", "9", "1", "1"});
  check_command({"workspace", m1});
  check_command({"workspace", m1, "--chord", "0.05", "--solver", "slsqp"});
  check_command({"workspace", m1, "--chord", "5"}, 1);  // too long: boundaries are missing
  check_command({"workspace", m1, "--orientation", "170"});
  check_command({"dextrous", triangle, "--range", "-8", "8"});
  check_command({"dextrous", triangle, "--range", "-90", "90"});
  check_command({"orientation", triangle, "--at", "20", "100"});
  check_command({"orientation", triangle, "--at", "9000", "100"});
  check_command({"conditioning", triangle, "--grid", "11"});
  check_command({"conditioning", m1, "--orientation", "170", "--grid", "11"});
  check_command({"conditioning", m1, "--grid", "11"});
  check_command({"conditioning", example("two_legs").string(), "--grid", "11"});
  check_command({"synthesize", circle, "--points", "40", "--starts", "2", "--max-evaluations", "100"});
  check_command({"synthesize", example("P2_dextrous").string(), "--points", "60", "--no-prove"});
  const TemporaryFolder folder;
  const std::string proved = (folder / "proved").string();
  check_command({"synthesize", example("P2").string(), "--points", "40", "--prove", "--gap", "1e-3", "--out", proved});
  check_command({"check", proved + "/certificate.toml"});
  check_command({"check", proved + "/certificate_turned.toml"});
  std::string too_large = reprise::read_file(circle);
  const std::size_t radius = too_large.find("radius = ");
  too_large.replace(radius, too_large.find('\n', radius) - radius, "radius = 1");
  check_command({"synthesize", folder.write("p.toml", too_large).string(), "--points", "40"}, 1);
  const std::string study = folder
                                .write("study.toml", "[sweep]\nproblem = '" + m1 +
                                                         "'\ncompute = 'workspace'\n[[vary]]\n"
                                                         "key = 'manipulator.design[4]'\nvalues = [0.9, 1]\n")
                                .string();
  const std::string sweep = (folder / "sweep").string();
  check_command({"sweep", study, "--out", sweep, "--part", "2/2"});
  check_command({"sweep", "--merge", sweep}, 1);
  check_command({"sweep", study, "--out", sweep});
  check_command({"compare", circle, "--points", "40", "--optimizer", "slsqp,cobyla", "--max-evaluations", "100"});
}

BOOST_AUTO_TEST_CASE(the_unit_of_the_file_is_shown_where_lengths_are) {
  const TemporaryFolder folder;
  const std::string triangle = example("triangle").string();
  const std::string out = (folder / "out").string();
  const std::string picture = (folder / "workspace.svg").string();
  const std::vector<std::vector<std::string>> commands{{"pose", triangle, "--at", "20", "100"},
                                                       {"assemble", triangle, "--lengths", "180", "170", "100"},
                                                       {"orientation", triangle, "--at", "20", "100"},
                                                       {"dextrous", triangle, "--range", "-5", "5"},
                                                       {"workspace", triangle, "--out", out, "--plot", picture}};
  for (std::vector<std::string> command : commands) {
    BOOST_TEST_CONTEXT(command[0]) {
      BOOST_TEST(contains(run(command).out, "mm"));
      command.emplace_back("--json");
      BOOST_TEST(run(command).document()["unit"] == "mm");
    }
  }
  BOOST_TEST(contains(run(commands.back()).out, " mm^2"));
  BOOST_TEST(contains(reprise::read_file(folder / "out/boundary.csv"), "# x [mm]: "));
  BOOST_TEST(contains(reprise::read_file(picture), "x [mm]"));
  // Without a unit nothing is made up.
  const auto ended = run({"pose", example("M1").string(), "--at", "1", "1.5"});
  BOOST_TEST(!contains(ended.out, "mm"));
}

BOOST_AUTO_TEST_CASE(bounds_for_people_are_bounds_whatever_their_size) {
  BOOST_TEST(lower_number(0.0) == "0");
  BOOST_TEST(upper_number(0.0) == "0");
  BOOST_TEST(lower_number(0.25) == "0.25");
  BOOST_TEST(lower_number(2.0 / 3.0) == "0.666666");
  BOOST_TEST(upper_number(2.0 / 3.0) == "0.666667");
  BOOST_TEST(lower_number(1.0 / 3e9, 3) == "3.33e-10");
  BOOST_TEST(upper_number(1.0 / 3e9, 3) == "3.34e-10");
  BOOST_TEST(lower_number(std::nextafter(1.0, 0.0)) == "0.999999");
  for (int power = -300; power <= 300; power += 7) {
    for (const double digits : {1.0, 1.2345651, 3.1415926, 9.999999999}) {
      for (const double value : {digits * std::pow(10.0, power), -digits * std::pow(10.0, power)}) {
        const double lower = std::stod(lower_number(value));
        const double upper = std::stod(upper_number(value));
        BOOST_TEST(lower <= value);
        BOOST_TEST(upper >= value);
        BOOST_TEST(upper - lower <= 1.01e-5 * std::abs(value));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(zeros_have_no_sign) {
  const auto ended = run({"pose", example("M1").string(), "--at", "-0", "1.5", "--json"});
  BOOST_REQUIRE_MESSAGE(ended.code == 0, ended.err);
  BOOST_TEST(!contains(ended.out, "-0.0,"), ended.out);
  BOOST_TEST(!contains(ended.out, "-0.0\n"), ended.out);
}

// Names may hold anything that TOML allows.
BOOST_AUTO_TEST_CASE(documents_are_unicode_whatever_the_names) {
  const TemporaryFolder folder;
  std::string content = reprise::read_file(example("two_legs"));
  content.replace(content.find("two legs\""), 9,
                  "Gr\xc3\xb6\xc3\x9f"
                  "e 'x' \\\"y\\\" \\\\\"");
  const auto ended = run({"pose", folder.write("m.toml", content).string(), "--at", "1", "1", "--json"});
  BOOST_REQUIRE_MESSAGE(ended.code == 0, ended.err);
  BOOST_TEST(ended.document()["manipulator"].get<std::string>().starts_with("Gr\xc3\xb6\xc3\x9f"));
}
