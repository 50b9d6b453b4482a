// Work that never looks at its Progress is left behind when that is cancelled, and nothing else changes for its caller.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "reflines/errors.h"
#include "threads/abandonable_work.h"

namespace reflines {
namespace {

using std::chrono::milliseconds;

// Work that ends when the test says so, as a factorization that cannot be interrupted.
struct Stubborn {
  std::promise<void> may_end;
  std::shared_future<void> end = may_end.get_future().share();
  std::shared_ptr<std::atomic<int>> ended = std::make_shared<std::atomic<int>>(0);

  std::function<void()> work() const {
    return [end = end, ended = ended] {
      end.wait();
      ++*ended;
    };
  }
};

TEST(AbandonableWorkTest, ReturnsAtTheEndOfTheWork) {
  Progress progress;
  const auto thread = std::make_shared<std::thread::id>();
  run_abandonable(&progress, [thread] { *thread = std::this_thread::get_id(); });
  EXPECT_NE(*thread, std::thread::id());
  EXPECT_NE(*thread, std::this_thread::get_id());
}

TEST(AbandonableWorkTest, WorkThatNobodyMayCancelStaysOnItsThread) {
  std::thread::id thread;
  run_abandonable(nullptr, [&thread] { thread = std::this_thread::get_id(); });
  EXPECT_EQ(thread, std::this_thread::get_id());
}

TEST(AbandonableWorkTest, WorkWithinAbandonableWorkStaysOnItsThread) {
  Progress progress;
  const auto same = std::make_shared<bool>(false);
  run_abandonable(&progress, [same, &progress] {
    const auto outer = std::this_thread::get_id();
    run_abandonable(&progress, [same, outer] { *same = outer == std::this_thread::get_id(); });
  });
  EXPECT_TRUE(*same);
  EXPECT_TRUE(may_abandon(&progress));
}

TEST(AbandonableWorkTest, ErrorsReachTheCaller) {
  Progress progress;
  EXPECT_THROW(run_abandonable(&progress, [] { throw InvalidInput("No."); }), InvalidInput);
}

TEST(AbandonableWorkTest, WhatWasCancelledBeforeIsNotBegun) {
  Progress progress;
  progress.cancel();
  const auto begun = std::make_shared<std::atomic<bool>>(false);
  EXPECT_THROW(run_abandonable(&progress, [begun] { *begun = true; }), Cancelled);
  EXPECT_FALSE(*begun);
}

TEST(AbandonableWorkTest, ACancelledCallerDoesNotWait) {
  Stubborn stubborn;
  Progress progress;
  std::thread artist([&progress] {
    std::this_thread::sleep_for(milliseconds(30));
    progress.cancel();
  });
  EXPECT_THROW(run_abandonable(&progress, stubborn.work()), Cancelled);  // for ever, if it waited
  EXPECT_EQ(*stubborn.ended, 0);
  artist.join();
  stubborn.may_end.set_value();
}

TEST(AbandonableWorkTest, TheNextCallWaitsForWhatWasAbandonedAndCanBeCancelledThere) {
  Stubborn stubborn;
  Progress first, second, third;
  std::thread artist([&] {
    std::this_thread::sleep_for(milliseconds(30));
    first.cancel();
    std::this_thread::sleep_for(milliseconds(60));
    second.cancel();
  });
  EXPECT_THROW(run_abandonable(&first, stubborn.work()), Cancelled);
  const auto begun = std::make_shared<std::atomic<bool>>(false);
  EXPECT_THROW(run_abandonable(&second, [begun] { *begun = true; }), Cancelled);
  EXPECT_FALSE(*begun);
  artist.join();
  stubborn.may_end.set_value();
  run_abandonable(&third, [ended = stubborn.ended] { EXPECT_EQ(*ended, 1); });
}

TEST(AbandonableWorkTest, WhatTheWorkOwnsIsFreedAtItsEnd) {
  Progress progress;
  auto memory = std::make_shared<int>(0);
  const std::weak_ptr<int> watched = memory;
  run_abandonable(&progress, [memory = std::move(memory)] {});
  EXPECT_TRUE(watched.expired());
}

}  // namespace
}  // namespace reflines
