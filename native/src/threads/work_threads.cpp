#include "threads/work_threads.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace reflines {
namespace {

class WorkThreads {
 public:
  void run(std::function<void()> work) {
    const std::scoped_lock lock(mutex_);
    // First, since a system that is out of threads throws here.
    if (idle_ <= static_cast<int>(waiting_.size())) threads_.emplace_back(&WorkThreads::serve, this);
    waiting_.push_back(std::move(work));
    ++unfinished_;
    changed_.notify_all();
  }

  void wait_until_idle() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return unfinished_ == 0; });
  }

 private:
  [[noreturn]] void serve() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      ++idle_;
      changed_.wait(lock, [this] { return !waiting_.empty(); });
      --idle_;
      std::function<void()> work = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      work();
      work = nullptr;  // what it owns is freed without the lock
      lock.lock();
      --unfinished_;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::vector<std::thread> threads_;  // neither joined nor detached: they end with the process
  int idle_ = 0, unfinished_ = 0;
};

// Returns the threads, which are never destroyed: they wait until the process ends.
WorkThreads& threads() {
  static WorkThreads& own = *new WorkThreads;
  return own;
}

}  // namespace

void run_in_background(std::function<void()> work) { threads().run(std::move(work)); }

void wait_for_background_work() { threads().wait_until_idle(); }

}  // namespace reflines
