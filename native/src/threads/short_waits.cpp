#include "threads/short_waits.h"

#include <omp.h>

#include <algorithm>
#include <cstdlib>
#include <latch>
#include <thread>

namespace reflines {
namespace {

// Returns whether libgomp is there, and the user has left it to the program how its threads wait.
bool may_shorten() {
#if defined(__linux__) && !defined(__clang__)
  return std::getenv("OMP_WAIT_POLICY") == nullptr && std::getenv("GOMP_SPINCOUNT") == nullptr;
#else
  return false;
#endif
}

// Has a team of OpenMP threads of this size, and keeps it.
[[noreturn]] void keep_team(int threads) {
#pragma omp parallel num_threads(threads)
  {
    asm volatile("");  // the compiler leaves out a region without any work
  }
  std::latch never(1);
  while (true) never.wait();
}

}  // namespace

void shorten_waits() {
  if (!may_shorten()) return;
  // libgomp reads the environment when it is loaded, which Blender does at its start. But it spins 100 times only, not
  // 300,000, while it manages more threads than there are processors: a team that sleeps brings their number there.
  const int threads = std::max(2, omp_get_num_procs() - omp_get_max_threads() + 2);
  // Neither joined nor detached: it ends with the process.
  [[maybe_unused]] static const std::thread& keeper = *new std::thread(keep_team, threads);
}

}  // namespace reflines
