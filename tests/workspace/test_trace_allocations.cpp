// Tracing allocates nothing for each point.

#include <boost/test/unit_test.hpp>
#include <cstddef>

#include "../allocation_counter.hpp"
#include "reprise/workspace/trace.hpp"
#include "samples.hpp"

using namespace reprise;
using namespace reprise::test;

BOOST_AUTO_TEST_CASE(more_points_cost_no_more_allocations_than_the_list_of_points_needs_to_grow) {
#ifndef __SANITIZE_ADDRESS__
  const ConstantOrientationLimits limits(m1(), 0.0);
  const auto count = [&](double chord) {
    const std::size_t before = allocations;
    const TracedBoundary boundary = trace_boundary(limits, {1.0, 1.5}, {.chord = chord});
    BOOST_TEST(boundary.closed());
    return allocations - before;
  };
  const std::size_t coarse = count(0.02);
  // 16 times the points: the list doubles four times.
  const std::size_t fine = count(0.02 / 16.0);
  BOOST_TEST(coarse > 0u);
  BOOST_TEST(fine <= coarse + 5u);
#else
  BOOST_TEST_MESSAGE("nothing is counted under the address sanitizer");
#endif
}
