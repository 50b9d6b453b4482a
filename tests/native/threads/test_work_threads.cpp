#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "threads/work_threads.h"

namespace reflines {
namespace {

TEST(WorkThreads, AllWorkIsDone) {
  std::atomic<int> sum = 0;
  for (int k = 1; k <= 100; ++k) run_in_background([&sum, k] { sum += k; });
  wait_for_background_work();
  EXPECT_EQ(sum, 5050);
}

// Each piece waits for the other, so that one thread alone would never end.
TEST(WorkThreads, PiecesRunAtTheSameTime) {
  std::atomic<int> begun = 0;
  for (int k = 0; k < 4; ++k) {
    run_in_background([&begun] {
      ++begun;
      while (begun < 4) std::this_thread::yield();
    });
  }
  wait_for_background_work();
  EXPECT_EQ(begun, 4);
}

TEST(WorkThreads, AThreadIsUsedAgain) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  for (int k = 0; k < 20; ++k) {
    run_in_background([&] {
      const std::scoped_lock lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
    wait_for_background_work();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // until the thread waits again
  }
  EXPECT_LT(threads.size(), 20);
  EXPECT_EQ(threads.count(std::this_thread::get_id()), 0);
}

TEST(WorkThreads, WhatWorkOwnsIsFreedBeforeItCountsAsDone) {
  const auto owned = std::make_shared<int>(1);
  run_in_background([owned] {});
  wait_for_background_work();
  EXPECT_EQ(owned.use_count(), 1);
}

}  // namespace
}  // namespace reflines
