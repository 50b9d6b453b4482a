// Progress of a computation, shared between the thread that computes and threads that watch it and may cancel it.
#pragma once

#include <atomic>

#include "reflines/errors.h"

namespace reflines {

// Thread safe without locks: one thread solves and reports, any number of threads read and may cancel.
class Progress {
 public:
  // `fraction` in [0, 1]; `stage` must be a string literal (it is kept by address).
  void report(double fraction, const char* stage) {
    fraction_.store(fraction, std::memory_order_relaxed);
    stage_.store(stage, std::memory_order_relaxed);
  }
  // The same for work that throws Cancelled where it was told to stop.
  void enter(double fraction, const char* stage) {
    report(fraction, stage);
    if (cancelled()) throw Cancelled();
  }
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  const char* stage() const { return stage_.load(std::memory_order_relaxed); }

  // Asks the solver to give up at its next look; the unknowns are then left as they were.
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<double> fraction_{0.0};
  std::atomic<const char*> stage_{""};
  std::atomic<bool> cancelled_{false};
};

}  // namespace reflines
