#pragma once

// Counts every call of malloc, whoever makes it. To be included in one file of a test program. Under the address
// sanitizer, which has its own malloc, there is nothing to count.

#include <cstddef>

#ifndef __SANITIZE_ADDRESS__

namespace {
std::size_t allocations = 0;
}

extern "C" void* __libc_malloc(std::size_t size);  // NOLINT(bugprone-reserved-identifier): glibc's own name
extern "C" void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}

#endif
