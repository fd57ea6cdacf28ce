// Tracing allocates nothing for each point.

#include <boost/test/unit_test.hpp>
#include <cstddef>

#include "allocation_counter.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/workspace/dextrous_limits.hpp"
#include "reprise/workspace/trace.hpp"
#include "workspace/samples.hpp"

using namespace reprise;
using namespace reprise::test;

namespace {

#ifndef __SANITIZE_ADDRESS__
/// Traces M1's boundary with a chord and with one that gives 16 times the points.
void check_allocations(const Limits& limits) {
  const auto count = [&](double chord) {
    const std::size_t before = allocations;
    const TracedBoundary boundary = trace_boundary(limits, {1.0, 1.5}, {.chord = chord});
    BOOST_TEST(boundary.closed());
    return allocations - before;
  };
  const std::size_t coarse = count(0.02);
  // The list doubles four times.
  const std::size_t fine = count(0.02 / 16.0);
  BOOST_TEST(coarse > 0u);
  BOOST_TEST(fine <= coarse + 5u);
}
#else
void check_allocations(const Limits&) { BOOST_TEST_MESSAGE("nothing is counted under the address sanitizer"); }
#endif

}  // namespace

BOOST_AUTO_TEST_CASE(more_points_cost_no_more_allocations_than_the_list_of_points_needs_to_grow) {
  check_allocations(ConstantOrientationLimits(m1(), 0.0));
  check_allocations(DextrousLimits(m1(), {-pi / 36.0, pi / 36.0}));
}
