// The first exception of a parallel region. None may leave OpenMP's loops: the program would end.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace reflines {

class ParallelFailure {
 public:
  // Runs `work` on the calling thread and keeps what it throws; does nothing once another piece of work has failed.
  template <typename Work>
  void run(const Work& work) noexcept {
    if (failed_) return;
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (failure_ == nullptr) failure_ = std::current_exception();
      failed_ = true;
    }
  }

  // Throws what was kept; call it after the region.
  void rethrow() const {
    if (failure_ != nullptr) std::rethrow_exception(failure_);
  }

 private:
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

// Runs work(0) to work(count - 1) on all threads, `chunk` of them at a time; throws the first failure after all.
template <typename Work>
void run_parallel(int count, int chunk, const Work& work) {
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic, chunk) if (count > chunk)
  for (int k = 0; k < count; ++k) failure.run([&] { work(k); });
  failure.rethrow();
}

}  // namespace reflines
