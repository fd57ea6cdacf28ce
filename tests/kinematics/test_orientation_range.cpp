#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "reprise/kinematics/orientation_range.hpp"

using namespace reprise;

BOOST_AUTO_TEST_CASE(a_slice_is_one_orientation_and_a_range_has_both_its_ends) {
  const OrientationRange slice{0.3, 0.3};
  BOOST_TEST(slice.is_slice());
  BOOST_TEST(slice.ends() == std::vector{0.3}, boost::test_tools::per_element());
  BOOST_TEST(slice.spread(11) == std::vector{0.3}, boost::test_tools::per_element());
  const OrientationRange range{-0.1, 0.7};
  BOOST_TEST(!range.is_slice());
  BOOST_TEST(range.ends() == (std::vector{-0.1, 0.7}), boost::test_tools::per_element());
  for (const int count : {2, 3, 12}) {
    const std::vector<double> spread = range.spread(count);
    BOOST_REQUIRE_EQUAL(spread.size(), static_cast<std::size_t>(count));
    BOOST_TEST(spread.front() == range.lower);
    BOOST_TEST(spread.back() == range.upper);
    for (std::size_t k = 1; k < spread.size(); ++k) {
      BOOST_TEST(spread[k] - spread[k - 1] == 0.8 / (count - 1), boost::test_tools::tolerance(1e-13));
    }
  }
  BOOST_CHECK_THROW(range.spread(1), std::invalid_argument);
  BOOST_CHECK_THROW(slice.spread(1), std::invalid_argument);
  for (const OrientationRange& one : slices({-0.2, 0.0, 0.2})) BOOST_TEST(one.is_slice());
}
