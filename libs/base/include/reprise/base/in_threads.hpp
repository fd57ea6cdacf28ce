#pragma once

// Work that falls into parts, done in several threads.

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace reprise {

/// Calls work(k) for every k below `count`, in that many threads (at least one). The calls must not depend on each
/// other. What one of them throws is thrown on, once all threads have ended; no call begins after it.
template <class Work>
void in_threads(std::size_t count, long threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::size_t k = next++; k < count; k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> others;
  for (long k = 1; k < threads; ++k) others.emplace_back(run);
  run();
  for (std::thread& one : others) one.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace reprise
