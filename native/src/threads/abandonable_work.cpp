#include "threads/abandonable_work.h"

#include <chrono>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace reflines {
namespace {

constexpr auto kLookInterval = std::chrono::milliseconds(10);

thread_local bool runs_abandonable_work = false;

// The work that was abandoned, until it ends.
class Abandoned {
 public:
  ~Abandoned() {
    for (Job& job : jobs_) job.thread.join();
  }

  // Waits for the end of what was abandoned before. Throws Cancelled.
  void wait(const Progress& progress) {
    while (!has_ended()) {
      if (progress.cancelled()) throw Cancelled();
      std::this_thread::sleep_for(kLookInterval);
    }
  }

  void keep(std::thread thread, std::future<void> end) {
    const std::scoped_lock lock(mutex_);
    jobs_.push_back({std::move(thread), std::move(end)});
  }

 private:
  struct Job {
    std::thread thread;
    std::future<void> end;
  };

  bool has_ended() {
    const std::scoped_lock lock(mutex_);
    std::erase_if(jobs_, [](Job& job) {
      if (job.end.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
      job.thread.join();
      return true;
    });
    return jobs_.empty();
  }

  std::mutex mutex_;
  std::vector<Job> jobs_;
};

Abandoned abandoned;

}  // namespace

bool may_abandon(const Progress* progress) { return progress != nullptr && !runs_abandonable_work; }

void run_abandonable(const Progress* progress, std::function<void()> work) {
  if (!may_abandon(progress)) return work();
  abandoned.wait(*progress);
  if (progress->cancelled()) throw Cancelled();
  std::packaged_task<void()> task([work = std::move(work)]() mutable {
    runs_abandonable_work = true;
    const std::function<void()> own = std::move(work);  // what it owns is freed here, not with the future
    own();
  });
  std::future<void> end = task.get_future();
  std::thread thread(std::move(task));
  while (end.wait_for(kLookInterval) != std::future_status::ready) {
    if (!progress->cancelled()) continue;
    abandoned.keep(std::move(thread), std::move(end));
    throw Cancelled();
  }
  thread.join();
  end.get();
}

}  // namespace reflines
