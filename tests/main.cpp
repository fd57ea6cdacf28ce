// Boost.Test puts the main() of the test programs here.

#define BOOST_TEST_DYN_LINK
#define BOOST_TEST_MODULE reprise

#include <boost/test/unit_test.hpp>
