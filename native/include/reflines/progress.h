// Progress of a computation, shared between the thread that computes and threads that watch it and may cancel it.
#pragma once

#include <atomic>

#include "reflines/errors.h"

namespace reflines {

// The state of one computation, thread safe without locks: one thread writes it, any number of threads read and may
// cancel.
class Progress {
 public:
  // Sets the state: `fraction` in [0, 1]; `stage` must be a string literal (it is kept by address).
  void report(double fraction, const char* stage) {
    fraction_.store(fraction, std::memory_order_relaxed);
    stage_.store(stage, std::memory_order_relaxed);
  }
  // Sets the state likewise, and throws Cancelled where the computation was cancelled.
  void enter(double fraction, const char* stage) {
    report(fraction, stage);
    if (cancelled()) throw Cancelled();
  }
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  const char* stage() const { return stage_.load(std::memory_order_relaxed); }

  // Asks the computation to stop at its next check; the unknowns are then left as they were.
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<double> fraction_{0.0};
  std::atomic<const char*> stage_{""};
  std::atomic<bool> cancelled_{false};
};

// Throws Cancelled where there is a progress and it was cancelled: every stage calls this at least every 0.3 s.
inline void throw_if_cancelled(const Progress* progress) {
  if (progress != nullptr && progress->cancelled()) throw Cancelled();
}

}  // namespace reflines
