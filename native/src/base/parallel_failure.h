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

}  // namespace reflines
