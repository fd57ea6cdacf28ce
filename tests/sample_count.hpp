#pragma once

// How many samples of one kind a test takes. Header only.

#include <algorithm>
#include <concepts>

namespace reprise::test {

#ifdef REPRISE_FEW_SAMPLES
inline constexpr bool few_samples = true;
#else
inline constexpr bool few_samples = false;
#endif

/// All of them in Release. With the sanitizers, under which a test takes ten times as long, and in Debug a quarter, at
/// least 1: what they find, they find in few samples.
template <std::integral Number>
constexpr Number scaled(Number count) {
  return few_samples ? std::max<Number>(count / 4, 1) : count;
}

/// How many of a kind that chance brings must be among the samples: of a quarter of them, an eighth, since small
/// numbers scatter more.
template <std::integral Number>
constexpr Number scaled_minimum(Number count) {
  return few_samples ? std::max<Number>(count / 8, 1) : count;
}

}  // namespace reprise::test
