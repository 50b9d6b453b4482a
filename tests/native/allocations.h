// Counts every heap allocation of the program, the libraries' own included. For one file of a test program.
#pragma once

#include <atomic>
#include <cstddef>

#if !defined(__SANITIZE_ADDRESS__)                 // AddressSanitizer brings its own malloc
extern "C" void* __libc_malloc(std::size_t size);  // NOLINT(readability-identifier-naming): glibc's name
static std::atomic<long> allocations{0};
extern "C" void* malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#else
static std::atomic<long> allocations{0};
#endif
