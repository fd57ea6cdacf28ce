#include <fmt/format.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <map>
#include <memory>

#include "reprise/io/options.hpp"
#include "temporary_folder.hpp"

using namespace reprise;

namespace {

struct Fixture {
  bool flag = false;
  double number = 0.02;
  long integer = 7;
  std::filesystem::path path = "here";
  std::string choice = "area";
  std::vector<double> numbers{0.0};
  std::vector<std::string> choices{"slsqp"};
  std::unique_ptr<CommandLine> options = std::make_unique<CommandLine>("program", "What it does");

  Fixture() {
    options->flag("--flag", flag, "a flag");
    options->number("--number", number, NumberRange::positive(1.0), "a number");
    options->integer("--integer", integer, 1, 9, "an integer");
    options->path("--path", path, "a path");
    options->choice("--choice", choice, {"area", "pointwise"}, "a choice");
    options->numbers("--numbers", numbers, NumberRange::between(-180.0, 180.0), "numbers");
    options->choices("--choices", choices, {"dynamic_q", "slsqp", "ipopt"}, "choices");
  }

  bool parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "program");
    return options->parse(static_cast<int>(arguments.size()), arguments.data());
  }
};

/// The sentence for a wrong command line.
std::string error(const std::vector<const char*>& arguments) {
  Fixture fixture;
  try {
    fixture.parse(arguments);
  } catch (const UsageError& usage_error) {
    return usage_error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(defaults_stay_when_nothing_is_given) {
  Fixture fixture;
  BOOST_TEST(fixture.parse({}));
  BOOST_TEST(!fixture.flag);
  BOOST_TEST(fixture.number == 0.02);
  BOOST_TEST(fixture.choices == std::vector<std::string>{"slsqp"}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(values_are_set_in_both_spellings) {
  Fixture fixture;
  BOOST_TEST(fixture.parse({"--flag", "--number", "1e-3", "--integer=9", "--path", "there", "--choice=pointwise",
                            "--numbers", "-5,0,5", "--choices", "ipopt,dynamic_q"}));
  BOOST_TEST(fixture.flag);
  BOOST_TEST(fixture.number == 1e-3);
  BOOST_TEST(fixture.integer == 9);
  BOOST_TEST(fixture.path == "there");
  BOOST_TEST(fixture.choice == "pointwise");
  BOOST_TEST(fixture.numbers == std::vector<double>({-5, 0, 5}), boost::test_tools::per_element());
  BOOST_TEST(fixture.choices == std::vector<std::string>({"ipopt", "dynamic_q"}), boost::test_tools::per_element());

  const auto values = fixture.options->values();
  const std::map<std::string, std::string> named(values.begin(), values.end());
  BOOST_TEST(named.at("--number") == "0.001");
  BOOST_TEST(named.at("--choices") == "[\"ipopt\",\"dynamic_q\"]");
  BOOST_TEST(named.at("--flag") == "true");
}

BOOST_AUTO_TEST_CASE(wrong_values_are_named_with_what_is_allowed) {
  for (const char* value : {"0", "-1", "1.5", "nan", "inf", "abc", "0.1x", "", " 0.1", "1e400"}) {
    BOOST_TEST_CONTEXT(value) {
      BOOST_TEST(error({"--number", value}) ==
                 fmt::format("--number is '{}', but must be a number above 0 and at most 1.", value));
    }
  }
  for (const char* value : {"0", "10", "2.5", "two", "99999999999999999999"}) {
    BOOST_TEST(error({"--integer", value}) ==
               fmt::format("--integer is '{}', but must be a whole number from 1 to 9.", value));
  }
  BOOST_TEST(error({"--choice", "nonsense"}) == "--choice is 'nonsense', but must be one of area, pointwise.");
  BOOST_TEST(error({"--choices", "slsqp,nonsense"}) ==
             "--choices is 'nonsense', but must be one or more of dynamic_q, slsqp, ipopt, separated by commas.");
  BOOST_TEST(contains(error({"--choices", "slsqp,"}), "--choices is ''"));
  BOOST_TEST(contains(error({"--choices", "slsqp,slsqp"}), "without repeats"));
  BOOST_TEST(contains(error({"--numbers", "0,200"}), "--numbers is '200'"));
  BOOST_TEST(contains(error({"--path", ""}), "--path is ''"));
}

BOOST_AUTO_TEST_CASE(wrong_options_are_named) {
  BOOST_TEST(error({"--nothing"}) == "there is no option '--nothing'; --help lists the options.");
  BOOST_TEST(error({"stray"}) == "the argument 'stray' is not expected; --help lists what is.");
  BOOST_TEST(error({"--num", "1"}) ==
             "there is no option '--num' (did you mean '--number'?); --help lists the options.");
  BOOST_TEST(error({"--number"}) == "--number has no value, but must be a number above 0 and at most 1.");
  BOOST_TEST(error({"--number", "1", "--number", "0.5"}) == "--number is given 2 times, but must be given once.");
  BOOST_TEST(error({"--number=1", "--number", "0.5"}) == "--number is given 2 times, but must be given once.");
  BOOST_TEST(error({"--flag=3"}) == "--flag takes no value, but one was given.");
  BOOST_TEST(error({"--choice", "pointwize"}) ==
             "--choice is 'pointwize', but must be one of area, pointwise (did you mean 'pointwise'?).");
}

BOOST_AUTO_TEST_CASE(a_wrong_command_line_sets_nothing) {
  Fixture fixture;
  BOOST_CHECK_THROW(fixture.parse({"--number", "0.5", "--choice", "nonsense"}), UsageError);
  BOOST_TEST(fixture.number == 0.02);
}

BOOST_AUTO_TEST_CASE(help_names_every_option_and_its_default) {
  Fixture fixture;
  BOOST_TEST(!fixture.parse({"--number", "0.5", "--help"}));
  BOOST_TEST(fixture.number == 0.02);
  const std::string help = fixture.options->help();
  for (const char* part : {"What it does", "--flag", "--number", "0.02", "--choices", "dynamic_q|slsqp|ipopt"}) {
    BOOST_TEST_CONTEXT(part) { BOOST_TEST(contains(help, part)); }
  }
}

BOOST_AUTO_TEST_CASE(files_and_tuples_are_read_and_must_be_given) {
  std::filesystem::path file;
  std::vector<double> point;
  std::vector<double> range{-1.0, 1.0};
  std::optional<double> chord;
  CommandLine options("program", "What it does");
  options.file("FILE", file, "a file");
  options.tuple("--at", point, "X Y", NumberRange::any(), "a point");
  options.tuple("--range", range, "LOWER UPPER", NumberRange::between(-5.0, 5.0), "a range");
  options.number("--chord", chord, NumberRange::positive(), "a length");
  options.footer("The end.");
  const auto parse = [&options](std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "program");
    return options.parse(static_cast<int>(arguments.size()), arguments.data());
  };
  const auto error_of = [&](const std::vector<const char*>& arguments) { return thrown_by([&] { parse(arguments); }); };
  BOOST_TEST(error_of({"f"}) == "--at is missing; it must be 2 numbers, X Y (a point), each of them a number.");
  BOOST_TEST(error_of({"--at", "1", "2"}) == "FILE is missing; it must be the name of a file.");
  BOOST_TEST(error_of({"f", "--at"}) == "--at takes 2 numbers, X Y (a point), but 0 were given.");
  BOOST_TEST(error_of({"f", "--at", "1"}) == "--at takes 2 numbers, X Y (a point), but 1 was given.");
  for (const std::vector<const char*>& three :
       {std::vector<const char*>{"f", "--at", "1", "-2", "3"}, std::vector<const char*>{"--at", "1", "-2", "3", "f"},
        std::vector<const char*>{"f", "--at", "1", "-2", "3", "--range", "0", "1"},
        std::vector<const char*>{"f", "--range", "0", "1", "--at", "1", "-2", "3"}}) {
    BOOST_TEST(error_of(three) == "--at takes 2 numbers, X Y (a point), but 3 were given.");
  }
  BOOST_TEST(error_of({"f", "--at", "1", "2", "--at", "3", "4"}) == "--at is given 2 times, but must be given once.");
  BOOST_TEST(contains(error_of({"f", "--at", "1", "x"}), "--at is 'x'"));
  BOOST_TEST(contains(error_of({"f", "--at", "1", "2", "--range", "-6", "0"}), "--range is '-6'"));
  BOOST_TEST(point.empty());
  BOOST_TEST(parse({"f", "--at", "-1.5", "2"}));
  BOOST_TEST(file == "f");
  BOOST_TEST(point == std::vector<double>({-1.5, 2.0}), boost::test_tools::per_element());
  BOOST_TEST(range == std::vector<double>({-1.0, 1.0}), boost::test_tools::per_element());
  BOOST_TEST(!chord.has_value());
  BOOST_TEST(contains(options.help(), "X Y (must be given)"));
  BOOST_TEST(contains(options.help(), "The end."));
}

BOOST_AUTO_TEST_CASE(summaries_tell_what_can_be_completed) {
  const Fixture fixture;
  const std::vector<OptionSummary> summaries = fixture.options->summaries();
  const auto of = [&](const std::string& name) {
    return *std::find_if(summaries.begin(), summaries.end(), [&](const auto& one) { return one.name == name; });
  };
  BOOST_TEST(!of("--flag").takes_value);
  BOOST_TEST(of("--number").takes_value);
  BOOST_TEST(of("--path").is_path);
  BOOST_TEST(of("--choice").choices == std::vector<std::string>({"area", "pointwise"}),
             boost::test_tools::per_element());
  BOOST_TEST(!of("--help").takes_value);
}
