#include <gtest/gtest.h>

#include <atomic>
#include <new>

#include "base/parallel_failure.h"

namespace reflines {
namespace {

TEST(ParallelFailure, LeavesALoopOfThreadsAfterIt) {
  ParallelFailure failure;
#pragma omp parallel for num_threads(4) schedule(dynamic)
  for (int k = 0; k < 100; ++k) {
    failure.run([k] {
      if (k % 10 == 3) throw std::bad_alloc();
    });
  }
  EXPECT_THROW(failure.rethrow(), std::bad_alloc);
}

TEST(ParallelFailure, DoesAllWorkWhereNothingFails) {
  ParallelFailure failure;
  std::atomic<int> sum = 0;
#pragma omp parallel for num_threads(4) schedule(dynamic)
  for (int k = 1; k <= 100; ++k) failure.run([&sum, k] { sum += k; });
  failure.rethrow();
  EXPECT_EQ(sum, 5050);
}

TEST(ParallelFailure, PiecesOfALoopAreDoneOnceUpToTheFirstFailure) {
  std::atomic<int> sum = 0;
  run_parallel(101, 7, [&sum](int k) { sum += k; });
  EXPECT_EQ(sum, 5050);
  EXPECT_THROW(run_parallel(101, 7,
                            [](int k) {
                              if (k == 50) throw std::bad_alloc();
                            }),
               std::bad_alloc);
}

}  // namespace
}  // namespace reflines
