#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "reprise/io/messages.hpp"

using namespace reprise;

BOOST_AUTO_TEST_CASE(a_slip_is_told_from_another_word) {
  const std::vector<std::string> keys{"base", "platform",  "length", "base_angle_deg",
                                      "leg",  "range_deg", "centre", "x_C"};
  const auto meant = [&](const std::string& word) {
    const std::string text = did_you_mean(word, keys);
    return text.empty() ? text : text.substr(14, text.size() - 16);
  };
  BOOST_TEST(did_you_mean("bsae", keys) == "did you mean 'base'?");
  BOOST_TEST(meant("bas") == "base");    // left out
  BOOST_TEST(meant("baase") == "base");  // put in
  BOOST_TEST(meant("bsae") == "base");   // exchanged
  BOOST_TEST(meant("bade") == "base");   // changed
  BOOST_TEST(meant("legs") == "leg");
  BOOST_TEST(meant("center") == "centre");
  BOOST_TEST(meant("platfrom") == "platform");
  BOOST_TEST(meant("Platform") == "platform");
  BOOST_TEST(meant("lenght") == "length");
  BOOST_TEST(meant("range") == "range_deg");  // cut short
  BOOST_TEST(meant("base_angle") == "base_angle_deg");
  BOOST_TEST(meant("x_c") == "x_C");
  BOOST_TEST(meant("") == "");
  BOOST_TEST(meant("x") == "");
  BOOST_TEST(meant("colour") == "");
  BOOST_TEST(meant("unit") == "");
  BOOST_TEST(meant(std::string(100'000, 'b')) == "");
  BOOST_TEST(did_you_mean("base", {}) == "");
  // The nearest is taken, among equally near ones the first.
  BOOST_TEST(did_you_mean("aac", {"abd", "aab", "aad"}) == "did you mean 'aab'?");
}

BOOST_AUTO_TEST_CASE(messages_have_one_line) {
  BOOST_TEST(on_one_line("a\r\n\tb\x7f"
                         "c") == "a b c");
  BOOST_TEST(on_one_line("\na \xc3\xa4\n") == "a \xc3\xa4");
  BOOST_TEST(on_one_line("\n") == "");
  BOOST_TEST(on_one_line(std::string("a\0b", 3)) == "a b");
}

BOOST_AUTO_TEST_CASE(things_are_counted) {
  BOOST_TEST(counted(0, "leg") == "0 legs");
  BOOST_TEST(counted(1, "leg") == "1 leg");
  BOOST_TEST(counted(2, "leg") == "2 legs");
}
