#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "reprise/base/require.hpp"

using namespace reprise;

BOOST_AUTO_TEST_CASE(numbers_keep_their_digits) {
  for (const double value : {1e-9, 0.1, -1.0 / 3.0, 1e300, 5e-324})
    BOOST_TEST(std::strtod(shown(value).c_str(), nullptr) == value);
  BOOST_TEST(shown(1e-9) == "1e-09");
  BOOST_TEST(shown(std::numeric_limits<double>::quiet_NaN()) == "nan");
  BOOST_TEST(shown(Eigen::Vector2d(1.0, 0.5)) == "(1, 0.5)");
}

BOOST_AUTO_TEST_CASE(a_broken_condition_names_argument_value_and_what_is_allowed) {
  const auto says = [](const std::string& expected) {
    return [expected](const std::invalid_argument& error) { return error.what() == expected; };
  };
  require(true, "chord", -1.0, "positive");
  BOOST_CHECK_EXCEPTION(require(false, "chord", 1e-9, "positive"), std::invalid_argument,
                        says("chord is 1e-09, but it must be positive"));
  BOOST_CHECK_EXCEPTION(require(false, "samples", 3, "at least 8"), std::invalid_argument,
                        says("samples is 3, but it must be at least 8"));
  BOOST_CHECK_EXCEPTION(require(false, "mode", "x", "a or b"), std::invalid_argument,
                        says("mode is x, but it must be a or b"));
  BOOST_CHECK_EXCEPTION(require(false, "u", Eigen::Vector2d(0.0, 2.0), "short"), std::invalid_argument,
                        says("u is (0, 2), but it must be short"));
}
