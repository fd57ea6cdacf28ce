#include <boost/test/unit_test.hpp>
#include <clocale>
#include <cmath>
#include <locale>
#include <string>

#include "reprise/base/constants.hpp"
#include "reprise/io/expression.hpp"
#include "temporary_folder.hpp"

using reprise::evaluate;
using reprise::Evaluated;
using reprise::pi;

namespace {

double value(const std::string& expression) {
  const Evaluated evaluated = evaluate(expression);
  BOOST_TEST(evaluated.trouble == "", expression);
  BOOST_REQUIRE(evaluated.value.has_value());
  return *evaluated.value;
}

std::string trouble(const std::string& expression) {
  const Evaluated evaluated = evaluate(expression);
  BOOST_TEST(!evaluated.value.has_value(), expression);
  return evaluated.trouble;
}

}  // namespace

BOOST_AUTO_TEST_CASE(expressions_are_worth_what_the_same_operations_give) {
  const double root = std::sqrt(3.0);
  BOOST_TEST(value("10*sqrt(3)/3") == 10.0 * root / 3.0);
  BOOST_TEST(value("-5*sqrt(3)") == -5.0 * root);
  BOOST_TEST(value("pi/6") == pi / 6.0);
  BOOST_TEST(value("1/3/3") == 1.0 / 3.0 / 3.0);
  BOOST_TEST(value("1 - 2 - 3") == -4.0);
  BOOST_TEST(value("2 + 3 * 4") == 14.0);
  BOOST_TEST(value("(2 + 3) * -4") == -20.0);
  BOOST_TEST(value("-(-2)") == 2.0);
  BOOST_TEST(value(" .5 ") == 0.5);
  BOOST_TEST(value("+5.") == 5.0);
  BOOST_TEST(value("15.91e-1") == 1.591);
  BOOST_TEST(value("0.1") == 0.1);
  BOOST_TEST(value("sqrt(sqrt(16) + 12)") == 4.0);
  BOOST_TEST(value("0.1*3") == 0.1 * 3);  // not 0.3
}

BOOST_AUTO_TEST_CASE(angles_are_degrees) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const std::string angle = std::to_string(90 * quarter);
    const int turn = ((quarter % 4) + 4) % 4;
    BOOST_TEST(value("sin(" + angle + ")") == (turn == 1 ? 1.0 : turn == 3 ? -1.0 : 0.0));
    BOOST_TEST(value("cos(" + angle + ")") == (turn == 0 ? 1.0 : turn == 2 ? -1.0 : 0.0));
  }
  constexpr double rounding = 4e-16;
  BOOST_TEST(std::abs(value("sin(30)") - 0.5) < rounding);
  BOOST_TEST(std::abs(value("cos(-60)") - 0.5) < rounding);
  BOOST_TEST(std::abs(value("sin(300)") + std::sqrt(0.75)) < rounding);
  BOOST_TEST(std::abs(value("cos(45) - sqrt(2)/2")) < rounding);
  BOOST_TEST(std::abs(value("sin(20)*sin(20) + cos(20)*cos(20)") - 1.0) < rounding);
  BOOST_TEST(std::abs(value("sin(1e15 + 30)") - value("sin(1e15 - 360*2777777777777 + 30)")) < rounding);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_read_is_said_with_its_place) {
  BOOST_TEST(trouble("") == "is empty");
  BOOST_TEST(trouble("  ") == "is empty");
  BOOST_TEST(trouble("10*sqr(3)") == "cannot be read at character 4 ('sqr')");
  BOOST_TEST(trouble("2*") == "ends too early");
  BOOST_TEST(trouble("(1 + 2") == "has a parenthesis that is not closed");
  BOOST_TEST(trouble("1 + 2)") == "cannot be read at character 6 (')')");
  BOOST_TEST(trouble("sqrt()") == "has no number in the parentheses of sqrt");
  BOOST_TEST(trouble("2,5") == "cannot be read at character 2 (',')");
  BOOST_TEST(trouble("2^3") == "cannot be read at character 2 ('^')");
  BOOST_TEST(trouble("1 ? 2 : 3") == "cannot be read at character 3 ('?')");
  BOOST_TEST(trouble("a=1") == "cannot be read at character 2 ('=')");
  BOOST_TEST(trouble("2\n3") == "cannot be read at character 2");
  BOOST_TEST(trouble("3\xc2\xb0") == "cannot be read at character 2");
  BOOST_TEST(trouble("1 2") == "cannot be read at character 3 ('2')");
  BOOST_TEST(trouble("2pi") == "cannot be read at character 2 ('pi')");
  BOOST_TEST(trouble("1e400") == "cannot be read at character 1 ('1e400')");
  for (const char* infinite : {"1/0", "-1/0", "0/0", "sqrt(-1)", "1e308*10", "sin(1/0)", "cos(sqrt(-1))"}) {
    BOOST_TEST(trouble(infinite) == "has no finite value", infinite);
  }
  for (const char* other : {"nan", "inf", "0x10", "1_000", "e", "_pi", "rnd()", "sum(1)", "1.5.2", "()", "*", "--5"}) {
    BOOST_TEST(contains(trouble(other), "cannot be read at character"), other);
  }
}

BOOST_AUTO_TEST_CASE(nesting_is_as_deep_as_the_length_allows) {
  BOOST_TEST(value(std::string(499, '(') + "7" + std::string(499, ')')) == 7.0);
  std::string roots;
  for (int k = 0; k < 160; ++k) roots += "sqrt(";
  BOOST_TEST(value(roots + "1" + std::string(160, ')')) == 1.0);
  BOOST_TEST(trouble(std::string(1000, '(')) == "ends too early");
  BOOST_TEST(trouble(std::string(1'000'000, '(')) == "is longer than 1000 characters");
}

// A failure leaves nothing behind for the next expression.
BOOST_AUTO_TEST_CASE(expressions_do_not_know_each_other) {
  BOOST_TEST(trouble("((2*") != "");
  BOOST_TEST(value("3 - 1") == 2.0);
}

BOOST_AUTO_TEST_CASE(the_locale_does_not_matter) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  BOOST_TEST(value("1234.5*2") == 2469.0);
  std::locale::global(before);
  // Where the machine has no such locale this changes nothing.
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  BOOST_TEST(value("0.5*2") == 1.0);
  std::setlocale(LC_ALL, "C");
}
