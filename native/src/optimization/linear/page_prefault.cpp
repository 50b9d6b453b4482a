#include "optimization/linear/page_prefault.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstdint>

namespace reflines {

namespace {

constexpr std::size_t kPage = std::size_t{1} << 12;
constexpr std::size_t kHugePage = std::size_t{1} << 21;

// Asks Linux for huge pages, a hint: where it is not followed, and on other systems, pages are small.
void ask_for_huge_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  const auto begin = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (begin + kHugePage - 1) / kHugePage * kHugePage;
  const std::uintptr_t last = (begin + bytes) / kHugePage * kHugePage;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace

void provide_pages(void* block, std::size_t bytes) {
  ask_for_huge_pages(block, bytes);
  volatile char* const memory = static_cast<char*>(block);
  constexpr std::size_t kBlock = 2 * kHugePage;
#pragma omp parallel for schedule(dynamic) if (bytes > kBlock)
  for (std::size_t begin = 0; begin < bytes; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, bytes);
    for (std::size_t place = begin; place < end; place += kPage) memory[place] = 0;
  }
}

}  // namespace reflines
