// Counts every heap allocation of the program, the libraries' own included. For one file of a test program.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

// Only glibc lets a program replace malloc and call the original. The sanitizers bring their own malloc: GCC tells by a
// macro, clang by __has_feature.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define REFLINES_OTHER_MALLOC
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define REFLINES_OTHER_MALLOC
#endif

static std::atomic<std::int64_t> allocations{0};
#if defined(__GLIBC__) && !defined(REFLINES_OTHER_MALLOC)
constexpr bool kAllocationsAreCounted = true;
extern "C" void* __libc_malloc(std::size_t size);  // NOLINT(readability-identifier-naming): glibc's name
extern "C" void* malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#else
constexpr bool kAllocationsAreCounted = false;
#endif
